//! Events, by observers and by messages.

use super::common::{bits, cable_of, cube, pin, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::{AttachmentEnded, CableAsleep, CableAwake, CableWarning, GapOpened, StepFailed};
use lariat_bevy::lariat_rapier::BodyQuantity;
use lariat_bevy::{
    At, Attachment, Bending, BodyPose, Cables, Damping, Diagnostics, Error, Physics, Settings, lariat_rapier,
};

#[derive(Resource, Default)]
struct Log(Vec<(&'static str, Entity)>);

/// A crate on a well damped rope comes to rest, sleeps, and wakes by an impulse.
#[test]
fn sleeping_and_waking_send_events() {
    let mut world = world();
    world.init_resource::<Log>();
    world.add_observer(|event: On<CableAsleep>, mut log: ResMut<Log>| log.0.push(("asleep", event.entity)));
    world.add_observer(|event: On<CableAwake>, mut log: ResMut<Log>| log.0.push(("awake", event.entity)));
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = soft([0.0; 3], [0.0, -2.0, 0.0]);
    let cable = world.spawn((cable, Bending, Damping::critical_fraction(1.0))).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 600);
    assert_eq!(world.resource::<Log>().0, [("asleep", cable)]);
    assert!(world.resource::<Cables>().is_asleep(cable));
    let handle = world.resource::<Physics>().bodies.iter().find(|(_, b)| b.mass() == 5.0).map(|(h, _)| h).unwrap();
    let push = lariat_bevy::rapier::prelude::Vector::new(5.0, 0.0, 0.0);
    world.resource_mut::<Physics>().bodies[handle].apply_impulse(push, true);
    steps(&mut world, 2);
    assert_eq!(world.resource::<Log>().0, [("asleep", cable), ("awake", cable)]);
}

/// Young's modulus in GPa, read as Pa: told once, to observers and as a message, and counted.
#[test]
fn a_warning_of_a_cable_is_an_event_once() {
    let mut world = world();
    world.init_resource::<Log>();
    world.add_observer(|event: On<CableWarning>, mut log: ResMut<Log>| log.0.push(("warning", event.entity)));
    let soft = lariat_bevy::Cable::round(0.01, 210.0, 1.0).between([0.0; 3], [0.0, -2.0, 0.0]);
    // what is told by the law of the paper is one of accuracy, which is counted and no event
    let cable = world.spawn((soft, Bending, lariat_bevy::AxialLaw::hooke())).id();
    let good = world.spawn(super::common::soft([5.0, 0.0, 0.0], [5.0, -2.0, 0.0])).id();
    world.spawn(pin(cable));
    world.spawn(pin(good));
    let mut messages: Vec<CableWarning> = Vec::new();
    for _ in 0..30 {
        steps(&mut world, 1);
        messages.extend(world.resource_mut::<Messages<CableWarning>>().drain());
    }
    let told = |warning: &CableWarning| warning.entity == cable && warning.warning.to_string().contains("in Pa");
    assert!(messages.iter().any(told), "{messages:?}");
    assert!(messages.iter().all(|warning| warning.entity == cable), "{messages:?}");
    assert_eq!(world.resource::<Log>().0.len(), messages.len());
    assert_eq!(world.resource::<Diagnostics>().cables.warnings, messages.len() as u64);
}

/// A heavy ball hits a crate on a rope, which cannot follow within a step that is divided no further: the attachment hears of its gap, once.
#[test]
fn a_gap_that_opens_triggers_observers() {
    let mut world = world();
    world.init_resource::<Log>();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Bending)).id();
    world.spawn(pin(cable));
    let hook = world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    world.entity_mut(hook).observe(move |event: On<GapOpened>, mut log: ResMut<Log>| {
        assert!(event.cable == cable && event.body == Some(load) && event.gap > 4e-3);
        log.0.push(("gap", event.entity));
    });
    steps(&mut world, 30);
    assert_eq!(world.resource::<Log>().0, []);
    let settings = world.resource::<Cables>().settings();
    world.resource_mut::<Cables>().set_settings(Settings { max_rapier_steps: 4, ..settings });
    world.spawn(cube(0.1, 50.0, [-1.0, -2.1, 0.0]).velocity([40.0, 0.0, 0.0]));
    steps(&mut world, 10);
    assert_eq!(world.resource::<Log>().0, [("gap", hook)]);
}

/// A body whose velocity is not a number: the step fails with the name of the cable, whose time
/// stands still, and goes on when the velocity is finite again. Another cable and a free body go on.
#[test]
fn a_failed_step_names_the_cable_and_keeps_the_last_good_state() {
    let mut world = world();
    world.init_resource::<Log>();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Name::new("sling"), Bending)).id();
    let other = world.spawn(soft([5.0, 0.0, 0.0], [6.0, 0.0, 0.0])).id();
    let free = world.spawn(cube(0.1, 1.0, [3.0, 0.0, 0.0])).id();
    world.entity_mut(cable).observe(|event: On<StepFailed>, mut log: ResMut<Log>| log.0.push(("sling", event.entity)));
    world.entity_mut(other).observe(|event: On<StepFailed>, mut log: ResMut<Log>| log.0.push(("other", event.entity)));
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 10);
    let handle = world.resource::<Physics>().bodies.iter().find(|(_, b)| b.mass() == 5.0).map(|(h, _)| h).unwrap();
    let before = bits(&world, cable);
    let good = world.resource::<Physics>().bodies[handle].linvel();
    let bad = lariat_bevy::rapier::prelude::Vector::new(f32::NAN, 0.0, 0.0);
    world.resource_mut::<Physics>().bodies[handle].set_linvel(bad, true);
    steps(&mut world, 3);
    assert_eq!(world.resource::<Log>().0, [("sling", cable); 3]);
    assert!(bits(&world, cable) == before);
    assert_eq!(world.resource::<Diagnostics>().failed_steps, 3);
    let failures: Vec<StepFailed> = world.resource_mut::<Messages<StepFailed>>().drain().collect();
    let Error::Coupling(lariat_rapier::Error::StepRefused { cables, cause, .. }) = &failures[0].error else {
        panic!("{}", failures[0].error);
    };
    assert_eq!(*cables, ["sling"]);
    let lariat_rapier::Error::BodyNotFinite { body, quantity: BodyQuantity::Velocity, .. } = **cause else {
        panic!("{cause}");
    };
    assert_eq!(body, handle);
    // all others went on
    assert!((cable_of(&world, other).time() - 13.0 / 60.0).abs() < 1e-6);
    assert!(world.get::<BodyPose>(free).unwrap().velocity.y < -9.81 * 12.5 / 60.0);
    world.resource_mut::<Physics>().bodies[handle].set_linvel(good, true);
    steps(&mut world, 10);
    assert_eq!(world.resource::<Log>().0.len(), 3);
    let time = cable_of(&world, cable).time();
    assert!((time - 20.0 / 60.0).abs() < 1e-6, "{time}");
}

#[test]
fn the_end_of_an_attachment_triggers_observers() {
    let mut world = world();
    world.init_resource::<Log>();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = world.spawn(soft([0.0; 3], [0.0, -2.0, 0.0])).id();
    let hook = world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    world
        .entity_mut(hook)
        .observe(|event: On<AttachmentEnded>, mut log: ResMut<Log>| log.0.push(("ended", event.entity)));
    steps(&mut world, 2);
    world.despawn(load);
    steps(&mut world, 2);
    assert_eq!(world.resource::<Log>().0, [("ended", hook)]);
}
