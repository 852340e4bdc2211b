//! Rigid bodies as components, for programs that own their Rapier world.

use crate::cables::Cables;
use crate::pending::Pending;
use crate::physics::Physics;
use crate::rigid::Rigid;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::system::{Query, Res, ResMut, SystemParam};
use bevy_ecs::world::DeferredWorld;
use lariat_ancf::{Point, Vector3};
use lariat_rapier::convert::{rotation, to_pose, to_vector, vector};
use lariat_rapier::rapier::dynamics::{RigidBody, RigidBodyBuilder, RigidBodyHandle};
use lariat_rapier::rapier::geometry::ColliderBuilder;
use lariat_rapier::rapier::math::Pose;
use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};

/// A rigid body with its colliders. It is added to Rapier's world in the next host step, and
/// removed with this component or its entity.
#[derive(Component, Clone, Debug, Serialize, Deserialize)]
#[require(BodyPose)]
#[component(on_add = placed, on_discard = discarded)]
pub struct Body {
    pub(crate) rigid: Rigid,
    pub(crate) colliders: Vec<ColliderBuilder>,
}

impl Body {
    /// A body of Rapier's builder.
    pub fn new(rigid: RigidBodyBuilder) -> Self {
        Body { rigid: Rigid::Described(rigid), colliders: Vec::new() }
    }

    /// A body that forces and impulses move.
    pub fn dynamic() -> Self {
        Self::new(RigidBodyBuilder::dynamic())
    }

    /// A body at rest.
    pub fn fixed() -> Self {
        Self::new(RigidBodyBuilder::fixed())
    }

    /// A body that [`KinematicTarget`] moves.
    pub fn kinematic() -> Self {
        Self::new(RigidBodyBuilder::kinematic_position_based())
    }

    /// Sets the position in m.
    pub fn at(mut self, position: impl Into<Point>) -> Self {
        self.rigid = self.rigid.at(to_vector(&position.into().0));
        self
    }

    /// Sets the initial velocity in m/s.
    pub fn velocity(mut self, velocity: impl Into<Point>) -> Self {
        self.rigid = self.rigid.velocity(to_vector(&velocity.into().0));
        self
    }

    /// Adds a collider.
    pub fn with(mut self, collider: ColliderBuilder) -> Self {
        self.colliders.push(collider);
        self
    }
}

/// The handle of an entity's body in Rapier's world. Inserted with a [`Body`]; for bodies of
/// another plugin insert it yourself ([`BodyHandle::external`]).
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BodyHandle {
    pub(crate) handle: RigidBodyHandle,
}

impl BodyHandle {
    /// The handle of a body that another plugin adds and removes.
    pub fn external(handle: RigidBodyHandle) -> Self {
        BodyHandle { handle }
    }

    /// Returns the handle in Rapier's world.
    pub fn handle(&self) -> RigidBodyHandle {
        self.handle
    }
}

/// Position, rotation and velocity of a body after the last host step; before the first, where it
/// is built.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyPose {
    /// Position of its origin in m.
    pub position: Vector3<f64>,
    /// Rotation from body to world axes.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of its centre of mass in m/s.
    pub velocity: Vector3<f64>,
    /// Position and rotation before the last host step.
    before: (Vector3<f64>, UnitQuaternion<f64>),
}

impl BodyPose {
    /// Returns position and rotation at a fraction of the last host step: 0 = before it, 1 = after
    /// it.
    pub fn between(&self, fraction: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let (position, rotation) = &self.before;
        let change = (self.rotation * rotation.inverse()).scaled_axis() * fraction;
        (position.lerp(&self.position, fraction), UnitQuaternion::from_scaled_axis(change) * rotation)
    }

    /// Reads the state of a body; for a new one it is the state before the step too.
    pub(crate) fn read(&mut self, body: &RigidBody, new: bool) {
        let now = (vector(body.translation()), rotation(*body.rotation()));
        self.before = if new { now } else { (self.position, self.rotation) };
        (self.position, self.rotation) = now;
        self.velocity = vector(body.linvel());
    }
}

/// Position and rotation of a kinematic body after the next host step.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KinematicTarget {
    /// Position of its origin in m.
    pub position: Vector3<f64>,
    /// Rotation from body to world axes.
    pub rotation: UnitQuaternion<f64>,
}

impl KinematicTarget {
    /// A position in m, without rotation.
    pub fn at(position: impl Into<Point>) -> Self {
        KinematicTarget { position: position.into().0, rotation: UnitQuaternion::identity() }
    }

    pub(crate) fn pose(&self) -> Pose {
        to_pose(&self.position, &self.rotation)
    }
}

/// Rapier's bodies by entity.
#[derive(SystemParam)]
pub struct Bodies<'w, 's> {
    physics: ResMut<'w, Physics>,
    handles: Query<'w, 's, &'static BodyHandle>,
    cables: Res<'w, Cables>,
}

impl Bodies<'_, '_> {
    /// Returns the body of an entity; `None` before its first host step.
    pub fn get(&self, entity: Entity) -> Option<&RigidBody> {
        self.physics.bodies.get(self.handles.get(entity).ok()?.handle)
    }

    /// Returns the body of an entity, to change it.
    pub fn get_mut(&mut self, entity: Entity) -> Option<&mut RigidBody> {
        self.physics.bodies.get_mut(self.handles.get(entity).ok()?.handle)
    }

    /// Returns the entity of a body, for handles in results of Rapier's queries and events.
    pub fn entity(&self, handle: RigidBodyHandle) -> Option<Entity> {
        self.cables.links.bodies.get(&handle).copied()
    }
}

/// Reads where a new body will be; one that was loaded with its pose keeps that.
fn placed(mut world: DeferredWorld, context: HookContext) {
    let Some(body) = world.get::<Body>(context.entity).map(|body| body.rigid.build()) else { return };
    if let Some(mut pose) = world.get_mut::<BodyPose>(context.entity).filter(|pose| **pose == BodyPose::default()) {
        pose.read(&body, true);
    }
}

/// Notes that the body of a component that is removed or replaced is to be removed from Rapier's
/// world.
fn discarded(mut world: DeferredWorld, context: HookContext) {
    let Some(handle) = world.get::<BodyHandle>(context.entity).map(|b| b.handle) else { return };
    if let Some(mut pending) = world.get_resource_mut::<Pending>() {
        pending.removed_bodies.push(handle);
    }
    if let Ok(mut commands) = world.commands().get_entity(context.entity) {
        commands.try_remove::<BodyHandle>();
    }
}
