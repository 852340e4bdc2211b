//! Snapshots restore a run bitwise.

use super::common::{bits, cable_of, cube, pin, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{
    At, Attachment, AttachmentReading, Bending, Body, BodyPose, Cables, Damping, Drag, Error, Physics, Snapshot,
};

/// A load that swings into a wall, on a cable with effects.
fn scene(world: &mut World) -> (Entity, Entity, Entity) {
    world.spawn(Body::fixed().at([0.0, -2.8, 0.0]).with(ColliderBuilder::cuboid(10.0, 0.5, 10.0)));
    world.spawn(Body::fixed().at([0.2, -1.6, 0.0]).with(ColliderBuilder::cuboid(0.1, 0.8, 1.0)));
    let load = world.spawn(cube(0.1, 20.0, [1.6, -0.1, 0.0])).id();
    let cable = soft([0.0; 3], [1.6, 0.0, 0.0]);
    let cable = world.spawn((cable, Bending, Damping::critical_fraction(0.05), Drag::air())).id();
    world.spawn(pin(cable));
    let hook = world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    (cable, load, hook)
}

#[test]
fn a_run_from_a_snapshot_replays_bitwise() {
    let mut world = world();
    let (cable, load, hook) = scene(&mut world);
    let state = |world: &World| {
        let pose = *world.get::<BodyPose>(load).unwrap();
        (bits(world, cable), pose, *world.get::<AttachmentReading>(hook).unwrap())
    };
    steps(&mut world, 25);
    let snapshot = Snapshot::take(&mut world).unwrap();
    let mut first = Vec::new();
    for _ in 0..50 {
        steps(&mut world, 1);
        first.push(state(&world));
    }
    for _ in 0..2 {
        assert!(snapshot.restore(&mut world).unwrap().is_empty());
        for then in &first {
            steps(&mut world, 1);
            assert!(*then == state(&world));
        }
    }
}

/// After the snapshot a load is despawned, an effect is removed, and a cable, a body and an
/// attachment are spawned.
#[test]
fn a_snapshot_respawns_what_was_despawned_and_despawns_what_was_spawned() {
    let mut world = world();
    let (cable, load, hook) = scene(&mut world);
    steps(&mut world, 25);
    let snapshot = Snapshot::take(&mut world).unwrap();
    steps(&mut world, 40);
    let then = bits(&world, cable);
    snapshot.restore(&mut world).unwrap();
    world.despawn(load);
    world.entity_mut(cable).remove::<Drag>();
    let new = world.spawn(soft([3.0, 0.0, 0.0], [4.0, 0.0, 0.0])).id();
    let body = world.spawn(cube(0.1, 1.0, [4.0, -0.1, 0.0])).id();
    world.spawn(Attachment::ball(new, At::End).to(body).at([0.0, 0.1, 0.0]));
    steps(&mut world, 10);
    assert!(world.get_entity(hook).is_err());
    let renamed = snapshot.restore(&mut world).unwrap();
    assert_eq!(renamed.len(), 2); // load and hook
    assert!(world.get_entity(new).is_err() && world.get_entity(body).is_err());
    assert!(world.get::<Drag>(cable).is_some());
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    steps(&mut world, 40);
    assert!(bits(&world, cable) == then);
    let load = renamed[&load];
    assert!(world.get::<BodyPose>(load).unwrap().position.y < -0.5);
    // a despawned cable is respawned too
    world.despawn(cable);
    steps(&mut world, 3);
    let renamed = snapshot.restore(&mut world).unwrap();
    steps(&mut world, 40);
    assert!(bits(&world, renamed[&cable]) == then);
}

#[test]
fn a_single_cable_can_be_restored_to_an_earlier_state() {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [1.6, 0.0, 0.0]), Bending)).id();
    steps(&mut world, 10);
    let earlier = cable_of(&world, cable).snapshot().clone();
    steps(&mut world, 10);
    let then = bits(&world, cable);
    world.resource_mut::<Cables>().get_mut(cable).unwrap().restore(earlier).unwrap();
    steps(&mut world, 10);
    assert!(bits(&world, cable) == then);
}

/// Another engine owns the bodies when `Physics` does not hold them: neither saved nor restored, and
/// nothing changes.
#[test]
fn a_snapshot_without_the_bodies_of_its_cables_is_refused() {
    let mut world = world();
    let (cable, ..) = scene(&mut world);
    steps(&mut world, 10);
    let snapshot = Snapshot::take(&mut world).unwrap();
    steps(&mut world, 10);
    let then = bits(&world, cable);
    let engine = core::mem::take(&mut world.resource_mut::<Physics>().0);
    assert!(matches!(Snapshot::take(&mut world), Err(Error::ForeignBodies { .. })));
    assert!(matches!(snapshot.restore(&mut world), Err(Error::ForeignBodies { .. })));
    assert!(bits(&world, cable) == then);
    world.resource_mut::<Physics>().0 = engine;
    snapshot.restore(&mut world).unwrap();
    steps(&mut world, 10);
    assert!(bits(&world, cable) == then);
}
