//! A rope bridge: planks on two ropes.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Integrator, PointLoad, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};

const PLANKS: u32 = 7;
const PLANK: f64 = 20.0; // kg
const WALKER: f64 = 80.0; // kg, on the middle plank

/// Seven planks on two ropes of 12.4 m across 12 m; someone stands on the middle plank.
pub struct Bridge {
    world: PhysicsWorld,
    cables: CableSet,
    ends: Vec<AttachmentHandle>,
}

impl Bridge {
    pub fn new() -> Outcome<Self> {
        let (length, g) = (12.4, 9.81);
        let at = |plank: u32| length * f64::from(plank + 1) / f64::from(PLANKS + 1);
        let mass = |plank: u32| if plank == PLANKS / 2 { PLANK + WALKER } else { PLANK };
        let (mut world, mut cables, mut ends) = (PhysicsWorld::new(), CableSet::new(), Vec::new());
        let bank = world.insert_body(RigidBodyBuilder::fixed());
        let mut planks = Vec::new();
        for z in [-0.5, 0.5] {
            let mut rope = Cable::builder()
                .name(format!("rope at z = {z} m"))
                .points([Vector3::new(-6.0, 0.0, z), Vector3::new(6.0, 0.0, z)]) // m
                .length(length)
                .section(Section::wire_rope(0.012)?)
                .elements(16)
                .damping(Damping { axial: 0.005, bending: 0.05 }) // s
                .integrator(Integrator {
                    method: "generalised-alpha-0".parse()?,
                    control: StepControl::MaxStep(1.0 / 240.0),
                })
                .fix(At::Start)
                .fix(At::End)
                .build()?;
            // the shape of the ropes under all loads first, then the planks where it is
            for plank in 0..PLANKS {
                rope.add_load(PointLoad::force(at(plank), -0.5 * mass(plank) * g * Vector3::y()))?;
            }
            rope.equilibrium()?;
            rope.clear_loads();
            let rope = cables.insert(rope);
            for plank in 0..PLANKS {
                let p = cables.get(rope)?.sample(at(plank))?.position;
                if planks.len() < PLANKS as usize {
                    let body = RigidBodyBuilder::dynamic().translation(Vector::new(p.x as Real, p.y as Real, 0.0));
                    let shape = ColliderBuilder::cuboid(0.3, 0.02, 0.6).mass(PLANK as Real);
                    planks.push(world.insert(body.can_sleep(false), shape).0);
                }
                let body = planks[plank as usize];
                cables.attach(&world, rope, at(plank), body, Vector::new(0.0, 0.0, z as Real), AttachmentKind::Ball)?;
            }
            for end in [At::Start, At::End] {
                ends.push(cables.attach_here(&world, rope, end, bank, AttachmentKind::Ball)?);
            }
        }
        let middle = planks[PLANKS as usize / 2];
        world.bodies[middle].add_force(Vector::new(0.0, (-WALKER * g) as Real, 0.0), true);
        Ok(Bridge { world, cables, ends })
    }
}

impl Stage for Bridge {
    fn step(&mut self) -> Outcome<()> {
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        let mut lift = 0.0;
        for &end in &self.ends {
            lift -= self.cables.attachment(end)?.force().y;
        }
        let ropes: f64 =
            self.cables.iter().map(|(_, rope)| rope.length() * rope.elements()[0].section.mass_per_length).sum();
        let weight = (f64::from(PLANKS) * PLANK + WALKER + ropes) * 9.81;
        let line = format!("the four ends carry {lift:.1} N, all of it weighs {weight:.1} N");
        if (lift / weight - 1.0).abs() < 0.01 { Ok(line) } else { Err(line.into()) }
    }
}
