//! Cables that break where their tension is too large.

use crate::attachment::{Attachment, OnCable};
use crate::cable::Cable;
use crate::cables::Cables;
use crate::components::{CableComponents, put};
use crate::event::CableBroken;
use crate::interpolate::Interpolate;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::{DetectChanges, QueryState, Ref, World};
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

/// Breaks the cables whose tension exceeds their limit.
pub(crate) fn break_cables(world: &mut World, limits: &mut QueryState<(Entity, Ref<BreakTension>)>) {
    let cables = world.resource::<Cables>();
    let peak = |(entity, limit): (Entity, Ref<BreakTension>)| {
        // the tension of a sleeping cable does not change, but its limit may
        let cable = cables.get(entity).ok().filter(|_| limit.is_changed() || !cables.is_asleep(entity))?;
        let (arc_length, tension) = cable.peak_tension();
        (tension > limit.0).then_some((entity, arc_length, tension))
    };
    let overloaded: Vec<(Entity, f64, f64)> = limits.iter(world).filter_map(peak).collect();
    for (entity, peak, tension) in overloaded {
        if let Some((rest, arc_length)) = break_cable(world, entity, peak) {
            let event = CableBroken { entity, rest, arc_length, tension };
            world.resource_mut::<Cables>().events.push(event.into());
        }
    }
}

/// Breaks a cable near an arc length; returns the entity of the part behind the break, and the arc
/// length of the break (m).
fn break_cable(world: &mut World, entity: Entity, arc_length: f64) -> Option<(Entity, f64)> {
    let description = world.get::<Cable>(entity)?.clone();
    let components = CableComponents::of(world.entity(entity));
    let mut cables = world.resource_mut::<Cables>();
    let handle = cables.handle(entity).ok()?;
    let at = inner_node(cables.get(entity).ok()?, arc_length)?;
    let tail = cables.set.cut(handle, at).ok()?;
    let (before, behind) = (cables.set.get(handle).ok()?, cables.set.get(tail).ok()?);
    let length = before.length();
    let [before, behind] = [before, behind].map(|part| components.of_part(part));
    let rest = world.spawn_empty().id();
    let mut cables = world.resource_mut::<Cables>();
    // linked before its component is inserted, which else would build a new cable
    cables.links.insert_cable(rest, tail);
    let moved = move_attachments(&mut cables, tail, length, rest);
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
    Some((rest, length))
}

/// Returns the inner node that is nearest to an arc length (m); a cable of one element has none.
fn inner_node(cable: &lariat_ancf::Cable, arc_length: f64) -> Option<At> {
    let nodes = cable.node_arc_lengths();
    let inner = &nodes[1..nodes.len() - 1];
    let distance = |node: &f64| (node - arc_length).abs();
    inner.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).map(At::ArcLength)
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
            link.made.at = match link.made.at {
                At::ArcLength(s) => At::ArcLength(s - length),
                // nodes have other numbers, and the end remains the end
                At::Node(_) => At::ArcLength(attachment.arc_length()),
                at => at,
            };
            moved.push((link.entity, link.made.at));
        }
    }
    moved
}
