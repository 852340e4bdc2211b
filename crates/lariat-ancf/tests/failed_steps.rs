//! Steps that fail: the error names the reason, the cable keeps the state before the step exactly,
//! and the next step succeeds once the cause is removed.

mod common;

use common::{pendulum, soft_cable};
use lariat_ancf::{At, Cable, Error, Integrator, Method, PointLoad, Section, StepControl, Vector3};

/// Under a load that overflows the step fails, the state is that before the step to the bit, and
/// the next step succeeds without the load.
///
/// *Source.* The contract. 1e300 N overflows.
#[test]
fn a_step_under_an_impossible_load_fails_and_the_next_succeeds_without_it() {
    for method in Method::ALL {
        let mut cable = pendulum(4).integrator(Integrator::substeps(method, 200).unwrap()).build().unwrap();
        cable.step(0.01).unwrap();
        cable.add_load(PointLoad::force(2.0, Vector3::new(0.0, 1e300, 0.0))).unwrap();
        let before = cable.snapshot().clone();
        let error = cable.step(0.01).expect_err("an impossible step");
        let Error::StepFailed { cable: name, time, step, .. } = &error else { panic!("{method}: {error}") };
        assert!(name == "pendulum" && *step >= 0.0 && *time == 0.01, "{method}: {error}");
        assert_eq!(*cable.snapshot(), before, "{method}");
        cable.clear_loads();
        cable.step(0.01).unwrap_or_else(|e| panic!("{method}: {e}"));
    }
}

/// An explicit step far beyond the stability limit fails, by the limit or by the overflow that
/// follows; shorter steps succeed from the state that was kept.
///
/// *Source.* Stability of the harmonic oscillator: 2/omega for Verlet. Ten elements of steel, omega
/// about 5e5 rad/s.
#[test]
fn an_explicit_step_beyond_the_stability_limit_fails_and_a_stable_one_succeeds() {
    let steel = Section::round(0.01, 2.1e11, 7850.0).unwrap();
    for method in [Method::Verlet, Method::Rkn4, Method::Rkn6] {
        let coarse = Integrator::substeps(method, 4).unwrap();
        let mut cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::x()])
            .section(steel)
            .fix(At::Start)
            .integrator(coarse)
            .build()
            .unwrap();
        let before = cable.snapshot().clone();
        let mut failed = None;
        for _ in 0..50 {
            let last = cable.snapshot().clone();
            if let Err(error) = cable.step(1.0 / 60.0) {
                assert_eq!(*cable.snapshot(), last, "{method}: the last good state");
                failed = Some(error);
                break;
            }
        }
        let error = failed.unwrap_or_else(|| panic!("{method}: never failed"));
        assert!(matches!(error, Error::StepFailed { .. }), "{method}: {error}");
        cable.restore(before).unwrap();
        cable.set_integrator(Integrator { method, control: StepControl::Stable(0.8) }).unwrap();
        cable.step(1e-3).unwrap_or_else(|e| panic!("{method}: {e}"));
    }
}

/// A cable whose nodes coincide and whose slopes are zero: a step succeeds without NaN or fails and
/// keeps the state, and the cable steps again when it is stretched out.
///
/// *Source.* The contract.
#[test]
fn a_cable_collapsed_to_a_point_steps_or_fails_without_nan() {
    for method in Method::ALL {
        let mut cable = soft_cable().integrator(Integrator::substeps(method, 50).unwrap()).build().unwrap();
        let good = (cable.positions().to_vec(), cable.velocities().to_vec());
        cable.set_coordinates(&vec![0.0; good.0.len()], &good.1).unwrap();
        let before = cable.snapshot().clone();
        match cable.step(0.01) {
            Ok(()) => assert!(cable.positions().iter().chain(cable.velocities()).all(|x| x.is_finite()), "{method}"),
            Err(Error::StepFailed { .. }) => assert_eq!(*cable.snapshot(), before, "{method}"),
            Err(error) => panic!("{method}: {error}"),
        }
        cable.set_coordinates(&good.0, &good.1).unwrap();
        cable.step(0.01).unwrap_or_else(|e| panic!("{method}: {e}"));
    }
}

/// A cable that moves into its own held end is compressed through |r'| = 0, and conserves its
/// energy.
///
/// *Source.* Conservation: the cable is undamped and without loads, the integrator adaptive
/// (ESDIRK4, 1e-6 m).
#[test]
fn a_cable_compressed_through_zero_slope_conserves_energy() {
    let integrator = Integrator::tolerance(Method::Esdirk4, 1e-6).unwrap();
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        // waves travel at 6.3 m/s, slower than the cable
        .section(Section::from_stiffness(40.0, 0.05, 1.0).unwrap())
        .fix(At::Start)
        .gravity(Vector3::zeros())
        .velocity(Vector3::new(-10.0, 0.1, 0.0))
        .integrator(integrator)
        .build()
        .unwrap();
    let start = cable.energy().total();
    let mut shortest: f64 = 1.0;
    for _ in 0..300 {
        cable.step(1e-3).unwrap();
        for k in 0..=100 {
            let at = cable.length() * f64::from(k) / 100.0;
            shortest = shortest.min(cable.sample(at).unwrap().slope.norm());
        }
    }
    let change = (cable.energy().total() - start) / start;
    println!("shortest slope {shortest:.3}, energy {change:+.1e}");
    assert!(shortest < 0.1, "{shortest}: never compressed through zero");
    assert!(change.abs() < 1e-2, "{change:e}");
}
