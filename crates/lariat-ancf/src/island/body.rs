//! A rigid body of an island.
//!
//! # Equation
//!
//! `m x'' = f`, `I omega' + omega x I omega = tau` about the centre of mass, f and tau constant
//! over a step, in world axes. With a carried inertia C (6x6, symmetric, constant over a step) the
//! left side is `(diag(m, I) + C) (x'', omega')`: the inertia of the bodies of a mechanism that
//! move with this one.
//!
//! # References
//!
//! Khatib 1987, the operational space inertia.

use crate::error::{Error, require, require_finite};
use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};
use serde::{Deserialize, Serialize};

/// Accelerations of a body at the end of a step, in m/s^2 and rad/s^2 in world axes, and what they
/// depend on. Plain data, part of a snapshot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyMemory {
    pub(super) acceleration: [Vector3<f64>; 2],
    pub(super) algorithmic: Option<[Vector3<f64>; 2]>,
    pub(super) force: Vector3<f64>,
    pub(super) torque: Vector3<f64>,
    pub(super) mass: f64,
    pub(super) inertia: Matrix3<f64>,
    pub(super) free: [bool; 6],
    pub(super) pins: usize,
    /// The last step of the discrete gradient, if that was the method.
    #[serde(default)]
    pub(super) differences: Option<BodyDifferences>,
}

impl BodyMemory {
    /// Returns the memory of a step of the discrete gradient, which knows no accelerations.
    pub(super) fn of_differences(body: &RigidBody, differences: BodyDifferences) -> Self {
        BodyMemory {
            acceleration: [Vector3::zeros(); 2],
            algorithmic: None,
            force: body.force,
            torque: body.torque,
            mass: body.mass,
            inertia: body.inertia,
            free: body.free,
            pins: 0,
            differences: Some(differences),
        }
    }
}

/// What a body carries to the next step of the [discrete
/// gradient](crate::integrate::discrete_gradient). Plain data.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct BodyDifferences {
    /// Changes of velocity in world axes and of angular velocity in body axes.
    pub change: [Vector3<f64>; 2],
    /// Length of the step in s.
    pub step: f64,
    /// Dissipation a of its formula.
    #[serde(default = "crate::one_leg::of_games")]
    pub dissipation: f64,
    /// Velocity and angular velocity at its end, in world axes.
    pub velocity: [Vector3<f64>; 2],
    /// Attitude at its end.
    pub rotation: UnitQuaternion<f64>,
}

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
    /// World axes along which forces move the body (x, y, z) and about which torques rotate it (x,
    /// y, z); along and about the others it keeps its velocity. All false: a driven body.
    pub free: [bool; 6],
    /// Inertia of the bodies that move with it, beyond its own, about its centre of mass in world
    /// axes: velocity before angular velocity (kg, kg m, kg m^2). Default: none.
    pub carried: Option<Matrix6<f64>>,
    /// Part of `torque` in N m, in world axes, that turns with the body, as does the carried
    /// inertia under the [discrete gradient](crate::integrate::discrete_gradient). Default: zero.
    pub turning_torque: Vector3<f64>,
    /// Attitude of the body at which what turns with it is as given: `carried`, `turning_torque`,
    /// and the [inertia](super::CoupledInertia) that couples it. Default: the present one.
    pub carried_at: Option<UnitQuaternion<f64>>,
    /// Whether the gyroscopic torque -omega x I omega acts (some engines omit it). Default: true.
    pub gyroscopic: bool,
    /// Accelerations that integrators carry from step to step; `None` if the state is not the
    /// result of a step.
    pub memory: Option<BodyMemory>,
    /// Of a driven body, which moves by the uniform velocities above on the average: what its
    /// velocity and angular velocity exceed them by at the beginning and at the end of the step, in
    /// m/s and rad/s. The pins follow cubics between them. Default: zero.
    pub unsteadiness: [[Vector3<f64>; 2]; 2],
    /// In [statics](super::equilibrium), forces of constant direction that act at points of the
    /// body, beside `force` and `torque`, which are through the centre of mass and constant: their
    /// torque turns with it. Default: none.
    pub at_points: Option<PointForces>,
}

/// Forces of constant direction at points of a body, R its attitude: `sum F`, and `A = sum p F^T`
/// of the points p from the centre of mass, in body axes. Their torque is the axial vector of `R
/// A`, their work from the unturned attitude its trace.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointForces {
    /// Sum of the forces in N, in world axes.
    pub(super) force: Vector3<f64>,
    moment: Matrix3<f64>,
}

impl PointForces {
    /// Adds a force in N, in world axes, at a point in m from the centre of mass, in body axes.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers that are not finite.
    pub fn add(&mut self, point: &Vector3<f64>, force: &Vector3<f64>) -> Result<(), Error> {
        require_finite("point of a force (m)", point)?;
        require_finite("force on a body (N)", force)?;
        self.force += force;
        self.moment += point * force.transpose();
        Ok(())
    }

    /// Returns the torque in N m at an attitude.
    pub(super) fn torque(&self, rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
        let b = rotation.to_rotation_matrix() * self.moment;
        Vector3::new(b[(1, 2)] - b[(2, 1)], b[(2, 0)] - b[(0, 2)], b[(0, 1)] - b[(1, 0)])
    }

    /// Returns the derivative of the torque by a rotation, symmetrised, with the sign of a
    /// stiffness.
    pub(super) fn stiffness(&self, rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
        let b = rotation.to_rotation_matrix() * self.moment;
        Matrix3::from_diagonal_element(b.trace()) - (b + b.transpose()) * 0.5
    }

    /// Returns the work in J of turning with the body, up to a constant.
    pub(super) fn work(&self, rotation: &UnitQuaternion<f64>) -> f64 {
        (rotation.to_rotation_matrix() * self.moment).trace()
    }
}

impl RigidBody {
    /// Returns a free body at rest, without force.
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
            turning_torque: Vector3::zeros(),
            carried_at: None,
            gyroscopic: true,
            memory: None,
            unsteadiness: Default::default(),
            at_points: None,
        })
    }

    /// Returns a massless point that joins cables.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a position that is not finite.
    pub fn junction(position: Vector3<f64>) -> Result<Self, Error> {
        let mut body = RigidBody::new(1.0, Matrix3::identity(), position)?;
        (body.mass, body.inertia) = (0.0, Matrix3::zeros());
        body.free = [true, true, true, false, false, false];
        Ok(body)
    }

    /// Moves it rigidly, with what it remembers of its last step: turned about the origin, then
    /// displaced by `by` (m). Forces stay as they are.
    pub fn move_by(&mut self, turn: &UnitQuaternion<f64>, by: &Vector3<f64>) {
        (self.position, self.rotation) = (turn * self.position + by, turn * self.rotation);
        (self.velocity, self.angular_velocity) = (turn * self.velocity, turn * self.angular_velocity);
        let Some(memory) = &mut self.memory else { return };
        memory.acceleration = memory.acceleration.map(|a| turn * a);
        memory.algorithmic = memory.algorithmic.map(|both| both.map(|a| turn * a));
        if let Some(last) = &mut memory.differences {
            // the change of the angular velocity is in body axes
            last.change[0] = turn * last.change[0];
            last.velocity = last.velocity.map(|v| turn * v);
            last.rotation = turn * last.rotation;
        }
    }

    /// Returns whether it is driven: forces neither move nor rotate it.
    pub(super) fn is_driven(&self) -> bool {
        self.free == [false; 6]
    }

    /// Returns whether its motion, loads and inertia are those with which its last step ended, by
    /// the discrete gradient; always of a driven body at rest.
    pub(super) fn is_as_after_last_step(&self) -> bool {
        if self.is_driven() && !self.moves() {
            return true;
        }
        let Some(memory) = &self.memory else { return false };
        let loads = memory.force == self.force && memory.torque == self.torque;
        let inertia = memory.mass == self.mass && memory.inertia == self.inertia && memory.free == self.free;
        let motion = memory.differences.is_some_and(|last| {
            last.velocity == [self.velocity, self.angular_velocity] && last.rotation == self.rotation
        });
        loads && inertia && motion
    }

    /// Returns whether it moves when the step begins, or is prescribed to.
    pub(super) fn moves(&self) -> bool {
        let rates = [[self.velocity, self.angular_velocity], self.unsteadiness[0], self.unsteadiness[1]];
        rates.as_flattened().iter().any(|rate| *rate != Vector3::zeros())
    }

    /// Returns the inertia about the centre of mass in world axes, at attitude `rotation`.
    pub fn world_inertia(&self, rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
        let r = rotation.to_rotation_matrix();
        r * self.inertia * r.transpose()
    }

    /// Returns the attitude at which what turns with it is as given.
    pub(super) fn attitude_of_carried(&self) -> UnitQuaternion<f64> {
        self.carried_at.unwrap_or(self.rotation)
    }

    /// Returns momentum and angular momentum about the centre of mass of the carried inertia, at
    /// velocity `v` and angular velocity `spin`.
    pub(super) fn carried_momentum(
        &self,
        v: &Vector3<f64>,
        spin: &Vector3<f64>,
    ) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let carried = self.carried?;
        let p = carried * Vector6::new(v.x, v.y, v.z, spin.x, spin.y, spin.z);
        Some((p.fixed_rows::<3>(0).into_owned(), p.fixed_rows::<3>(3).into_owned()))
    }

    /// Returns the kinetic energy in J, without that of the carried inertia.
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * (self.mass * self.velocity.norm_squared() + self.angular_velocity.dot(&self.spin()))
    }

    /// Returns the energy in J that the method `discrete-gradient` holds beyond the kinetic energy,
    /// as [`Cable::energy_in_store`](crate::coupling::Coupling::energy_in_store); without that of
    /// the carried inertia.
    pub fn energy_in_store(&self) -> f64 {
        let Some(last) = self.memory.as_ref().and_then(|memory| memory.differences.as_ref()) else { return 0.0 };
        let [velocity, spin] = last.change;
        0.5 * last.dissipation * (self.mass * velocity.norm_squared() + spin.dot(&(self.inertia * spin)))
    }

    /// Returns the linear momentum in kg m/s and the angular momentum about the origin in kg m^2/s,
    /// without those of the carried inertia.
    pub fn momentum(&self) -> (Vector3<f64>, Vector3<f64>) {
        let linear = self.mass * self.velocity;
        (linear, self.position.cross(&linear) + self.spin())
    }

    /// Returns the angular momentum about the centre of mass in kg m^2/s.
    fn spin(&self) -> Vector3<f64> {
        self.rotation * (self.inertia * (self.rotation.inverse() * self.angular_velocity))
    }

    /// Returns the world position of a point given in body axes from the centre of mass.
    pub fn point(&self, local: &Vector3<f64>) -> Vector3<f64> {
        self.position + self.rotation * local
    }
}
