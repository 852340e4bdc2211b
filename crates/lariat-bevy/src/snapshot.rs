//! State taken out and put back: for rollback networking, and for trying things out.
//!
//! A snapshot holds Rapier's world, the set of cables, and the components of this crate on every cable, attachment and body. From a
//! restored snapshot a run goes on bitwise as it did from the moment when the snapshot was taken.

use crate::attachment::{Attachment, AttachmentReading, BreakForce, Holds, OnCable, ToBody, Unable};
use crate::body::{Body, BodyHandle, BodyPose, KinematicTarget};
use crate::breaking::BreakTension;
use crate::cable::Cable;
use crate::clock::FixedClock;
use crate::effects::{Bending, Buoyancy, Damping, Drag, GravityScale, LineLoads, PointLoads, RestShape, Rule};
use crate::error::Error;
use crate::interpolate::Interpolate;
use crate::prepare::ChangedEffects;
use crate::world::{Cables, Links, Physics, bring_home, lend_out, with_cables};
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::{DetectChangesMut, Or, With};
use bevy_ecs::query::Allow;
use bevy_ecs::world::{EntityRef, EntityWorldMut, World};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::pipeline::{CollisionPipeline, PhysicsPipeline, PhysicsWorld};
use lariat_rapier::{AttachmentHandle, CableSet, Lent};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// State of all cables, attachments and bodies.
#[derive(Clone)]
pub struct Snapshot {
    physics: Arc<PhysicsWorld>,
    set: CableSet,
    links: Links,
    clock: FixedClock,
    pending: Pending,
    entities: Vec<Saved>,
}

/// Rapier's world but for its work space.
fn copy(world: &PhysicsWorld) -> PhysicsWorld {
    PhysicsWorld {
        gravity: world.gravity,
        integration_parameters: world.integration_parameters,
        physics_pipeline: PhysicsPipeline::new(),
        collision_pipeline: CollisionPipeline::new(),
        islands: world.islands.clone(),
        broad_phase: world.broad_phase.clone(),
        narrow_phase: world.narrow_phase.clone(),
        bodies: world.bodies.clone(),
        colliders: world.colliders.clone(),
        impulse_joints: world.impulse_joints.clone(),
        multibody_joints: world.multibody_joints.clone(),
        soft_bodies: world.soft_bodies.clone(),
        ccd_solver: world.ccd_solver.clone(),
    }
}

/// An entity with its components.
#[derive(Clone)]
struct Saved {
    entity: Entity,
    cable: Option<Cable>,
    body: Option<Body>,
    interpolate: Option<Interpolate>,
    on: Option<OnCable>,
    to: Option<ToBody>,
    plain: Plain,
}

/// Components that are plain data; `put` touches only what differs, so that nothing seems changed that is not.
macro_rules! plain {
    ($($field:ident: $type:ty),* $(,)?) => {
        #[derive(Clone)]
        struct Plain { $($field: Option<$type>),* }

        impl Plain {
            fn of(entity: EntityRef) -> Self {
                Plain { $($field: entity.get::<$type>().cloned()),* }
            }

            fn put(self, entity: &mut EntityWorldMut) {
                $(if entity.get::<$type>() != self.$field.as_ref() {
                    match self.$field {
                        Some(component) => { entity.insert(component); }
                        None => { entity.remove::<$type>(); }
                    }
                })*
            }
        }
    };
}

plain! {
    name: Name, rule: Rule, bending: Bending, damping: Damping, drag: Drag, buoyancy: Buoyancy, rest_shape: RestShape,
    line_loads: LineLoads, point_loads: PointLoads, gravity_scale: GravityScale, break_force: BreakForce, break_tension: BreakTension,
    attachment: Attachment, reading: AttachmentReading, unable: Unable, target: KinematicTarget, pose: BodyPose,
    handle: BodyHandle, holds: Holds,
}

type Ours = (Or<(With<Cable>, With<Attachment>, With<Body>, With<BodyHandle>)>, Allow<Disabled>);
type Made = (Or<(With<Cable>, With<Attachment>, With<Body>)>, Allow<Disabled>);

/// What went away and was not taken in when the snapshot was taken.
#[derive(Clone)]
struct Pending {
    cables: Vec<(Entity, Lent)>,
    bodies: Vec<RigidBodyHandle>,
    attachments: Vec<(Entity, AttachmentHandle)>,
}

impl Snapshot {
    /// Copies the state out.
    ///
    /// # Errors
    /// [`Error::NotInstalled`].
    pub fn take(world: &mut World) -> Result<Snapshot, Error> {
        if !world.contains_resource::<Cables>() {
            return Err(Error::NotInstalled);
        }
        with_cables(world, bring_home);
        let entities: Vec<Entity> = world.query_filtered::<Entity, Ours>().iter(world).collect();
        let entities = entities.into_iter().map(|entity| Saved::of(world.entity(entity))).collect();
        let cables = world.resource::<Cables>();
        let snapshot = Snapshot {
            physics: Arc::new(copy(&world.resource::<Physics>().0)),
            set: cables.set.clone(),
            links: cables.links.clone(),
            clock: *world.resource::<FixedClock>(),
            pending: Pending {
                cables: cables.handed_in.clone(),
                bodies: cables.retired_bodies.clone(),
                attachments: cables.retired_attachments.clone(),
            },
            entities,
        };
        with_cables(world, lend_out);
        Ok(snapshot)
    }

    /// Puts the state back. Cables, attachments and bodies that are new since are despawned; those that went away are spawned anew, with this
    /// crate's components only, and other numbers: the result tells which, old to new.
    ///
    /// # Errors
    /// [`Error::NotInstalled`].
    pub fn restore(&self, world: &mut World) -> Result<BTreeMap<Entity, Entity>, Error> {
        if !world.contains_resource::<Cables>() {
            return Err(Error::NotInstalled);
        }
        with_cables(world, bring_home);
        // attachments of a cable that goes must not go with it, if they are known
        for saved in &self.entities {
            if let Some(on) = saved.on.filter(|on| world.get_entity(on.0).is_ok())
                && let Ok(mut entity) = world.get_entity_mut(saved.entity)
            {
                entity.insert(on);
            }
        }
        let known: BTreeSet<Entity> = self.entities.iter().map(|saved| saved.entity).collect();
        let now: Vec<Entity> = world.query_filtered::<Entity, Made>().iter(world).collect();
        for entity in now.into_iter().filter(|entity| !known.contains(entity)) {
            world.despawn(entity);
        }
        let mut renamed = BTreeMap::new();
        for saved in &self.entities {
            if world.get_entity(saved.entity).is_err() {
                renamed.insert(saved.entity, world.spawn_empty().id());
            }
        }
        let name = |entity: Entity| renamed.get(&entity).copied().unwrap_or(entity);
        for saved in &self.entities {
            saved.clone().put(world, &name);
        }
        let mut cables = world.resource_mut::<Cables>();
        cables.set = self.set.clone();
        cables.links = self.links.renamed(&name);
        cables.host = None;
        let Pending { cables: gone, bodies, attachments } = self.pending.clone();
        cables.handed_in = gone.into_iter().map(|(entity, lent)| (name(entity), lent)).collect();
        cables.retired_attachments = attachments.into_iter().map(|(entity, held)| (name(entity), held)).collect();
        cables.retired_bodies = bodies;
        cables.notices.clear();
        world.resource_mut::<Physics>().0 = copy(&self.physics);
        *world.resource_mut::<FixedClock>() = self.clock;
        // what was changed and not taken in yet is so again
        let cables: Vec<Entity> = self.entities.iter().filter(|s| s.cable.is_some()).map(|s| name(s.entity)).collect();
        world.resource_mut::<ChangedEffects>().0.extend(cables);
        let mut targets = world.query::<&mut KinematicTarget>();
        targets.iter_mut(world).for_each(|mut target| target.set_changed());
        with_cables(world, lend_out);
        Ok(renamed)
    }
}

impl Saved {
    fn of(entity: EntityRef) -> Self {
        Saved {
            entity: entity.id(),
            cable: entity.get::<Cable>().cloned(),
            body: entity.get::<Body>().cloned(),
            interpolate: entity.get::<Interpolate>().cloned(),
            on: entity.get::<OnCable>().copied(),
            to: entity.get::<ToBody>().copied(),
            plain: Plain::of(entity),
        }
    }

    fn put(self, world: &mut World, name: &impl Fn(Entity) -> Entity) {
        let alive = |world: &World, entity: Entity| world.get_entity(entity).is_ok();
        let on = self.on.map(|on| OnCable(name(on.0))).filter(|on| alive(world, on.0));
        let to = self.to.map(|to| ToBody(name(to.0))).filter(|to| alive(world, to.0));
        let Ok(mut entity) = world.get_entity_mut(name(self.entity)) else { return };
        match self.cable {
            Some(cable) => {
                entity.insert(cable);
            }
            None => {
                entity.remove::<Cable>();
            }
        }
        // a body's description only matters where it is made; to put it back over itself would make the body anew
        match self.body {
            Some(body) if !entity.contains::<Body>() => {
                entity.insert(body);
            }
            None if entity.contains::<Body>() => {
                entity.remove::<Body>();
            }
            _ => {}
        }
        match self.interpolate {
            Some(interpolate) => {
                entity.insert(interpolate);
            }
            None => {
                entity.remove::<Interpolate>();
            }
        }
        if entity.get::<OnCable>() != on.as_ref() {
            match on {
                Some(on) => {
                    entity.insert(on);
                }
                None => {
                    entity.remove::<OnCable>();
                }
            }
        }
        if entity.get::<ToBody>() != to.as_ref() {
            match to {
                Some(to) => {
                    entity.insert(to);
                }
                None => {
                    entity.remove::<ToBody>();
                }
            }
        }
        self.plain.put(&mut entity);
    }
}

impl Links {
    fn renamed(&self, name: &impl Fn(Entity) -> Entity) -> Links {
        let mut links = self.clone();
        links.cables.values_mut().for_each(|entity| *entity = name(*entity));
        links.bodies.values_mut().for_each(|entity| *entity = name(*entity));
        for bound in links.attachments.values_mut() {
            (bound.entity, bound.cable) = (name(bound.entity), name(bound.cable));
            bound.body = bound.body.map(name);
        }
        links
    }
}
