//! The generalised velocity of a multibody, of which Rapier makes the velocities of its links.

use crate::body::spatial::split_spatial;
use crate::convert::to_vector;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Gives the bodies of a link's multibody the velocities of its generalised velocity; does nothing
/// for other bodies.
pub(crate) fn refresh(world: &mut PhysicsWorld, handle: RigidBodyHandle) {
    let Some(link) = world.multibody_joints.rigid_body_link(handle) else { return };
    let Some(multibody) = world.multibody_joints.get_multibody(link.multibody) else { return };
    for id in 0..multibody.num_links() {
        let (Some(link), jacobian) = (multibody.link(id), multibody.body_jacobian(id)) else { continue };
        let Some(body) = world.bodies.get_mut(link.rigid_body_handle()) else { continue };
        if jacobian.ncols() == multibody.ndofs() && body.is_dynamic() {
            let v = jacobian * multibody.generalized_velocity();
            let (linear, angular) = split_spatial(&v.map(f64::from));
            body.set_linvel(to_vector(&linear), false);
            body.set_angvel(to_vector(&angular), false);
        }
    }
}

/// Edits the components of the generalised velocity of a link's multibody with `values`, and
/// refreshes its bodies.
pub(super) fn edit_velocity<T>(
    world: &mut PhysicsWorld,
    handle: RigidBodyHandle,
    values: impl Iterator<Item = T>,
    edit: impl Fn(&mut Real, T),
) {
    let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else { return };
    if let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) {
        multibody.generalized_velocity_mut().iter_mut().zip(values).for_each(|(u, value)| edit(u, value));
    }
    refresh(world, handle);
}
