//! Worlds, cables and bodies that the tests share.

use bevy_ecs::prelude::*;
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{At, Attachment, Body, BodyPose, Cable, CableStep, Cables, Physics, ToWorldBundle, lariat_ancf};

/// A world with host steps of 1/60 s.
pub fn world() -> World {
    let mut world = World::new();
    lariat_bevy::install(&mut world);
    world
}

/// A round cable of 1 cm, 1e9 Pa, 4000 kg/m^3.
pub fn soft(from: [f64; 3], to: [f64; 3]) -> Cable {
    Cable::round(0.01, 1e9, 4000.0).between(from, to)
}

/// A cube with this half of a side (m) and mass (kg).
pub fn cube(half: f32, mass: f32, at: [f64; 3]) -> Body {
    Body::dynamic().at(at).with(ColliderBuilder::cuboid(half, half, half).mass(mass))
}

/// Attaches the start of a cable to the world.
pub fn pin(cable: Entity) -> ToWorldBundle {
    Attachment::ball(cable, At::Start).to_world()
}

pub fn steps(world: &mut World, count: usize) {
    for _ in 0..count {
        world.run_schedule(CableStep);
    }
}

pub fn cable_of(world: &World, entity: Entity) -> &lariat_ancf::Cable {
    world.resource::<Cables>().get(entity).unwrap()
}

/// All bits of a cable's coordinates and velocities.
pub fn bits(world: &World, cable: Entity) -> Vec<u64> {
    let cable = cable_of(world, cable);
    cable.positions().iter().chain(cable.velocities()).map(|x| x.to_bits()).collect()
}

pub fn height(world: &World, body: Entity) -> f64 {
    world.get::<BodyPose>(body).unwrap().position.y
}

/// The number of enabled bodies: all but the mark by which a set knows its world.
pub fn bodies(world: &World) -> usize {
    world.resource::<Physics>().bodies.iter().filter(|(_, body)| body.is_enabled()).count()
}
