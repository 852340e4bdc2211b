//! A player swings on a grapple whose rope winds round a corner.

use super::{Outcome, Stage};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, Fidelity, Reel, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

const ROPE: f64 = 0.005; // m, radius

/// A player of 80 kg swings on 8 m of rope against the edge of a balcony 4 m below the hook, and reels in on the way.
pub struct Corner {
    world: PhysicsWorld,
    cables: CableSet,
    rope: CableHandle,
    player: RigidBodyHandle,
    touched: bool,
    path: Vec<(f64, f64, f64)>,
    energy: Vec<f64>,
}

impl Corner {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        // the balcony ends at x = 1 under the hook; its lower edge is at y = -4
        let balcony = ColliderBuilder::cuboid(2.0, 0.5, 2.0).translation(Vector::new(3.0, -3.5, 0.0)).friction(0.5);
        world.insert_collider(balcony, None);
        let hands = Vector3::new(-5.6, -5.6, 0.0);
        let player = RigidBodyBuilder::dynamic().translation(Vector::new(-5.6, -6.4, 0.0)).can_sleep(false);
        let (player, _) = world.insert(player, ColliderBuilder::capsule_y(0.5, 0.3).mass(80.0));
        let rope = Cable::builder()
            .name("grapple")
            .points([Vector3::zeros(), hands])
            .section(Section::from_stiffness(1.0e5, 0.02, 0.05)?) // EA N, EI N m^2, kg/m: 8 mm
            .elements(16)
            .damping(Damping { axial: 0.02, bending: 0.05 }) // s
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        cables.set_contact(rope, Contact::with_friction(0.5).with_radius(ROPE))?;
        cables.attach(&world, rope, At::End, player, Vector::new(0.0, 0.8, 0.0), AttachmentKind::Ball)?;
        Ok(Corner { world, cables, rope, player, touched: false, path: Vec::new(), energy: Vec::new() })
    }

    /// Reels in at this rate in m/s, at the hook.
    fn reel_in(&mut self, rate: f64) -> Outcome<()> {
        let winch = Reel { acceleration: 1.0, ..Reel::with_rate(-rate) };
        Ok(self.cables.get_mut(self.rope)?.add_reel(At::Start, winch)?)
    }
}

impl Stage for Corner {
    fn step(&mut self) -> Outcome<()> {
        if self.path.len() == 120 {
            self.reel_in(0.5)?;
        }
        self.cables.step(&mut self.world)?;
        self.touched |= self.cables.contacts(self.rope)?.next().is_some();
        let body = &self.world.bodies[self.player];
        let (p, v) = (vector(body.translation()), vector(body.linvel()));
        self.path.push((p.x, p.y, v.norm()));
        self.energy.push(self.cables.energy(&self.world)?.total());
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        let highest = self.path.iter().map(|p| p.1).fold(f64::MIN, f64::max);
        let every: Vec<String> = self
            .path
            .iter()
            .zip(&self.energy)
            .step_by(15)
            .map(|(p, e)| format!("({:.2} {:.2} {:.2} e{e:.0})", p.0, p.1, p.2))
            .collect();
        Ok(format!("touched {}, highest {highest}, {}", self.touched, every.join(" ")))
    }
}
