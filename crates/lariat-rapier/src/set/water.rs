//! The water that the bodies of a set's world are in: see [`crate::water`].

use super::CableSet;
use crate::water::BodiesInWater;

impl CableSet {
    /// Gives the set bodies in water, and returns those that it had: their forces act in all of its
    /// steps, beside those of the user, which stay as they are. They are part of its snapshots. The
    /// time of the water is that of the cables; without cables, that of the steps. `None` takes the
    /// water away, but not the added masses of its bodies: [remove](BodiesInWater::remove) those
    /// before. Default: none.
    pub fn set_water(&mut self, water: impl Into<Option<BodiesInWater>>) -> Option<BodiesInWater> {
        let new = water.into().map(Box::new);
        core::mem::replace(&mut self.contents.water, new).map(|before| *before)
    }

    /// Returns the water, if there is any.
    pub fn water(&self) -> Option<&BodiesInWater> {
        self.contents.water.as_deref()
    }

    /// Returns the water, to change it, or the bodies that are in it.
    pub fn water_mut(&mut self) -> Option<&mut BodiesInWater> {
        self.contents.water.as_deref_mut()
    }
}
