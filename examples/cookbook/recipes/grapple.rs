//! A player shoots a hook at a ledge, swings, and lets go.

use super::{Outcome, Stage};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, Section};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};

/// A player of 80 kg swings on a rope of the length that it was shot at, and lets go after 1.2 s.
pub struct Grapple {
    world: PhysicsWorld,
    cables: CableSet,
    player: RigidBodyHandle,
    rope: Option<AttachmentHandle>,
    steps: u32,
    start: f64,
}

impl Grapple {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let player = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 4.0, 0.0)).can_sleep(false);
        let (player, _) = world.insert(player, ColliderBuilder::capsule_y(0.5, 0.3).mass(80.0));
        let mut grapple = Grapple { world, cables: CableSet::new(), player, rope: None, steps: 0, start: 4.0 };
        grapple.shoot(Vector::new(5.0, 8.0, 0.0))?;
        Ok(grapple)
    }

    /// A rope from the player's hands to a point of the world.
    fn shoot(&mut self, point: Vector) -> Outcome<()> {
        let hands = Vector::new(0.0, 0.8, 0.0);
        let from = self.world.bodies[self.player].translation() + hands;
        let speed = vector(self.world.bodies[self.player].linvel());
        let rope = Cable::builder()
            .name("grapple")
            .points([vector(point), vector(from)])
            .section(Section::from_stiffness(1.0e5, 0.02, 0.05)?) // EA N, EI N m^2, kg/m: 8 mm
            .elements(10)
            .damping(Damping { axial: 0.02, bending: 0.05 }) // s
            .fidelity(Fidelity::Game)
            .velocity(speed) // as the player has it: a rope at rest would jerk
            .fix(At::Start)
            .build()?;
        let rope = self.cables.insert(rope);
        self.rope = Some(self.cables.attach(&self.world, rope, At::End, self.player, hands, AttachmentKind::Ball)?);
        Ok(())
    }

    /// Lets go, and takes the rope out of the world.
    fn let_go(&mut self) -> Outcome<()> {
        if let Some(held) = self.rope.take() {
            let rope = self.cables.attachment(held)?.cable();
            self.cables.remove(&mut self.world, rope)?;
        }
        Ok(())
    }
}

impl Stage for Grapple {
    fn step(&mut self) -> Outcome<()> {
        self.steps += 1;
        if self.steps == 72 {
            self.let_go()?;
        }
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        // the speed that the height gives, with what turns with the body and the rope: 5 %
        let body = &self.world.bodies[self.player];
        let fallen = self.start - f64::from(body.translation().y);
        let (speed, expected) = (f64::from(body.linvel().length()), (2.0 * 9.81 * fallen).max(0.0).sqrt());
        let line = format!("{speed:.2} m/s after a fall of {fallen:.2} m, by energy {expected:.2} m/s");
        if (speed / expected - 1.0).abs() < 0.05 { Ok(line) } else { Err(line.into()) }
    }
}
