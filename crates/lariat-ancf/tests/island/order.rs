//! Convergence with the host step to the monolithic reference, for bodies of a tenth to ten
//! thousand times the cable's mass, on a soft cable and on a steel bar.

use super::bench::{Scene, payload, soft, steel};
use super::reference::Reference;
use lariat_ancf::{Integrator, Method, Section, Vector3};

const DURATION: f64 = 0.3;
const METHODS: [Method; 3] = [Method::TrBdf2, Method::Esdirk3, Method::Esdirk4];

fn pose(scene: &Scene) -> Vector3<f64> {
    let body = &scene.bodies[0];
    Vector3::new(body.position.x, body.position.y, body.rotation.scaled_axis().z)
}

fn exact(section: Section, mass: f64) -> Vector3<f64> {
    let mut reference = Reference::new(section, mass);
    reference.run(DURATION, 0.5);
    reference.body()
}

fn error(section: Section, mass: f64, integrator: Integrator, steps: usize, exact: &Vector3<f64>) -> f64 {
    let mut scene = payload(section, mass, integrator);
    scene.run(DURATION / steps as f64, steps);
    (pose(&scene) - exact).norm()
}

/// The reference agrees with itself at half the step to 1e-10 m, far below the errors measured with
/// it.
///
/// *Source.* Order 4: an error of 1e-10 at the coarse step is 6e-12 at the fine one.
#[test]
fn the_monolithic_reference_has_converged() {
    for (section, mass) in [(soft(), 0.08), (soft(), 50.0)] {
        let mut fine = Reference::new(section, mass);
        fine.run(DURATION, 0.25);
        assert!((fine.body() - exact(section, mass)).norm() < 1e-10, "{mass} kg");
    }
}

/// One integration step per host step, 1/120 s to 1/960 s: the error of the body's pose falls with
/// the order of the method where the step resolves the cable's waves; soft cable: all masses,
/// steel: bodies heavier than the bar.
///
/// *Source.* The monolithic reference; orders 2, 3 and 4 of the methods. The stiff part of the
/// motion (order reduction, Hairer & Wanner 1996, IV.15) reduces the order of the lightest and the
/// stiffest by up to one.
#[test]
fn the_error_falls_with_the_order_of_the_method() {
    let cases = [
        (soft(), 0.08, [1.3, 1.5, 2.3]),
        (soft(), 0.8, [1.6, 2.3, 3.1]),
        (soft(), 50.0, [1.9, 2.8, 3.3]),
        (soft(), 800.0, [1.8, 2.5, 3.4]),
        (soft(), 8000.0, [1.9, 2.5, 2.6]),
        (steel(), 50.0, [1.8, 1.6, 2.5]),
        (steel(), 800.0, [1.4, 0.7, 3.4]),
        (steel(), 8000.0, [1.8, 1.8, 3.1]),
    ];
    for (section, mass, least) in cases {
        let exact = exact(section, mass);
        for (method, least) in METHODS.into_iter().zip(least) {
            let integrator = Integrator::substeps(method, 1).unwrap();
            // below 1e-9 the error of Newton's iteration dominates
            let [coarse, fine] = [36, 288].map(|n| error(section, mass, integrator, n, &exact).max(1e-9));
            let order = (coarse / fine).log2() / 3.0;
            assert!(order > least, "{section:?}, {mass} kg, {method}: {coarse:.1e}, {fine:.1e}, order {order:.2}");
        }
    }
}

/// Methods that carry accelerations from step to step carry them from host step to host step: they
/// have order 2 with one integration step per host step. So have the explicit ones, whose
/// accelerations depend on the body's angular velocity.
///
/// *Source.* The monolithic reference; order 2 of the methods, as for a cable alone
/// (tests/integrators.rs).
#[test]
fn accelerations_are_kept_across_host_steps() {
    let methods =
        ["generalised-alpha-0", "generalised-alpha-0.5", "generalised-alpha-0.8", "trapezoid", "verlet", "rkn4"];
    let mass = 50.0;
    let exact = exact(soft(), mass);
    for method in methods {
        let method: Method = method.parse().unwrap();
        let integrator = Integrator::substeps(method, 1).unwrap();
        let explicit = matches!(method, Method::Verlet | Method::Rkn4);
        let steps = if explicit { [5400, 10_800] } else { [288, 1152] };
        let [coarse, fine] = steps.map(|n| error(soft(), mass, integrator, n, &exact).max(1e-9));
        let order = (coarse / fine).log2() / (steps[1] as f64 / steps[0] as f64).log2();
        let floor = 2e-9;
        assert!(order > 1.8 || coarse < floor, "{method}: {coarse:.1e}, {fine:.1e}, order {order:.2}");
    }
}

/// With one integration step per host step of 1/60 s, for all masses and stiffnesses, the pose (m
/// and rad) is within 1e-3 with TR-BDF2, 2.1e-3 with ESDIRK3 (a cube of 80 g on steel; others
/// 4e-4), 2e-4 with ESDIRK4.
///
/// *Source.* The monolithic reference.
#[test]
fn one_step_per_frame_is_stable_and_accurate_for_every_mass() {
    for section in [soft(), steel()] {
        for mass in [0.08, 0.8, 50.0, 800.0, 8000.0] {
            let exact = exact(section, mass);
            for (method, most) in METHODS.into_iter().zip([1e-3, 2.1e-3, 2e-4]) {
                let error = error(section, mass, Integrator::substeps(method, 1).unwrap(), 18, &exact);
                assert!(error < most, "{mass} kg, {method}: {error:.1e}");
            }
        }
    }
}

/// The default integrator keeps 1e-6 m per host step: after 18 of 1/60 s the body is within 1.8e-5
/// m, and within 1e-6 m with 288 of 1/960 s, where its errors are far below its tolerance.
///
/// *Source.* The monolithic reference.
#[test]
fn the_default_integrator_keeps_its_tolerance_with_every_mass() {
    for section in [soft(), steel()] {
        for mass in [0.08, 0.8, 50.0, 800.0, 8000.0] {
            let exact = exact(section, mass);
            for (steps, most) in [(18, 1.8e-5), (288, 1e-6)] {
                let mut scene = payload(section, mass, Integrator::default());
                scene.run(DURATION / steps as f64, steps);
                let error = (pose(&scene) - exact).xy().norm();
                assert!(error < most, "{mass} kg, {steps} steps: {error:.1e}");
            }
        }
    }
}
