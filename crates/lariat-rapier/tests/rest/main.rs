//! Statics of cables and bodies under twist, in water, and in contact, and the runs that start from them.

mod centre;
mod half_space;
mod torsion;
mod touching;
mod water;

use lariat_rapier::CableSet;
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::Vector3;
use lariat_rapier::rapier::prelude::*;

const G: f64 = 9.81;

/// Steps for 10 s at 1/60 s, and returns how far in m the body goes from where it was, at most.
fn moves(world: &mut PhysicsWorld, set: &mut CableSet, body: RigidBodyHandle) -> f64 {
    let start = vector(world.bodies[body].translation());
    world.integration_parameters.dt = 1.0 / 60.0;
    let mut most = 0.0f64;
    for _ in 0..600 {
        set.step(world).unwrap();
        most = most.max((vector(world.bodies[body].translation()) - start).norm());
    }
    most
}

fn down(x: f64) -> Vector3<f64> {
    Vector3::new(0.0, -x, 0.0)
}
