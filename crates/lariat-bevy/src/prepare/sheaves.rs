//! Makes the sheaves between two cables that components describe.

use crate::cables::Cables;
use crate::event::SheaveFailed;
use crate::links::SheaveLink;
use crate::pending::Pending;
use crate::sheave::Sheave;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Query, Ref, Res, ResMut};
use bevy_ecs::query::Allow;

/// Makes the sheaves that the components ask for, and ends the others. `pending.new_cables` is still that of the attachments.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    pending: Res<Pending>,
    sheaves: Query<(Entity, Ref<Sheave>), Allow<Disabled>>,
) {
    let Cables { set, links, events, .. } = &mut *cables;
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
                None if !pending.new_cables && !sheave.is_changed() => continue,
                None => {}
            }
        }
        let added = links.handle(sheave.from.0).and_then(|from| {
            let to = links.handle(sheave.to.0)?;
            Ok(set.add_sheave((from, sheave.from.1), (to, sheave.to.1), sheave.options)?)
        });
        let link = SheaveLink { made: *sheave, handle: added.as_ref().ok().copied() };
        links.sheaves.insert(entity, link);
        if let Err(error) = added {
            events.push(SheaveFailed { entity, error }.into());
        }
    }
}

/// Ends the sheaves at ends that nothing holds, with which no cable could step; attachments are made by now.
pub(crate) fn end_unheld(mut cables: ResMut<Cables>) {
    let Cables { set, links, events, .. } = &mut *cables;
    for (entity, link) in &mut links.sheaves {
        let Some((handle, sheave)) = link.handle.and_then(|handle| Some((handle, set.sheave(handle).ok()?))) else {
            continue;
        };
        let unheld = sheave.ends().into_iter().find_map(|(cable, at)| {
            let cable = set.get(cable).ok()?;
            let support = cable.support(at).ok()?;
            (!support.attached && support.position.is_none()).then(|| cable.name().to_string())
        });
        if let Some(cable) = unheld {
            // it was there just now
            let _ = set.remove_sheave(handle);
            link.handle = None;
            let reason = "its end at the sheave is held by nothing: attach both cables there";
            events.push(
                SheaveFailed { entity: *entity, error: lariat_ancf::Error::ReelPlace { cable, reason }.into() }.into(),
            );
        }
    }
}
