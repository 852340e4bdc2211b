//! A swinging load is saved, and the game goes on from there.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::Section;
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableSet, Rope};
use serde::{Deserialize, Serialize};

/// What a saved game holds: bodies and cables are plain data. Handles stay valid, and the time is the game's own.
#[derive(Serialize, Deserialize)]
pub struct Saved {
    world: PhysicsWorld,
    cables: CableSet,
    steps: u32,
}

/// A load of 20 kg swings on 3 m of rope; after 1 s the game is saved, after 3 s it is loaded.
pub struct Save {
    game: Saved,
    load: RigidBodyHandle,
    file: Vec<u8>,
    at_two: Vec<Vector>,
}

impl Save {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let load = RigidBodyBuilder::dynamic().translation(Vector::new(3.0, 0.0, 0.0));
        let (load, _) = world.insert(load, ColliderBuilder::ball(0.2).mass(20.0));
        let mut cables = CableSet::new();
        let rope = Rope::new(Section::from_stiffness(1.0e5, 0.02, 0.01)?);
        cables.add_rope(&world, [0.0, 0.0, 0.0], (load, [3.0, 0.0, 0.0]), rope)?;
        let game = Saved { world, cables, steps: 0 };
        Ok(Save { game, load, file: Vec::new(), at_two: Vec::new() })
    }

    /// Any format of serde that keeps all bits of a number: of `serde_json` with its feature `float_roundtrip`.
    fn save(&mut self) -> Outcome<()> {
        self.file = serde_json::to_vec(&self.game)?;
        Ok(())
    }

    fn load(&mut self) -> Outcome<()> {
        self.game = serde_json::from_slice(&self.file)?;
        Ok(())
    }
}

impl Stage for Save {
    fn step(&mut self) -> Outcome<()> {
        let mut again = false;
        match self.game.steps {
            60 if self.file.is_empty() => self.save()?,
            180 if self.at_two.len() == 1 => {
                self.load()?;
                again = true;
            }
            _ => {}
        }
        let Saved { world, cables, steps } = &mut self.game;
        cables.step(world)?;
        *steps += 1;
        if *steps == 120 && (again || self.at_two.len() < 2) {
            self.at_two.push(self.game.world.bodies[self.load].translation());
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        let [first, second] = self.at_two[..] else { return Err("2 s were not reached twice".into()) };
        let line = format!(
            "after 2 s the load is at ({:.4}, {:.4}) m, after loading again, to the bit; {} kB",
            first.x,
            first.y,
            self.file.len() / 1000
        );
        let same = first.to_array().map(Real::to_bits) == second.to_array().map(Real::to_bits);
        // a quarter of the period from level is 1.8541 sqrt(L/g): after 2.05 s it would stand level on the other side
        let fine = (first.x + 3.0).abs() < 0.03 && first.y.abs() < 0.03;
        if same && fine { Ok(line) } else { Err(format!("{line}: {second:?}").into()) }
    }
}
