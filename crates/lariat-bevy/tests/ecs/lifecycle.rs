//! Cables that are spawned early or late, cloned, replaced, or disabled.

use super::common::{bits, cable_of, cube, height, pin, soft, steps, world};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use lariat_bevy::lariat_ancf::Vector3;
use lariat_bevy::{At, Attachment, Bending, BodyPose, Cable, Cables, Diagnostics, Snapshot, install};
use std::collections::BTreeMap;

fn time(world: &World, cable: Entity) -> f64 {
    cable_of(world, cable).time()
}

/// A regression: a cable that was spawned later had a clock of its own, and an island with two
/// times cannot be stepped.
#[test]
fn a_cable_that_is_spawned_later_can_be_attached_to_the_same_body() {
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
    assert_eq!(world.resource::<Diagnostics>().failed_steps, 0);
    assert_eq!(time(&world, first), time(&world, second));
    assert!((time(&world, first) - 1.5).abs() < 1e-5);
}

/// *Source.* The description.
#[test]
fn a_body_has_its_pose_before_the_first_step() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -1.1, 2.0]).velocity([0.0, 0.0, 3.0])).id();
    let pose = *world.get::<BodyPose>(load).unwrap();
    assert!((pose.position - Vector3::new(0.0, -1.1, 2.0)).norm() < 1e-6 && pose.velocity.z == 3.0, "{pose:?}");
    assert_eq!(pose.between(0.0).0, pose.position);
}

#[test]
fn a_description_inserted_over_another_rebuilds_the_cable() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -1.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -1.0, 0.0]), Bending)).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]).gap(lariat_bevy::Gap::Close));
    steps(&mut world, 30);
    world.entity_mut(cable).insert(soft([0.0; 3], [0.0, -1.0, 0.0]).elements(3));
    steps(&mut world, 60);
    assert_eq!(world.resource::<Diagnostics>().failed_steps, 0);
    assert_eq!(cable_of(&world, cable).positions().len(), 24);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    assert!((height(&world, load) + 1.1).abs() < 1e-2, "{}", height(&world, load));
}

#[test]
fn a_clone_of_the_component_is_a_new_cable_in_its_initial_state() {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [1.0, 0.0, 0.0]), Bending)).id();
    let initial = bits(&world, cable);
    steps(&mut world, 10);
    let clone = world.get::<Cable>(cable).unwrap().clone();
    let clone = world.spawn((clone, Bending)).id();
    assert!(bits(&world, clone) == initial && bits(&world, cable) != initial);
    world.despawn(cable);
    steps(&mut world, 10);
    assert_eq!(world.resource::<Diagnostics>().failed_steps, 0);
    assert!((time(&world, clone) - 20.0 / 60.0).abs() < 1e-6);
}

#[test]
fn a_cable_that_is_spawned_before_installation_is_built_in_the_first_step() {
    let mut world = World::new();
    let cable = world.spawn((soft([0.0; 3], [1.0, 0.0, 0.0]), Bending)).id();
    install(&mut world);
    assert!(world.resource::<Cables>().get(cable).is_err());
    steps(&mut world, 10);
    assert!((time(&world, cable) - 10.0 / 60.0).abs() < 1e-6);
}

#[test]
fn cables_follow_components_that_change_while_the_resource_is_taken_out() {
    let mut world = world();
    let [gone, replaced] = [0.0, 1.0].map(|z| world.spawn((soft([0.0, 0.0, z], [1.0, 0.0, z]), Bending)).id());
    world.spawn(pin(gone));
    world.spawn(pin(replaced));
    steps(&mut world, 5);
    let new = world.resource_scope(|world, _: Mut<Cables>| {
        world.despawn(gone);
        world.entity_mut(replaced).insert(soft([0.0, 0.0, 1.0], [1.0, 0.0, 1.0]).elements(3));
        world.spawn(soft([0.0, 0.0, 2.0], [1.0, 0.0, 2.0])).id()
    });
    steps(&mut world, 5);
    let cables = world.resource::<Cables>();
    let elements: BTreeMap<Entity, usize> =
        cables.iter().map(|(entity, cable)| (entity, cable.elements().len())).collect();
    assert_eq!(elements, [(replaced, 3), (new, 10)].into());
    assert_eq!(world.resource::<Cables>().attachments(), 1);
}

#[test]
fn the_cable_of_a_disabled_entity_is_stepped() {
    let mut world = world();
    let cable = world.spawn(soft([0.0; 3], [1.0, 0.0, 0.0])).id();
    let other = world.spawn(soft([0.0; 3], [1.0, 0.0, 1.0])).id();
    steps(&mut world, 10);
    world.entity_mut(cable).insert(Disabled);
    steps(&mut world, 10);
    assert_eq!(world.resource::<Diagnostics>().failed_steps, 0);
    assert_eq!(time(&world, cable), time(&world, other));
}

/// A regression: removals that no step had carried out yet were missing from a snapshot, and every
/// step after it failed.
#[test]
fn a_snapshot_taken_between_despawning_and_a_step_replays_bitwise() {
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
    assert_eq!(world.resource::<Diagnostics>().failed_steps, 0);
    assert!(bits(&world, other) == then);
    assert_eq!(world.resource::<Cables>().attachments(), 0);
}
