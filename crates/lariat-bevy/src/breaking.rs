//! Cables that break where their load is too large, or are cut.

use crate::attachment::{Attachment, OnCable};
use crate::cable::Cable;
use crate::cables::{Cables, Parting};
use crate::components::{CableComponents, put};
use crate::event::{CableBroken, CableFailed};
use crate::interpolate::Interpolate;
use crate::junction::Junction;
use crate::mesh::RopeMesh;
use crate::sheave::Sheave;
use crate::strength::{BreakStrain, BreakTension};
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::{Changed, Or, Query, RemovedComponents, ResMut, With, World};
use bevy_ecs::query::Allow;
use lariat_ancf::{At, Strength};
use lariat_rapier::CableHandle;

/// The limits of a cable.
type Limits = (Option<&'static BreakTension>, Option<&'static BreakStrain>);

/// Query filter: the strength of a cable was added or changed, or the cable was.
type StrengthChanged = Or<(Changed<BreakTension>, Changed<BreakStrain>, Changed<Cable>)>;

/// Tells the set which cables break, and at which load.
pub(crate) fn set_strengths(
    mut cables: ResMut<Cables>,
    limits: Query<Limits, (With<Cable>, Allow<Disabled>)>,
    changed: Query<Entity, (StrengthChanged, Allow<Disabled>)>,
    mut tensions: RemovedComponents<BreakTension>,
    mut strains: RemovedComponents<BreakStrain>,
) {
    for entity in changed.iter().chain(tensions.read()).chain(strains.read()) {
        let (Ok(handle), Ok((tension, strain))) = (cables.handle(entity), limits.get(entity)) else { continue };
        let strength = Strength { tension: tension.map(|t| t.0), strain: strain.map(|s| s.0) };
        if let Err(lariat_rapier::Error::Cable(error)) = cables.set.set_strength(handle, strength) {
            cables.events.push(CableFailed { entity, error }.into());
        }
    }
}

/// Makes an entity of the part behind each break, with the same components.
pub(crate) fn split_entities(world: &mut World) {
    for broken in core::mem::take(&mut world.resource_mut::<Cables>().broken) {
        let Parting { cable, rest: tail, how } = broken;
        let link = world.resource::<Cables>().links.cables.get(&cable).copied();
        let Some(rest) = link.and_then(|link| split_entity(world, link.entity, cable, tail)) else { continue };
        let entity = link.map_or(Entity::PLACEHOLDER, |link| link.entity);
        let event = CableBroken { entity, rest, how };
        world.resource_mut::<Cables>().events.push(event.into());
    }
}

/// Spawns the entity of the part behind a break.
pub(crate) fn split_entity(world: &mut World, entity: Entity, cable: CableHandle, tail: CableHandle) -> Option<Entity> {
    let description = world.get::<Cable>(entity)?.clone();
    let components = CableComponents::of(world.entity(entity));
    let cables = world.resource::<Cables>();
    let (before, behind) = (cables.set.get(cable).ok()?, cables.set.get(tail).ok()?);
    let (length, length_behind) = (before.length(), behind.length());
    let [before, behind] = [before, behind].map(|part| components.of_part(part));
    let rest = world.spawn_empty().id();
    let mut cables = world.resource_mut::<Cables>();
    // linked before its component is inserted, which else would build a new cable
    cables.links.insert_cable(rest, tail, length_behind);
    if let Some(link) = cables.links.cables.get_mut(&cable) {
        link.length = length;
    }
    let moved = move_attachments(&mut cables, tail, length, rest);
    let tied = move_junctions(&mut cables, tail, length, rest);
    let led = move_sheaves(&mut cables, tail, rest);
    before.put(&mut world.entity_mut(entity));
    behind.put(&mut world.entity_mut(rest));
    let name = world.get::<Name>(entity).cloned();
    let drawn = world.get::<Interpolate>(entity).map(|_| Interpolate::default());
    let mesh = world.get::<RopeMesh>(entity).cloned();
    let mut part = world.entity_mut(rest);
    put(&mut part, name);
    put(&mut part, drawn);
    put(&mut part, mesh);
    part.insert(description);
    for (attachment, at) in moved {
        if let Some(mut attachment) = world.get_mut::<Attachment>(attachment) {
            attachment.at = at;
        }
        world.entity_mut(attachment).insert(OnCable(rest));
    }
    for (entity, junction) in tied {
        if let Some(mut component) = world.get_mut::<Junction>(entity) {
            *component = junction;
        }
    }
    for (entity, sheave) in led {
        if let Some(mut component) = world.get_mut::<Sheave>(entity) {
            *component = sheave;
        }
    }
    Some(rest)
}

/// Points the sheaves behind a break to the entity `rest`; returns those that changed, with their components.
fn move_sheaves(cables: &mut Cables, tail: CableHandle, rest: Entity) -> Vec<(Entity, Sheave)> {
    let Cables { set, links, .. } = cables;
    let mut moved = Vec::new();
    for (entity, link) in &mut links.sheaves {
        let Some(Ok(sheave)) = link.handle.map(|handle| set.sheave(handle)) else { continue };
        let before = link.made;
        for (own, (cable, at)) in [&mut link.made.from, &mut link.made.to].into_iter().zip(sheave.ends()) {
            if cable == tail {
                *own = (rest, at);
            }
        }
        if link.made != before {
            moved.push((*entity, link.made));
        }
    }
    moved
}

/// Points the junctions behind a break at `length` (m) to the entity `rest`; returns those that
/// changed, with their components.
fn move_junctions(cables: &mut Cables, tail: CableHandle, length: f64, rest: Entity) -> Vec<(Entity, Junction)> {
    let Cables { set, links, .. } = cables;
    let mut moved = Vec::new();
    for (handle, link) in &mut links.junctions {
        let Ok(junction) = set.junction(*handle) else { continue };
        let before = link.made.clone();
        for (point, (cable, arc_length)) in link.made.points.iter_mut().zip(junction.points()) {
            if cable == tail {
                *point = (rest, moved_point(point.1, length, arc_length));
            }
        }
        if link.made != before {
            moved.push((link.entity, link.made.clone()));
        }
    }
    moved
}

/// Returns a point of a cable as a point of its part behind a break at `length` (m), where it is at
/// `arc_length` (m).
fn moved_point(at: At, length: f64, arc_length: f64) -> At {
    match at {
        At::ArcLength(s) => At::ArcLength(s - length),
        // nodes have other numbers, and the end remains the end
        At::Node(_) => At::ArcLength(arc_length),
        at => at,
    }
}

/// Links the attachments behind a break at `length` (m) to the entity `rest`; returns them with
/// their points on its cable.
fn move_attachments(cables: &mut Cables, tail: CableHandle, length: f64, rest: Entity) -> Vec<(Entity, At)> {
    let Cables { set, links, .. } = cables;
    let mut moved = Vec::new();
    for (handle, link) in &mut links.attachments {
        let Ok(attachment) = set.attachment(*handle) else { continue };
        if attachment.cable() == tail {
            link.cable = rest;
            link.made.at = moved_point(link.made.at, length, attachment.arc_length());
            moved.push((link.entity, link.made.at));
        }
    }
    moved
}
