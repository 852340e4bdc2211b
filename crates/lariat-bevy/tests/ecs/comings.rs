//! Cables that come late, are copied, overwritten, or disabled.

use super::bench::{bits, cube, height, pin, soft, steps, world};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use lariat_bevy::{At, Attachment, Bending, Cable, Cables, Diagnostics, Snapshot};

fn time(world: &World, cable: Entity) -> f64 {
    world.get::<Cable>(cable).unwrap().core().unwrap().time()
}

/// A regression: a cable that came later had a clock of its own, and an island of two times is refused.
#[test]
fn a_cable_that_comes_later_holds_the_same_body() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -1.1, 0.0])).id();
    let first = world.spawn((soft([0.0; 3], [0.0, -1.0, 0.0]), Bending)).id();
    world.spawn(pin(first));
    world.spawn(Attachment::ball(first, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 60);
    let second = world.spawn((soft([0.5, 0.0, 0.0], [0.1, -1.1, 0.0]), Bending)).id();
    world.spawn(pin(second));
    world.spawn(Attachment::ball(second, At::End).to(load).at([0.1, 0.0, 0.0]));
    steps(&mut world, 30);
    assert_eq!(world.resource::<Diagnostics>().refused_steps, 0);
    assert_eq!(time(&world, first), time(&world, second));
    assert!((time(&world, first) - 1.5).abs() < 1e-5);
}

/// A regression: the mechanics of a cable that was overwritten in place were lost, and every step refused.
#[test]
fn a_cable_that_is_overwritten_in_place_is_built_anew_and_held_on() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -1.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -1.0, 0.0]), Bending)).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 30);
    *world.get_mut::<Cable>(cable).unwrap() = soft([0.0; 3], [0.0, -1.0, 0.0]).elements(3);
    steps(&mut world, 60);
    assert_eq!(world.resource::<Diagnostics>().refused_steps, 0);
    assert_eq!(world.get::<Cable>(cable).unwrap().positions().len(), 24);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    assert!((height(&world, load) + 1.1).abs() < 1e-2, "{}", height(&world, load));
}

#[test]
fn the_copy_of_a_cable_is_a_cable_of_its_own() {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [1.0, 0.0, 0.0]), Bending)).id();
    steps(&mut world, 10);
    let copy = world.get::<Cable>(cable).unwrap().clone();
    let copy = world.spawn((copy, Bending)).id();
    world.despawn(cable);
    steps(&mut world, 10);
    assert_eq!(world.resource::<Diagnostics>().refused_steps, 0);
    assert!((time(&world, copy) - 20.0 / 60.0).abs() < 1e-6);
}

#[test]
fn a_disabled_entity_keeps_its_cable_going() {
    let mut world = world();
    let cable = world.spawn(soft([0.0; 3], [1.0, 0.0, 0.0])).id();
    let other = world.spawn(soft([0.0; 3], [1.0, 0.0, 1.0])).id();
    steps(&mut world, 10);
    world.entity_mut(cable).insert(Disabled);
    steps(&mut world, 10);
    assert_eq!(world.resource::<Diagnostics>().refused_steps, 0);
    assert_eq!(time(&world, cable), time(&world, other));
}

/// A regression: what was despawned and not taken in yet was missing from a snapshot, and every step after it refused.
#[test]
fn a_snapshot_between_a_despawning_and_a_step_holds() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -1.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -1.0, 0.0]), Bending)).id();
    let other = world.spawn((soft([2.0, 0.0, 0.0], [3.0, 0.0, 0.0]), Bending)).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 10);
    world.despawn(cable);
    world.despawn(load);
    let snapshot = Snapshot::take(&mut world).unwrap();
    steps(&mut world, 10);
    let then = bits(&world, other);
    snapshot.restore(&mut world).unwrap();
    steps(&mut world, 10);
    assert_eq!(world.resource::<Diagnostics>().refused_steps, 0);
    assert!(bits(&world, other) == then);
    assert_eq!(world.resource::<Cables>().attachments(), 0);
}
