//! Which bodies a body is near, and which it will run into.
//!
//! Rapier lists a pair of colliders once their boxes, as they were when its last step began, come within its prediction distance. A body
//! that flies farther than that in a step meets others before they are listed: its box, swept along its way, is looked up among all others.

use crate::convert::{to_vector, vector};
use ::nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{Aabb, BoundingVolume, Collider, ColliderHandle, ContactPair};
use rapier::math::Real;
use rapier::pipeline::{PhysicsWorld, QueryFilter};

/// Whether a body is near another. Rapier keeps the pairs of a collider that was removed until its next step.
pub(crate) fn touches(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    pairs(world, handle).next().is_some()
}

/// The pairs of the colliders of a body: its own collider, the other, the pair.
fn pairs<'a>(
    world: &'a PhysicsWorld,
    handle: RigidBodyHandle,
) -> impl Iterator<Item = (&'a Collider, &'a Collider, &'a ContactPair)> {
    let of = |c: &'a ColliderHandle| world.narrow_phase.contact_pairs_with(*c).map(move |pair| (*c, pair));
    world.bodies[handle].colliders().iter().flat_map(of).filter_map(|(own, pair)| {
        let other = if pair.collider1 == own { pair.collider2 } else { pair.collider1 };
        Some((world.colliders.get(own)?, world.colliders.get(other)?, pair))
    })
}

/// A box that is swept along `way` (m), and loosened by `by` (m) on all sides.
fn swept(aabb: Aabb, way: &Vector3<f64>, by: f64) -> Aabb {
    let way = to_vector(way);
    let there = Aabb::new(aabb.mins + way, aabb.maxs + way);
    Aabb::new(aabb.mins.min(there.mins), aabb.maxs.max(there.maxs)).loosened(by as Real)
}

/// A bound of the speed in m/s at which a body that moves along `way` (m) within `dt` (s) may run into one that Rapier lists no pair with
/// yet; none if it meets none. No other is faster than `fastest` (m/s): a slow body among slow ones meets none but listed ones, and nothing
/// is looked up.
pub(crate) fn runs_into(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    way: &Vector3<f64>,
    dt: f64,
    fastest: f64,
) -> Option<f64> {
    let listed = f64::from(world.integration_parameters.prediction_distance());
    let others = dt * fastest;
    // pairs are as old as a step
    if 2.0 * (way.norm() + others) <= listed {
        return None;
    }
    let colliders = world.bodies[handle].colliders().iter().filter_map(|c| world.colliders.get(*c));
    let meets = colliders.filter(|c| c.is_enabled() && !c.is_sensor()).any(|collider| {
        let filter =
            QueryFilter::default().exclude_rigid_body(handle).exclude_sensors().groups(collider.collision_groups());
        let own = swept(collider.compute_aabb(), way, listed);
        let reached = own.loosened(others as Real);
        world
            .intersect_aabb_conservative(reached, filter)
            .any(|(_, other)| swept(other.compute_aabb(), &(velocity_of(world, other) * dt), 0.0).intersects(&own))
    });
    meets.then(|| way.norm() / dt + fastest)
}

/// Velocity in m/s of the body of a collider.
fn velocity_of(world: &PhysicsWorld, collider: &Collider) -> Vector3<f64> {
    collider.parent().and_then(|b| world.bodies.get(b)).map_or_else(Vector3::zeros, |b| vector(b.linvel()))
}

/// The speed in m/s at which a body may strike another within `dt` (s), if no other is faster than `fastest` (m/s); none if it meets none.
/// Of pairs in contact, the speed along the normal.
pub(crate) fn closing(world: &PhysicsWorld, handle: RigidBodyHandle, dt: f64, fastest: f64) -> Option<f64> {
    let velocity = vector(world.bodies[handle].linvel());
    let margin = f64::from(world.integration_parameters.prediction_distance());
    let met = pairs(world, handle).filter_map(|(own, other, pair)| {
        let relative = velocity - velocity_of(world, other);
        let normals = pair.manifolds().iter().filter(|m| !m.points.is_empty()).map(|m| vector(m.data.normal));
        let along = normals.map(|n| relative.dot(&n).abs()).reduce(f64::max);
        let reach = || swept(own.compute_aabb(), &(relative * dt), margin).intersects(&other.compute_aabb());
        along.or_else(|| reach().then(|| relative.norm()))
    });
    let listed = met.reduce(f64::max);
    let beyond = runs_into(world, handle, &(velocity * dt), dt, fastest);
    listed.into_iter().chain(beyond).reduce(f64::max)
}

/// The speed in m/s of the fastest body that is awake.
pub(crate) fn fastest(world: &PhysicsWorld) -> f64 {
    world.active_bodies().map(|(_, b)| f64::from(b.linvel().length())).fold(0.0, f64::max)
}
