//! Makes the sheaves along a cable that components ask for, and the entities of its parts and attachments.

use super::attachments::ground;
use super::has_cable_changed;
use crate::attachment::{Attached, Attachment, OnCable, ToBody};
use crate::body::BodyHandle;
use crate::breaking::split_entity;
use crate::cables::Cables;
use crate::error::Error;
use crate::event::SheaveFailed;
use crate::links::{AttachmentLink, SheaveLink};
use crate::passing::SheaveAlong;
use crate::physics::Physics;
use crate::sheave::Sheave;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Ref, World};
use bevy_ecs::query::{Allow, QueryState};
use bevy_ecs::world::Mut;
use lariat_ancf::At;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::math::{Real, Vector};
use lariat_rapier::{AttachmentKind, CableHandle, Gap, SheaveHandle};

/// Makes the sheaves that were asked for. Attachments to the ends of their cables are there already.
pub(crate) fn update(world: &mut World, asked: &mut QueryState<(Entity, Ref<SheaveAlong>), Allow<Disabled>>) {
    let asked: Vec<_> = asked.iter(world).map(|(entity, sheave)| (entity, *sheave, sheave.is_changed())).collect();
    for (entity, sheave, is_changed) in asked {
        let body = |body: Entity| {
            world.get_entity(body).is_ok_and(|body| body.get_ref::<BodyHandle>().is_some_and(|own| own.is_changed()))
        };
        if (is_changed || has_cable_changed(world, sheave.cable.0) || sheave.body.is_some_and(body))
            && let Err(error) = make(world, entity, sheave)
        {
            world.resource_mut::<Cables>().events.push(SheaveFailed { entity, error }.into());
        }
    }
}

/// Makes a sheave, and the entities of its part and its attachments.
fn make(world: &mut World, entity: Entity, sheave: SheaveAlong) -> Result<(), Error> {
    let body = match sheave.body {
        None => None,
        Some(body) => {
            let handle = world.get::<BodyHandle>(body).map(|body| body.handle);
            Some((body, handle.ok_or(Error::NotABody(body))?))
        }
    };
    let (cable, rest, made, rigid) = world.resource_scope(|world, mut cables: Mut<Cables>| {
        let mut physics = world.resource_mut::<Physics>();
        let whole = cables.handle(sheave.cable.0)?;
        let rigid = body.map_or_else(|| ground(&mut cables, &mut physics), |(_, handle)| handle);
        let anchor: [f64; 3] = sheave.anchor.into();
        let eye = (rigid, Vector::from(anchor.map(|x| x as Real)));
        let made = cables.set.add_sheave_at(&physics, (whole, sheave.cable.1), eye, sheave.options)?;
        let [(cable, _), (rest, _)] = cables.set.sheave(made)?.ends();
        Ok::<_, Error>((cable, rest, made, rigid))
    })?;
    let owner = world.resource::<Cables>().links.cables.get(&cable).map(|link| link.entity);
    let before = owner.ok_or(Error::NotACable(sheave.cable.0))?;
    let behind = split_entity(world, before, cable, rest).ok_or(Error::NotACable(before))?;
    hold(world, (before, cable, At::End), sheave, rigid);
    hold(world, (behind, rest, At::Start), sheave, rigid);
    link(world, entity, [before, behind], sheave, made);
    Ok(())
}

/// Spawns the entity of the attachment of a part at a sheave.
fn hold(world: &mut World, (part, handle, at): (Entity, CableHandle, At), sheave: SheaveAlong, rigid: RigidBodyHandle) {
    let made = Attachment {
        at,
        kind: AttachmentKind::Ball,
        anchor: Some(sheave.anchor),
        world: sheave.body.is_none(),
        gap: Gap::Close,
        direction: None,
    };
    let cables = world.resource::<Cables>();
    let node = cables.set.get(handle).map_or(0, |cable| if at == At::End { cable.nodes() - 1 } else { 0 });
    let own = cables.set.attachments().find(|(_, own)| own.cable() == handle && own.node() == node);
    let Some(attachment) = own.map(|(attachment, _)| attachment) else { return };
    let mut spawned = world.spawn((made, OnCable(part)));
    if let Some(body) = sheave.body {
        spawned.insert(ToBody(body));
    }
    let entity = spawned.insert(Attached(attachment)).id();
    let link = AttachmentLink { entity, cable: part, body: sheave.body, handle: rigid, made, counted: 0.0 };
    world.resource_mut::<Cables>().links.attachments.insert(attachment, link);
}

/// Makes an entity that asked for a sheave the sheave.
fn link(world: &mut World, entity: Entity, [before, behind]: [Entity; 2], sheave: SheaveAlong, handle: SheaveHandle) {
    let made = Sheave::between((before, At::End), (behind, At::Start)).with_options(sheave.options);
    world.resource_mut::<Cables>().links.sheaves.insert(entity, SheaveLink { made, handle: Some(handle) });
    world.entity_mut(entity).remove::<SheaveAlong>().insert(made);
}
