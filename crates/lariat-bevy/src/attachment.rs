//! Attachments: entities that hold a point of a cable to a point of a body.

use crate::point::Point;
use crate::world::Cables;
use bevy_ecs::bundle::Bundle;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::world::DeferredWorld;
use lariat_ancf::{At, Vector3};
use lariat_rapier::{AttachmentHandle, AttachmentKind};

/// How a point of a cable is held. Spawn it with its relationships:
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Attachment, Body, Cable};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let cable = world.spawn(Cable::steel_rope(0.012).between([0.0, 0.0, 0.0], [4.0, 0.0, 0.0])).id();
/// let load = world.spawn(Body::dynamic().at([4.0, -0.5, 0.0])).id();
/// world.spawn(Attachment::ball(cable, At::Start).to_world());
/// world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.5, 0.0]));
/// ```
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[require(AttachmentReading)]
#[component(on_discard = retire)]
pub struct Attachment {
    /// The point of the cable.
    pub at: At,
    /// Ball or clamp.
    pub pin: AttachmentKind,
    /// The point of the body in m, in body axes from its origin (in world axes for the world). Default: where the cable's point is.
    pub anchor: Option<Vector3<f64>>,
    /// Holds to the world, not to a body.
    pub world: bool,
}

impl Attachment {
    /// Holds the position of a point of `cable`.
    pub fn ball(cable: Entity, at: impl Into<At>) -> AttachmentDraft {
        AttachmentDraft { cable, at: at.into(), pin: AttachmentKind::Ball }
    }

    /// Holds the position and the direction of the tangent of a point of `cable`.
    pub fn clamp(cable: Entity, at: impl Into<At>) -> AttachmentDraft {
        AttachmentDraft { cable, at: at.into(), pin: AttachmentKind::Clamp }
    }
}

/// An attachment that lacks its body.
#[derive(Clone, Copy, Debug)]
pub struct AttachmentDraft {
    cable: Entity,
    at: At,
    pin: AttachmentKind,
}

impl AttachmentDraft {
    /// To a body, where the cable's point is: [`at`](ToBodyBundle::at) gives another anchor.
    pub fn to(self, body: Entity) -> ToBodyBundle {
        let attachment = Attachment { at: self.at, pin: self.pin, anchor: None, world: false };
        ToBodyBundle { attachment, cable: OnCable(self.cable), body: ToBody(body) }
    }

    /// To the world, where the cable's point is: [`at`](ToWorldBundle::at) gives another place.
    pub fn to_world(self) -> ToWorldBundle {
        let attachment = Attachment { at: self.at, pin: self.pin, anchor: None, world: true };
        ToWorldBundle { attachment, cable: OnCable(self.cable) }
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
    /// The point of the body in m, in body axes from its origin.
    pub fn at(mut self, anchor: impl Into<Point>) -> Self {
        self.attachment.anchor = Some(anchor.into().0);
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
    /// The place in m.
    pub fn at(mut self, place: impl Into<Point>) -> Self {
        self.attachment.anchor = Some(place.into().0);
        self
    }
}

/// The cable of an attachment.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = CableAttachments)]
pub struct OnCable(pub Entity);

/// The attachments of a cable; they go when it goes.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq)]
#[relationship_target(relationship = OnCable, linked_spawn)]
pub struct CableAttachments(Vec<Entity>);

/// The body of an attachment. Insert another to hold to another body: the gap closes with at most 10 m/s.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = BodyAttachments)]
pub struct ToBody(pub Entity);

/// The attachments of a body; when it goes they end, and their cables go on free.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq)]
#[relationship_target(relationship = ToBody)]
pub struct BodyAttachments(Vec<Entity>);

/// The force in N beyond which an attachment breaks, read after each host step.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct BreakForce(pub f64);

/// What passed through an attachment, after the last step.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct AttachmentReading {
    /// Force of the cable on the body in N, world axes.
    pub force: Vector3<f64>,
    /// Moment of the cable on the body about the anchor in N m, world axes; zero for a ball.
    pub moment: Vector3<f64>,
    /// Distance of node and anchor in m.
    pub gap: f64,
    /// Work of the cable on the body since the attachment was made, in J.
    pub work: f64,
}

/// An attachment that holds: its handle in the set.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub(crate) struct Holds(pub AttachmentHandle);

/// An attachment that could not be made, until it changes.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unable;

/// Leaves the hold of an attachment to be ended.
fn retire(mut world: DeferredWorld, context: HookContext) {
    let Some(handle) = world.get::<Holds>(context.entity).map(|h| h.0) else { return };
    if let Some(mut cables) = world.get_resource_mut::<Cables>() {
        cables.retired_attachments.push((context.entity, handle));
    }
    if let Ok(mut commands) = world.commands().get_entity(context.entity) {
        commands.try_remove::<Holds>();
    }
}
