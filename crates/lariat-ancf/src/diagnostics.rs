//! What a cable did: counts, so that cost can be read without a clock, and the same on every machine.

use serde::{Deserialize, Serialize};

/// Counts since the cable was built or [`reset`](Diagnostics::reset). Plain data; two runs of the same cable count the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnostics {
    /// Host steps taken.
    pub host_steps: u64,
    /// Integration steps taken inside them.
    pub steps: u64,
    /// Integration steps tried and thrown away.
    pub rejected_steps: u64,
    /// Newton iterations.
    pub newton_iterations: u64,
    /// Factorisations of the step matrix.
    pub factorisations: u64,
    /// Factorisations that met an indefinite matrix and went through the pivoted path.
    pub indefinite_factorisations: u64,
    /// Solves with a factored step matrix.
    pub solves: u64,
    /// Solves with the factored mass matrix.
    pub mass_solves: u64,
    /// Elements whose force alone was evaluated.
    pub force_evaluations: u64,
    /// Elements whose force and tangent were evaluated.
    pub tangent_evaluations: u64,
    /// Elements for which a bending rule ran; zero for a cable without bending.
    pub bending_evaluations: u64,
    /// Point loads evaluated.
    pub load_evaluations: u64,
    /// Elements whose damping force was evaluated; zero for a cable without. The account of a step takes two powers more, not counted.
    #[serde(default)]
    pub damping_evaluations: u64,
    /// Elements whose drag was evaluated; zero for a cable without. The account of a step takes two powers more, not counted.
    #[serde(default)]
    pub drag_evaluations: u64,
    /// Elements for which a rest shape was evaluated; zero for a cable that is straight and unstretched at rest.
    #[serde(default)]
    pub rest_shape_evaluations: u64,
}

impl Diagnostics {
    /// All counts to zero.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Elements evaluated, with or without tangent.
    pub fn element_evaluations(&self) -> u64 {
        self.force_evaluations + self.tangent_evaluations
    }
}
