//! A street lamp on a cable in the wind.

use super::{Outcome, Stage};
use lariat_rapier::convert::{to_vector, vector};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Drag, Effects, Fidelity, Flow, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

const AIR: f64 = 1.2; // kg/m^3
const SHADE: f64 = 0.09; // m^2, drag coefficient times area of the lamp
const WIND: f64 = 10.0; // m/s

/// A lamp of 3 kg on 1.5 m of cable; within 2 s a wind of 10 m/s rises.
pub struct Lamp {
    world: PhysicsWorld,
    cables: CableSet,
    lamp: RigidBodyHandle,
    flow: Flow,
    time: f64,
    angle: f64,
}

impl Lamp {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let lamp = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -1.5, 0.0)).can_sleep(false);
        let (lamp, _) = world.insert(lamp, ColliderBuilder::ball(0.15).mass(3.0));
        // of time (s) and share of the wind
        let flow = Flow::uniform(Vector3::new(WIND, 0.0, 0.0)).with_history([[0.0, 0.0], [2.0, 1.0]]);
        let mut drag = Drag::new(AIR, 1.2, 0.01, flow.clone());
        drag.diameter = Some(0.008); // m: a section of measured stiffness has none
        let damping = Damping { axial: 0.01, bending: 0.02 }; // s
        let cable = Cable::builder()
            .name("lamp cable")
            .points([Vector3::zeros(), Vector3::new(0.0, -1.5, 0.0)]) // m
            .section(Section::from_stiffness(5.0e4, 0.01, 0.08)?) // EA N, EI N m^2, kg/m
            .elements(8)
            .effects(Effects { drag: Some(drag), damping: Some(damping), ..Effects::default() })
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .build()?;
        let mut cables = CableSet::new();
        let cable = cables.insert(cable);
        cables.attach(&world, cable, At::End, lamp, Vector::ZERO, AttachmentKind::Ball)?;
        Ok(Lamp { world, cables, lamp, flow, time: 0.0, angle: 0.0 })
    }

    /// Drag acts on cables; the wind on a body is the user's force.
    fn blow(&mut self) {
        let body = &mut self.world.bodies[self.lamp];
        let v = body.linvel();
        let wind = self.flow.at(self.time, &Vector3::zeros());
        let past = wind - vector(v);
        let force = past * (0.5 * AIR * SHADE * past.norm());
        body.reset_forces(true);
        body.add_force(to_vector(&force), true);
    }
}

impl Stage for Lamp {
    fn step(&mut self) -> Outcome<()> {
        self.blow();
        self.time += 1.0 / 60.0;
        self.cables.step(&mut self.world)?;
        let p = self.world.bodies[self.lamp].translation();
        if self.time > 15.0 {
            self.angle += f64::from(p.x).atan2(f64::from(-p.y)) / 300.0; // mean over the last 5 s
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // moments about the top: half of what acts on the cable acts at the lamp
        let (lamp, cable) = (0.5 * AIR * SHADE * WIND * WIND, 0.5 * AIR * 1.2 * 0.008 * 1.5 * WIND * WIND);
        let expected = (lamp + 0.5 * cable).atan2((3.0 + 0.5 * 1.5 * 0.08) * 9.81);
        let (angle, expected) = (self.angle.to_degrees(), expected.to_degrees());
        let line = format!("the lamp hangs {angle:.2} degrees out of the vertical, by hand {expected:.2}");
        if (angle / expected - 1.0).abs() < 0.02 { Ok(line) } else { Err(line.into()) }
    }
}
