//! Which bodies a body is near, and which it will collide with.
//!
//! Rapier lists a pair of colliders once their bounding boxes at the start of its last step came
//! within its prediction distance. A body that moves farther than that in a step meets others
//! before they are listed: its box, swept along its displacement, is looked up among all others.
//!
//! Boxes along the axes overlap long before bodies do: that of a long lever holds the loads below
//! it. Therefore the distance decides.

use crate::body::ledger::is_ledger;
use crate::convert::{to_vector, vector};
use crate::scales::body::{PREDICTION_DISTANCES, STEPS_AHEAD};
use ::nalgebra::Vector3;
use rapier::dynamics::{CoefficientCombineRule, RigidBodyHandle};
use rapier::geometry::{Aabb, BoundingVolume, Collider, ColliderHandle, ContactManifold, ContactPair};
use rapier::math::{AngVector, Real, Vector};
use rapier::parry::query::{contact, distance};
use rapier::pipeline::{PhysicsWorld, QueryFilter};

/// Returns whether a body may deviate from its prediction and must feel its cables meanwhile: it is
/// near another, a link of a multibody, or joined to a dynamic body.
///
/// Not one that is joined to a fixed body: Rapier's joint would yield to the motors and leave a gap
/// of 1e-2 m at 5 kN, where it leaves 4e-6 m without them.
pub(crate) fn may_deviate(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    is_near_another(world, handle) || is_linked(world, handle)
}

/// Returns whether a body is a link of a multibody, or joined to a dynamic body.
pub(crate) fn is_linked(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    let dynamic =
        |b: RigidBodyHandle| b != handle && world.bodies.get(b).is_some_and(|b| b.is_dynamic() && !is_ledger(b));
    world.multibody_joints.rigid_body_link(handle).is_some()
        || world.impulse_joints.attached_enabled_joints(handle).any(|(a, b, _, _)| dynamic(a) || dynamic(b))
}

/// Returns whether a body is near no other, and no joint holds it but that of a ledger.
pub(crate) fn is_isolated(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    is_unjointed(world, handle) && !may_deviate(world, handle)
}

/// Returns whether no joint holds a body but that of a ledger.
pub(crate) fn is_unjointed(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    let ledger = |b: RigidBodyHandle| world.bodies.get(b).is_some_and(is_ledger);
    let joined = |(a, b)| !ledger(a) && !ledger(b);
    world.multibody_joints.rigid_body_link(handle).is_none()
        && !world.impulse_joints.attached_joints(handle).any(|(a, b, _, _)| joined((a, b)))
}

/// Returns whether Rapier's next step may make contacts of a body with another, of those that it
/// lists pairs of. It keeps the pairs of a removed collider until then.
fn is_near_another(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    // contacts first: a body of a pile has some, and the distances of its other neighbours take
    // longer to find
    pairs(world, handle).any(|(_, _, pair)| touches(pair))
        || pairs(world, handle).any(|(own, other, _)| may_reach(world, own, other))
}

/// Returns whether a pair has points of contact.
fn touches(pair: &ContactPair) -> bool {
    pair.manifolds().iter().any(|m| !m.points.is_empty())
}

/// Returns whether a pair that Rapier lists may touch in its next step or, at twice the present
/// velocities, in the one after it: the reaction of a body that chatters is expected again.
pub(crate) fn may_touch(world: &PhysicsWorld, one: &Collider, two: &Collider, pair: &ContactPair) -> bool {
    touches(pair) || may_reach(world, one, two)
}

/// Returns whether two colliders without points of contact may touch, as [`may_touch`].
fn may_reach(world: &PhysicsWorld, one: &Collider, two: &Collider) -> bool {
    let dt = f64::from(world.integration_parameters.dt);
    let linear = (velocity_of(world, one) - velocity_of(world, two)).norm() * dt;
    reaches(world, one, two, STEPS_AHEAD * (linear + turn(world, one, dt) + turn(world, two, dt)))
}

/// Returns whether two colliders that come closer by `way` (m) may touch: within twice the distance
/// at which Rapier makes contacts.
fn reaches(world: &PhysicsWorld, one: &Collider, two: &Collider, way: f64) -> bool {
    let body = |c: &Collider| c.parent().and_then(|b| world.bodies.get(b));
    let sweeps = |c: &Collider| body(c).is_some_and(|b| b.is_ccd_enabled() || b.soft_ccd_prediction() > 0.0);
    let skins = f64::from(one.contact_skin() + two.contact_skin());
    let listed = PREDICTION_DISTANCES * f64::from(world.integration_parameters.prediction_distance()) + skins;
    let within = |found: Real| f64::from(found) <= way + listed;
    // the distance of the boxes along the axes is a lower bound
    let boxes = [one, two].map(Collider::compute_aabb);
    let gap = (boxes[0].mins - boxes[1].maxs).max(boxes[1].mins - boxes[0].maxs).max(Vector::ZERO).length();
    sweeps(one)
        || sweeps(two)
        || within(gap)
            && distance(one.position(), one.shape(), two.position(), two.shape())
                .map_or(true, |found| within(found.distance))
}

/// Returns by how much a point of a collider rotates at most within `dt` (s), in m: of a half-space
/// that does not rotate by nothing, although its box has no end.
fn turn(world: &PhysicsWorld, collider: &Collider, dt: f64) -> f64 {
    let body = collider.parent().and_then(|b| world.bodies.get(b));
    body.filter(|body| body.angvel() != AngVector::default()).map_or(0.0, |body| {
        let sphere = collider.compute_aabb().bounding_sphere();
        let radius = (sphere.center() - body.center_of_mass()).length() + sphere.radius();
        f64::from(body.angvel().length() * radius) * dt
    })
}

/// Returns the listed pairs of the colliders of a body: its own collider, the other, the pair.
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

/// Returns a bounding box swept along `displacement` (m), and enlarged by `margin` (m) on all
/// sides.
fn swept(aabb: Aabb, displacement: &Vector3<f64>, margin: f64) -> Aabb {
    let displacement = to_vector(displacement);
    let moved = Aabb::new(aabb.mins + displacement, aabb.maxs + displacement);
    Aabb::new(aabb.mins.min(moved.mins), aabb.maxs.max(moved.maxs)).loosened(margin as Real)
}

/// Returns whether the box of a body, swept along `displacement` (m), overlaps that of another. It
/// needs no list of Rapier's, which has none before its first step, and asks all colliders.
pub(crate) fn overlaps(world: &PhysicsWorld, handle: RigidBodyHandle, displacement: &Vector3<f64>) -> bool {
    let margin = f64::from(world.integration_parameters.prediction_distance());
    let solid = |c: &Collider| c.is_enabled() && !c.is_sensor();
    let own = world.bodies[handle].colliders().iter().filter_map(|c| world.colliders.get(*c)).filter(|c| solid(c));
    let mut boxes = own.map(|c| swept(c.compute_aabb(), displacement, margin));
    boxes.any(|own| {
        let mut others = world.colliders.iter().map(|(_, c)| c).filter(|c| solid(c) && c.parent() != Some(handle));
        others.any(|c| c.compute_aabb().intersects(&own))
    })
}

/// Returns whether a body may collide within `dt` (s) with one that Rapier may list no pair with
/// yet, if no other is faster than `fastest` (m/s).
pub(crate) fn may_collide(world: &PhysicsWorld, handle: RigidBodyHandle, (dt, fastest): (f64, f64)) -> bool {
    within_reach(world, handle, (dt, fastest)).next().is_some()
}

/// Returns the colliders of a body and of others that may touch within `dt` (s), whether Rapier
/// lists them or not. Slow bodies among slow ones need no look-up.
fn within_reach(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    (dt, fastest): (f64, f64),
) -> impl Iterator<Item = (&Collider, &Collider)> {
    let velocity = vector(world.bodies[handle].linvel());
    let displacement = velocity * dt;
    let listed = f64::from(world.integration_parameters.prediction_distance());
    let others = dt * fastest;
    // the list of pairs may be one step old
    let slow = STEPS_AHEAD * (displacement.norm() + others) <= listed;
    let handles = if slow { &[] } else { world.bodies[handle].colliders() };
    let colliders = handles.iter().filter_map(|c| world.colliders.get(*c)).filter(|c| c.is_enabled() && !c.is_sensor());
    colliders.flat_map(move |collider| {
        let filter =
            QueryFilter::default().exclude_rigid_body(handle).exclude_sensors().groups(collider.collision_groups());
        let swept_own = swept(collider.compute_aabb(), &displacement, listed);
        let reached = swept_own.loosened(others as Real);
        world.intersect_aabb_conservative(reached, filter).filter_map(move |(_, other)| {
            let moved = velocity_of(world, other) * dt;
            let way = || (displacement - moved).norm() + turn(world, collider, dt) + turn(world, other, dt);
            let meets = swept(other.compute_aabb(), &moved, 0.0).intersects(&swept_own)
                && reaches(world, collider, other, way());
            meets.then_some((collider, other))
        })
    })
}

/// Returns the velocity in m/s of the body of a collider.
fn velocity_of(world: &PhysicsWorld, collider: &Collider) -> Vector3<f64> {
    collider.parent().and_then(|b| world.bodies.get(b)).map_or_else(Vector3::zeros, |b| vector(b.linvel()))
}

/// Calls `f` for each contact that a body has, or may have within `dt` (s), if no other body is
/// faster than `fastest` (m/s): with the speed in m/s at which they collide at most, along the
/// normal where they touch, and the direction in which it pushes, `None` if that is not known or
/// friction pushes in others.
pub(crate) fn for_each_push(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    (dt, fastest): (f64, f64),
    mut f: impl FnMut(f64, &dyn Fn() -> Option<Vector3<f64>>),
) {
    let velocity = vector(world.bodies[handle].linvel());
    let margin = f64::from(world.integration_parameters.prediction_distance());
    let slips = |one: &Collider, two: &Collider| {
        let rules = (one.friction_combine_rule(), two.friction_combine_rule());
        CoefficientCombineRule::combine(one.friction(), two.friction(), rules.0, rules.1) == 0.0
    };
    for (own, other, pair) in pairs(world, handle) {
        let relative = velocity - velocity_of(world, other);
        for manifold in pair.manifolds().iter().filter(|m| !m.points.is_empty()) {
            let normal = vector(manifold.data.normal);
            f(closing_speed(world, pair, manifold), &|| slips(own, other).then_some(normal));
        }
        let way = || relative.norm() * dt + turn(world, own, dt) + turn(world, other, dt);
        if !touches(pair)
            && swept(own.compute_aabb(), &(relative * dt), margin).intersects(&other.compute_aabb())
            && reaches(world, own, other, way())
        {
            let speed = relative.norm() + turn(world, own, 1.0) + turn(world, other, 1.0);
            f(speed, &|| slips(own, other).then(|| direction(own, other)).flatten());
        }
    }
    for (own, other) in within_reach(world, handle, (dt, fastest)) {
        f(velocity.norm() + fastest, &|| slips(own, other).then(|| direction(own, other)).flatten());
    }
}

/// Returns the direction from the nearest point of a collider to that of another.
fn direction(own: &Collider, other: &Collider) -> Option<Vector3<f64>> {
    let nearest = contact(own.position(), own.shape(), other.position(), other.shape(), Real::MAX);
    nearest.ok().flatten().map(|c| vector(c.normal1)).filter(|n| n.iter().all(|x| x.is_finite()))
}

/// Returns the speed in m/s at which a body may collide with another within `dt` (s), if no other
/// is faster than `fastest` (m/s); `None` if it cannot. Of pairs in contact it is the speed of
/// their points along the normal, of others an upper bound of that of any of their points.
pub(crate) fn collision(world: &PhysicsWorld, handle: RigidBodyHandle, within: (f64, f64)) -> Option<f64> {
    let mut speed: Option<f64> = None;
    for_each_push(world, handle, within, |push, _| speed = Some(speed.unwrap_or(0.0).max(push)));
    speed
}

/// Returns the largest relative speed in m/s along the normal at the points of a manifold of a
/// pair; 0 if one of its colliders is gone.
fn closing_speed(world: &PhysicsWorld, pair: &ContactPair, manifold: &ContactManifold) -> f64 {
    let [one, two] = [pair.collider1, pair.collider2].map(|handle| world.colliders.get(handle));
    let (Some(one), Some(two)) = (one, two) else { return 0.0 };
    let velocity = |c: &Collider, at: Vector| {
        let body = c.parent().and_then(|b| world.bodies.get(b));
        body.map_or_else(Vector3::zeros, |body| vector(body.velocity_at_point(at)))
    };
    let normal = vector(manifold.data.normal);
    let speeds = manifold.points.iter().map(|point| {
        let at = one.position() * point.local_p1;
        (velocity(one, at) - velocity(two, at)).dot(&normal).abs()
    });
    speeds.fold(0.0, f64::max)
}

/// Returns the speed in m/s of the fastest body that is awake.
pub(crate) fn fastest(world: &PhysicsWorld) -> f64 {
    world.active_bodies().map(|(_, b)| f64::from(b.linvel().length())).fold(0.0, f64::max)
}
