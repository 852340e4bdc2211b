//! The bodies of a scene that are in water, in a run and in statics.

use super::Physics;
use crate::error::Error;
use crate::scene::Scene;
use lariat_rapier::convert::to_vector;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::prelude::PhysicsWorld;
use lariat_rapier::water::{BodiesInWater, Immersed};
use lariat_rapier::{BodyForce, Equilibrium};

/// Rounds of statics in which the forces of water and the places of bodies are to agree.
const ROUNDS: usize = 20;
/// Change of a force of water, over the weight of the displaced water and the force, at which they do.
const AGREE: f64 = 1e-6;

/// Puts the bodies of a scene into its water; `None` if none is in it.
///
/// # Errors
/// [`Error::Body`] for a shape that encloses no volume.
pub(super) fn fill(
    world: &mut PhysicsWorld,
    scene: &Scene,
    bodies: &[RigidBodyHandle],
) -> Result<Option<BodiesInWater>, Error> {
    let Some(water) = &scene.water else { return Ok(None) };
    let mut filled = BodiesInWater::new(water.clone()).map_err(|source| Error::Coupling { time: 0.0, source })?;
    for (body, &handle) in scene.bodies.iter().zip(bodies) {
        let Some(own) = body.water else { continue };
        let mut immersed = Immersed::default().with_added_mass(own.added_mass);
        (immersed.volume, immersed.drag_area, immersed.spin_drag) = (own.volume, own.drag_area, own.rotational_drag);
        filled.insert(world, handle, immersed).map_err(|error| Error::Body {
            time: 0.0,
            body: body.name.clone(),
            problem: error.to_string(),
        })?;
    }
    Ok((!filled.is_empty()).then_some(filled))
}

impl Physics {
    /// Moves cables and bodies to equilibrium under loads and under the forces of water, which depend on where the bodies are: anew, until
    /// they agree.
    ///
    /// # Errors
    /// As [`settle`](Self::settle); [`Error::Body`] for a body at the surface, whose height statics do not find.
    pub(super) fn equilibrium_in_water(&mut self, scene: &Scene, loads: Vec<BodyForce>) -> Result<Equilibrium, Error> {
        let count = loads.len();
        let mut forces = loads;
        self.add_water(scene, &mut forces)?;
        for _ in 0..ROUNDS {
            let found = self.cables.equilibrium_under(&mut self.world, &forces);
            let found = found.map_err(|error| self.explain(scene, 0.0, error))?;
            let before = forces.split_off(count);
            self.add_water(scene, &mut forces)?;
            let agrees = |(a, b): (&BodyForce, &BodyForce)| {
                (a.force - b.force).norm() <= AGREE * (a.force.norm() + b.force.norm())
            };
            if before.iter().zip(&forces[count..]).all(agrees) {
                return Ok(found);
            }
        }
        let body =
            scene.bodies.iter().find(|body| body.water.is_some()).map_or(String::new(), |body| body.name.clone());
        let problem =
            format!("statics do not find where it is at rest in the current, in {ROUNDS} rounds: run it to rest");
        Err(Error::Body { time: 0.0, body, problem })
    }

    /// Adds the forces of water at rest on the bodies that cables carry.
    fn add_water(&self, scene: &Scene, forces: &mut Vec<BodyForce>) -> Result<(), Error> {
        let Some(water) = self.cables.water() else { return Ok(()) };
        for (index, body) in scene.bodies.iter().enumerate() {
            let handle = self.bodies[index];
            let carried = scene.attachments.iter().any(|attachment| attachment.body == Some(index));
            let (Some(own), Some((_, added))) =
                (water.at_rest(&self.world, handle, 0.0), water.volume_and_added_mass(handle))
            else {
                continue;
            };
            if carried && own.wet > 0.0 && own.wet < 1.0 {
                let problem = "it floats at the surface, and statics do not find its height: start it as drawn, and let it come to rest";
                return Err(Error::Body { time: 0.0, body: body.name.clone(), problem: problem.to_string() });
            }
            let centre = self.world.bodies[handle].local_center_of_mass();
            let mut add = |point, force| forces.push(BodyForce { body: handle, point, force });
            add(to_vector(&own.pressure_point), own.pressure);
            add(to_vector(&own.drag_point), own.drag);
            add(centre, -scene.gravity * added);
        }
        Ok(())
    }
}
