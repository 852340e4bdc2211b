//! A world with cables, made in one way, that a case is played on.

mod case;
mod measure;
mod peers;

pub use case::{Bounds, Case, Play, Refusals, case};
pub use measure::play;

use super::engine::rapier::prelude::*;
use super::engine::{AttachmentHandle, AttachmentKind, CableHandle, CableSet};
use crate::stability::host::{Host, Make};
use lariat_ancf::{
    At, Buoyancy, Cable, CableBuilder, Damping, Drag, Effects, Flow, GravityScale, Integrator, LineLoad, RestShape,
    Section, StepControl, Vector3,
};
use measure::Trace;

/// Any error of a case.
pub type Fault = Box<dyn std::error::Error + Send + Sync>;

/// What holds an end of a rope.
#[derive(Clone, Copy, Debug)]
pub enum End {
    /// Nothing.
    Free,
    /// It stays where it is.
    Fixed,
    /// Its place and the direction of its tangent stay.
    Clamped,
    /// A point of a body, in body axes.
    On(RigidBodyHandle, [f64; 3]),
    /// A body, clamped to it.
    ClampedOn(RigidBodyHandle, [f64; 3]),
}

/// A rope as the stage knows it.
pub enum Strand {
    /// A cable of the set.
    Cable(CableHandle),
    /// A soft rope, its rest length, what its ends hold to, and the mass between two particles.
    Soft(SoftBodyHandle, f64, [Hold; 2], f64),
    /// Links, the half length of each, the rest length, and what the ends hold to.
    Links(Vec<(RigidBodyHandle, f64)>, f64, [Hold; 2]),
}

/// What the end of a rival's rope holds to: a point of the world, or of a body.
#[derive(Clone, Copy, Debug)]
pub enum Hold {
    /// Free.
    None,
    /// A point of the world.
    World([f64; 3]),
    /// A point of a body.
    Body(RigidBodyHandle, [f64; 3]),
}

/// A world, its cables, and what is measured on them.
pub struct Stage {
    pub world: PhysicsWorld,
    pub set: CableSet,
    pub make: Make,
    pub host: Host,
    /// Host steps done.
    pub k: usize,
    /// Time in s.
    pub time: f64,
    pub strands: Vec<Strand>,
    pub held: Vec<AttachmentHandle>,
    pub trace: Trace,
}

/// To Rapier.
pub fn to(x: [f64; 3]) -> Vector {
    Vector::new(x[0] as Real, x[1] as Real, x[2] as Real)
}

/// From Rapier.
pub fn from(x: Vector) -> Vector3<f64> {
    Vector3::new(f64::from(x.x), f64::from(x.y), f64::from(x.z))
}

/// E = 1e9 Pa, 4000 kg/m^3, square of 1 cm: EA = 1e5 N, 0.4 kg/m.
pub fn soft() -> Section {
    Section::square(0.01, 1e9, 4000.0).expect("a section")
}

/// Steel wire, 3 mm round: EA = 1.41e6 N, 0.055 kg/m.
pub fn wire() -> Section {
    Section::round(0.003, 2e11, 7850.0).expect("a section")
}

/// Generalised-alpha of spectral radius 0 at 1/480 s: damps what the step does not resolve.
pub fn damping() -> Integrator {
    Integrator { method: "generalised-alpha-0".parse().expect("a method"), control: StepControl::MaxStep(1.0 / 480.0) }
}

/// A cable along a straight line.
pub fn line(a: [f64; 3], b: [f64; 3], section: Section) -> CableBuilder {
    Cable::builder().points([Vector3::from(a), Vector3::from(b)]).section(section)
}

/// All effects, mild: losses, a breeze across, its buoyancy, a slight curl, a load along, nine tenths of gravity.
pub fn all_effects(weight_per_length: f64) -> Effects {
    let mut drag = Drag::new(1.2, 1.2, 0.02, Flow::uniform(Vector3::new(0.5, 0.0, 1.0)));
    drag.diameter = Some(0.01);
    let mut buoyancy = Buoyancy::new(1.2, 1.0);
    buoyancy.area = Some(1e-4);
    Effects {
        damping: Some(Damping { axial: 1e-4, bending: 1e-3 }),
        drag: Some(drag),
        buoyancy: Some(buoyancy),
        rest_shape: Some(RestShape::curved(0.05)),
        line_loads: Some(LineLoad::uniform(Vector3::new(0.0, 0.0, 0.05 * weight_per_length)).into()),
        gravity_scale: Some(GravityScale(0.9)),
    }
}

impl Stage {
    pub fn new(host: Host, make: Make) -> Self {
        let mut world = PhysicsWorld::new();
        let ours = make == Make::Lariat;
        let mut set = CableSet::new();
        // rivals get the split of the host step that is Lariat's default
        let parts = set.settings.rapier_steps;
        world.integration_parameters.dt = 1.0 / (host.rate as Real * if ours { 1.0 } else { parts as Real });
        world.integration_parameters.num_solver_iterations = host.iterations;
        set.settings.sleep_speed = 2e-3;
        Stage {
            world,
            set,
            make,
            host,
            k: 0,
            time: 0.0,
            strands: Vec::new(),
            held: Vec::new(),
            trace: Trace::default(),
        }
    }

    /// Length of the host's regular step in s.
    pub fn dt(&self) -> f64 {
        1.0 / f64::from(self.host.rate)
    }

    /// No gravity.
    pub fn weightless(&mut self) {
        self.world.gravity = Vector::ZERO;
    }

    /// A dynamic ball.
    pub fn ball(&mut self, mass: f64, radius: f64, at: [f64; 3]) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic().translation(to(at)).can_sleep(false);
        self.world.insert(body, ColliderBuilder::ball(radius as Real).mass(mass as Real)).0
    }

    /// A dynamic cube of half side `half`.
    pub fn cube(&mut self, mass: f64, half: f64, at: [f64; 3]) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic().translation(to(at)).can_sleep(false);
        let half = half as Real;
        self.world.insert(body, ColliderBuilder::cuboid(half, half, half).mass(mass as Real)).0
    }

    /// A fixed box.
    pub fn post(&mut self, at: [f64; 3], half: [f64; 3]) -> RigidBodyHandle {
        let half = to(half);
        let body = RigidBodyBuilder::fixed().translation(to(at));
        self.world.insert(body, ColliderBuilder::cuboid(half.x, half.y, half.z)).0
    }

    /// A body that moves by velocity.
    pub fn winch(&mut self, at: [f64; 3]) -> RigidBodyHandle {
        self.world.insert_body(RigidBodyBuilder::kinematic_velocity_based().translation(to(at)))
    }

    /// Sets the velocity of a body.
    pub fn drive(&mut self, body: RigidBodyHandle, velocity: [f64; 3]) {
        self.world.bodies[body].set_linvel(to(velocity), true);
    }

    /// Place of a body's origin in m.
    pub fn place(&self, body: RigidBodyHandle) -> Vector3<f64> {
        from(self.world.bodies[body].translation())
    }

    /// A rope between two ends, in the way of this stage.
    pub fn rope(&mut self, builder: CableBuilder, start: End, end: End) -> Result<usize, Fault> {
        let mut builder = builder;
        for (at, end) in [(At::Start, start), (At::End, end)] {
            builder = match end {
                End::Fixed => builder.fix(at),
                End::Clamped => builder.clamp(at),
                _ => builder,
            };
        }
        let mut cable = builder.name(format!("rope {}", self.strands.len())).build()?;
        if self.host.effects {
            let own = cable.effects().clone();
            let section = &cable.elements()[0].section;
            let mut effects = all_effects(9.81 * section.mass_per_length);
            if own.damping.is_some() {
                effects.damping = own.damping;
            }
            cable.set_effects(effects)?;
        }
        let strand = match self.make {
            Make::Lariat => {
                let handle = self.set.insert(cable);
                for (at, end) in [(At::Start, start), (At::End, end)] {
                    let (body, anchor, pin) = match end {
                        End::On(body, anchor) => (body, anchor, AttachmentKind::Ball),
                        End::ClampedOn(body, anchor) => (body, anchor, AttachmentKind::Clamp),
                        _ => continue,
                    };
                    self.held.push(self.set.attach(&self.world, handle, at, body, to(anchor), pin)?);
                }
                Strand::Cable(handle)
            }
            Make::SoftRope => peers::soft_rope(&mut self.world, &cable, start, end),
            Make::Capsules | Make::Multibody => peers::links(&mut self.world, &cable, start, end, self.make),
        };
        self.strands.push(strand);
        Ok(self.strands.len() - 1)
    }

    /// A cable of the set.
    pub fn cable(&self, i: usize) -> Option<&Cable> {
        match self.strands.get(i) {
            Some(Strand::Cable(handle)) => self.set.get(*handle).ok(),
            _ => None,
        }
    }

    /// A cable of the set, to change it.
    pub fn cable_mut(&mut self, i: usize) -> Result<&mut Cable, Fault> {
        match self.strands.get(i) {
            Some(Strand::Cable(handle)) => Ok(self.set.get_mut(*handle)?),
            _ => Err("not one of Lariat's".into()),
        }
    }

    /// Tension of a cable at an arc length in N; none of the rivals' can be read.
    pub fn tension(&self, i: usize, s: f64) -> f64 {
        self.cable(i).and_then(|c| c.sample(s).ok()).map_or(f64::NAN, |sample| sample.tension)
    }

    /// Force of an attachment at the last step in N.
    pub fn force(&self, i: usize) -> Vector3<f64> {
        let a = self.held.get(i).and_then(|a| self.set.attachment(*a).ok());
        a.map_or(Vector3::repeat(f64::NAN), |a| a.force())
    }

    /// One host step.
    pub fn step(&mut self) -> Result<(), Fault> {
        if self.make == Make::Lariat {
            self.set.step(&mut self.world)?;
        } else {
            for _ in 0..self.set.settings.rapier_steps {
                self.world.step();
            }
        }
        Ok(())
    }
}
