//! Damping that Rapier gives the joints of a multibody.

use ::nalgebra::DVector;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Damping by degree of freedom, in N s/m or N m s.
pub(super) type JointDamping = DVector<Real>;

/// Edits the damping of the joints of a link's multibody.
pub(super) fn edit_damping(world: &mut PhysicsWorld, handle: RigidBodyHandle, edit: impl Fn(&mut JointDamping)) {
    let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else { return };
    if let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) {
        edit(multibody.damping_mut());
    }
}
