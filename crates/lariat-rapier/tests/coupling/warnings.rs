//! Warnings of a set: as events, once each, and when asked for.

use super::common::{add_cube, cable, run, soft};
use lariat_ancf::coupling::Coupling;
use lariat_rapier::lariat_ancf::{
    At, Cable, Contact, Damping, Fidelity, Integrator, Level, Method, Motion, Section, StepControl, Vector3,
    Warning as CableWarning, Water,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::water::BodiesInWater;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Event, Gap, Warning};

/// Runs a number of host steps, and returns all of their events.
fn events(set: &mut CableSet, world: &mut PhysicsWorld, steps: usize) -> Vec<Event> {
    let step = |_| {
        run(world, set, 1);
        set.take_events()
    };
    (0..steps).flat_map(step).collect()
}

fn told(set: &mut CableSet, world: &mut PhysicsWorld, steps: usize) -> Vec<(CableHandle, CableWarning)> {
    let warning = |event| match event {
        Event::Warning { cable, warning } => Some((cable, warning)),
        _ => None,
    };
    events(set, world, steps).into_iter().filter_map(warning).collect()
}

/// A load of 50 kg that swings on two elements and on twelve, on a cable that the load stretches by a tenth, and on one as thick as
/// long: each has its warning once, at a host step, and a good one has none.
#[test]
fn warnings_are_events_once_for_each_cable() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    set.settings.warn_level = Some(Level::Coarse);
    let load = 50.0 * 9.81;
    let sections = [
        (2, soft()),
        (12, soft()),
        (12, Section::from_stiffness(10.0 * load, 1e-4, 0.4).unwrap()),
        (12, Section::round(0.5, 2e11, 10.0).unwrap()),
    ];
    let mut cables = Vec::new();
    for (i, (elements, section)) in sections.into_iter().enumerate() {
        let z = 3.0 * i as f64;
        // slack: it drops, bends and is pulled taut; the stretched and the thick one only hang
        let across = if i < 2 { 1.2 } else { 0.0 };
        let down = if i < 2 { 0.3 } else { -2.0 };
        let builder = cable([0.0, 0.0, z], [across, down, z], section).elements(elements).fix(At::Start);
        let rope = set.insert(builder.build().unwrap());
        let cube = add_cube(&mut world, 50.0, 0.1, [across as Real, down as Real - 0.1, z as Real]);
        set.attach(&world, rope, At::End, cube, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        cables.push(rope);
    }
    let told = told(&mut set, &mut world, 90);
    let of = |cable: CableHandle| told.iter().filter(|(c, _)| *c == cable).map(|(_, w)| w).collect::<Vec<_>>();
    let coarse = |w: &&CableWarning| {
        matches!(w, CableWarning::CoarseMesh { elements: 2, .. } | CableWarning::CoarseElement { .. })
    };
    assert!(of(cables[0]).iter().any(coarse), "{told:?}");
    assert!(of(cables[2]).iter().any(|w| matches!(w, CableWarning::LargeStrain { .. })), "{told:?}");
    assert!(matches!(&of(cables[3])[..], [CableWarning::Stubby { .. }, ..]), "{told:?}");
    for rope in cables {
        let mut kinds: Vec<_> = of(rope).into_iter().map(std::mem::discriminant).collect();
        let count = kinds.len();
        kinds.dedup();
        assert_eq!(count, kinds.len(), "{told:?}");
        assert_eq!(set.get(rope).unwrap().diagnostics().warnings, count as u64);
    }
}

/// A load that hangs on a straight cable has no warning; a set that does not watch has none at all.
#[test]
fn a_cable_that_is_good_enough_and_a_set_that_does_not_watch_have_no_warning() {
    for (watch, elements, length) in [(true, 10, 2.0), (true, 4, 0.5), (false, 1, 2.0)] {
        let mut world = PhysicsWorld::new();
        let mut set = CableSet::new();
        set.settings.watch = watch;
        let rope = cable([0.0; 3], [0.0, -length, 0.0], soft()).elements(elements).fix(At::Start);
        let rope = set.insert(rope.build().unwrap());
        let cube = add_cube(&mut world, 10.0, 0.1, [0.0, -length as Real - 0.1, 0.0]);
        set.attach(&world, rope, At::End, cube, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        assert_eq!(told(&mut set, &mut world, 120), []);
        assert_eq!(set.get(rope).unwrap().is_watched(), watch);
    }
}

/// A cable through a wall is told when asked for, by its deepest node; not one that is attached to the wall, nor a sensor.
#[test]
fn a_cable_inside_a_collider_is_told() {
    let mut world = PhysicsWorld::new();
    let wall = RigidBodyBuilder::fixed().translation(Vector::new(1.0, 0.1, 0.0));
    let (wall, collider) = world.insert(wall, ColliderBuilder::cuboid(0.3, 0.5, 0.5));
    let sensor = RigidBodyBuilder::fixed().translation(Vector::new(3.0, 0.0, 0.0));
    world.insert(sensor, ColliderBuilder::cuboid(0.3, 0.5, 0.5).sensor(true));
    let mut set = CableSet::new();
    let through = set.insert(cable([0.0; 3], [4.0, 0.0, 0.0], soft()).elements(8).build().unwrap());
    let [Warning::InCollider { cable: found, collider: there, arc_length, depth, .. }] = set.warnings(&world)[..]
    else {
        panic!("{:?}", set.warnings(&world))
    };
    assert!(found == through && there == collider && (arc_length - 1.0).abs() < 1e-9 && (depth - 0.3).abs() < 1e-6);
    set.attach_here(&world, through, 1.0, wall, AttachmentKind::Ball).unwrap();
    assert!(set.warnings(&world).is_empty());
}

/// A cable that comes near a collider with which it should bounce more than it can tells so in an event, once.
#[test]
fn more_restitution_than_cables_have_is_told_once() {
    for (own, expected) in [(0.0, None), (0.75, None), (1.0, Some(1.0))] {
        let mut world = PhysicsWorld::new();
        world.insert_collider(ColliderBuilder::cuboid(3.0, 0.1, 1.0).restitution(1.0), None);
        let mut set = CableSet::new();
        let rope = set.insert(cable([-1.0, 0.2, 0.0], [1.0, 0.2, 0.0], soft()).elements(8).build().unwrap());
        let contact = Contact::with_friction(0.3).with_radius(0.01).with_restitution(own);
        set.set_contact(rope, contact).unwrap();
        let found = told(&mut set, &mut world, 60).into_iter().filter_map(|(cable, warning)| match warning {
            CableWarning::HighRestitution { restitution, .. } => Some((cable, restitution)),
            _ => None,
        });
        let found: Vec<_> = found.collect();
        let expected: Vec<_> = expected.into_iter().map(|restitution| (rope, restitution)).collect();
        assert_eq!(found, expected);
    }
}

/// Who asks is told, of cables that touch, by the most elastic collider.
#[test]
fn more_restitution_than_cables_have_is_told() {
    let mut world = PhysicsWorld::new();
    for restitution in [0.0, 1.0, 0.9] {
        world.insert_collider(ColliderBuilder::cuboid(1.0, 0.1, 1.0).restitution(restitution), None);
    }
    let mut set = CableSet::new();
    let high = || cable([0.0, 2.0, 0.0], [4.0, 2.0, 0.0], soft()).elements(8);
    set.insert(high().build().unwrap());
    assert_eq!(set.warnings(&world), []);
    let touching = set.insert(high().build().unwrap());
    let contact = Contact::with_friction(0.3).with_radius(0.01);
    set.set_contact(touching, contact).unwrap();
    assert_eq!(set.warnings(&world), []);
    set.set_contact(touching, contact.with_restitution(0.9)).unwrap();
    let [Warning::HighRestitution { cable: found, restitution, .. }] = set.warnings(&world)[..] else {
        panic!("{:?}", set.warnings(&world))
    };
    assert!(found == touching && (restitution - 0.95).abs() < 1e-6);
}

/// A bar that swings, by a method that damps long steps: the loss of energy is told when asked for; with error control there is none, nor for a load on the bar,
/// which exchanges energy with it.
#[test]
fn energy_that_integration_takes_is_told() {
    for (method, loaded, due) in [
        (Method::GeneralisedAlpha { rho: 0.0 }, false, true),
        (Method::Esdirk4, false, false),
        (Method::Esdirk4, true, false),
    ] {
        let mut world = PhysicsWorld::new();
        let mut set = CableSet::new();
        if due {
            world.integration_parameters.dt = 0.03;
            set.settings.rapier_steps = 1;
        }
        let control = if due { StepControl::Substeps(1) } else { StepControl::Tolerance(1e-6) };
        let section = Section::from_stiffness(1e6, 5.0, 2.0).unwrap();
        let builder = cable([0.0; 3], [1.5, 0.0, 0.0], section).elements(12).fix(At::Start);
        let rope = set.insert(builder.integrator(Integrator { method, control }).build().unwrap());
        if loaded {
            let cube = add_cube(&mut world, 0.5, 0.05, [1.5, 0.0, 0.0]);
            set.attach(&world, rope, At::End, cube, Vector::new(0.0, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        }
        run(&mut world, &mut set, 60);
        let told = set.get(rope).unwrap().warnings();
        let lost = told.iter().any(|w| matches!(w, CableWarning::EnergyLost { .. }));
        let made = told.iter().any(|w| matches!(w, CableWarning::EnergyMade { .. }));
        assert!(lost == due && !made, "{due} {told:?}");
    }
}

/// A crate hangs on a rope, moves at first while the rope does not, and is put elsewhere later: a shock before the first step, and a gap in the step
/// in which it was moved. Before and after there is nothing to say.
#[test]
fn shocks_and_gaps_of_attachments_are_told() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let rope = cable([0.0, 0.0, 0.0], [0.0, -2.0, 0.0], soft()).elements(8).fix(At::Start);
    let rope = set.insert(rope.build().unwrap());
    let load = add_cube(&mut world, 5.0, 0.1, [0.0, -2.1, 0.0]);
    let hook = set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    assert_eq!(set.warnings(&world), []);
    // across the rope, which the load has not pulled taut: no wave, and no shock
    world.bodies[load].set_linvel(Vector::new(0.3, 0.0, 0.0), true);
    assert_eq!(set.warnings(&world), []);
    // the anchor is at 0.1 m from the centre: w x r and v together
    world.bodies[load].set_linvel(Vector::new(0.2, -0.3, 0.0), true);
    world.bodies[load].set_angvel(Vector::new(0.0, 0.0, 2.0), true);
    // its wave has 0.3 sqrt(EA m) = 0.3 sqrt(1e5 0.4) N, where 5 kg hang
    assert!(
        matches!(set.warnings(&world)[..], [Warning::VelocityJump { attachment, difference, force, .. }]
            if attachment == hook && (difference - 0.3).abs() < 1e-6 && (force - 60.0).abs() < 1e-3),
        "{:?}",
        set.warnings(&world)
    );
    world.bodies[load].set_linvel(Vector::new(0.5, 0.0, 0.0), true);
    let opened = |set: &mut CableSet, world: &mut PhysicsWorld, steps| {
        let gap = |event| match event {
            Event::GapOpened { attachment, gap } => Some((attachment, gap)),
            _ => None,
        };
        events(set, world, steps).into_iter().filter_map(gap).collect::<Vec<_>>()
    };
    assert_eq!(opened(&mut set, &mut world, 60), []);
    assert_eq!(set.open_gap(hook), Ok(None));
    // a heavy ball hits the crate: within that step, if it is divided no further, the rope cannot follow
    set.settings.max_rapier_steps = 4;
    let place = world.bodies[load].translation();
    let ball = RigidBodyBuilder::dynamic()
        .translation(place + Vector::new(-1.0, 0.0, 0.0))
        .linvel(Vector::new(40.0, 0.0, 0.0));
    world.insert(ball, ColliderBuilder::ball(0.1).mass(50.0));
    let told = opened(&mut set, &mut world, 10);
    assert!(matches!(told[..], [(attachment, gap)] if attachment == hook && gap.closed), "{told:?}");
    let warnings = set.warnings(&world);
    let open = |w: &Warning| matches!(w, Warning::OpenGap { gap, .. } if gap.gap >= told[0].1.gap);
    assert!(warnings.iter().any(open), "{warnings:?}");
}

/// Keeps what is logged.
struct Lines(std::sync::Mutex<Vec<String>>);

static LINES: Lines = Lines(std::sync::Mutex::new(Vec::new()));

impl log::Log for Lines {
    fn enabled(&self, _: &log::Metadata) -> bool {
        true
    }
    fn log(&self, record: &log::Record) {
        self.0.lock().unwrap().push(record.args().to_string());
    }
    fn flush(&self) {}
}

/// What is wrong with how cables begin is logged once, by a program that asks for nothing: a rope through a wall, a shock, an impact that
/// returns more than it can. What nothing is wrong with is not.
#[test]
fn what_is_wrong_at_the_start_is_logged_once() {
    log::set_logger(&LINES).unwrap();
    log::set_max_level(log::LevelFilter::Warn);
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let mut add = |name: &str, x: f64| {
        let rope = cable([x, 0.0, 0.0], [x, -2.0, 0.0], soft()).name(name).elements(8).fix(At::Start);
        set.insert(rope.build().unwrap())
    };
    add("through-a-wall", 0.0);
    add("right", 6.0);
    let (shock, bounce) = (add("with-a-shock", 2.0), add("that-bounces", 4.0));
    world.insert_collider(ColliderBuilder::cuboid(0.2, 0.2, 0.2).translation(Vector::new(0.0, -1.0, 0.0)), None);
    let load = add_cube(&mut world, 5.0, 0.1, [2.0, -2.1, 0.0]);
    world.bodies[load].set_linvel(Vector::new(0.0, -0.5, 0.0), true);
    set.attach(&world, shock, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    world.insert_collider(ColliderBuilder::ball(0.2).translation(Vector::new(4.5, -1.0, 0.0)).restitution(1.0), None);
    set.set_contact(bounce, Contact::default().with_radius(0.01).with_restitution(1.0)).unwrap();
    let expected = set.warnings(&world);
    assert_eq!(expected.len(), 3, "{expected:?}");
    run(&mut world, &mut set, 5);
    let lines = LINES.0.lock().unwrap();
    for warning in &expected {
        let line = warning.to_string();
        assert_eq!(lines.iter().filter(|other| **other == line).count(), 1, "{line}: {lines:#?}");
    }
    assert!(!lines.iter().any(|line| line.contains("\"right\"")), "{lines:#?}");
}

/// An anchor 1 m from the cable that is to close is never met after one step, and is met later.
#[test]
fn a_gap_that_is_still_to_close_is_told_when_asked_for() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0, 0.0, 0.0], [0.0, -2.0, 0.0], soft()).elements(8).fix(At::Start).build().unwrap());
    let load = add_cube(&mut world, 5.0, 0.1, [0.0, -3.1, 0.0]);
    let close = AttachmentKind::Ball.with_gap(Gap::Close);
    let hook = set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), close).unwrap();
    run(&mut world, &mut set, 1);
    let gap = set.open_gap(hook).unwrap();
    assert!(gap.is_some_and(|gap| !gap.closed && gap.gap > 0.5), "{gap:?}");
    run(&mut world, &mut set, 60);
    assert_eq!((set.open_gap(hook), set.take_events()), (Ok(None), vec![]));
}

/// A load on a rope that a game puts elsewhere, before the first step or after some: the gap is told,
/// and neither the steps nor the mesh that cannot follow it. Fidelity game is told nothing of mesh and
/// steps, whatever happens to it.
#[test]
fn a_body_that_is_put_elsewhere_is_told_as_a_gap() {
    for (level, steps) in [(None, 30), (Some(Level::Coarse), 30), (None, 0)] {
        let mut world = PhysicsWorld::new();
        let mut set = CableSet::new();
        set.settings.warn_level = level;
        let rope = cable([0.0, 0.0, 0.0], [0.0, -2.0, 0.0], soft()).elements(6).fix(At::Start);
        let rope = set.insert(rope.build().unwrap());
        let load = add_cube(&mut world, 5.0, 0.1, [0.0, -2.1, 0.0]);
        let hook = set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
        assert_eq!(events(&mut set, &mut world, steps), []);
        world.bodies[load].set_translation(Vector::new(1.0, -0.6, 0.0), true);
        let events = events(&mut set, &mut world, 60);
        let opened = |e: &Event| matches!(e, Event::GapOpened { attachment, .. } if *attachment == hook);
        assert!(events.iter().any(opened), "{events:?}");
        let coarse = |e: &Event| matches!(e, Event::Warning { warning, .. } if warning.level() == Level::Coarse);
        assert!(!events.iter().any(coarse), "{events:?}");
        let told = set.warnings(&world);
        assert!(steps == 0 || matches!(told[..], [Warning::OpenGap { .. }]), "{told:?}");
    }
}

/// A dynamic body that was given neither a collider nor a mass is told; one with either, or that may not
/// move, is not.
#[test]
fn a_dynamic_body_without_mass_is_told() {
    let told = |body: RigidBodyBuilder, collider: Option<ColliderBuilder>, steps: usize| {
        let mut world = PhysicsWorld::new();
        let body = match collider {
            Some(collider) => world.insert(body, collider).0,
            None => world.insert_body(body),
        };
        let mut set = CableSet::new();
        let rope = set.insert(cable([0.0; 3], [2.0, 0.0, 0.0], soft()).fix(At::Start).build().unwrap());
        let at = AttachmentKind::Ball.with_gap(Gap::Close);
        set.attach(&world, rope, At::End, body, Vector::ZERO, at).unwrap();
        run(&mut world, &mut set, steps);
        set.warnings(&world).iter().any(|warning| matches!(warning, Warning::NoMass { .. }))
    };
    let dynamic = || RigidBodyBuilder::dynamic().translation(Vector::X * 2.0);
    for steps in [0, 3] {
        assert!(told(dynamic(), None, steps) && told(dynamic(), Some(ColliderBuilder::ball(0.1).mass(0.0)), steps));
        assert!(!told(dynamic().additional_mass(2.0), None, steps) && !told(RigidBodyBuilder::fixed(), None, steps));
        assert!(!told(dynamic(), Some(ColliderBuilder::ball(0.1)), steps));
        assert!(!told(dynamic().lock_translations(), None, steps));
    }
}

/// An anchor in the axes of the world, a world in another unit, and water in t/m^3 are told; and none where they are as they should be.
#[test]
fn far_anchors_and_other_units_are_told() {
    let kinds = |anchor: f64, unit: Real, water: Option<f64>| {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.length_unit = unit;
        let mut set = CableSet::new();
        set.set_water(water.map(|density| BodiesInWater::new(Water::new(density)).unwrap()));
        let rope = set.insert(cable([0.0; 3], [0.0, -2.0, 0.0], soft()).fix(At::Start).build().unwrap());
        let cube = add_cube(&mut world, 10.0, 0.1, [0.0, -2.0 - anchor as Real, 0.0]);
        set.attach(&world, rope, At::End, cube, Vector::new(0.0, anchor as Real, 0.0), AttachmentKind::Ball).unwrap();
        let kind = |warning: &Warning| match warning {
            Warning::FarAnchor { distance, .. } => {
                assert!((distance / anchor - 1.0).abs() < 1e-6, "{warning}");
                Some("anchor")
            }
            Warning::LengthUnit { .. } => Some("unit"),
            Warning::LightWater { .. } => Some("water"),
            _ => None,
        };
        set.warnings(&world).iter().filter_map(kind).collect::<Vec<_>>()
    };
    assert_eq!(kinds(0.1, 1.0, None), Vec::<&str>::new());
    assert_eq!(kinds(0.1, 1.0, Some(1025.0)), Vec::<&str>::new());
    assert_eq!(kinds(0.1, 1.0, Some(1.025)), ["water"]);
    assert_eq!(kinds(0.1, 100.0, None), ["unit"]);
    assert_eq!(kinds(2.0, 1.0, None), ["anchor"]);
}

/// Two weights on a rope over a pulley: one that is a mesh of 24 sides is told, a cylinder is not, and neither is a rope that is dragged over a
/// flat mesh, or one that rests on the pulley.
///
/// Reference: the contract.
#[test]
fn a_rope_that_slides_over_facets_is_told() {
    let prism = |sides: u32| {
        let ring = |x: Real, k: u32| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            Vector::new(0.2 * angle.cos() as Real, 0.2 * angle.sin() as Real, x)
        };
        let corners: Vec<Vector> = (0..sides).flat_map(|k| [ring(-0.3, k), ring(0.3, k)]).collect();
        ColliderBuilder::convex_hull(&corners).unwrap()
    };
    let flat = || {
        let corner = |x: Real, z: Real| Vector::new(x, 0.0, z);
        let corners = vec![corner(-9.0, -9.0), corner(-9.0, 9.0), corner(9.0, 9.0), corner(9.0, -9.0)];
        ColliderBuilder::trimesh(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap()
    };
    let wheel = || ColliderBuilder::cylinder(0.3, 0.2).rotation(Vector::X * std::f64::consts::FRAC_PI_2 as Real);
    let is_told = |set: &CableSet, world: &PhysicsWorld| {
        let told = set.warnings(world);
        told.iter().any(|warning| format!("{warning:?}").contains("Facets"))
    };
    for (shape, masses, told) in [
        (prism(24), [3.0, 2.0], true),
        (prism(12), [1.0, 2.0], true),
        (prism(24), [2.0, 2.0], false),
        (wheel(), [3.0, 2.0], false),
    ] {
        let mut world = PhysicsWorld::new();
        world.insert(RigidBodyBuilder::fixed(), shape.friction(0.0));
        let reach = 0.205;
        let loads = [(-reach, masses[0]), (reach, masses[1])]
            .map(|(x, mass)| add_cube(&mut world, mass, 0.05, [x as Real, -1.0, 0.0]));
        let arc = (0..=12).map(|k| std::f64::consts::PI * (1.0 - f64::from(k) / 12.0));
        let arc = arc.map(|angle| Vector3::new(reach * angle.cos(), reach * angle.sin(), 0.0));
        let mut points = vec![Vector3::new(-reach, -1.0, 0.0)];
        points.extend(arc);
        points.push(Vector3::new(reach, -1.0, 0.0));
        let rope =
            Cable::builder().points(points).elements(60).section(Section::from_stiffness(1e5, 1e-3, 0.02).unwrap());
        let rope = rope.damping(Damping { axial: 1e-3, bending: 1e-2 }).fidelity(Fidelity::Game);
        let mut set = CableSet::new();
        let rope = set.insert(rope.build().unwrap());
        set.set_contact(rope, Contact::with_friction(0.0).with_radius(0.005)).unwrap();
        for (at, load) in [(At::Start, loads[0]), (At::End, loads[1])] {
            set.attach(&world, rope, at, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
        }
        run(&mut world, &mut set, 40);
        assert_eq!(is_told(&set, &world), told, "{masses:?}: {:?}", set.warnings(&world));
    }
    let mut world = PhysicsWorld::new();
    world.insert(RigidBodyBuilder::fixed(), flat().friction(0.3));
    let mut set = CableSet::new();
    let rope = cable([0.0, 0.01, 0.0], [2.0, 0.01, 0.0], soft()).elements(20).fidelity(Fidelity::Game).fix(At::End);
    let rope = set.insert(rope.build().unwrap());
    set.set_contact(rope, Contact::with_friction(0.3).with_radius(0.01)).unwrap();
    let from = Vector3::new(2.0, 0.01, 0.0);
    let pulled = Motion::hermite(0.0, 2.0, (from, Vector3::x()), (from + 2.0 * Vector3::x(), Vector3::x()));
    set.get_mut(rope).unwrap().set_motion(20, pulled).unwrap();
    run(&mut world, &mut set, 60);
    assert!(!is_told(&set, &world), "{:?}", set.warnings(&world));
}

/// A body on an impulse joint to a link of a multibody is told before the first step, and one whose joints are of one kind is not; so is a ring that an
/// impulse joint closes.
#[test]
fn joints_of_two_kinds_are_told() {
    let told = |reduced: [bool; 2], ring: bool| {
        let mut world = PhysicsWorld::new();
        let root = world.insert_body(RigidBodyBuilder::fixed());
        let bodies =
            [add_cube(&mut world, 200.0, 0.3, [1.0, 0.0, 0.0]), add_cube(&mut world, 1.0, 0.1, [2.0, 0.0, 0.0])];
        let hinge =
            || RevoluteJointBuilder::new(Vector::Z).local_anchor1(Vector::X * 0.5).local_anchor2(-Vector::X * 0.5);
        for (one, other, multibody) in [(root, bodies[0], reduced[0]), (bodies[0], bodies[1], reduced[1])] {
            match multibody {
                true => world.multibody_joints.insert(one, other, hinge(), true).map(|_| ()).unwrap(),
                false => drop(world.insert_impulse_joint(one, other, hinge())),
            }
        }
        if ring {
            let closing =
                RevoluteJointBuilder::new(Vector::Z).local_anchor1(Vector::X * 2.0).local_anchor2(Vector::ZERO);
            world.insert_impulse_joint(root, bodies[1], closing);
        }
        let mut set = CableSet::new();
        let rope = set.insert(cable([2.0, 0.0, 0.0], [2.0, 2.0, 0.0], soft()).fix(At::End).build().unwrap());
        set.attach(&world, rope, At::Start, bodies[1], Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.warnings(&world).iter().any(|warning| matches!(warning, Warning::MixedJoints { .. }))
    };
    assert!(told([true, false], false) && told([false, true], false) && told([true, true], true));
    assert!(!told([true, true], false) && !told([false, false], false) && !told([false, false], true));
}
