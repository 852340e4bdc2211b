//! Bodies that slide along a taut rope.

use crate::bench::{GRAVITY, RADIUS, rope, steps, up, with};
use crate::bodies::{World, on_body};
use lariat_ancf::contact::{Ball, Capsule, Cylinder, Mount, Obstacle, RigidMotion};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Cable, Contact, Damping, Vector3};
use nalgebra::{Matrix3, UnitQuaternion};
use std::f64::consts::FRAC_PI_2;

/// Length of the rope in m, and by how much less it is unstretched: 250 N.
const LENGTH: f64 = 4.0;
const PULL: f64 = 1e-3;
/// Radius of the bodies in m.
const SIZE: f64 = 0.1;

fn taut(elements: usize, damping: f64, obstacle: Obstacle) -> Cable {
    let end = Vector3::new(0.5 * LENGTH, 0.0, 0.0);
    let cable = rope(0.05, &[-end, end], elements).length(LENGTH - PULL).gravity(Vector3::zeros());
    let cable = cable.fix(At::Start).fix(At::End).damping(Damping { axial: damping, bending: damping });
    let mut cable = with(cable.build().unwrap(), vec![obstacle]);
    cable.set_contact(Contact::with_friction(0.0).with_radius(RADIUS)).unwrap();
    cable
}

/// A body with a round side across the rope: 0 a ball, 1 a capsule, 2 a cylinder.
fn round_body(shape: usize) -> Obstacle {
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
    let mount = Mount { body: 0, position: Vector3::zeros(), rotation };
    let half = Vector3::new(0.0, 0.0, 0.15);
    match shape {
        0 => on_body(Ball { radius: SIZE }, 0.0),
        1 => on_body(Capsule { ends: [-half, half], radius: SIZE }, 0.0),
        _ => Obstacle::new(1, Cylinder { half_height: 0.2, radius: SIZE }, Vector3::zeros(), 0.0).on(mount),
    }
}

/// A body that slides along a taut rope without friction is not braked, on meshes that are coarse beside it and on fine ones, slow and fast, light and
/// heavy, in steps of 1/60 to 1/960 s.
///
/// *Source.* A force across the rope does no work along it: what contacts and the method lose is the bounce with which the body begins, and the waves
/// that it sends along the rope, less than 2 % of its energy. Bumps between samples took a third to two thirds.
#[test]
fn a_body_that_slides_along_a_rope_without_friction_is_not_braked() {
    for (shape, elements, rate, mass, speed) in [
        (0, 13, 240.0, 0.8, 1.5),
        (0, 26, 240.0, 0.8, 1.5),
        (0, 32, 240.0, 0.8, 1.5),
        (0, 40, 240.0, 0.8, 1.5),
        (0, 80, 240.0, 0.8, 1.5),
        (0, 40, 60.0, 0.8, 1.5),
        (0, 40, 960.0, 0.8, 1.5),
        (0, 26, 240.0, 4.0, 1.5),
        (0, 40, 240.0, 0.1, 1.5),
        (0, 80, 240.0, 0.8, 4.0),
        (1, 32, 240.0, 0.8, 1.5),
        (2, 32, 120.0, 4.0, 3.0),
    ] {
        let from = Vector3::new(-1.7, SIZE + RADIUS, 0.0);
        let mut body = RigidBody::new(mass, Matrix3::from_diagonal_element(0.4 * mass * SIZE * SIZE), from).unwrap();
        body.force = -GRAVITY * mass * up();
        body.velocity = Vector3::x() * speed;
        body.free = [true, true, false, false, false, false];
        let mut world = World::new(vec![taut(elements, 0.0, round_body(shape))], vec![body]);
        world.integrator = steps(rate);
        let energy = 0.5 * mass * speed * speed;
        let (mut made, mut hosts) = (0.0f64, 0);
        while world.bodies[0].position.x < 1.2 && hosts < 300 {
            made = made.max(world.step());
            hosts += 1;
        }
        let law = world.cables[0].energy_law();
        let lost = (law.contacts + law.numerical + law.shortened) / energy;
        let d = world.cables[0].diagnostics();
        println!(
            "{shape}, {elements} elements, 1/{rate} s, {mass} kg, {speed} m/s: lost {:.2} %, now {:.3} m/s, made {made:.1e}, {:.0} iterations/host, {} divided",
            100.0 * lost,
            world.bodies[0].velocity.x,
            d.newton_iterations as f64 / f64::from(hosts),
            d.split_steps
        );
        assert!(lost < 0.02 && made < 1e-8 * energy, "{shape} {elements} {rate} {mass} {speed}: {lost}");
    }
}

/// A ball that is pressed into a taut rope and moved along it feels the force of the rope, whose elements are 0.08 to 0.15 m long.
///
/// *Source.* Equilibrium of an elastic string of two straight parts, to 5 %: a straight element may not sink in between its samples, by which the force
/// was 0.55 to 1.5 times that.
#[test]
fn a_ball_moved_along_a_rope_feels_its_force() {
    for (elements, speed) in [(26, 0.1), (32, 0.1), (40, 0.1), (32, 0.5)] {
        let depth = 0.03;
        let start = Vector3::new(-0.3, SIZE + RADIUS + 1e-3, 0.0);
        let obstacle = Obstacle::new(1, Ball { radius: SIZE }, start, 0.0);
        let mut cable = taut(elements, 1e-2, obstacle.clone());
        // slowly, since nothing damps the rope's swing
        let down = depth / 3.0;
        let set = |cable: &mut Cable, position: Vector3<f64>, velocity: Vector3<f64>| {
            let mut moved = obstacle.clone();
            moved.motion = RigidMotion { start: cable.time(), position, velocity, ..RigidMotion::default() };
            cable.set_obstacles(vec![moved]).unwrap();
        };
        set(&mut cable, start, -down * up());
        for _ in 0..180 {
            cable.step(1.0 / 60.0).unwrap();
        }
        let pressed = start - depth * up();
        set(&mut cable, pressed, Vector3::zeros());
        for _ in 0..30 {
            cable.step(1.0 / 60.0).unwrap();
        }
        set(&mut cable, pressed, speed * Vector3::x());
        let (from, mut range) = (cable.time(), [f64::INFINITY, 0.0f64]);
        let mut mean = 0.0;
        let hosts = (0.6 / speed * 60.0) as usize;
        for _ in 0..hosts {
            cable.step(1.0 / 60.0).unwrap();
            let x = pressed.x + speed * (cable.time() - from);
            let (a, b, d) = (0.5 * LENGTH + x, 0.5 * LENGTH - x, depth - 1e-3);
            let sides = [a.hypot(d), b.hypot(d)];
            let tension = 1e6 * ((sides[0] + sides[1]) / (LENGTH - PULL) - 1.0);
            let exact = tension * d * (1.0 / sides[0] + 1.0 / sides[1]);
            let force: f64 = cable.contacts().map(|touch| touch.normal_force).sum();
            let ratio = force / exact;
            range = [range[0].min(ratio), range[1].max(ratio)];
            mean += ratio / hosts as f64;
        }
        println!("{elements} elements, {speed} m/s: {:.3} to {:.3} of the force, mean {mean:.4}", range[0], range[1]);
        assert!(
            range[0] > 0.95 && range[1] < 1.05 && (mean - 1.0).abs() < 0.02,
            "{elements} {speed}: {range:?} {mean}"
        );
    }
}
