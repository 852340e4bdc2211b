//! A hook that hangs on a twisted rope, turns, and turns back.

use super::{Outcome, Stage};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Effects, Fidelity, Section, Torsion};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

const STIFFNESS: f64 = 0.02; // GJ in N m^2
const RADIUS: f32 = 0.1; // m

/// A ball of 1 kg, clamped to 1 m of rope that is twisted by a quarter of a turn.
pub struct Hook {
    world: PhysicsWorld,
    cables: CableSet,
    hook: RigidBodyHandle,
    rope: CableHandle,
    time: f64,
    /// Times at which its spin changed sign.
    turns: Vec<f64>,
    spin: f64,
}

impl Hook {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let hook = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -1.0 - RADIUS, 0.0)).can_sleep(false);
        let (hook, _) = world.insert(hook, ColliderBuilder::ball(RADIUS).mass(1.0));
        let torsion = Torsion { initial_twist: 0.25, ..Torsion::new(STIFFNESS) }; // turns
        let rope = Cable::builder()
            .name("rope")
            .points([vector(Vector::ZERO), vector(Vector::new(0.0, -1.0, 0.0))]) // m
            .section(Section::from_stiffness(1.0e4, 0.026, 0.01)?) // EA N, EI N m^2, kg/m
            .elements(4)
            .effects(Effects { torsion: Some(torsion), ..Effects::default() })
            .damping(Damping { axial: 0.01, bending: 0.02 }) // s
            .fidelity(Fidelity::Game)
            .clamp(At::Start) // a ball would let it spin
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        let top = Vector::new(0.0, RADIUS, 0.0);
        cables.attach(&world, rope, At::End, hook, top, AttachmentKind::Clamp)?;
        Ok(Hook { world, cables, hook, rope, time: 0.0, turns: Vec::new(), spin: 0.0 })
    }

    /// Returns the torque in N m of the rope on the hook.
    fn torque(&self) -> Option<f64> {
        self.cables.get(self.rope).ok()?.torsion().first().map(|reading| reading.torque)
    }
}

impl Stage for Hook {
    fn step(&mut self) -> Outcome<()> {
        self.cables.step(&mut self.world)?;
        self.time += 1.0 / 60.0;
        let spin = f64::from(self.world.bodies[self.hook].angvel().y);
        if self.spin * spin < 0.0 {
            // where it crossed zero within the step
            self.turns.push(self.time - spin / (spin - self.spin) / 60.0);
        }
        self.spin = spin;
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // half a period between its turns: pi sqrt(J L/GJ), J = 2/5 m r^2
        let [Some(first), Some(last)] = [self.turns.first(), self.turns.last()] else { return Err("no turn".into()) };
        let half = (last - first) / (self.turns.len() - 1) as f64;
        let inertia = 0.4 * f64::from(RADIUS * RADIUS);
        let expected = std::f64::consts::PI * (inertia / STIFFNESS).sqrt();
        let torque = self.torque().ok_or("no torque")?;
        let line = format!("the hook turns back each {half:.4} s, by hand {expected:.4} s; torque {torque:.4} N m");
        if (half / expected - 1.0).abs() < 1e-3 { Ok(line) } else { Err(line.into()) }
    }
}
