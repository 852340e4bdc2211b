//! The contacts of the cables of a set.

use super::CableSet;
use crate::contact::collider;
use crate::contact::pull::kept_by_others;
use crate::contents::rules::{ContactFilter, ContactRules};
use crate::error::Error;
use crate::handle::CableHandle;
use lariat_ancf::Contact;
use lariat_ancf::contact::{PairTouch, Touch};
use lariat_ancf::coupling::Coupling;
use rapier::geometry::ColliderHandle;

impl CableSet {
    /// Lets a cable touch the colliders of the world, and other cables and itself if the contact
    /// says so, or no longer with `None`. Needs the method `discrete-gradient`, which a cable gets
    /// if nobody chose its integrator. The cable's own friction is combined with that of a collider
    /// as [`set_contact_rules`](Self::set_contact_rules) say. So is its restitution.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::Cable`] for numbers out of range, for a cable without a
    /// diameter or a radius, and for another method.
    pub fn set_contact(&mut self, cable: CableHandle, contact: impl Into<Option<Contact>>) -> Result<(), Error> {
        Ok(self.contents.cable_mut(cable)?.set_contact(contact)?)
    }

    /// Sets the groups of a cable, and how its friction and restitution are combined, for its
    /// contacts with colliders and other cables.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn set_contact_rules(&mut self, cable: CableHandle, rules: ContactRules) -> Result<(), Error> {
        let slot = self.contents.cables.get_mut(cable.0 as usize).ok_or(Error::NoCable(cable))?;
        (slot.rules, slot.modified) = (rules, true);
        Ok(())
    }

    /// Sets a function that decides which colliders cables may touch, beyond their groups; it is no
    /// part of a snapshot.
    pub fn set_contact_filter(&mut self, filter: Option<ContactFilter>) {
        self.stepper.finder.filter = filter;
        self.contents.cables.values_mut().for_each(|slot| slot.modified = true);
    }

    /// Returns the contacts of a cable at the end of the last step, each with its collider.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn contacts(&self, cable: CableHandle) -> Result<impl Iterator<Item = (ColliderHandle, Touch)>, Error> {
        Ok(self.get(cable)?.contacts().map(|touch| (collider(touch.obstacle), touch)))
    }

    /// Returns the contacts of a cable with others and with itself at the end of the last step,
    /// each with the other cable. Needs [`Contact::with_cables`].
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn cable_contacts(&self, cable: CableHandle) -> Result<Vec<(CableHandle, PairTouch)>, Error> {
        let own = self.get(cable)?;
        let handle = |key: u64| self.iter().find(|(_, other)| other.contact_key() == key).map(|(handle, _)| handle);
        let kept = own.cable_contacts().filter_map(|touch| Some((handle(touch.other)?, touch)));
        let all = 0..self.contents.cables.len();
        let mirrored = kept_by_others(&self.contents, all, cable.0 as usize);
        let mirrored = mirrored.map(|(other, touch)| (CableHandle(other as u32), touch));
        Ok(kept.chain(mirrored).collect())
    }
}
