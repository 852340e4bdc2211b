//! Cables that live outside their set between steps, in the components of an ECS.

use crate::attach::release_body;
use crate::contents::Slot;
use crate::error::Error;
use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle};
use crate::join::remove_cable;
use crate::set::CableSet;
use core::ops::{Deref, DerefMut};
use lariat_ancf::{At, Cable};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// A cable that its set has lent, with what the set knows of it. Reads as the cable; to change it
/// wakes it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Lent {
    handle: CableHandle,
    slot: Box<Slot>,
}

impl Lent {
    /// Its handle in the set.
    pub fn handle(&self) -> CableHandle {
        self.handle
    }

    /// Whether it sleeps with the bodies that it holds.
    pub fn is_asleep(&self) -> bool {
        self.slot.asleep
    }
}

impl Deref for Lent {
    type Target = Cable;

    fn deref(&self) -> &Cable {
        &self.slot.cable
    }
}

impl DerefMut for Lent {
    fn deref_mut(&mut self) -> &mut Cable {
        self.slot.modified = true;
        &mut self.slot.cable
    }
}

impl CableSet {
    /// Takes a cable out, without copying it. Until it is given back the set cannot step;
    /// attachments stay.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::Lent`] if it is out already.
    pub fn lend(&mut self, cable: CableHandle) -> Result<Lent, Error> {
        let contents = &mut self.contents;
        let slot = contents.cables.remove(cable.0 as usize);
        let slot = slot.ok_or_else(|| contents.missing(cable))?;
        let place = contents.lent.partition_point(|&h| h < cable.0);
        contents.lent.insert(place, cable.0);
        Ok(Lent { handle: cable, slot })
    }

    /// Takes a lent cable back.
    ///
    /// # Errors
    /// [`Error::NoCable`] for one that this set has not lent; it is dropped.
    pub fn give_back(&mut self, cable: Lent) -> Result<(), Error> {
        let contents = &mut self.contents;
        let place = contents.lent.binary_search(&cable.handle.0).map_err(|_| Error::NoCable(cable.handle))?;
        contents.lent.remove(place);
        contents.cables.put_back(cable.handle.0 as usize, cable.slot);
        Ok(())
    }

    /// Gives a lent cable up that does not come back: its attachments end, and its part in
    /// junctions.
    ///
    /// # Errors
    /// [`Error::NoCable`] for one that is not lent.
    pub fn forget(&mut self, world: &mut PhysicsWorld, cable: CableHandle) -> Result<(), Error> {
        let contents = &mut self.contents;
        let place = contents.lent.binary_search(&cable.0).map_err(|_| Error::NoCable(cable))?;
        contents.lent.remove(place);
        contents.changed = true;
        for i in 0..contents.attachments.len() {
            if contents.attachments.get(i).is_some_and(|a| a.cable == cable) {
                release_body(contents, world, AttachmentHandle(i as u32))?;
            }
        }
        for i in 0..contents.junctions.len() {
            if !contents.junctions.get(i).is_some_and(|j| j.nodes.iter().any(|(c, _)| *c == cable)) {
                continue;
            }
            for (other, node) in remove_cable(contents, JunctionHandle(i as u32), cable) {
                if other != cable {
                    contents.cable_mut(other)?.detach(At::Node(node))?;
                }
            }
        }
        Ok(())
    }

    /// Cables that are lent, in the order of their handles.
    pub fn lent(&self) -> impl Iterator<Item = CableHandle> {
        self.contents.lent.iter().map(|&h| CableHandle(h))
    }

    /// Whether a cable is lent.
    pub fn is_lent(&self, cable: CableHandle) -> bool {
        self.contents.lent.binary_search(&cable.0).is_ok()
    }
}
