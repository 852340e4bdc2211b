//! Bodies that no cable holds: whether something is below on which they would come to lie.
//!
//! # Equation
//! Each body of an island that nothing holds goes straight along what constantly acts on it: its
//! weight and the forces of the users. Those of one island fall together, and do not hold each
//! other.

use super::contacts::{for_each_pair, meets, place};
use super::solve::BodyForce;
use crate::convert::{to_vector, vector};
use crate::error::Error;
use crate::scales::statics::FALL;
use ::nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Vector;
use rapier::pipeline::PhysicsWorld;

/// Returns whether one of the `bodies` of an island would meet a collider of another body, or one
/// without a body.
pub(super) fn land(world: &PhysicsWorld, bodies: &[RigidBodyHandle], forces: &[BodyForce]) -> bool {
    let found = for_each_pair(world, bodies.iter().copied(), |body, own, other| {
        let beside = other.parent().is_none_or(|parent| !bodies.contains(&parent));
        let fall = (place(world, own), fall(world, body, forces));
        let met = beside && meets((&fall.0, own.shape(), fall.1), (&place(world, other), other.shape(), Vector::ZERO));
        if met { Err(Error::ContactInStatics { body, other: other.parent() }) } else { Ok(()) }
    });
    found.is_err()
}

/// Returns the way on which a body is looked for what it would fall on.
fn fall(world: &PhysicsWorld, handle: RigidBodyHandle, forces: &[BodyForce]) -> Vector {
    let Some(body) = world.bodies.get(handle) else { return Vector::ZERO };
    let weight = vector(world.gravity) * f64::from(body.mass() * body.gravity_scale());
    let of_users: Vector3<f64> = forces.iter().filter(|force| force.body == handle).map(|force| force.force).sum();
    let load = weight + vector(body.user_force()) + of_users;
    load.try_normalize(0.0).map_or(Vector::ZERO, |direction| to_vector(&(direction * FALL)))
}
