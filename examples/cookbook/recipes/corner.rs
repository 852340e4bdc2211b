//! A player swings on a grapple whose rope winds round a corner.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, Fidelity, Reel, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet};

/// A player of 80 kg swings on 7.9 m of rope against the edge of a balcony 4 m below the hook, and after 2 s reels in.
pub struct Corner {
    world: PhysicsWorld,
    cables: CableSet,
    rope: CableHandle,
    hand: AttachmentHandle,
    steps: u32,
    energy: [f64; 2],
}

impl Corner {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        // the balcony ends at x = 1 m, beside the hook; its lower edge is at y = -4 m
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
        cables.set_contact(rope, Contact::with_friction(0.5).with_radius(0.005))?;
        let hand = cables.attach(&world, rope, At::End, player, Vector::new(0.0, 0.8, 0.0), AttachmentKind::Ball)?;
        let energy = [cables.energy(&world)?.total(); 2];
        Ok(Corner { world, cables, rope, hand, steps: 0, energy })
    }

    /// Reels in at this rate in m/s, at the hook.
    fn reel_in(&mut self, rate: f64) -> Outcome<()> {
        let winch = Reel { acceleration: 1.0, ..Reel::with_rate(-rate) };
        Ok(self.cables.get_mut(self.rope)?.add_reel(At::Start, winch)?)
    }
}

impl Stage for Corner {
    fn step(&mut self) -> Outcome<()> {
        if self.steps == 120 {
            self.energy[1] = self.cables.energy(&self.world)?.total();
            self.reel_in(0.5)?;
        }
        self.steps += 1;
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        // taut from the hook to the corner and from there to the hands: both parts are as long as what is out, with its stretch
        let rope = self.cables.get(self.rope)?;
        let (hands, corner) = (rope.sample(rope.length())?.position, Vector3::new(1.0, -4.0, 0.0));
        let out = rope.reel(At::Start).ok_or("the rope has a reel")?.length_out;
        let pull = self.cables.attachment(self.hand)?.force().norm();
        let (ways, expected) = (corner.norm() + (hands - corner).norm(), out * (1.0 + pull / 1.0e5));
        let [start, end] = self.energy;
        let line = format!(
            "{ways:.3} m from the hook round the corner to the hands, by hand {expected:.3} m, {pull:.0} N; before it was reeled in, {:.0} J were lost",
            start - end
        );
        let fine = (ways / expected - 1.0).abs() < 5e-3 && hands.x > 1.5 && end < start && start - end < 400.0;
        if fine { Ok(line) } else { Err(line.into()) }
    }
}
