//! Pendulums of variable length: a body on a rope that a reel pays out and takes in while it swings.

use super::common::{Random, cable, judge, place, told};
use lariat_rapier::convert::to_vector;
use lariat_rapier::lariat_ancf::{At, Fidelity, Reel, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};
use std::ops::{Add, Mul};

const G: f64 = 9.81;

/// The rate that is asked for, in m/s by time in s.
#[derive(Clone, Copy, Debug)]
enum Asked {
    Sine { speed: f64, frequency: f64 },
    Ramp { speed: f64, from: f64, until: f64 },
}

impl Asked {
    fn at(self, t: f64) -> f64 {
        match self {
            Asked::Sine { speed, frequency } => speed * (frequency * t).sin(),
            Asked::Ramp { speed, from, until } => speed * ((t - from) / (until - from)).clamp(0.0, 1.0),
        }
    }
}

/// A load on a rope from a reel, from rest at an angle.
#[derive(Clone, Copy, Debug)]
struct Pendulum {
    mass: f64,
    rope: f64,
    angle: f64,
    section: Section,
    asked: Asked,
    /// Host steps per second.
    rate: usize,
    fidelity: Fidelity,
}

impl Pendulum {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let (mass, rope) = (r.log(0.5, 200.0), r.between(1.0, 8.0));
        let stiffness = mass * G * r.log(2e3, 1e5);
        let section = Section::from_stiffness(stiffness, 1e-9 * stiffness, 1e-4 * mass / rope).unwrap();
        // half of the rope stays out, and it stays taut
        let asked = if r.one(&[true, false]) {
            let frequency = r.between(0.3, 3.0);
            let speed = r.between(0.1, 0.4) * (0.5 * rope * frequency).min(0.5 * G / frequency);
            Asked::Sine { speed, frequency }
        } else {
            let from = r.between(0.0, 3.0);
            Asked::Ramp { speed: r.between(-0.04, 0.2) * rope, from, until: from + r.between(0.5, 4.0) }
        };
        let (angle, rate) = (r.between(0.1, 0.8), r.one(&[60, 90, 120, 240]));
        Pendulum { mass, rope, angle, section, asked, rate, fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]) }
    }

    /// Returns the errors of the load over 10 s, over the length: against the equation, and against that of a rope without stretch; and that of the length; and
    /// what was told.
    fn run(&self) -> ([f64; 3], Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let dt = f64::from(world.integration_parameters.dt);
        let (stiffness, mass) = (self.section.axial_stiffness, self.mass);
        let stretched = self.rope * (1.0 + mass * G * self.angle.cos() / stiffness);
        let start = stretched * Vector3::new(self.angle.sin(), -self.angle.cos(), 0.0);
        let top = world.insert_body(RigidBodyBuilder::fixed());
        let load = RigidBodyBuilder::dynamic().translation(to_vector(&start)).can_sleep(false);
        let load = world.insert(load, ColliderBuilder::ball(0.05).mass(mass as Real)).0;
        let start = place(&world, load);
        let mut set = CableSet::new();
        let rope = cable(start, Vector3::zeros(), self.section).length(self.rope).fidelity(self.fidelity).elements(8);
        let rope = set.insert(rope.build().unwrap());
        set.attach(&world, rope, At::Start, load, Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach(&world, rope, At::End, top, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let reel = Reel { acceleration: 1e3, ..Reel::default() };
        set.get_mut(rope).unwrap().add_reel(At::End, reel).unwrap();
        let (mut elastic, mut rigid) = ([start, Vector3::zeros()], [self.angle, 0.0]);
        let (mut length, mut errors) = (self.rope, [0.0f64; 3]);
        for step in 0..10 * self.rate {
            let rates = [step, step + 1].map(|step| self.asked.at(step as f64 * dt));
            set.get_mut(rope).unwrap().set_reel_rate(At::End, rates[1]).unwrap();
            if let Err(error) = set.step(&mut world) {
                return ([f64::NAN; 3], vec![error.to_string()]);
            }
            // what is asked for is reached linearly over the host step
            let rate = |s: f64| rates[0] + s / dt * (rates[1] - rates[0]);
            let out = |s: f64| length + 0.5 * s * (rates[0] + rate(s));
            let pulled = |s: f64, [x, v]: [Vector3<f64>; 2]| {
                let f = x.norm() / out(s);
                [v, -x / x.norm() * (stiffness * 0.5 * (f * f - 1.0) * f / mass) - G * Vector3::y()]
            };
            let swung = |s: f64, [x, v]: [f64; 2]| [v, (-G * x.sin() - 2.0 * rate(s) * v) / out(s)];
            // the fastest vibration is that of the shortest rope
            let parts = ((stiffness / mass / (0.5 * self.rope)).sqrt() * dt / 0.05).ceil();
            let h = dt / parts;
            for k in 0..parts as usize {
                elastic = runge_kutta(pulled, k as f64 * h, h, elastic);
                rigid = runge_kutta(swung, k as f64 * h, h, rigid);
            }
            length = out(dt);
            let (at, reel) = (place(&world, load), set.get(rope).unwrap().reel(At::End).unwrap());
            let without_stretch = length * Vector3::new(rigid[0].sin(), -rigid[0].cos(), 0.0);
            let own = [(at - elastic[0]).norm(), (at - without_stretch).norm(), (reel.length_out - length).abs()];
            (0..3).for_each(|i| errors[i] = errors[i].max(own[i] / length));
        }
        (errors, told(&set, &world))
    }
}

/// Takes a step of the classical Runge-Kutta method.
fn runge_kutta<T>(slope: impl Fn(f64, [T; 2]) -> [T; 2], s: f64, h: f64, y: [T; 2]) -> [T; 2]
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T>,
{
    let moved = |by: f64, d: [T; 2]| [y[0] + d[0] * by, y[1] + d[1] * by];
    let a = slope(s, y);
    let b = slope(s + 0.5 * h, moved(0.5 * h, a));
    let c = slope(s + 0.5 * h, moved(0.5 * h, b));
    let d = slope(s + h, moved(h, c));
    core::array::from_fn(|i| y[i] + (a[i] + (b[i] + c[i]) * 2.0 + d[i]) * (h / 6.0))
}

/// A body on a light rope from a reel, at 60 to 240 Hz and either fidelity, swings as its equation says, to 1e-3 of the length in 10 s; and what is out is the
/// integral of the rate to rounding.
///
/// Reference: `m x'' = -N x/|x| + m g` with `N = EA eps f`, eps = (f^2 - 1)/2 and f = |x|/l, and `l' = r`, r linear over each host step, by the classical
/// Runge-Kutta method. That of a rope without stretch, `(l^2 theta')' = -g l sin theta`, is printed beside it: its frequency is that of another length, off by half of the strain m g/EA, which adds up.
#[test]
fn a_body_on_a_rope_of_variable_length_follows_its_equation() {
    judge(0..12, 0.2, |seed| {
        let pendulum = Pendulum::random(seed);
        let ([error, rigid, length], told) = pendulum.run();
        let strain = pendulum.mass * G / pendulum.section.axial_stiffness;
        let case = format!(
            "{seed}: {error:.1e}, without stretch ({strain:.1e}) {rigid:.1e}, length {length:.1e}, told {told:?}: {pendulum:?}"
        );
        // lengths of up to 2400 host steps are sums with rounding
        let off = !(error < 1e-3 && length < 1e-12);
        (off, vec![], case)
    });
}
