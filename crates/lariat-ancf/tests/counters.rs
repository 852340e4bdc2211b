//! Counts: what is absent is not computed, and the same run counts the same on every machine.

mod common;

use common::{pendulum, rule};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Diagnostics, Fidelity, Integrator, Method, PointLoad, StepControl, Vector3};

fn counted(name: &str, load: bool, method: Method, steps: usize) -> Diagnostics {
    let mut builder = pendulum(10).rule(rule(name)).integrator(Integrator::substeps(method, 40).unwrap());
    if load {
        builder = builder.load(PointLoad::force(1.0, Vector3::new(0.0, -1.0, 0.0)));
    }
    let mut cable = builder.build().unwrap();
    for _ in 0..steps {
        cable.step(1.0 / 240.0).unwrap();
    }
    *cable.diagnostics()
}

/// A cable without bending runs no bending rule, a cable without loads evaluates no load; with them, each is counted.
///
/// *Source.* Effects are paid for only where the scene calls for them; ten elements, one load.
#[test]
fn absent_bending_and_absent_loads_cost_nothing() {
    for method in Method::ALL {
        let bare = counted("projected-none", false, method, 3);
        assert_eq!((bare.bending_evaluations, bare.load_evaluations), (0, 0), "{method}");
        assert!(bare.element_evaluations() > 0, "{method}");
        let full = counted("projected-3", true, method, 3);
        assert_eq!(full.bending_evaluations, full.element_evaluations(), "{method}");
        assert_eq!(full.load_evaluations * 10, full.element_evaluations(), "{method}");
    }
}

/// The same run counts the same, twice.
///
/// *Source.* Equality of all counters of two runs.
#[test]
fn counts_are_reproducible() {
    for method in Method::ALL {
        assert_eq!(counted("projected-3", true, method, 5), counted("projected-3", true, method, 5), "{method}");
    }
}

/// Explicit methods solve with the mass matrix and factor nothing; implicit ones iterate in every stage, with a new
/// tangent at most in every iteration.
///
/// *Source.* The number of stages each method claims; 3 host steps of 40 steps, and one acceleration to begin with.
#[test]
fn methods_cost_what_they_claim() {
    for method in Method::ALL {
        let (d, p) = (counted("projected-3", false, method, 3), method.properties());
        assert_eq!((d.host_steps, d.steps, d.rejected_steps), (3, 120, 0), "{method}");
        if p.implicit {
            assert!(d.newton_iterations >= u64::from(p.stages) * d.steps, "{method}: {d:?}");
            assert!((1..=d.newton_iterations).contains(&d.factorisations), "{method}: {d:?}");
        } else {
            assert_eq!(d.factorisations, 0, "{method}");
            assert_eq!(d.mass_solves, u64::from(p.stages) * d.steps + 1, "{method}: {d:?}");
            assert_eq!(d.force_evaluations, 10 * d.mass_solves, "{method}: {d:?}");
        }
    }
}

/// A host that keeps its step in single precision gets the steps that one in double precision gets; a step that is longer by more
/// is split.
///
/// *Source.* 1/60 s in single precision is longer than 4/240 s by 5e-8 of it; the game fidelity steps by 1/240 s at most.
#[test]
fn a_host_step_in_single_precision_takes_no_more_steps() {
    for (host, expected) in
        [(1.0 / 60.0, 4), (f64::from(1.0f32 / 60.0), 4), (f64::from(1.0f32 / 60.0) / 4.0, 1), (0.01667, 5)]
    {
        let mut cable = pendulum(10).fidelity(Fidelity::Game).build().unwrap();
        assert_eq!(cable.integrator().control, StepControl::MaxStep(1.0 / 240.0));
        cable.step(host).unwrap();
        let d = cable.diagnostics();
        assert_eq!((d.steps, d.rejected_steps), (expected, 0), "{host}");
    }
}

/// Reset counts from zero.
///
/// *Source.* The default of `Diagnostics`.
#[test]
fn reset_sets_all_counts_to_zero() {
    let mut cable = pendulum(10).build().unwrap();
    cable.step(0.01).unwrap();
    assert_ne!(*cable.diagnostics(), Diagnostics::default());
    cable.diagnostics_mut().reset();
    assert_eq!(*cable.diagnostics(), Diagnostics::default());
}
