//! A winch lifts a load over the edge of a roof.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, Fidelity, Reel, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet};
use std::f64::consts::FRAC_PI_2;

const FRICTION: f64 = 0.2;
const ROPE: f64 = 0.006; // m, radius
const LOAD: f64 = 30.0; // kg
const RATE: f64 = 0.2; // m/s

/// A winch 3 m behind the edge of a roof takes in a rope that hangs 4 m down over it, with a load of 30 kg.
pub struct Edge {
    world: PhysicsWorld,
    cables: CableSet,
    rope: CableHandle,
    hook: AttachmentHandle,
    load: RigidBodyHandle,
    pulls: Vec<(f64, f64, f64)>,
}

impl Edge {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        // the roof ends at x = 0; its surface is at y = 0
        let roof =
            ColliderBuilder::cuboid(5.0, 5.0, 5.0).translation(Vector::new(-5.0, -5.0, 0.0)).friction(FRICTION as Real);
        world.insert_collider(roof, None);
        let rope = Cable::builder()
            .name("winch rope")
            // level on the roof, over the edge, down the wall: drawn at its radius from both
            .points([[-3.0, ROPE], [-0.02, ROPE], [ROPE, -0.02], [ROPE, -4.0]].map(|[x, y]| Vector3::new(x, y, 0.0)))
            .section(Section::from_stiffness(2.0e5, 0.02, 0.1)?) // EA N, EI N m^2, kg/m
            .elements(28)
            .damping(Damping { axial: 5e-3, bending: 5e-3 }) // s
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        cables.set_contact(rope, Contact::with_friction(FRICTION).with_radius(ROPE))?;
        let load = RigidBodyBuilder::dynamic().translation(Vector::new(ROPE as Real, -4.2, 0.0)).can_sleep(false);
        let (load, _) = world.insert(load, ColliderBuilder::ball(0.2).mass(LOAD as Real).sensor(true));
        let top = Vector::new(0.0, 0.2, 0.0);
        let hook = cables.attach(&world, rope, At::End, load, top, AttachmentKind::Ball)?;
        // the winch: a motor at the end that is held
        let winch = Reel { acceleration: 0.2, ..Reel::with_rate(-RATE) };
        cables.get_mut(rope)?.add_reel(At::Start, winch)?;
        Ok(Edge { world, cables, rope, hook, load, pulls: Vec::new() })
    }
}

impl Stage for Edge {
    fn step(&mut self) -> Outcome<()> {
        self.cables.step(&mut self.world)?;
        let winch = self.cables.get(self.rope)?.reel(At::Start).map_or(f64::NAN, |reel| reel.tension);
        let hook = self.cables.attachment(self.hook)?.force().norm();
        if self.pulls.len() % 40 == 0 && std::env::var("DBG").is_ok() {
            let reel = self.cables.get(self.rope)?.reel(At::Start);
            println!("{} winch {winch:.1} hook {hook:.1} y {:.3} v {:.3} {reel:?}", self.pulls.len(), self.world.bodies[self.load].translation().y, self.world.bodies[self.load].linvel().y);
            let c = self.cables.get(self.rope)?;
            println!("   {:?}", c.positions().iter().map(|p| ((p.x * 100.0).round() / 100.0, (p.y * 100.0).round() / 100.0)).collect::<Vec<_>>());
        }
        self.pulls.push((winch, hook, f64::from(self.world.bodies[self.load].linvel().y)));
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // Euler-Eytelwein over the quarter of a turn, and the friction of what lies on the roof
        let last = &self.pulls[self.pulls.len() / 2..];
        let mean = |of: fn(&(f64, f64, f64)) -> f64| last.iter().map(of).sum::<f64>() / last.len() as f64;
        let (winch, hook, speed) = (mean(|p| p.0), mean(|p| p.1), mean(|p| p.2));
        let expected = LOAD * 9.81 * (FRICTION * FRAC_PI_2).exp();
        Ok(format!(
            "winch {winch:.1} N by hand {expected:.1}, hook {hook:.1} of {:.1} N, speed {speed:.3}",
            LOAD * 9.81
        ))
    }
}
