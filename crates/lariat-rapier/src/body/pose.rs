//! Positions and attitudes of bodies, how they are rounded, and how far Rapier rotates a body in a
//! step.

use crate::convert::{rotation, vector};
use ::nalgebra::{UnitQuaternion, Vector3};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Position of the origin of a body in m, and its attitude.
pub(crate) type OriginPose = (Vector3<f64>, UnitQuaternion<f64>);

/// Returns the largest rounding of a coordinate in a step of this many substeps, as a share of it:
/// half a unit in the last place in each, and two for the way from the centre of mass to the origin
/// and back.
pub(crate) fn rounding(substeps: usize) -> f64 {
    (0.5 * substeps as f64 + 2.0) * f64::from(Real::EPSILON)
}

/// Returns the pose of a body.
pub(crate) fn pose(world: &PhysicsWorld, body: RigidBodyHandle) -> OriginPose {
    let body = &world.bodies[body];
    (vector(body.translation()), rotation(*body.rotation()))
}
