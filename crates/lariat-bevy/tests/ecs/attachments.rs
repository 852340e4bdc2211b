//! Attachments: made, replaced, released, broken.

use super::common::{bodies, cable_of, cube, height, pin, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::{AttachmentEnded, AttachmentFailed, EndReason};
use lariat_bevy::{
    At, Attachment, AttachmentReading, Bending, Body, BodyHandle, BreakForce, CableAttachments, Cables, Error, Gap,
    KinematicTarget, Physics, ToBody, lariat_ancf, lariat_rapier,
};
use lariat_rapier::rapier::math::Pose;

/// A crate on a cable: cable, crate, and the two attachments.
fn hanging(world: &mut World) -> (Entity, Entity, Entity, Entity) {
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Bending)).id();
    let top = world.spawn(pin(cable)).id();
    let hook = world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    (cable, load, top, hook)
}

#[derive(Resource, Default)]
struct Observed(Vec<AttachmentEnded>);

fn ended(world: &mut World) -> Vec<AttachmentEnded> {
    world.resource_mut::<Messages<AttachmentEnded>>().drain().collect()
}

#[test]
fn a_despawned_body_ends_its_attachment_and_frees_the_cable() {
    let mut world = world();
    let (cable, load, top, hook) = hanging(&mut world);
    steps(&mut world, 30);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    world.despawn(load);
    steps(&mut world, 30);
    assert_eq!(
        ended(&mut world),
        [AttachmentEnded { entity: hook, cable, body: Some(load), reason: EndReason::BodyGone }]
    );
    assert!(world.get_entity(hook).is_err() && world.get_entity(top).is_ok());
    assert_eq!(world.resource::<Cables>().attachments(), 1);
    assert_eq!(bodies(&world), 1); // the one that represents the world
    let cable = cable_of(&world, cable);
    assert!((cable.time() - 1.0).abs() < 1e-5 && cable.positions().iter().all(|x| x.is_finite()));
}

#[test]
fn a_despawned_cable_despawns_its_attachments_and_releases_the_body() {
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
fn a_despawned_attachment_releases_the_body() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    steps(&mut world, 30);
    world.add_observer(|event: On<AttachmentEnded>, mut observed: ResMut<Observed>| observed.0.push(event.clone()));
    world.init_resource::<Observed>();
    world.despawn(hook);
    steps(&mut world, 31);
    let event = AttachmentEnded { entity: hook, cable, body: Some(load), reason: EndReason::Released };
    assert_eq!(ended(&mut world), std::slice::from_ref(&event));
    assert_eq!(world.resource::<Observed>().0, [event]);
    assert!(height(&world, load) < -3.2);
    assert_eq!(world.get::<CableAttachments>(cable).unwrap().iter().count(), 1);
    assert!(world.get_entity(load).is_ok());
}

#[test]
fn removing_the_body_relationship_releases_the_body_and_keeps_the_entity() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    steps(&mut world, 30);
    world.entity_mut(hook).remove::<ToBody>();
    steps(&mut world, 30);
    assert_eq!(
        ended(&mut world),
        [AttachmentEnded { entity: hook, cable, body: Some(load), reason: EndReason::Released }]
    );
    assert!(height(&world, load) < -3.0);
    world.get_mut::<Attachment>(hook).unwrap().gap = Gap::Close;
    world.entity_mut(hook).insert(ToBody(load));
    steps(&mut world, 60);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
}

/// From a crate to another 1 m away: the gap closes, and the other one hangs.
#[test]
fn a_retargeted_attachment_closes_the_gap_to_the_other_body() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    let other = world.spawn(cube(0.1, 5.0, [1.0, -1.6, 0.0])).id();
    let floor =
        Body::fixed().at([1.0, -1.8, 0.0]).with(lariat_bevy::rapier::prelude::ColliderBuilder::cuboid(0.5, 0.1, 0.5));
    world.spawn(floor);
    steps(&mut world, 30);
    // refused first: the load falls, and the cable is free there
    world.entity_mut(hook).insert(ToBody(other));
    steps(&mut world, 2);
    let failures: Vec<AttachmentFailed> = world.resource_mut::<Messages<AttachmentFailed>>().drain().collect();
    let [AttachmentFailed { entity, error: Error::Coupling(lariat_rapier::Error::GapTooLong { gap, .. }) }] =
        failures[..]
    else {
        panic!("{failures:?}");
    };
    assert!(entity == hook && (gap - 1.0).abs() < 0.2, "{gap} m");
    world.get_mut::<Attachment>(hook).unwrap().gap = Gap::Close;
    for _ in 0..60 {
        steps(&mut world, 1);
        assert!(cable_of(&world, cable).positions().iter().all(|x| x.is_finite()));
    }
    assert!(height(&world, load) < -4.0);
    let reading = world.get::<AttachmentReading>(hook).unwrap();
    assert!(reading.gap.norm() < 1e-3, "{}", reading.gap);
    assert!(ended(&mut world).is_empty());
}

#[test]
fn an_attachment_breaks_when_its_force_exceeds_the_limit() {
    let mut world = world();
    let (cable, load, top, hook) = hanging(&mut world);
    world.entity_mut(hook).insert(BreakForce(40.0)); // the crate weighs 49 N
    world.entity_mut(top).insert(BreakForce(1e4));
    steps(&mut world, 60);
    assert_eq!(
        ended(&mut world),
        [AttachmentEnded { entity: hook, cable, body: Some(load), reason: EndReason::Broken }]
    );
    assert!(world.get_entity(hook).is_err() && height(&world, load) < -3.0);
    assert!(world.get_entity(top).is_ok());
}

#[test]
fn an_impossible_attachment_fails_once_and_is_retried_when_it_changes() {
    let mut world = world();
    let (cable, load, _, _) = hanging(&mut world);
    let rock = world.spawn_empty().id();
    let lost = world.spawn(Attachment::ball(cable, 1.0).to(rock)).id();
    let off = world.spawn(Attachment::ball(cable, 7.0).to(load)).id();
    let no_cable = world.spawn(Attachment::ball(rock, At::Start).to(load)).id();
    steps(&mut world, 5);
    let failures: Vec<AttachmentFailed> = world.resource_mut::<Messages<AttachmentFailed>>().drain().collect();
    assert_eq!(failures.len(), 3);
    let of = |entity: Entity| failures.iter().find(|t| t.entity == entity).map(|t| &t.error).unwrap();
    assert_eq!(of(lost), &Error::NotABody(rock));
    let out_of_range = lariat_rapier::Error::Cable(lariat_ancf::Error::OutOfRange {
        cable: "cable".to_string(),
        what: "arc length",
        value: 7.0,
        limit: 2.0,
    });
    assert_eq!(of(off), &Error::Coupling(out_of_range));
    assert_eq!(of(no_cable), &Error::NotACable(rock));
    world.entity_mut(lost).insert(ToBody(load));
    steps(&mut world, 5);
    assert_eq!(world.resource::<Cables>().attachments(), 3);
}

#[test]
fn attachments_pass_to_a_cable_that_replaces_another() {
    let mut world = world();
    let (cable, load, _, hook) = hanging(&mut world);
    world.get_mut::<Attachment>(hook).unwrap().gap = Gap::Close;
    steps(&mut world, 30);
    world.entity_mut(cable).insert(soft([0.0; 3], [0.0, -2.0, 0.0]).elements(4));
    steps(&mut world, 60);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    assert!((height(&world, load) + 2.1).abs() < 1e-2, "{}", height(&world, load));
    assert!(world.get_entity(hook).is_ok());
    assert_eq!(cable_of(&world, cable).positions().len(), 30);
}

#[test]
fn attachments_pass_to_a_body_that_replaces_another() {
    let mut world = world();
    let (_, load, _, hook) = hanging(&mut world);
    world.get_mut::<Attachment>(hook).unwrap().gap = Gap::Close;
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

/// A boom that rises with 0.5 m/s lifts its load.
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

/// A crate that still bounces on its cable is put to rest, where the stretch by its weight has it; with a body that holds the cable it is then
/// moved by a metre, and hangs on as it did.
///
/// *Source.* delta = (W + w/2) L/EA with a cable of 0.63 kg and 78.5 kN; a rigid motion.
#[test]
fn a_crate_is_put_to_rest_and_moved_with_its_cable() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let beam = world.spawn(Body::fixed().at([0.0, 0.0, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Bending)).id();
    world.spawn(Attachment::ball(cable, At::Start).to(beam));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 3);
    let handle = |world: &World, entity: Entity| world.get::<BodyHandle>(entity).unwrap().handle();
    let both = [handle(&world, beam), handle(&world, load)];
    world.resource_scope(|world: &mut World, mut cables: Mut<Cables>| {
        let mut physics = world.resource_mut::<Physics>();
        assert!(cables.equilibrium(&mut physics).unwrap().is_stable());
        let mass = 2.0 * 4000.0 * core::f64::consts::FRAC_PI_4 * 1e-4;
        let stretch = (5.0 + 0.5 * mass) * 9.81 * 2.0 / (1e9 * core::f64::consts::FRAC_PI_4 * 1e-4);
        let rest = f64::from(physics.bodies[both[1]].translation().y);
        assert!((rest + 2.1 + stretch).abs() < 1e-5, "{rest} m");
        cables.move_bodies(&mut physics, &both, &Pose::translation(1.0, 0.5, 0.0)).unwrap();
    });
    let before = height(&world, load) + 0.5;
    steps(&mut world, 60);
    assert!((height(&world, load) - before).abs() < 5e-3 && cable_of(&world, cable).time() > 1.0);
    assert!((cable_of(&world, cable).node_position(0).x - 1.0).abs() < 1e-6);
}
