//! Hanging cables without bending stiffness, against the catenary of the Green law found by
//! shooting.

mod common;

use common::rod::{Catenary, stretch};
use common::{Model, Random};
use lariat_ancf::{
    At, AxialRule, BendingRule, Cable, CableBuilder, EquilibriumFailure, Error, PointLoad, Rule, Section, Vector3,
};

const GRAVITY: f64 = 9.81;
/// Axial rule with no bending at all.
const LIMP: Rule = Rule::new(AxialRule::Projected, BendingRule::None);

/// A limp cable of 1 kg/m without supports.
fn limp(points: [Vector3<f64>; 2], length: f64, axial: f64, elements: usize) -> CableBuilder {
    Cable::builder()
        .points(points)
        .length(length)
        .section(Section::from_stiffness(axial, 0.0, 1.0).unwrap())
        .rule(LIMP)
        .elements(elements)
}

/// A cable of `length` between pins (0, 0) and (`dx`, `dy`).
fn hanging(axial: f64, length: f64, dx: f64, dy: f64, elements: usize) -> Model<CableBuilder, Catenary> {
    let reference = Catenary::between(axial, GRAVITY, length, dx, dy);
    let [x, y] = reference.miss(dx, dy);
    assert!(x.hypot(y) < 1e-11 * length, "the reference itself did not converge: {reference:?}");
    Model {
        problem: limp([Vector3::zeros(), Vector3::new(dx, dy, 0.0)], length, axial, elements)
            .fix(At::Start)
            .fix(At::End),
        reference,
        tolerance: 1e-4 * length,
        source: "catenary of the Green law: EA f (f^2 - 1)/2 = T, shooting on (H, V0) with adaptive quadrature",
    }
}

/// Largest distance of the nodes from the reference in m, and largest difference of the tension at
/// the middles of elements as a share of the largest tension.
fn errors(cable: &Cable, reference: &Catenary) -> (f64, f64) {
    let s = cable.node_arc_lengths();
    let largest = reference.tension(0.0).max(reference.tension(reference.length));
    let distance = s.iter().enumerate().fold(0.0f64, |worst, (i, &s)| {
        let [x, y] = reference.at(s);
        worst.max((cable.node_position(i) - Vector3::new(x, y, 0.0)).norm())
    });
    let tension = s.windows(2).fold(0.0f64, |worst, ends| {
        let middle = 0.5 * (ends[0] + ends[1]);
        worst.max((cable.sample(middle).unwrap().tension - reference.tension(middle)).abs() / largest)
    });
    (distance, tension)
}

/// From a taut line (sag 1/100 of the span) to a loop deeper than its span, level and with one pin
/// higher, soft and stiff.
///
/// *Source.* Semi-analytic catenary of the Green law (see `common/rod.rs`). A Green-law cable is
/// not Irvine's: with EA = 200 N it differs by centimetres.
#[test]
fn hanging_cable_takes_the_shape_and_tension_of_the_green_law_catenary() {
    let mut worst = (0.0f64, 0.0f64);
    for (axial, length, dx, dy) in [
        (1e6, 9.995, 10.0, 0.0),
        (1e6, 10.003, 10.0, 0.0),
        (1e4, 9.95, 10.0, 0.0),
        (1e6, 10.3, 10.0, 0.0),
        (1e6, 12.0, 10.0, 3.0),
        (1e4, 15.0, 10.0, -4.0),
        (200.0, 12.0, 10.0, 2.0),
        (1e6, 25.0, 10.0, 0.0),
        (1e6, 30.0, 10.0, 5.0),
    ] {
        let model = hanging(axial, length, dx, dy, 40);
        let mut cable = model.problem.build().unwrap();
        let report = cable.equilibrium().unwrap_or_else(|e| panic!("EA {axial}, {length} m over ({dx}, {dy}): {e}"));
        let (distance, tension) = errors(&cable, &model.reference);
        let sag = -(0..=40).map(|i| cable.node_position(i).y).fold(0.0, f64::min);
        println!(
            "EA {axial:e}, length {length}, ({dx}, {dy}), sag/span {:.4}: shape {distance:.2e} m, tension {tension:.2e}, \
             {} iterations, stable {}",
            sag / dx,
            report.iterations,
            report.stable
        );
        assert!(distance < model.tolerance, "{distance:e} m from the {}", model.source);
        assert!(tension < 2e-3, "tension {tension:e}");
        assert!(report.stable, "EA {axial}, {length} m over ({dx}, {dy})");
        worst = (worst.0.max(distance / length), worst.1.max(tension));
    }
    println!("worst: shape {:.2e} of the length, tension {:.2e} of the largest", worst.0, worst.1);
}

/// Halving the elements' length divides the error of the shape by 2^3 or more.
///
/// *Source.* Cubic elements: order 4 in displacement for smooth solutions; the limp cable has no
/// bending energy, and strain projected on linear functions.
#[test]
fn catenary_converges_with_the_number_of_elements() {
    let errors: Vec<f64> = [8, 16, 32, 64]
        .into_iter()
        .map(|elements| {
            let model = hanging(1e5, 12.0, 10.0, 2.0, elements);
            let mut cable = model.problem.build().unwrap();
            cable.equilibrium().unwrap();
            errors(&cable, &model.reference).0
        })
        .collect();
    let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
    println!("errors {errors:?} m, orders {orders:.2?}");
    assert!(orders.iter().all(|p| *p > 2.8), "{orders:?}");
}

/// A cable hanging from one end: T(s) = w (L - s), each point stretched by the Green law, the
/// elongation their integral.
///
/// *Source.* Analytic in T; the stretch solves a cubic, integrated by Simpson's rule. EA = 300 N
/// under 98 N: 12 % longer.
#[test]
fn vertical_cable_is_elongated_by_its_own_weight_after_the_green_law() {
    let (axial, length) = (300.0, 10.0);
    let n = 2000;
    let f = |i: i32| stretch(axial, GRAVITY * length * (1.0 - f64::from(i) / f64::from(n)), 0.0);
    let simpson: f64 = (0..=n).map(|i| f(i) * if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) }).sum();
    let expected = simpson * length / f64::from(3 * n);
    let points = [Vector3::zeros(), Vector3::new(0.0, -length, 0.0)];
    let mut cable = limp(points, length, axial, 10).fix(At::Start).build().unwrap();
    let report = cable.equilibrium().unwrap();
    let found = -cable.node_position(10).y;
    println!("stretched length {found:.8} m, expected {expected:.8} m, {report:?}");
    assert!((found - expected).abs() < 1e-5 * expected);
    for s in [0.5, 3.5, 8.5] {
        let tension = cable.sample(s).unwrap().tension;
        assert!((tension - GRAVITY * (length - s)).abs() < 2e-2, "tension {tension} N at {s} m");
    }
    let reaction = cable.reactions().unwrap()[0].force;
    assert!((reaction - Vector3::new(0.0, GRAVITY * length, 0.0)).norm() < 1e-6, "{reaction}");
}

/// The reactions of the pins carry the weight, whatever the mesh does.
///
/// *Source.* Equilibrium of the whole cable: sum of the reactions = weight, and H equal at both
/// pins, from shooting.
#[test]
fn reactions_of_the_pins_carry_the_weight_and_the_catenarys_pull() {
    let model = hanging(1e5, 12.0, 10.0, 2.0, 40);
    let mut cable = model.problem.build().unwrap();
    cable.equilibrium().unwrap();
    let reactions = cable.reactions().unwrap();
    let sum = reactions[0].force + reactions[1].force;
    assert!((sum - Vector3::new(0.0, GRAVITY * 12.0, 0.0)).norm() < 1e-6, "{sum}");
    let c = model.reference;
    let start = Vector3::new(-c.h, -c.v0, 0.0);
    println!("start reaction {:?}, expected {:?}", reactions[0].force.as_slice(), start.as_slice());
    assert!((reactions[0].force - start).norm() < 1e-4 * start.norm());
}

/// A shape far off: the same equilibrium from fifty random starts, coordinates off by up to 3 m and
/// slopes pointing anywhere.
///
/// *Source.* A hanging limp cable has one stable equilibrium, the catenary (its energy is convex in
/// the region of tension).
#[test]
fn equilibrium_is_found_from_fifty_random_starts() {
    let model = hanging(1e4, 12.0, 10.0, 2.0, 12);
    let mut cable = model.problem.clone().build().unwrap();
    cable.equilibrium().unwrap();
    let expected = cable.positions().to_vec();
    let mut failures = Vec::new();
    let mut iterations = 0;
    for seed in 0..50 {
        let mut random = Random::new(seed);
        let mut start = model.problem.clone().build().unwrap();
        let q: Vec<f64> = start
            .positions()
            .chunks_exact(6)
            .flat_map(|n| {
                let (r, t) = (random.vector() * 3.0, random.vector().normalize());
                [n[0] + r.x, n[1] + r.y, n[2] + r.z, t.x, t.y, t.z]
            })
            .collect();
        start.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
        match start.equilibrium() {
            Ok(report) => {
                iterations = iterations.max(report.iterations);
                let off = common::largest_difference(start.positions(), &expected);
                if off.is_nan() || off > 1e-6 || !report.stable {
                    failures.push(format!("seed {seed}: off by {off:e}, {report:?}"));
                }
            }
            Err(error) => failures.push(format!("seed {seed}: {error}")),
        }
    }
    println!("at most {iterations} iterations");
    assert!(failures.is_empty(), "{} of 50 starts:\n{}", failures.len(), failures.join("\n"));
}

/// A point load in the middle of a straight, massless string: a triangle whose sides carry T with 2
/// T sin(angle) = F.
///
/// *Source.* Statics of three forces and the Green law, solved by bisection of the sag. The slope
/// of the element is continuous, so the corner is rounded over one element and the sag converges
/// with the first power of its length: a limit of the element, not an error.
#[test]
fn straight_string_under_a_point_load_becomes_a_triangle() {
    let (axial, length, load) = (1e4, 2.0, 50.0);
    let residual = |sag: f64| {
        let side = sag.hypot(0.5 * length);
        let f = side / (0.5 * length);
        2.0 * axial * f * (f * f - 1.0) / 2.0 * sag / side - load
    };
    let (mut low, mut high) = (0.0, length);
    for _ in 0..100 {
        let m = 0.5 * (low + high);
        if residual(m) > 0.0 { high = m } else { low = m }
    }
    let errors = [8, 16, 32, 64].map(|elements| {
        let mut cable = limp([Vector3::zeros(), Vector3::new(length, 0.0, 0.0)], length, axial, elements)
            .gravity(Vector3::zeros())
            .fix(At::Start)
            .fix(At::End)
            .load(PointLoad::force(0.5 * length, Vector3::new(0.0, -load, 0.0)))
            .build()
            .unwrap();
        cable.equilibrium().unwrap();
        (1.0 + cable.node_position(elements / 2).y / low).abs()
    });
    println!("sag {low:.6} m, relative errors {errors:?}");
    assert!(errors[3] < 4e-3, "{errors:?}");
    assert!(errors.windows(2).all(|e| e[0] / e[1] > 1.8), "{errors:?}");
}

/// A cable that nothing holds has no equilibrium, and the cable is unchanged.
///
/// *Source.* A free cable under gravity accelerates.
#[test]
fn a_free_cable_has_no_equilibrium_and_is_unchanged() {
    let mut cable = limp([Vector3::zeros(), Vector3::x()], 1.0, 1e4, 4).build().unwrap();
    let before = cable.snapshot().clone();
    let error = cable.equilibrium().unwrap_err();
    assert!(matches!(&error, Error::NoEquilibrium { failure: EquilibriumFailure::NotHeld, .. }), "{error}");
    assert_eq!(*cable.snapshot(), before);
}
