//! Winches: a crane that slews with a load on its rope, and a rope that is drawn tight on a body in front of a stop.

use super::common::{Random, cable, judge, place, told};
use lariat_rapier::convert::to_vector;
use lariat_rapier::lariat_ancf::{At, Damping, Drag, Fidelity, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A load on a rope from a point that goes on a circle, from rest.
#[derive(Clone, Copy, Debug)]
struct Crane {
    radius: f64,
    /// In rad/s, reached after `ramp` (s).
    speed: f64,
    ramp: f64,
    rope: f64,
    load: f64,
    section: Section,
    damping: f64,
    by_pose: bool,
    fidelity: Fidelity,
    rate: usize,
}

impl Crane {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let (rope, load, stiffness) = (r.log(0.5, 5.0), r.log(0.5, 100.0), r.log(3e4, 3e6));
        let section = Section::from_stiffness(stiffness, 1e-8 * stiffness, r.log(0.003, 0.1) * load / rope).unwrap();
        let mode = std::f64::consts::FRAC_PI_2 * (stiffness / section.mass_per_length).sqrt() / rope;
        Crane {
            radius: r.log(0.3, 5.0),
            speed: r.log(0.2, 2.0),
            ramp: r.one(&[0.0, 0.5]),
            rope,
            load,
            section,
            damping: 2.0 * r.one(&[0.0, 0.2]) / mode,
            by_pose: r.one(&[false, true]),
            fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]),
            rate: r.one(&[30, 60, 120, 240]),
        }
    }

    fn tip(&self, t: f64) -> Vector3<f64> {
        let angle =
            if t < self.ramp { 0.5 * self.speed * t * t / self.ramp } else { self.speed * (t - 0.5 * self.ramp) };
        Vector3::new(self.radius * angle.cos(), 0.0, self.radius * angle.sin())
    }

    /// Returns the path of the load over 2 s, and what was told.
    fn run(&self, fine: bool) -> (Vec<Vector3<f64>>, Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let builder = if self.by_pose {
            RigidBodyBuilder::kinematic_position_based()
        } else {
            RigidBodyBuilder::kinematic_velocity_based()
        };
        let tip = self.tip(0.0);
        let winch = world.insert_body(builder.translation(to_vector(&tip)));
        let low = tip - Vector3::y() * self.rope * (1.0 + self.load * 9.81 / self.section.axial_stiffness);
        let load = RigidBodyBuilder::dynamic().translation(to_vector(&low)).can_sleep(false);
        let load = world.insert(load, ColliderBuilder::ball(0.05).mass(self.load as Real)).0;
        let mut rope = cable(tip, low, self.section).length(self.rope).elements(6).fidelity(self.fidelity).elements(6);
        if self.damping > 0.0 {
            rope = rope.damping(Damping { axial: self.damping, bending: self.damping });
        }
        if fine {
            let control = StepControl::Tolerance(1e-7);
            rope = rope.integrator(Integrator { method: "esdirk4".parse().unwrap(), control });
        }
        let mut set = CableSet::new();
        let rope = set.insert(rope.build().unwrap());
        set.attach_here(&world, rope, At::Start, winch, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, rope, At::End, load, AttachmentKind::Ball).unwrap();
        let mut path = vec![place(&world, load)];
        for k in 1..=2 * self.rate {
            let next = self.tip(k as f64 / self.rate as f64);
            if self.by_pose {
                world.bodies[winch].set_next_kinematic_position(Pose::from_translation(to_vector(&next)));
            } else {
                let velocity = (next - place(&world, winch)) * self.rate as f64;
                world.bodies[winch].set_linvel(to_vector(&velocity), true);
            }
            if let Err(error) = set.step(&mut world) {
                return (path, vec![error.to_string()]);
            }
            path.push(place(&world, load));
        }
        (path, told(&set, &world))
    }
}

/// The load of a crane that slews moves as in fine steps, within 5 % of its way, or tells.
///
/// Reference: the same with 960 host steps per second by poses, and an integrator that controls its error.
#[test]
fn the_load_of_a_slewing_crane_moves_as_in_fine_steps_or_tells() {
    judge(0..12, 0.2, |seed| {
        let crane = Crane::random(seed);
        let ((path, told), (fine, _)) = (crane.run(false), Crane { by_pose: true, rate: 960, ..crane }.run(true));
        let way = fine.iter().map(|x| (x - fine[0]).norm()).fold(0.0, f64::max);
        let apart = path.iter().zip(fine.iter().step_by(960 / crane.rate)).map(|(a, b)| (a - b).norm());
        let error = apart.fold(0.0, f64::max) / way;
        let case = format!("{seed}: {error:.4} of {way:.3} m, told {told:?}: {crane:?}");
        let off = !error.is_finite() || error > 0.05;
        (off, told, case)
    });
}

/// A box that a rope pulls against a stop, by a winch that draws the rope tight and stops.
#[derive(Clone, Copy, Debug)]
struct Jam {
    mass: f64,
    rope: f64,
    section: Section,
    damping: f64,
    /// In N.
    tension: f64,
    /// In m.
    before: f64,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

impl Jam {
    fn random(seed: u64) -> Self {
        let mut r = Random::new(seed);
        let (mass, rope, stiffness) = (r.log(0.5, 50.0), r.log(0.5, 4.0), r.log(3e4, 3e6));
        let section = Section::from_stiffness(stiffness, 1e-8 * stiffness, r.log(0.01, 0.3) / rope).unwrap();
        let mode = std::f64::consts::FRAC_PI_2 * (stiffness / section.mass_per_length).sqrt() / rope;
        Jam {
            mass,
            rope,
            section,
            damping: 2.0 * r.one(&[0.1, 0.3]) / mode,
            tension: r.log(0.5, 50.0) * mass * 9.81,
            before: r.one(&[0.0, 0.03]),
            fidelity: r.one(&[Fidelity::Game, Fidelity::Engineering]),
            iterations: r.one(&[1, 4]),
            rate: r.one(&[30, 60, 120, 240]),
        }
    }

    /// Returns the tension that is read at both ends of the last half second at its least and at its most, that of the stretch, and what was told.
    fn run(&self) -> ([f64; 2], f64, Vec<String>) {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        // the stop has a hole for the rope
        for z in [-0.2, 0.2] {
            let stop = ColliderBuilder::cuboid(0.1, 0.5, 0.15).translation(Vector::new(0.2, 0.0, z));
            world.insert_collider(stop, None);
        }
        let body =
            RigidBodyBuilder::dynamic().translation(Vector::new(-self.before as Real, 0.0, 0.0)).can_sleep(false);
        let body = world.insert(body, ColliderBuilder::cuboid(0.1, 0.1, 0.2).mass(self.mass as Real)).0;
        let from = Vector3::new(0.1 - self.before, 0.0, 0.0);
        let to = from + Vector3::x() * self.rope;
        let winch = world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(to_vector(&to)));
        let rope = cable(from, to, self.section)
            .gravity(Vector3::zeros())
            .damping(Damping { axial: self.damping, bending: self.damping })
            .fidelity(self.fidelity)
            .elements(6);
        let mut set = CableSet::new();
        let mut rope = rope.build().unwrap();
        // a rope buckles whenever the body runs ahead of it, and nothing else would damp how it swings across from then on
        rope.set_drag(Drag { diameter: Some(0.01), ..Drag::new(1000.0, 1.2, 0.0, Default::default()) }).unwrap();
        let rope = set.insert(rope);
        let hook = set.attach_here(&world, rope, At::Start, body, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, rope, At::End, winch, AttachmentKind::Ball).unwrap();
        let stretch = self.tension / self.section.axial_stiffness * self.rope;
        let steps = self.rate / 2;
        let speed = (self.before + stretch) / 0.5;
        let mut seen = [f64::INFINITY, f64::NEG_INFINITY];
        for k in 0..4 * steps {
            let speed = if k < steps { speed } else { 0.0 };
            world.bodies[winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
            if let Err(error) = set.step(&mut world) {
                return ([f64::NAN; 2], f64::NAN, vec![error.to_string()]);
            }
            if k >= 3 * steps {
                let force = set.attachment(hook).unwrap().force().x;
                seen = [seen[0].min(force), seen[1].max(force)];
            }
        }
        let rope = set.get(rope).unwrap();
        let stretch = (rope.node_position(6) - rope.node_position(0)).norm() / self.rope;
        // Green's strain
        let expected = self.section.axial_stiffness * 0.5 * (stretch * stretch - 1.0) * stretch;
        (seen, expected, told(&set, &world))
    }
}

/// The force on a body that a rope jams against a stop is that of the stretch, steadily, within 5 %, or something is told.
///
/// Reference: the law of the rope, between where body and winch hold it.
#[test]
fn a_rope_jams_a_body_with_the_force_of_its_stretch_or_tells() {
    // known: more false alarms than the fifth that is wanted
    judge(0..40, 0.25, |seed| {
        let jam = Jam::random(seed);
        let (seen, expected, told) = jam.run();
        let off = !seen.iter().all(|force| (force / expected - 1.0).abs() < 0.05);
        let case = format!("{seed}: {:.2} to {:.2} of {expected:.2} N, told {told:?}: {jam:?}", seen[0], seen[1]);
        (off, told, case)
    });
}
