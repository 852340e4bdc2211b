//! An entity of a snapshot with its components.

use super::changes::{PutBack, Watched};
use crate::attachment::{Attached, Attachment, AttachmentReading, BreakForce, NotAttachable, OnCable, ToBody};
use crate::body::{Body, BodyHandle, BodyPose, KinematicTarget};
use crate::cable::Cable;
use crate::components::{CableComponents, put};
use crate::interpolate::Interpolate;
use crate::junction::{Joined, Junction, NotJoinable};
use crate::kink::KinkAlong;
use crate::mesh::RopeMesh;
use crate::passing::SheaveAlong;
use crate::pending::Pending;
use crate::saved::maybe;
use crate::sheave::Sheave;
use crate::water::InWater;
use bevy_ecs::change_detection::Tick;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::name::Name;
use bevy_ecs::world::{EntityRef, EntityWorldMut, World};
use serde::{Deserialize, Serialize};

/// An entity with its components.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Saved {
    pub entity: Entity,
    disabled: bool,
    /// Those that no host step has seen yet since they changed.
    changed: Vec<Watched>,
    pub on: Option<OnCable>,
    to: Option<ToBody>,
    body: Option<Body>,
    junction: Option<Junction>,
    sheave: Option<Sheave>,
    along: Option<SheaveAlong>,
    kink: Option<KinkAlong>,
    cable: CableComponents,
    plain: Plain,
}

impl Saved {
    /// Copies the components of an entity.
    pub fn of(entity: EntityRef, pending: &Pending, now: Tick) -> Self {
        Saved {
            entity: entity.id(),
            disabled: entity.contains::<Disabled>(),
            changed: Watched::changed(entity, pending, now),
            on: entity.get().copied(),
            to: entity.get().copied(),
            body: entity.get().cloned(),
            junction: entity.get().cloned(),
            sheave: entity.get().copied(),
            along: entity.get().copied(),
            kink: entity.get().copied(),
            cable: CableComponents::of(entity),
            plain: Plain::of(entity),
        }
    }

    /// Spawns an entity for it, without its components.
    pub fn spawn(&self, world: &mut World) -> Entity {
        if self.disabled { world.spawn(Disabled).id() } else { world.spawn_empty().id() }
    }

    /// Renames entities, itself among them.
    pub fn rename(&mut self, name: &(impl Fn(Entity) -> Entity + ?Sized)) {
        self.entity = name(self.entity);
        self.on = self.on.map(|on| OnCable(name(on.0)));
        self.to = self.to.map(|to| ToBody(name(to.0)));
        if let Some(junction) = &mut self.junction {
            junction.rename(name);
        }
        if let Some(sheave) = &mut self.sheave {
            sheave.rename(name);
        }
        self.along = self.along.map(|along| along.renamed(name));
        self.kink = self.kink.map(|kink| kink.renamed(name));
        self.cable.rename(name);
    }

    /// Gives its entity its components.
    pub fn put(self, world: &mut World) {
        let alive = |entity: Entity| world.get_entity(entity).is_ok();
        let on = self.on.filter(|on| alive(on.0));
        let to = self.to.filter(|to| alive(to.0));
        let Ok(mut entity) = world.get_entity_mut(self.entity) else { return };
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
        put(&mut entity, self.junction);
        put(&mut entity, self.sheave);
        put(&mut entity, self.along);
        put(&mut entity, self.kink);
        put(&mut entity, on);
        put(&mut entity, to);
        self.cable.put(&mut entity);
        self.plain.put(&mut entity);
    }

    /// Has the components of its entity count as changed that had changed.
    pub fn settle(&self, world: &mut World, entity: Entity, put_back: &mut PutBack) {
        Watched::settle(world, entity, &self.changed, put_back);
    }
}

macro_rules! plain {
    ($($field:ident: $type:ty),* $(,)?) => {
        /// Components that are saved as they are, besides those of [`CableComponents`].
        #[derive(Clone, Serialize, Deserialize)]
        struct Plain { $(#[serde(with = "maybe")] $field: Option<$type>),* }

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
    in_water: InWater, body_handle: BodyHandle, attached: Attached, joined: Joined, not_joinable: NotJoinable,
}
