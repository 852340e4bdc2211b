//! The water that bodies are in: a resource for the water, a component for each body.

use bevy_ecs::component::Component;
use bevy_ecs::resource::Resource;
use lariat_ancf::Water;
use lariat_rapier::water::Immersed;
use serde::{Deserialize, Serialize};

/// The water of the world, in which bodies with [`InWater`] float, sink and ride on waves. Cables are in it by
/// their [`Buoyancy`](crate::Buoyancy) and [`Drag`](crate::Drag), of the same [`Flow`](lariat_ancf::Flow). Change it at any time; remove
/// it, and all bodies are in air.
///
/// ```
/// use bevy_ecs::prelude::*;
/// use lariat_ancf::{Surface, Vector3, Water};
/// use lariat_bevy::rapier::prelude::{ColliderBuilder, RigidBodyBuilder};
/// use lariat_bevy::{Body, BodyPose, CableStep, InWater, Sea};
///
/// let mut world = World::new();
/// lariat_bevy::install(&mut world);
/// let surface = Surface::at(0.0, Vector3::new(0.0, -9.81, 0.0));
/// world.insert_resource(Sea(Water::new(1000.0).with_surface(surface)));
/// let ball = Body::new(RigidBodyBuilder::dynamic()).with(ColliderBuilder::ball(0.2).density(500.0));
/// let float = world.spawn((ball, InWater::with_drag_area([0.06; 3]))).id();
/// for _ in 0..900 {
///     world.run_schedule(CableStep);
/// }
/// assert!(world.get::<BodyPose>(float).unwrap().position.y.abs() < 0.01); // half of it is below
/// ```
#[derive(Resource, Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sea(pub Water);

/// What the water of [`Sea`] does to a body: buoyancy and the forces of its wave, drag and added mass. It has the mass
/// and the colliders that the body has when this component is added or changed. What cannot be in water is
/// [`WaterFailed`](crate::event::WaterFailed); it is tried again when the component or the body changes.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InWater(pub Immersed);

impl InWater {
    /// Buoyancy, and drag by drag coefficient times area in m^2 along the axes of the body.
    pub fn with_drag_area(drag_area: impl Into<[f64; 3]>) -> Self {
        InWater(Immersed::with_drag_area(drag_area))
    }

    /// The same with a coefficient of added mass, 0.5 of a sphere.
    pub fn with_added_mass(self, coefficient: f64) -> Self {
        InWater(self.0.with_added_mass(coefficient))
    }

    /// The same with coefficients of added mass along the axes of the body.
    pub fn with_added_mass_along(self, coefficients: impl Into<[f64; 3]>) -> Self {
        InWater(self.0.with_added_mass_along(coefficients))
    }

    /// The same with a displaced volume in m^3, in place of that of its colliders.
    pub fn with_volume(self, volume: f64) -> Self {
        InWater(self.0.with_volume(volume))
    }
}
