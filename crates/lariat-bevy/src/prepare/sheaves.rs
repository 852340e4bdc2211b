//! Makes the sheaves between two cables that components describe.

use crate::cables::Cables;
use crate::error::Error;
use crate::event::SheaveFailed;
use crate::links::SheaveLink;
use crate::pending::Pending;
use crate::sheave::Sheave;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Query, Ref, ResMut};
use bevy_ecs::query::Allow;
use lariat_ancf::At;
use lariat_rapier::{CableHandle, CableSet};

/// Makes the sheaves that the components ask for, and ends the others; attachments are made by now,
/// and have read `pending.new_cables`.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    mut pending: ResMut<Pending>,
    sheaves: Query<(Entity, Ref<Sheave>), Allow<Disabled>>,
) {
    let Cables { set, links, events, .. } = &mut *cables;
    let new_cables = core::mem::take(&mut pending.new_cables);
    links.sheaves.retain(|entity, link| {
        let stays = sheaves.get(*entity).is_ok_and(|(_, sheave)| *sheave == link.made);
        if let Some(handle) = link.handle.filter(|_| !stays) {
            // one that has ended already is what is wanted
            let _ = set.remove_sheave(handle);
        }
        stays
    });
    for (entity, sheave) in &sheaves {
        if let Some(link) = links.sheaves.get_mut(&entity) {
            match link.handle.map(|handle| set.sheave(handle)) {
                Some(Ok(_)) => continue,
                Some(Err(error)) => {
                    link.handle = None;
                    events.push(SheaveFailed { entity, error: error.into() }.into());
                    continue;
                }
                None if !new_cables && !sheave.is_changed() => continue,
                None => {}
            }
        }
        let added = links.handle(sheave.from.0).and_then(|from| {
            let to = links.handle(sheave.to.0)?;
            check_held(set, [(from, sheave.from.1), (to, sheave.to.1)])?;
            Ok(set.add_sheave((from, sheave.from.1), (to, sheave.to.1), sheave.options)?)
        });
        let link = SheaveLink { made: *sheave, handle: added.as_ref().ok().copied() };
        links.sheaves.insert(entity, link);
        if let Err(error) = added {
            events.push(SheaveFailed { entity, error }.into());
        }
    }
}

/// Refuses ends that nothing holds: no cable could step with a sheave there.
fn check_held(set: &CableSet, ends: [(CableHandle, At); 2]) -> Result<(), Error> {
    for (cable, at) in ends {
        let cable = set.get(cable)?;
        let support = cable.support(at)?;
        if !support.attached && support.position.is_none() {
            let reason = "its end at the sheave is held by nothing: attach both cables there";
            return Err(lariat_ancf::Error::ReelPlace { cable: cable.name().to_string(), reason }.into());
        }
    }
    Ok(())
}
