//! What is told of cables that pass through what they can touch, and of those that do not.

use crate::bench::{RADIUS, rope, steps, up, with};
use crate::bodies::World;
use lariat_ancf::contact::{Capsule, Cuboid, Cylinder, Obstacle, RigidMotion};
use lariat_ancf::warning::{Passage, Through};
use lariat_ancf::{At, Cable, Contact, Motion, PointLoad, Support, Vector3, Warning};
use nalgebra::UnitQuaternion;

fn passage(cable: &Cable) -> Option<Passage> {
    let passed = |w: &Warning| matches!(w, Warning::PassedThrough { .. });
    let warning = cable.warnings().into_iter().find(passed)?;
    let Warning::PassedThrough { first, steps, .. } = &warning else { return None };
    assert_eq!(*steps, cable.diagnostics().crossed_steps);
    let first = first.clone().expect("the first passage is known");
    assert!(warning.to_string().contains(&format!("through {}", first.through)), "{warning}");
    Some(first)
}

/// Contact that holds nothing.
fn soft() -> Contact {
    Contact { stiffness: Some(1.0), ..Contact::default().with_radius(RADIUS) }
}

/// A cable that is tied to a body where the core of a feature ends or lies, and does not touch it
/// there, passes through nothing while both move, whatever the length of its elements.
///
/// *Source.* Geometry: the cable moves away from the body from its first point on.
#[test]
fn a_cable_that_is_tied_to_a_body_passes_through_nothing() {
    let half = 0.5;
    let cylinder = Obstacle::new(3, Cylinder { half_height: half, radius: 0.2 }, Vector3::zeros(), 0.3);
    let rod = Capsule { ends: [-half * up(), half * up()], radius: 0.002 };
    let rod = Obstacle::new(3, rod, Vector3::zeros(), 0.3);
    let block = Cuboid { half_extents: Vector3::new(0.2, half, 0.3) };
    let block = Obstacle::new(3, block, Vector3::zeros(), 0.3);
    for (name, shape, beside) in [("cylinder", cylinder, 0.0), ("rod", rod, 0.0), ("block", block, 0.2)] {
        for elements in [4, 12] {
            let rotation = UnitQuaternion::from_euler_angles(0.3, 0.2, 0.1);
            let anchor = Vector3::new(0.31, 0.17, -0.23);
            let (velocity, position) =
                (Vector3::new(0.7, 0.1, -0.3), anchor - rotation * Vector3::new(beside, -half, 0.0));
            let away = rotation * Vector3::new(0.6 + beside, -0.8, 0.3);
            let cable = rope(0.01, &[anchor, anchor + away], elements).velocity(velocity);
            let mut cable = cable.build().unwrap();
            let start = Some(Motion::uniform(0.0, anchor, velocity));
            cable.set_support(At::Start, Support { position: start, ..Support::default() }).unwrap();
            let motion = RigidMotion { rotation, velocity, ..RigidMotion::at(position) };
            let body = Obstacle { except: vec![[0.0, 4.0 * RADIUS]], ..shape.clone().moving(motion) };
            let mut cable = with(cable, vec![body]);
            for _ in 0..60 {
                cable.step(1.0 / 60.0).unwrap();
            }
            let d = cable.diagnostics();
            println!("{name}, {elements} elements: {} steps crossed, {} divided", d.crossed_steps, d.split_steps);
            assert_eq!(passage(&cable), None, "{name}, {elements} elements");
        }
    }
}

/// A rope that a load draws through a thin rod, because its contact is soft, says so, with the key
/// of the rod and the place.
///
/// *Source.* Geometry: the rod crosses the middle of the rope.
#[test]
fn a_rope_that_a_load_draws_through_a_rod_says_where() {
    let ends = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
    let cable = rope(0.01, &ends, 10).fix(At::Start).fix(At::End).build().unwrap();
    let (at, top) = (1.02, -0.05);
    let rod = Capsule { ends: [Vector3::new(at, top, -1.0), Vector3::new(at, top, 1.0)], radius: 0.002 };
    let mut cable = with(cable, vec![Obstacle::new(3, rod, Vector3::zeros(), 0.3)]);
    cable.set_contact(soft()).unwrap();
    cable.add_load(PointLoad::force(1.0, up() * -5e3)).unwrap();
    for _ in 0..60 {
        cable.step(1.0 / 60.0).unwrap();
    }
    let Passage { time_s, arc_length_m, through } = passage(&cable).unwrap();
    println!("{time_s} s, {arc_length_m} m, {through}");
    assert_eq!(through, Through::Obstacle(3));
    assert!((arc_length_m - at).abs() < 0.01 && 0.0 < time_s && time_s < 1.0, "{time_s} s, {arc_length_m} m");
}

/// Of two ropes that pass through each other each names the other one.
///
/// *Source.* Geometry: they cross at their middles.
#[test]
fn ropes_that_pass_through_each_other_name_each_other() {
    let line = |name: &str, at: Vector3<f64>, along: Vector3<f64>, velocity: Vector3<f64>| {
        let ends = [at - 0.1 * along, at + 0.1 * along];
        let bar = rope(10.0, &ends, 2).name(name).velocity(velocity).gravity(Vector3::zeros());
        let mut bar = bar.build().unwrap();
        bar.set_contact(soft().with_cables()).unwrap();
        bar
    };
    let below = line("below", Vector3::zeros(), Vector3::x(), Vector3::zeros());
    let above = line("above", up() * 0.02 + Vector3::x() * 0.013, Vector3::z(), -up());
    let mut world = World::new(vec![below, above], vec![]);
    world.integrator = steps(240.0);
    world.run(6, |_| {});
    for (k, (other, at)) in [("above", 0.113), ("below", 0.1)].into_iter().enumerate() {
        let first = passage(&world.cables[k]).unwrap();
        assert_eq!(first.through, Through::Cable(other.into()));
        assert!((first.arc_length_m - at).abs() < 1e-3, "{first:?}");
    }
}
