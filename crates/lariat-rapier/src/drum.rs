//! Drums of a set: bodies whose spin pays cable out and takes it in.

use crate::contents::Contents;
use crate::convert::vector;
use crate::error::Error;
use crate::handle::CableHandle;
use crate::set::CableSet;
use ::nalgebra::Vector3;
use lariat_ancf::island::Drum as Winch;
use lariat_ancf::{At, Reel};
use rapier::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier::math::{Real, Vector};
use serde::{Deserialize, Serialize};

/// A body that turns as the end of a cable runs, which feels its pull: torque or a motor on its joint hoist a load, and without one it runs free.
/// The body turns about an axis through its centre of mass: by an impulse joint to a fixed or kinematic body, or with its other axes locked.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drum {
    /// The dynamic body.
    pub body: RigidBodyHandle,
    /// Axis in its frame, of any length: positive spin about it pays out.
    pub axis: Vector,
    /// Radius in m at which the cable leaves.
    pub radius: Real,
}

/// A drum, and the end of the cable on it.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Wound {
    pub cable: CableHandle,
    start: bool,
    pub drum: Drum,
}

impl Wound {
    fn at(&self) -> At {
        if self.start { At::Start } else { At::End }
    }

    /// Returns it for an island with these cables and, at an index, its body.
    pub fn within(&self, cables: &[usize], body: usize) -> Option<Winch> {
        let cable = cables.iter().position(|&c| c == self.cable.0 as usize)?;
        let axis = vector(self.drum.axis).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        Some(Winch { cable: (cable, self.start), body, axis, radius: f64::from(self.drum.radius) })
    }
}

impl CableSet {
    /// Winds an end of a cable on a drum: its rate is the spin of the body relative to the one that holds that end, or to the world. `stock` and
    /// `inertia` of the reel are what the drum carries beside the body's own. Needs the integrator `discrete-gradient`. The drum ends with its
    /// body, and by [`remove_drum`](Self::remove_drum).
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::NoBody`]; [`Error::DrumBody`] for one that is not dynamic; [`Error::Cable`] for a point that is not an end, an end
    /// with a reel, a reel with rates or a largest force of its own, or an effect that does not go with one. What makes no drum beyond that is
    /// an error of the next step, as is a drum joined to a dynamic body ([`Error::DrumJoined`]).
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
        let reel = Reel { feed: Reel::on_drum().feed, ..reel };
        self.contents.cable_mut(cable)?.add_reel(at, reel)?;
        self.contents.drums.push(Wound { cable, start: at == At::Start, drum });
        self.contents.changed = true;
        Ok(())
    }

    /// Ends the drum at an end of a cable: what is out stays. Returns it, or `None` if there is none.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn remove_drum(&mut self, cable: CableHandle, at: impl Into<At>) -> Result<Option<Drum>, Error> {
        self.contents.cable(cable)?;
        let start = at.into() == At::Start;
        let mut removed = None;
        remove_where(&mut self.contents, |wound| {
            let here = (wound.cable, wound.start) == (cable, start);
            removed = removed.or(here.then_some(wound.drum));
            here
        })?;
        Ok(removed)
    }

    /// Returns the drums with the ends of cables on them.
    pub fn drums(&self) -> impl Iterator<Item = (CableHandle, At, &Drum)> {
        self.contents.drums.iter().map(|wound| (wound.cable, wound.at(), &wound.drum))
    }
}

/// Ends the drums that `ends` names, and the reels on them.
fn remove_where(contents: &mut Contents, mut ends: impl FnMut(&Wound) -> bool) -> Result<(), Error> {
    for i in (0..contents.drums.len()).rev() {
        let wound = contents.drums[i];
        if ends(&wound) {
            contents.drums.remove(i);
            contents.changed = true;
            if let Ok(cable) = contents.cable_mut(wound.cable) {
                cable.remove_reel(wound.at())?;
            }
        }
    }
    Ok(())
}

/// Ends the drums of a cable that is removed.
pub(crate) fn remove_of(contents: &mut Contents, cable: CableHandle) -> Result<(), Error> {
    remove_where(contents, |wound| wound.cable == cable)
}

/// Ends the drums whose bodies were removed from the world.
pub(crate) fn end_lost(contents: &mut Contents, bodies: &RigidBodySet) -> Result<(), Error> {
    remove_where(contents, |wound| !bodies.contains(wound.drum.body))
}

/// Gives the drum at the end of a cable that was cut to the part behind the cut.
pub(crate) fn follow_cut(contents: &mut Contents, cable: CableHandle, tail: CableHandle) {
    for wound in contents.drums.iter_mut().filter(|wound| wound.cable == cable && !wound.start) {
        wound.cable = tail;
    }
}
