//! Cables tied to each other, as entities.

use crate::pending::Pending;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::world::DeferredWorld;
use lariat_ancf::At;
use lariat_rapier::{Gap, JunctionHandle};
use serde::{Deserialize, Serialize};

/// Ties points of cables to each other: they share one position, like a massless shackle. The cables
/// are untied when this component is removed or its entity is despawned.
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Cable, CableStep, Junction};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let left = world.spawn(Cable::steel_rope(0.012).between([-2.0, 1.0, 0.0], [0.0, 0.0, 0.0])).id();
/// let right = world.spawn(Cable::steel_rope(0.012).between([2.0, 1.0, 0.0], [0.0, 0.0, 0.0])).id();
/// let hanger = world.spawn(Cable::steel_rope(0.012).between([0.0, 0.0, 0.0], [0.0, -2.0, 0.0])).id();
/// world.spawn(Junction::between((left, At::End), (right, At::End)).and((hanger, At::Start)));
/// ```
///
/// The points may be up to 1e-3 m apart, or as far as [`gap`](Self::gap) says. If a junction cannot
/// be made, [`JunctionFailed`](crate::event::JunctionFailed) is sent; it is tried again when the
/// component changes or a cable is spawned. Of a junction whose cable is removed the others stay
/// tied; with one cable left it ends ([`JunctionEnded`](crate::event::JunctionEnded)).
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[component(on_discard = discarded)]
pub struct Junction {
    /// The cables, and their points that are tied.
    pub points: Vec<(Entity, At)>,
    /// What to do if the points are not in one place when they are tied.
    pub gap: Gap,
}

impl Junction {
    /// Ties a point of a cable to a point of another, or of itself.
    pub fn between(first: (Entity, impl Into<At>), second: (Entity, impl Into<At>)) -> Self {
        Junction { points: vec![(first.0, first.1.into()), (second.0, second.1.into())], gap: Gap::default() }
    }

    /// Ties a further point to them.
    pub fn and(mut self, point: (Entity, impl Into<At>)) -> Self {
        self.points.push((point.0, point.1.into()));
        self
    }

    /// Sets what to do if the points are not in one place.
    pub fn gap(mut self, gap: Gap) -> Self {
        self.gap = gap;
        self
    }

    /// Renames entities.
    pub(crate) fn rename(&mut self, name: &(impl Fn(Entity) -> Entity + ?Sized)) {
        self.points.iter_mut().for_each(|(cable, _)| *cable = name(*cable));
    }
}

/// The handle of a junction in the set, while it exists there.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Joined(pub JunctionHandle);

/// Marks a junction that could not be made or ended, until it changes or a cable is spawned.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct NotJoinable;

/// Notes that the junction of a component that is removed or replaced is to be removed from the set.
fn discarded(mut world: DeferredWorld, context: HookContext) {
    let Some(handle) = world.get::<Joined>(context.entity).map(|joined| joined.0) else { return };
    if let Some(mut pending) = world.get_resource_mut::<Pending>() {
        pending.removed_junctions.push(handle);
    }
    if let Ok(mut commands) = world.commands().get_entity(context.entity) {
        commands.try_remove::<Joined>();
    }
}
