//! Static equilibrium of the bodies of a scene and the cables attached to them.

use super::{Physics, build};
use crate::error::Error;
use crate::scene::body::BodyKind;
use crate::scene::{BodyLoadScene, Scene};
use lariat_ancf::{Cable, EquilibriumReport};
use lariat_rapier::convert::to_vector;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{AttachmentReading, BodyForce, Equilibrium};

/// What statics did with the bodies of a scene, by their positions in it.
#[non_exhaustive]
pub struct Settled {
    /// By cable, the report of its equilibrium.
    pub cables: Vec<EquilibriumReport>,
    /// Bodies that were moved to equilibrium.
    pub moved: Vec<usize>,
    /// Attached bodies that were held where they are drawn.
    pub held: Vec<usize>,
    /// Dynamic bodies that no cable is attached to.
    pub unattached: Vec<usize>,
    /// Host steps of 1/60 s in which all came to rest by its motion, where statics have no law for
    /// what touches.
    pub relaxation_steps: Option<u32>,
}

impl Physics {
    /// Moves cables and dynamic bodies to equilibrium, `fully` with those loads on bodies that have a ramp, which then stay.
    ///
    /// # Errors
    /// [`Error::Mechanics`] without an equilibrium, [`Error::Body`] for a body with a contact, or a joint that statics do not compute.
    pub fn settle(&mut self, scene: &Scene, fully: bool, drawn: Vec<Cable>) -> Result<Settled, Error> {
        self.script.full_loads = fully;
        let acting = scene.body_loads.iter().filter(|load| fully || load.load.ramp == 0.0);
        let force = |load: &BodyLoadScene| BodyForce {
            body: self.bodies[load.body],
            point: to_vector(&load.point),
            force: load.at(0.0, fully).0,
        };
        let forces: Vec<BodyForce> = acting.clone().map(force).collect();
        for load in &scene.body_loads {
            let body = &mut self.world.bodies[self.bodies[load.body]];
            body.reset_forces(false);
            body.reset_torques(false);
        }
        for load in acting {
            let (_, moment) = load.at(0.0, fully);
            self.world.bodies[self.bodies[load.body]].add_torque(to_vector(&moment), true);
        }
        let drawn: Vec<_> = self.handles.iter().copied().zip(drawn).collect();
        let found = self.cables.equilibrium_from(&mut self.world, &forces, &drawn);
        let found = found.map_err(|error| self.explain(scene, 0.0, error))?;
        self.settled(scene, &found)
    }

    /// Looks whether the cables, each of which found an equilibrium by itself, are on the side of each other on which they were drawn.
    ///
    /// # Errors
    /// [`Error::Coupling`] with the names of two that are not.
    pub fn check_drawn(&self, scene: &Scene, drawn: Vec<Cable>) -> Result<(), Error> {
        let drawn: Vec<_> = self.handles.iter().copied().zip(drawn).collect();
        self.cables.check_drawn(&self.world, &drawn).map_err(|error| self.explain(scene, 0.0, error))
    }

    /// Moves a cable that is not yet attached to equilibrium, with all bodies held where they are
    /// drawn.
    ///
    /// # Errors
    /// [`Error::Mechanics`] without an equilibrium, [`Error::Body`] for a body that the cable would
    /// run through.
    pub fn equilibrium_among(&mut self, scene: &Scene, cable: &mut Cable) -> Result<EquilibriumReport, Error> {
        let found = self.cables.equilibrium_among(&self.world, cable);
        found.map_err(|error| self.explain(scene, 0.0, error))
    }

    /// Sets cables and bodies that are in equilibrium in motion, as the scene says, and adds the loads that begin with a ramp, unless all
    /// act in full.
    ///
    /// # Errors
    /// [`Error::Mechanics`]; not for a checked scene.
    pub fn set_off(&mut self, scene: &Scene) -> Result<(), Error> {
        for (i, &handle) in self.handles.iter().enumerate() {
            let cable = self.cables.get_mut(handle).map_err(|source| Error::Coupling { time: 0.0, source })?;
            scene.add_wave(cable, i)?;
            scene.set_off(cable, i, !self.script.full_loads)?;
        }
        for (body, &handle) in scene.bodies.iter().zip(&self.bodies) {
            if body.kind == BodyKind::Dynamic
                && (body.course.velocity, body.course.angular_velocity) != Default::default()
            {
                build::set_in_motion(&mut self.world.bodies[handle], body);
            }
        }
        Ok(())
    }

    fn settled(&mut self, scene: &Scene, found: &Equilibrium) -> Result<Settled, Error> {
        for (index, handle) in self.attachments.iter().enumerate() {
            let Some(handle) = *handle else { continue };
            let attachment = self.cables.attachment(handle).map_err(|error| self.explain(scene, 0.0, error))?;
            let AttachmentReading { force, moment, .. } = *attachment.reading();
            self.held_by[index] = (force, moment);
        }
        let named = |handles: &[RigidBodyHandle]| {
            self.bodies.iter().enumerate().filter(|(_, b)| handles.contains(b)).map(|(i, _)| i).collect()
        };
        let report = |handle| found.cables.iter().find(|(cable, _)| cable == handle).map(|(_, report)| *report);
        Ok(Settled {
            cables: self.handles.iter().filter_map(report).collect(),
            moved: named(&found.moved),
            held: named(&found.held),
            unattached: named(&found.unattached),
            relaxation_steps: found.relaxed.map(|relaxed| relaxed.host_steps),
        })
    }
}
