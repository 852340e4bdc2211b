//! Kinks of cables, as entities.

use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use lariat_ancf::At;
use serde::{Deserialize, Serialize};

/// Asks for a kink at a point between the ends of a cable: its slope is free on both sides there, as at a hinge, and no moment goes
/// through it ([`CableSet::add_kink`](lariat_rapier::CableSet::add_kink) says where that is right).
///
/// In the next host step, after the attachments were made, the entity has a [`Junction`](crate::Junction) of both parts in the place
/// of this component, to which other cables can be [tied](crate::Junction::and). The entity of the cable keeps the part before the
/// kink; the part behind it is a new entity with the same components, attachments and loads behind the kink go with it.
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Attachment, Cable, Cables, CableStep, Junction, KinkAlong};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let rope = world.spawn(Cable::steel_rope(0.01).between([0.0, 0.0, 0.0], [4.0, 0.0, 0.0])).id();
/// world.spawn(Attachment::ball(rope, At::Start).to_world());
/// world.spawn(Attachment::ball(rope, At::End).to_world());
/// let kink = world.spawn(KinkAlong::of(rope, At::ArcLength(1.0))).id();
/// world.run_schedule(CableStep);
/// let [_, (rest, _)] = world.get::<Junction>(kink).unwrap().points[..] else { unreachable!() };
/// assert!((world.resource::<Cables>().get(rest).unwrap().length() - 3.0).abs() < 1e-9);
/// ```
///
/// If the kink cannot be made, [`JunctionFailed`](crate::event::JunctionFailed) is sent; it is tried again when this component or the
/// cable changes.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KinkAlong {
    /// The cable, and the point.
    pub cable: (Entity, At),
}

impl KinkAlong {
    /// A kink at a point of a cable.
    pub fn of(cable: Entity, at: impl Into<At>) -> Self {
        KinkAlong { cable: (cable, at.into()) }
    }

    /// Returns it with other names of entities.
    pub(crate) fn renamed(self, name: &(impl Fn(Entity) -> Entity + ?Sized)) -> Self {
        KinkAlong { cable: (name(self.cable.0), self.cable.1) }
    }
}
