//! A glider on its tow rope is put elsewhere without a jolt.

use super::{Outcome, Stage};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, CableSet, Rope, RopeEnd};

/// Two balls of 5 and 1 kg whirl about each other on a rope of 2 m; after 1 s they go through a portal that turns them by a quarter.
pub struct Teleport {
    world: PhysicsWorld,
    cables: CableSet,
    balls: [RigidBodyHandle; 2],
    hook: AttachmentHandle,
    steps: u32,
    before: (f64, f64, f64),
    jump: f64,
}

impl Teleport {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let mut ball =
            |x: f64, mass: f64, speed: f64| {
                let body = RigidBodyBuilder::dynamic()
                    .translation(Vector::new(x as Real, 0.0, 0.0))
                    .linvel(Vector::new(0.0, speed as Real, 0.0));
                world.insert(body.can_sleep(false), ColliderBuilder::ball(0.1).mass(mass as Real)).0
            };
        // about their common centre with 3 rad/s
        let balls = [ball(-1.0 / 3.0, 5.0, -1.0), ball(5.0 / 3.0, 1.0, 5.0)];
        let mut cables = CableSet::new();
        let ends = [-1.0 / 3.0, 5.0 / 3.0].map(|x| Vector3::new(x, 0.0, 0.0));
        let ends = [RopeEnd { point: ends[0], body: Some(balls[0]) }, RopeEnd { point: ends[1], body: Some(balls[1]) }];
        let rope = cables.add_rope(&world, ends[0], ends[1], Rope::new(Section::from_stiffness(5.0e4, 0.01, 0.02)?))?;
        let hook = rope.end.ok_or("the rope is attached to a body")?;
        Ok(Teleport { world, cables, balls, hook, steps: 0, before: (0.0, 0.0, 0.0), jump: 0.0 })
    }

    /// Through the portal: all bodies of the rope at once, with one rigid motion; their rope goes with them.
    fn teleport(&mut self) -> Outcome<()> {
        let portal = Pose::new(Vector::new(100.0, 20.0, 0.0), Vector::new(0.0, core::f32::consts::FRAC_PI_2, 0.0));
        Ok(self.cables.move_bodies(&mut self.world, &self.balls, &portal)?)
    }

    /// Pull at the lighter ball in N, distance of the balls in m, speed of the lighter one in m/s.
    fn state(&self) -> Outcome<(f64, f64, f64)> {
        let [a, b] = self.balls.map(|ball| vector(self.world.bodies[ball].translation()));
        let pull = self.cables.attachment(self.hook)?.force().norm();
        Ok((pull, (a - b).norm(), vector(self.world.bodies[self.balls[1]].linvel()).norm()))
    }
}

impl Stage for Teleport {
    fn step(&mut self) -> Outcome<()> {
        self.steps += 1;
        if self.steps == 60 {
            self.before = self.state()?;
            self.teleport()?;
        }
        self.cables.step(&mut self.world)?;
        if self.steps == 60 {
            let after = self.state()?;
            self.jump = (after.0 / self.before.0 - 1.0).abs();
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // m w^2 r on the lighter ball, and half of the rope's own part
        let (pull, distance, speed) = self.state()?;
        let p = vector(self.world.bodies[self.balls[1]].translation());
        Ok(format!("pull {pull:.2} N of 75, {distance:.4} m, {speed:.3} m/s, jump {:.2e}, at {p:?}", self.jump))
    }
}
