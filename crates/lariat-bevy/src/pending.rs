//! Changes to entities that take effect in the next host step.
//!
//! A component hook sees one entity and must not step the physics, so it notes here what the
//! systems of [`prepare`](crate::prepare) then carry out.

use bevy_ecs::entity::Entity;
use bevy_ecs::resource::Resource;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{AttachmentHandle, CableHandle, JunctionHandle};
use std::collections::BTreeSet;

/// Changes that the next host step carries out.
#[derive(Resource, Clone, Debug, Default)]
pub(crate) struct Pending {
    /// Cables whose component was removed or replaced.
    pub removed_cables: Vec<CableHandle>,
    /// Entities whose cable component was removed or replaced while [`Cables`](crate::Cables) was taken
    /// out of the world.
    pub unlinked: Vec<Entity>,
    /// Attachments whose component was removed or replaced.
    pub removed_attachments: Vec<(Entity, AttachmentHandle)>,
    /// Junctions whose component was removed or replaced.
    pub removed_junctions: Vec<JunctionHandle>,
    /// Bodies whose component was removed or replaced.
    pub removed_bodies: Vec<RigidBodyHandle>,
    /// Cables whose effects may differ from their components, in the order of entities.
    pub changed_effects: BTreeSet<Entity>,
    /// Whether a cable was built since attachments were last tried.
    pub new_cables: bool,
}
