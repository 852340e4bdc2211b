//! A load that is applied at once: the tension comes to twice the static one for a moment, and breaks the rope if that is above its limit.

mod common;

use approx::assert_relative_eq;
use common::pendulum;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Break, Cable, Fidelity, Integrator, Method, Section, Strength, Vector3, Warning};
use nalgebra::Matrix3;

const MASS: f64 = 100.0;
const WEIGHT: f64 = MASS * 9.81;
const LENGTH: f64 = 2.0;

/// What became of a rope of stiffness EA (N) from which a mass was let go at once: its break, and its warnings.
fn let_go(stiffness: f64, fidelity: Fidelity, rate: f64, limit: f64) -> (Option<Break>, Vec<Warning>) {
    let mut rope = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -LENGTH, 0.0)])
        .section(Section::from_stiffness(stiffness, 0.1, 1e-3).unwrap())
        .elements(4)
        .fidelity(fidelity)
        .fix(At::Start)
        .build()
        .unwrap();
    rope.attach(At::End).unwrap();
    rope.set_strength(limit).unwrap();
    rope.set_watched(true);
    let body = RigidBody::new(MASS, Matrix3::identity(), Vector3::new(0.0, -LENGTH, 0.0)).unwrap();
    let mut bodies = [body];
    bodies[0].force = Vector3::new(0.0, -WEIGHT, 0.0);
    let pin = PinConstraint { cable: 0, node: 4, body: 0, anchor: Vector3::zeros(), direction: None };
    let (mut island, integrator) = (Island::default(), rope.integrator());
    for _ in 0..(0.2 * rate) as usize {
        island.step(&mut [&mut rope], &mut bodies, &[pin], integrator, 1.0 / rate).unwrap();
        rope.note_host_step(false, |_| {});
        let energy = rope.energy().total();
        if let Some((rest, how)) = rope.break_overloaded().unwrap() {
            assert_relative_eq!(rope.energy().total() + rest.energy().total(), energy, max_relative = 1e-12);
            assert!(how.time <= rope.time() && how.time > rope.time() - 1.0 / rate - 1e-12, "{how:?}");
            return (Some(how), rope.warnings());
        }
    }
    (None, rope.warnings())
}

/// *Source.* A mass m on a rope without mass that is let go at once: T = m g (1 - cos(omega t)), omega^2 = EA/(L m), so the tension comes to 2 m g
/// (Timoshenko & Young 1955, section 1). Strains are 2e-3 at most.
#[test]
fn a_rope_that_is_loaded_at_once_breaks_if_it_bears_less_than_twice_the_load() {
    for stiffness in [2e5, 1e6] {
        for fidelity in [Fidelity::Engineering, Fidelity::Game] {
            for rate in [30.0, 60.0, 240.0] {
                let case = format!("EA {stiffness:.0e} N, {fidelity:?}, {rate} Hz");
                let (how, _) = let_go(stiffness, fidelity, rate, 0.98 * 2.0 * WEIGHT);
                let how = how.unwrap_or_else(|| panic!("{case}: it did not break"));
                assert!((0.98..1.02).contains(&(how.tension / (2.0 * WEIGHT))), "{case}: {how:?}");
                let (how, _) = let_go(stiffness, fidelity, rate, 1.02 * 2.0 * WEIGHT);
                assert!(how.is_none(), "{case}: {how:?}");
                // at a fifth more no warning is due: the steps resolve the peak that far
                let (how, warnings) = let_go(stiffness, fidelity, rate, 1.2 * 2.0 * WEIGHT);
                let unseen = warnings.iter().any(|warning| matches!(warning, Warning::UnseenLoad { .. }));
                assert!(how.is_none() && !unseen, "{case}: {warnings:?}");
            }
        }
    }
}

/// Whatever the steps resolve, a rope that should break does, or a warning says that this is not known.
///
/// *Source.* As above: 2 m g.
#[test]
fn a_peak_that_the_steps_do_not_resolve_is_told() {
    let (mut broke, mut told) = (0, 0);
    for stiffness in [2e5, 2e6, 1e7, 1e8, 1e9] {
        for fidelity in [Fidelity::Engineering, Fidelity::Game] {
            for rate in [30.0, 60.0, 240.0] {
                for share in [1.05, 1.3, 1.6, 1.9, 1.99] {
                    let (how, warnings) = let_go(stiffness, fidelity, rate, share * WEIGHT);
                    let unseen = warnings.iter().any(|warning| matches!(warning, Warning::UnseenLoad { .. }));
                    assert!(
                        how.is_some() || unseen,
                        "EA {stiffness:.0e} N, {fidelity:?}, {rate} Hz, {share}: {warnings:?}"
                    );
                    (broke, told) = (broke + u32::from(how.is_some()), told + u32::from(how.is_none()));
                }
            }
        }
    }
    println!("{broke} broke, {told} told");
}

/// The load is read after each step of each method: a host step of 40 steps has the peak of 40 host steps, at its place and time. Nothing is read
/// without a limit.
///
/// *Source.* The same steps.
#[test]
fn every_step_is_read_if_there_is_a_limit() {
    for method in Method::ALL {
        let built = |substeps: u32| {
            let integrator = Integrator::substeps(method, substeps).unwrap();
            let mut cable = pendulum(10).integrator(integrator).build().unwrap();
            cable.set_strength(Strength { tension: Some(1e9), strain: Some(1e9) }).unwrap();
            cable
        };
        let (mut whole, mut parts) = (built(40), built(1));
        for _ in 0..5 {
            whole.step(1.0 / 240.0).unwrap();
            let once = whole.peak_load().unwrap();
            assert!(whole.break_overloaded().unwrap().is_none());
            let mut each = parts.peak_load().unwrap();
            for _ in 0..40 {
                parts.step(1.0 / 9600.0).unwrap();
                let load = parts.peak_load().unwrap();
                assert!(parts.break_overloaded().unwrap().is_none());
                each = if load.share > each.share { load } else { each };
            }
            assert_relative_eq!(once.tension, each.tension, max_relative = 1e-6, epsilon = 1e-6);
            assert_relative_eq!(once.time, each.time, epsilon = 1e-9);
            assert_relative_eq!(once.arc_length, each.arc_length, epsilon = 1e-9);
        }
        let counts = whole.diagnostics();
        assert_eq!(counts.load_readings, 10 * (counts.steps + 1), "{method}");
        let mut free = pendulum(10).integrator(Integrator::substeps(method, 40).unwrap()).build().unwrap();
        free.step(1.0 / 240.0).unwrap();
        assert_eq!(free.diagnostics().load_readings, 0, "{method}");
        assert_eq!(free.peak_load(), None);
    }
}
