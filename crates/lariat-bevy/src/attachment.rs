//! Attachments: entities that connect a point of a cable to a point of a body.

use crate::error::Error;
use crate::pending::Pending;
use bevy_ecs::bundle::Bundle;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::world::DeferredWorld;
use core::ops::Deref;
use lariat_ancf::{At, Point, Vector3};
use lariat_rapier::{AttachmentHandle, AttachmentKind, Gap};
use serde::{Deserialize, Serialize};

/// An attachment of a point of a cable. Spawn it with its relationships:
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Attachment, Body, Cable};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let cable = world.spawn(Cable::steel_rope(0.012).between([0.0, 0.0, 0.0], [4.0, 0.0, 0.0])).id();
/// let ball = lariat_bevy::rapier::prelude::ColliderBuilder::ball(0.3).mass(20.0);
/// let load = world.spawn(Body::dynamic().at([4.0, -0.5, 0.0]).with(ball)).id();
/// world.spawn(Attachment::ball(cable, At::Start).to_world());
/// world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.5, 0.0]));
/// ```
///
/// # Limits
///
/// A ball transmits no moment. A clamp holds the direction of the tangent, and the twist of a cable
/// with [`Torsion`](crate::Torsion).
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[require(AttachmentReading)]
#[component(on_discard = discarded)]
pub struct Attachment {
    /// The point of the cable.
    pub at: At,
    /// Ball or clamp.
    pub kind: AttachmentKind,
    /// The point of the body in m, in body axes from its origin; in world axes for the world.
    /// Default: where the cable's point is.
    pub anchor: Option<Vector3<f64>>,
    /// Whether it is attached to the world instead of a body.
    pub world: bool,
    /// What to do if the point of the cable is not at the anchor when the attachment is made, or made
    /// again with another cable or body. Default: a gap of more than 1e-3 m is an error
    /// ([`AttachmentFailed`](crate::event::AttachmentFailed)).
    pub gap: Gap,
    /// Direction of the tangent of a clamp, of any size, in body axes; in world axes for the world. Default: that of the cable where it is
    /// attached, of a slack cable as it was laid that of the drawing.
    pub direction: Option<Vector3<f64>>,
}

impl Attachment {
    /// Prescribes the position of a point of `cable`.
    pub fn ball(cable: Entity, at: impl Into<At>) -> AttachmentDraft {
        AttachmentDraft { cable, at: at.into(), kind: AttachmentKind::Ball, direction: None }
    }

    /// Prescribes the position of a point of `cable` and the direction of its tangent.
    pub fn clamp(cable: Entity, at: impl Into<At>) -> AttachmentDraft {
        AttachmentDraft { cable, at: at.into(), kind: AttachmentKind::Clamp, direction: None }
    }
}

/// An attachment without its body.
#[derive(Clone, Copy, Debug)]
pub struct AttachmentDraft {
    cable: Entity,
    at: At,
    kind: AttachmentKind,
    direction: Option<Vector3<f64>>,
}

impl AttachmentDraft {
    /// Sets the direction of the tangent of a clamp, towards growing arc length: in body axes, or those of the world.
    pub fn along(mut self, direction: impl Into<Point>) -> Self {
        self.direction = Some(direction.into().0);
        self
    }

    fn attachment(&self, world: bool) -> Attachment {
        let AttachmentDraft { at, kind, direction, .. } = *self;
        Attachment { at, kind, anchor: None, world, gap: Gap::default(), direction }
    }

    /// Attaches to a body, at the present position of the cable's point unless
    /// [`at`](ToBodyBundle::at) sets another anchor.
    pub fn to(self, body: Entity) -> ToBodyBundle {
        ToBodyBundle { attachment: self.attachment(false), cable: OnCable(self.cable), body: ToBody(body) }
    }

    /// Attaches to the world, at the present position of the cable's point unless
    /// [`at`](ToWorldBundle::at) sets another.
    pub fn to_world(self) -> ToWorldBundle {
        ToWorldBundle { attachment: self.attachment(true), cable: OnCable(self.cable) }
    }
}

/// An attachment of a cable to a body.
#[derive(Bundle, Clone, Copy, Debug)]
pub struct ToBodyBundle {
    attachment: Attachment,
    cable: OnCable,
    body: ToBody,
}

impl ToBodyBundle {
    /// Sets the point of the body in m, in body axes from its origin.
    pub fn at(mut self, anchor: impl Into<Point>) -> Self {
        self.attachment.anchor = Some(anchor.into().0);
        self
    }

    /// Sets what to do if the point of the cable is not there.
    pub fn gap(mut self, gap: Gap) -> Self {
        self.attachment.gap = gap;
        self
    }
}

/// An attachment of a cable to the world.
#[derive(Bundle, Clone, Copy, Debug)]
pub struct ToWorldBundle {
    attachment: Attachment,
    cable: OnCable,
}

impl ToWorldBundle {
    /// Sets the position in m.
    pub fn at(mut self, position: impl Into<Point>) -> Self {
        self.attachment.anchor = Some(position.into().0);
        self
    }

    /// Sets what to do if the point of the cable is not there.
    pub fn gap(mut self, gap: Gap) -> Self {
        self.attachment.gap = gap;
        self
    }
}

/// The cable of an attachment.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[relationship(relationship_target = CableAttachments)]
pub struct OnCable(pub Entity);

/// The attachments of a cable; they are despawned with it.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq)]
#[relationship_target(relationship = OnCable, linked_spawn)]
pub struct CableAttachments(Vec<Entity>);

/// The body of an attachment. Insert another one to attach to another body; if the cable is not
/// there, [`Attachment::gap`] says whether it is drawn there or the attachment fails.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[relationship(relationship_target = BodyAttachments)]
pub struct ToBody(pub Entity);

/// The attachments of a body. When it is despawned they end, and their cables are free there.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq)]
#[relationship_target(relationship = ToBody)]
pub struct BodyAttachments(Vec<Entity>);

/// The force in N above which an attachment breaks, compared after each host step; one that is not
/// above 0 makes the attachment fail.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BreakForce(pub f64);

impl BreakForce {
    /// Refuses what is not positive.
    pub(crate) fn check(&self) -> Result<(), Error> {
        (self.0 > 0.0).then_some(()).ok_or(Error::BreakForce(self.0))
    }
}

/// Force, moment, gap and work of an attachment after the last host step.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AttachmentReading(pub lariat_rapier::AttachmentReading);

impl Deref for AttachmentReading {
    type Target = lariat_rapier::AttachmentReading;
    fn deref(&self) -> &lariat_rapier::AttachmentReading {
        &self.0
    }
}

/// The handle of an attachment in the set, while it exists there.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Attached(pub AttachmentHandle);

/// Marks an attachment that could not be made, until it changes.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct NotAttachable;

/// Notes that the attachment of a component that is removed or replaced is to be removed from the
/// set.
fn discarded(mut world: DeferredWorld, context: HookContext) {
    let Some(handle) = world.get::<Attached>(context.entity).map(|attached| attached.0) else { return };
    if let Some(mut pending) = world.get_resource_mut::<Pending>() {
        pending.removed_attachments.push((context.entity, handle));
    }
    if let Ok(mut commands) = world.commands().get_entity(context.entity) {
        commands.try_remove::<Attached>();
    }
}
