//! Entities of the objects of the set and of Rapier's world.

use crate::attachment::Attachment;
use crate::error::Error;
use crate::junction::Junction;
use crate::saved::pairs;
use crate::sheave::Sheave;
use bevy_ecs::entity::{Entity, EntityHashMap};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::{AttachmentHandle, CableHandle, JunctionHandle, SheaveHandle};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashMap};

/// Which entity stands for which object of the set and of Rapier's world.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Links {
    /// In the order of handles, so that no result depends on the order of entities.
    #[serde(with = "pairs")]
    pub cables: BTreeMap<CableHandle, CableLink>,
    /// Handle of each cable entity, or why its cable could not be built.
    #[serde(with = "builds")]
    pub built: EntityHashMap<Result<CableHandle, lariat_ancf::Error>>,
    #[serde(with = "pairs")]
    pub attachments: BTreeMap<AttachmentHandle, AttachmentLink>,
    #[serde(with = "pairs")]
    pub junctions: BTreeMap<JunctionHandle, JunctionLink>,
    /// By entity.
    #[serde(with = "pairs")]
    pub sheaves: BTreeMap<Entity, SheaveLink>,
    #[serde(with = "bodies")]
    pub bodies: HashMap<RigidBodyHandle, Entity>,
    /// The fixed body to which cables are attached that are attached to the world.
    pub ground: Option<RigidBodyHandle>,
}

/// A cable of the set.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct CableLink {
    pub entity: Entity,
    /// Unstretched length in m for which shares of effects are meant: that when it was built or broke, whatever reels do.
    pub length: f64,
    /// The cable's counters when they were last read.
    pub counted: lariat_ancf::Diagnostics,
}

/// An attachment of the set.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct JunctionLink {
    pub entity: Entity,
    /// The component that it was made from.
    pub made: Junction,
}

/// A sheave of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SheaveLink {
    /// The component that it was made from.
    pub made: Sheave,
    /// The sheave of the set; `None` if it could not be made or has ended.
    pub handle: Option<SheaveHandle>,
}

impl Links {
    /// Returns the handle of an entity's cable.
    pub fn handle(&self, entity: Entity) -> Result<CableHandle, Error> {
        match self.built.get(&entity) {
            Some(Ok(handle)) => Ok(*handle),
            Some(Err(reason)) => Err(Error::NotBuilt { entity, reason: reason.clone() }),
            None => Err(Error::NotACable(entity)),
        }
    }

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

    /// Returns a text in which entities stand for the handles of their bodies.
    pub fn name_entities(&self, text: &str) -> String {
        let name = |text: String, (body, entity): (&RigidBodyHandle, &Entity)| {
            text.replace(&format!("{body:?}"), &format!("of entity {entity}"))
        };
        // most texts have none
        if text.contains("RigidBodyHandle(") {
            self.bodies.iter().fold(text.to_string(), name)
        } else {
            text.to_string()
        }
    }

    /// Renames entities.
    pub fn renamed(&self, name: &(impl Fn(Entity) -> Entity + ?Sized)) -> Links {
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

/// The handles of entities, and those without a cable: the reason is found again.
mod builds {
    use super::{CableHandle, Entity, EntityHashMap, pairs};
    use serde::{Deserializer, Serializer};
    use std::collections::BTreeMap;

    type Built = EntityHashMap<Result<CableHandle, lariat_ancf::Error>>;

    pub fn serialize<S: Serializer>(built: &Built, serializer: S) -> Result<S::Ok, S::Error> {
        let handles = built.iter().map(|(entity, built)| (*entity, built.as_ref().ok().copied()));
        pairs::serialize(&handles.collect(), serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Built, D::Error> {
        let handles: BTreeMap<Entity, Option<CableHandle>> = pairs::deserialize(deserializer)?;
        let unknown = || lariat_ancf::Error::NoSection { cable: "cable".to_string() };
        Ok(handles.into_iter().map(|(entity, handle)| (entity, handle.ok_or_else(unknown))).collect())
    }
}

/// The entities of bodies.
mod bodies {
    use super::{Entity, HashMap, RigidBodyHandle};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    type Bodies = HashMap<RigidBodyHandle, Entity>;

    pub fn serialize<S: Serializer>(bodies: &Bodies, serializer: S) -> Result<S::Ok, S::Error> {
        let mut bodies: Vec<(&RigidBodyHandle, &Entity)> = bodies.iter().collect();
        bodies.sort_by_key(|(handle, _)| handle.into_raw_parts());
        bodies.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Bodies, D::Error> {
        let bodies: Vec<(RigidBodyHandle, Entity)> = Vec::deserialize(deserializer)?;
        Ok(bodies.into_iter().collect())
    }
}
