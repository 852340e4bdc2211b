//! Motions that are known.

use super::common::{G, implicit, rope};
use super::random::Random;
use approx::assert_relative_eq;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, Damping, ErrorNorm, Integrator, Method, Reel, Section, StepControl, Vector3};
use nalgebra::Matrix3;

/// The momentum of a rope changes by its weight and the force on the eye: with a reel that pays out at a constant rate, a rope that
/// hangs at rest moves down as a whole, and its tension at the eye is its weight.
///
/// *Source.* Newton's second law of the rope that is out: d(m v)/dt = m g - T with v constant and mass m = rho A l entering with v.
#[test]
fn a_rope_paid_out_at_a_constant_rate_hangs_by_its_weight() {
    for integrator in implicit() {
        let mut cable = rope(1.0, 6, integrator);
        let mut effects = cable.effects().clone();
        effects.damping = Some(Damping { axial: 5e-3, bending: 0.0 });
        cable.set_effects(effects).unwrap();
        cable
            .add_reel(At::End, Reel { rate: vec![[0.0, 0.4]], acceleration: 1.0, stock: Some(4.0), ..Reel::default() })
            .unwrap();
        (0..180).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        let reel = cable.reel(At::End).unwrap();
        let weight = 0.4 * G * reel.length_out;
        assert_relative_eq!(reel.length_out, 1.0 + 0.4 * 3.0 - 0.5 * 0.4 * 0.4, epsilon = 1e-6);
        assert!((reel.tension / weight - 1.0).abs() < 0.01, "{:?}: {reel:?} {weight} N", integrator.method);
        // the free end moves with the rate
        let speed = cable.sample(0.0).unwrap().velocity;
        assert!((speed.y + 0.4).abs() < 5e-3, "{:?}: {speed:?}", integrator.method);
        // the configurational force: T f less the strain energy per length
        let f = 1.0 + weight / 1.0e4;
        assert!((reel.force - reel.tension * f).abs() < 0.02 * weight, "{:?}: {reel:?}", integrator.method);
        (0..600).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        let reel = cable.reel(At::End).unwrap();
        assert!(
            reel.stopped && reel.rate == 0.0 && reel.length_out <= 4.0 + 1e-9 && reel.length_out > 3.99,
            "{reel:?}"
        );
    }
}

/// A mass on a light, stiff rope whose length changes, against its own equation: l = 1.5 + 0.1 t and a wave.
///
/// *Source.* `(l^2 theta')' = -g l sin theta`, by the classical Runge-Kutta method here, with the length that the reel has out.
#[test]
fn a_pendulum_of_variable_length_follows_its_equation() {
    let tolerance = StepControl::ToleranceOf(1e-7, ErrorNorm::Bodies);
    for (method, control, swing) in [
        (Method::Esdirk4, tolerance, 0.6),
        (Method::DiscreteGradient, StepControl::Substeps(1), 0.6),
        (Method::DiscreteGradient, StepControl::Substeps(3), 0.6),
        (Method::DiscreteGradient, StepControl::Substeps(1), -0.4),
    ] {
        let integrator = Integrator { method, control };
        let (mut theta, mut omega) = (0.6f64, 0.0f64);
        let start = 1.5 * Vector3::new(theta.sin(), -theta.cos(), 0.0);
        let mut cable = Cable::builder()
            .points([start, Vector3::zeros()])
            .section(Section::from_stiffness(1.0e6, 1e-4, 2e-4).unwrap())
            .elements(8)
            .integrator(integrator)
            .fix(At::End)
            .build()
            .unwrap();
        cable.attach(At::Start).unwrap();
        // slower than free fall: a rope does not push
        cable.add_reel(At::End, Reel { acceleration: 4.0, ..Reel::default() }).unwrap();
        let mut bodies = [RigidBody::new(1.0, Matrix3::identity() * 1e-3, start).unwrap()];
        bodies[0].force = Vector3::new(0.0, -G, 0.0);
        let pin = PinConstraint { cable: 0, node: 0, body: 0, anchor: Vector3::zeros(), direction: None };
        let mut island = Island::default();
        let dt = 1.0 / 240.0;
        let mut worst: f64 = 0.0;
        let mut rate_before = 0.0;
        for step in 0..2400 {
            let t = f64::from(step) * dt;
            let rate = if t < 4.0 { 0.1 } else { swing * (2.0 * (t - 4.0)).sin() };
            cable.set_reel_rate(At::End, rate).unwrap();
            cable.remesh_reel().unwrap();
            let l0 = cable.length();
            island.step(&mut [&mut cable], &mut bodies, &[pin], integrator, dt).unwrap();
            let acceleration = (cable.reel(At::End).unwrap().rate - rate_before) / dt;
            let (r0, n) = (rate_before, 20);
            rate_before = cable.reel(At::End).unwrap().rate;
            let slope = |s: f64, th: f64, om: f64| {
                let (l, r) = (l0 + s * (r0 + 0.5 * s * acceleration), r0 + s * acceleration);
                (om, (-G * th.sin() - 2.0 * r * om) / l)
            };
            for k in 0..n {
                let (h, s) = (dt / f64::from(n), dt * f64::from(k) / f64::from(n));
                let a = slope(s, theta, omega);
                let b = slope(s + 0.5 * h, theta + 0.5 * h * a.0, omega + 0.5 * h * a.1);
                let c = slope(s + 0.5 * h, theta + 0.5 * h * b.0, omega + 0.5 * h * b.1);
                let d = slope(s + h, theta + h * c.0, omega + h * c.1);
                theta += h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0);
                omega += h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1);
            }
            let expected = cable.length() * Vector3::new(theta.sin(), -theta.cos(), 0.0);
            worst = worst.max((bodies[0].position - expected).norm() / cable.length());
        }
        let reel = cable.reel(At::End).unwrap();
        println!("{method:?}: {worst:.2e} of the length, {reel:?}");
        assert!(reel.splits >= 2 && reel.merges >= 1);
        assert!(worst < 1e-3, "{method:?}: {worst:e}");
    }
}

/// What is asked of a reel before a host step is reached at its end, linearly, into however many steps method, host and reel divide it; also by a motor that is strong enough.
///
/// *Source.* The integral of a rate that is linear in every host step.
#[test]
fn rates_are_linear_over_a_host_step() {
    let methods = [
        (Method::Esdirk4, StepControl::Tolerance(1e-5)),
        (Method::DiscreteGradient, StepControl::Substeps(1)),
        (Method::DiscreteGradient, StepControl::MaxStep(1.0 / 240.0)),
    ];
    for (method, control) in methods {
        // more passes in a host step than an element takes at once
        for (elements, motor) in [(4, false), (40, false), (4, true), (40, true)] {
            if motor && method != Method::DiscreteGradient {
                continue;
            }
            let mut cable = rope(1.0, elements, Integrator { method, control });
            let max_force = motor.then_some(1e6);
            cable.add_reel(At::End, Reel { acceleration: 1e3, max_force, ..Reel::default() }).unwrap();
            let (dt, mut expected) = (1.0 / 60.0, 1.0);
            let asked = |step: i32| 0.8 * (f64::from(step) * 0.1).sin();
            for step in 0..90 {
                cable.set_reel_rate(At::End, asked(step + 1)).unwrap();
                cable.step(dt).unwrap();
                expected += 0.5 * dt * (asked(step) + asked(step + 1));
                let reel = cable.reel(At::End).unwrap();
                let missed = [reel.rate - asked(step + 1), reel.length_out - expected].map(f64::abs);
                assert!(missed.iter().all(|x| *x < 1e-12), "{method:?}, {elements}, {motor}, {step}: {missed:?}");
            }
        }
    }
}

/// A reel that runs to the end of its stock, or takes in to the least length, ends exactly there, prescribed or with a motor, at any
/// acceleration, rate and step.
///
/// *Source.* The stock; 0.4 of an element of 0.25 m. The sum of the lengths of steps is a sum of numbers with rounding.
#[test]
fn a_reel_ends_exactly_at_its_stop() {
    let mut random = Random::new(7);
    for trial in 0..24 {
        let mut between = |low, high| random.between(low, high);
        let (acceleration, speed, dt) = (between(0.7, 8.0), between(0.3, 2.0), 1.0 / between(60.0, 500.0));
        let (stock, motor) = (between(1.3, 1.9), trial % 2 == 0);
        let mut cable =
            rope(1.0, 4, Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) });
        let max_force = motor.then_some(1e3);
        let reel = Reel { acceleration, stock: Some(stock), max_force, ..Reel::with_rate(speed) };
        cable.add_reel(At::End, reel).unwrap();
        let least = 0.1;
        for (rate, expected) in [(speed, stock), (-speed, least)] {
            cable.set_reel_rate(At::End, rate).unwrap();
            let mut beyond = 0.0f64;
            for _ in 0..(8.0 / dt) as usize {
                cable.step(dt).unwrap();
                let reel = cable.reel(At::End).unwrap();
                beyond = beyond.max((reel.length_out - expected) * rate.signum());
                if reel.stopped && reel.rate == 0.0 {
                    break;
                }
            }
            let reel = cable.reel(At::End).unwrap();
            let missed = (reel.length_out - expected).abs();
            println!(
                "{acceleration:.2} m/s^2, {rate:.2} m/s, 1/{:.0} s: {missed:.1e} m, beyond {beyond:.1e} m",
                1.0 / dt
            );
            assert!(missed < 1e-12 && beyond < 1e-12 && reel.rate == 0.0, "{missed:e} {beyond:e} {reel:?}");
        }
    }
}
