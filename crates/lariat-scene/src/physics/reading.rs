//! State of bodies, in `f64` from the single precision of Rapier.

use lariat_ancf::Vector3;
use lariat_rapier::convert::{rotation, vector};
use lariat_rapier::rapier::prelude::RigidBody;
use nalgebra::UnitQuaternion;

/// Position and velocity of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BodyState {
    /// Origin in m.
    pub position: Vector3<f64>,
    /// Rotation.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of the origin in m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity in rad/s, world axes.
    pub angular_velocity: Vector3<f64>,
}

/// Returns the state of a body.
pub fn state(body: &RigidBody) -> BodyState {
    let (position, spin) = (vector(body.translation()), vector(body.angvel()));
    let arm = position - vector(body.center_of_mass());
    BodyState {
        position,
        rotation: rotation(*body.rotation()),
        velocity: vector(body.linvel()) + spin.cross(&arm),
        angular_velocity: spin,
    }
}
