//! A flag is hoisted in the wind.

use super::{Outcome, Stage};
use lariat_rapier::convert::{to_vector, vector};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, Reel, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet, SheaveOptions};

const POLE: f64 = 8.0; // m
const FLAG: f64 = 0.6; // kg
const RATE: f64 = 0.5; // m/s
const BEGIN: f64 = 1.5; // m, height of the flag before it is hoisted
const WIND: f64 = 6.0; // m/s
const STOP: u32 = 600; // host step
const SHADE: f64 = 0.05; // m^2, drag coefficient times area of the flag across the wind

/// A winch at the foot of a pole of 8 m hoists a flag of 0.6 kg over the truck at the top, in a wind of 6 m/s.
pub struct Flag {
    world: PhysicsWorld,
    cables: CableSet,
    halyard: CableHandle,
    hook: AttachmentHandle,
    flag: RigidBodyHandle,
    steps: u32,
}

impl Flag {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let truck = world.insert_body(RigidBodyBuilder::fixed().translation(Vector::new(0.0, POLE as Real, 0.0)));
        let flag =
            RigidBodyBuilder::dynamic().translation(Vector::new(0.0, (BEGIN - 0.3) as Real, 0.0)).can_sleep(false);
        let (flag, _) = world.insert(flag, ColliderBuilder::cuboid(0.02, 0.3, 0.4).mass(FLAG as Real).sensor(true));
        let halyard = Cable::builder()
            .name("halyard")
            .points([Vector3::zeros(), Vector3::new(0.0, POLE, 0.0), Vector3::new(0.0, BEGIN, 0.0)])
            .section(Section::from_stiffness(2.0e4, 1e-3, 0.02)?) // EA N, EI N m^2, kg/m: 5 mm
            .elements(14)
            .node_at(POLE)
            .damping(Damping { axial: 0.02, bending: 0.02 }) // s
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .build()?;
        let mut cables = CableSet::new();
        let halyard = cables.insert(halyard);
        let hook = cables.attach(&world, halyard, At::End, flag, Vector::new(0.0, 0.3, 0.0), AttachmentKind::Ball)?;
        let sheave = SheaveOptions { friction: 0.05, ..SheaveOptions::default() };
        cables.add_sheave_at(&world, (halyard, POLE), (truck, Vector::ZERO), sheave)?;
        let winch = Reel { acceleration: 0.5, ..Reel::with_rate(-RATE) };
        cables.get_mut(halyard)?.add_reel(At::Start, winch)?;
        Ok(Flag { world, cables, halyard, hook, flag, steps: 0 })
    }

    /// The wind on the flag; drag of the halyard would be the effect `Drag`.
    fn blow(&mut self) {
        let body = &mut self.world.bodies[self.flag];
        let past = Vector3::new(WIND, 0.0, 0.0) - vector(body.linvel());
        body.reset_forces(true);
        body.add_force(to_vector(&(past * (0.5 * 1.2 * SHADE * past.norm()))), true);
    }
}

impl Stage for Flag {
    fn step(&mut self) -> Outcome<()> {
        self.steps += 1;
        if self.steps == STOP {
            self.cables.get_mut(self.halyard)?.set_reel_rate(At::Start, 0.0)?;
        }
        self.blow();
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        // 6.5 m hung behind the truck, less what was hoisted: it speeds up and stops in the same time; the halyard pulls against wind and weight
        let attachment = self.cables.attachment(self.hook)?;
        let force = attachment.force();
        let hook = vector(self.world.bodies[self.flag].position() * Vector::new(0.0, 0.3, 0.0));
        let below = (hook - Vector3::new(0.0, POLE, 0.0)).norm();
        let left = POLE - BEGIN - RATE * f64::from(STOP - 1) / 60.0;
        let (wind, weight) = (0.5 * 1.2 * SHADE * WIND * WIND, FLAG * 9.81);
        let line = format!(
            "the flag hangs {below:.3} m under the truck, by hand {left:.3} m; the halyard pulls with {:.2} N against the wind and {:.2} N upwards, by hand {wind:.2} N and {weight:.2} N",
            -force.x, force.y
        );
        let fine = (below - left).abs() < 0.005
            && (-force.x / wind - 1.0).abs() < 0.05
            && (force.y / weight - 1.0).abs() < 0.02;
        if fine { Ok(line) } else { Err(line.into()) }
    }
}
