//! Statics of cables that lie on obstacles.

use crate::bench::{RADIUS, deepest, rope, up};
use lariat_ancf::contact::{Cuboid, Cylinder, HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Contact, Drag, Error, Flow, PointLoad, Section, Vector3, Warning};
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
        // Coulomb: friction holds at most mu times the weight that lies
        let bound = cable.friction_bound() / (0.5 * w * (length - s));
        assert!((bound - 1.0).abs() < 3e-2, "{bound}");
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
        // Euler and Eytelwein: friction of 0.5 holds T (exp(mu theta) - 1), here on half a turn
        let (bound, most) = (cable.friction_bound(), load * ((0.5 * std::f64::consts::PI).exp() - 1.0));
        println!("friction holds {bound:.3} N, the capstan {most:.3} N");
        assert!(bound > 0.95 * most && bound < 1.05 * (most + 8.0 * weight * length), "{bound} N of {most}");
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

/// The mooring line of these tests, from an anchor at the origin on a seabed to a fairlead 186 m
/// above it: 850 m of chain.
mod mooring {
    pub const LENGTH: f64 = 850.0;
    pub const HEIGHT: f64 = 186.0;
    pub const STIFFNESS: f64 = 7.536e8;
    pub const MASS: f64 = 113.35;
    pub const RADIUS: f64 = 0.05;
}

fn mooring_line(span: f64, elements: usize) -> Cable {
    use mooring::*;
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(span, HEIGHT, 0.0)])
        .length(LENGTH)
        .section(Section::from_stiffness(STIFFNESS, 0.0, MASS).unwrap())
        .elements(elements)
        .gravity(Vector3::new(0.0, -9.81, 0.0))
        .integrator(crate::bench::steps(200.0))
        .fix(At::Start)
        .fix(At::End)
        .build()
        .unwrap();
    cable.set_contact(Contact::with_friction(0.0).with_radius(RADIUS)).unwrap();
    cable.set_obstacles([Obstacle::new(1, HalfSpace { normal: up() }, up() * -RADIUS, 0.0)]).unwrap();
    cable
}

/// Tension at the fairlead in N of the elastic catenary on a seabed without friction: `x = L - s +
/// H L/EA + a asinh(s/a)`, `h = a (sqrt(1 + s^2/a^2) - 1) + w s^2/(2 EA)`, a = H/w, s the length
/// that hangs.
fn catenary(span: f64) -> f64 {
    use mooring::*;
    let w = MASS * 9.81;
    let hanging = |force: f64| {
        let a = force / w;
        let height = |s: f64| a * ((1.0 + (s / a).powi(2)).sqrt() - 1.0) + w * s * s / (2.0 * STIFFNESS);
        root(|s| height(s) - HEIGHT, 0.0, LENGTH)
    };
    let reach = |force: f64| {
        let (s, a) = (hanging(force), force / w);
        LENGTH - s + LENGTH * force / STIFFNESS + a * f64::asinh(s / a)
    };
    let force = root(|force| reach(force) - span, 1.0, 1e7);
    force.hypot(w * hanging(force))
}

/// The root of a function that grows.
fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Largest displacement in m of a node in 10 s of motion.
fn moves(cable: &mut Cable) -> f64 {
    let start = cable.positions().to_vec();
    for _ in 0..200 {
        cable.step(0.05).unwrap();
    }
    let moved = cable.positions().chunks_exact(6).zip(start.chunks_exact(6));
    moved.map(|(a, b)| (0..3).map(|x| (a[x] - b[x]).powi(2)).sum::<f64>().sqrt()).fold(0.0, f64::max)
}

/// A mooring line on its seabed is found at every offset and mesh, with the tension of the elastic
/// catenary; a bulge between samples of a coarse mesh is a warning with the number of elements that
/// would do, and not an error. It stays at rest.
///
/// *Source.* The elastic catenary with touchdown (Jonkman, NREL/TP-500-41958, 2007, section 2.6.2).
#[test]
fn a_mooring_line_has_the_tension_of_the_elastic_catenary_at_any_offset_and_mesh() {
    let mut told = [0; 3];
    for span in [740.0, 755.0, 770.0, 780.0, 790.0] {
        for (k, elements) in [25, 50, 100].into_iter().enumerate() {
            let mut cable = mooring_line(span, elements);
            let report = cable.equilibrium().unwrap_or_else(|e| panic!("{span} {elements}: {e}"));
            let top = cable.pull(elements).0.norm();
            let error = top / catenary(span) - 1.0;
            let sinks =
                cable.warnings().iter().any(|w| matches!(w, Warning::Sinks { enough, .. } if *enough > elements));
            told[k] += usize::from(sinks);
            let moved = moves(&mut cable);
            println!(
                "{span} m, {elements}: {top:.0} N, error {error:.1e}, sinks {sinks}, moves {moved:.1e} m, {report:?}"
            );
            assert!(error.abs() < 1e-3, "{span} {elements}: {error}");
            assert!(moved < 1e-6, "{span} {elements}: {moved}");
        }
    }
    println!("told {told:?}");
    assert!(told[0] > 0 && told[2] == 0, "{told:?}");
}

/// At 100 offsets, with 20 to 160 elements, the line is found; where the touchdown is so sharp that its mesh does not resolve it, a warning tells by
/// how much the tension is off, with a mesh that is right.
///
/// *Source.* As above. What is told is bounded by the warning, and the rest by less than the share from which it tells.
#[test]
fn a_mooring_line_is_right_at_a_hundred_offsets_or_tells() {
    let mut advised = 0;
    for elements in [20, 27, 40, 80, 160] {
        let (mut right, mut told) = (0.0f64, 0);
        for k in 0..100 {
            let span = 700.0 + 97.0 * f64::from(k) / 99.0;
            let mut cable = mooring_line(span, elements);
            cable.equilibrium().unwrap_or_else(|e| panic!("{span} {elements}: {e}"));
            let error = (cable.pull(elements).0.norm() / catenary(span) - 1.0).abs();
            let share = cable.warnings().into_iter().find_map(|warning| match warning {
                Warning::CoarseTouchdown { share, enough, .. } => Some((share, enough)),
                _ => None,
            });
            let Some((share, enough)) = share else {
                right = right.max(error);
                continue;
            };
            assert!(error < share, "{span} {elements}: {error} for {share}");
            told += 1;
            if k % 10 == 0 {
                let mut fine = mooring_line(span, enough);
                fine.equilibrium().unwrap();
                let left = (fine.pull(enough).0.norm() / catenary(span) - 1.0).abs();
                assert!(left < 2e-3, "{span} {enough}: {left}");
                advised += 1;
            }
        }
        println!("{elements}: told {told}, others within {right:.1e}");
        assert!(right < 1.5e-3, "{elements}: {right}");
        assert!(elements < 160 || told == 0 && right < 1e-3);
    }
    assert!(advised > 5, "{advised}");
}

/// A mooring line on its seabed comes to rest in a current across and along it, is carried by bed,
/// anchor and fairlead against weight and drag, and motion, whose drag and contacts are computed
/// otherwise, leaves it where it is.
///
/// *Source.* Newton's first law, for the whole and for each node.
#[test]
fn a_mooring_line_rests_on_its_seabed_in_a_current() {
    for (flow, elements) in
        [([0.0, 0.0, 1.0], 40), ([1.5, 0.0, 0.0], 40), ([-1.0, 0.0, 1.0], 80), ([0.3, 0.0, 2.0], 20)]
    {
        let mut cable = mooring_line(770.0, elements);
        let still = {
            let mut still = cable.clone();
            still.equilibrium().unwrap();
            still.positions().to_vec()
        };
        let drag = Drag::new(1025.0, 1.2, 0.05, Flow::uniform(Vector3::from(flow)));
        let section = Section { diameter: Some(0.153), ..cable.elements()[0].section };
        cable = {
            let mut other = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(770.0, mooring::HEIGHT, 0.0)])
                .length(mooring::LENGTH)
                .section(section)
                .elements(elements)
                .gravity(cable.gravity())
                .integrator(cable.integrator())
                .fix(At::Start)
                .fix(At::End)
                .build()
                .unwrap();
            other.set_contact(cable.effects().contact).unwrap();
            other.set_obstacles(cable.obstacles().to_vec()).unwrap();
            other.set_drag(drag).unwrap();
            other
        };
        let report = cable.equilibrium().unwrap();
        let w = mooring::MASS * 9.81;
        let moved_by_flow = cable.positions().iter().zip(&still).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let bed = carried(&cable);
        let moved = moves(&mut cable);
        println!(
            "{flow:?} {elements}: {moved_by_flow:.2} m by the flow, bed {bed:.0} N, moves {moved:.1e} m, {report:?}"
        );
        assert!(report.stable && report.residual < 1e-8 * w * mooring::LENGTH);
        assert!(moved_by_flow > 0.05 && bed > 0.1 * w * mooring::LENGTH, "{moved_by_flow} {bed}");
        assert!(moved < 1e-6, "{moved}");
    }
}
