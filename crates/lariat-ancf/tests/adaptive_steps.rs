//! How many steps adaptive control takes: few where motion is calm, without a loss that is seen.

mod common;

use common::pendulum;
use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::effect::Contact;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, CableBuilder, Error, Fidelity, Integrator, Method, Section, StepControl, Vector3};
use nalgebra::Matrix3;

const FRAME: f64 = 1.0 / 60.0;

/// That of fidelity game.
const FIXED: Integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };

/// A rope of 10 mm that hangs at an angle (rad), straight.
fn hanging(length: f64, angle: f64) -> CableBuilder {
    let end = Vector3::new(angle.sin(), -angle.cos(), 0.0) * length;
    Cable::builder()
        .points([Vector3::zeros(), end])
        .section(Section::round(0.01, 1e8, 1200.0).unwrap())
        .elements(16)
        .rule(Fidelity::Game.rule())
        .integrator(Integrator::ADAPTIVE)
        .fix(At::Start)
}

/// The same, in equilibrium.
fn at_rest(length: f64) -> Cable {
    let mut rope = hanging(length, 0.0).build().unwrap();
    rope.equilibrium().unwrap();
    rope
}

/// Advances by a host step, and returns the number of steps that were accepted.
fn steps(cable: &mut Cable, dt: f64) -> u64 {
    let before = cable.diagnostics().steps;
    cable.step(dt).unwrap();
    cable.diagnostics().steps - before
}

/// Energies, and the store.
fn energy(cable: &Cable) -> f64 {
    cable.energy().total() + cable.energy_in_store()
}

/// A rope that hangs at rest takes four steps in each of its first two host steps, since the error of the first is not known, and
/// steps of 1/60 s in those that follow.
///
/// *Source.* The rule of `StepControl::Adaptive`: at rest the error is zero.
#[test]
fn a_rope_at_rest_takes_one_step() {
    let mut rope = at_rest(2.0);
    let taken: Vec<u64> = (0..4).map(|_| steps(&mut rope, FRAME)).collect();
    assert_eq!(taken, [4, 4, 1, 1]);
    for (dt, expected) in
        [(1.0 / 30.0, 2), (1.0 / 240.0, 1), (1.0 / 120.0, 1), (0.5, 30), (f64::from(1.0f32 / 60.0), 1)]
    {
        assert_eq!(steps(&mut rope, dt), expected, "{dt}");
    }
}

/// Ropes of 1 to 5 m that swing by 3 to 11 degrees take at most 2.6 of 4 steps, and end within the tolerance times the number of host
/// steps of the same scene in steps of 1/1920 s.
///
/// *Source.* The tolerance, 1e-4 m in 1/60 s, and the same method at an eighth of the step.
#[test]
fn calm_ropes_take_fewer_steps_within_the_tolerance() {
    let frames = 180;
    for (length, angle) in [(1.0, 0.05), (2.0, 0.05), (2.0, 0.2), (5.0, 0.1)] {
        let path = |control| {
            let mut rope = at_rest(length);
            rope.set_integrator(Integrator { control, ..FIXED }).unwrap();
            let rate = angle * (1.5 * 9.81 / length).sqrt();
            rope.set_rigid_motion(Vector3::zeros(), Vector3::new(0.0, 0.0, rate)).unwrap();
            rope.diagnostics_mut().reset();
            let end = |rope: &Cable| rope.node_position(16);
            let path: Vec<Vector3<f64>> = (0..frames)
                .map(|_| {
                    rope.step(FRAME).unwrap();
                    end(&rope)
                })
                .collect();
            (path, *rope.diagnostics())
        };
        let (exact, _) = path(StepControl::MaxStep(1.0 / 1920.0));
        let error = |path: &[Vector3<f64>]| path.iter().zip(&exact).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        let ((fixed, before), (chosen, now)) = (path(FIXED.control), path(Integrator::ADAPTIVE.control));
        let per = |n: u64| n as f64 / f64::from(frames);
        let (of_fixed, of_chosen) = (error(&fixed), error(&chosen));
        println!(
            "{length} m, {angle} rad: {:.2} steps, {:.2} iterations, {:.2} rejected for {:.2} and {:.2}, error {of_chosen:.1e} for {of_fixed:.1e} m",
            per(now.steps),
            per(now.newton_iterations),
            per(now.rejected_steps),
            per(before.steps),
            per(before.newton_iterations)
        );
        assert!(per(now.steps) < 2.6 && per(now.newton_iterations) < 2.6, "{now:?}");
        assert!(of_chosen < 1e-4 * f64::from(frames), "{of_chosen}");
    }
}

/// Ropes of 0.1 and 1 m that turn about an end without gravity, at 2 to 80 rad/s, lose at most 1e-3 of their angular momentum in a
/// turn; and where they take fewer steps than four, at most 5e-5.
///
/// *Source.* Conservation of angular momentum about the point that is held; `pi a (h w)^3` of it in a turn is what the formula takes.
#[test]
fn a_rope_that_turns_keeps_its_angular_momentum() {
    for length in [0.1, 1.0] {
        for speed in [1.0, 2.0, 5.0, 10.0, 20.0, 40.0, 80.0] {
            let mut rope = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(length, 0.0, 0.0)])
                .section(Section::round(0.01 * length, 1e8, 1200.0).unwrap())
                .elements(10)
                .rule(Fidelity::Game.rule())
                .integrator(Integrator::ADAPTIVE)
                .gravity(Vector3::zeros())
                .angular_velocity(Vector3::new(0.0, 0.0, speed))
                .fix(At::Start)
                .build()
                .unwrap();
            // until the number is chosen
            (0..3).for_each(|_| rope.step(FRAME).unwrap());
            rope.diagnostics_mut().reset();
            let (start, time) = (rope.momentum().angular.z, 3.0);
            (0..180).for_each(|_| rope.step(FRAME).unwrap());
            let lost = 1.0 - rope.momentum().angular.z / start;
            let turns = speed * time / core::f64::consts::TAU;
            let steps = rope.diagnostics().steps as f64 / 180.0;
            println!("{length} m, {speed} rad/s: {steps:.2} steps, {:.1e} of it in a turn", lost / turns);
            assert!(lost / turns < 1e-3 && lost > -1e-6, "{length} m, {speed} rad/s: {lost} in {turns} turns");
            assert!(steps > 3.9 || lost / turns < 5e-5, "{length} m, {speed} rad/s: {lost} in {turns} turns");
        }
    }
}

/// While numbers of steps change, energy and store never rise.
///
/// *Source.* The energy law.
#[test]
fn no_change_of_the_number_makes_energy() {
    for (length, angle) in [(0.5, 0.3), (1.0, 1.0), (2.0, 0.1), (2.0, 1.5), (4.0, 0.5)] {
        let mut rope = hanging(length, angle).build().unwrap();
        let (mut before, mut numbers) = (energy(&rope), Vec::new());
        let scale = 9.81 * 0.0942 * length * length;
        for frame in 0..600 {
            let dt = [FRAME, FRAME, 1.0 / 30.0, 0.011][frame % 4];
            let taken = steps(&mut rope, dt);
            if !numbers.contains(&taken) {
                numbers.push(taken);
            }
            let after = energy(&rope);
            assert!(after - before < 1e-9 * scale, "{length} m, {angle} rad: {} J at {frame}", after - before);
            before = after;
        }
        assert!(numbers.len() > 1, "{numbers:?}");
    }
}

/// A restored snapshot continues bitwise, in as many steps.
///
/// *Source.* The contract of `Cable::restore`.
#[test]
fn a_restored_rope_takes_the_same_steps() {
    let mut rope = hanging(2.0, 0.3).build().unwrap();
    for at in [1, 2, 7, 40, 90] {
        (0..at).for_each(|_| rope.step(FRAME).unwrap());
        let mut other = hanging(2.0, 0.3).build().unwrap();
        let text = serde_json::to_string(rope.snapshot()).unwrap();
        other.restore(serde_json::from_str(&text).unwrap()).unwrap();
        for _ in 0..40 {
            assert_eq!(steps(&mut rope, FRAME), steps(&mut other, FRAME));
        }
        assert_eq!(rope.snapshot(), other.snapshot());
    }
}

/// A rope at rest takes four steps again after each change of its state, its loads or its supports, and beside what it can touch.
///
/// *Source.* The rule of `StepControl::Adaptive`.
#[test]
fn changes_by_the_host_take_four_steps() {
    let calm = || {
        let mut rope = at_rest(2.0);
        (0..3).for_each(|_| rope.step(FRAME).unwrap());
        assert_eq!(steps(&mut rope, FRAME), 1);
        rope
    };
    type Change = fn(&mut Cable);
    let changes: [(&str, Change); 4] = [
        ("velocities", |rope| rope.set_rigid_motion(Vector3::new(1.0, 0.0, 0.0), Vector3::zeros()).unwrap()),
        ("gravity", |rope| rope.set_gravity(Vector3::new(1.0, -9.0, 0.0)).unwrap()),
        ("support", |rope| rope.release(At::Start).unwrap()),
        ("hold", |rope| rope.fix(At::End).unwrap()),
    ];
    for (name, change) in changes {
        let mut rope = calm();
        change(&mut rope);
        assert!(steps(&mut rope, FRAME) >= 4, "{name}");
    }
    let mut rope = hanging(2.0, 0.0).build().unwrap();
    rope.set_contact(Contact::default()).unwrap();
    rope.equilibrium().unwrap();
    let floor = Obstacle::new(1, HalfSpace { normal: Vector3::y() }, Vector3::new(0.0, -3.0, 0.0), 0.5);
    rope.set_obstacles([floor]).unwrap();
    assert!((0..5).all(|_| steps(&mut rope, FRAME) == 4));
}

/// A body that bounces gently on a rope takes one or two steps; four after each change of the body by the host.
///
/// *Source.* As above.
#[test]
fn changes_of_a_body_take_four_steps() {
    let changes: [fn(&mut RigidBody); 5] = [
        |body| body.velocity.x += 1e-3,
        |body| body.angular_velocity.y += 1e-3,
        |body| body.force.x += 0.1,
        |body| body.mass *= 1.01,
        |body| body.memory = None,
    ];
    for (i, change) in changes.into_iter().enumerate() {
        let mut rope = hanging(1.0, 0.0).build().unwrap();
        let node = rope.attach(At::End).unwrap();
        let end = rope.node_position(node);
        let mut body = RigidBody::new(2.0, Matrix3::identity() * 1e-2, end).unwrap();
        body.force = Vector3::new(0.0, -9.81 * 2.0, 0.0);
        let pin = PinConstraint { cable: 0, node, body: 0, anchor: Vector3::zeros(), direction: None };
        let (mut bodies, mut island) = ([body], Island::default());
        let mut step = |rope: &mut Cable, bodies: &mut [RigidBody]| {
            let before = rope.diagnostics().steps;
            island.step(&mut [rope], bodies, &[pin], Integrator::ADAPTIVE, FRAME).unwrap();
            rope.diagnostics().steps - before
        };
        for _ in 0..300 {
            step(&mut rope, &mut bodies);
        }
        assert!(step(&mut rope, &mut bodies) < 4);
        change(&mut bodies[0]);
        assert_eq!(step(&mut rope, &mut bodies), 4, "change {i}");
    }
}

/// Whips that neither 4 nor 8 steps resolve take 4, and no more iterations than steps of 1/240 s.
///
/// *Source.* The same ropes in steps of 1/240 s.
#[test]
fn whips_cost_no_more_than_fixed_steps() {
    let run = |integrator: Integrator| {
        let mut iterations = 0;
        for i in 0..20 {
            let x = f64::from(i);
            let middle = Vector3::new(1.0, -0.5 - 0.3 * (0.7 * x).sin(), 0.4 * (1.3 * x).cos());
            let end = Vector3::new(1.8 + 0.1 * (0.9 * x).sin(), 0.2, 0.3 * (0.4 * x).sin());
            let mut rope = hanging(1.0, 0.0).points([Vector3::zeros(), middle, end]).build().unwrap();
            rope.set_integrator(integrator).unwrap();
            (0..60).for_each(|_| rope.step(FRAME).unwrap());
            iterations += rope.diagnostics().newton_iterations;
        }
        iterations
    };
    let (chosen, fixed) = (run(Integrator::ADAPTIVE), run(FIXED));
    println!("{chosen} iterations for {fixed}");
    assert!(chosen as f64 <= 1.1 * fixed as f64, "{chosen} iterations for {fixed}");
}

/// A tolerance that is not positive, and a method without discrete gradients, are refused.
///
/// *Source.* The contract of `Integrator::checked`.
#[test]
fn a_bad_adaptive_control_is_refused() {
    for tolerance in [0.0, -1.0, f64::NAN] {
        let integrator = Integrator { control: StepControl::Adaptive(tolerance), ..FIXED };
        assert!(matches!(integrator.checked(), Err(Error::InvalidValue { .. })), "{tolerance}");
    }
    let other = Integrator { method: Method::Esdirk4, control: StepControl::Adaptive(1e-4) };
    assert!(matches!(other.checked(), Err(Error::NoErrorEstimate { .. })));
    assert!(pendulum(4).integrator(other).build().is_err());
}
