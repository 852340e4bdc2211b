//! A rigid body as an island sees it.
//!
//! `m x'' = f`, `I omega' + omega x I omega = tau` about the centre of mass, f and tau constant over a step, in world axes.
//! With a carried inertia C (6x6, symmetric, constant over a step) `(diag(m, I) + C) (x'', omega')` stands on the left: what a link of a
//! mechanism feels of the links that it moves with. *Source.* Khatib 1987, the operational space inertia.

use super::memory::BodyMemory;
use crate::error::{Error, require, require_finite};
use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};

/// A rigid body. All vectors in world axes, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidBody {
    /// Mass in kg; 0 for a massless junction of cables.
    pub mass: f64,
    /// Inertia about the centre of mass in kg m^2, in body axes.
    pub inertia: Matrix3<f64>,
    /// Centre of mass in m.
    pub position: Vector3<f64>,
    /// Attitude: body axes to world axes.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of the centre of mass in m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity in rad/s.
    pub angular_velocity: Vector3<f64>,
    /// Force through the centre of mass in N, gravity included.
    pub force: Vector3<f64>,
    /// Torque in N m.
    pub torque: Vector3<f64>,
    /// World axes along which forces move the body (x, y, z) and about which they turn it (x, y, z); along others it keeps its
    /// velocity. All false: a driven body.
    pub free: [bool; 6],
    /// Inertia of what it moves with, beyond its own, about its centre of mass in world axes: velocity before angular velocity
    /// (kg, kg m, kg m^2). Default: none.
    pub carried: Option<Matrix6<f64>>,
    /// Whether the gyroscopic torque -omega x I omega acts (an engine may leave it out).
    pub gyroscopic: bool,
    /// What integrators carry from step to step; `None` if the state was not the result of a step.
    pub memory: Option<BodyMemory>,
}

impl RigidBody {
    /// A free body at rest, without force.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a mass that is not positive, or numbers that are not finite.
    pub fn new(mass: f64, inertia: Matrix3<f64>, position: Vector3<f64>) -> Result<Self, Error> {
        require("body mass (kg)", mass, mass > 0.0, "> 0")?;
        for (i, principal) in inertia.symmetric_eigenvalues().iter().enumerate() {
            require(&format!("principal inertia {i} (kg m^2)"), *principal, *principal > 0.0, "> 0")?;
        }
        require_finite("body position (m)", &position)?;
        Ok(RigidBody {
            mass,
            inertia,
            position,
            rotation: UnitQuaternion::identity(),
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            force: Vector3::zeros(),
            torque: Vector3::zeros(),
            free: [true; 6],
            carried: None,
            gyroscopic: true,
            memory: None,
        })
    }

    /// A massless point that holds cables together.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a position that is not finite.
    pub fn junction(position: Vector3<f64>) -> Result<Self, Error> {
        let mut body = RigidBody::new(1.0, Matrix3::identity(), position)?;
        body.mass = 0.0;
        body.free = [true, true, true, false, false, false];
        Ok(body)
    }

    /// Inertia about the centre of mass in world axes, at attitude `rotation`.
    pub fn world_inertia(&self, rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
        let r = rotation.to_rotation_matrix();
        r * self.inertia * r.transpose()
    }

    /// Momentum and angular momentum about the centre of mass of what it carries, at velocity `v` and angular velocity `spin`.
    pub(super) fn carried_momentum(
        &self,
        v: &Vector3<f64>,
        spin: &Vector3<f64>,
    ) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let carried = self.carried?;
        let p = carried * Vector6::new(v.x, v.y, v.z, spin.x, spin.y, spin.z);
        Some((p.fixed_rows::<3>(0).into_owned(), p.fixed_rows::<3>(3).into_owned()))
    }

    /// Returns the kinetic energy in J, without that of what it carries.
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * (self.mass * self.velocity.norm_squared() + self.angular_velocity.dot(&self.spin()))
    }

    /// Returns the linear momentum in kg m/s and the angular momentum about the origin in kg m^2/s,
    /// without those of what it carries.
    pub fn momentum(&self) -> (Vector3<f64>, Vector3<f64>) {
        let linear = self.mass * self.velocity;
        (linear, self.position.cross(&linear) + self.spin())
    }

    /// Returns the angular momentum about the centre of mass in kg m^2/s.
    fn spin(&self) -> Vector3<f64> {
        self.rotation * (self.inertia * (self.rotation.inverse() * self.angular_velocity))
    }

    /// World position of a point given in body axes from the centre of mass.
    pub fn point(&self, local: &Vector3<f64>) -> Vector3<f64> {
        self.position + self.rotation * local
    }
}
