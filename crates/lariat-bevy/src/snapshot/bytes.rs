//! Snapshots as bytes: MessagePack under a [seal](lariat_ancf::seal), and what of a snapshot is
//! checked before it is taken for one.

use super::Snapshot;
use crate::error::Error;
use bevy_ecs::entity::Entity;
use lariat_ancf::seal::{seal, unseal};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeSet;

/// What the seal says that it is around.
const KIND: &str = "bevy snapshot";

impl Snapshot {
    /// Returns the snapshot as bytes under a seal with the version of this package and a checksum, to
    /// read with [`from_bytes`](Self::from_bytes). The same state has the same bytes.
    ///
    /// # Errors
    /// [`Error::NotWritten`] for a collider with a shape of your own, which Rapier does not save.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let body = rmp_serde::to_vec_named(self).map_err(|reason| Error::NotWritten(reason.to_string()))?;
        Ok(seal(KIND, &body))
    }

    /// Reads a snapshot from the bytes of [`to_bytes`](Self::to_bytes). Its
    /// [`restore`](Self::restore) spawns all of its entities anew.
    ///
    /// # Errors
    /// [`Error::Seal`] for bytes that are damaged, cut off, of another kind or of another version;
    /// [`Error::NotASnapshot`] for what is sealed and yet no snapshot.
    pub fn from_bytes(bytes: &[u8]) -> Result<Snapshot, Error> {
        rmp_serde::from_slice(unseal(KIND, bytes)?).map_err(|reason| Error::NotASnapshot(reason.to_string()))
    }

    /// Returns what contradicts itself.
    fn contradiction(&self) -> Option<String> {
        let entities: BTreeSet<Entity> = self.entities.iter().map(|saved| saved.entity).collect();
        if entities.len() < self.entities.len() {
            return Some("an entity is there more than once".to_string());
        }
        let lost = self.links.cables.keys().find(|cable| self.set.get(**cable).is_err());
        if let Some(cable) = lost {
            return Some(format!("{cable:?} is not in the set of cables"));
        }
        let mut built = self.links.built.iter();
        let is_linked = |entity, cable| self.links.cables.get(cable).is_some_and(|link| link.entity == entity);
        let apart = built.find(|(entity, built)| built.as_ref().is_ok_and(|cable| !is_linked(**entity, cable)));
        apart.map(|(entity, _)| format!("the cable of entity {entity} is that of another"))
    }
}

impl Serialize for Snapshot {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // the function that is derived
        Snapshot::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for Snapshot {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        // the function that is derived, which checks nothing
        let snapshot = Snapshot::deserialize(deserializer)?;
        snapshot.contradiction().map_or(Ok(snapshot), |wrong| Err(D::Error::custom(wrong)))
    }
}
