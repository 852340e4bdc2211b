//! Rigid bodies as components, for programs that own their Rapier world.

use crate::point::{Point, from_vector, to_vector};
use crate::world::{Cables, Physics};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::system::{Query, Res, ResMut, SystemParam};
use bevy_ecs::world::DeferredWorld;
use lariat_ancf::Vector3;
use lariat_rapier::rapier::dynamics::{RigidBody, RigidBodyBuilder, RigidBodyHandle};
use lariat_rapier::rapier::geometry::ColliderBuilder;
use lariat_rapier::rapier::math::Pose;
use nalgebra::{Quaternion, UnitQuaternion};

/// A rigid body with its colliders; the plugin makes it before the next step, and removes it when this component or the entity goes.
#[derive(Component, Clone, Debug)]
#[require(BodyPose)]
#[component(on_discard = retire)]
pub struct Body {
    pub(crate) rigid: RigidBodyBuilder,
    pub(crate) colliders: Vec<ColliderBuilder>,
}

impl Body {
    /// A body as Rapier's builder describes it.
    pub fn new(rigid: RigidBodyBuilder) -> Self {
        Body { rigid, colliders: Vec::new() }
    }

    /// A body that forces move.
    pub fn dynamic() -> Self {
        Self::new(RigidBodyBuilder::dynamic())
    }

    /// A body that stands still.
    pub fn fixed() -> Self {
        Self::new(RigidBodyBuilder::fixed())
    }

    /// A body that [`KinematicTarget`] moves.
    pub fn kinematic() -> Self {
        Self::new(RigidBodyBuilder::kinematic_position_based())
    }

    /// Its place in m.
    pub fn at(mut self, position: impl Into<Point>) -> Self {
        self.rigid = self.rigid.translation(to_vector(&position.into().0));
        self
    }

    /// Its velocity in m/s.
    pub fn moving(mut self, velocity: impl Into<Point>) -> Self {
        self.rigid = self.rigid.linvel(to_vector(&velocity.into().0));
        self
    }

    /// Adds a collider.
    pub fn with(mut self, collider: ColliderBuilder) -> Self {
        self.colliders.push(collider);
        self
    }
}

/// What Rapier calls a body. The plugin keeps it; who brings bodies of another plugin sets it ([`BodyHandle::external`]).
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub struct BodyHandle {
    pub(crate) handle: RigidBodyHandle,
}

impl BodyHandle {
    /// A body that someone else makes and removes.
    pub fn external(handle: RigidBodyHandle) -> Self {
        BodyHandle { handle }
    }
}

/// Where a body is after the last step, and where it was before it.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyPose {
    /// Place of its origin in m.
    pub position: Vector3<f64>,
    /// Attitude.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of its centre of mass in m/s.
    pub velocity: Vector3<f64>,
    before: (Vector3<f64>, UnitQuaternion<f64>),
}

impl BodyPose {
    /// Place and attitude between the last two steps: 0 = before, 1 = after.
    pub fn between(&self, fraction: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let (place, attitude) = &self.before;
        let turn = (self.rotation * attitude.inverse()).scaled_axis() * fraction;
        (place.lerp(&self.position, fraction), UnitQuaternion::from_scaled_axis(turn) * attitude)
    }

    pub(crate) fn follow(&mut self, body: &RigidBody, first: bool) {
        let q = body.rotation();
        let now = (
            from_vector(body.translation()),
            UnitQuaternion::from_quaternion(Quaternion::new(q.w.into(), q.x.into(), q.y.into(), q.z.into())),
        );
        self.before = if first { now } else { (self.position, self.rotation) };
        (self.position, self.rotation) = now;
        self.velocity = from_vector(body.linvel());
    }
}

/// Where a kinematic body is to be after the next step.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct KinematicTarget {
    /// Place of its origin in m.
    pub position: Vector3<f64>,
    /// Attitude.
    pub rotation: UnitQuaternion<f64>,
}

impl KinematicTarget {
    /// This place (m), unturned.
    pub fn at(position: impl Into<Point>) -> Self {
        KinematicTarget { position: position.into().0, rotation: UnitQuaternion::identity() }
    }

    pub(crate) fn pose(&self) -> Pose {
        let q = self.rotation.coords.map(|x| x as f32);
        Pose::from_parts(
            to_vector(&self.position),
            lariat_rapier::rapier::math::Rotation::from_xyzw(q.x, q.y, q.z, q.w),
        )
    }
}

/// Rapier's bodies by entity.
#[derive(SystemParam)]
pub struct Bodies<'w, 's> {
    physics: ResMut<'w, Physics>,
    handles: Query<'w, 's, &'static BodyHandle>,
    links: Res<'w, Cables>,
}

impl Bodies<'_, '_> {
    /// The body of an entity; none before its first step.
    pub fn get(&self, entity: Entity) -> Option<&RigidBody> {
        self.physics.bodies.get(self.handles.get(entity).ok()?.handle)
    }

    /// The body of an entity, to change it.
    pub fn get_mut(&mut self, entity: Entity) -> Option<&mut RigidBody> {
        self.physics.bodies.get_mut(self.handles.get(entity).ok()?.handle)
    }

    /// The entity of a body, as Rapier's queries and events name it.
    pub fn entity(&self, handle: RigidBodyHandle) -> Option<Entity> {
        self.links.links.bodies.get(&handle.into_raw_parts()).copied()
    }
}

/// Leaves the body of an entity to be removed.
fn retire(mut world: DeferredWorld, context: HookContext) {
    let Some(handle) = world.get::<BodyHandle>(context.entity).map(|b| b.handle) else { return };
    if let Some(mut cables) = world.get_resource_mut::<Cables>() {
        cables.retired_bodies.push(handle);
    }
    if let Ok(mut commands) = world.commands().get_entity(context.entity) {
        commands.try_remove::<BodyHandle>();
    }
}
