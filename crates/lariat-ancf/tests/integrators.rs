//! Conformance of every time integrator: order of convergence, invariants, and exact times.

mod common;

use common::{EXACT_IN_TIME, Random, largest_difference, map3, soft_cable};
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{At, Cable, Integrator, Method, Motion, PointLoad, SlopeSupport, StepControl, Support, Vector3};

/// The soft cable held at its start, which moves along a cubic of time.
fn towed() -> Cable {
    let mut cable = soft_cable().fix(At::Start).build().unwrap();
    let motion = Motion::hermite(
        0.0,
        0.4,
        (Vector3::zeros(), Vector3::zeros()),
        (Vector3::new(-0.1, 0.15, 0.05), Vector3::new(0.5, 0.0, -0.3)),
    );
    cable.set_support(At::Start, Support { position: Some(motion), ..Support::default() }).unwrap();
    cable
}

/// The soft cable swinging about a pin, with its slope held to a direction at the other end.
fn swinging() -> Cable {
    let mut cable = soft_cable().fix(At::Start).velocity(Vector3::new(0.0, 0.3, 0.5)).build().unwrap();
    let slope = SlopeSupport::Direction(Vector3::new(1.0, 0.0, 0.0));
    cable.set_support(At::End, Support { slope, ..Support::default() }).unwrap();
    cable
}

/// The soft cable free, translating and rotating, without gravity.
fn thrown() -> Cable {
    soft_cable()
        .gravity(Vector3::zeros())
        .velocity(Vector3::new(0.2, 0.1, -0.4))
        .angular_velocity(Vector3::new(0.5, -1.0, 2.0))
        .build()
        .unwrap()
}

fn with(mut cable: Cable, method: Method, control: StepControl) -> Cable {
    cable.set_integrator(Integrator { method, control }).unwrap();
    cable
}

/// Returns the state after 0.25 s.
fn end(mut cable: Cable, method: Method, steps: u32) -> Vec<f64> {
    cable.set_integrator(Integrator::substeps(method, steps).unwrap()).unwrap();
    cable.step(0.25).unwrap_or_else(|e| panic!("{method}: {e}"));
    cable.positions().iter().chain(cable.velocities()).copied().collect()
}

/// Returns the observed orders in two halvings of the step, against a run with a far smaller error.
fn orders(start: fn() -> Cable, method: Method) -> [f64; 2] {
    let reference = end(start(), Method::Rkn6, 6400);
    let steps = match method.properties().order {
        2 => 800,
        3 => 1600,
        4 => 320,
        _ => 60,
    };
    let errors = [steps, 2 * steps, 4 * steps].map(|n| largest_difference(&end(start(), method, n), &reference));
    println!("{method}: errors 1e{:.1?} with {steps} steps and more", errors.map(|e| e.log10()));
    [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()]
}

/// Checks that both halvings reach the claimed order and the second does not exceed it, so that the
/// steps are in the asymptotic range.
fn assert_order(method: Method, observed: [f64; 2]) {
    let claimed = f64::from(method.properties().order);
    println!("{method}: claimed {claimed}, observed {observed:.2?}");
    assert!(observed.iter().all(|p| *p > claimed - 0.35), "{method}: {observed:?}, claimed {claimed}");
    assert!(observed[1] < claimed + 0.5, "{method}: {observed:?}, claimed {claimed}");
}

/// Halving the step divides the error by 2^order, as each method claims, for a swinging cable with
/// supports at rest.
///
/// *Source.* The claimed order (`Method::properties`). The reference is the sixth-order symplectic
/// method at a tenth of the step or less, error below 1e-13, itself checked in
/// `independent_solver_agrees_with_the_reference_method`.
#[test]
fn every_method_converges_with_its_order() {
    for method in Method::ALL {
        assert_order(method, orders(swinging, method));
    }
}

/// A prescribed motion does not reduce the order: the moving end's acceleration enters at each
/// stage's own time.
///
/// *Source.* As above; a cubic motion, and a load that ramps up over the whole run.
#[test]
fn a_moving_support_does_not_reduce_the_order() {
    let start = || {
        let mut cable = towed();
        let load = PointLoad { ramp: 0.4, ..PointLoad::force(0.7, Vector3::new(0.5, 0.0, 2.0)) };
        cable.add_load(load).unwrap();
        cable
    };
    for method in Method::ALL {
        assert_order(method, orders(start, method));
    }
}

/// A free cable conserves its linear momentum to rounding with every method.
///
/// *Source.* Newton's third law: the rules' forces sum to zero, and every method conserves linear
/// invariants.
#[test]
fn a_free_cable_conserves_its_linear_momentum() {
    for method in Method::ALL {
        let mut cable = with(thrown(), method, StepControl::Substeps(8));
        let before = cable.momentum().linear;
        for _ in 0..60 {
            cable.step(1.0 / 60.0).unwrap();
        }
        let drift = (cable.momentum().linear - before).norm() / before.norm();
        println!("{method}: linear momentum drifts by {drift:.1e}");
        assert!(drift < 1e-13, "{method}: {drift:e}");
    }
}

/// Angular momentum is quadratic in the state: symplectic methods conserve it to rounding, the
/// others to their order. The discrete gradient restores what its dissipation takes.
///
/// *Source.* Hairer, Lubich & Wanner 2006, theorems IV.2.2 and VI.4: symplectic Runge-Kutta methods
/// and compositions of kicks and drifts conserve it; midpoint is the only implicit one here (the
/// trapezoidal rule is conjugate to it and conserves a nearby quantity).
#[test]
fn symplectic_methods_conserve_angular_momentum_and_the_others_to_their_order() {
    for method in Method::ALL {
        let drift = |substeps: u32| {
            let mut cable = with(thrown(), method, StepControl::Substeps(substeps));
            let before = cable.momentum().angular;
            let mut worst = 0.0f64;
            for _ in 0..30 {
                cable.step(1.0 / 60.0).unwrap();
                worst = worst.max((cable.momentum().angular - before).norm() / before.norm());
            }
            worst
        };
        let (coarse, fine) = (drift(8), drift(16));
        println!("{method}: angular momentum drifts by {coarse:.1e}, with half the step {fine:.1e}");
        let restores = method == Method::DiscreteGradient;
        if restores || matches!(method, Method::Midpoint | Method::Verlet | Method::Rkn4 | Method::Rkn6) {
            assert!(coarse < 1e-11 && fine < 1e-11, "{method}: {coarse:e} {fine:e}");
        } else {
            let order = f64::from(method.properties().order);
            assert!(coarse > 1e-9, "{method}: no drift at all, {coarse:e}: theory is wrong or the test is");
            assert!((coarse / fine).log2() > order - 0.4, "{method}: {coarse:e} {fine:e}");
        }
    }
}

/// The energy error of a symplectic method oscillates without growth, and falls with its order.
///
/// *Source.* Backward error analysis (Hairer, Lubich & Wanner 2006, IX.8). The trapezoidal rule is
/// conjugate symplectic, with the same property. 20 s against 2 s.
#[test]
fn energy_error_of_symplectic_methods_stays_bounded_and_falls_with_their_order() {
    // stretched by 5 % between two pins and released: nonlinear, but never slack
    let start = || {
        let points = [Vector3::zeros(), Vector3::new(1.05, 0.0, 0.0)];
        soft_cable().points(points).fix(At::Start).fix(At::End).build().unwrap()
    };
    for (method, substeps) in
        [(Method::Midpoint, 16), (Method::Trapezoid, 16), (Method::Verlet, 16), (Method::Rkn4, 3), (Method::Rkn6, 2)]
    {
        let worst = |substeps: u32, seconds: u32| {
            let mut cable = with(start(), method, StepControl::Substeps(substeps));
            let before = cable.energy().total();
            (0..60 * seconds).fold(0.0f64, |worst, _| {
                cable.step(1.0 / 60.0).unwrap();
                worst.max((cable.energy().total() - before).abs())
            })
        };
        let (short, long, fine) = (worst(substeps, 2), worst(substeps, 20), worst(2 * substeps, 2));
        let order = (short / fine).log2();
        println!("{method}: energy error {short:.1e} J in 2 s, {long:.1e} J in 20 s, order {order:.2}");
        assert!(long < 4.0 * short, "{method}: {short:e} J in 2 s, {long:e} J in 20 s");
        assert!(order > f64::from(method.properties().order) - 0.5, "{method}: order {order}");
    }
}

/// A run of the rotated and shifted cable is the rotated and shifted run.
///
/// *Source.* Frame indifference. 1e-12 m is rounding, grown over 0.5 s.
#[test]
fn a_rotated_and_shifted_run_is_the_same_run() {
    let mut random = Random::new(21);
    let (rotation, shift) = (random.rotation(), random.vector());
    for method in Method::ALL {
        for control in [StepControl::Substeps(8), StepControl::Tolerance(1e-5)] {
            let integrator = Integrator { method, control };
            if integrator.checked().is_err() {
                continue;
            }
            let mut here = soft_cable().fix(At::Start).integrator(integrator).build().unwrap();
            let mut there = soft_cable().gravity(rotation * here.gravity()).integrator(integrator).build().unwrap();
            let mut q = map3(here.positions(), |v| rotation * v);
            q.chunks_exact_mut(6).for_each(|n| (0..3).for_each(|x| n[x] += shift[x]));
            there.set_coordinates(&q, here.velocities()).unwrap();
            there.fix(At::Start).unwrap();
            for _ in 0..30 {
                here.step(1.0 / 60.0).unwrap();
                there.step(1.0 / 60.0).unwrap();
            }
            let mut expected = map3(here.positions(), |v| rotation * v);
            expected.chunks_exact_mut(6).for_each(|n| (0..3).for_each(|x| n[x] += shift[x]));
            let off = largest_difference(there.positions(), &expected);
            println!("{method}, {control:?}: off by {off:.1e}");
            assert!(off < 1e-12, "{method}, {control:?}: {off:e}");
        }
    }
}

/// The cable reaches the host's time to the bit after steps of any length, and a step of zero does
/// nothing.
///
/// *Source.* A host adds its steps in f64; any difference would accumulate.
#[test]
fn every_method_reaches_the_hosts_time_to_the_bit() {
    for method in Method::ALL {
        for control in [StepControl::Substeps(7), StepControl::MaxStep(1.3e-3), StepControl::Tolerance(1e-4)] {
            let integrator = Integrator { method, control };
            if integrator.checked().is_err() {
                continue;
            }
            let mut cable = soft_cable().fix(At::Start).integrator(integrator).build().unwrap();
            let mut time = 0.0f64;
            for dt in [1.0 / 60.0, 0.013, 1e-3, 1.0 / 240.0, 0.0, 3e-2, 1e-9, 0.017] {
                let before = cable.snapshot().clone();
                cable.step(dt).unwrap();
                time += dt;
                assert_eq!(cable.time().to_bits(), time.to_bits(), "{method}, {control:?}, step {dt}");
                assert!(dt > 0.0 || *cable.snapshot() == before, "{method}: a step of zero changed the state");
            }
        }
    }
}

/// The division of a time into host steps changes the motion by no more than the tolerance.
///
/// *Source.* The exact-in-time run.
#[test]
fn uneven_host_steps_give_the_same_motion() {
    let mut exact = soft_cable().fix(At::Start).integrator(EXACT_IN_TIME).build().unwrap();
    exact.step(0.3).unwrap();
    for method in [Method::Esdirk3, Method::Esdirk4, Method::GeneralisedAlpha { rho: 0.5 }] {
        let control = StepControl::Tolerance(1e-8);
        let mut cable = soft_cable().fix(At::Start).integrator(Integrator { method, control }).build().unwrap();
        for dt in [0.1, 1e-4, 0.02, 0.0799, 0.1] {
            cable.step(dt).unwrap();
        }
        let off = largest_difference(&cable.positions()[18..21], &exact.positions()[18..21]);
        println!("{method}: tip off by {off:.1e} m");
        assert!(off < 1e-6, "{method}: {off:e}");
    }
}

/// An independent solver agrees on two elements: the assembled force, a dense mass matrix, its
/// dense inverse, and the classical Runge-Kutta method of order 4 share nothing with the
/// integrators and the block-tridiagonal matrices.
///
/// *Source.* Kutta 1901, 8000 steps: error below 1e-9 m by halving the step.
#[test]
fn independent_solver_agrees_with_the_reference_method() {
    let integrator = Integrator::substeps(Method::Rkn6, 1000).unwrap();
    let build = || soft_cable().elements(2).fix(At::Start).integrator(integrator).build().unwrap();
    let mut evaluator = build();
    let n = evaluator.positions().len();
    // without rows and columns of the pinned position
    let free: Vec<usize> = (3..n).collect();
    let mass = common::dense(&evaluator.mass_matrix());
    let mass = nalgebra::DMatrix::from_fn(free.len(), free.len(), |r, c| mass[(free[r], free[c])]);
    let inverse = mass.try_inverse().unwrap();
    let mut acceleration = |q: &[f64]| {
        evaluator.set_coordinates(q, &vec![0.0; n]).unwrap();
        let force = evaluator.force();
        let a = &inverse * nalgebra::DVector::from_fn(free.len(), |r, _| force[free[r]]);
        let mut full = vec![0.0; n];
        free.iter().zip(a.iter()).for_each(|(&i, a)| full[i] = *a);
        full
    };
    let plus = |x: &[f64], h: f64, y: &[f64]| x.iter().zip(y).map(|(x, y)| x + h * y).collect::<Vec<_>>();
    let mut run = |steps: u32| {
        let h = 0.4 / f64::from(steps);
        let start = build();
        let (mut q, mut v) = (start.positions().to_vec(), start.velocities().to_vec());
        for _ in 0..steps {
            let k1 = acceleration(&q);
            let v2 = plus(&v, 0.5 * h, &k1);
            let k2 = acceleration(&plus(&q, 0.5 * h, &v));
            let v3 = plus(&v, 0.5 * h, &k2);
            let k3 = acceleration(&plus(&q, 0.5 * h, &v2));
            let v4 = plus(&v, h, &k3);
            let k4 = acceleration(&plus(&q, h, &v3));
            for i in 0..n {
                q[i] += h / 6.0 * (v[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
                v[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
            }
        }
        q
    };
    let (coarse, fine) = (run(4000), run(8000));
    let mut ours = build();
    ours.step(0.4).unwrap();
    let (own, off) = (largest_difference(&coarse, &fine), largest_difference(ours.positions(), &fine));
    println!("independent solver: {own:.1e} between its own steps, {off:.1e} from ours");
    assert!(own < 1e-9 && off < 1e-9, "{own:e} {off:e}");
}
