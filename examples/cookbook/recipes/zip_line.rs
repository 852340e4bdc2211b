//! A rider on a zip line.

use super::{Outcome, Stage};
use lariat_rapier::convert::{to_vector, vector};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, PointLoad, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableSet, SheaveHandle, SheaveOptions};

const SPAN: f64 = 30.0; // m
const DROP: f64 = 2.0; // m
const RIDER: f64 = 80.0; // kg
const START: f64 = 3.0; // m along the line
const HANGS: f64 = 0.8; // m, the middle of the rider under the wheel

/// A rider of 80 kg rolls down a rope of HMPE across 30 m that ends 2 m lower.
pub struct ZipLine {
    world: PhysicsWorld,
    cables: CableSet,
    rider: RigidBodyHandle,
    wheel: SheaveHandle,
    length: f64,
    start: Vector3<f64>,
}

impl ZipLine {
    pub fn new() -> Outcome<Self> {
        let length = 1.01 * SPAN.hypot(DROP); // m
        let mut line = Cable::builder()
            .name("zip line")
            .points([Vector3::zeros(), Vector3::new(SPAN, -DROP, 0.0)])
            .length(length)
            .section(Section::from_stiffness(4.8e6, 0.05, 0.07)?) // EA N, EI N m^2, kg/m: 12 mm
            .elements(20)
            .node_at(START)
            .damping(Damping { axial: 2e-3, bending: 2e-3 }) // s
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .fix(At::End)
            .build()?;
        // the shape under the rider first, so that he does not fall into the line
        line.add_load(PointLoad::force(START, -RIDER * 9.81 * Vector3::y()))?;
        line.equilibrium()?;
        line.clear_loads();
        let start = line.sample(START)?.position - HANGS * Vector3::y();
        let mut world = PhysicsWorld::new();
        let rider = RigidBodyBuilder::dynamic().translation(to_vector(&start)).can_sleep(false);
        let (rider, _) = world.insert(rider, ColliderBuilder::capsule_y(0.4, 0.2).mass(RIDER as Real));
        let mut cables = CableSet::new();
        let line = cables.insert(line);
        // the wheel is an eye of the rider: the line runs through it
        let eye = (rider, Vector::new(0.0, HANGS as Real, 0.0));
        let wheel = cables.add_sheave_at(&world, (line, START), eye, SheaveOptions::default())?;
        Ok(ZipLine { world, cables, rider, wheel, length, start })
    }
}

impl Stage for ZipLine {
    fn step(&mut self) -> Outcome<()> {
        Ok(self.cables.step(&mut self.world)?)
    }

    fn check(&mut self) -> Outcome<String> {
        // by energy alone, and on the ellipse that a taut line of this length allows to the wheel
        let body = &self.world.bodies[self.rider];
        let (at, speed) = (vector(body.translation()), f64::from(body.linvel().length()));
        let expected = (2.0 * 9.81 * (self.start.y - at.y)).max(0.0).sqrt();
        let wheel = vector(*body.position() * Vector::new(0.0, HANGS as Real, 0.0));
        let ways = wheel.norm() + (wheel - Vector3::new(SPAN, -DROP, 0.0)).norm();
        let way = -self.cables.sheave(self.wheel)?.passed(); // line that ran to the part before the wheel
        let line = format!(
            "{speed:.2} m/s after {way:.1} m, by energy {expected:.2} m/s; both parts are {ways:.2} m, the line {:.2} m",
            self.length
        );
        let fine = (speed / expected - 1.0).abs() < 0.05 && (ways / self.length - 1.0).abs() < 3e-3;
        if fine { Ok(line) } else { Err(line.into()) }
    }
}
