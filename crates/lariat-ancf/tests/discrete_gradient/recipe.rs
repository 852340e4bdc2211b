//! Cables drawn by chance: of any stiffness, slack or taut, held anyhow, thrown, and disturbed in the middle of the run.

use crate::common::Random;
use lariat_ancf::{At, Cable, Integrator, Method, Motion, Rule, Section, SlopeSupport, StepControl, Support, Vector3};

/// What happens in the middle of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Disturbance {
    None,
    FlippedGravity,
    Kick(Vector3<f64>),
    Released,
}

/// A cable and what is done to it.
pub struct Scene {
    pub cable: Cable,
    pub disturbance: Disturbance,
    /// Whether a support moves.
    pub driven: bool,
}

pub fn power(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(low + 0.5 * (high - low) * (1.0 + random.next()))
}

pub fn choose(random: &mut Random, n: usize) -> usize {
    ((0.5 * (1.0 + random.next()) * n as f64) as usize).min(n - 1)
}

/// The scene of a seed, with a rule.
pub fn scene(seed: u64, rule: Rule, method: Method, longest: f64) -> Scene {
    let random = &mut Random::new(seed);
    let corners = 2 + choose(random, 2);
    let mut points = vec![Vector3::zeros()];
    for _ in 1..corners {
        let angle = std::f64::consts::PI * random.next();
        let last = points[points.len() - 1];
        points.push(last + Vector3::new(angle.cos(), 0.4 * angle.sin(), 0.5 * angle.sin()) * 0.8);
    }
    let drawn: f64 = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    let bending = if choose(random, 4) == 0 { 0.0 } else { power(random, -6.0, 1.0) };
    let section = Section::from_stiffness(power(random, 3.0, 7.0), bending, power(random, -2.0, 0.5)).unwrap();
    let weightless = choose(random, 3) == 0;
    let gravity = if weightless { Vector3::zeros() } else { Vector3::new(0.0, -9.81, 0.0) };
    let mut builder = Cable::builder()
        .points(points.clone())
        .section(section)
        .length(drawn * (0.95 + 0.2 * (1.0 + random.next())))
        .elements(2 + choose(random, 11))
        .gravity(gravity)
        .velocity(random.vector() * 5.0)
        .angular_velocity(random.vector() * 10.0)
        .rule(rule)
        .integrator(Integrator { method, control: StepControl::MaxStep(longest) });
    let holding = choose(random, 6);
    if holding == 1 || holding == 2 {
        builder = builder.fix(At::Start);
    }
    if holding == 2 {
        builder = builder.fix(At::End);
    }
    if holding == 3 {
        builder = builder.clamp(At::Start);
    }
    let mut cable = builder.build().unwrap();
    let driven = holding == 4;
    if driven {
        let motion = Motion::uniform(0.0, points[0], random.vector() * 5.0);
        let slope = SlopeSupport::Free;
        cable.set_support(At::Start, Support { position: Some(motion), slope, ..Support::default() }).unwrap();
    }
    let disturbance = match choose(random, 4) {
        0 => Disturbance::FlippedGravity,
        1 => Disturbance::Kick(random.vector() * 10.0),
        2 => Disturbance::Released,
        _ => Disturbance::None,
    };
    Scene { cable, disturbance, driven }
}

/// Does to a cable what its scene says.
pub fn disturb(cable: &mut Cable, disturbance: Disturbance) {
    match disturbance {
        Disturbance::None => {}
        Disturbance::FlippedGravity => cable.set_gravity(-cable.gravity()).unwrap(),
        Disturbance::Kick(velocity) => {
            let (q, mut v) = (cable.positions().to_vec(), cable.velocities().to_vec());
            let at = v.len() - 6;
            (0..3).for_each(|x| v[at + x] += velocity[x]);
            cable.set_coordinates(&q, &v).unwrap();
        }
        Disturbance::Released => cable.release(At::Start).unwrap(),
    }
}
