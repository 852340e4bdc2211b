//! Attachments that were spawned, changed, or lost their cable or body.

use crate::attachment::{Attached, Attachment, BreakForce, NotAttachable, OnCable, ToBody};
use crate::body::BodyHandle;
use crate::cables::Cables;
use crate::error::Error;
use crate::event::{AttachmentEnded, AttachmentFailed, EndReason};
use crate::links::AttachmentLink;
use crate::pending::Pending;
use crate::physics::Physics;
use crate::snapshot::Watched;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::prelude::{Commands, Has, Query, Ref, Res, ResMut};
use lariat_rapier::rapier::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use lariat_rapier::rapier::math::Vector;
use lariat_rapier::{AttachmentHandle, AttachmentOptions};

/// The components of an attachment, and its state.
type Components = (
    Entity,
    Ref<'static, Attachment>,
    Option<Ref<'static, OnCable>>,
    Option<Ref<'static, ToBody>>,
    Option<&'static Attached>,
    Option<&'static BreakForce>,
    Has<NotAttachable>,
);

/// Makes the attachments that the components ask for, and ends the others.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    pending: Res<Pending>,
    attachments: Query<Components>,
    handles: Query<Ref<BodyHandle>>,
    mut commands: Commands,
) {
    let cables = &mut *cables;
    let new_cables = pending.new_cables;
    for (entity, attachment, on, to, attached, limit, failed) in &attachments {
        let changed = attachment.is_changed()
            || on.as_ref().is_some_and(|on| pending.has_changed(entity, Watched::OnCable, on))
            || to.as_ref().is_some_and(|to| pending.has_changed(entity, Watched::ToBody, to))
            || new_cables
            || to.as_ref().is_some_and(|to| handles.get(to.0).is_ok_and(|body| body.is_changed()));
        let body = to.as_ref().map(|to| to.0).filter(|_| !attachment.world);
        let complete = on.is_some() && (body.is_some() || attachment.world);
        if let Some(&Attached(handle)) = attached {
            let Some(link) = cables.links.attachments.get(&handle).copied() else {
                commands.entity(entity).remove::<Attached>();
                continue;
            };
            let same_body = match body {
                Some(body) => handles.get(body).is_ok_and(|b| b.handle == link.handle),
                None => attachment.world && link.body.is_none(),
            };
            // a gap is closed or refused when the attachment is made, not later
            let same = Attachment { gap: link.made.gap, ..*attachment } == link.made;
            if same_body && same && on.as_ref().is_some_and(|on| on.0 == link.cable) {
                continue;
            }
            cables.links.attachments.remove(&handle);
            // one that has ended already is what is wanted
            let _ = cables.set.detach(&mut physics, handle);
            commands.entity(entity).remove::<Attached>();
            let no_body = body.is_some_and(|body| handles.get(body).is_err());
            if !complete || no_body {
                let gone = no_body || !physics.bodies.contains(link.handle);
                let reason = if gone { EndReason::BodyGone } else { EndReason::Released };
                let (cable, body) = (link.cable, link.body);
                cables.events.push(AttachmentEnded { entity, cable, body, reason }.into());
                continue;
            }
        } else if failed && !changed {
            continue;
        } else if !complete {
            // one that was released is no failure, and neither is one that was told of
            if attachment.is_added() {
                let error = Error::Incomplete(if on.is_none() { "cable" } else { "body" });
                commands.entity(entity).insert(NotAttachable);
                cables.events.push(AttachmentFailed { entity, error }.into());
            }
            continue;
        }
        let Some(cable) = on.map(|on| on.0) else { continue };
        let checked = limit.map_or(Ok(()), BreakForce::check);
        match checked.and_then(|()| attach(cables, &mut physics, &handles, &attachment, entity, cable, body)) {
            Ok(handle) => {
                commands.entity(entity).insert(Attached(handle)).remove::<NotAttachable>();
            }
            Err(error) => {
                commands.entity(entity).insert(NotAttachable);
                cables.events.push(AttachmentFailed { entity, error }.into());
            }
        }
    }
}

/// Makes one attachment.
fn attach(
    cables: &mut Cables,
    physics: &mut Physics,
    handles: &Query<Ref<BodyHandle>>,
    attachment: &Attachment,
    entity: Entity,
    cable: Entity,
    body: Option<Entity>,
) -> Result<AttachmentHandle, Error> {
    let handle = cables.handle(cable)?;
    let rigid = match body {
        Some(body) => handles.get(body).map_err(|_| Error::NotABody(body))?.handle,
        None => ground(cables, physics),
    };
    let (kind, gap, direction) = (attachment.kind, attachment.gap, attachment.direction);
    let options = AttachmentOptions { kind, gap, direction };
    let made = match attachment.anchor {
        Some(anchor) => cables.set.attach(physics, handle, attachment.at, rigid, anchor, options)?,
        None => cables.set.attach_here(physics, handle, attachment.at, rigid, options)?,
    };
    let link = AttachmentLink { entity, cable, body, handle: rigid, made: *attachment, counted: 0.0 };
    cables.links.attachments.insert(made, link);
    Ok(made)
}

/// Returns the fixed body that represents the world, and adds it if there is none.
pub(crate) fn ground(cables: &mut Cables, physics: &mut Physics) -> RigidBodyHandle {
    match cables.links.ground {
        Some(handle) if physics.bodies.contains(handle) => handle,
        _ => {
            let handle = physics.insert_body(RigidBodyBuilder::fixed().translation(Vector::ZERO));
            cables.links.ground = Some(handle);
            handle
        }
    }
}
