//! Cables that live outside their set between steps, in the components of an ECS.

use crate::set::{CableSet, Slot};
use crate::{CableHandle, Error};
use core::ops::{Deref, DerefMut};
use lariat_ancf::Cable;
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
