//! The world of a scene at its start, for a program that steps it itself.

use super::World;
use crate::error::Error;
use crate::physics::{Parts, Physics};
use crate::scene::{Purpose, Scene};

impl Parts {
    /// Builds a scene and brings it to its start, as a run does.
    ///
    /// # Errors
    /// Those of the start of a run, [`Error::Mechanics`] and [`Error::Body`]; [`Error::TimedCut`] for
    /// a cable that the scene cuts at a time, which is for the program that steps.
    pub fn of(scene: &Scene) -> Result<Self, Error> {
        if let Some(cable) = scene.cables.iter().find(|cable| cable.breaking.cut.is_some()) {
            return Err(Error::TimedCut { cable: cable.name.clone() });
        }
        let mut world = World::build(scene)?;
        world.start(Purpose::Run)?;
        let told = world.told();
        let physics = match world.physics.take() {
            Some(physics) => *physics,
            None => Physics::of_cables(scene, world.alone)?,
        };
        Ok(Parts { told, ..physics.into_parts(scene) })
    }
}
