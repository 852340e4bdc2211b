//! Rapier's world as a resource.

use bevy_ecs::resource::Resource;
use core::ops::{Deref, DerefMut};
use lariat_rapier::rapier::pipeline::PhysicsWorld;

/// Rapier's world. Gravity, the time step of the host (`integration_parameters.dt`, in s) and the
/// solver settings are its own.
#[derive(Resource, Default)]
pub struct Physics(pub PhysicsWorld);

impl Deref for Physics {
    type Target = PhysicsWorld;
    fn deref(&self) -> &PhysicsWorld {
        &self.0
    }
}

impl DerefMut for Physics {
    fn deref_mut(&mut self) -> &mut PhysicsWorld {
        &mut self.0
    }
}
