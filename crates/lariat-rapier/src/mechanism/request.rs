//! What the mechanism of a body is asked for with.

use ::nalgebra::Vector6;
use rapier::dynamics::RigidBodyHandle;

/// A body whose mechanism is wanted.
pub(crate) struct Request<'a> {
    pub handle: RigidBodyHandle,
    /// Half of the step in s: after it, at the present motion, the mechanism is looked at.
    pub half_step: f64,
    /// Rapier's substep in s.
    pub substep: f64,
    /// How often Rapier goes through all joints in a substep.
    pub sweeps: usize,
    /// The bodies of its island, itself included, with force in N and torque in N m on each over
    /// the step, those of its cables included: they decide which limits are active.
    pub members: &'a [(RigidBodyHandle, Vector6<f64>)],
    /// Tells whether a cable is attached to a body.
    pub is_attached: &'a dyn Fn(RigidBodyHandle) -> bool,
}

impl Request<'_> {
    /// Returns whether a body is a member of the same island.
    pub fn is_member(&self, body: RigidBodyHandle) -> bool {
        self.members.iter().any(|(member, _)| *member == body)
    }
}
