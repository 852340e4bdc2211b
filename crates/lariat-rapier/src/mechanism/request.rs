//! What the mechanism of a body is asked for with.

use ::nalgebra::Vector6;
use lariat_ancf::island::RigidBody;
use rapier::dynamics::RigidBodyHandle;

/// A body whose mechanism is wanted.
pub(crate) struct Request<'a> {
    pub handle: RigidBodyHandle,
    pub body: &'a RigidBody,
    /// Force in N and torque in N m on it over the step, those of its cables included; they decide
    /// which limits are active.
    pub load: Vector6<f64>,
    /// Rapier's substep in s.
    pub substep: f64,
    /// Tells whether a cable is attached to a body.
    pub is_attached: &'a dyn Fn(RigidBodyHandle) -> bool,
}
