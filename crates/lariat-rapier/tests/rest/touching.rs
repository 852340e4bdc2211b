//! Worlds in which bodies rest on others, and cables on cables.

use super::{G, moves};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Contact, PointLoad, Section, Strength, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Error};

fn world_with_floor() -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, -9.81, 0.0);
    let floor = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.5, 0.0));
    world.insert(floor, ColliderBuilder::cuboid(50.0, 0.5, 50.0).friction(0.6));
    world
}

fn rope(from: Vector3<f64>, to: Vector3<f64>, axial: f64) -> lariat_rapier::lariat_ancf::CableBuilder {
    let section = Section::from_stiffness(axial, 0.05, 0.2).unwrap();
    Cable::builder().points([from, to]).section(section).elements(12).fix(At::Start)
}

/// Returns the force in N, upwards, of the supports of a cable.
fn held(set: &CableSet, cable: CableHandle) -> f64 {
    let reactions = set.get(cable).unwrap().clone().reactions().unwrap();
    reactions.iter().map(|reaction| reaction.force.y).sum()
}

/// A plank with a foot that stands on the floor hangs at its other end from a rope that is drawn
/// vertical: the rope carries its share of the weight by the law of the lever, whatever plank and
/// rope weigh, and its pull does not change when the world is stepped.
///
/// *Source.* Moments about the foot: T (a + b) = W a, with a and b the distances of the centre of
/// mass from foot and rope, and the rope vertical.
#[test]
fn a_plank_rests_on_its_foot_and_a_rope() {
    for (mass, centre, axial) in [(20.0, 0.0, 1e5), (3.0, -0.4, 1e4), (400.0, 0.5, 1e6)] {
        let mut world = world_with_floor();
        let plank = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.1, 0.0)).build();
        let plank = world.insert_body(plank);
        let foot = ColliderBuilder::ball(0.1).density(0.0).translation(Vector::new(-1.0, 0.0, 0.0)).friction(0.6);
        world.insert_collider(foot, Some(plank));
        let inertia = Vector::new(0.1, 1.0, 1.0) * (mass as Real) / 3.0;
        let properties = MassProperties::new(Vector::new(centre as Real, 0.0, 0.0), mass as Real, inertia);
        world.bodies[plank].set_additional_mass_properties(properties, true);
        let mut set = CableSet::new();
        let line = rope(Vector3::new(1.0, 3.1, 0.0), Vector3::new(1.0, 0.1, 0.0), axial);
        let cable = set.insert(line.build().unwrap());
        let eye = Vector3::new(1.0, 0.0, 0.0);
        let held = set.attach(&world, cable, At::End, plank, eye, AttachmentKind::Ball).unwrap();
        let found = set.equilibrium(&mut world).unwrap();
        let relaxed = found.relaxed.expect("statics have no law for the foot");
        assert!(found.is_stable() && found.moved == [plank] && relaxed.way < 1e-5, "{found:?}");
        let lever = mass * G * (1.0 + centre) / 2.0;
        let force = set.attachment(held).unwrap().force();
        let pull = force.norm();
        println!("{mass} kg: {pull:.4} N, lever {lever:.4} N, {relaxed:?}");
        assert!((pull / lever - 1.0).abs() < 2e-3, "{mass} kg: {pull} N, not {lever} N");
        assert_eq!(set.get(cable).unwrap().time(), 0.0);
        assert!(moves(&mut world, &mut set, plank) < 1e-4);
    }
}

/// A box that stands under a slack rope keeps it slack, and one on another box that hangs stays on
/// it: ropes carry their own weight, and that of both boxes.
///
/// *Source.* Balance of forces on boxes and rope.
#[test]
fn boxes_stand_on_a_floor_and_on_each_other() {
    let mut world = world_with_floor();
    let load = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.2, 0.0));
    let (load, _) = world.insert(load, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(10.0));
    let upper = RigidBodyBuilder::dynamic().translation(Vector::new(0.02, 0.55, 0.01));
    let (upper, _) = world.insert(upper, ColliderBuilder::cuboid(0.15, 0.15, 0.15).mass(4.0));
    let mut set = CableSet::new();
    let slack = rope(Vector3::new(1.0, 1.0, 0.0), Vector3::new(0.2, 0.2, 0.0), 1e5).length(2.0);
    let cable = set.insert(slack.build().unwrap());
    set.attach(&world, cable, At::End, load, Vector3::new(0.2, 0.0, 0.0), AttachmentKind::Ball).unwrap();
    let found = set.equilibrium(&mut world).unwrap();
    assert!(found.relaxed.is_some() && found.moved.len() == 2, "{found:?}");
    let force: f64 = set.attachments().map(|(_, a)| a.force().y).sum();
    let held = held(&set, cable);
    println!("{:?}: {force} and {held} N", found.relaxed);
    let weight = 2.0 * 0.2 * G;
    assert!((held / weight - 1.0).abs() < 1e-3, "{held} N, not {weight} N");
    assert!(-weight < force && force < 0.0, "the box carries a part: {force} N");
    let top = world.bodies[upper].translation().y;
    assert!((top - 0.55).abs() < 2e-3, "{top}");
    assert!(moves(&mut world, &mut set, upper) < 1e-4);
}

/// A rope that is drawn across another one, which is taut, lies on it: it does not pass through it,
/// all ends together carry the weight of both, and the world then stands, as does the one that comes
/// to rest in a run of its own with damping.
///
/// *Source.* Balance of forces; the same world, stepped for 100 s.
#[test]
fn a_rope_rests_on_another() {
    let build = |damped: bool| {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -9.81, 0.0);
        let mut set = CableSet::new();
        let contact = Contact { cables: true, ..Contact::with_friction(0.0).with_radius(0.01) };
        let mut add = |points: &[[f64; 3]], slack: f64| {
            let points: Vec<Vector3<f64>> = points.iter().map(|&x| Vector3::from(x)).collect();
            let way: f64 = points.windows(2).map(|x| (x[1] - x[0]).norm()).sum();
            let mut line = rope(points[0], points[1], 2e4).points(points).length(way * slack).fix(At::End);
            if damped {
                line = line.damping(lariat_rapier::lariat_ancf::Damping { axial: 0.02, bending: 0.05 });
            }
            let cable = set.insert(line.build().unwrap());
            set.set_contact(cable, contact).unwrap();
            cable
        };
        let low = add(&[[-1.0, 0.0, 0.05], [1.0, 0.0, -0.02]], 0.999);
        let high = add(&[[0.1, 0.1, -1.0], [0.0, 0.4, 0.0], [-0.05, 0.1, 1.0]], 1.0);
        world.integration_parameters.dt = 1.0 / 60.0;
        (world, set, low, high)
    };
    let (mut world, mut set, low, high) = build(false);
    let found = set.equilibrium(&mut world).unwrap();
    println!("{:?}", found.relaxed);
    assert!(found.relaxed.is_some(), "{found:?}");
    let weight: f64 = [low, high].iter().map(|&cable| 0.2 * G * set.get(cable).unwrap().length()).sum();
    let held = held(&set, low) + held(&set, high);
    assert!((held / weight - 1.0).abs() < 2e-3, "{held} N, {weight} N");
    let (mut other, mut others, _, _) = build(true);
    (0..6000).for_each(|_| others.step(&mut other).unwrap());
    let middle = |set: &CableSet, cable: CableHandle| {
        let cable = set.get(cable).unwrap();
        cable.sample(0.5 * cable.length()).unwrap().position
    };
    for cable in [low, high] {
        let apart = (middle(&set, cable) - middle(&others, cable)).norm();
        assert!(apart < 2e-3, "{apart} m");
    }
    let at = middle(&set, high);
    (0..120).for_each(|_| set.step(&mut world).unwrap());
    assert!((middle(&set, high) - at).norm() < 1e-4);
}

/// What came to rest by its motion has its clock, its loads with their ramps, its strength and its
/// integrator as before, and does not break on the way.
///
/// *Source.* The contract.
#[test]
fn a_relaxation_leaves_clock_loads_and_strength() {
    let mut world = world_with_floor();
    let load = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.2, 0.0));
    let (load, _) = world.insert(load, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(10.0));
    let mut set = CableSet::new();
    let slack = rope(Vector3::new(0.0, 2.0, 0.0), Vector3::new(0.0, 0.4, 0.0), 1e5).length(2.0);
    let mut slack = slack.build().unwrap();
    let force = Vector3::new(0.5, 0.0, 0.0);
    slack.add_load(PointLoad { arc_length: 1.0, force, ramp: 2.0, ..PointLoad::default() }).unwrap();
    let cable = set.insert(slack);
    // less than it pulls on the way, more than at rest
    set.set_strength(cable, Strength::from(5.0)).unwrap();
    set.attach(&world, cable, At::End, load, Vector3::new(0.0, 0.2, 0.0), AttachmentKind::Ball).unwrap();
    let before = set.get(cable).unwrap().clone();
    let found = set.equilibrium(&mut world).unwrap();
    assert!(found.relaxed.is_some());
    let after = set.get(cable).unwrap();
    assert_eq!((after.time(), after.strength(), after.integrator()), (0.0, before.strength(), before.integrator()));
    assert_eq!(after.loads(), before.loads());
    assert!(after.velocities().iter().all(|v| *v == 0.0) && set.iter().count() == 1);
}

/// A world in which something falls for ever, or moves as prescribed, is refused, and stays as it
/// is.
///
/// *Source.* The contract.
#[test]
fn what_never_rests_is_refused() {
    let mut world = world_with_floor();
    let load = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.2, 0.0));
    let (load, _) = world.insert(load, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(10.0));
    let mut set = CableSet::new();
    let slack = rope(Vector3::new(0.0, 2.0, 0.0), Vector3::new(0.0, 0.4, 0.0), 1e5).length(2.0);
    let cable = set.insert(slack.build().unwrap());
    set.attach(&world, cable, At::End, load, Vector3::new(0.0, 0.2, 0.0), AttachmentKind::Ball).unwrap();
    let falls = RigidBodyBuilder::dynamic().translation(Vector::new(100.0, 0.0, 0.0));
    let (falls, _) = world.insert(falls, ColliderBuilder::ball(0.1).mass(1.0));
    let before = (set.get(cable).unwrap().positions().to_vec(), vector(world.bodies[falls].translation()));
    let error = set.equilibrium(&mut world).unwrap_err();
    assert!(matches!(error, Error::ContactInStatics { body, .. } if body == load), "{error}");
    assert_eq!(before, (set.get(cable).unwrap().positions().to_vec(), vector(world.bodies[falls].translation())));
}

/// Two boxes on a floor or above it, joined by a slack rope that nothing else holds: they come to stand on the floor, the rope hangs between
/// them, and each carries half of it.
///
/// *Source.* The sag of a shallow parabola, s^2 = 3/8 d (l - d), with its distance d and length l; balance of forces.
#[test]
fn boxes_that_only_a_rope_joins_stand_on_the_floor() {
    for (height, mass, slack) in [
        (0.0, 1000.0, 0.02),
        (0.0, 30.0, 0.02),
        (1e-3, 1000.0, 0.02),
        (-1e-3, 200.0, 0.02),
        (0.3, 1000.0, 0.02),
        (3.0, 50.0, 0.01),
    ] {
        let mut world = world_with_floor();
        let mut add = |x: f64| {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, (0.5 + height) as Real, 0.0));
            world.insert(body, ColliderBuilder::cuboid(1.0, 0.5, 0.8).mass(mass as Real).friction(0.6)).0
        };
        let boxes = [add(0.0), add(6.0)];
        let mut set = CableSet::new();
        let [from, to] = [1.0, 5.0].map(|x| Vector3::new(x, 0.5 + height, 0.0));
        let section = Section::from_stiffness(1e6, 0.05, 0.2).unwrap();
        let line = Cable::builder().points([from, to]).section(section).elements(12).length(4.0 * (1.0 + slack));
        let cable = set.insert(line.build().unwrap());
        for (at, body) in [(At::Start, boxes[0]), (At::End, boxes[1])] {
            set.attach_here(&world, cable, at, body, AttachmentKind::Ball).unwrap();
        }
        let found = set.equilibrium(&mut world).unwrap();
        let middle = set.get(cable).unwrap().sample(2.0 * (1.0 + slack)).unwrap().position.y;
        let sag = f64::from(world.bodies[boxes[0]].translation().y) - middle;
        // the rope draws the boxes a little nearer before friction holds them
        let [one, two] = boxes.map(|body| f64::from(world.bodies[body].translation().x));
        let distance = two - one - 2.0;
        let parabola = (0.375 * distance * (4.0 * (1.0 + slack) - distance)).sqrt();
        let half = 0.5 * 0.2 * G * 4.0 * (1.0 + slack);
        let told = format!("{height} m, {mass} kg: sag {sag:.4} m, parabola {parabola:.4} m, {:?}", found.relaxed);
        println!("{told}");
        assert!(found.relaxed.is_some() && found.moved == boxes, "{told}");
        assert!((sag / parabola - 1.0).abs() < 0.02, "{told}");
        for body in boxes {
            assert!((world.bodies[body].translation().y - 0.5).abs() < 2e-3, "{told}");
        }
        for (_, attachment) in set.attachments() {
            assert!(
                (attachment.force().y / -half - 1.0).abs() < 5e-3,
                "{told}: {} N, half {half} N",
                attachment.force().y
            );
        }
        assert!(moves(&mut world, &mut set, boxes[0]) < 1e-3, "{told}");
    }
}

/// A box on a rope that is slack enough to hang it below a plate over which it is drawn comes to lie on the plate, however thin that is.
///
/// *Source.* The plate holds the box.
#[test]
fn a_box_lies_on_what_is_below_it() {
    for (height, thickness, mass) in [(0.1, 0.2, 500.0), (0.3, 0.05, 20.0), (0.5, 1.0, 500.0)] {
        let mut world = PhysicsWorld::new();
        let plate = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.5 * thickness as Real, 0.0));
        world.insert(plate, ColliderBuilder::cuboid(20.0, 0.5 * thickness as Real, 20.0).friction(0.6));
        let load = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, (0.5 + height) as Real, 0.0));
        let (load, _) = world.insert(load, ColliderBuilder::cuboid(0.5, 0.5, 0.5).mass(mass as Real).friction(0.6));
        let mut set = CableSet::new();
        let line = rope(Vector3::new(2.0, 3.0 + height, 0.0), Vector3::new(0.0, 1.0 + height, 0.0), 1e5).length(6.0);
        let cable = set.insert(line.build().unwrap());
        set.attach_here(&world, cable, At::End, load, AttachmentKind::Ball).unwrap();
        let found = set.equilibrium(&mut world).unwrap();
        let y = world.bodies[load].translation().y;
        println!("{height} m over {thickness} m: {y} m, {:?}", found.relaxed);
        assert!(found.relaxed.is_some() && (y - 0.5).abs() < 2e-3, "{y} m, {found:?}");
    }
}

/// Boxes that a rope joins, over nothing and beside a floor: the error names them, not the rope alone, and all stays as it is.
///
/// *Source.* The contract.
#[test]
fn boxes_that_nothing_holds_are_named() {
    for beside in [false, true] {
        let mut world = PhysicsWorld::new();
        if beside {
            let floor = RigidBodyBuilder::fixed().translation(Vector::new(20.0, -0.5, 0.0));
            world.insert(floor, ColliderBuilder::cuboid(5.0, 0.5, 5.0));
        }
        let mut add = |x: Real| {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.5, 0.0));
            world.insert(body, ColliderBuilder::cuboid(0.5, 0.5, 0.5).mass(10.0)).0
        };
        let boxes = [add(0.0), add(3.0)];
        let mut set = CableSet::new();
        let line = Cable::builder().points([Vector3::new(0.5, 0.5, 0.0), Vector3::new(2.5, 0.5, 0.0)]);
        let section = Section::from_stiffness(1e5, 0.05, 0.2).unwrap();
        let cable = set.insert(line.section(section).length(2.1).name("tow").build().unwrap());
        for (at, body) in [(At::Start, boxes[0]), (At::End, boxes[1])] {
            set.attach_here(&world, cable, at, body, AttachmentKind::Ball).unwrap();
        }
        let before = *world.bodies[boxes[0]].position();
        let error = set.equilibrium(&mut world).unwrap_err();
        println!("{error}");
        assert!(matches!(&error, Error::NotHeldInStatics { bodies, cables } if *bodies == boxes && *cables == ["tow"]));
        assert_eq!(*world.bodies[boxes[0]].position(), before);
    }
}
