//! Cables that break where their tension is too large.

use crate::attachment::{Attachment, OnCable};
use crate::cable::Cable;
use crate::cables::{Break, Cables};
use crate::components::{CableComponents, put};
use crate::event::CableBroken;
use crate::interpolate::Interpolate;
use crate::junction::Junction;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::{Query, RemovedComponents, ResMut, World};
use bevy_ecs::query::Allow;
use lariat_ancf::At;
use lariat_rapier::CableHandle;

/// The tension in N above which a cable breaks, compared after each host step; without it nothing
/// is compared.
///
/// The cable breaks at the inner node nearest to the largest tension, so that a cable of one
/// element does not break. The part behind the break is a new entity with the same components, and
/// takes the attachments behind the break.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct BreakTension(pub f64);

/// Tells the set which cables break, and at which tension.
pub(crate) fn set_strengths(
    mut cables: ResMut<Cables>,
    limits: Query<(Entity, &BreakTension), Allow<Disabled>>,
    mut removed: RemovedComponents<BreakTension>,
) {
    for entity in removed.read() {
        if let Ok(handle) = cables.handle(entity) {
            // a cable with an entity is in the set
            let _ = cables.set.set_strength(handle, None);
        }
    }
    for (entity, limit) in &limits {
        if let Ok(handle) = cables.handle(entity) {
            let _ = cables.set.set_strength(handle, Some(limit.0));
        }
    }
}

/// Makes an entity of the part behind each break, with the same components.
pub(crate) fn split_entities(world: &mut World) {
    for broken in core::mem::take(&mut world.resource_mut::<Cables>().broken) {
        let Break { cable, rest: tail, arc_length, tension } = broken;
        let link = world.resource::<Cables>().links.cables.get(&cable).copied();
        let Some(rest) = link.and_then(|link| split_entity(world, link.entity, cable, tail)) else { continue };
        let entity = link.map_or(Entity::PLACEHOLDER, |link| link.entity);
        let event = CableBroken { entity, rest, arc_length, tension };
        world.resource_mut::<Cables>().events.push(event.into());
    }
}

/// Spawns the entity of the part behind a break.
fn split_entity(world: &mut World, entity: Entity, cable: CableHandle, tail: CableHandle) -> Option<Entity> {
    let description = world.get::<Cable>(entity)?.clone();
    let components = CableComponents::of(world.entity(entity));
    let cables = world.resource::<Cables>();
    let (before, behind) = (cables.set.get(cable).ok()?, cables.set.get(tail).ok()?);
    let length = before.length();
    let [before, behind] = [before, behind].map(|part| components.of_part(part));
    let rest = world.spawn_empty().id();
    let mut cables = world.resource_mut::<Cables>();
    // linked before its component is inserted, which else would build a new cable
    cables.links.insert_cable(rest, tail);
    let moved = move_attachments(&mut cables, tail, length, rest);
    let tied = move_junctions(&mut cables, tail, length, rest);
    before.put(&mut world.entity_mut(entity));
    behind.put(&mut world.entity_mut(rest));
    let (limit, name) = (world.get::<BreakTension>(entity).copied(), world.get::<Name>(entity).cloned());
    let drawn = world.get::<Interpolate>(entity).map(|_| Interpolate::default());
    let mut part = world.entity_mut(rest);
    put(&mut part, limit);
    put(&mut part, name);
    put(&mut part, drawn);
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
    Some(rest)
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
