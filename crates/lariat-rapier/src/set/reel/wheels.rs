//! Drums and sheaves of a set.

use crate::contents::reel::drum::{Drum, Wound};
use crate::contents::reel::sheave::{Sheave, SheaveOptions};
use crate::edit::reel::{drums, sheaves};
use crate::error::Error;
use crate::handle::{CableHandle, SheaveHandle};
use crate::set::CableSet;
use lariat_ancf::{At, Reel};
use rapier::dynamics::RigidBodySet;

impl CableSet {
    /// Winds an end of a cable on a drum: its rate is the spin of the body relative to the one that
    /// holds that end, or to the world. `stock` and `inertia` of the reel are what the drum carries
    /// beside the body's own. Needs the integrator `discrete-gradient`. The drum ends with its
    /// body, and by [`remove_drum`](Self::remove_drum).
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::NoBody`]; [`Error::DrumBody`] for one that is not dynamic;
    /// [`Error::Cable`] for a point that is not an end, an end with a reel, a reel with rates or a
    /// largest force of its own, or an effect that does not go with one. What makes no drum beyond
    /// that is an error of the next step, as is a drum joined to a dynamic body
    /// ([`Error::DrumJoined`]).
    pub fn add_drum(
        &mut self,
        bodies: &RigidBodySet,
        (cable, at): (CableHandle, impl Into<At>),
        drum: Drum,
        reel: Reel,
    ) -> Result<(), Error> {
        let at = at.into();
        let body = bodies.get(drum.body).ok_or(Error::NoBody(drum.body))?;
        if !body.is_dynamic() {
            return Err(Error::DrumBody(drum.body));
        }
        drum.winch((0, true), 0).check()?;
        let reel = Reel { feed: Reel::on_drum().feed, ..reel };
        let start = self.contents.is_start(cable, at)?;
        self.contents.cable_mut(cable)?.add_reel(at, reel)?;
        self.contents.wheels.drums.push(Wound { cable, start, drum });
        self.contents.changed = true;
        Ok(())
    }

    /// Ends the drum at an end of a cable: what is out stays. Returns it, or `None` if there is
    /// none.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn remove_drum(&mut self, cable: CableHandle, at: impl Into<At>) -> Result<Option<Drum>, Error> {
        let start = self.contents.is_start(cable, at.into())?;
        let mut removed = None;
        drums::remove_where(&mut self.contents, |wound| {
            let here = (wound.cable, wound.start) == (cable, start);
            removed = removed.or(here.then_some(wound.drum));
            here
        })?;
        Ok(removed)
    }

    /// Returns the drums with the ends of cables on them.
    pub fn drums(&self) -> impl Iterator<Item = (CableHandle, At, &Drum)> {
        self.contents.wheels.drums.iter().map(|wound| (wound.cable, wound.at(), &wound.drum))
    }

    /// Lets a cable run into another over a sheave: `from` and `to` are ends of cables that are
    /// attached at one point, to a body or to the world. Both need the integrator
    /// `discrete-gradient`, and one mass per length, EA and EI. The sheave ends with one of the
    /// attachments.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::Cable`] for a point that is not an end, an end with a reel, or
    /// an effect that does not go with one. What makes no sheave beyond that is an error of the
    /// next step.
    pub fn add_sheave(
        &mut self,
        from: (CableHandle, impl Into<At>),
        to: (CableHandle, impl Into<At>),
        options: SheaveOptions,
    ) -> Result<SheaveHandle, Error> {
        sheaves::add(&mut self.contents, (from.0, from.1.into()), (to.0, to.1.into()), options)
    }

    /// Ends a sheave: what is on its sides stays there, and nothing runs over it any more.
    ///
    /// # Errors
    /// [`Error::NoSheave`].
    pub fn remove_sheave(&mut self, sheave: SheaveHandle) -> Result<(), Error> {
        sheaves::remove(&mut self.contents, sheave)
    }

    /// Returns a sheave.
    ///
    /// # Errors
    /// [`Error::NoSheave`].
    pub fn sheave(&self, sheave: SheaveHandle) -> Result<&Sheave, Error> {
        self.contents.wheels.sheaves.get(sheave.0 as usize).ok_or(Error::NoSheave(sheave))
    }
}
