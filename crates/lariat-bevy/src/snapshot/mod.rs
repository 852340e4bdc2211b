//! Saving and restoring the state of all cables, attachments and bodies, for rollback networking,
//! for trials, and for saved games.
//!
//! A snapshot holds Rapier's world, the set of cables, the water, and the components of this crate
//! on every cable, attachment and body. A run that goes on from a restored snapshot is bitwise the
//! run that went on from the moment when the snapshot was taken.

mod bytes;
mod changes;
mod entity;
mod names;
mod shared;

use crate::attachment::Attachment;
use crate::body::{Body, BodyHandle};
use crate::breaking::split_entities;
use crate::cable::Cable;
use crate::cables::Cables;
use crate::clock::FixedClock;
use crate::components::CableComponents;
use crate::error::Error;
use crate::junction::Junction;
use crate::kink::KinkAlong;
use crate::links::{AttachmentLink, Links};
use crate::passing::SheaveAlong;
use crate::pending::Pending;
use crate::physics::Physics;
use crate::sheave::Sheave;
use crate::water::Sea;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Or, With};
use bevy_ecs::query::Allow;
use bevy_ecs::world::{World, WorldId};
pub(crate) use changes::{PutBack, Watched};
use entity::Saved;
use lariat_rapier::CableSet;
use lariat_rapier::rapier::pipeline::{CollisionPipeline, PhysicsPipeline, PhysicsWorld};
use names::Names;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// State of all cables, attachments and bodies.
///
/// To go back in its own world, keep it. To load it in another world, or in another run of the
/// program, write it with [`to_bytes`](Self::to_bytes):
///
/// ```
/// use bevy_ecs::prelude::*;
/// use lariat_bevy::{Cable, CableStep, Cables, Snapshot};
///
/// let mut world = World::new();
/// lariat_bevy::install(&mut world);
/// let rope = Cable::steel_rope(0.012).between([0.0, 0.0, 0.0], [4.0, 0.0, 0.0]);
/// let rope = world.spawn(rope).id();
/// world.run_schedule(CableStep);
/// let saved: Vec<u8> = Snapshot::take(&mut world)?.to_bytes()?; // to a file
///
/// let mut other = World::new();
/// lariat_bevy::install(&mut other);
/// let new_names = Snapshot::from_bytes(&saved)?.restore(&mut other)?;
/// let loaded = new_names[&rope]; // a new entity
/// # world.run_schedule(CableStep);
/// # other.run_schedule(CableStep);
/// let (here, there) = (world.resource::<Cables>(), other.resource::<Cables>());
/// assert_eq!(here.get(rope)?.positions(), there.get(loaded)?.positions());
/// # Ok::<(), lariat_bevy::Error>(())
/// ```
///
/// It is plain serde data as well, in a format of your choice: JSON needs `serde_json` with its feature
/// `float_roundtrip`, without which numbers change in their last digit, and has no infinite numbers.
/// Such formats find no damage: put a [seal](lariat_ancf::seal) around them.
///
/// # Limits
///
/// - It holds no entity that is not of this crate, and no component that is not: keep yours by the
///   numbers that [`restore`](Self::restore) renames. What names such an entity names one that does not
///   exist after a load.
/// - Functions are not saved: a loaded cable with force densities or potentials cannot step before they
///   are [added](lariat_ancf::Cable::add_force_density) again.
/// - Events that were not sent yet are lost, and the counters of [`Diagnostics`](crate::Diagnostics) go on
///   from those of the world.
#[derive(Clone, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct Snapshot {
    #[serde(with = "shared")]
    physics: Arc<PhysicsWorld>,
    set: CableSet,
    links: Links,
    pending: Pending,
    clock: FixedClock,
    /// The water, and whether it had changed.
    sea: Option<(Sea, bool)>,
    entities: Vec<Saved>,
    /// The world whose entities these are; none that is known for one that was loaded.
    #[serde(skip)]
    origin: Option<WorldId>,
}

type Ours =
    (With<Cable>, With<Attachment>, With<Junction>, With<Sheave>, With<SheaveAlong>, With<KinkAlong>, With<Body>);
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
        // a cable that was cut has its second entity in the next host step, or now
        split_entities(world);
        let now = world.change_tick();
        let entities: Vec<Entity> = world.query_filtered::<Entity, AnyOfOurs>().iter(world).collect();
        let pending = world.resource::<Pending>();
        let saved = |entity| Saved::of(world.entity(entity), pending, now);
        let entities = entities.into_iter().map(saved).collect();
        let sea = world.get_resource_ref::<Sea>();
        let sea = sea.map(|sea| (Sea::clone(&sea), sea.last_changed().is_newer_than(pending.prepared, now)));
        let cables = world.resource::<Cables>();
        Ok(Snapshot {
            physics: Arc::new(copy(&world.resource::<Physics>().0)),
            set: cables.set.clone(),
            links: cables.links.clone(),
            pending: pending.clone(),
            clock: *world.resource::<FixedClock>(),
            sea,
            entities,
            origin: Some(world.id()),
        })
    }

    /// Restores the state.
    ///
    /// In the world where it was taken, cables, attachments and bodies that were spawned since are
    /// despawned. Those that were despawned since are spawned again, with this crate's components only
    /// and new entity numbers: returns them, from old to new.
    ///
    /// In another world, and of a snapshot that was loaded, the numbers mean nothing: cables,
    /// attachments and bodies of the world are despawned, all those of the snapshot are spawned, and all
    /// are returned. No other entity is touched, but that a [`BodyHandle`] to a body which is gone is
    /// removed.
    ///
    /// # Errors
    /// As [`take`](Self::take); nothing is restored then.
    pub fn restore(&self, world: &mut World) -> Result<BTreeMap<Entity, Entity>, Error> {
        check(world)?;
        world.resource_mut::<Cables>().restoring = true;
        let prepared = world.resource::<Pending>().prepared;
        let is_own = self.origin == Some(world.id());
        let names = if is_own { self.names_here(world) } else { self.names_elsewhere(world) };
        let name = |entity: Entity| names.of(entity);
        for saved in &self.entities {
            let mut saved = saved.clone();
            saved.rename(&name);
            saved.put(world);
        }
        let ended = world.change_tick();
        world.increment_change_tick();
        let mut put_back = PutBack::between(prepared, ended);
        for saved in &self.entities {
            saved.settle(world, name(saved.entity), &mut put_back);
        }
        self.restore_water(world);
        let (set, mut links) = (self.set.clone(), self.links.renamed(&name));
        if !is_own {
            find_reasons(world, &mut links);
        }
        let mut pending = self.pending.renamed(&name);
        // a component that had changed when the snapshot was taken counts as changed again
        pending.changed_effects = links.built.keys().copied().collect();
        (pending.prepared, pending.put_back) = (prepared, put_back);
        *world.resource_mut::<Pending>() = pending;
        *world.resource_mut::<Cables>() = Cables { set, links, ..Cables::default() };
        world.resource_mut::<Physics>().0 = copy(&self.physics);
        *world.resource_mut::<FixedClock>() = self.clock;
        Ok(names.spawned)
    }

    /// Despawns what the snapshot does not hold, and spawns what it holds and the world does not;
    /// returns the names of the latter.
    fn names_here(&self, world: &mut World) -> Names {
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
        despawn_ours(world, |entity| !known.contains(&entity));
        let mut names = Names::default();
        for saved in &self.entities {
            if world.get_entity(saved.entity).is_err() {
                names.spawned.insert(saved.entity, saved.spawn(world));
            }
        }
        names
    }

    /// Despawns all cables, attachments and bodies of another world, and spawns an entity for each that
    /// the snapshot holds; returns their names.
    fn names_elsewhere(&self, world: &mut World) -> Names {
        despawn_ours(world, |_| true);
        let with_handle: Vec<Entity> =
            world.query_filtered::<Entity, (With<BodyHandle>, Allow<Disabled>)>().iter(world).collect();
        for entity in with_handle {
            // its body goes with Rapier's world
            world.entity_mut(entity).remove::<BodyHandle>();
        }
        let mut names = Names::default();
        names.spawned.extend(self.entities.iter().map(|saved| (saved.entity, saved.spawn(world))));
        names.lose(self.mentioned(), world);
        names
    }

    /// Returns the entities that the snapshot holds or that something in it names.
    fn mentioned(&self) -> BTreeSet<Entity> {
        names::mentioned(|note| {
            self.links.renamed(note);
            self.pending.renamed(note);
            self.entities.iter().for_each(|saved| saved.clone().rename(note));
        })
    }

    fn restore_water(&self, world: &mut World) {
        let Some((sea, has_changed)) = &self.sea else {
            world.remove_resource::<Sea>();
            return;
        };
        if world.get_resource::<Sea>() != Some(sea) {
            world.insert_resource(sea.clone());
        }
        let now = world.change_tick();
        if let Some(mut own) = world.get_resource_mut::<Sea>() {
            changes::settle(&mut own, *has_changed, now);
        }
    }
}

/// Despawns cables, attachments, junctions, sheaves and bodies.
fn despawn_ours(world: &mut World, which: impl Fn(Entity) -> bool) {
    let now: Vec<Entity> = world.query_filtered::<Entity, SpawnedByUser>().iter(world).collect();
    for entity in now.into_iter().filter(|entity| which(*entity)) {
        // one of them may have gone with its cable
        let _ = world.try_despawn(entity);
    }
}

/// Finds again why cables could not be built, which is not saved in full.
fn find_reasons(world: &World, links: &mut Links) {
    for (entity, built) in &mut links.built {
        let (Err(reason), Some(cable)) = (built, world.get::<Cable>(*entity)) else { continue };
        if let Err(found) = CableComponents::of(world.entity(*entity)).build("cable", &cable.0) {
            *reason = found;
        }
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
