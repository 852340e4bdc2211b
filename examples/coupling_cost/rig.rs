//! A scene with its cables made in one way, ready to run.

use crate::Outcome;
use crate::peers::{self, Chain};
use crate::scene::{HALF, LENGTH, PARTS, RATE, Scene};
use lariat::{At, Cable, Fidelity, Integrator, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

/// How cables are made.
#[derive(Clone, Copy, PartialEq)]
pub enum Make {
    /// Boxes alone.
    Nothing,
    /// Lariat with one of its presets.
    Lariat(Fidelity),
    /// Lariat with an integrator.
    Exact(Integrator),
    /// Rapier's soft rope, with the natural frequency of its edges in Hz.
    SoftRope(Real),
    /// Capsules with spherical joints.
    Capsules(Chain),
}

/// How a host step is split, and Rapier's solver iterations in each part.
#[derive(Clone, Copy, PartialEq)]
pub struct Split {
    pub steps: u32,
    pub iterations: usize,
}

enum Cables {
    None,
    Lariat(Box<CableSet>, Vec<CableHandle>),
    Soft(Vec<SoftBodyHandle>),
    Capsules(Vec<Vec<RigidBodyHandle>>),
}

/// A world that runs.
pub struct Rig {
    pub world: PhysicsWorld,
    boxes: Vec<RigidBodyHandle>,
    cables: Cables,
    steps: u32,
    start: Vector,
}

fn vector(x: Vector) -> Vector3<f64> {
    Vector3::new(f64::from(x.x), f64::from(x.y), f64::from(x.z))
}

/// A cable of the scene, not yet held by its box.
pub fn cable(scene: &Scene, make: Make, i: usize) -> Outcome<Cable> {
    let section = Section::square(crate::scene::SIDE, scene.material.young, scene.material.density)?;
    let builder = Cable::builder()
        .points([vector(scene.start(i)), vector(scene.along(i, 1.0))])
        .length(LENGTH)
        .section(section)
        .elements(PARTS)
        .fix(At::Start);
    Ok(match make {
        Make::Lariat(fidelity) => builder.fidelity(fidelity),
        Make::Exact(integrator) => builder.integrator(integrator),
        _ => return Err("not one of Lariat's".into()),
    }
    .build()?)
}

impl Rig {
    pub fn new(scene: &Scene, make: Make, split: Split) -> Outcome<Self> {
        let Split { steps, iterations } = split;
        let ours = matches!(make, Make::Lariat(_) | Make::Exact(_));
        // a set splits the host step itself
        let (mut world, boxes) = scene.world(if ours { 1 } else { steps }, iterations);
        let every = 0..scene.count;
        let cables = match make {
            Make::Nothing => Cables::None,
            Make::Lariat(_) | Make::Exact(_) => {
                let mut set = CableSet::new();
                set.settings.rapier_steps = steps;
                let handles = every.map(|i| {
                    let handle = set.insert(cable(scene, make, i)?);
                    set.attach(&world, handle, At::End, boxes[i], Vector::Y * HALF, AttachmentKind::Ball)?;
                    Ok(handle)
                });
                let handles = handles.collect::<Outcome<_>>()?;
                Cables::Lariat(Box::new(set), handles)
            }
            Make::SoftRope(frequency) => {
                Cables::Soft(every.map(|i| peers::soft_rope(scene, &mut world, boxes[i], i, frequency)).collect())
            }
            Make::Capsules(chain) => {
                Cables::Capsules(every.map(|i| peers::capsules(scene, &mut world, boxes[i], i, chain)).collect())
            }
        };
        Ok(Rig { world, boxes, cables, steps: if ours { 1 } else { steps }, start: scene.start(0) })
    }

    /// One host step of 1/60 s.
    pub fn step(&mut self) -> Outcome<()> {
        for _ in 0..self.steps {
            match &mut self.cables {
                Cables::Lariat(set, _) => set.step(&mut self.world)?,
                _ => self.world.step(),
            }
        }
        Ok(())
    }

    /// The centre of the first box in m.
    pub fn centre(&self) -> Vector3<f64> {
        vector(self.world.bodies[self.boxes[0]].translation())
    }

    /// World and set, if the cables are Lariat's.
    pub fn parts(&mut self) -> Option<(&mut PhysicsWorld, &mut CableSet)> {
        if let Cables::Lariat(set, _) = &mut self.cables { Some((&mut self.world, set)) } else { None }
    }

    /// The set and its cables, if they are Lariat's.
    pub fn lariat(&mut self) -> Option<(&mut CableSet, &[CableHandle])> {
        if let Cables::Lariat(set, handles) = &mut self.cables { Some((set, handles)) } else { None }
    }

    /// Length of the first cable over its unstretched length, less 1: through nodes, particles or joints from the fixed point to
    /// the point of the box, so that gaps count.
    pub fn stretch(&self) -> f64 {
        let holder = &self.world.bodies[self.boxes[0]];
        let between: Vec<Vector3<f64>> = match &self.cables {
            Cables::None => return 0.0,
            Cables::Lariat(set, handles) => {
                let cable = set.get(handles[0]).expect("it was inserted");
                (1..PARTS).map(|k| cable.node_position(k)).collect()
            }
            Cables::Soft(handles) => {
                let places = self.world.soft_bodies[handles[0]].particle_positions();
                places.take(PARTS).skip(1).map(vector).collect()
            }
            Cables::Capsules(chains) => peers::joints(&self.world, &chains[0]).into_iter().map(vector).collect(),
        };
        let mut points = vec![vector(self.start)];
        points.extend(between);
        points.push(vector(*holder.position() * (Vector::Y * HALF)));
        points.windows(2).map(|p| (p[1] - p[0]).norm()).sum::<f64>() / LENGTH - 1.0
    }
}

/// Host steps in a time in s.
pub fn host_steps(seconds: f64) -> usize {
    (seconds * RATE as f64).round() as usize
}
