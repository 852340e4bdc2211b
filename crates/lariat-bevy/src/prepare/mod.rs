//! The stage before a host step: applies to the set and to Rapier's world what was spawned, changed
//! or removed since the last one.

pub(crate) mod attachments;
pub(crate) mod bodies;
pub(crate) mod drums;
pub(crate) mod effects;
pub(crate) mod junctions;
pub(crate) mod kinks;
pub(crate) mod passing;
pub(crate) mod reels;
pub(crate) mod removals;
pub(crate) mod sheaves;
pub(crate) mod water;

use crate::cable::{Cable, build};
use crate::cables::Cables;
use crate::diagnostics::{Diagnostics, Stage};
use crate::interpolate::Interpolate;
use crate::pending::Pending;
use crate::snapshot::{PutBack, Watched};
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Changed, Commands, Query, Res, ResMut, World};
use bevy_ecs::query::Allow;
use bevy_ecs::system::SystemChangeTick;

/// Returns whether the description of a cable changed since this was asked last.
fn has_cable_changed(world: &World, entity: Entity) -> bool {
    let own = world.get_entity(entity).ok().and_then(|cable| cable.get_ref::<Cable>());
    own.is_some_and(|own| world.resource::<Pending>().has_changed(entity, Watched::Cable, &own))
}

/// Starts the clock of the stage.
pub(crate) fn begin(mut diagnostics: ResMut<Diagnostics>) {
    diagnostics.start();
}

/// Stops the clock of the stage; what changed until now was seen.
pub(crate) fn end(mut diagnostics: ResMut<Diagnostics>, mut pending: ResMut<Pending>, ticks: SystemChangeTick) {
    diagnostics.stop(Stage::Prepare);
    (pending.prepared, pending.put_back) = (ticks.this_run(), PutBack::default());
}

/// Builds the cables that were spawned before [`install`](crate::install), or while [`Cables`] was
/// taken out of the world.
pub(crate) fn build_cables(
    new: Query<Entity, (Changed<Cable>, Allow<Disabled>)>,
    cables: Res<Cables>,
    mut commands: Commands,
) {
    for entity in new.iter().filter(|entity| !cables.links.built.contains_key(entity)) {
        commands.queue(move |world: &mut World| build(world.into(), entity));
    }
}

/// Copies the coordinates of cables that are drawn between host steps.
pub(crate) fn copy_coordinates(cables: Res<Cables>, mut drawn: Query<(Entity, &mut Interpolate)>) {
    for (entity, mut interpolate) in &mut drawn {
        if let Ok(cable) = cables.get(entity) {
            interpolate.copy(cable);
        }
    }
}
