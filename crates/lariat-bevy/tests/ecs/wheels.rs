//! Drums and sheaves as components.

use super::common::{bits, cable_of, cube, height, soft, steps, world};
use bevy_ecs::message::Messages;
use bevy_ecs::prelude::*;
use lariat_bevy::event::{CableBroken, CableFailed, DrumFailed, SheaveFailed};
use lariat_bevy::lariat_ancf::Error as Mechanics;
use lariat_bevy::rapier::prelude::{ColliderBuilder, LockedAxes, MassProperties, RigidBodyBuilder, Vector};
use lariat_bevy::{
    At, Attachment, Body, Cables, Damping, Drum, Error, OnCable, Physics, Reel, Sheave, SheaveAlong, SheaveOptions,
    Snapshot,
};

const G: f64 = 9.81;
const RADIUS: f64 = 0.2;

/// Spawns a drum about z of this inertia in kg m^2.
fn drum(world: &mut World, inertia: f32) -> Entity {
    let own = MassProperties::new(Vector::ZERO, 4.0, Vector::new(inertia, inertia, inertia));
    let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Y;
    let body = RigidBodyBuilder::dynamic().additional_mass_properties(own).locked_axes(axes);
    world.spawn(Body::new(body).at([RADIUS, 0.0, 0.0])).id()
}

/// A crate falls on a rope from a drum as their equation says; cut, the part at the drum keeps it; a snapshot in the middle goes on bitwise, also with
/// a drum whose body was despawned since; without its body or its component the rope keeps its length.
///
/// *Source.* `(J/R^2 + rho S + m) a = g (rho L + m)`, L as in the middle of the fall.
#[test]
fn a_drum_is_a_component() {
    let mut world = world();
    let wheel = drum(&mut world, 0.4);
    let load = world.spawn(cube(0.1, 8.0, [0.0, -2.1, 0.0])).id();
    let rope = soft([0.0, -2.0, 0.0], [0.0; 3]);
    let wound = Drum::at_end(wheel, [0.0, 0.0, 2.0], RADIUS).with_stock(5.0);
    let rope = world.spawn((rope, Damping::critical_fraction(1.0), wound.clone())).id();
    world.spawn(Attachment::ball(rope, At::End).to_world());
    world.spawn(Attachment::ball(rope, At::Start).to(load).at([0.0, 0.1, 0.0]));
    let start = -2.1;
    steps(&mut world, 30);
    let density = core::f64::consts::FRAC_PI_4 * 1e-4 * 4000.0;
    let moved = 0.4 / (RADIUS * RADIUS) + density * 5.0 + 8.0;
    let fallen = start - height(&world, load);
    let expected = 0.5 * G * (density * 2.1 + 8.0) / moved * 0.25;
    println!("{fallen} of {expected} m");
    assert!((fallen / expected - 1.0).abs() < 0.02, "{fallen} of {expected} m");
    assert!((cable_of(&world, rope).length() - 2.0 - fallen).abs() < 5e-3);
    let spin = |world: &World| {
        let handle = world.resource::<Cables>().set().drums().next().unwrap().2.body;
        f64::from(world.resource::<Physics>().bodies[handle].angvel().z) * RADIUS
    };
    let rate = cable_of(&world, rope).reel(At::End).unwrap().rate;
    assert!((spin(&world) / rate - 1.0).abs() < 0.01, "{} of {rate}", spin(&world));

    let snapshot = Snapshot::take(&mut world).unwrap();
    steps(&mut world, 10);
    let once = bits(&world, rope);
    snapshot.restore(&mut world).unwrap();
    steps(&mut world, 10);
    assert!(bits(&world, rope) == once);
    world.despawn(wheel);
    steps(&mut world, 2);
    let failed: Vec<DrumFailed> = world.resource_mut::<Messages<DrumFailed>>().drain().collect();
    assert!(matches!(failed[..], [DrumFailed { error: Error::NotABody(body), .. }] if body == wheel), "{failed:?}");
    let length = cable_of(&world, rope).length();
    steps(&mut world, 2);
    assert_eq!(cable_of(&world, rope).length(), length);
    let renamed = snapshot.restore(&mut world).unwrap();
    steps(&mut world, 10);
    assert!(bits(&world, rope) == once);
    assert_eq!(world.get::<Drum>(rope).unwrap().body, renamed[&wheel]);

    world.resource_mut::<Cables>().cut(rope, 0.9).unwrap();
    steps(&mut world, 5);
    let broken: Vec<CableBroken> = world.resource_mut::<Messages<CableBroken>>().drain().collect();
    let rest = broken[0].rest;
    assert!(world.get::<Drum>(rope).is_none() && world.get::<Drum>(rest).is_some());
    let out = cable_of(&world, rest).length();
    steps(&mut world, 5);
    assert!(cable_of(&world, rest).length() > out + 0.01);
    world.entity_mut(rest).remove::<Drum>();
    steps(&mut world, 1);
    assert!(cable_of(&world, rest).reel(At::End).is_none() && world.resource::<Cables>().set().drums().count() == 0);
    assert_eq!(world.resource::<Messages<DrumFailed>>().len(), 0);
}

/// A drum without body, on a body that is fixed, and one at an end with a reel are events; a reel at the end of a drum is one, too; a drum that changes is
/// made anew.
#[test]
fn drums_that_cannot_be_are_events() {
    let mut world = world();
    let (wheel, ground) = (drum(&mut world, 0.4), world.spawn(Body::fixed()).id());
    let rope = world.spawn((soft([0.0, -1.0, 0.0], [0.0; 3]), Drum::at_end(ground, [0.0, 0.0, 1.0], RADIUS))).id();
    world.spawn(Attachment::ball(rope, At::End).to_world());
    let failed = |world: &mut World| -> Vec<Error> {
        steps(world, 2);
        world.resource_mut::<Messages<DrumFailed>>().drain().map(|failed| failed.error).collect()
    };
    let first = failed(&mut world);
    assert!(matches!(first[..], [Error::Coupling(lariat_bevy::lariat_rapier::Error::DrumBody(_))]), "{first:?}");
    world.get_mut::<Drum>(rope).unwrap().body = wheel;
    assert!(failed(&mut world).is_empty() && cable_of(&world, rope).reel(At::End).is_some());
    world.entity_mut(rope).insert(Reel::with_rate(1.0));
    assert!(failed(&mut world).is_empty());
    let of_reel: Vec<CableFailed> = world.resource_mut::<Messages<CableFailed>>().drain().collect();
    assert!(matches!(of_reel[..], [CableFailed { error: Mechanics::ReelPlace { .. }, .. }]), "{of_reel:?}");
    world.entity_mut(rope).remove::<Reel>();
    world.get_mut::<Drum>(rope).unwrap().radius = 0.1;
    assert!(failed(&mut world).is_empty());
    let radius = world.resource::<Cables>().set().drums().next().unwrap().2.radius;
    assert_eq!(radius, 0.1);
    let other = (soft([1.0, -1.0, 0.0], [1.0, 0.0, 0.0]), Reel::default());
    let other = world.spawn((other, Drum::at_end(wheel, [0.0, 0.0, 1.0], RADIUS))).id();
    // made first, so that the reel is the event
    steps(&mut world, 1);
    let of_reel: Vec<CableFailed> = world.resource_mut::<Messages<CableFailed>>().drain().collect();
    assert!(matches!(of_reel[..], [CableFailed { entity, .. }] if entity == other), "{of_reel:?}");
}

/// Two crates on a rope over a sheave: the heavier falls as in Atwood's machine; cut, a side keeps the sheave; a snapshot goes on bitwise; the
/// sheave ends with its component and its attachment.
///
/// *Source.* `(m_1 + m_2 + rho L) a = (m_1 - m_2) g`, sides of one length.
#[test]
fn a_sheave_is_an_entity() {
    let mut world = world();
    let loads = [3.0f32, 5.0].map(|mass| world.spawn(cube(0.1, mass, [0.0, -2.1, 0.0])).id());
    let up = world.spawn((soft([0.0, -2.0, 0.0], [0.0; 3]), Damping::critical_fraction(1.0))).id();
    let down = world.spawn((soft([0.0; 3], [0.0, -2.0, 0.0]), Damping::critical_fraction(1.0))).id();
    world.spawn(Attachment::ball(up, At::Start).to(loads[0]).at([0.0, 0.1, 0.0]));
    let top = world.spawn(Attachment::ball(up, At::End).to_world()).id();
    world.spawn(Attachment::ball(down, At::Start).to_world());
    world.spawn(Attachment::ball(down, At::End).to(loads[1]).at([0.0, 0.1, 0.0]));
    let sheave = world.spawn(Sheave::between((up, At::End), (down, At::Start))).id();
    steps(&mut world, 10);
    let rate = |world: &World| cable_of(world, down).reel(At::Start).unwrap().rate;
    let before = (rate(&world), height(&world, loads[1]));
    steps(&mut world, 20);
    let density = core::f64::consts::FRAC_PI_4 * 1e-4 * 4000.0;
    let gained = (rate(&world) - before.0) / (2.0 * G / (8.0 + 4.0 * density) / 3.0);
    let fallen = before.1 - height(&world, loads[1]);
    let passed = world.resource::<Cables>().sheave(sheave).unwrap().passed();
    println!("{gained} of the speed, {fallen} and {passed} m");
    // what hangs further down weighs more: up to 2 rho g x of 2 g
    assert!((gained - 1.0).abs() < 0.02 && passed > fallen && passed < fallen + 0.05, "{gained} {passed} {fallen}");

    let snapshot = Snapshot::take(&mut world).unwrap();
    steps(&mut world, 6);
    let once = bits(&world, down);
    world.despawn(sheave);
    steps(&mut world, 2);
    assert!(cable_of(&world, up).reel(At::End).is_none() && world.resource::<Cables>().sheave(sheave).is_err());
    let renamed = snapshot.restore(&mut world).unwrap();
    let sheave = renamed[&sheave];
    steps(&mut world, 6);
    assert!(bits(&world, down) == once);

    world.resource_mut::<Cables>().cut(up, 0.6).unwrap();
    steps(&mut world, 3);
    let rest = world.resource_mut::<Messages<CableBroken>>().drain().next().unwrap().rest;
    assert_eq!(world.get::<Sheave>(sheave).unwrap().from, (rest, At::End));
    assert!(world.resource::<Cables>().sheave(sheave).is_ok());
    // friction added: made anew
    world.get_mut::<Sheave>(sheave).unwrap().options = SheaveOptions { brake: 1e4, ..SheaveOptions::default() };
    steps(&mut world, 6);
    assert!(rate(&world).abs() < 1e-6, "{} m/s", rate(&world));
    assert_eq!(world.resource::<Messages<SheaveFailed>>().len(), 0);
    world.despawn(top);
    steps(&mut world, 3);
    let failed: Vec<SheaveFailed> = world.resource_mut::<Messages<SheaveFailed>>().drain().collect();
    assert_eq!(failed.len(), 1, "{failed:?}");
    assert!(world.resource::<Cables>().sheave(sheave).is_err());
}

/// Two crates on one rope over an eye of the world or of a kinematic body, spawned in one frame with their attachments: the heavier falls
/// as in Atwood's machine; the parts have the components of the rope; a snapshot from before and after the sheave was made goes on bitwise.
/// What cannot be made is an event, and is tried again when it changes.
///
/// *Source.* `(m_1 + m_2 + rho L) x'' = (m_1 - m_2 + 2 rho x) g` from rest on sides of one length: `x'' = sqrt(a^2 + k^2 x'^2)`, a at the start, k the
/// growth rate.
#[test]
fn a_sheave_along_a_rope_is_an_entity() {
    for on_body in [false, true] {
        let mut world = world();
        let block = Body::new(RigidBodyBuilder::kinematic_position_based()).at([0.0, 0.1, 0.0]);
        let block = world.spawn(block).id();
        // both at one place, and so without contact
        let load = |mass| ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(mass).sensor(true);
        let loads = [3.0f32, 5.0].map(|mass| world.spawn(Body::dynamic().at([0.0, -2.1, 0.0]).with(load(mass))).id());
        let drawn = soft([0.0, -2.0, 0.0], [0.0; 3]).through([[0.0, -2.0, 0.0], [0.0; 3], [0.0, -2.0, 0.0]]);
        let rope = world.spawn((drawn.node_at(2.0), Damping::critical_fraction(1.0))).id();
        world.spawn(Attachment::ball(rope, At::Start).to(loads[0]).at([0.0, 0.1, 0.0]));
        let hook = world.spawn(Attachment::ball(rope, At::End).to(loads[1]).at([0.0, 0.1, 0.0])).id();
        let along = SheaveAlong::of(rope, At::ArcLength(2.0));
        let far = world.spawn(along.to_world([0.0, 0.5, 0.0])).id();
        let along = if on_body { along.to(block, [0.0, -0.1, 0.0]) } else { along.to_world([0.0; 3]) };
        let sheave = world.spawn(along).id();
        let snapshot = Snapshot::take(&mut world).unwrap();
        steps(&mut world, 5);
        let failed: Vec<SheaveFailed> = world.resource_mut::<Messages<SheaveFailed>>().drain().collect();
        assert!(matches!(failed[..], [SheaveFailed { entity, .. }] if entity == far), "{failed:?}");
        world.get_mut::<SheaveAlong>(far).unwrap().anchor.y = 0.6;
        steps(&mut world, 5);
        let failed: Vec<SheaveFailed> = world.resource_mut::<Messages<SheaveFailed>>().drain().collect();
        assert!(matches!(failed[..], [SheaveFailed { entity, .. }] if entity == far), "{failed:?}");
        let parts = world.resource::<Cables>().parts(rope).unwrap();
        assert!(parts.len() == 2 && parts[0] == rope);
        let down = parts[1];
        assert_eq!(world.get::<Sheave>(sheave).unwrap().to, (down, At::Start));
        assert_eq!(world.get::<OnCable>(hook).unwrap().0, down);
        assert!(world.get::<SheaveAlong>(sheave).is_none() && world.get::<Damping>(down) == world.get::<Damping>(rope));
        let once = bits(&world, rope);
        let renamed = snapshot.restore(&mut world).unwrap();
        assert!(renamed.is_empty() && world.get::<SheaveAlong>(sheave).is_some());
        steps(&mut world, 10);
        assert!(bits(&world, rope) == once);
        world.despawn(far);
        world.resource_mut::<Messages<SheaveFailed>>().clear();
        let down = world.resource::<Cables>().parts(rope).unwrap()[1];
        let rate = |world: &World| cable_of(world, down).reel(At::Start).unwrap().rate;
        let before = rate(&world);
        let snapshot = Snapshot::take(&mut world).unwrap();
        steps(&mut world, 20);
        let density = core::f64::consts::FRAC_PI_4 * 1e-4 * 4000.0;
        let mass = 8.0 + 4.0 * density;
        let (start, growth, time) = (2.0 * G / mass, (2.0 * density * G / mass).sqrt(), 1.0f64 / 3.0);
        let acceleration = start.hypot(growth * before);
        let expected = before * (growth * time).cosh() + acceleration / growth * (growth * time).sinh();
        println!("{} of {expected} m/s", rate(&world));
        assert!((rate(&world) / expected - 1.0).abs() < 0.01, "{} of {expected} m/s", rate(&world));
        let once = bits(&world, down);
        snapshot.restore(&mut world).unwrap();
        steps(&mut world, 20);
        assert!(bits(&world, down) == once);
        assert_eq!(world.resource::<Messages<SheaveFailed>>().len(), 0);
        // without the sheave both parts keep their lengths, held by their attachments
        world.despawn(sheave);
        steps(&mut world, 2);
        assert!(cable_of(&world, rope).reel(At::End).is_none() && cable_of(&world, down).reel(At::Start).is_none());
        let held = world.query::<(&Attachment, &OnCable)>().iter(&world).filter(|(_, on)| on.0 == down).count();
        assert_eq!(held, 2);
    }
}
