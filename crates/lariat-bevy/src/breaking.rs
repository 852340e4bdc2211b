//! Cables that part where they are pulled too hard.

use crate::attachment::{Attachment, OnCable};
use crate::cable::{Cable, State};
use crate::effects::{Bending, Buoyancy, Damping, Drag, GravityScale, LineLoads, PointLoads, RestShape, Rule};
use crate::event::{CableBroken, Notice};
use crate::interpolate::Interpolate;
use crate::world::{Cables, bring_home, lend_out, with_cables};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::World;
use lariat_ancf::At;
use lariat_rapier::CableHandle;

/// The tension in N at which a cable parts, read after each host step; absent, nothing is read. The cable parts at the node that is nearest to
/// the largest tension, but not at an end, so a single element does not part: the rest is a new entity with the same components, and takes the attachments beyond.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct BreakTension(pub f64);

/// Parts the cables whose tension is beyond their limit.
pub(crate) fn part(world: &mut World) {
    let mut of = world.query::<(Entity, &Cable, &BreakTension)>();
    let overloaded: Vec<(Entity, f64, f64)> = of
        .iter(world)
        .filter_map(|(entity, cable, limit)| {
            let (s, tension) = cable.core().ok().filter(|_| !cable.is_asleep())?.peak_tension();
            (tension > limit.0).then_some((entity, s, tension))
        })
        .collect();
    for (entity, s, tension) in overloaded {
        if let Some((rest, arc_length)) = part_one(world, entity, s) {
            let event = CableBroken { entity, rest, arc_length, tension };
            world.resource_mut::<Cables>().notices.push(Notice::Broken(event));
        }
    }
}

/// Where a cable parts: at the inner node that is nearest to `s`; one element does not part.
fn place(cable: &lariat_ancf::Cable, s: f64) -> Option<At> {
    let nodes = cable.node_arc_lengths();
    let inner = &nodes[1..nodes.len() - 1];
    let nearest = inner.iter().copied().min_by(|a, b| (a - s).abs().total_cmp(&(b - s).abs()));
    nearest.map(At::ArcLength)
}

fn part_one(world: &mut World, entity: Entity, s: f64) -> Option<(Entity, f64)> {
    let cable = world.get::<Cable>(entity)?;
    let State::Lent(lent) = &cable.state else { return None };
    let (handle, at, plan) = (lent.handle(), place(lent, s)?, cable.plan.clone());
    let drawn = world.get::<Interpolate>(entity).is_some();
    let rest = world.entity_mut(entity).clone_and_spawn_with_opt_in(|clone| {
        clone.allow::<(Rule, Bending, Damping, Drag, Buoyancy, GravityScale, BreakTension, Name)>();
    });
    let cut = with_set(world, |cables| {
        let tail = cables.set.cut(handle, at).ok()?;
        cables.links.cables.insert(tail, rest);
        let length = cables.set.get(handle).ok()?.length();
        Some((length, parts(cables, handle)?, parts(cables, tail)?, move_attachments(cables, tail, length, rest)))
    });
    let Some((length, kept, beyond, moved)) = cut else {
        world.despawn(rest);
        return None;
    };
    world.entity_mut(rest).insert(Cable { plan, state: State::Away, counted: Default::default() });
    if drawn {
        world.entity_mut(rest).insert(Interpolate::default());
    }
    // components say what either part does
    if world.get::<PointLoads>(entity).is_some() {
        world.entity_mut(entity).insert(kept.0);
        world.entity_mut(rest).insert(beyond.0);
    }
    if world.get::<LineLoads>(entity).is_some() {
        world.entity_mut(entity).insert(kept.1);
        world.entity_mut(rest).insert(beyond.1);
    }
    if let Some(shape) = beyond.2 {
        world.entity_mut(rest).insert(shape);
    }
    for (attachment, at) in moved {
        if let Some(mut held) = world.get_mut::<Attachment>(attachment) {
            held.at = at;
        }
        world.entity_mut(attachment).insert(OnCable(rest));
    }
    with_set(world, |_| Some(()));
    Some((rest, length))
}

/// Loads and rest shape of a part, as components.
fn parts(cables: &Cables, handle: CableHandle) -> Option<(PointLoads, LineLoads, Option<RestShape>)> {
    let cable = cables.set.get(handle).ok()?;
    let effects = cable.effects();
    let shape = effects.rest_shape.clone().map(RestShape);
    Some((PointLoads(cable.loads().to_vec()), LineLoads(effects.line_loads.clone().unwrap_or_default().0), shape))
}

/// Attachments beyond the cut, at `length` (m), are the rest's from now on; where they hold it.
fn move_attachments(cables: &mut Cables, tail: CableHandle, length: f64, rest: Entity) -> Vec<(Entity, At)> {
    let Cables { set, links, .. } = cables;
    let mut moved = Vec::new();
    for (attachment, bound) in &mut links.attachments {
        if set.attachment(*attachment).is_ok_and(|a| a.cable() == tail) {
            bound.cable = rest;
            bound.made.at = match bound.made.at {
                At::ArcLength(s) => At::ArcLength(s - length),
                // nodes have other numbers, and the end stays the end
                At::Node(_) => set.attachment(*attachment).map_or(At::End, |a| At::ArcLength(a.arc_length())),
                at => at,
            };
            moved.push((bound.entity, bound.made.at));
        }
    }
    moved
}

/// Runs `action` while the set has all its cables.
fn with_set<T>(world: &mut World, action: impl FnOnce(&mut Cables) -> Option<T>) -> Option<T> {
    with_cables(world, |cables, of| {
        bring_home(cables, of);
        let outcome = action(cables);
        lend_out(cables, of);
        outcome
    })
}
