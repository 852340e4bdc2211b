//! Bodies in water, by a resource and a component.

use super::common::{height, steps, world};
use bevy_ecs::prelude::*;
use lariat_ancf::{Surface, Vector3, Water};
use lariat_bevy::event::WaterFailed;
use lariat_bevy::rapier::prelude::{ColliderBuilder, RigidBodyBuilder};
use lariat_bevy::{Body, Cables, InWater, Physics, Sea, Snapshot, lariat_ancf};

fn sea(density: f64) -> Sea {
    Sea(Water::new(density).with_surface(Surface::at(0.0, Vector3::new(0.0, -9.81, 0.0))))
}

/// A ball of half the density of water.
fn ball() -> Body {
    Body::new(RigidBodyBuilder::dynamic()).with(ColliderBuilder::ball(0.2).density(500.0))
}

/// *Source.* Archimedes: half of the ball is below; in twice as dense water a float rises; in air it falls with its own mass.
#[test]
fn a_body_floats_rises_and_falls_as_sea_and_component_change() {
    let mut world = world();
    world.insert_resource(sea(1000.0));
    let float = world.spawn((ball(), InWater::with_drag_area([0.06; 3]).with_added_mass(0.5))).id();
    steps(&mut world, 900);
    assert!(height(&world, float).abs() < 0.01, "{}", height(&world, float));
    world.resource_mut::<Sea>().0 = sea(2000.0).0;
    steps(&mut world, 900);
    assert!(height(&world, float) > 0.05, "{}", height(&world, float));
    world.entity_mut(float).remove::<InWater>();
    let before = height(&world, float);
    steps(&mut world, 60);
    let mass = 500.0 * 4.0 / 3.0 * core::f64::consts::PI * 0.2f64.powi(3);
    let rigid = world.resource::<Physics>().bodies.iter().find(|(_, body)| body.is_dynamic()).unwrap().1.mass();
    assert!((f64::from(rigid) / mass - 1.0).abs() < 1e-4, "{rigid} of {mass}");
    assert!((before - height(&world, float) - 0.5 * 9.81).abs() < 0.1);
    world.remove_resource::<Sea>();
    steps(&mut world, 1);
    assert!(world.resource::<Cables>().set().water().is_none());
}

/// Saves a world with a float, and checks that it goes on from there as it did.
fn floats_on_to_the_bit(float: InWater) {
    let mut world = world();
    world.insert_resource(sea(1000.0));
    let float = world.spawn((ball(), float)).id();
    steps(&mut world, 20);
    let saved = Snapshot::take(&mut world).unwrap();
    steps(&mut world, 20);
    let first = height(&world, float).to_bits();
    saved.restore(&mut world).unwrap();
    steps(&mut world, 20);
    assert_eq!(height(&world, float).to_bits(), first);
}

#[test]
fn a_restored_world_floats_on_to_the_bit() {
    floats_on_to_the_bit(InWater::with_drag_area([0.06; 3]).with_added_mass(0.5));
}

/// Added mass by axes is saved and read, and one number stands for three; a copy goes on as the original.
#[test]
fn added_mass_by_axes_is_saved_and_read() {
    let float = InWater::with_drag_area([0.06; 3]).with_added_mass_along([0.1, 0.9, 0.4]);
    let written = serde_json::to_string(&float).unwrap();
    assert_eq!(serde_json::from_str::<InWater>(&written).unwrap(), float);
    let read: InWater = serde_json::from_str(r#"{"added_mass": 0.5}"#).unwrap();
    assert_eq!(read, InWater::default().with_added_mass(0.5));
    floats_on_to_the_bit(float);
}

#[test]
fn what_cannot_be_in_water_is_an_event_once() {
    let mut world = world();
    world.insert_resource(sea(1000.0));
    let wall = Body::new(RigidBodyBuilder::fixed()).with(ColliderBuilder::ball(0.2));
    let wall = world.spawn((wall, InWater::default())).id();
    let mut told = Vec::new();
    for _ in 0..10 {
        steps(&mut world, 1);
        told.extend(world.resource_mut::<Messages<WaterFailed>>().drain());
    }
    assert_eq!(told.iter().map(|failed| failed.entity).collect::<Vec<_>>(), [wall]);
    world.resource_mut::<Sea>().0.density = 0.0;
    steps(&mut world, 1);
    assert_eq!(world.resource_mut::<Messages<WaterFailed>>().drain().count(), 1);
}
