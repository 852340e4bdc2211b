//! The physics of a world: Rapier's side, the cables' side, and which entity is what.

use crate::attachment::Attachment;
use crate::cable::Cable;
use crate::cable::State;
use crate::error::Error;
use crate::event::{Notice, StepRefused};
use bevy_ecs::change_detection::{DetectChangesMut, Mut};
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::query::Allow;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Query;
use bevy_ecs::world::World;
use core::ops::{Deref, DerefMut};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::pipeline::PhysicsWorld;
use lariat_rapier::{AttachmentHandle, CableHandle, CableSet, HostStep, Lent, Settings};
use std::collections::BTreeMap;

/// Rapier's world. Gravity, the host's time step (`integration_parameters.dt`, in s) and solver settings are its own.
#[derive(Resource, Default)]
pub struct Physics(pub PhysicsWorld);

impl Deref for Physics {
    type Target = PhysicsWorld;
    fn deref(&self) -> &PhysicsWorld {
        &self.0
    }
}

impl DerefMut for Physics {
    fn deref_mut(&mut self) -> &mut PhysicsWorld {
        &mut self.0
    }
}

/// A body by its handle, in the order of handles.
pub(crate) type BodyKey = (u32, u32);

/// What an attachment of the set stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bound {
    pub entity: Entity,
    pub cable: Entity,
    /// None: the world.
    pub body: Option<Entity>,
    pub handle: RigidBodyHandle,
    /// As it was when it was made.
    pub made: Attachment,
    /// Its work when it was counted last, in J.
    pub counted: f64,
}

/// The cables of a world and what they hold to.
#[derive(Resource, Default)]
pub struct Cables {
    pub(crate) set: CableSet,
    pub(crate) links: Links,
    /// Mechanics of cables that went away or were replaced.
    pub(crate) handed_in: Vec<(Entity, Lent)>,
    pub(crate) retired_bodies: Vec<RigidBodyHandle>,
    pub(crate) retired_attachments: Vec<(Entity, AttachmentHandle)>,
    pub(crate) notices: Vec<Notice>,
    pub(crate) host: Option<HostStep>,
    /// Whether cables came since attachments were tried.
    pub(crate) fresh: bool,
}

/// Which entity is what.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    pub cables: BTreeMap<CableHandle, Entity>,
    pub attachments: BTreeMap<AttachmentHandle, Bound>,
    pub bodies: BTreeMap<BodyKey, Entity>,
    /// The body that stands for the world.
    pub ground: Option<RigidBodyHandle>,
}

impl Cables {
    /// How cables step: Rapier steps per host step, and the speed below which they may sleep.
    pub fn settings(&self) -> Settings {
        self.set.settings
    }

    /// Changes how cables step.
    pub fn set_settings(&mut self, settings: Settings) {
        self.set.settings = settings;
    }

    /// Whether the step that began was refused: there is nothing for the engine to step.
    pub fn is_refused(&self) -> bool {
        self.host.as_ref().is_none_or(HostStep::has_failed)
    }

    /// Refuses a step from outside, with the reason.
    pub fn refuse(&mut self, reason: impl Into<String>) {
        let event = StepRefused { entity: Entity::PLACEHOLDER, error: Error::Engine(reason.into()) };
        self.notices.push(Notice::Refused(event));
    }

    /// Number of attachments that hold.
    pub fn attachments(&self) -> usize {
        self.set.attachments().count()
    }
}

/// All cables, those of disabled entities too: they go on.
pub(crate) type AllCables<'w, 's> = Query<'w, 's, &'static mut Cable, Allow<Disabled>>;

/// Takes all cables from their components for a step, or for a change of the set.
pub(crate) fn bring_home(cables: &mut Cables, of: &mut AllCables) {
    for mut cable in of.iter_mut() {
        let state = &mut cable.bypass_change_detection().state;
        if let State::Lent(_) = state
            && let State::Lent(lent) = core::mem::replace(state, State::Away)
        {
            // a component that was copied, or comes from another world, holds a cable that the set does not know
            if cables.set.give_back(lent).is_err() {
                *state = State::Planned;
            }
        }
    }
}

/// Gives all cables of the set to their components.
pub(crate) fn lend_out(cables: &mut Cables, of: &mut AllCables) {
    let Cables { set, links, .. } = cables;
    for (handle, entity) in &links.cables {
        let Ok(mut cable) = of.get_mut(*entity) else { continue };
        if let Ok(lent) = set.lend(*handle) {
            cable.bypass_change_detection().state = State::Lent(lent);
        }
    }
}

/// Runs `action` on the cables of a world and their components.
pub(crate) fn with_cables<T>(world: &mut World, action: impl FnOnce(&mut Cables, &mut AllCables) -> T) -> T {
    let mut query = world.query_filtered::<&mut Cable, Allow<Disabled>>();
    world.resource_scope(|world, mut cables: Mut<Cables>| action(&mut cables, &mut query.query_mut(world)))
}
