//! A rope over a pulley that does not turn.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};
use std::f64::consts::{FRAC_PI_2, PI};

const DRUM: f64 = 0.1; // m
const ROPE: f64 = 0.005; // m, radius
const FRICTION: f64 = 0.2;
const MASSES: [f64; 2] = [5.0, 12.0]; // kg

/// 5 and 12 kg hang on a rope that lies on a fixed drum of 0.1 m radius.
pub struct Pulley {
    world: PhysicsWorld,
    cables: CableSet,
    heavy: RigidBodyHandle,
    speeds: Vec<f64>,
}

impl Pulley {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        // a cylinder stands along y: this one lies along z
        let lying = Vector::new(FRAC_PI_2 as Real, 0.0, 0.0);
        let drum = ColliderBuilder::cylinder(0.2, DRUM as Real).rotation(lying).friction(FRICTION as Real);
        world.insert_collider(drum, None);
        // half a turn on the drum, then 1 m down on both sides
        let arm = DRUM + ROPE;
        let mut points = vec![Vector3::new(-arm, -1.0, 0.0)];
        points.extend((0..=24).map(|i| PI * f64::from(i) / 24.0).map(|a| Vector3::new(-a.cos(), a.sin(), 0.0) * arm));
        points.push(Vector3::new(arm, -1.0, 0.0));
        let rope = Cable::builder()
            .name("rope")
            .points(points)
            .section(Section::from_stiffness(1.0e6, 1.0e-3, 0.05)?) // EA N, EI N m^2, kg/m
            .elements(42) // about 18 of them on a turn of the drum
            .damping(Damping { axial: 1e-3, bending: 1e-3 }) // s
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        cables.set_contact(rope, Contact::with_friction(FRICTION).with_radius(ROPE))?;
        let mut loads = Vec::new();
        for (x, mass, end) in [(-arm, MASSES[0], At::Start), (arm, MASSES[1], At::End)] {
            let load = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, -1.05, 0.0));
            let (load, _) = world.insert(load, ColliderBuilder::cuboid(0.05, 0.05, 0.05).mass(mass as Real));
            cables.attach(&world, rope, end, load, Vector::new(0.0, 0.05, 0.0), AttachmentKind::Ball)?;
            loads.push(load);
        }
        Ok(Pulley { world, cables, heavy: loads[1], speeds: Vec::new() })
    }
}

impl Stage for Pulley {
    fn step(&mut self) -> Outcome<()> {
        self.cables.step(&mut self.world)?;
        self.speeds.push(-f64::from(self.world.bodies[self.heavy].linvel().y));
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // Euler-Eytelwein: the rope slips, with T2/T1 = exp(mu pi)
        let grip = (FRICTION * PI).exp();
        let expected = 9.81 * (MASSES[1] - MASSES[0] * grip) / (MASSES[1] + MASSES[0] * grip);
        let (from, to) = (self.speeds.len() / 4, self.speeds.len() - 1);
        let a = (self.speeds[to] - self.speeds[from]) * 60.0 / (to - from) as f64;
        let line = format!("12 kg fall at {a:.3} m/s^2, by hand {expected:.3}");
        if (a / expected - 1.0).abs() < 0.05 { Ok(line) } else { Err(line.into()) }
    }
}
