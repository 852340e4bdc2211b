//! The settings of a body that a step changes and restores.

use rapier::dynamics::RigidBody as RapierBody;
use rapier::math::{AngVector, Real, Vector};

/// Velocities, forces and settings of a body that a step replaces and restores.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SavedBody {
    linvel: Vector,
    angvel: AngVector,
    user_force: Vector,
    user_torque: AngVector,
    gyroscopic: bool,
    fast_rotation: bool,
    linear_damping: Real,
    angular_damping: Real,
}

impl SavedBody {
    /// Saves a body.
    pub fn of(body: &RapierBody) -> Self {
        SavedBody {
            linvel: body.linvel(),
            angvel: body.angvel(),
            user_force: body.user_force(),
            user_torque: body.user_torque(),
            gyroscopic: body.gyroscopic_forces_enabled(),
            fast_rotation: body.is_fast_rotation_allowed(),
            linear_damping: body.linear_damping(),
            angular_damping: body.angular_damping(),
        }
    }

    /// Restores the user's forces and the settings.
    pub fn restore_settings(&self, body: &mut RapierBody) {
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(self.user_force, false);
        body.add_torque(self.user_torque, false);
        body.enable_gyroscopic_forces(self.gyroscopic);
        body.set_allow_fast_rotation(self.fast_rotation);
        body.set_linear_damping(self.linear_damping);
        body.set_angular_damping(self.angular_damping);
    }

    /// Returns the factors by which Rapier's damping multiplies velocity and angular velocity in
    /// `h` (s).
    pub fn damping_factors(&self, h: f64) -> (f64, f64) {
        let factor = |damping: Real| 1.0 / (1.0 + h * f64::from(damping));
        (factor(self.linear_damping), factor(self.angular_damping))
    }

    /// Restores the velocities.
    pub fn restore_velocities(&self, body: &mut RapierBody) {
        body.set_linvel(self.linvel, false);
        body.set_angvel(self.angvel, false);
    }
}

/// Replaces all forces and torques on a body by `force` and `torque`, and disables its damping.
pub(crate) fn replace_loads(body: &mut RapierBody, force: Vector, torque: AngVector) {
    body.reset_forces(false);
    body.reset_torques(false);
    body.add_force(force, false);
    body.add_torque(torque, false);
    body.set_linear_damping(0.0);
    body.set_angular_damping(0.0);
}
