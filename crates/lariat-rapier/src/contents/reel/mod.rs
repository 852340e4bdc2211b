//! What a cable runs over, and what it is wound on.

pub(crate) mod drum;
pub(crate) mod sheave;

use super::Table;
use crate::handle::CableHandle;
use drum::Wound;
use rapier::dynamics::RigidBodyHandle;
use serde::{Deserialize, Serialize};
use sheave::Sheave;

/// The wheels of a set: its sheaves and drums.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Wheels {
    pub sheaves: Table<Sheave>,
    pub drums: Vec<Wound>,
}

impl Wheels {
    /// Returns the cables on drums with the bodies that these are.
    pub fn bodies(&self) -> impl Iterator<Item = (CableHandle, RigidBodyHandle)> {
        self.drums.iter().map(|wound| (wound.cable, wound.drum.body))
    }

    /// Returns the cables that run over sheaves or are on drums, some of them more than once.
    pub fn cables(&self) -> impl Iterator<Item = CableHandle> {
        let over = self.sheaves.values().flat_map(|sheave| sheave.ends).map(|(cable, _)| cable);
        over.chain(self.bodies().map(|(cable, _)| cable))
    }

    /// Returns the cables that a cable runs into over sheaves, and itself with them.
    pub fn beside(&self, cable: CableHandle) -> impl Iterator<Item = CableHandle> {
        let of = move |sheave: &&Sheave| sheave.ends.iter().any(|(c, _)| *c == cable);
        self.sheaves.values().filter(of).flat_map(|sheave| sheave.ends).map(|(cable, _)| cable)
    }
}
