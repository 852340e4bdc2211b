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

use crate::error::Error;
use crate::event::{QueuedEvent, StepFailed};
use crate::links::Links;
use bevy_ecs::entity::Entity;
use bevy_ecs::resource::Resource;
use lariat_ancf::warning::Interface;
use lariat_ancf::{At, Break};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::math::Pose;
use lariat_rapier::rapier::pipeline::PhysicsWorld;
use lariat_rapier::{CableHandle, CableSet, Equilibrium, Event, HostStep, Settings};

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

    /// Moves bodies by a rigid motion in world axes, with the cables that are attached to them, as
    /// [`CableSet::move_bodies`] does: a teleport without a jolt.
    ///
    /// # Errors
    /// [`Error::Coupling`]; nothing has moved then.
    pub fn move_bodies(
        &mut self,
        world: &mut PhysicsWorld,
        bodies: &[RigidBodyHandle],
        by: &Pose,
    ) -> Result<(), Error> {
        Ok(self.set.move_bodies(world, bodies, by)?)
    }

    /// Moves the cables that were built, and the bodies on them, to static equilibrium, as
    /// [`CableSet::equilibrium`] does. Cables are built, and attached, before a host step.
    ///
    /// # Errors
    /// [`Error::Coupling`]; all is then as before.
    pub fn equilibrium(&mut self, world: &mut PhysicsWorld) -> Result<Equilibrium, Error> {
        Ok(self.set.equilibrium(world)?)
    }

    /// Takes the events of cables that broke or were cut from the set.
    fn take_partings(&mut self) {
        let parting = |event| match event {
            Event::Broken { cable, rest, how } => Some(Parting { cable, rest, how }),
            _ => None,
        };
        self.broken.extend(self.set.take_events().into_iter().filter_map(parting));
    }

    /// Returns what is to be said about all cables in a world, by level, in the words of Bevy: the
    /// [warnings of the set](lariat_rapier::CableSet::warnings). Worth a look when a scene has been
    /// built.
    pub fn warnings(&self, world: &PhysicsWorld) -> Vec<String> {
        let text = |warning| self.links.name_entities(&Interface::Bevy.text(&warning));
        self.set.warnings(world).into_iter().map(text).collect()
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
        self.links.handle(entity)
    }

    /// Returns what the sheave of an entity did so far: what passed, its friction, what that took.
    ///
    /// # Errors
    /// [`Error::NotASheave`], also if it could not be made or has ended.
    pub fn sheave(&self, entity: Entity) -> Result<&lariat_rapier::Sheave, Error> {
        let handle = self.links.sheaves.get(&entity).and_then(|link| link.handle);
        handle.and_then(|handle| self.set.sheave(handle).ok()).ok_or(Error::NotASheave(entity))
    }

    /// Returns the parts of a cable that runs over [sheaves along it](crate::SheaveAlong), from start to end; the cable alone if it runs over
    /// none.
    ///
    /// # Errors
    /// [`Error::NotACable`]; [`Error::NotBuilt`] with the reason.
    pub fn parts(&self, entity: Entity) -> Result<Vec<Entity>, Error> {
        let parts = self.set.parts(self.handle(entity)?)?;
        Ok(parts.iter().filter_map(|part| self.links.cables.get(part)).map(|link| link.entity).collect())
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
