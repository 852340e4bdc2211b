//! Cables that live outside their set between steps, in the components of an ECS.

use crate::set::{CableSet, Slot};
use crate::{AttachmentHandle, CableHandle, Error};
use core::ops::{Deref, DerefMut};
use lariat_ancf::{At, Cable};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// A cable that its set has lent, with what the set knows of it. Reads as the cable; to change it wakes it.
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
        self.slot.stirred = true;
        &mut self.slot.cable
    }
}

impl CableSet {
    /// Takes a cable out, without copying it. Until it is given back the set cannot step; attachments stay.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::Lent`] if it is out already.
    pub fn lend(&mut self, cable: CableHandle) -> Result<Lent, Error> {
        let slot = self.cables.get_mut(cable.0 as usize).and_then(Option::take);
        let slot = slot.ok_or_else(|| self.missing(cable))?;
        let place = self.lent.partition_point(|&h| h < cable.0);
        self.lent.insert(place, cable.0);
        Ok(Lent { handle: cable, slot })
    }

    /// Takes a lent cable back.
    ///
    /// # Errors
    /// [`Error::NoCable`] for one that this set has not lent; it is dropped.
    pub fn give_back(&mut self, cable: Lent) -> Result<(), Error> {
        let place = self.lent.binary_search(&cable.handle.0).map_err(|_| Error::NoCable(cable.handle))?;
        self.lent.remove(place);
        self.cables[cable.handle.0 as usize] = Some(cable.slot);
        Ok(())
    }

    /// Gives a lent cable up that does not come back: its attachments end, and its part in junctions.
    ///
    /// # Errors
    /// [`Error::NoCable`] for one that is not lent.
    pub fn forget(&mut self, world: &mut PhysicsWorld, cable: CableHandle) -> Result<(), Error> {
        let place = self.lent.binary_search(&cable.0).map_err(|_| Error::NoCable(cable))?;
        self.lent.remove(place);
        self.stale = true;
        for i in 0..self.attachments.len() {
            if self.attachments[i].as_ref().is_some_and(|a| a.cable == cable) {
                self.end(world, AttachmentHandle(i as u32))?;
            }
        }
        let mut freed = Vec::new();
        for slot in &mut self.junctions {
            let Some(junction) = slot else { continue };
            let own: Vec<bool> = junction.nodes.iter().map(|(c, _)| *c == cable).collect();
            if !own.contains(&true) {
                continue;
            }
            let mut keep = own.iter().map(|own| !own);
            junction.nodes.retain(|_| keep.next().unwrap_or(true));
            let mut keep = own.iter().map(|own| !own);
            junction.arc_lengths.retain(|_| keep.next().unwrap_or(true));
            junction.memory = None;
            if junction.nodes.len() < 2 {
                freed.append(&mut junction.nodes);
                *slot = None;
            }
        }
        for (other, node) in freed {
            self.get_mut(other)?.detach(At::Node(node))?;
        }
        Ok(())
    }

    /// Cables that are lent, in the order of their handles.
    pub fn lent(&self) -> impl Iterator<Item = CableHandle> {
        self.lent.iter().map(|&h| CableHandle(h))
    }

    /// Whether a cable is lent.
    pub fn is_lent(&self, cable: CableHandle) -> bool {
        self.lent.binary_search(&cable.0).is_ok()
    }

    /// Why a cable is not here.
    pub(crate) fn missing(&self, cable: CableHandle) -> Error {
        if self.is_lent(cable) { Error::Lent(cable) } else { Error::NoCable(cable) }
    }

    /// That all cables are here.
    pub(crate) fn complete(&self) -> Result<(), Error> {
        self.lent.first().map_or(Ok(()), |&h| Err(Error::Lent(CableHandle(h))))
    }
}
