//! Contacts of bodies that were moved to their place, which statics do not compute.

use super::joints::keep_apart;
use crate::error::Error;
use crate::scales::statics::TOUCH;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{BoundingVolume, Collider};
use rapier::math::{Pose, Real};
use rapier::parry::query::contact;
use rapier::parry::shape::Shape;
use rapier::pipeline::PhysicsWorld;

/// Rejects moved bodies that touch another, where they were or where they are to be.
pub(super) fn check_contacts(world: &PhysicsWorld, poses: &[(RigidBodyHandle, Pose)]) -> Result<(), Error> {
    let solid: Vec<&Collider> =
        world.colliders.iter().map(|(_, c)| c).filter(|c| c.is_enabled() && !c.is_sensor()).collect();
    let after = |c: &Collider| {
        let moved = c.parent().and_then(|parent| poses.iter().find(|(handle, _)| *handle == parent));
        match (moved, c.position_wrt_parent()) {
            (Some((_, pose)), Some(local)) => *pose * *local,
            _ => *c.position(),
        }
    };
    let before = |c: &Collider| match (c.parent().and_then(|b| world.bodies.get(b)), c.position_wrt_parent()) {
        (Some(body), Some(local)) => *body.position() * *local,
        _ => *c.position(),
    };
    for &(handle, _) in poses {
        let own = solid.iter().filter(|c| c.parent() == Some(handle));
        for (a, b) in own.flat_map(|a| solid.iter().map(move |b| (a, b))) {
            let joined = b.parent().is_some_and(|other| keep_apart(world, handle, other));
            if b.parent() == Some(handle) || joined || !a.collision_groups().test(b.collision_groups()) {
                continue;
            }
            for (at, to) in [(before(a), before(b)), (after(a), after(b))] {
                let near = a.shape().compute_aabb(&at).loosened(TOUCH as Real);
                if near.intersects(&b.shape().compute_aabb(&to)) && touch((&at, a.shape()), (&to, b.shape())) {
                    return Err(Error::ContactInStatics { body: handle, other: b.parent() });
                }
            }
        }
    }
    Ok(())
}

/// Returns whether two shapes are within [`TOUCH`] of each other. Pairs that parry does not compare
/// cannot collide in Rapier either. A half-space is asked first: parry 0.31 takes the pose of a
/// second one for its inverse, and so finds it at a wrong distance.
fn touch(first: (&Pose, &dyn Shape), second: (&Pose, &dyn Shape)) -> bool {
    let (first, second) = if second.1.as_halfspace().is_some() { (second, first) } else { (first, second) };
    contact(first.0, first.1, second.0, second.1, TOUCH as Real).is_ok_and(|found| found.is_some())
}
