//! Sheaves, as entities.

use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use lariat_ancf::At;
use lariat_rapier::SheaveOptions;
use serde::{Deserialize, Serialize};

/// Lets a cable run into another over a wheel without extent: both ends are attached at one point, of a body or of the world.
/// [`Cables::sheave`](crate::Cables::sheave) reads it. It ends when this component is removed or its entity is despawned.
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Attachment, Cable, Cables, CableStep, Sheave};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let up = world.spawn(Cable::steel_rope(0.01).between([0.0, -3.0, 0.0], [0.0, 0.0, 0.0])).id();
/// let down = world.spawn(Cable::steel_rope(0.01).between([0.0, 0.0, 0.0], [0.0, -5.0, 0.0])).id();
/// world.spawn(Attachment::ball(up, At::End).to_world());
/// world.spawn(Attachment::ball(down, At::Start).to_world());
/// let sheave = world.spawn(Sheave::between((up, At::End), (down, At::Start)).friction(0.1)).id();
/// for _ in 0..30 {
///     world.run_schedule(CableStep);
/// }
/// assert!(world.resource::<Cables>().sheave(sheave).unwrap().passed() > 0.05); // the longer side falls
/// ```
///
/// Both cables need the integrator `discrete-gradient`, the default, and one section. If a sheave cannot be made, or ends with
/// one of its cables or attachments, [`SheaveFailed`](crate::event::SheaveFailed) is sent; it is tried again when the component changes or a cable is spawned.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sheave {
    /// The cable that runs into the other at positive rates, and its end.
    pub from: (Entity, At),
    /// The other, and its end.
    pub to: (Entity, At),
    /// Inertia, friction, brake.
    pub options: SheaveOptions,
}

impl Sheave {
    /// A sheave without friction between the ends of two cables.
    pub fn between(from: (Entity, impl Into<At>), to: (Entity, impl Into<At>)) -> Self {
        let options = SheaveOptions::default();
        Sheave { from: (from.0, from.1.into()), to: (to.0, to.1.into()), options }
    }

    /// Sets the coefficient of friction of the rope on the wheel.
    pub fn friction(mut self, friction: f64) -> Self {
        self.options.friction = friction;
        self
    }

    /// Sets inertia, friction and brake.
    pub fn with_options(self, options: SheaveOptions) -> Self {
        Sheave { options, ..self }
    }

    /// Renames entities.
    pub(crate) fn rename(&mut self, name: &(impl Fn(Entity) -> Entity + ?Sized)) {
        (self.from.0, self.to.0) = (name(self.from.0), name(self.to.0));
    }
}
