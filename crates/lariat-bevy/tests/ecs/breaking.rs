//! Cables that break.

use super::common::{cable_of, cube, height, pin, soft, steps, world};
use approx::assert_relative_eq;
use bevy_ecs::prelude::*;
use lariat_bevy::event::{AttachmentEnded, CableBroken, CableFailed, StepFailed};
use lariat_bevy::lariat_ancf::{BreakCause, Error, PointLoad, Vector3};
use lariat_bevy::{
    At, Attachment, AttachmentReading, Bending, BreakStrain, BreakTension, CableAttachments, Cables, Damping,
    PointLoads, Reel, ReelAtStart,
};

/// A crate of 5 kg hangs on a cable that breaks at 80 N; then a force on the cable grows to 50 N
/// downwards. The cable breaks at the top, where its own weight adds to the tension, and the crate
/// falls freely with the rest of the cable.
///
/// *Source.* N = (M + rho A L) g + F; free fall.
#[test]
fn a_cable_breaks_at_its_peak_tension_and_the_rest_falls_with_its_load() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = soft([0.0; 3], [0.0, -2.0, 0.0]);
    let cable = world.spawn((cable, Bending, Damping::critical_fraction(1.0), BreakTension(80.0))).id();
    let top = world.spawn(pin(cable)).id();
    let hook = world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    // while the crate drops into the cable the tension is up to twice the weight
    world.entity_mut(cable).insert(BreakTension(200.0));
    steps(&mut world, 300);
    assert_eq!(world.resource::<Messages<CableBroken>>().len(), 0);
    world.entity_mut(cable).insert(BreakTension(80.0));
    let pull = PointLoad { ramp: 2.0, ..PointLoad::force(1.8, Vector3::new(0.0, -50.0, 0.0)) };
    world.entity_mut(cable).insert(PointLoads(vec![pull]));
    let mut broken = Vec::new();
    let mut before = 0.0;
    for step in 0..150 {
        before = height(&world, load);
        steps(&mut world, 1);
        broken.extend(world.resource_mut::<Messages<CableBroken>>().drain());
        if !broken.is_empty() {
            // (80 - 49.05 - 6.2)/50 of 2 s
            assert!((58..62).contains(&step), "{step}");
            break;
        }
    }
    let [CableBroken { entity, rest, how }] = broken[..] else { panic!("{broken:?}") };
    let (arc_length, tension) = (how.arc_length, how.tension);
    assert_eq!(entity, cable);
    assert_relative_eq!(arc_length, 0.2, epsilon = 1e-9);
    assert!(tension > 80.0 && tension < 82.0, "{tension}");
    assert_eq!(world.get::<CableAttachments>(cable).unwrap().iter().collect::<Vec<_>>(), [top]);
    assert_eq!(world.get::<CableAttachments>(rest).unwrap().iter().collect::<Vec<_>>(), [hook]);
    assert!(world.get::<PointLoads>(cable).unwrap().0.is_empty());
    assert_relative_eq!(world.get::<PointLoads>(rest).unwrap().0[0].arc_length, 1.6, epsilon = 1e-9);
    world.entity_mut(rest).remove::<PointLoads>();
    steps(&mut world, 30);
    let failures: Vec<StepFailed> = world.resource_mut::<Messages<StepFailed>>().drain().collect();
    assert!(failures.is_empty(), "{failures:?}");
    let fallen = before - height(&world, load);
    assert!((fallen - 0.5 * 9.81 * 0.25).abs() < 0.1, "{fallen}");
    assert!(world.get::<AttachmentReading>(hook).unwrap().gap.norm() < 1e-6);
    assert_eq!(world.resource::<Cables>().attachments(), 2);
    assert_eq!(world.resource::<Messages<AttachmentEnded>>().len(), 0);
    let lengths = [cable, rest].map(|c| cable_of(&world, c).length());
    assert_relative_eq!(lengths[0] + lengths[1], 2.0, epsilon = 1e-9);
    assert!(world.get::<Bending>(rest).is_some() && world.get::<BreakTension>(rest).is_some());
}

/// A crate of 5 kg hangs at rest on a cable, both asleep, and the cable is weakened to 20 N, 30 N
/// below its load: it breaks in the next step. A limit above its tension leaves it asleep.
#[test]
fn a_limit_that_is_put_on_a_sleeping_cable_breaks_it() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Bending, Damping::critical_fraction(1.0))).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 600);
    assert!(world.resource::<Cables>().is_asleep(cable));
    world.entity_mut(cable).insert(BreakTension(100.0));
    steps(&mut world, 10);
    assert!(world.resource::<Cables>().is_asleep(cable));
    assert_eq!(world.resource::<Messages<CableBroken>>().len(), 0);
    world.get_mut::<BreakTension>(cable).unwrap().0 = 20.0;
    steps(&mut world, 1);
    let broken: Vec<CableBroken> = world.resource_mut::<Messages<CableBroken>>().drain().collect();
    assert_eq!(broken.len(), 1);
    let weight = 9.81 * (5.0 + cable_mass(0.01, 4000.0, 2.0));
    assert!((broken[0].how.tension - weight).abs() < 1.0, "{broken:?} {weight} N");
    let before = height(&world, load);
    steps(&mut world, 30);
    assert!(before - height(&world, load) > 1.0);
}

/// A hanging cable is cut by hand: the part behind is an entity with the same components, takes the crate, and falls freely. A limit
/// that makes no sense, or on a cable of one element, is an event.
#[test]
fn a_cable_is_cut_by_hand_and_limits_without_sense_are_events() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let components = (Bending, Damping::critical_fraction(1.0), BreakStrain(0.5));
    let cable = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), components)).id();
    world.spawn(pin(cable));
    let hook = world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    steps(&mut world, 60);
    assert!(world.resource_mut::<Cables>().cut(cable, 2.0).is_err());
    world.resource_mut::<Cables>().cut(cable, 1.13).unwrap();
    let before = height(&world, load);
    steps(&mut world, 30);
    let broken: Vec<CableBroken> = world.resource_mut::<Messages<CableBroken>>().drain().collect();
    let [CableBroken { entity, rest, how }] = broken[..] else { panic!("{broken:?}") };
    assert_eq!((entity, how.cause), (cable, BreakCause::Cut));
    assert_relative_eq!(how.arc_length, 1.13, epsilon = 1e-9);
    assert_eq!(world.get::<CableAttachments>(rest).unwrap().iter().collect::<Vec<_>>(), [hook]);
    assert_eq!(world.get::<BreakStrain>(rest), Some(&BreakStrain(0.5)));
    assert!(world.get::<Damping>(rest).is_some());
    let fallen = before - height(&world, load);
    assert!((fallen - 0.5 * 9.81 * 0.25).abs() < 0.1, "{fallen}");
    let one = world.spawn((soft([3.0, 0.0, 0.0], [4.0, 0.0, 0.0]).elements(1), BreakTension(1e3))).id();
    world.entity_mut(rest).insert(BreakTension(-1.0));
    steps(&mut world, 1);
    let failed: Vec<CableFailed> = world.resource_mut::<Messages<CableFailed>>().drain().collect();
    assert_eq!(failed.len(), 2, "{failed:?}");
    assert!(failed.iter().any(|f| f.entity == one && matches!(f.error, Error::OneElement { .. })), "{failed:?}");
    assert!(failed.iter().any(|f| f.entity == rest && matches!(f.error, Error::InvalidValue { .. })), "{failed:?}");
}

/// A crate hangs from a reel that is a component: it is hoisted, the reel stays with the part at its end when the cable is cut, and the
/// rest keeps its length when the component is removed. A reel that the cable cannot carry is an event.
///
/// *Source.* 1 s at 0.4 m/s, reached with 2 m/s^2.
#[test]
fn a_reel_is_a_component_that_stays_with_its_part() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let cable = soft([0.0, -2.0, 0.0], [0.0; 3]);
    let cable = world.spawn((cable, Bending, Damping::critical_fraction(1.0), Reel::default())).id();
    world.spawn(Attachment::ball(cable, At::End).to_world());
    world.spawn(Attachment::ball(cable, At::Start).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 60);
    let before = height(&world, load);
    *world.get_mut::<Reel>(cable).unwrap() = Reel::with_rate(-0.4);
    steps(&mut world, 60);
    let expected = 0.4 - 0.5 * 0.4 * 0.2;
    assert_relative_eq!(cable_of(&world, cable).length(), 2.0 - expected, epsilon = 1e-6);
    assert!((height(&world, load) - before - expected).abs() < 0.03);
    world.resource_mut::<Cables>().cut(cable, 0.8).unwrap();
    steps(&mut world, 60);
    let broken: Vec<CableBroken> = world.resource_mut::<Messages<CableBroken>>().drain().collect();
    let rest = broken[0].rest;
    assert!(world.get::<Reel>(cable).is_none() && world.get::<Reel>(rest).is_some());
    let length = cable_of(&world, rest).length();
    assert!(length < 0.6 && cable_of(&world, cable).length() == 0.8);
    world.entity_mut(rest).remove::<Reel>();
    steps(&mut world, 1);
    let length = cable_of(&world, rest).length();
    steps(&mut world, 30);
    assert_eq!(cable_of(&world, rest).length(), length);
    world.entity_mut(rest).insert(Reel::with_rate(f64::NAN));
    steps(&mut world, 1);
    let failed: Vec<CableFailed> = world.resource_mut::<Messages<CableFailed>>().drain().collect();
    assert!(matches!(failed[..], [CableFailed { error: Error::InvalidValue { .. }, .. }]), "{failed:?}");
}

/// A crate hangs by a cable from a reel at its first point and is hoisted; cut, the part above keeps the reel. With a second reel at the end both are
/// described, and removing one leaves the other.
///
/// *Source.* 1 s at 0.5 m/s, reached with 2 m/s^2.
#[test]
fn a_reel_at_the_start_is_a_component_too() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 7.0, [0.0, -2.6, 0.0])).id();
    let cable = soft([0.0; 3], [0.0, -2.5, 0.0]);
    let cable = world.spawn((cable, Bending, Damping::critical_fraction(1.0), ReelAtStart::default())).id();
    world.spawn(Attachment::ball(cable, At::Start).to_world());
    world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
    steps(&mut world, 60);
    let before = height(&world, load);
    *world.get_mut::<ReelAtStart>(cable).unwrap() = ReelAtStart::with_rate(-0.5);
    steps(&mut world, 60);
    let expected = 0.5 - 0.5 * 0.5 * 0.25;
    assert_relative_eq!(cable_of(&world, cable).length(), 2.5 - expected, epsilon = 1e-6);
    assert!((height(&world, load) - before - expected).abs() < 0.04);
    *world.get_mut::<ReelAtStart>(cable).unwrap() = ReelAtStart::to_length(2.4, 0.5);
    steps(&mut world, 120);
    assert_relative_eq!(cable_of(&world, cable).length(), 2.4, epsilon = 1e-9);
    world.resource_mut::<Cables>().cut(cable, 1.2).unwrap();
    steps(&mut world, 2);
    let broken: Vec<CableBroken> = world.resource_mut::<Messages<CableBroken>>().drain().collect();
    assert!(world.get::<ReelAtStart>(cable).is_some() && world.get::<ReelAtStart>(broken[0].rest).is_none());
    let ends = |world: &World| [At::Start, At::End].map(|at| cable_of(world, cable).reel(at).is_some());
    world.entity_mut(cable).insert(Reel::default());
    steps(&mut world, 1);
    assert_eq!(ends(&world), [true, true]);
    world.entity_mut(cable).remove::<ReelAtStart>();
    steps(&mut world, 1);
    assert_eq!(ends(&world), [false, true]);
}

/// Mass in kg of a round cable: diameter in m, density in kg/m^3, length in m.
fn cable_mass(diameter: f64, density: f64, length: f64) -> f64 {
    core::f64::consts::FRAC_PI_4 * diameter * diameter * density * length
}
