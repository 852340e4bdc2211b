//! What the search for contacts sees of a step.

use super::path::BodyPath;
use crate::model::Model;
use crate::one_leg::OneLeg;
use crate::state::ContactMemory;

/// A step of a cable, as the search sees it.
pub(crate) struct Motion<'a> {
    pub model: &'a Model,
    pub time: f64,
    pub h: f64,
    pub leg: OneLeg,
    pub q: &'a [f64],
    /// Velocities when the step begins.
    pub v: &'a [f64],
    /// Change of the coordinates in the first iterate.
    pub change: &'a [f64],
    pub memory: &'a [ContactMemory],
    /// Power in W of contacts in the last step that may close offsets.
    pub lost: f64,
    /// The bodies of the island as they move in the first iterate.
    pub bodies: &'a [BodyPath],
}
