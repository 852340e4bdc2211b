//! Attachments are entities.

use super::bench::{bodies, cube, height, pin, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::{AttachmentEnded, AttachmentFailed, End};
use lariat_bevy::{
    At, Attachment, AttachmentReading, Bending, Body, BreakForce, Cable, CableAttachments, Cables, Error,
    KinematicTarget, ToBody,
};

/// A crate on a cable: cable, crate, and the two attachments.
fn hanging(world: &mut World) -> (Entity, Entity, Entity, Entity) {
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Bending)).id();
    let top = world.spawn(pin(cable)).id();
    let hook = world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    (cable, load, top, hook)
}

fn ended(world: &mut World) -> Vec<AttachmentEnded> {
    world.resource_mut::<Messages<AttachmentEnded>>().drain().collect()
}

#[test]
fn a_despawned_body_ends_its_attachment_and_the_cable_goes_on() {
    let mut world = world();
    let (cable, load, top, hook) = hanging(&mut world);
    steps(&mut world, 30);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    world.despawn(load);
    steps(&mut world, 30);
    assert_eq!(ended(&mut world), [AttachmentEnded { entity: hook, cable, body: Some(load), end: End::BodyGone }]);
    assert!(world.get_entity(hook).is_err() && world.get_entity(top).is_ok());
    assert_eq!(world.resource::<Cables>().attachments(), 1);
    assert_eq!(bodies(&world), 1); // the one that stands for the world
    let cable = world.get::<Cable>(cable).unwrap();
    assert!((cable.core().unwrap().time() - 1.0).abs() < 1e-5 && cable.positions().iter().all(|x| x.is_finite()));
}

#[test]
fn a_despawned_cable_takes_its_attachments_and_lets_the_body_fall() {
    let mut world = world();
    let (cable, load, top, hook) = hanging(&mut world);
    steps(&mut world, 30);
    world.despawn(cable);
    assert!(world.get_entity(hook).is_err() && world.get_entity(top).is_err());
    steps(&mut world, 31);
    assert!(height(&world, load) < -3.2, "{}", height(&world, load));
    assert_eq!(world.resource::<Cables>().attachments(), 0);
    assert!(ended(&mut world).is_empty());
}

#[test]
fn a_despawned_attachment_lets_go() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    steps(&mut world, 30);
    world.despawn(hook);
    steps(&mut world, 31);
    assert!(height(&world, load) < -3.2);
    assert_eq!(world.get::<CableAttachments>(cable).unwrap().iter().count(), 1);
    assert!(world.get_entity(load).is_ok());
}

#[test]
fn a_relationship_that_is_removed_lets_go_and_the_entity_stays() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    steps(&mut world, 30);
    world.entity_mut(hook).remove::<ToBody>();
    steps(&mut world, 30);
    assert_eq!(ended(&mut world), [AttachmentEnded { entity: hook, cable, body: Some(load), end: End::Released }]);
    assert!(height(&world, load) < -3.0);
    world.entity_mut(hook).insert(ToBody(load));
    steps(&mut world, 60);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
}

/// From a crate to another 1 m away: the gap closes, and the other one hangs.
#[test]
fn an_attachment_that_is_retargeted_stays_finite_and_holds_the_other_body() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    let other = world.spawn(cube(0.1, 5.0, [1.0, -1.6, 0.0])).id();
    let floor =
        Body::fixed().at([1.0, -1.8, 0.0]).with(lariat_bevy::rapier::prelude::ColliderBuilder::cuboid(0.5, 0.1, 0.5));
    world.spawn(floor);
    steps(&mut world, 30);
    world.entity_mut(hook).insert(ToBody(other));
    for _ in 0..60 {
        steps(&mut world, 1);
        assert!(world.get::<Cable>(cable).unwrap().positions().iter().all(|x| x.is_finite()));
    }
    assert!(height(&world, load) < -4.0);
    let reading = world.get::<AttachmentReading>(hook).unwrap();
    assert!(reading.gap < 1e-3, "{}", reading.gap);
    assert!(ended(&mut world).is_empty());
}

#[test]
fn an_attachment_breaks_at_its_force() {
    let mut world = world();
    let (cable, load, top, hook) = hanging(&mut world);
    world.entity_mut(hook).insert(BreakForce(40.0)); // the crate weighs 49 N
    world.entity_mut(top).insert(BreakForce(1e4));
    steps(&mut world, 60);
    assert_eq!(ended(&mut world), [AttachmentEnded { entity: hook, cable, body: Some(load), end: End::Broken }]);
    assert!(world.get_entity(hook).is_err() && height(&world, load) < -3.0);
    assert!(world.get_entity(top).is_ok());
}

#[test]
fn what_cannot_be_held_says_so_once_and_is_tried_again_when_it_changes() {
    let mut world = world();
    let (cable, load, _, _) = hanging(&mut world);
    let rock = world.spawn_empty().id();
    let lost = world.spawn(Attachment::ball(cable, 1.0).to(rock)).id();
    let off = world.spawn(Attachment::ball(cable, 7.0).to(load)).id();
    let no_cable = world.spawn(Attachment::ball(rock, At::Start).to(load)).id();
    steps(&mut world, 5);
    let told: Vec<AttachmentFailed> = world.resource_mut::<Messages<AttachmentFailed>>().drain().collect();
    assert_eq!(told.len(), 3);
    let of = |entity: Entity| told.iter().find(|t| t.entity == entity).map(|t| &t.error).unwrap();
    assert_eq!(of(lost), &Error::NotABody(rock));
    assert!(of(off).to_string().contains('7'), "{}", of(off));
    assert_eq!(of(no_cable), &Error::NotACable(rock));
    world.entity_mut(lost).insert(ToBody(load));
    steps(&mut world, 5);
    assert_eq!(world.resource::<Cables>().attachments(), 3);
}

#[test]
fn a_cable_that_is_replaced_takes_over_the_attachments() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    steps(&mut world, 30);
    world.entity_mut(cable).insert(soft([0.0; 3], [0.0, -2.0, 0.0]).elements(4));
    steps(&mut world, 60);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    assert!((height(&world, load) + 2.1).abs() < 1e-2, "{}", height(&world, load));
    assert!(world.get_entity(hook).is_ok());
    assert_eq!(world.get::<Cable>(cable).unwrap().positions().len(), 30);
}

#[test]
fn a_body_that_is_replaced_is_held_on() {
    let mut world = world();
    let (_, load, _, _) = hanging(&mut world);
    steps(&mut world, 30);
    world.entity_mut(load).insert(cube(0.1, 9.0, [0.0, -2.1, 0.0]));
    steps(&mut world, 120);
    assert_eq!(bodies(&world), 2 + ledgers(&world));
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    assert!((height(&world, load) + 2.1).abs() < 1e-2, "{}", height(&world, load));
}

fn ledgers(world: &World) -> usize {
    world.resource::<lariat_bevy::Physics>().bodies.iter().filter(|(_, b)| b.mass() > 1e8).count()
}

/// A boom that rises with 0.5 m/s lifts its load; a kinematic body moves by its target.
#[test]
fn a_kinematic_body_carries_its_cable() {
    let mut world = world();
    let boom = world.spawn(Body::kinematic().at([0.0, 0.0, 0.0])).id();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Bending)).id();
    world.spawn(Attachment::ball(cable, At::Start).to(boom).at([0.0, 0.0, 0.0]));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    for k in 1..=120 {
        world.entity_mut(boom).insert(KinematicTarget::at([0.0, 0.5 * f64::from(k) / 60.0, 0.0]));
        steps(&mut world, 1);
    }
    assert!((height(&world, boom) - 1.0).abs() < 1e-5);
    assert!((height(&world, load) + 1.1).abs() < 2e-2, "{}", height(&world, load));
}
