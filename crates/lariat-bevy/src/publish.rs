//! After a host step: readings, poses, counts, and events.

use crate::attachment::{AttachmentReading, BreakForce, Holds};
use crate::body::{BodyHandle, BodyPose};
use crate::diagnostics::{Diagnostics, Stage};
use crate::event::{AttachmentEnded, CableAsleep, CableAwake, End, Notice};
use crate::world::{AllCables, Cables, Physics, bring_home, lend_out};
use bevy_ecs::prelude::{DetectChangesMut, Query, Res, ResMut};
use bevy_ecs::world::World;
use lariat_rapier::Event;
use std::time::Instant;

/// What passed through attachments; those that were pulled too hard break.
pub(crate) fn read_attachments(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut of: AllCables,
    mut readings: Query<(&mut AttachmentReading, Option<&BreakForce>)>,
    mut diagnostics: ResMut<Diagnostics>,
) {
    let start = Instant::now();
    let cables = &mut *cables;
    for event in cables.set.take_events() {
        let notice = match &event {
            Event::Asleep(cable) => {
                cables.links.cables.get(cable).map(|&entity| Notice::Asleep(CableAsleep { entity }))
            }
            Event::Awake(cable) => cables.links.cables.get(cable).map(|&entity| Notice::Awake(CableAwake { entity })),
            Event::AttachmentEnded { attachment, .. } => cables.links.attachments.remove(attachment).map(|bound| {
                let (entity, cable, body) = (bound.entity, bound.cable, bound.body);
                Notice::Ended(AttachmentEnded { entity, cable, body, end: End::BodyGone })
            }),
            _ => None,
        };
        cables.notices.extend(notice);
    }
    let mut broken = Vec::new();
    let Cables { set, links, .. } = &mut *cables;
    for (handle, bound) in &mut links.attachments {
        let (Ok(attachment), Ok((mut reading, limit))) = (set.attachment(*handle), readings.get_mut(bound.entity))
        else {
            continue;
        };
        diagnostics.interface_work += attachment.work() - bound.counted;
        bound.counted = attachment.work();
        let force = attachment.force();
        let now =
            AttachmentReading { force, moment: attachment.moment(), gap: attachment.gap(), work: attachment.work() };
        reading.set_if_neq(now);
        if limit.is_some_and(|limit| force.norm() > limit.0) {
            broken.push(*handle);
        }
    }
    if !broken.is_empty() {
        bring_home(cables, &mut of);
        for handle in broken {
            let Some(bound) = cables.links.attachments.remove(&handle) else { continue };
            let _ = cables.set.detach(&mut physics, handle);
            let (entity, cable, body) = (bound.entity, bound.cable, bound.body);
            cables.notices.push(Notice::Ended(AttachmentEnded { entity, cable, body, end: End::Broken }));
        }
        lend_out(cables, &mut of);
    }
    diagnostics.spent(Stage::Publish, start);
}

/// What cables did, and that they moved.
pub(crate) fn count(mut of: AllCables, mut diagnostics: ResMut<Diagnostics>) {
    for mut cable in &mut of {
        let Ok(core) = cable.core() else { continue };
        let (rule, now) = (core.rule(), *core.diagnostics());
        let done = now.since(&cable.counted);
        if !cable.is_asleep() {
            cable.set_changed();
        }
        if done != lariat_ancf::Diagnostics::default() {
            diagnostics.count(rule, &done);
            cable.bypass_change_detection().counted = now;
        }
    }
}

/// Where bodies are.
pub(crate) fn read_bodies(physics: Res<Physics>, mut poses: Query<(&BodyHandle, &mut BodyPose)>) {
    for (body, mut pose) in &mut poses {
        let Some(rigid) = physics.bodies.get(body.handle) else { continue };
        let mut now = *pose;
        now.follow(rigid, false);
        pose.set_if_neq(now);
    }
}

/// Sends events; attachments that ended are despawned after theirs.
pub(crate) fn send(world: &mut World) {
    let notices = core::mem::take(&mut world.resource_mut::<Cables>().notices);
    for notice in notices {
        let ended = match &notice {
            Notice::Ended(event) => Some((event.entity, event.end)),
            _ => None,
        };
        notice.send(world);
        if let Some((entity, end)) = ended
            && let Ok(mut entity) = world.get_entity_mut(entity)
        {
            entity.remove::<Holds>();
            if end != End::Released {
                entity.despawn();
            }
        }
    }
}
