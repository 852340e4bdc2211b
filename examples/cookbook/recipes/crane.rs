//! A crane turns with its load.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};
use std::f64::consts::FRAC_PI_2;

const ARM: f64 = 4.0; // m
const TURN: f64 = 10.0; // s
const MASS: f64 = 200.0; // kg

/// A boom of 4 m turns by 90 degrees within 10 s; 200 kg hang on 4 m of 8 mm steel rope.
pub struct Crane {
    world: PhysicsWorld,
    cables: CableSet,
    boom: RigidBodyHandle,
    load: RigidBodyHandle,
    hook: AttachmentHandle,
    time: f64,
    pull: f64,
}

impl Crane {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let boom = world.insert_body(RigidBodyBuilder::kinematic_position_based());
        let load = RigidBodyBuilder::dynamic().translation(Vector::new(ARM as Real, -4.2, 0.0)).can_sleep(false);
        let (load, _) = world.insert(load, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(MASS as Real));
        let rope = Cable::builder()
            .name("hoist rope")
            .points([Vector3::new(ARM, 0.0, 0.0), Vector3::new(ARM, -4.0, 0.0)]) // m
            .section(Section::wire_rope(0.008)?)
            .elements(10)
            .damping(Damping { axial: 0.01, bending: 0.05 }) // s
            // a stiff rope on a moving end: an L-stable method
            .integrator(Integrator {
                method: "generalised-alpha-0".parse()?,
                control: StepControl::MaxStep(1.0 / 240.0),
            })
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        cables.attach(&world, rope, At::Start, boom, Vector::new(ARM as Real, 0.0, 0.0), AttachmentKind::Ball)?;
        let hook = cables.attach(&world, rope, At::End, load, Vector::new(0.0, 0.2, 0.0), AttachmentKind::Ball)?;
        Ok(Crane { world, cables, boom, load, hook, time: 0.0, pull: 0.0 })
    }

    /// Where the boom is to be at the end of the coming host step: smooth, without jumps of velocity.
    fn turn(&mut self) {
        let s = (self.time / TURN).min(1.0);
        let angle = FRAC_PI_2 * s * s * (3.0 - 2.0 * s);
        let rotation = Rotation::from_rotation_y(-angle as Real);
        self.world.bodies[self.boom].set_next_kinematic_rotation(rotation);
    }
}

impl Stage for Crane {
    fn step(&mut self) -> Outcome<()> {
        self.time += 1.0 / 60.0;
        self.turn();
        self.cables.step(&mut self.world)?;
        if self.time > TURN + 1.0 {
            self.pull += self.cables.attachment(self.hook)?.force().norm() / 240.0; // mean over the last 4 s
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        let weight = MASS * 9.81;
        let p = self.world.bodies[self.load].translation();
        let off = f64::from(p.x).hypot(f64::from(p.z) - ARM);
        let line = format!("the rope pulls with {:.1} N of {weight:.1} N, {off:.2} m from under the tip", self.pull);
        if (self.pull / weight - 1.0).abs() < 0.02 && off < 0.5 { Ok(line) } else { Err(line.into()) }
    }
}
