//! What is kept of velocities to judge the [length of steps](crate::warning).

use serde::{Deserialize, Serialize};

/// What the velocities of a cable say about its steps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Steps {
    /// Velocities four and two host times ago, when both are known, in m/s.
    pub(crate) before: [Vec<f64>; 2],
    /// How many of them are known.
    pub(crate) known: u8,
    /// Whether a host time has passed since the latter.
    pub(crate) between: bool,
    /// Time in s and integration steps at the last note.
    pub(crate) time: f64,
    /// Host step in s.
    pub(crate) host_step: f64,
    /// Integration steps of the cable when velocities were last kept.
    pub(crate) steps: u64,
    /// Worst so far.
    pub(crate) worst: Estimate,
}

/// Error of a motion per oscillation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Estimate {
    /// In m.
    pub(crate) error: f64,
    /// Time in s.
    pub(crate) time: f64,
    /// Length of the integration steps in s.
    pub(crate) step: f64,
}
