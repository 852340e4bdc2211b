//! Sheaves along one cable, as entities.

use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use lariat_ancf::{At, Point, Vector3};
use lariat_rapier::SheaveOptions;
use serde::{Deserialize, Serialize};

/// Asks for a sheave at a point between the ends of one cable: an eye of a body or of the world, over which it runs.
///
/// In the next host step, after the attachments were made, the entity has a [`Sheave`](crate::Sheave) in the place of this component. The entity of the
/// cable keeps the part before the sheave; the part behind it is a new entity with the same components, and both are attached to the eye by
/// new entities. [`Cables::parts`](crate::Cables::parts) lists the parts. The ends of the cable are those of its first and last part then: attach them before, or
/// with it.
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Attachment, Body, Cable, Cables, CableStep, SheaveAlong};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let rope = Cable::steel_rope(0.01).through([[0.0, -3.0, 0.0], [0.0, 0.0, 0.0], [0.0, -5.0, 0.0]]).node_at(3.0);
/// let rope = world.spawn(rope).id();
/// let sheave = world.spawn(SheaveAlong::of(rope, At::ArcLength(3.0)).to_world([0.0, 0.0, 0.0])).id();
/// for _ in 0..30 {
///     world.run_schedule(CableStep);
/// }
/// let cables = world.resource::<Cables>();
/// assert!(cables.sheave(sheave).unwrap().passed() > 0.05); // the longer side falls
/// assert_eq!(cables.parts(rope).unwrap().len(), 2);
/// ```
///
/// A cable that is drawn around a corner there needs a [node](crate::Cable::node_at) at it, and has no strain from the corner then. If the sheave
/// cannot be made, [`SheaveFailed`](crate::event::SheaveFailed) is sent; it is tried again when this component, the cable or the body changes.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SheaveAlong {
    /// The cable, and the point that is at the sheave.
    pub cable: (Entity, At),
    /// The body; `None` for the world.
    pub body: Option<Entity>,
    /// The eye in m, in body axes from its origin; in world axes for the world.
    pub anchor: Vector3<f64>,
    /// Inertia, friction, brake.
    pub options: SheaveOptions,
}

impl SheaveAlong {
    /// A sheave without friction at the origin of the world, for a point of a cable.
    pub fn of(cable: Entity, at: impl Into<At>) -> Self {
        SheaveAlong {
            cable: (cable, at.into()),
            body: None,
            anchor: Vector3::zeros(),
            options: SheaveOptions::default(),
        }
    }

    /// Puts the eye on a body, at a point in m in its axes.
    pub fn to(self, body: Entity, anchor: impl Into<Point>) -> Self {
        SheaveAlong { body: Some(body), anchor: anchor.into().0, ..self }
    }

    /// Puts the eye at a point of the world in m.
    pub fn to_world(self, anchor: impl Into<Point>) -> Self {
        SheaveAlong { body: None, anchor: anchor.into().0, ..self }
    }

    /// Sets inertia, friction and brake.
    pub fn with_options(self, options: SheaveOptions) -> Self {
        SheaveAlong { options, ..self }
    }

    /// Returns it with other names of entities.
    pub(crate) fn renamed(self, name: &(impl Fn(Entity) -> Entity + ?Sized)) -> Self {
        SheaveAlong { cable: (name(self.cable.0), self.cable.1), body: self.body.map(name), ..self }
    }
}
