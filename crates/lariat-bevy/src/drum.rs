//! Drums at the ends of cables, as components.

use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use lariat_ancf::{At, Reel};
use serde::{Deserialize, Serialize};

/// Winds the end of a cable on a body: its rate is the spin of the body relative to what holds the end, and the body feels the pull. Torque on the
/// body, or a motor on its joint, hoists. `cables.get(entity)?.reel(At::End)` reads it.
///
/// The cable needs the integrator `discrete-gradient`, the default, and an attachment at that end to what the drum turns in; the body turns
/// about an axis through its centre of mass, by an impulse joint to a fixed or kinematic body or with its other axes locked. A drum
/// that cannot be is [`DrumFailed`](crate::event::DrumFailed); it is tried again when the component, the cable or the body changes. While its body is gone the
/// cable keeps its length.
///
/// ```
/// use bevy_ecs::prelude::*;
/// use lariat_bevy::rapier::prelude::{ColliderBuilder, LockedAxes, RigidBodyBuilder};
/// use lariat_bevy::{At, Attachment, Body, Cable, Cables, Drum};
/// # use lariat_bevy::CableStep;
///
/// let mut world = World::new();
/// lariat_bevy::install(&mut world);
/// let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Y;
/// let wheel = Body::new(RigidBodyBuilder::dynamic().locked_axes(axes)).at([0.2, 0.0, 0.0]);
/// let wheel = world.spawn(wheel.with(ColliderBuilder::ball(0.2).mass(2.0))).id();
/// let rope = Cable::steel_rope(0.012).between([0.0, 0.0, 0.0], [0.0, -2.0, 0.0]);
/// let rope = world.spawn((rope, Drum::at_start(wheel, [0.0, 0.0, 1.0], 0.2).with_stock(10.0))).id();
/// world.spawn(Attachment::ball(rope, At::Start).to_world());
/// for _ in 0..30 {
///     world.run_schedule(CableStep);
/// }
/// assert!(world.resource::<Cables>().get(rope).unwrap().length() > 2.1); // its weight pulls it out
/// ```
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drum {
    /// The body.
    pub body: Entity,
    /// Axis in the axes of the body, of any length: positive spin about it pays out.
    pub axis: [f64; 3],
    /// Radius in m at which the cable leaves.
    pub radius: f64,
    /// Whether the start of the cable is on it. Default: the end.
    pub start: bool,
    /// Length in m of cable in all: the drum stops there, and what is not out turns with it. Default: no limit, and no mass.
    pub stock: Option<f64>,
}

impl Drum {
    /// A drum at the last point of the cable; the axis is in the axes of the body, the radius in m.
    pub fn at_end(body: Entity, axis: [f64; 3], radius: f64) -> Self {
        Drum { body, axis, radius, start: false, stock: None }
    }

    /// A drum at the first point of the cable.
    pub fn at_start(body: Entity, axis: [f64; 3], radius: f64) -> Self {
        Drum { start: true, ..Self::at_end(body, axis, radius) }
    }

    /// Sets the length in m of cable in all.
    pub fn with_stock(self, stock: f64) -> Self {
        Drum { stock: Some(stock), ..self }
    }

    /// Returns the end that is on it.
    pub fn at(&self) -> At {
        if self.start { At::Start } else { At::End }
    }

    /// Returns the reel that it gives its cable.
    pub(crate) fn reel(&self) -> Reel {
        Reel { stock: self.stock, ..Reel::on_drum() }
    }
}
