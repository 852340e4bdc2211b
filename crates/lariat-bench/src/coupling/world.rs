//! A scene with cables of one model, ready to run.

use super::model::{CableModel, Split};
use super::scene::{ELEMENTS, HALF, LENGTH, RATE, Scene};
use crate::error::Error;
use crate::single::convert::from_rapier;
use crate::single::peers::{End, PeerRope};
use lariat_ancf::{At, Cable, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

enum Cables {
    None,
    Lariat(Box<CableSet>, Vec<CableHandle>),
    Peers(Vec<PeerRope>),
}

/// A world that runs.
pub struct World {
    pub physics: PhysicsWorld,
    boxes: Vec<RigidBodyHandle>,
    cables: Cables,
    /// Rapier steps per host step, where no set of cables splits it.
    steps: u32,
    start: Vector,
}

/// Builds a cable of the scene, not yet attached to its box.
pub fn cable(scene: &Scene, model: CableModel, i: usize) -> Result<Cable, Error> {
    let builder = scene.cable(i)?;
    let builder = match model {
        CableModel::Lariat(fidelity) => builder.fidelity(fidelity),
        CableModel::Exact(integrator) => builder.integrator(integrator),
        _ => builder,
    };
    Ok(builder.build()?)
}

impl World {
    /// Creates a scene with cables of a model.
    ///
    /// # Errors
    /// [`Error::Mechanics`], [`Error::Coupling`]; not for the scenes here.
    pub fn new(scene: &Scene, model: CableModel, split: Split) -> Result<Self, Error> {
        let steps = if model.is_lariat() { 1 } else { split.steps };
        let (mut physics, boxes) = scene.world(steps, split.iterations);
        let each = boxes.iter().enumerate();
        let cables = match model {
            CableModel::None => Cables::None,
            CableModel::Lariat(_) | CableModel::Exact(_) => {
                let mut set = CableSet::new();
                set.settings.rapier_steps = split.steps;
                let handles = each.map(|(i, holder)| {
                    let handle = set.insert(cable(scene, model, i)?);
                    set.attach(&physics, handle, At::End, *holder, Vector::Y * HALF, AttachmentKind::Ball)?;
                    Ok(handle)
                });
                let handles = handles.collect::<Result<_, Error>>()?;
                Cables::Lariat(Box::new(set), handles)
            }
            CableModel::SoftRope(_) | CableModel::Capsules(_) => {
                let ropes = each.map(|(i, holder)| {
                    let ends = [End::Fixed, End::On(*holder, [0.0, f64::from(HALF), 0.0])];
                    let cable = cable(scene, model, i)?;
                    Ok(match model {
                        CableModel::Capsules(joints) => PeerRope::capsules(&mut physics, &cable, ends, joints, None),
                        CableModel::SoftRope(frequency) => PeerRope::soft(&mut physics, &cable, ends, frequency, None),
                        _ => unreachable!("matched above"),
                    })
                });
                Cables::Peers(ropes.collect::<Result<_, Error>>()?)
            }
        };
        Ok(World { physics, boxes, cables, steps, start: scene.start(0) })
    }

    /// Advances by one host step of 1/60 s.
    ///
    /// # Errors
    /// As [`CableSet::step`].
    pub fn step(&mut self) -> Result<(), Error> {
        for _ in 0..self.steps {
            match &mut self.cables {
                Cables::Lariat(set, _) => set.step(&mut self.physics)?,
                _ => self.physics.step(),
            }
        }
        Ok(())
    }

    /// Returns the centre of the first box in m.
    pub fn centre(&self) -> Vector3<f64> {
        from_rapier(self.physics.bodies[self.boxes[0]].translation())
    }

    /// Returns the physics and the set of cables, if there is one.
    pub fn parts(&mut self) -> Option<(&mut PhysicsWorld, &mut CableSet)> {
        if let Cables::Lariat(set, _) = &mut self.cables { Some((&mut self.physics, set)) } else { None }
    }

    /// Returns the first cable of the set, to reset or read its counts.
    pub fn first_cable(&mut self) -> Option<&mut Cable> {
        if let Cables::Lariat(set, handles) = &mut self.cables { set.get_mut(handles[0]).ok() } else { None }
    }

    /// Returns the length of the first cable over its unstretched length, minus 1.
    ///
    /// It is measured through nodes, particles or joints, from the fixed point to the point of the
    /// box, so that gaps count.
    pub fn stretch(&self) -> f64 {
        match &self.cables {
            Cables::None => 0.0,
            Cables::Peers(ropes) => ropes[0].stretch(&self.physics),
            Cables::Lariat(set, handles) => {
                let cable = set.get(handles[0]).expect("a cable of this set");
                let holder = &self.physics.bodies[self.boxes[0]];
                let mut points = vec![from_rapier(self.start)];
                points.extend((1..ELEMENTS).map(|k| cable.node_position(k)));
                points.push(from_rapier(*holder.position() * (Vector::Y * HALF)));
                points.windows(2).map(|p| (p[1] - p[0]).norm()).sum::<f64>() / LENGTH - 1.0
            }
        }
    }
}

/// Returns the host steps in a time in s.
pub fn host_steps(seconds: f64) -> usize {
    (seconds * RATE as f64).round() as usize
}
