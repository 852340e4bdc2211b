//! The bodies of a scene that are in water.

use crate::error::Error;
use crate::scene::Scene;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::prelude::PhysicsWorld;
use lariat_rapier::water::{BodiesInWater, Immersed};

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
        let mut immersed = Immersed::default().with_added_mass_along(own.added_mass);
        (immersed.volume, immersed.drag_area, immersed.spin_drag) = (own.volume, own.drag_area, own.rotational_drag);
        filled.insert(world, handle, immersed).map_err(|error| Error::Body {
            time: 0.0,
            body: body.name.clone(),
            problem: error.to_string(),
        })?;
    }
    Ok((!filled.is_empty()).then_some(filled))
}
