//! Changes to entities that take effect in the next host step.
//!
//! A component hook sees one entity and must not step the physics, so it notes here what the
//! systems of [`prepare`](crate::prepare) then carry out.

use crate::snapshot::{PutBack, Watched};
use bevy_ecs::change_detection::{DetectChanges, Ref, Tick};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::resource::Resource;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{AttachmentHandle, CableHandle, JunctionHandle};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Changes that the next host step carries out.
#[derive(Resource, Clone, Debug, Default, Serialize, Deserialize)]
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
    /// When the last host step was prepared: a later change was seen by no host step yet.
    #[serde(skip)]
    pub prepared: Tick,
    /// Changes since then that are none.
    #[serde(skip)]
    pub put_back: PutBack,
}

impl Pending {
    /// Whether a component that changed at a moment was not seen since.
    pub fn is_new(&self, entity: Entity, component: Watched, changed: Tick, now: Tick) -> bool {
        changed.is_newer_than(self.prepared, now) && !self.put_back.explains(entity, component, changed)
    }

    /// Whether a component has changed for the system that asks, and not by a snapshot that put it back.
    pub fn has_changed<C: Component>(&self, entity: Entity, component: Watched, own: &Ref<C>) -> bool {
        own.is_changed() && !self.put_back.explains(entity, component, own.last_changed())
    }

    /// Renames entities.
    pub fn renamed(&self, name: &(impl Fn(Entity) -> Entity + ?Sized)) -> Pending {
        let mut pending = self.clone();
        pending.unlinked.iter_mut().for_each(|entity| *entity = name(*entity));
        pending.removed_attachments.iter_mut().for_each(|(entity, _)| *entity = name(*entity));
        pending
    }
}
