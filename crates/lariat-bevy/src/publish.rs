//! The stage after a host step: readings, poses, counters and events.

use crate::attachment::{Attached, AttachmentReading, BreakForce};
use crate::body::{BodyHandle, BodyPose};
use crate::cables::{Cables, Parting};
use crate::diagnostics::{Diagnostics, Stage};
use crate::event::{
    AttachmentEnded, CableAsleep, CableAwake, CableDegraded, CableWarning, ContactEnded, ContactIgnored,
    ContactStarted, EndReason, GapOpened, MechanismUnsettled, QueuedEvent,
};
use crate::physics::Physics;
use bevy_ecs::prelude::{DetectChangesMut, Query, Res, ResMut};
use bevy_ecs::world::World;
use lariat_rapier::Event;

/// Translates the events of the set.
pub(crate) fn read_events(mut cables: ResMut<Cables>, physics: Res<Physics>) {
    let Cables { set, links, events, broken, .. } = &mut *cables;
    let parent = |collider| physics.colliders.get(collider).and_then(|c| links.bodies.get(&c.parent()?).copied());
    let entity_of = |cable| links.cables.get(&cable).map(|link| link.entity);
    for event in set.take_events() {
        let translated: Option<QueuedEvent> = match event {
            Event::Asleep(cable) => entity_of(cable).map(|entity| CableAsleep { entity }.into()),
            Event::Awake(cable) => entity_of(cable).map(|entity| CableAwake { entity }.into()),
            Event::Degraded { cable, iterations } => {
                entity_of(cable).map(|entity| CableDegraded { entity, iterations }.into())
            }
            Event::AttachmentEnded { attachment, .. } => links.attachments.remove(&attachment).map(|link| {
                let (entity, cable, body) = (link.entity, link.cable, link.body);
                AttachmentEnded { entity, cable, body, reason: EndReason::BodyGone }.into()
            }),
            Event::GapOpened { attachment, gap } => links
                .attachments
                .get(&attachment)
                .map(|link| GapOpened { entity: link.entity, cable: link.cable, body: link.body, gap: gap.gap }.into()),
            Event::Unsettled { attachment, how } => links
                .attachments
                .get(&attachment)
                .map(|link| MechanismUnsettled { entity: link.entity, cable: link.cable, body: link.body, how }.into()),
            Event::Broken { cable, rest, how } => {
                broken.push(Parting { cable, rest, how });
                None
            }
            Event::ContactStarted { cable, collider, arc_length, force } => entity_of(cable)
                .map(|entity| ContactStarted { entity, body: parent(collider), collider, arc_length, force }.into()),
            Event::ContactEnded { cable, collider, arc_length } => entity_of(cable)
                .map(|entity| ContactEnded { entity, body: parent(collider), collider, arc_length }.into()),
            Event::ContactIgnored { cable, collider } => {
                entity_of(cable).map(|entity| ContactIgnored { entity, body: parent(collider), collider }.into())
            }
            Event::Warning { cable, warning } => entity_of(cable).map(|entity| CableWarning { entity, warning }.into()),
            _ => None,
        };
        events.extend(translated);
    }
}

/// Reads the attachments, and ends those whose force exceeds their limit.
pub(crate) fn read_attachments(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut readings: Query<(&mut AttachmentReading, Option<&BreakForce>)>,
    mut diagnostics: ResMut<Diagnostics>,
) {
    diagnostics.start();
    let mut broken = Vec::new();
    let Cables { set, links, events, .. } = &mut *cables;
    for (handle, link) in &mut links.attachments {
        let (Ok(attachment), Ok((mut reading, limit))) = (set.attachment(*handle), readings.get_mut(link.entity))
        else {
            continue;
        };
        let now = *attachment.reading();
        diagnostics.interface_work += now.work - link.counted;
        link.counted = now.work;
        reading.set_if_neq(AttachmentReading(now));
        if limit.is_some_and(|limit| now.force.norm() > limit.0) {
            broken.push(*handle);
        }
    }
    for handle in broken {
        let Some(link) = links.attachments.remove(&handle) else { continue };
        // it was read above, so it exists
        let _ = set.detach(&mut physics, handle);
        let (entity, cable, body) = (link.entity, link.cable, link.body);
        events.push(AttachmentEnded { entity, cable, body, reason: EndReason::Broken }.into());
    }
    diagnostics.stop(Stage::Publish);
}

/// Adds up the counters of cables.
pub(crate) fn count(mut cables: ResMut<Cables>, mut diagnostics: ResMut<Diagnostics>) {
    let Cables { set, links, .. } = &mut *cables;
    for (handle, link) in &mut links.cables {
        let Ok(cable) = set.get(*handle) else { continue };
        let now = *cable.diagnostics();
        let done = now.since(&link.counted);
        if done != lariat_ancf::Diagnostics::default() {
            diagnostics.count(cable.rule(), &done);
            link.counted = now;
        }
    }
}

/// Reads the poses of bodies.
pub(crate) fn read_bodies(physics: Res<Physics>, mut poses: Query<(&BodyHandle, &mut BodyPose)>) {
    for (body, mut pose) in &mut poses {
        let Some(rigid) = physics.bodies.get(body.handle) else { continue };
        let mut now = *pose;
        now.read(rigid, false);
        pose.set_if_neq(now);
    }
}

/// Sends events; attachments that ended are despawned after theirs, unless the user released them.
pub(crate) fn send(world: &mut World) {
    let events = core::mem::take(&mut world.resource_mut::<Cables>().events);
    for event in events {
        let ended = match &event {
            QueuedEvent::AttachmentEnded(event) => Some((event.entity, event.reason)),
            _ => None,
        };
        event.send(world);
        if let Some((entity, reason)) = ended
            && let Ok(mut entity) = world.get_entity_mut(entity)
        {
            entity.remove::<Attached>();
            if reason != EndReason::Released {
                entity.despawn();
            }
        }
    }
}
