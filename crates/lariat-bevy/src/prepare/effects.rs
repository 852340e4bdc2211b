//! Changes of the components that say what a cable does.

use crate::cable::Cable;
use crate::cables::Cables;
use crate::components::{AnyChanged, CableComponents};
use crate::event::CableFailed;
use crate::pending::Pending;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Query, ResMut, With};
use bevy_ecs::query::Allow;
use bevy_ecs::world::World;

/// Notes the cables whose components changed.
pub(crate) fn watch(mut pending: ResMut<Pending>, changed: Query<Entity, (With<Cable>, AnyChanged, Allow<Disabled>)>) {
    pending.changed_effects.extend(&changed);
}

/// Updates these cables where they differ from their components. One whose change is not possible
/// stays as it is.
pub(crate) fn update(world: &mut World) {
    let changed = core::mem::take(&mut world.resource_mut::<Pending>().changed_effects);
    for entity in changed {
        let Some(cable) = world.get::<Cable>(entity) else { continue };
        let cables = world.resource::<Cables>();
        let Ok(handle) = cables.handle(entity) else { continue };
        let (Ok(current), Some(link)) = (cables.set.get(handle), cables.links.cables.get(&handle)) else { continue };
        let updated = CableComponents::of(world.entity(entity)).updated(current, &cable.0, link.length);
        let mut cables = world.resource_mut::<Cables>();
        match updated {
            Ok(None) => {}
            Ok(Some(updated)) => {
                if let Ok(current) = cables.get_mut(entity) {
                    *current = updated;
                }
            }
            Err(error) => cables.events.push(CableFailed { entity, error }.into()),
        }
    }
}
