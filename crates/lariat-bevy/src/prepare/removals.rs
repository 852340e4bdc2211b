//! Removal of cables, attachments and bodies whose components were removed or replaced.

use crate::attachment::{Attached, Attachment};
use crate::cables::Cables;
use crate::event::{AttachmentEnded, EndReason};
use crate::pending::Pending;
use crate::physics::Physics;
use bevy_ecs::prelude::{Commands, Query, ResMut, With};
use lariat_rapier::CableHandle;

/// Removes cables, then attachments, then bodies.
pub(crate) fn remove(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut pending: ResMut<Pending>,
    attachments: Query<(), With<Attachment>>,
    mut commands: Commands,
) {
    let Cables { set, links, events, .. } = &mut *cables;
    let unlinked = pending.unlinked.drain(..).filter_map(|entity| links.remove_cable(entity));
    let unlinked: Vec<CableHandle> = unlinked.collect();
    for handle in pending.removed_cables.drain(..).chain(unlinked) {
        // one that is not in the set has no attachments there
        let _ = set.remove(&mut physics, handle);
        links.attachments.retain(|attachment, link| {
            let exists = set.attachment(*attachment).is_ok();
            // the attachment passes to the cable that replaces this one, if one does
            if !exists && let Ok(mut entity) = commands.get_entity(link.entity) {
                entity.try_remove::<Attached>();
            }
            exists
        });
    }
    for (entity, handle) in pending.removed_attachments.drain(..) {
        let Some(link) = links.attachments.remove(&handle) else { continue };
        let replaced = attachments.contains(entity);
        if set.detach(&mut physics, handle).is_ok() && !replaced {
            let (cable, body) = (link.cable, link.body);
            events.push(AttachmentEnded { entity, cable, body, reason: EndReason::Released }.into());
        }
    }
    for handle in pending.removed_bodies.drain(..) {
        links.bodies.remove(&handle);
        physics.remove_body(handle);
    }
}
