//! A rope is cut under load.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

/// A crate of 20 kg hangs on 3 m of rope, which is cut in the middle after 1 s.
pub struct Cut {
    world: PhysicsWorld,
    cables: CableSet,
    load: RigidBodyHandle,
    rope: CableHandle,
    steps: u32,
    height: f64,
}

impl Cut {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let load = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -3.2, 0.0)).can_sleep(false);
        let (load, _) = world.insert(load, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(20.0));
        let rope = Cable::builder()
            .name("rope")
            .points([Vector3::zeros(), Vector3::new(0.0, -3.0, 0.0)]) // m
            .section(Section::from_stiffness(1.0e5, 0.02, 0.05)?) // EA N, EI N m^2, kg/m
            .elements(12) // a node is placed at the cut; more elements show more of the whip
            .damping(Damping { axial: 0.02, bending: 0.05 }) // s: the ends whip back
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        cables.attach(&world, rope, At::End, load, Vector::new(0.0, 0.2, 0.0), AttachmentKind::Ball)?;
        Ok(Cut { world, cables, load, rope, steps: 0, height: 0.0 })
    }

    /// Cuts in the middle, and returns the part that hangs on the load.
    fn cut(&mut self) -> Outcome<CableHandle> {
        Ok(self.cables.cut(self.rope, 1.5)?) // arc length, m
    }
}

impl Stage for Cut {
    fn step(&mut self) -> Outcome<()> {
        self.steps += 1;
        if self.steps == 61 {
            self.cut()?;
            self.height = f64::from(self.world.bodies[self.load].translation().y);
        }
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        // 30 host steps of free fall; before the cut the load still swings up and down a little
        let fallen = self.height - f64::from(self.world.bodies[self.load].translation().y);
        let expected = 0.5 * 9.81 * 0.25;
        let line = format!("the load falls {fallen:.3} m in 0.5 s, by hand {expected:.3} m");
        if (fallen / expected - 1.0).abs() < 0.02 { Ok(line) } else { Err(line.into()) }
    }
}
