//! Hanging lamps that sleep while it is calm.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableHandle, CableSet, Rope};

const LAMPS: usize = 12;
const GUST: [u32; 2] = [600, 720]; // host steps

/// Twelve lamps of 2 kg hang in a hall; a draught comes through for 2 s.
pub struct Lamps {
    world: PhysicsWorld,
    cables: CableSet,
    lamps: Vec<(CableHandle, RigidBodyHandle)>,
    steps: u32,
    asleep: [usize; 3],
}

impl Lamps {
    pub fn new() -> Outcome<Self> {
        let (mut world, mut cables, mut lamps) = (PhysicsWorld::new(), CableSet::new(), Vec::new());
        for i in 0..LAMPS {
            let top = Vector3::new(2.0 * i as f64, 3.0, 0.0);
            let low = top - Vector3::new(0.0, 1.2, 0.0);
            // rigid bodies lose their swing by damping alone; 0.4 1/s of a lamp shade in air
            let lamp = RigidBodyBuilder::dynamic()
                .translation(Vector::new(low.x as Real, low.y as Real, 0.0))
                .linear_damping(0.4);
            let (lamp, _) = world.insert(lamp, ColliderBuilder::ball(0.12).mass(2.0));
            let rope = Rope::new(Section::from_stiffness(2.0e4, 0.005, 0.05)?).elements(4);
            lamps.push((cables.add_rope(&world, top, (lamp, low), rope)?.cable, lamp));
        }
        // ropes ring on for minutes; below this speed (m/s) nobody sees it
        cables.settings.sleep_speed = 0.03;
        Ok(Lamps { world, cables, lamps, steps: 0, asleep: [0; 3] })
    }

    /// How many lamps are asleep, with their cables.
    fn asleep(&self) -> Outcome<usize> {
        let mut count = 0;
        for (cable, _) in &self.lamps {
            count += usize::from(self.cables.is_asleep(*cable)?);
        }
        Ok(count)
    }
}

impl Stage for Lamps {
    fn step(&mut self) -> Outcome<()> {
        // a draught wakes what it blows at; without it nothing is touched, so that all may sleep
        if self.steps == GUST[0] || self.steps == GUST[1] {
            for (_, lamp) in &self.lamps {
                let body = &mut self.world.bodies[*lamp];
                body.reset_forces(true);
                if self.steps == GUST[0] {
                    body.add_force(Vector::new(3.0, 0.0, 0.0), true);
                }
            }
        }
        self.cables.step(&mut self.world)?;
        self.steps += 1;
        for (k, at) in [GUST[0] - 1, GUST[0] + 30, 2400].into_iter().enumerate() {
            if self.steps == at {
                self.asleep[k] = self.asleep()?;
            }
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // asleep again where they hung: as far below the hook as the rope is long, with its stretch
        let low = f64::from(self.world.bodies[self.lamps[3].1].translation().y);
        let expected = 3.0 - 1.2 * (1.0 + 2.0 * 9.81 / 2.0e4);
        let line = format!(
            "{:?} of {LAMPS} lamps are asleep before, in and after the draught; one hangs at {low:.4} m, by hand {expected:.4} m",
            self.asleep
        );
        let fine = self.asleep == [LAMPS, 0, LAMPS] && (low - expected).abs() < 1e-3;
        if fine { Ok(line) } else { Err(line.into()) }
    }
}
