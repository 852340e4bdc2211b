//! Statics of cables that lie on obstacles.

use crate::bench::{RADIUS, deepest, rope, up};
use lariat_ancf::contact::{Cuboid, Cylinder, HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Contact, Error, PointLoad, Section, Vector3};
use nalgebra::UnitQuaternion;

fn with(builder: lariat_ancf::CableBuilder, obstacles: Vec<Obstacle>) -> Cable {
    let mut cable = builder.build().unwrap();
    cable.set_contact(Contact::with_friction(0.4).with_radius(RADIUS)).unwrap();
    cable.set_obstacles(obstacles).unwrap();
    cable
}

fn carried(cable: &Cable) -> f64 {
    cable.contacts().map(|touch| touch.normal_force * touch.normal.y).sum()
}

/// A mooring line from an anchor on the seabed to a fairlead has the tension, the touchdown and the reactions of the catenary, and stays at rest when it moves on.
///
/// *Source.* The catenary with touchdown, inextensible: a = H/w, suspended length `s = sqrt(h^2 + 2 h a)`, span `L - s + a asinh(s/a)`, tension at the
/// fairlead `w (a + h)` (Faltinsen, Sea Loads on Ships and Offshore Structures, 1990, chapter 8); it stretches by 1e-4.
#[test]
fn a_mooring_line_has_the_catenary_with_touchdown() {
    for (w, h, a, length, elements, radius) in [
        (1000.0, 50.0, 60.0, 200.0, 80, 0.04),
        (200.0, 20.0, 10.0, 60.0, 60, 0.02),
        (3000.0, 100.0, 300.0, 400.0, 100, 0.08),
    ] {
        let s = f64::sqrt(h * h + 2.0 * h * a);
        let span = length - s + a * f64::asinh(s / a);
        let section = Section::from_stiffness(1e4 * w * (a + h), 1.0, w / 9.81).unwrap();
        let line = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(span, h, 0.0)])
            .length(length)
            .section(section)
            .elements(elements)
            .gravity(Vector3::new(0.0, -9.81, 0.0))
            .integrator(crate::bench::steps(240.0))
            .fix(At::Start)
            .fix(At::End);
        // the centre line lies at y = 0
        let seabed = Obstacle::new(1, HalfSpace { normal: up() }, up() * -radius, 0.5);
        let mut cable = line.build().unwrap();
        cable.set_contact(Contact::with_friction(0.4).with_radius(radius)).unwrap();
        cable.set_obstacles([seabed]).unwrap();
        let report = cable.equilibrium().unwrap();
        let top = cable.sample(length).unwrap().tension;
        let anchor = cable.sample(0.0).unwrap().tension;
        let touchdown = cable.contacts().map(|touch| touch.arc_length).fold(0.0, f64::max);
        println!(
            "{w} N/m: top {top:.0} for {:.0} N, anchor {anchor:.0} for {:.0}, touchdown {touchdown:.2} for {:.2} m, carried {:.0} for {:.0} N, {report:?}",
            w * (a + h),
            w * a,
            length - s,
            carried(&cable),
            w * (length - s)
        );
        let element = length / elements as f64;
        assert!((top / (w * (a + h)) - 1.0).abs() < 5e-3, "{top}");
        assert!((anchor / (w * a) - 1.0).abs() < 1e-2, "{anchor}");
        assert!((touchdown - (length - s)).abs() < element, "{touchdown}");
        assert!((carried(&cable) / (w * (length - s)) - 1.0).abs() < 2e-2);
        let before = cable.energy().total();
        for _ in 0..30 {
            cable.step(1.0 / 60.0).unwrap();
        }
        let kinetic = cable.energy().kinetic;
        println!("moved on: kinetic {kinetic:.1e} J, energy {:.1e} J", cable.energy().total() - before);
        assert!(kinetic < 1e-6 * w * length, "{kinetic}");
    }
}

/// A rope laid on a floor, held at its ends and too long, is carried by it.
///
/// *Source.* The floor carries the weight but for what the held ends do.
#[test]
fn a_rope_lies_on_a_floor() {
    for (drop, length) in [(0.1, 1.5), (0.02, 1.2), (0.3, 2.0)] {
        let ends = [-0.5, 0.5].map(|x| Vector3::new(x, drop, 0.0));
        let floor = Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), 0.5);
        let builder = rope(1e-2, &ends, 40).length(length).fix(At::Start).fix(At::End);
        let mut cable = with(builder, vec![floor]);
        let report = cable.equilibrium().unwrap();
        let weight = 0.14 * 9.81 * length;
        let reactions = -(cable.pull(0).0.y + cable.pull(cable.nodes() - 1).0.y);
        println!("{drop}: floor {:.4}, ends {reactions:.4}, of {weight:.4} N, {report:?}", carried(&cable));
        assert!((carried(&cable) + reactions - weight).abs() < 1e-6 * weight);
        assert!(carried(&cable) > 0.2 * weight && deepest(&cable) < 0.02 * RADIUS);
    }
}

/// A rope over a drum, with a weight at one end and held at the other, has the same tension on both sides, and rests on it with the force of both.
///
/// *Source.* Frictionless capstan: T1 = T2 + w dy; the drum carries the sum.
#[test]
fn a_rope_over_a_drum_has_one_tension() {
    for (load, radius, elements) in [(50.0, 0.1, 60), (500.0, 0.2, 60), (10.0, 0.05, 80)] {
        let reach = radius + RADIUS;
        let drum = Cylinder { half_height: 0.5, radius };
        let mut drum = Obstacle::new(1, drum, Vector3::zeros(), 0.5);
        drum.motion.rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
        let arc = (0..=12).map(|i| std::f64::consts::PI * (1.0 - f64::from(i) / 12.0));
        let mut points = vec![Vector3::new(-reach, -0.5, 0.0)];
        points.extend(arc.map(|a| Vector3::new(reach * a.cos(), reach * a.sin(), 0.0)));
        points.push(Vector3::new(reach, -0.5, 0.0));
        let mut cable = with(rope(1e-4, &points, elements).fix(At::Start), vec![drum]);
        let length = cable.length();
        cable.set_loads(&[PointLoad::force(length, up() * -load)]).unwrap();
        let report = cable.equilibrium().unwrap();
        let [left, right] = [0.02, length - 0.02].map(|s| cable.sample(s).unwrap());
        let weight = 0.14 * 9.81;
        let expected = right.tension + weight * (left.position.y - right.position.y);
        let total = load + weight * length + cable.pull(0).0.y.abs();
        println!(
            "{load} N: {:.4} and {expected:.4} N, drum {:.4} of {total:.4} N, {report:?}",
            left.tension,
            carried(&cable)
        );
        assert!((left.tension / expected - 1.0).abs() < 5e-3, "{} {expected}", left.tension);
        assert!((carried(&cable) / total - 1.0).abs() < 1e-2);
    }
}

/// A rope that hangs onto the edge of a box, which no sample sees, is refused with the obstacle; the cable is then as before.
///
/// *Source.* The contract.
#[test]
fn what_statics_cannot_see_is_refused() {
    let ends = [Vector3::new(-0.5, 0.0, 0.0), Vector3::new(0.5, 0.0, 0.0)];
    let tilted = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.785);
    let half = Vector3::new(0.1, 0.1, 0.4);
    let mut edge = Obstacle::new(7, Cuboid { half_extents: half }, Vector3::new(0.03, -0.35, 0.0), 0.5);
    edge.motion.rotation = tilted;
    let mut cable = with(rope(1e-3, &ends, 8).length(1.2).fix(At::Start).fix(At::End), vec![edge]);
    let before = cable.positions().to_vec();
    match cable.equilibrium() {
        Err(Error::NoEquilibrium { failure, .. }) => assert!(failure.to_string().contains("obstacle 7"), "{failure}"),
        other => panic!("{other:?}"),
    }
    assert_eq!(cable.positions(), before);
}
