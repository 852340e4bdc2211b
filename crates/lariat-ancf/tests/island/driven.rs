//! Cables whose ends are driven by random motions: what the pins give is the momentum that the cable gains.

use crate::bench::Scene;
use crate::common::Random;
use lariat_ancf::island::RigidBody;
use lariat_ancf::{Cable, Fidelity, Integrator, Method, Section, StepControl, Vector3};
use nalgebra::Matrix3;

/// Returns the shares of impulse and angular impulse that are in neither the bodies nor the cable, over 12 host steps in which both ends change
/// their velocities and spins at random. `new` bodies have no memory of the last step, and velocities at its ends beside the mean.
fn lost(seed: u64, integrator: Integrator, gravity: f64, clamped: [bool; 2], new: bool) -> [f64; 2] {
    let mut random = Random::new(seed);
    let section = Section::from_stiffness(10f64.powf(4.0 + random.next()), 10f64.powf(random.next()), 0.5).unwrap();
    let end = Vector3::new(1.5 + 0.4 * random.next(), random.next() * 0.3, random.next() * 0.3);
    let down = Vector3::new(0.0, -gravity, 0.0);
    let cable = Cable::builder().points([Vector3::zeros(), end]).length(2.0 + 0.2 * random.next());
    let cable = cable.elements(6).section(section).gravity(down).build().unwrap();
    let weight = 0.5 * cable.length() * down;
    let ends = [Vector3::zeros(), end];
    let arms = [random.vector() * 0.2, random.vector() * 0.2];
    let bodies = [0, 1].map(|i| {
        let mut body = RigidBody::new(1.0, Matrix3::identity(), ends[i] - arms[i]).unwrap();
        body.free = [false; 6];
        body
    });
    let mut scene = Scene::new(vec![cable], bodies.to_vec(), integrator);
    for (i, at) in [lariat_ancf::At::Start, lariat_ancf::At::End].into_iter().enumerate() {
        scene = if clamped[i] { scene.clamp(0, at, i, arms[i]) } else { scene.pin(0, at, i, arms[i]) };
    }
    let dt = 1.0 / (200.0 + 100.0 * random.next());
    let places = |scene: &Scene| [0, scene.cables[0].nodes() - 1].map(|node| scene.cables[0].node_position(node));
    let [mut missed, mut size, mut missed_angular, mut size_angular] = [0.0f64, 0.0, 0.0, 0.0];
    for _ in 0..12 {
        for body in &mut scene.bodies {
            body.velocity = random.vector() * 3.0;
            body.angular_velocity = random.vector() * 6.0;
            if new {
                body.memory = None;
                body.unsteadiness = [random.vector(), random.vector()].map(|v| [v, v * 2.0]);
            }
        }
        let (before, from) = (scene.cables[0].momentum(), places(&scene));
        scene.try_step(dt).unwrap();
        let (after, to) = (scene.cables[0].momentum(), places(&scene));
        let (mut left, mut left_angular) = (after.linear - before.linear - weight * dt, after.angular - before.angular);
        for (pin, account) in scene.accounts().iter().enumerate() {
            left += account.impulse;
            left_angular += (0.5 * (from[pin] + to[pin])).cross(&account.impulse) + account.angular_impulse;
            size += account.impulse.norm();
            size_angular += account.angular_impulse.norm() + account.impulse.norm() * 2.0;
        }
        missed = missed.max(left.norm());
        missed_angular = missed_angular.max(left_angular.norm());
    }
    [missed / size, missed_angular / size_angular]
}

fn integrators() -> Vec<Integrator> {
    vec![
        Fidelity::Game.integrator(0.0),
        Fidelity::Engineering.integrator(0.0),
        Integrator { method: Method::GeneralisedAlpha { rho: 0.0 }, control: StepControl::Substeps(3) },
        Integrator { method: Method::TrBdf2, control: StepControl::Substeps(2) },
        Integrator { method: Method::Esdirk4, control: StepControl::Substeps(1) },
        Integrator { method: Method::Midpoint, control: StepControl::Substeps(2) },
        Integrator { method: Method::Verlet, control: StepControl::Stable(0.5) },
    ]
}

/// Newton: what the pins give is the impulse of gravity less the change of momentum, to rounding with every method. Without gravity the angular
/// impulses are the change of angular momentum, if an end is clamped: to rounding by the trapezoidal accounts, to what the numerical
/// dissipation of bending makes by the discrete gradient.
#[test]
fn pins_of_driven_bodies_give_the_momentum_of_the_cable() {
    for integrator in integrators() {
        let angular_bound = if integrator.method == Method::DiscreteGradient { 1e-3 } else { 1e-13 };
        for seed in 0..8 {
            let (clamps, new) = ([seed % 3 == 0, seed % 2 == 0], seed % 4 < 2);
            let [linear, _] = lost(seed, integrator, 9.81, clamps, new);
            let [floating, angular] = lost(seed + 100, integrator, 0.0, [seed % 3 == 0, true], new);
            let found = format!("{integrator:?}, seed {seed}: {linear:.1e} {floating:.1e} {angular:.1e}");
            assert!(linear.max(floating) < 1e-13 && angular < angular_bound, "{found}");
        }
    }
}
