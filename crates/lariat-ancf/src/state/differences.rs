//! What the [discrete gradient](crate::integrate::discrete_gradient) carries from step to step.

use serde::{Deserialize, Serialize};

/// Changes of velocities and coordinates over the last step: what the discrete gradient carries to
/// the next one. Plain data, part of a snapshot.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Differences {
    /// Change of velocities, flat as these; empty if the state was not the result of a step of this
    /// method.
    pub velocity: Vec<f64>,
    /// Change of coordinates, flat as these; empty as above.
    pub displacement: Vec<f64>,
    /// Length of the step in s.
    pub step: f64,
    /// Dissipation a of its formula.
    #[serde(default = "crate::one_leg::of_games")]
    pub dissipation: f64,
    /// Linear momentum in kg m/s and angular momentum in kg m^2/s that this and earlier steps took
    /// and that are still to be restored (`system/angular.rs`).
    pub owed: [f64; 6],
    /// Revision of the system's description at that step.
    pub revision: u64,
}

impl Differences {
    /// Forgets the last step: the next one begins without memory.
    pub(crate) fn clear(&mut self) {
        self.velocity.clear();
        self.displacement.clear();
        self.step = 0.0;
        self.owed = [0.0; 6];
        self.revision = 0;
    }

    /// Returns the length in s of the last step, if there was one.
    pub(crate) fn length(&self) -> Option<f64> {
        (!self.is_empty() && self.step > 0.0).then_some(self.step)
    }

    /// Returns whether there is no last step.
    pub(crate) fn is_empty(&self) -> bool {
        self.velocity.is_empty()
    }

    /// Copies `other` into the existing vectors.
    pub(crate) fn copy_from(&mut self, other: &Differences) {
        self.velocity.clone_from(&other.velocity);
        self.displacement.clone_from(&other.displacement);
        self.step = other.step;
        self.dissipation = other.dissipation;
        self.owed = other.owed;
        self.revision = other.revision;
    }
}
