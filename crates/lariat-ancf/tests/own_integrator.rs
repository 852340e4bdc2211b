//! Integration methods from outside the crate: written with its public items alone, they step
//! cables and islands with every step control, to their order.
//!
//! *Physics.* The methods are Newmark's with beta = 1/4 and gamma = 1/2, which is the built-in
//! trapezoidal rule, and Alexander's SDIRK2, of order 2 and L-stable.

mod common;

use common::{EXACT_IN_TIME, largest_difference, soft_cable};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::integrate::dirk::Tableau;
use lariat_ancf::integrate::{Dynamics, IntegratorRef, OneStep, Scratch, Stage, State, StepRequest};
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, Error, Integrator, Method, StepControl, StepFailure, Vector3};

/// Newmark's method with beta = 1/4 and gamma = 1/2.
#[derive(Debug)]
struct Newmark;

impl OneStep for Newmark {
    fn name(&self) -> String {
        "newmark".to_string()
    }

    fn estimate_order(&self) -> Option<u32> {
        Some(3)
    }

    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        StepRequest { h, newton_tolerance, estimate }: StepRequest,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        let Scratch { next, base, velocity_base, error, .. } = scratch;
        let a = &now.memory.acceleration;
        for i in 0..system.size() {
            base[i] = now.q[i] + h * now.v[i] + 0.25 * h * h * a[i];
            velocity_base[i] = now.v[i] + 0.5 * h * a[i];
        }
        let acceleration = &mut next.memory.acceleration;
        acceleration.copy_from_slice(a);
        let stage = Stage { time: now.time + h, c2: 0.25 * h * h, dv_dq: 2.0 / h, newton_tolerance, reuse: false };
        system.solve_stage(&stage, base, velocity_base, &mut next.q, acceleration)?;
        for i in 0..system.size() {
            next.v[i] = velocity_base[i] + 0.5 * h * acceleration[i];
            error[i] = h * h / 12.0 * (acceleration[i] - a[i]);
        }
        system.prescribe(now.time + h, &mut next.q, &mut next.v);
        if !estimate {
            return Ok(None);
        }
        system.filter(error);
        Ok(Some(system.norm(error)))
    }
}

/// 1 - sqrt 2/2.
const GAMMA: f64 = 0.292_893_218_813_452_4;

/// Alexander's SDIRK2 (SIAM J. Numer. Anal. 14 (1977) 1006): a tableau is a method.
const ALEXANDER: Tableau =
    Tableau { name: "alexander-2", a: &[&[GAMMA], &[1.0 - GAMMA, GAMMA]], b: &[1.0 - GAMMA, GAMMA], estimate: None };

/// The soft cable swinging about its start.
fn swinging() -> Cable {
    soft_cable().fix(At::Start).velocity(Vector3::new(0.0, 0.3, 0.5)).build().unwrap()
}

/// Positions and velocities after 0.25 s in `steps` steps.
fn end(method: impl OneStep, steps: u32) -> Vec<f64> {
    let mut cable = swinging();
    cable.step_with(0.25, &Integrator { method, control: StepControl::Substeps(steps) }).unwrap();
    cable.positions().iter().chain(cable.velocities()).copied().collect()
}

/// Halving the step divides the error by four, for a method that solves its own stage and for one
/// that is a tableau.
///
/// *Source.* Order 2 of both methods; the reference is the symplectic method of order 6, error
/// below 1e-12.
#[test]
fn a_method_of_another_crate_converges_with_its_order() {
    let reference = end(Method::Rkn6, 6400);
    let newmark = [800, 1600, 3200].map(|steps| end(Newmark, steps));
    let alexander = [800, 1600, 3200].map(|steps| end(ALEXANDER, steps));
    for (name, ends) in [(Newmark.name(), newmark), (ALEXANDER.name(), alexander)] {
        let errors = ends.map(|end| largest_difference(&end, &reference));
        let orders = [0, 1].map(|i| (errors[i] / errors[i + 1]).log2());
        println!("{name}: errors 1e{:.1?}, orders {orders:.2?}", errors.map(f64::log10));
        assert!(orders.iter().all(|order| (1.65..2.5).contains(order)), "{name}: {orders:?}");
    }
}

/// The same method from outside and from inside the crate gives the same motion.
///
/// *Source.* The built-in trapezoidal rule; 1e-8 is what Newton's iteration leaves, at 1e-10 m per
/// step.
#[test]
fn newmark_from_outside_is_the_built_in_trapezoidal_rule() {
    let difference = largest_difference(&end(Newmark, 400), &end(Method::Trapezoid, 400));
    assert!(difference < 1e-8, "{difference:e}");
}

/// Error control works with a method that has an estimate: the error is below the sum of the
/// tolerances of the host steps, a smaller tolerance takes more steps, and the time is the host's
/// to the bit.
///
/// *Source.* The exact-in-time run; 30 host steps.
#[test]
fn error_control_works_with_an_estimate_from_outside() {
    let mut exact = swinging();
    exact.set_integrator(EXACT_IN_TIME).unwrap();
    (0..30).for_each(|_| exact.step(0.01).unwrap());
    let mut counts = Vec::new();
    for tolerance in [1e-5, 1e-7] {
        let mut cable = swinging();
        let integrator = Integrator { method: Newmark, control: StepControl::Tolerance(tolerance) };
        (0..30).for_each(|_| cable.step_with(0.01, &integrator).unwrap());
        let error = (0..cable.nodes()).map(|i| (cable.node_position(i) - exact.node_position(i)).norm());
        let error = error.fold(0.0, f64::max);
        println!("{tolerance:e}: error {error:.1e} m, {} steps", cable.diagnostics().steps);
        assert!(error < 30.0 * tolerance, "{tolerance:e}: {error:e}");
        assert_eq!(cable.time().to_bits(), exact.time().to_bits());
        counts.push(cable.diagnostics().steps);
    }
    assert!(counts[0] > 30 && counts[1] > 2 * counts[0], "{counts:?}");
}

/// A step control that the method does not support is the error that a built-in method gives, with
/// the method's name.
///
/// *Source.* The contract.
#[test]
fn an_unsupported_step_control_is_an_error_with_the_methods_name() {
    let mut cable = swinging();
    let before = cable.snapshot().clone();
    let mut step = |control| cable.step_with(0.01, &Integrator { method: ALEXANDER, control });
    let method = || "alexander-2".to_string();
    assert_eq!(step(StepControl::Tolerance(1e-6)), Err(Error::NoErrorEstimate { method: method() }));
    assert_eq!(step(StepControl::Stable(0.5)), Err(Error::NoStabilityLimit { method: method() }));
    assert!(matches!(step(StepControl::Substeps(0)), Err(Error::InvalidValue { .. })));
    assert_eq!(*cable.snapshot(), before);
}

/// A state that is put back continues bitwise the same run.
///
/// *Source.* Bitwise equality: all that the method carries from step to step is in the state.
#[test]
fn a_run_with_a_method_of_another_crate_replays_bitwise() {
    let integrator = Integrator { method: Newmark, control: StepControl::Tolerance(1e-6) };
    let mut cable = swinging();
    let run = |cable: &mut Cable| (0..10).for_each(|_| cable.step_with(0.01, &integrator).unwrap());
    run(&mut cable);
    let middle = cable.snapshot().clone();
    run(&mut cable);
    let after = cable.snapshot().clone();
    cable.restore(middle).unwrap();
    run(&mut cable);
    assert_eq!(*cable.snapshot(), after);
}

/// A cable that changes from a method with algorithmic accelerations to one without and back begins
/// with true ones.
///
/// *Source.* Bitwise equality with a cable whose accelerations are computed anew: those that
/// generalised-alpha left behind belong to an earlier state.
#[test]
fn algorithmic_accelerations_are_not_taken_from_an_earlier_state() {
    let alpha = Integrator::substeps("generalised-alpha-0.5".parse().unwrap(), 4).unwrap();
    let newmark = Integrator { method: Newmark, control: StepControl::Substeps(4) };
    let mut cable = swinging();
    cable.step_with(0.01, &alpha).unwrap();
    cable.step_with(0.01, &newmark).unwrap();
    let mut fresh = swinging();
    fresh.restore(cable.snapshot().clone()).unwrap();
    let (q, v) = (cable.positions().to_vec(), cable.velocities().to_vec());
    fresh.set_coordinates(&q, &v).unwrap();
    cable.step_with(0.01, &alpha).unwrap();
    fresh.step_with(0.01, &alpha).unwrap();
    let difference = largest_difference(cable.positions(), fresh.positions());
    assert!(difference < 1e-12, "{difference:e}");
}

/// A cable and a body as one system, stepped from outside and from inside.
///
/// *Source.* The built-in trapezoidal rule.
#[test]
fn an_island_steps_with_a_method_of_another_crate() {
    let end = |integrator: IntegratorRef<'_>| {
        let mut cable = soft_cable().fix(At::Start).build().unwrap();
        let node = cable.attach(At::End).unwrap();
        let position = cable.node_position(node) - Vector3::new(0.0, 0.1, 0.0);
        let mut body = [RigidBody::new(1.0, nalgebra::Matrix3::identity() * 0.01, position).unwrap()];
        body[0].force = Vector3::new(0.0, -9.81, 0.0);
        let anchor = Vector3::new(0.0, 0.1, 0.0);
        let pins = [PinConstraint { cable: 0, node, body: 0, anchor, direction: None }];
        let mut island = Island::default();
        for _ in 0..20 {
            island.step_with(&mut [&mut cable], &mut body, &pins, integrator, 0.01).unwrap();
        }
        body[0].position
    };
    let control = StepControl::Substeps(4);
    let (outside, inside) = (
        end((&Integrator { method: Newmark, control }).into()),
        end((&Integrator { method: Method::Trapezoid, control }).into()),
    );
    assert!((outside - inside).norm() < 1e-9 && inside.y < -0.05, "{outside:?} {inside:?}");
}
