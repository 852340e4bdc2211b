//! The mark that a set leaves in its [world](crate::edit::world_mark).

use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// The mark of a set in its world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct WorldMark {
    pub body: RigidBodyHandle,
    pub key: u64,
}

impl WorldMark {
    /// Returns whether a world carries this mark.
    pub fn is_in(&self, world: &PhysicsWorld) -> bool {
        world.bodies.get(self.body).is_some_and(|body| !body.is_enabled() && body.user_data == u128::from(self.key))
    }
}
