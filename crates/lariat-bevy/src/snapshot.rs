//! Saving and restoring the state of all cables, attachments and bodies, for rollback networking
//! and for trials.
//!
//! A snapshot holds Rapier's world, the set of cables, and the components of this crate on every
//! cable, attachment and body. A run that goes on from a restored snapshot is bitwise the run that
//! went on from the moment when the snapshot was taken.

use crate::attachment::{Attached, Attachment, AttachmentReading, BreakForce, NotAttachable, OnCable, ToBody};
use crate::body::{Body, BodyHandle, BodyPose, KinematicTarget};
use crate::cable::Cable;
use crate::cables::Cables;
use crate::clock::FixedClock;
use crate::components::{CableComponents, put};
use crate::error::Error;
use crate::interpolate::Interpolate;
use crate::junction::{Joined, Junction, NotJoinable};
use crate::links::{AttachmentLink, Links};
use crate::mesh::RopeMesh;
use crate::passing::SheaveAlong;
use crate::pending::Pending;
use crate::physics::Physics;
use crate::sheave::Sheave;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::{DetectChangesMut, Or, With};
use bevy_ecs::query::Allow;
use bevy_ecs::world::{EntityRef, EntityWorldMut, World};
use lariat_rapier::CableSet;
use lariat_rapier::rapier::pipeline::{CollisionPipeline, PhysicsPipeline, PhysicsWorld};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// State of all cables, attachments and bodies.
#[derive(Clone)]
pub struct Snapshot {
    physics: Arc<PhysicsWorld>,
    set: CableSet,
    links: Links,
    pending: Pending,
    clock: FixedClock,
    entities: Vec<Saved>,
}

type Ours = (With<Cable>, With<Attachment>, With<Junction>, With<Sheave>, With<SheaveAlong>, With<Body>);
type AnyOfOurs = (Or<(Or<Ours>, With<BodyHandle>)>, Allow<Disabled>);
type SpawnedByUser = (Or<Ours>, Allow<Disabled>);

impl Snapshot {
    /// Copies the state.
    ///
    /// # Errors
    /// [`Error::NotInstalled`]; [`Error::ForeignBodies`] if a cable depends on a body that is not in
    /// [`Physics`], because another engine owns it.
    pub fn take(world: &mut World) -> Result<Snapshot, Error> {
        check(world)?;
        let entities: Vec<Entity> = world.query_filtered::<Entity, AnyOfOurs>().iter(world).collect();
        let entities = entities.into_iter().map(|entity| Saved::of(world.entity(entity))).collect();
        let cables = world.resource::<Cables>();
        Ok(Snapshot {
            physics: Arc::new(copy(&world.resource::<Physics>().0)),
            set: cables.set.clone(),
            links: cables.links.clone(),
            pending: world.resource::<Pending>().clone(),
            clock: *world.resource::<FixedClock>(),
            entities,
        })
    }

    /// Restores the state. Cables, attachments and bodies that were spawned since are despawned.
    /// Those that were despawned since are spawned again, with this crate's components only and new
    /// entity numbers: returns them, from old to new.
    ///
    /// # Errors
    /// As [`take`](Self::take); nothing is restored then.
    pub fn restore(&self, world: &mut World) -> Result<BTreeMap<Entity, Entity>, Error> {
        check(world)?;
        world.resource_mut::<Cables>().restoring = true;
        let renamed = self.restore_entities(world);
        let name = |entity: Entity| renamed.get(&entity).copied().unwrap_or(entity);
        let (set, links) = (self.set.clone(), self.links.renamed(&name));
        let mut pending = self.pending.clone();
        pending.unlinked.iter_mut().for_each(|entity| *entity = name(*entity));
        pending.removed_attachments.iter_mut().for_each(|(entity, _)| *entity = name(*entity));
        // a component that had changed when the snapshot was taken counts as changed again
        pending.changed_effects = links.built.keys().copied().collect();
        *world.resource_mut::<Pending>() = pending;
        *world.resource_mut::<Cables>() = Cables { set, links, ..Cables::default() };
        world.query::<&mut KinematicTarget>().iter_mut(world).for_each(|mut target| target.set_changed());
        world.resource_mut::<Physics>().0 = copy(&self.physics);
        *world.resource_mut::<FixedClock>() = self.clock;
        Ok(renamed)
    }

    /// Restores the components; returns the entities that were spawned again, from old to new.
    fn restore_entities(&self, world: &mut World) -> BTreeMap<Entity, Entity> {
        // an attachment that the snapshot holds must not be despawned with the cable it was moved
        // to since
        for saved in &self.entities {
            if let Some(on) = saved.on.filter(|on| world.get_entity(on.0).is_ok())
                && let Ok(mut entity) = world.get_entity_mut(saved.entity)
            {
                entity.insert(on);
            }
        }
        let known: BTreeSet<Entity> = self.entities.iter().map(|saved| saved.entity).collect();
        let now: Vec<Entity> = world.query_filtered::<Entity, SpawnedByUser>().iter(world).collect();
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
        renamed
    }
}

/// Checks that a world has cables, and that the bodies they are attached to are in [`Physics`].
fn check(world: &World) -> Result<(), Error> {
    let cables = world.get_resource::<Cables>().ok_or(Error::NotInstalled)?;
    let bodies = &world.resource::<Physics>().bodies;
    let mut attached = cables.links.attachments.values().filter(|link| !bodies.contains(link.handle));
    // a body of our own that is gone, the user has removed
    let own = |link: &AttachmentLink| link.body.is_some_and(|body| world.get::<Body>(body).is_some());
    match attached.find(|link| !own(link)) {
        Some(link) => Err(Error::ForeignBodies { attachment: link.entity }),
        None => Ok(()),
    }
}

/// Copies Rapier's world except for its workspace.
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
    on: Option<OnCable>,
    to: Option<ToBody>,
    body: Option<Body>,
    junction: Option<Junction>,
    sheave: Option<Sheave>,
    along: Option<SheaveAlong>,
    cable: CableComponents,
    plain: Plain,
}

impl Saved {
    fn of(entity: EntityRef) -> Self {
        Saved {
            entity: entity.id(),
            on: entity.get().copied(),
            to: entity.get().copied(),
            body: entity.get().cloned(),
            junction: entity.get().cloned(),
            sheave: entity.get().copied(),
            along: entity.get().copied(),
            cable: CableComponents::of(entity),
            plain: Plain::of(entity),
        }
    }

    fn put(mut self, world: &mut World, name: &impl Fn(Entity) -> Entity) {
        let alive = |entity: &Entity| world.get_entity(*entity).is_ok();
        let on = self.on.map(|on| name(on.0)).filter(alive).map(OnCable);
        let to = self.to.map(|to| name(to.0)).filter(alive).map(ToBody);
        let Ok(mut entity) = world.get_entity_mut(name(self.entity)) else { return };
        // to insert a body's description over itself would make the body anew
        match self.body {
            Some(body) if !entity.contains::<Body>() => {
                entity.insert(body);
            }
            None => {
                entity.remove::<Body>();
            }
            Some(_) => {}
        }
        // before `Joined`, which it removes
        let junction = self.junction.map(|mut junction| {
            junction.rename(name);
            junction
        });
        put(&mut entity, junction);
        let sheave = self.sheave.map(|mut sheave| {
            sheave.rename(name);
            sheave
        });
        put(&mut entity, sheave);
        put(&mut entity, self.along.map(|along| along.renamed(name)));
        self.cable.rename(name);
        put(&mut entity, on);
        put(&mut entity, to);
        self.cable.put(&mut entity);
        self.plain.put(&mut entity);
    }
}

macro_rules! plain {
    ($($field:ident: $type:ty),* $(,)?) => {
        /// Components that are saved as they are, besides those of [`CableComponents`].
        #[derive(Clone)]
        struct Plain { $($field: Option<$type>),* }

        impl Plain {
            fn of(entity: EntityRef) -> Self {
                Plain { $($field: entity.get::<$type>().cloned()),* }
            }

            fn put(self, entity: &mut EntityWorldMut) {
                $(put(entity, self.$field);)*
            }
        }
    };
}

// in this order: `Attachment` and `Body` remove handles, which are the last
plain! {
    name: Name, cable: Cable, interpolate: Interpolate, mesh: RopeMesh, break_force: BreakForce,
    attachment: Attachment, reading: AttachmentReading, not_attachable: NotAttachable, target: KinematicTarget, pose: BodyPose,
    body_handle: BodyHandle, attached: Attached, joined: Joined, not_joinable: NotJoinable,
}
