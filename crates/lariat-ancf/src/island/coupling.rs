//! Inertia that couples bodies: those of one mechanism that several cables hold.
//!
//! # Equation
//!
//! ```text
//! T = 1/2 sum_i u_i . B_i u_i + sum_(i<j) u_i . C_ij u_j
//! ```
//!
//! u = (v, w) are the velocities of the bodies, B_i their own [inertia](super::RigidBody) with what
//! they carry, and C_ij the blocks beside the diagonal of the operational-space inertia of the
//! bodies that a mechanism connects.
//!
//! # Validity
//!
//! As of a carried inertia: constant over a step. T must be positive definite.
//!
//! # References
//!
//! Khatib 1987, the operational space inertia; Chang & Khatib 2000, of several operational points.
//!
//! # Alternatives considered
//!
//! The other bodies' cables as loads that are known from the last step: they lag, and the forces of
//! two ropes on one arm ripple by 0.39 of their sum.

use crate::error::{Error, require};
use nalgebra::{Matrix6, UnitQuaternion, Vector6};

/// Inertia that couples two bodies of an [island](super::Island).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoupledInertia {
    /// Indices of the bodies.
    pub bodies: [usize; 2],
    /// Momentum and angular momentum of the first per velocity and angular velocity of the second,
    /// in world axes about their centres of mass, [when](super::RigidBody::carried_at) the step
    /// begins (kg, kg m, kg m^2). Its transpose couples the second to the first.
    pub matrix: Matrix6<f64>,
}

impl CoupledInertia {
    /// Returns the momenta of both bodies by the velocities of the other.
    pub(super) fn momenta(&self, velocity: impl Fn(usize) -> Vector6<f64>) -> [(usize, Vector6<f64>); 2] {
        let [one, two] = self.bodies;
        [(one, self.matrix * velocity(two)), (two, self.matrix.tr_mul(&velocity(one)))]
    }

    /// Returns it with the rotations of both bodies in axes that are turned from those in which it
    /// is by `turns`.
    pub(super) fn turned(&self, turns: [UnitQuaternion<f64>; 2]) -> Self {
        let [one, two] = turns.map(|turn| {
            let mut both = Matrix6::identity();
            both.fixed_view_mut::<3, 3>(3, 3).copy_from(turn.to_rotation_matrix().matrix());
            both
        });
        CoupledInertia { matrix: one * self.matrix * two.transpose(), ..*self }
    }
}

/// Checks that each couples two bodies out of `count`.
pub(super) fn check(coupled: &[CoupledInertia], count: usize) -> Result<(), Error> {
    for CoupledInertia { bodies: [one, two], matrix } in coupled {
        let other = *one.max(two);
        require("coupled body", other as f64, one != two && other < count, "the index of another body of the island")?;
        let largest = matrix.amax();
        require("coupled inertia (kg, kg m, kg m^2)", largest, matrix.iter().all(|x| x.is_finite()), "finite")?;
    }
    Ok(())
}
