//! Bodies in contact: several in series on ropes, the last jammed; a crate that is dragged over a floor; one that is set down and lifted.

use super::common::{Random, cable, judge, place, told};
use lariat_rapier::convert::to_vector;
use lariat_rapier::lariat_ancf::{At, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet, Event};

/// Bodies in series on ropes, drawn by a winch; the first is jammed against a stop.
#[derive(Clone, Debug)]
struct Series {
    masses: Vec<f64>,
    ropes: Vec<f64>,
    section: Section,
    /// Share of critical damping of a rope's first mode, 0 for none.
    damping: f64,
    tension: f64,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

/// What is read at a rope.
#[derive(Clone, Copy, Debug)]
struct Pull {
    /// Force in N on the body before it at its least and most, in the second half second after the winch stops, and in the last of two and a half.
    early: [f64; 2],
    late: [f64; 2],
    /// Force in N by its stretch in the end.
    of_stretch: f64,
}

impl Series {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let count = r.one(&[1, 2, 3]);
        let (masses, ropes): (Vec<f64>, Vec<f64>) = (0..count).map(|_| (r.log(0.2, 50.0), r.log(0.5, 4.0))).unzip();
        let stiffness = r.log(3e4, 3e6);
        let section = Section::from_stiffness(stiffness, 1e-8 * stiffness, r.log(0.003, 0.1)).unwrap();
        Series {
            // a stretch far above what Rapier rounds places to
            tension: (r.log(0.5, 50.0) * 9.81 * masses.iter().copied().fold(0.0, f64::max).min(10.0))
                .max(3e-5 * stiffness),
            masses,
            ropes,
            section,
            damping: r.one(&[0.0, 0.1, 0.3, 1.0]),
            fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]),
            iterations: r.one(&[1, 4]),
            rate: r.one(&[30, 60, 120, 240]),
        }
    }

    /// Returns what is read at each rope, and what was told.
    fn run(&self) -> (Vec<Pull>, Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        for z in [-0.2, 0.2] {
            let stop = ColliderBuilder::cuboid(0.1, 0.5, 0.15).translation(Vector::new(0.2, 0.0, z));
            world.insert_collider(stop, None);
        }
        let mut set = CableSet::new();
        let mut bodies = Vec::new();
        let mut x = 0.0;
        let mut ends = Vec::new();
        for (i, (mass, length)) in self.masses.iter().zip(&self.ropes).enumerate() {
            let half_z = if i == 0 { 0.2 } else { 0.05 };
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, 0.0, 0.0)).can_sleep(false);
            bodies.push(world.insert(body, ColliderBuilder::cuboid(0.1, 0.1, half_z).mass(*mass as Real)).0);
            ends.push([x + 0.1, x + 0.1 + length]);
            x += length + 0.2;
        }
        let winch = RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new((x - 0.1) as Real, 0.0, 0.0));
        bodies.push(world.insert_body(winch));
        let winch = *bodies.last().unwrap();
        let mut hooks = Vec::new();
        let mut ropes = Vec::new();
        for (i, [from, to]) in ends.into_iter().enumerate() {
            let mode = std::f64::consts::FRAC_PI_2
                * (self.section.axial_stiffness / self.section.mass_per_length).sqrt()
                / self.ropes[i];
            let mut rope = cable(Vector3::x() * from, Vector3::x() * to, self.section).gravity(Vector3::zeros());
            if self.damping > 0.0 {
                let time = 2.0 * self.damping / mode;
                rope = rope.damping(Damping { axial: time, bending: time });
            }
            let rope = set.insert(rope.fidelity(self.fidelity).elements(6).build().unwrap());
            hooks.push(set.attach_here(&world, rope, At::Start, bodies[i], AttachmentKind::Ball).unwrap());
            set.attach_here(&world, rope, At::End, bodies[i + 1], AttachmentKind::Ball).unwrap();
            ropes.push(rope);
        }
        let stretch = self.tension / self.section.axial_stiffness * self.ropes.iter().sum::<f64>();
        let half_second = self.rate / 2;
        let mut degraded = false;
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let mut pulls = vec![Pull { early: none, late: none, of_stretch: 0.0 }; hooks.len()];
        for k in 0..8 * half_second {
            let t = (k as f64 + 0.5) / half_second as f64;
            // smooth, so that little swings on
            let speed = if t < 2.0 { stretch * (1.0 - (std::f64::consts::PI * t).cos()) } else { 0.0 };
            world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
            if let Err(error) = set.step(&mut world) {
                return (vec![], vec![error.to_string()]);
            }
            degraded |= set.events().iter().any(|event| matches!(event, Event::Degraded { .. }));
            for (hook, pull) in hooks.iter().zip(&mut pulls) {
                let force = set.attachment(*hook).unwrap().force().x;
                let window = match k / half_second {
                    3 => &mut pull.early,
                    7 => &mut pull.late,
                    _ => continue,
                };
                *window = [window[0].min(force), window[1].max(force)];
            }
        }
        for ((rope, length), pull) in ropes.iter().zip(&self.ropes).zip(&mut pulls) {
            let rope = set.get(*rope).unwrap();
            let stretch = (rope.node_position(6) - rope.node_position(0)).norm() / length;
            pull.of_stretch = self.section.axial_stiffness * 0.5 * (stretch * stretch - 1.0) * stretch;
        }
        let degraded = degraded.then(|| "Degraded".to_string());
        (pulls, told(&set, &world).into_iter().chain(degraded).collect())
    }
}

/// Bodies in series are pulled with the same force, that of the stretch, within 5 % and what the winch left swinging, and nothing grows; or
/// something is told.
///
/// Reference: equilibrium, and the law of each rope.
#[test]
fn bodies_in_series_are_jammed_with_the_same_force_or_tell() {
    judge(0..40, 0.2, |seed| {
        let series = Series::random(seed);
        let (pulls, told) = series.run();
        let mean = pulls.iter().map(|pull| pull.of_stretch).sum::<f64>() / pulls.len() as f64;
        let same = pulls.iter().all(|pull| {
            // what the winch left swinging goes on without damping, and does not grow
            let swings = if series.damping > 0.0 { 0.0 } else { 0.5 * (pull.early[1] - pull.early[0]) };
            let near = |force: f64| (force - mean).abs() < 0.05 * mean + swings;
            pull.late.into_iter().all(near) && near(pull.of_stretch)
        });
        let off = pulls.is_empty() || !same;
        let case = format!("{seed}: {:.2} N: {pulls:.2?}, told {told:?}: {series:?}", series.tension);
        (off, told, case)
    });
}

/// A crate that a rope from a winch drags over a floor.
#[derive(Clone, Copy, Debug)]
struct Drag {
    mass: f64,
    friction: f64,
    rope: f64,
    /// Height of the rope over the middle of the crate, as a share of half its height.
    hook: f64,
    speed: f64,
    section: Section,
    damping: f64,
    clamp: bool,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

impl Drag {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let stiffness = r.log(3e4, 3e6);
        Drag {
            mass: r.log(0.5, 200.0),
            friction: r.between(0.1, 0.8),
            rope: r.log(0.5, 5.0),
            hook: r.between(-0.5, 0.3),
            speed: r.log(0.05, 3.0),
            section: Section::from_stiffness(stiffness, 1e-8 * stiffness, r.log(0.003, 0.1)).unwrap(),
            damping: r.log(1e-3, 3e-2),
            clamp: r.one(&[false, true]),
            fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]),
            iterations: r.one(&[1, 4]),
            rate: r.one(&[30, 60, 120, 240]),
        }
    }

    /// Returns the mean force on the crate along the floor in the last two seconds of four, by a Hann window since a soft rope swings, and what was
    /// told.
    fn run(&self) -> (f64, Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let floor = ColliderBuilder::cuboid(50.0, 0.5, 50.0).friction(self.friction as Real);
        world.insert_collider(floor.translation(Vector::new(0.0, -0.5, 0.0)), None);
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.15, 0.0)).can_sleep(false);
        let shape = ColliderBuilder::cuboid(0.3, 0.15, 0.3).friction(self.friction as Real).mass(self.mass as Real);
        let crate_ = world.insert(body, shape).0;
        let from = Vector3::new(0.3, 0.15 * (1.0 + self.hook), 0.0);
        let to = from + Vector3::x() * self.rope;
        let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(to_vector(&to)));
        let mut set = CableSet::new();
        let rope = cable(from, to, self.section)
            .gravity(Vector3::zeros())
            .damping(Damping { axial: self.damping, bending: self.damping })
            .fidelity(self.fidelity)
            .elements(6);
        let rope = set.insert(rope.build().unwrap());
        let kind = if self.clamp { AttachmentKind::Clamp } else { AttachmentKind::Ball };
        let hook = set.attach_here(&world, rope, At::Start, crate_, kind).unwrap();
        set.attach_here(&world, rope, At::End, winch, AttachmentKind::Ball).unwrap();
        let mut mean = 0.0;
        for k in 0..4 * self.rate {
            let t = k as f64 / self.rate as f64;
            let share = t.min(1.0);
            world.bodies[winch].set_linvel(Vector::new((self.speed * share) as Real, 0.0, 0.0), true);
            if let Err(error) = set.step(&mut world) {
                return (f64::NAN, vec![error.to_string()]);
            }
            if t >= 2.0 {
                let weight = 1.0 - (std::f64::consts::PI * t).cos();
                mean += weight * set.attachment(hook).unwrap().force().x / (2 * self.rate) as f64;
            }
        }
        (mean, told(&set, &world))
    }
}

/// A crate that is dragged steadily pulls with the friction of its weight, within 5 %, or something is told.
///
/// Reference: mu m g, by Coulomb.
#[test]
fn a_dragged_crate_pulls_with_its_friction_or_tells() {
    judge(0..40, 0.2, |seed| {
        let drag = Drag::random(seed);
        let (force, told) = drag.run();
        let expected = drag.friction * drag.mass * 9.81;
        let off = force.is_nan() || (force / expected - 1.0).abs() > 0.05;
        let case = format!("{seed}: {force:.2} of {expected:.2} N, told {told:?}: {drag:?}");
        (off, told, case)
    });
}

/// A crate on a rope from a winch that sets it down on a floor and lifts it again.
#[derive(Clone, Copy, Debug)]
struct Hoist {
    mass: f64,
    rope: f64,
    speed: f64,
    section: Section,
    damping: f64,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

impl Hoist {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let (mass, stiffness) = (r.log(0.5, 500.0), r.log(1e5, 1e7));
        let rope = r.log(0.5, 5.0);
        Hoist {
            mass,
            rope,
            speed: r.log(0.02, 0.2),
            section: Section::from_stiffness(stiffness, 1e-8 * stiffness, r.log(0.003, 0.05) * mass / rope).unwrap(),
            damping: r.log(1e-3, 3e-2),
            fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]),
            iterations: r.one(&[1, 4]),
            rate: r.one(&[30, 60, 120, 240]),
        }
    }

    /// Returns how high the crate is in the end over where the winch holds it, how far it tilts at most, and what was told.
    fn run(&self) -> ([f64; 2], Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let floor = ColliderBuilder::cuboid(5.0, 0.5, 5.0).translation(Vector::new(0.0, -0.5, 0.0));
        world.insert_collider(floor, None);
        let high = 0.2 + 0.3 * self.speed;
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, high as Real, 0.0)).can_sleep(false);
        let load = world.insert(body, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(self.mass as Real)).0;
        let low = Vector3::new(0.0, high + 0.2, 0.0);
        let stretch = self.rope * (self.mass * 9.81 / self.section.axial_stiffness);
        let top = low + Vector3::y() * (self.rope + stretch);
        let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(to_vector(&top)));
        let mut set = CableSet::new();
        let rope = cable(low, top, self.section)
            .length(self.rope)
            .damping(Damping { axial: self.damping, bending: self.damping })
            .fidelity(self.fidelity)
            .elements(6);
        let rope = set.insert(rope.build().unwrap());
        set.attach_here(&world, rope, At::Start, load, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, rope, At::End, winch, AttachmentKind::Ball).unwrap();
        let mut tilt = 0.0f64;
        // half a second down, a half at rest, one up, one at rest; smoothly, so that the crate does not bounce
        for k in 0..3 * self.rate {
            let t = (k as f64 + 0.5) / self.rate as f64;
            let smooth = |from: f64, time: f64| {
                let share = ((t - from) / time).clamp(0.0, 1.0);
                1.0 - (std::f64::consts::TAU * share).cos()
            };
            let share = smooth(1.0, 1.0) - smooth(0.0, 0.5);
            world.bodies[winch].set_linvel(Vector::new(0.0, (self.speed * share) as Real, 0.0), true);
            if let Err(error) = set.step(&mut world) {
                return ([f64::NAN; 2], vec![error.to_string()]);
            }
            tilt = tilt.max(f64::from(world.bodies[load].rotation().to_scaled_axis().length()));
        }
        let hangs = place(&world, winch).y - self.rope - stretch - 0.2;
        ([place(&world, load).y - hangs, tilt], told(&set, &world))
    }
}

/// A crate that is set down and lifted hangs below its winch in the end, upright, or something is told. Its rope may whip still.
///
/// Reference: statics.
#[test]
fn a_crate_is_set_down_and_lifted_or_tells() {
    judge(0..40, 0.2, |seed| {
        let hoist = Hoist::random(seed);
        let ([off_place, tilt], told) = hoist.run();
        let off = off_place.is_nan() || off_place.abs() > 0.01 || tilt > 0.05;
        let case = format!("{seed}: {off_place:.1e} m off, tilt {tilt:.1e}, told {told:?}: {hoist:?}");
        (off, told, case)
    });
}
