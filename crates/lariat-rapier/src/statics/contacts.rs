//! Contacts of bodies that are moved to their place, which statics do not compute: where they were
//! drawn, where they are found, and on the straight way between.

use super::joints::keep_apart;
use crate::error::Error;
use crate::scales::statics::TOUCH;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{BoundingVolume, Collider};
use rapier::math::{Pose, Real, Vector};
use rapier::parry::query::{ShapeCastOptions, cast_shapes, contact};
use rapier::parry::shape::Shape;
use rapier::pipeline::PhysicsWorld;

/// Rejects moved bodies that touch another where they were, on their way, or where they are to be.
/// Bodies at the poses that they have are looked at where they are.
pub(super) fn check_contacts(world: &PhysicsWorld, poses: &[(RigidBodyHandle, Pose)]) -> Result<(), Error> {
    let after = |c: &Collider| {
        let moved = c.parent().and_then(|parent| poses.iter().find(|(handle, _)| *handle == parent));
        match (moved, c.position_wrt_parent()) {
            (Some((_, pose)), Some(local)) => *pose * *local,
            _ => *c.position(),
        }
    };
    for_each_pair(world, poses.iter().map(|(handle, _)| *handle), |body, a, b| {
        let [one, two] = [a, b].map(|c| [place(world, c), after(c)]);
        let at = |i: usize| touch((&one[i], a.shape()), (&two[i], b.shape()));
        let way = |[from, to]: [Pose; 2]| to.translation - from.translation;
        if at(0) || at(1) || meets((&one[0], a.shape(), way(one)), (&two[0], b.shape(), way(two))) {
            return Err(Error::ContactInStatics { body, other: b.parent() });
        }
        Ok(())
    })
}

/// Calls `f` with each of some bodies, each of its colliders, and each collider of others that it
/// may touch.
pub(super) fn for_each_pair(
    world: &PhysicsWorld,
    bodies: impl Iterator<Item = RigidBodyHandle>,
    mut f: impl FnMut(RigidBodyHandle, &Collider, &Collider) -> Result<(), Error>,
) -> Result<(), Error> {
    let solid: Vec<&Collider> =
        world.colliders.iter().map(|(_, c)| c).filter(|c| c.is_enabled() && !c.is_sensor()).collect();
    for handle in bodies {
        let own = solid.iter().filter(|c| c.parent() == Some(handle));
        for (a, b) in own.flat_map(|a| solid.iter().map(move |b| (a, b))) {
            let joined = b.parent().is_some_and(|other| keep_apart(world, handle, other));
            if b.parent() == Some(handle) || joined || !a.collision_groups().test(b.collision_groups()) {
                continue;
            }
            f(handle, a, b)?;
        }
    }
    Ok(())
}

/// Returns where a collider is with its body, which the user may have moved since Rapier's last
/// step.
pub(super) fn place(world: &PhysicsWorld, collider: &Collider) -> Pose {
    match (collider.parent().and_then(|body| world.bodies.get(body)), collider.position_wrt_parent()) {
        (Some(body), Some(local)) => *body.position() * *local,
        _ => *collider.position(),
    }
}

/// Returns whether two shapes are within [`TOUCH`] of each other. Pairs that parry does not compare
/// cannot collide in Rapier either. A half-space is asked first: parry 0.31 takes the pose of a
/// second one for its inverse, and so finds it at a wrong distance.
fn touch(first: (&Pose, &dyn Shape), second: (&Pose, &dyn Shape)) -> bool {
    let near = first.1.compute_aabb(first.0).loosened(TOUCH as Real);
    if !near.intersects(&second.1.compute_aabb(second.0)) {
        return false;
    }
    let (first, second) = if second.1.as_halfspace().is_some() { (second, first) } else { (first, second) };
    contact(first.0, first.1, second.0, second.1, TOUCH as Real).is_ok_and(|found| found.is_some())
}

/// Returns whether two shapes meet that go straight, by a way (m) each, without turning.
pub(super) fn meets(first: (&Pose, &dyn Shape, Vector), second: (&Pose, &dyn Shape, Vector)) -> bool {
    let way = first.2 - second.2;
    if way == Vector::ZERO {
        return false;
    }
    let (from, other) = (first.1.compute_aabb(first.0), second.1.compute_aabb(second.0));
    if !from.merged(&from.translated(way)).intersects(&other) {
        return false;
    }
    let (first, second) = if second.1.as_halfspace().is_some() { (second, first) } else { (first, second) };
    let options = ShapeCastOptions { max_time_of_impact: 1.0, ..ShapeCastOptions::default() };
    cast_shapes(first.0, first.2, first.1, second.0, second.2, second.1, options).is_ok_and(|hit| hit.is_some())
}
