//! What a cable did: counts, so that cost can be read without a clock, and the same on every
//! machine.

use crate::effect::EffectCounts;
use crate::term::ReasonCounts;
use core::ops::AddAssign;
use serde::{Deserialize, Serialize};

/// Counts since the cable was built or [`reset`](Diagnostics::reset). Plain data; two runs of the
/// same cable count the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
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
    /// Elements whose load was compared with the [limits](crate::Cable::set_strength) of the cable;
    /// zero for a cable without limits.
    #[serde(default)]
    pub load_readings: u64,
    /// Tests of whether pieces of a cable are near each other, other cables, obstacles and their
    /// edges and corners; those with cables are counted by the first one of an island, and are
    /// fewer where a tree of boxes is kept, which results do not depend on. Zero for a cable
    /// without contact.
    #[serde(default)]
    pub search_tests: u64,
    /// Steps of the discrete gradient whose velocities were scaled down to keep its energy law.
    #[serde(default)]
    pub rescaled_steps: u64,
    /// Steps of the discrete gradient that were divided to keep its energy law.
    #[serde(default)]
    pub split_steps: u64,
    /// Steps of the discrete gradient in which centre lines of cables went through each other, or
    /// through thin parts of obstacles.
    #[serde(default)]
    pub crossed_steps: u64,
    /// Steps of the discrete gradient at the end of which it touched another cable or itself.
    #[serde(default)]
    pub touching_steps: u64,
    /// Steps of the discrete gradient whose friction did not settle on the normal forces of the
    /// step itself.
    #[serde(default)]
    pub lagging_steps: u64,
    /// Steps of the discrete gradient under a tolerance that were accepted at the shortest length,
    /// a 64th of the host step, with an estimated error above the tolerance.
    #[serde(default)]
    pub unresolved_steps: u64,
    /// Steps of the discrete gradient that were accepted although their iteration had not come to
    /// its end: the energy law holds, but forces of contacts are not those of their law, or bodies
    /// have not the momentum that forces give them. Counted by the first cable of an island.
    #[serde(default)]
    pub unsolved_steps: u64,
    /// Host steps whose accuracy was reduced because a [limit](crate::integrate::WorkLimit) to the
    /// work was reached.
    #[serde(default)]
    pub cut_steps: u64,
    /// Pairs of neighbouring directions that turned by more than 120 degrees to each other or in a
    /// step, at which the twist of a cable with torsion is not kept.
    #[serde(default)]
    pub twist_slips: u64,
    /// Newton iterations of the discrete gradient beyond the first one of a step, by the reason for
    /// them.
    #[serde(default)]
    pub iterations_for: ReasonCounts,
    /// Divisions of its steps, by the reason for them.
    #[serde(default)]
    pub divisions_for: ReasonCounts,
    /// [Warnings](crate::Cable::warnings) that came up in host steps, each kind once; zero for a
    /// cable that is not [watched](crate::Cable::set_watched).
    #[serde(default)]
    pub warnings: u64,
    /// Elements for which each effect was evaluated; zero for effects that are absent. The work of
    /// a step takes two powers more, not counted.
    #[serde(default)]
    pub effects: EffectCounts,
}

/// Applies `$op` field by field; the rest is given.
macro_rules! by_field {
    ($a:expr, $b:expr, $op:expr, $rest:expr) => {
        by_field!(@ $a, $b, $op, $rest; host_steps, steps, rejected_steps, newton_iterations, factorisations,
            indefinite_factorisations, solves, mass_solves, force_evaluations, tangent_evaluations, bending_evaluations,
            load_evaluations, load_readings, search_tests, rescaled_steps, split_steps, crossed_steps, touching_steps, lagging_steps,
            unresolved_steps, unsolved_steps, cut_steps, twist_slips, warnings)
    };
    (@ $a:expr, $b:expr, $op:expr, $rest:expr; $($field:ident),*) => {
        Diagnostics { $($field: $op($a.$field, $b.$field),)* ..$rest }
    };
}

impl AddAssign for Diagnostics {
    fn add_assign(&mut self, other: Self) {
        self.effects += other.effects;
        self.iterations_for += other.iterations_for;
        self.divisions_for += other.divisions_for;
        *self = by_field!(self, other, |a: u64, b: u64| a + b, *self);
    }
}

impl Diagnostics {
    /// What was counted after `earlier`; zero where it was reset since.
    pub fn since(&self, earlier: &Self) -> Self {
        let rest = Diagnostics {
            effects: self.effects.since(&earlier.effects),
            iterations_for: self.iterations_for.since(&earlier.iterations_for),
            divisions_for: self.divisions_for.since(&earlier.divisions_for),
            ..*self
        };
        by_field!(self, earlier, u64::saturating_sub, rest)
    }

    /// All counts to zero.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Elements evaluated, with or without tangent.
    pub fn element_evaluations(&self) -> u64 {
        self.force_evaluations + self.tangent_evaluations
    }
}
