//! A winch lifts a load over the edge of a roof.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, Fidelity, Reel, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use std::f64::consts::FRAC_PI_2;

const FRICTION: f64 = 0.2;
const ROPE: f64 = 0.006; // m, radius
const EDGE: f64 = 0.2; // m, radius of the edge
const LOAD: f64 = 30.0; // kg
const RATE: f64 = 0.2; // m/s

/// A winch 1 m behind the rounded edge of a roof takes in a rope that hangs 2.5 m down over it, with a load of 30 kg.
pub struct Edge {
    world: PhysicsWorld,
    cables: CableSet,
    rope: CableHandle,
    load: RigidBodyHandle,
    steps: u32,
    pull: f64,
    hanging: f64,
}

impl Edge {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        // the edge is a quarter of a pipe between roof (y = 0) and wall (x = 0), along z
        let pipe = ColliderBuilder::cylinder(1.0, EDGE as Real).friction(FRICTION as Real);
        let level = Vector::new(core::f32::consts::FRAC_PI_2, 0.0, 0.0);
        world.insert_collider(pipe.position(Pose::new(Vector::splat(-EDGE as Real).with_z(0.0), level)), None);
        let bent = (0..=8).map(|i| FRAC_PI_2 * f64::from(i) / 8.0).map(|angle| {
            let (sine, cosine) = angle.sin_cos();
            Vector3::new(sine, cosine, 0.0) * (EDGE + ROPE) - Vector3::new(EDGE, EDGE, 0.0)
        });
        let (winch, low) = (Vector3::new(-1.0 - EDGE, ROPE, 0.0), Vector3::new(ROPE, -2.5, 0.0));
        let rope = Cable::builder()
            .name("winch rope")
            .points([winch].into_iter().chain(bent).chain([low]))
            .section(Section::from_stiffness(2.0e5, 0.02, 0.1)?) // EA N, EI N m^2, kg/m
            .elements(40)
            .damping(Damping { axial: 5e-3, bending: 5e-3 }) // s
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        cables.set_contact(rope, Contact::with_friction(FRICTION).with_radius(ROPE))?;
        let load = RigidBodyBuilder::dynamic().translation(Vector::new(ROPE as Real, -2.7, 0.0)).can_sleep(false);
        let (load, _) = world.insert(load, ColliderBuilder::ball(0.2).mass(LOAD as Real));
        cables.attach(&world, rope, At::End, load, Vector::new(0.0, 0.2, 0.0), AttachmentKind::Ball)?;
        // the winch: a motor at the end that is held
        let winch = Reel { acceleration: 0.2, ..Reel::with_rate(-RATE) };
        cables.get_mut(rope)?.add_reel(At::Start, winch)?;
        Ok(Edge { world, cables, rope, load, steps: 0, pull: 0.0, hanging: 0.0 })
    }
}

impl Stage for Edge {
    fn step(&mut self) -> Outcome<()> {
        self.cables.step(&mut self.world)?;
        self.steps += 1;
        if self.steps > 180 {
            let reel = self.cables.get(self.rope)?.reel(At::Start).ok_or("the rope has a reel")?;
            self.pull += reel.tension / 240.0; // mean over the last 4 s
            self.hanging += -(f64::from(self.world.bodies[self.load].translation().y) + 0.2 + EDGE) / 240.0;
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // Euler and Eytelwein: what hangs, times exp(friction x angle); the rope beside the pipe weighs 1 N
        let expected = 9.81 * (LOAD + 0.1 * self.hanging) * (FRICTION * FRAC_PI_2).exp();
        let speed = self.world.bodies[self.load].linvel().y;
        let line =
            format!("the winch pulls with {:.1} N, by hand {expected:.1} N; {speed:.3} m/s of {RATE} m/s", self.pull);
        let fine = (self.pull / expected - 1.0).abs() < 0.03 && (f64::from(speed) / RATE - 1.0).abs() < 0.1;
        if fine { Ok(line) } else { Err(line.into()) }
    }
}
