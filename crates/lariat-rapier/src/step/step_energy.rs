//! What the energy balance of a step compares with.

use ::nalgebra::Vector3;
use lariat_ancf::warning::balance::CableTerms;

/// What an island has when a step begins.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepEnergy {
    /// Terms of all cables; `None` if the island is not judged.
    pub start: Option<CableTerms>,
    /// By pin, its gap in m.
    pub gaps: Vec<Vector3<f64>>,
    pub buffer: Vec<f64>,
}
