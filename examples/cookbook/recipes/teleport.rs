//! Two bodies on a rope go through a portal.

use super::{Outcome, Stage};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Fidelity, RopeKind, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};

const EA: f64 = 5.0e4; // N
const PULL: f64 = 15.0; // N: 1 kg at 5/3 m and 3 rad/s

/// Two balls of 5 and 1 kg whirl about each other on a rope of 2 m; after 1 s they go through a portal that turns them by a quarter.
pub struct Teleport {
    world: PhysicsWorld,
    cables: CableSet,
    balls: [RigidBodyHandle; 2],
    hook: AttachmentHandle,
    steps: u32,
    pulls: Vec<f64>,
}

impl Teleport {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let mut ball = |x: Real, mass: Real| {
            // about their common centre with 3 rad/s
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.0, 0.0)).linvel(Vector::new(
                0.0,
                3.0 * x,
                0.0,
            ));
            world.insert(body.can_sleep(false), ColliderBuilder::ball(0.1).mass(mass)).0
        };
        let balls = [ball(-1.0 / 3.0, 5.0), ball(5.0 / 3.0, 1.0)];
        // it whirls with them, and is as long as it is under this pull: it starts without a jerk
        let ends = [-1.0 / 3.0, 5.0 / 3.0].map(|x| Vector3::new(x, 0.0, 0.0));
        let rope = Cable::builder()
            .points(ends)
            .length(2.0 / (1.0 + PULL / EA))
            .section(Section::from_stiffness(EA, 0.01, 0.002)?)
            .elements(10)
            .damped_as(RopeKind::FibreRope)
            .fidelity(Fidelity::Game)
            .velocity(-Vector3::y())
            .angular_velocity(Vector3::z() * 3.0)
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        cables.attach_here(&world, rope, At::Start, balls[0], AttachmentKind::Ball)?;
        let hook = cables.attach_here(&world, rope, At::End, balls[1], AttachmentKind::Ball)?;
        Ok(Teleport { world, cables, balls, hook, steps: 0, pulls: Vec::new() })
    }

    /// Through the portal: all bodies of the rope at once, by one rigid motion; their rope goes with them.
    fn teleport(&mut self) -> Outcome<()> {
        let portal = Pose::new(Vector::new(100.0, 20.0, 0.0), Vector::new(0.0, core::f32::consts::FRAC_PI_2, 0.0));
        Ok(self.cables.move_bodies(&mut self.world, &self.balls, &portal)?)
    }
}

impl Stage for Teleport {
    fn step(&mut self) -> Outcome<()> {
        self.steps += 1;
        if self.steps == 60 {
            self.teleport()?;
        }
        self.cables.step(&mut self.world)?;
        self.pulls.push(self.cables.attachment(self.hook)?.force().norm());
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // they whirl on about a centre that stands where the portal put it, in the plane x = 100 m, and the pull stays m w^2 r
        let [a, b] = self.balls.map(|ball| vector(self.world.bodies[ball].translation()));
        let centre = (a * 5.0 + b) / 6.0;
        let off = (centre - Vector3::new(100.0, 20.0, 0.0)).norm();
        let plane = (b.x - 100.0).abs();
        // places in single precision are 1e-5 m off on this stiff rope when it starts: that rings out within half a second
        let furthest = self.pulls[30..].iter().map(|pull| (pull / PULL - 1.0).abs()).fold(0.0, f64::max);
        let line = format!(
            "the pull stays within {:.1} % of {PULL} N, the centre is {off:.4} m off, the plane {plane:.4} m",
            100.0 * furthest
        );
        if furthest < 0.02 && off < 5e-3 && plane < 5e-3 { Ok(line) } else { Err(line.into()) }
    }
}
