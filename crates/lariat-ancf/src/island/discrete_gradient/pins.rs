//! What pins and clamps hold, as a term of a step. Equations: [`holds`](super::holds).
//!
//! Their residuals and works are added with those of the [cables](super::cables), whose rows hold
//! them.

use super::IslandStep;
use crate::term::{StepStart, StepTerm};

/// Held coordinates and mounted obstacles, which are where their bodies are.
pub(super) struct Pins;

impl StepTerm<IslandStep<'_, '_>> for Pins {
    fn name(names: &mut Vec<&'static str>) {
        names.push("pins");
    }

    fn begin(island: &mut IslandStep<'_, '_>, _: &StepStart) {
        island.follow();
    }
}
