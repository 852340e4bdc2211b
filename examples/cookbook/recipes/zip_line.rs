//! A rider on a zip line.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableHandle, CableSet, SheaveOptions};

const SPAN: f64 = 30.0; // m
const DROP: f64 = 2.0; // m
const RIDER: f64 = 80.0; // kg
const START: f64 = 3.0; // m along the line

/// A rider of 80 kg rolls down a steel rope of 30 m that ends 2 m lower.
pub struct ZipLine {
    world: PhysicsWorld,
    cables: CableSet,
    line: CableHandle,
    rider: RigidBodyHandle,
    energy: f64,
    path: Vec<(f64, f64, f64)>,
}

impl ZipLine {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let mut line = Cable::builder()
            .name("zip line")
            .points([Vector3::zeros(), Vector3::new(SPAN, -DROP, 0.0)])
            .length(1.005 * SPAN.hypot(DROP)) // m: 0.5 % longer than the span
            .section(Section::wire_rope(0.012)?)
            .elements(20)
            .node_at(START)
            .damping(Damping { axial: 2e-3, bending: 2e-3 }) // s
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .fix(At::End)
            .build()?;
        line.equilibrium()?;
        let wheel = line.sample(START)?.position;
        let hang = Vector::new(wheel.x as Real, (wheel.y - 0.8) as Real, 0.0);
        let rider = RigidBodyBuilder::dynamic().translation(hang).can_sleep(false);
        let (rider, _) = world.insert(rider, ColliderBuilder::capsule_y(0.4, 0.2).mass(RIDER as Real));
        let mut cables = CableSet::new();
        let line = cables.insert(line);
        // the wheel is an eye of the rider, 0.8 m above the middle: the line runs through it
        let wheel = (rider, Vector::new(0.0, 0.8, 0.0));
        cables.add_sheave_at(&world, (line, START), wheel, SheaveOptions::default())?;
        // hangs on the line, held back at the platform: start in equilibrium of all but the way along
        Ok(ZipLine { world, cables, line, rider, energy: 0.0, path: Vec::new() })
    }
}

impl Stage for ZipLine {
    fn step(&mut self) -> Outcome<()> {
        if self.path.is_empty() {
            self.energy = self.cables.energy(&self.world)?.total();
        }
        self.cables.step(&mut self.world)?;
        let body = &self.world.bodies[self.rider];
        let (p, v) = (body.translation(), body.linvel());
        if self.path.len() % 20 == 0 && std::env::var("DBG").is_ok() {
            let e = self.cables.energy(&self.world)?;
            println!("{} x {:.2} y {:.2} v {:.2} ({:.2} {:.2}) E {:.1} {e:?}", self.path.len(), p.x, p.y, v.length(), v.x, v.y, e.total());
        }
        self.path.push((f64::from(p.x), f64::from(p.y), f64::from(v.length())));
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        let (x, y, v) = self.path[self.path.len() - 1];
        let fallen = self.path[0].1 - y;
        let expected = (2.0 * 9.81 * fallen).max(0.0).sqrt();
        let parts = self.cables.parts(self.line)?.len();
        Ok(format!(
            "{parts} parts, x {x:.2} y {y:.2} fallen {fallen:.2} v {v:.2} by energy {expected:.2}; energy {:.1} -> {:.1}",
            self.energy,
            self.cables.energy(&self.world)?.total()
        ))
    }
}
