//! Clamps hold the directions that were drawn or given, never that of the arc in which a slack cable is laid.

mod common;

use common::rod::stretch;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, CableBuilder, Error, Section, SlopeSupport, Vector3};

/// A heavy extensible rod between two clamps, by shooting; nothing here uses the crate under test.
///
/// *Source.* The planar rod of `common/rod.rs` with its weight: `n(s) = n(0) + w s e_y`, `M' = -f (n.nu)`, by the classical
/// Runge-Kutta method in 2000 steps, force and moment at the start by Newton's method with differences.
struct Clamped {
    axial: f64,
    bending: f64,
    weight: f64,
    length: f64,
    /// Angles of the tangents in rad.
    angles: [f64; 2],
    span: f64,
}

impl Clamped {
    /// x, y, angle and moment at the end, of the force (N) and moment (N m) that the section carries at the start.
    fn shoot(&self, [fx, fy, m0]: [f64; 3]) -> [f64; 4] {
        let rate = |s: f64, [_, _, angle, m]: [f64; 4]| {
            let fy = fy + self.weight * s;
            let (sin, cos) = angle.sin_cos();
            let f = stretch(self.axial, fx * cos + fy * sin, m * m / self.bending);
            [f * cos, f * sin, m * f * f / self.bending, -f * (fy * cos - fx * sin)]
        };
        let steps = 2000;
        let h = self.length / f64::from(steps);
        let plus = |y: [f64; 4], k: [f64; 4], h: f64| core::array::from_fn(|i| y[i] + h * k[i]);
        (0..steps).fold([0.0, 0.0, self.angles[0], m0], |y, i| {
            let s = h * f64::from(i);
            let k1 = rate(s, y);
            let k2 = rate(s + 0.5 * h, plus(y, k1, 0.5 * h));
            let k3 = rate(s + 0.5 * h, plus(y, k2, 0.5 * h));
            let k4 = rate(s + h, plus(y, k3, h));
            core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
        })
    }

    /// Force and moment of the section at the start, from a guess of them.
    fn solve(&self, mut x: [f64; 3]) -> [f64; 3] {
        let miss = |x: [f64; 3]| {
            let [a, b, angle, _] = self.shoot(x);
            Vector3::new((a - self.span) / self.length, b / self.length, angle - self.angles[1])
        };
        let unit = self.bending / self.length.powi(2);
        let units = [unit, unit, unit * self.length];
        let mut at = miss(x);
        for _ in 0..200 {
            let mut jacobian = nalgebra::Matrix3::zeros();
            for k in 0..3 {
                let mut beside = x;
                beside[k] += 1e-6 * units[k];
                jacobian.set_column(k, &((miss(beside) - at) / 1e-6));
            }
            let step = jacobian.lu().solve(&at).expect("regular");
            let mut share = 1.0;
            loop {
                let next: [f64; 3] = core::array::from_fn(|k| x[k] - share * units[k] * step[k]);
                let trial = miss(next);
                if trial.norm() < at.norm() || share < 1e-6 {
                    (x, at) = (next, trial);
                    break;
                }
                share *= 0.5;
            }
            if at.norm() < 1e-12 {
                break;
            }
        }
        assert!(at.norm() < 1e-9, "shooting ended {at:?} off");
        x
    }
}

/// The rubber tube of `angles` at its clamps, drawn along the line between them with so many points.
fn tube(points: usize, elements: usize, angles: [f64; 2]) -> (CableBuilder, Clamped) {
    let section = Section::tube(0.012, 0.008, 5e6, 1100.0).unwrap();
    let along = |angle: f64| Vector3::new(angle.cos(), angle.sin(), 0.0);
    let line = (0..points).map(|i| Vector3::new(0.7 * i as f64 / (points - 1) as f64, 0.0, 0.0));
    let builder = Cable::builder().points(line).length(1.0).elements(elements).section(section);
    let ends = [At::Start, At::End].into_iter().zip(angles);
    let builder = ends.fold(builder, |builder, (at, angle)| match angle {
        0.0 => builder.clamp(at),
        _ => builder.clamp_along(at, 3.0 * along(angle)),
    });
    let (axial, bending) = (section.axial_stiffness, section.bending_stiffness);
    let weight = section.mass_per_length * 9.81;
    (builder, Clamped { axial, bending, weight, length: 1.0, angles, span: 0.7 })
}

/// A slack tube between clamps that are level, or turned, has the forces and moments of the elastica between them, however it is drawn.
///
/// *Source.* [`Clamped`]. Of the level clamps the issue gives H = -0.0570 N and M = -0.0495 N m.
#[test]
fn a_slack_tube_between_clamps_is_the_elastica_however_it_is_drawn() {
    for angles in [[0.0, 0.0], [-0.5, 0.3], [-1.0, 1.0], [0.4, 0.0]] {
        let mut of_drawing: Vec<[f64; 3]> = Vec::new();
        for points in [2, 5, 41] {
            let (builder, reference) = tube(points, 80, angles);
            let mut cable = builder.build().unwrap();
            let start = cable.reactions().unwrap()[0];
            // the support bears what the section does, with the other sign
            let found = [-start.force.x, -start.force.y, -start.moment.z];
            let right = reference.solve(found);
            println!("{angles:?}, {points} points: {found:.6?} against {right:.6?}");
            for k in 0..3 {
                let unit = reference.bending;
                assert!((found[k] - right[k]).abs() < 1e-4 * unit.max(right[k].abs()), "{found:?} {right:?}");
            }
            if angles == [0.0, 0.0] {
                // by an elastica that does not stretch; this one does, by 1e-3
                assert!((found[0] + 0.0570).abs() < 3e-4 && (found[2] + 0.0495).abs() < 1e-4, "{found:?}");
            }
            for (at, angle) in [(0.0, angles[0]), (1.0, angles[1])] {
                let slope = cable.sample(at).unwrap().slope;
                assert!((slope.y.atan2(slope.x) - angle).abs() < 1e-14);
            }
            of_drawing.push(found);
        }
        for other in &of_drawing[1..] {
            (0..3).for_each(|k| assert!((other[k] - of_drawing[0][k]).abs() < 1e-6));
        }
    }
}

/// What is attached with its tangent as it was laid holds the direction of the drawing, and so does a clamp made after building.
#[test]
fn an_end_that_is_clamped_after_building_holds_the_drawn_direction() {
    let build = || {
        let section = Section::from_stiffness(1e5, 1.0, 0.1).unwrap();
        let points = [Vector3::zeros(), 0.5 * Vector3::new(1.0, 1.0, 0.0), Vector3::new(2.0, 0.5, 0.0)];
        Cable::builder().points(points).length(2.5).section(section).elements(12).fix(At::End).build().unwrap()
    };
    let first = Vector3::new(1.0, 1.0, 0.0).normalize();
    let mut cable = build();
    cable.attach_clamped(At::Start, None).unwrap();
    assert!(matches!(cable.support(At::Start).unwrap().slope, SlopeSupport::Attached(d) if (d - first).norm() < 1e-15));
    assert!((cable.sample(0.0).unwrap().slope.normalize() - first).norm() < 1e-14);
    let mut cable = build();
    cable.clamp(At::Start).unwrap();
    assert!((cable.sample(0.0).unwrap().slope.normalize() - first).norm() < 1e-14);
    // the shape between is at rest
    let before = cable.positions().to_vec();
    cable.equilibrium().unwrap();
    let moved = before.iter().zip(cable.positions()).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
    assert!(moved < 1e-6, "{moved:e}");
    cable.release(At::Start).unwrap();
    for _ in 0..10 {
        cable.step(1.0 / 60.0).unwrap();
    }
    // one that has moved holds the tangent that it has
    let tangent = cable.sample(0.0).unwrap().slope.normalize();
    cable.clamp(At::Start).unwrap();
    assert!((cable.sample(0.0).unwrap().slope.normalize() - tangent).norm() < 1e-14);
}

/// Clamps of a taut cable keep the tangent that it had, to the bit, and a direction that has no length is refused.
#[test]
fn a_taut_cable_is_laid_as_before_and_no_direction_is_refused() {
    let section = Section::from_stiffness(1e5, 1.0, 0.1).unwrap();
    let build =
        || Cable::builder().points([Vector3::zeros(), Vector3::x(), Vector3::new(2.0, 1.0, 0.0)]).section(section);
    let [free, clamped] = [build(), build().clamp(At::Start).clamp(At::End)].map(|builder| builder.build().unwrap());
    let ends = |cable: &Cable| [cable.positions()[..6].to_vec(), cable.positions()[60..].to_vec()];
    assert!(ends(&free).iter().zip(ends(&clamped)).all(|(a, b)| a[..3] == b[..3]));
    assert_eq!(
        clamped.positions()[3..6],
        build().clamp_along(At::Start, [5.0, 0.0, 0.0]).build().unwrap().positions()[3..6]
    );
    for direction in [[0.0; 3], [f64::NAN, 1.0, 0.0]] {
        let refused = build().clamp_along(At::Start, direction).build();
        assert!(matches!(refused, Err(Error::InvalidValue { .. })), "{refused:?}");
        assert!(free.clone().clamp_along(At::Start, direction).is_err());
    }
}

/// A rod drawn straight along x from its clamp, which turns it by this angle towards y.
fn cantilever(length: f64, stiffness: f64, gravity: f64) -> CableBuilder {
    let section = Section::from_stiffness(1e5, stiffness, 0.2).unwrap();
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(length, 0.0, 0.0)])
        .elements(12)
        .section(section)
        .gravity(Vector3::new(0.0, -gravity, 0.0))
}

fn strain_energy(cable: &Cable) -> f64 {
    let energy = cable.energy();
    energy.axial + energy.bending
}

fn towards(degrees: f64) -> Vector3<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vector3::new(cos, sin, 0.0)
}

fn farthest(a: &Cable, b: &Cable) -> f64 {
    (0..a.nodes()).map(|node| (a.node_position(node) - b.node_position(node)).norm()).fold(0.0, f64::max)
}

/// A cantilever whose clamp turns it away from its drawing starts as if it had been drawn along the clamp: without stress, and with its motion.
///
/// *Source.* The same rod drawn along the direction; without gravity a straight rod at rest stays.
#[test]
fn a_cantilever_turned_by_its_clamp_is_the_one_drawn_along_it() {
    for (length, stiffness) in [(1.0, 5.0), (3.0, 0.05)] {
        for degrees in [10.0, 45.0, 90.0, 135.0, 179.0, 180.0] {
            for gravity in [0.0, 9.81] {
                let case = format!("{length} m, EI {stiffness}, {degrees} degrees, g = {gravity}");
                let direction = towards(degrees);
                let turned = cantilever(length, stiffness, gravity).clamp_along(At::Start, direction).build().unwrap();
                let mut later = cantilever(length, stiffness, gravity).build().unwrap();
                later.clamp_along(At::Start, direction).unwrap();
                let along = cantilever(length, stiffness, gravity).points([Vector3::zeros(), length * direction]);
                let mut along = along.clamp(At::Start).build().unwrap();
                let mut turned = turned;
                assert!(strain_energy(&turned) < 1e-20, "{case}: {:e} J", strain_energy(&turned));
                assert!(farthest(&turned, &along) < 1e-12 && farthest(&later, &along) < 1e-12, "{case}");
                let start = turned.clone();
                for _ in 0..6 {
                    turned.step(1.0 / 60.0).unwrap();
                    along.step(1.0 / 60.0).unwrap();
                }
                if gravity == 0.0 {
                    assert!(farthest(&turned, &start) < 1e-9, "{case}: {:e} m", farthest(&turned, &start));
                }
                // both follow the motion within the tolerance of their steps
                assert!(farthest(&turned, &along) < 1e-4 * length, "{case}: {:e} m", farthest(&turned, &along));
            }
        }
    }
}

/// Beyond a pin the part with a free end goes on straight, and the part between clamp and pin is a propped beam.
///
/// *Source.* A beam with a rotated end and a pin: M = 3 EI theta/L, for small angles; the free part has no stress.
#[test]
fn a_free_part_beyond_a_pin_follows_its_tangent() {
    let angle = 0.1f64;
    let build = cantilever(2.0, 5.0, 0.0).clamp_along(At::Start, towards(angle)).fix(At::ArcLength(1.0));
    let mut cable = build.build().unwrap();
    let moment = cable.reactions().unwrap()[0].moment.z;
    let expected = 3.0 * 5.0 * angle.to_radians();
    assert!((moment.abs() - expected).abs() < 2e-3 * expected, "{moment} for {expected}");
    let tail = cable.sample(1.0).unwrap().slope.normalize();
    let end = cable.node_position(cable.nodes() - 1);
    assert!((end - (Vector3::x() + tail)).norm() < 1e-9);
    assert!((tail.y.atan2(tail.x) + 0.5 * angle.to_radians()).abs() < 1e-3 * angle.to_radians());
    let start = cable.clone();
    (0..30).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    assert!(farthest(&cable, &start) < 1e-6, "{:e}", farthest(&cable, &start));
}

/// A clamp amid a cable without other supports turns all of it; a slack cantilever hangs from its clamp in equilibrium.
#[test]
fn both_sides_turn_and_a_slack_cantilever_starts_at_rest() {
    let middle = cantilever(2.0, 5.0, 0.0).clamp_along(At::ArcLength(1.0), towards(70.0)).build().unwrap();
    assert!(strain_energy(&middle) < 1e-20);
    let arm = middle.node_position(middle.nodes() - 1) - Vector3::x();
    assert!((arm - towards(70.0)).norm() < 1e-12 && (middle.node_position(0) - Vector3::x() + arm).norm() < 1e-12);
    for gravity in [0.0, 9.81] {
        for degrees in [0.0, 40.0, 90.0, 150.0] {
            let build = cantilever(1.0, 5.0, gravity).length(1.4).clamp_along(At::Start, towards(degrees));
            let mut slack = build.build().unwrap();
            let start = slack.clone();
            (0..30).for_each(|_| slack.step(1.0 / 60.0).unwrap());
            assert!(farthest(&slack, &start) < 1e-5, "{degrees}, {gravity}: {:e}", farthest(&slack, &start));
        }
    }
}

/// An end that turned with its clamp is laid where it was drawn if it is to be attached there: as if it had been held from the start.
#[test]
fn an_end_that_is_attached_later_is_where_it_was_drawn() {
    for degrees in [20.0, 90.0, 179.0] {
        let build = || cantilever(1.0, 5.0, 9.81).clamp_along(At::Start, towards(degrees));
        let held = build().fix(At::End).build().unwrap();
        let mut later = build().build().unwrap();
        assert_eq!(later.drawn_position(At::End), Some(Vector3::x()));
        later.lay_as_drawn(At::End).unwrap();
        assert!(farthest(&later, &held) < 1e-9, "{degrees}: {:e}", farthest(&later, &held));
        later.attach(At::End).unwrap();
        let mut moved = build().build().unwrap();
        moved.step(1e-3).unwrap();
        assert_eq!(moved.drawn_position(At::End), None);
    }
}

/// A cable that is clamped at its start and then fixed or clamped at its end is held at both drawn
/// ends, as one that is built so.
///
/// *Source.* The same cable by the builder.
#[test]
fn an_end_that_is_held_later_is_held_where_it_was_drawn() {
    for (length, up) in [(1.0, true), (1.25, false), (1.25, true)] {
        let drawn = || {
            let end = Vector3::new(1.0, 0.0, 0.0);
            let section = Section::from_stiffness(1e4, 0.5, 0.2).unwrap();
            Cable::builder().points([Vector3::zeros(), end]).length(length).elements(12).section(section)
        };
        let direction = if up { Vector3::new(1.0, 1.0, 0.0) } else { Vector3::x() };
        let mut later = drawn().build().unwrap();
        later.clamp_along(At::Start, direction).unwrap();
        later.fix(At::End).unwrap();
        assert!((later.node_position(12) - Vector3::new(1.0, 0.0, 0.0)).norm() < 1e-9, "{length} {up}");
        let built = drawn().clamp_along(At::Start, direction).fix(At::End).build().unwrap();
        for node in 0..13 {
            let off = (later.node_position(node) - built.node_position(node)).norm();
            assert!(off < 1e-6, "{length} {up}, node {node}: {off}");
        }
    }
}
