//! A kinematic character on a rope.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::Section;
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, CableSet, Rope};

const LENGTH: f64 = 5.0; // m
const EA: f64 = 4.0e3; // N: a bungee
const STRENGTH: f64 = 600.0; // N, what the character can pull with
const WALK: f64 = 2.0; // m/s

/// A character, moved by the game, walks away from a post on a leash of 5 m, until it cannot pull harder.
pub struct Leash {
    world: PhysicsWorld,
    cables: CableSet,
    character: RigidBodyHandle,
    hand: AttachmentHandle,
}

impl Leash {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let at = Vector::new(2.0, 1.0, 0.0);
        let character = RigidBodyBuilder::kinematic_position_based().translation(at);
        let (character, _) = world.insert(character, ColliderBuilder::capsule_y(0.5, 0.3));
        let leash = Rope::new(Section::from_stiffness(EA, 0.005, 0.05)?).unstretched_length(LENGTH);
        let mut cables = CableSet::new();
        let rope = cables.add_rope(&world, [0.0, 1.0, 0.0], (character, [2.0, 1.0, 0.0]), leash)?;
        let hand = rope.end.ok_or("the leash is attached to the character")?;
        Ok(Leash { world, cables, character, hand })
    }

    /// A kinematic body feels nothing: the game asks the leash for its pull, and walks as fast as that leaves.
    fn walk(&mut self) -> Outcome<()> {
        let pull = -self.cables.attachment(self.hand)?.force().x; // N, backwards, over the last step
        let speed = WALK * (1.0 - pull / STRENGTH).clamp(-1.0, 1.0);
        let body = &mut self.world.bodies[self.character];
        let next = body.translation() + Vector::new((speed / 60.0) as Real, 0.0, 0.0);
        body.set_next_kinematic_translation(next);
        Ok(())
    }
}

impl Stage for Leash {
    fn step(&mut self) -> Outcome<()> {
        self.walk()?;
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        // at rest the pull is the strength, EA over the elongation
        let x = f64::from(self.world.bodies[self.character].translation().x);
        let pull = -self.cables.attachment(self.hand)?.force().x;
        let expected = LENGTH * (1.0 + STRENGTH / EA);
        let line =
            format!("the character stands at {x:.3} m and pulls {pull:.1} N; by hand {expected:.3} m, {STRENGTH} N");
        let fine = (x / expected - 1.0).abs() < 5e-3 && (pull / STRENGTH - 1.0).abs() < 0.01;
        if fine { Ok(line) } else { Err(line.into()) }
    }
}
