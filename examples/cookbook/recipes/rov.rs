//! A vehicle under water on its tether.

use super::{Outcome, Stage};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{
    At, Buoyancy, Cable, Drag, Effects, Fidelity, RopeKind, Section, Surface, Vector3, Water,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::water::{BodiesInWater, Immersed};
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};

const TETHER: f64 = 30.0; // m
const THRUST: f64 = 200.0; // N
const SINKS: f64 = 100.0; // N: weight less buoyancy
const MASS: f64 = 90.0; // kg
const SEA: f64 = 1025.0; // kg/m^3

/// A vehicle of 90 kg hangs on 30 m of neutral tether from a ship, and drives off until the tether holds it.
pub struct Rov {
    world: PhysicsWorld,
    cables: CableSet,
    vehicle: RigidBodyHandle,
    hook: AttachmentHandle,
}

impl Rov {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let down = vector(world.gravity);
        let vehicle = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -TETHER as Real, 0.0));
        let (vehicle, _) = world.insert(vehicle, ColliderBuilder::cuboid(0.4, 0.25, 0.3).mass(MASS as Real));
        // the water: a current would be `.with_flow(Flow::uniform(..))`
        let water = Water::new(SEA).with_surface(Surface::at(0.0, down));
        let immersed = Immersed::with_drag_area([0.3, 0.6, 0.5]) // m^2, along its own axes
            .with_added_mass(0.7)
            .with_volume((MASS - SINKS / down.norm()) / SEA); // m^3: its frame is open
        let mut bodies = BodiesInWater::new(water.clone())?;
        bodies.insert(&mut world, vehicle, immersed)?;
        let mut cables = CableSet::new();
        cables.set_water(bodies);
        // 12 mm of tether that is as heavy as the water it displaces
        let section = Section::from_stiffness(2.0e5, 0.05, SEA * 1.131e-4)?; // EA N, EI N m^2, kg/m
        let drag = Drag { diameter: Some(0.012), ..Drag::new(SEA, 1.2, 0.01, water.flow) };
        let buoyancy = Buoyancy { area: Some(1.131e-4), ..Buoyancy::new(SEA, 1.0) }; // m^2
        let tether = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(0.0, -TETHER, 0.0)])
            .section(section)
            .elements(15)
            .effects(Effects { drag: Some(drag), buoyancy: Some(buoyancy), ..Effects::default() })
            .damped_as(RopeKind::FibreRope)
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .build()?;
        let tether = cables.insert(tether);
        let hook = cables.attach_here(&world, tether, At::End, vehicle, AttachmentKind::Ball)?;
        // thrusters: a force that stays until it is set again
        world.bodies[vehicle].add_force(Vector::new(THRUST as Real, 0.0, 0.0), true);
        Ok(Rov { world, cables, vehicle, hook })
    }
}

impl Stage for Rov {
    fn step(&mut self) -> Outcome<()> {
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        // at rest a neutral tether is straight, along thrust and what the vehicle sinks with
        let place = vector(self.world.bodies[self.vehicle].translation());
        let pull = self.cables.attachment(self.hook)?.force().norm();
        let force = Vector3::new(THRUST, -SINKS, 0.0);
        let expected = force.normalize() * TETHER;
        let off = (place - expected).norm();
        let line = format!(
            "the vehicle is {off:.3} m from where a straight tether holds it, the tether pulls {pull:.1} N; by hand {:.1} N",
            force.norm()
        );
        if off < 0.3 && (pull / force.norm() - 1.0).abs() < 0.01 { Ok(line) } else { Err(line.into()) }
    }
}
