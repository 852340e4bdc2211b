//! The cables of a world, by entity.
//!
//! The resource [`Cables`] owns the state of all cables, in a [`CableSet`]. An entity's
//! [`Cable`](crate::Cable) is the description that its cable was built from; state is read with
//! [`Cables::get`] and changed with [`Cables::get_mut`].
//!
//! # Alternatives considered
//!
//! Components that own the state of their cables. The set needs all cables at once to step them, so
//! every stage has to move them out of the components and back; a copied, overwritten or despawned
//! component then takes state with it that the set still counts on. A user's code has the same
//! length either way:
//!
//! | to | with components | with the resource |
//! |---|---|---|
//! | read one | `ropes: Query<&Cable>`, `ropes.get(e)?.core()?.length()` | `cables: Res<Cables>`, `cables.get(e)?.length()` |
//! | read all | `for rope in &ropes` | `for (entity, rope) in cables.iter()` |
//! | read some | `Query<&Cable, With<Bridge>>` | `Query<Entity, With<Bridge>>` and `cables.get(entity)?` |
//! | change the integrator | `ropes.get_mut(e)?.core_mut()?.set_integrator(i)` | `cables.get_mut(e)?.set_integrator(i)` |
//! | go back in time with one | clone the component, insert the clone | `cables.get(e)?.snapshot()`, `cables.get_mut(e)?.restore(s)` |
//! | skip those at rest | `Changed<Cable>` | `cables.is_asleep(entity)` |
//! | know why it was not built | `ropes.get(e)?.failure()` | the error of `cables.get(e)` |
//!
//! Spawning, effects, breaking, despawning and [`Snapshot`](crate::Snapshot) are the same with
//! both. Systems that read cables run in parallel with both; two systems that change different
//! cables do so only with components, which nothing here needs.

use crate::attachment::Attachment;
use crate::error::Error;
use crate::event::{QueuedEvent, StepFailed};
use crate::junction::Junction;
use crate::sheave::Sheave;
use bevy_ecs::entity::{Entity, EntityHashMap};
use bevy_ecs::resource::Resource;
use lariat_ancf::{At, Break};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{AttachmentHandle, CableHandle, CableSet, Event, HostStep, JunctionHandle, Settings, SheaveHandle};
use std::collections::{BTreeMap, HashMap};

/// The cables of a world: a resource to read with `Res<Cables>` and to change with
/// `ResMut<Cables>`.
///
/// ```
/// use bevy_ecs::prelude::*;
/// use lariat_bevy::{Cable, Cables};
///
/// let mut world = World::new();
/// lariat_bevy::install(&mut world);
/// world.spawn(Cable::steel_rope(0.012).between([0.0, 0.0, 0.0], [4.0, 0.0, 0.0]));
///
/// fn longest(cables: Res<Cables>) -> f64 {
///     cables.iter().map(|(_, cable)| cable.length()).fold(0.0, f64::max)
/// }
/// assert_eq!(world.run_system_cached(longest).unwrap(), 4.0);
/// ```
///
/// # Limits
///
/// Cables touch bodies and each other only with a [`Contact`](crate::Contact): see the [crate page](crate#limits).
#[derive(Resource, Default)]
pub struct Cables {
    pub(crate) set: CableSet,
    pub(crate) links: Links,
    pub(crate) events: Vec<QueuedEvent>,
    /// Cables that broke in the host step, or were cut since.
    pub(crate) broken: Vec<Parting>,
    /// The host step that is under way.
    pub(crate) host: Option<HostStep>,
    /// Whether a snapshot is being restored, with the cables of all components: those that are
    /// inserted need not be built.
    pub(crate) restoring: bool,
}

impl Cables {
    /// Returns the cable of an entity.
    ///
    /// # Errors
    /// [`Error::NotACable`]; [`Error::NotBuilt`] with the reason.
    pub fn get(&self, entity: Entity) -> Result<&lariat_ancf::Cable, Error> {
        Ok(self.set.get(self.handle(entity)?)?)
    }

    /// Returns the cable of an entity, to change its state, integrator or gravity, and wakes it.
    /// The rule, the effects and the point loads are the entity's components, which overwrite what
    /// is set here.
    ///
    /// # Errors
    /// [`Error::NotACable`]; [`Error::NotBuilt`] with the reason.
    pub fn get_mut(&mut self, entity: Entity) -> Result<&mut lariat_ancf::Cable, Error> {
        let handle = self.handle(entity)?;
        Ok(self.set.get_mut(handle)?)
    }

    /// Cuts the cable of an entity at a point between its ends. The entity keeps the part before the
    /// cut; the part behind it becomes an entity with the same components before the next host step,
    /// and the event is [`CableBroken`](crate::event::CableBroken). Attachments and junctions go with
    /// their part.
    ///
    /// # Errors
    /// [`Error::NotACable`]; [`Error::NotBuilt`] with the reason; [`Error::Coupling`] for a point that is
    /// not between the ends.
    pub fn cut(&mut self, entity: Entity, at: impl Into<At>) -> Result<(), Error> {
        let handle = self.handle(entity)?;
        self.set.cut(handle, at)?;
        self.take_partings();
        Ok(())
    }

    /// Takes the events of cables that broke or were cut from the set.
    fn take_partings(&mut self) {
        let parting = |event| match event {
            Event::Broken { cable, rest, how } => Some(Parting { cable, rest, how }),
            _ => None,
        };
        self.broken.extend(self.set.take_events().into_iter().filter_map(parting));
    }

    /// Iterates over all cables with their entities, those of disabled entities included.
    pub fn iter(&self) -> impl Iterator<Item = (Entity, &lariat_ancf::Cable)> {
        self.links.cables.iter().filter_map(|(handle, link)| Some((link.entity, self.set.get(*handle).ok()?)))
    }

    /// Whether the cable of an entity sleeps, together with the bodies attached to it.
    pub fn is_asleep(&self, entity: Entity) -> bool {
        self.handle(entity).is_ok_and(|handle| self.set.is_asleep(handle) == Ok(true))
    }

    /// Returns the handle of an entity's cable in [`set`](Self::set).
    ///
    /// # Errors
    /// [`Error::NotACable`]; [`Error::NotBuilt`] with the reason.
    pub fn handle(&self, entity: Entity) -> Result<CableHandle, Error> {
        match self.links.built.get(&entity) {
            Some(Ok(handle)) => Ok(*handle),
            Some(Err(reason)) => Err(Error::NotBuilt { entity, reason: reason.clone() }),
            None => Err(Error::NotACable(entity)),
        }
    }

    /// Returns the set that owns the cables, to read energy and momentum of the world, and
    /// attachments by their handles.
    pub fn set(&self) -> &CableSet {
        &self.set
    }

    /// Returns the step settings: Rapier steps per host step, and the speed below which cables may
    /// sleep.
    pub fn settings(&self) -> Settings {
        self.set.settings
    }

    /// Changes the step settings.
    pub fn set_settings(&mut self, settings: Settings) {
        self.set.settings = settings;
    }

    /// Whether the host step that began has failed, so that the engine must not step.
    pub fn has_failed(&self) -> bool {
        self.host.as_ref().is_none_or(HostStep::has_failed)
    }

    /// Reports that a host engine cannot step: sends [`StepFailed`] with this error.
    pub fn report_failure(&mut self, error: Error) {
        self.events.push(StepFailed { entity: Entity::PLACEHOLDER, error }.into());
    }

    /// Returns the number of attachments.
    pub fn attachments(&self) -> usize {
        self.set.attachments().count()
    }
}

/// A cable of the set that broke or was cut.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parting {
    pub cable: CableHandle,
    /// The part behind the break.
    pub rest: CableHandle,
    /// Why, where and under which load.
    pub how: Break,
}

/// Which entity stands for which object of the set and of Rapier's world.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    /// In the order of handles, so that no result depends on the order of entities.
    pub cables: BTreeMap<CableHandle, CableLink>,
    /// Handle of each cable entity, or why its cable could not be built.
    pub built: EntityHashMap<Result<CableHandle, lariat_ancf::Error>>,
    pub attachments: BTreeMap<AttachmentHandle, AttachmentLink>,
    pub junctions: BTreeMap<JunctionHandle, JunctionLink>,
    /// By entity.
    pub sheaves: BTreeMap<Entity, SheaveLink>,
    pub bodies: HashMap<RigidBodyHandle, Entity>,
    /// The fixed body to which cables are attached that are attached to the world.
    pub ground: Option<RigidBodyHandle>,
}

/// A cable of the set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CableLink {
    pub entity: Entity,
    /// Unstretched length in m for which shares of effects are meant: that when it was built or broke, whatever reels do.
    pub length: f64,
    /// The cable's counters when they were last read.
    pub counted: lariat_ancf::Diagnostics,
}

/// An attachment of the set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AttachmentLink {
    pub entity: Entity,
    pub cable: Entity,
    /// `None` for the world.
    pub body: Option<Entity>,
    pub handle: RigidBodyHandle,
    /// The component that it was made from.
    pub made: Attachment,
    /// Its work when it was last read, in J.
    pub counted: f64,
}

/// A junction of the set.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JunctionLink {
    pub entity: Entity,
    /// The component that it was made from.
    pub made: Junction,
}

/// A sheave of an entity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SheaveLink {
    /// The component that it was made from.
    pub made: Sheave,
    /// The sheave of the set; `None` if it could not be made or has ended.
    pub handle: Option<SheaveHandle>,
}

impl Links {
    /// Links an entity to its cable.
    pub fn insert_cable(&mut self, entity: Entity, handle: CableHandle, length: f64) {
        self.built.insert(entity, Ok(handle));
        self.cables.insert(handle, CableLink { entity, length, counted: lariat_ancf::Diagnostics::default() });
    }

    /// Unlinks an entity from its cable, and returns the handle if there was one.
    pub fn remove_cable(&mut self, entity: Entity) -> Option<CableHandle> {
        let handle = self.built.remove(&entity)?.ok()?;
        self.cables.remove(&handle);
        Some(handle)
    }

    /// Renames entities.
    pub fn renamed(&self, name: &impl Fn(Entity) -> Entity) -> Links {
        let mut links = self.clone();
        links.built = self.built.iter().map(|(entity, built)| (name(*entity), built.clone())).collect();
        links.cables.values_mut().for_each(|link| link.entity = name(link.entity));
        for link in links.junctions.values_mut() {
            link.entity = name(link.entity);
            link.made.rename(name);
        }
        links.sheaves = self.sheaves.iter().map(|(entity, link)| (name(*entity), *link)).collect();
        links.sheaves.values_mut().for_each(|link| link.made.rename(name));
        links.bodies.values_mut().for_each(|entity| *entity = name(*entity));
        for link in links.attachments.values_mut() {
            (link.entity, link.cable) = (name(link.entity), name(link.cable));
            link.body = link.body.map(name);
        }
        links
    }
}
