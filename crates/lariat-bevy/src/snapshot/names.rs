//! The names that entities of a snapshot have in the world where it is restored.

use bevy_ecs::entity::Entity;
use bevy_ecs::world::World;
use core::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// New names of entities; the others keep theirs.
#[derive(Default)]
pub(super) struct Names {
    /// Those that were spawned, from old to new.
    pub spawned: BTreeMap<Entity, Entity>,
    /// Those that the snapshot does not hold, each with the number of an entity that does not exist.
    lost: BTreeMap<Entity, Entity>,
}

impl Names {
    /// Returns the name of an entity.
    pub fn of(&self, entity: Entity) -> Entity {
        self.spawned.get(&entity).or_else(|| self.lost.get(&entity)).copied().unwrap_or(entity)
    }

    /// Renames those that were not spawned, so that their numbers are not those of other entities.
    pub fn lose(&mut self, mentioned: BTreeSet<Entity>, world: &mut World) {
        for entity in mentioned {
            if entity != Entity::PLACEHOLDER && !self.spawned.contains_key(&entity) {
                let gone = world.spawn_empty().id();
                world.despawn(gone);
                self.lost.insert(entity, gone);
            }
        }
    }
}

/// Returns the entities that a renaming asks for.
pub(super) fn mentioned(rename: impl FnOnce(&dyn Fn(Entity) -> Entity)) -> BTreeSet<Entity> {
    let seen = RefCell::new(BTreeSet::new());
    rename(&|entity| {
        seen.borrow_mut().insert(entity);
        entity
    });
    seen.into_inner()
}
