//! State, energy and momentum of bodies, in `f64` from the single precision of Rapier.

use super::convert::{matrix, rotation, vector};
use lariat_ancf::{Momentum, Vector3};
use lariat_rapier::rapier::prelude::RigidBody;
use nalgebra::UnitQuaternion;

/// Position and velocity of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// Returns mass in kg, and angular momentum about the centre of mass in kg m^2/s.
fn spin_momentum(body: &RigidBody) -> (f64, Vector3<f64>) {
    let properties = body.mass_properties();
    let (local, to_world) = (&properties.local_mprops, rotation(*body.rotation()));
    let spin = to_world.inverse() * vector(body.angvel());
    let mass = if local.inv_mass > 0.0 { 1.0 / f64::from(local.inv_mass) } else { 0.0 };
    // a body without inertia does not rotate
    let rotates = local.inv_principal_inertia != lariat_rapier::rapier::math::AngVector::ZERO;
    let about = if rotates { matrix(&local.reconstruct_inertia_matrix()) * spin } else { Vector3::zeros() };
    (mass, to_world * about)
}

/// Returns kinetic energy and potential energy in gravity (zero at the origin), in J.
pub fn energy(body: &RigidBody, gravity: &Vector3<f64>) -> (f64, f64) {
    let (mass, spin) = spin_momentum(body);
    let velocity = vector(body.linvel());
    let kinetic = 0.5 * (mass * velocity.norm_squared() + spin.dot(&vector(body.angvel())));
    (kinetic, -mass * gravity.dot(&vector(body.center_of_mass())))
}

pub fn momentum(body: &RigidBody) -> Momentum {
    let (mass, spin) = spin_momentum(body);
    let linear = vector(body.linvel()) * mass;
    Momentum { linear, angular: vector(body.center_of_mass()).cross(&linear) + spin }
}
