//! Bent rods in statics: cantilevers under tip force and end moment against the elastica with the Green-law stretch.

mod common;

use common::rod::Elastica;
use common::{Model, rule};
use lariat_ancf::{At, Cable, CableBuilder, PointLoad, Rule, Section, Vector3};
use std::f64::consts::TAU;

/// A weightless cantilever of 1 m along x, clamped at the start.
fn cantilever(axial: f64, bending: f64, elements: usize, rule: Rule) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(axial, bending, 1.0).unwrap())
        .elements(elements)
        .gravity(Vector3::zeros())
        .rule(rule)
        .clamp(At::Start)
}

/// A dead force at the tip.
fn tip_loaded(axial: f64, bending: f64, force: [f64; 2], elements: usize, rule: Rule) -> Model<CableBuilder, Elastica> {
    Model {
        problem: cantilever(axial, bending, elements, rule)
            .load(PointLoad::force(1.0, Vector3::new(force[0], force[1], 0.0))),
        reference: Elastica { axial, bending, length: 1.0, force },
        tolerance: 1e-6,
        source: "elastica with the Green-law stretch: shooting on the root moment, classical Runge-Kutta, 1000 steps",
    }
}

/// Distance of the tip from the reference in m.
fn tip_error(model: Model<CableBuilder, Elastica>) -> f64 {
    let (tip, _) = model.reference.tip();
    let mut cable = model.problem.build().unwrap();
    cable.equilibrium().unwrap();
    (common::tip(&cable) - Vector3::new(tip.x, tip.y, 0.0)).norm()
}

/// The shooting solution itself, against elliptic integrals, so that the reference of this file is not its own judge.
///
/// *Source.* Inextensible elastica, tip force F normal to the clamp, F L^2/EI = 1: deflection 0.30172 L, shortening
/// 0.05643 L, tip angle 0.46135 rad (Mattiasson 1981, Int. J. Numer. Methods Eng. 17, 145, table 1; five printed
/// digits); F L^2/EI = 10: 0.81061, 0.55500, 1.43029.
#[test]
fn shooting_solution_agrees_with_the_elliptic_integrals_of_the_elastica() {
    for (load, down, short, angle) in [(1.0, 0.30172, 0.05643, 0.46135), (10.0, 0.81061, 0.55500, 1.43029)] {
        let (tip, _) = Elastica { axial: 1e9, bending: 1.0, length: 1.0, force: [0.0, load] }.tip();
        assert!((tip.y - down).abs() < 1e-5 && (1.0 - tip.x - short).abs() < 1e-5, "{tip:?}");
        assert!((tip.angle - angle).abs() < 1e-5, "{tip:?}");
    }
}

/// A cantilever bent through large angles by a tip force, thick enough that stretch matters: tip, slope and root
/// moment.
///
/// *Source.* Shooting (see the model's source), the loads from moderate to a tip that almost points along the force.
#[test]
fn tip_loaded_cantilever_takes_the_shape_of_the_elastica() {
    for force in [[0.0, 1.0], [0.0, 10.0], [-1.0, 3.0], [5.0, 5.0], [0.0, -10.0]] {
        for (name, share) in [("projected-3", 1.0), ("G5-5", 3.0)] {
            let model = tip_loaded(2e4, 1.0, force, 32, rule(name));
            let (tip, root) = model.reference.tip();
            let mut cable = model.problem.build().unwrap();
            let report = cable.equilibrium().unwrap();
            let end = cable.sample(1.0).unwrap();
            let error = (end.position - Vector3::new(tip.x, tip.y, 0.0)).norm();
            let angle = (end.slope.y.atan2(end.slope.x) - tip.angle).abs();
            let reaction = cable.reactions().unwrap()[0];
            println!(
                "{name} {force:?}: tip {error:.2e} m, angle {angle:.2e} rad, \
                 root moment {:.6} against {root:.6}, stable {}",
                -reaction.moment.z, report.stable
            );
            assert!(error < share * model.tolerance, "{name}, {force:?}: {error:e} m from the {}", model.source);
            assert!(angle < 2e-5 * share, "{angle:e} rad");
            assert!((reaction.moment.z + root).abs() < 1e-4 * root.abs(), "{reaction:?} {root}");
            assert!((reaction.force + Vector3::new(force[0], force[1], 0.0)).norm() < 1e-6, "{reaction:?}");
            assert!(report.stable);
        }
    }
}

/// Exact strain converges with order 4 where the rod is thick; projected strain too, and with a smaller error.
///
/// *Source.* Cubic elements. EA L^2/EI = 2e4.
#[test]
fn tip_error_falls_with_the_fourth_power_of_the_element_length() {
    for name in ["projected-3", "G5-5"] {
        let errors = [8, 16, 32].map(|elements| tip_error(tip_loaded(2e4, 1.0, [0.0, 10.0], elements, rule(name))));
        let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
        println!("{name}: errors {errors:?} m, orders {orders:.2?}");
        assert!(orders.iter().all(|p| *p > 3.5), "{name}: {orders:?}");
    }
}

/// Membrane locking of a thin rod, EA L^2/EI = 1e6: projected strain against exact strain with 4, 8, 16 elements.
///
/// *Source.* Independent prototype, tip-loaded cantilever with F L^2/EI = 10: 2e-3, 1e-4, 6e-6 of L projected; 2e-2,
/// 3e-3, 3e-4 exact (one digit).
#[test]
fn thin_rod_locks_with_exact_strain_and_not_with_projected_strain() {
    for (name, expected) in [("projected-3", [2e-3, 1e-4, 6e-6]), ("exact-3", [2e-2, 3e-3, 3e-4])] {
        let errors = [4, 8, 16].map(|elements| tip_error(tip_loaded(1e6, 1.0, [0.0, 10.0], elements, rule(name))));
        println!("{name}: {errors:?} of L, expected about {expected:?}");
        for (error, expected) in errors.into_iter().zip(expected) {
            assert!(error < 1.5 * expected, "{name}: {error:e} of L, expected {expected:e}");
        }
    }
}

/// An end moment M bends the rod into an arc and, by this energy, stretches it: f^2 = 1 + 2 M^2/(EA EI), theta' = M
/// f^2/EI. The moment that makes a full circle brings the tip back to the clamp.
///
/// Beyond 90 degrees the plane shape is an unstable equilibrium, since a cable has no torsional stiffness.
///
/// *Source.* Analytic: dW/df = 0 and dW/dtheta' = M for W = EA (f^2 - 1)^2/8 + EI (theta'/f)^2/2.
#[test]
fn end_moment_rolls_the_rod_into_a_circle_of_the_analytic_stretch() {
    let (axial, bending) = (2e4, 1.0);
    let mut cable = cantilever(axial, bending, 32, Rule::default()).build().unwrap();
    // M f^2 L/EI = angle
    let moment = |angle: f64| {
        let mut m: f64 = angle * bending;
        for _ in 0..100 {
            m = angle * bending / (1.0 + 2.0 * m * m / (axial * bending));
        }
        m
    };
    for (steps, step) in [(1, 1), (2, 1), (4, 1)].into_iter().chain((1..=8).map(|i| (8, i))) {
        let angle = TAU * f64::from(step) / f64::from(steps);
        let m = moment(angle);
        let f = (1.0 + 2.0 * m * m / (axial * bending)).sqrt();
        let radius = f / angle;
        // every moment at once on the straight rod, and eight of them one after the other
        if step == 1 {
            cable = cantilever(axial, bending, 32, Rule::default()).build().unwrap();
        }
        cable.clear_loads();
        cable.add_load(PointLoad::moment(1.0, Vector3::new(0.0, 0.0, m))).unwrap();
        let report = cable.equilibrium().unwrap_or_else(|e| panic!("angle {angle}: {e}"));
        // tilting the plane of the rod about the clamp adds to the angle about z once that is beyond 90 degrees:
        // unstable in space
        assert!((angle - TAU / 4.0).abs() < 0.01 || report.stable == (angle < TAU / 4.0), "angle {angle}: {report:?}");
        let expected = Vector3::new(radius * angle.sin(), radius * (1.0 - angle.cos()), 0.0);
        let error = (common::tip(&cable) - expected).norm();
        let middle = cable.sample(0.5).unwrap();
        // the raw stretch |r'| oscillates inside an element, the projected strain does not
        let stretch = (1.0 + 2.0 * middle.green_strain).sqrt();
        println!(
            "angle {angle:.3}: {} iterations, tip {error:.2e} m, stretch {stretch:.8} against {f:.8}, \
             moment {:.6} against {:.6}",
            report.iterations,
            middle.moment.z,
            m * f
        );
        assert!(error < 2e-5, "angle {angle}: {error:e} m");
        assert!((stretch - f).abs() < 1e-6, "{stretch} {f}");
        // EI kappa = EI theta'/f = M f
        assert!((middle.moment.z - m * f).abs() < 2e-3 * m, "{} {}", middle.moment.z, m * f);
        let root = cable.reactions().unwrap()[0].moment.z;
        assert!((root + m).abs() < 1e-6 * m, "root moment {root}, load {m}");
    }
}
