//! Worlds to test in.

use bevy_ecs::prelude::*;
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{At, Attachment, Body, BodyPose, Cable, CableStep, Physics, ToWorldBundle};

/// A world with cables, at 1/60 s.
pub fn world() -> World {
    let mut world = World::new();
    lariat_bevy::install(&mut world);
    world
}

/// 1 cm round, 1e9 Pa, 4000 kg/m^3.
pub fn soft(from: [f64; 3], to: [f64; 3]) -> Cable {
    Cable::round(0.01, 1e9, 4000.0).between(from, to)
}

/// A cube of this half side (m) and mass (kg).
pub fn cube(half: f32, mass: f32, at: [f64; 3]) -> Body {
    Body::dynamic().at(at).with(ColliderBuilder::cuboid(half, half, half).mass(mass))
}

pub fn pin(cable: Entity) -> ToWorldBundle {
    Attachment::ball(cable, At::Start).to_world()
}

pub fn steps(world: &mut World, count: usize) {
    for _ in 0..count {
        world.run_schedule(CableStep);
    }
}

/// All bits of a cable's coordinates.
pub fn bits(world: &World, cable: Entity) -> Vec<u64> {
    let cable = world.get::<Cable>(cable).unwrap();
    cable.positions().iter().chain(cable.velocities()).map(|x| x.to_bits()).collect()
}

pub fn height(world: &World, body: Entity) -> f64 {
    world.get::<BodyPose>(body).unwrap().position.y
}

pub fn bodies(world: &World) -> usize {
    world.resource::<Physics>().bodies.len()
}
