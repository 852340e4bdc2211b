//! Static equilibrium of the bodies of a scene and the cables attached to them.

use super::{Physics, reading};
use crate::error::Error;
use crate::scene::Scene;
use lariat_ancf::{Cable, EquilibriumReport};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{AttachmentReading, Equilibrium};
use nalgebra::UnitQuaternion;

/// Number of times that loads which act at a point of a body are applied anew to the body in its new attitude.
const MAX_ROUNDS: usize = 100;
/// Rotation in rad that does not change a load, in Rapier's single precision.
const SAME_ATTITUDE: f64 = 1e-6;

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
}

impl Physics {
    /// Moves cables and dynamic bodies to equilibrium, with the loads on bodies in full.
    ///
    /// # Errors
    /// [`Error::Mechanics`] without an equilibrium, [`Error::Body`] for a body with a joint or a contact.
    pub fn settle(&mut self, scene: &Scene) -> Result<Settled, Error> {
        let attitudes = |this: &Self| -> Vec<UnitQuaternion<f64>> {
            scene
                .body_loads
                .iter()
                .map(|load| reading::state(&this.world.bodies[this.bodies[load.body]]).rotation)
                .collect()
        };
        for _ in 0..MAX_ROUNDS {
            let before = attitudes(self);
            self.load(scene, f64::MAX, f64::MAX);
            let found = self.cables.equilibrium(&mut self.world).map_err(|error| self.explain(scene, 0.0, error))?;
            if before.iter().zip(&attitudes(self)).all(|(a, b)| a.angle_to(b) <= SAME_ATTITUDE) {
                return self.settled(scene, &found);
            }
        }
        let body = scene.body_loads.first().map_or(String::new(), |load| scene.bodies[load.body].name.clone());
        let problem = "its loads turn with it, and no equilibrium was found".to_string();
        Err(Error::Body { time: 0.0, body, problem })
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
        })
    }
}
