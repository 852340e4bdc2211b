//! Gives cables the reels that components describe.

use crate::cable::Cable;
use crate::cables::Cables;
use crate::event::CableFailed;
use crate::reel::EndReel;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Changed, Or, Query, RemovedComponents, ResMut, With};
use bevy_ecs::query::Allow;

/// Query filter: the reel of a cable was added or changed, or the cable was.
type ReelChanged<R> = Or<(Changed<R>, Changed<Cable>)>;

/// Gives cables their reels at an end, changes and removes them.
pub(crate) fn update<R: EndReel>(
    mut cables: ResMut<Cables>,
    reels: Query<&R, (With<Cable>, Allow<Disabled>)>,
    changed: Query<Entity, (ReelChanged<R>, Allow<Disabled>)>,
    mut removed: RemovedComponents<R>,
) {
    for entity in changed.iter().chain(removed.read()) {
        let Ok(now) = cables.get(entity).map(|cable| cable.reel_description(R::AT).cloned()) else { continue };
        let wanted = reels.get(entity).ok().map(|reel| reel.description().clone());
        if now == wanted {
            continue;
        }
        let Ok(cable) = cables.get_mut(entity) else { continue };
        let outcome = match (now, wanted) {
            // that of a drum or a sheave
            (Some(now), None) if now.needs_island() => continue,
            (Some(now), Some(reel)) if now.needs_island() => cable.add_reel(R::AT, reel),
            (_, None) => cable.remove_reel(R::AT),
            (None, Some(reel)) => cable.add_reel(R::AT, reel),
            (Some(_), Some(reel)) => cable.set_reel(R::AT, reel),
        };
        if let Err(error) = outcome {
            cables.events.push(CableFailed { entity, error }.into());
        }
    }
}
