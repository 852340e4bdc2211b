//! Sheaves in statics: material runs over them until their pulls balance.
//!
//! # Equation
//!
//! With the pulls F of both cables at a sheave and the friction b of its wheel
//! (`system/reel/wheel.rs`), the length u that runs over each sheave is such that
//!
//! ```text
//! r = F_b - F_a - P = 0        |P| <= b
//! ```
//!
//! Within its friction a sheave holds and nothing runs; else P is at its bound, as after a slow
//! slide. r is a function of the lengths of all sheaves, each value of it an equilibrium; the
//! lengths are found by Broyden's method, from the elastic stiffness of the cables on.
//!
//! # Validity
//!
//! Where all of a cable has run over and the pulls are still unequal, there is no equilibrium.
//!
//! # References
//!
//! Dennis & Schnabel 1983, chapter 8 (Broyden's method).
//!
//! # Alternatives considered
//!
//! The lengths as unknowns of the search itself: elements are split and merged while it runs.

use super::super::pin::PinConstraint;
use crate::cable::Cable;
use crate::element::side::Side;
use crate::error::{EquilibriumFailure, Error};
use crate::island::reel::Sheave;
use crate::scales::statics::{MAX_PASSES, MOST_PASSED};
use nalgebra::{DMatrix, DVector};

/// The lengths that run over the sheaves of an island.
pub(super) struct Passing<'a> {
    sheaves: &'a [Sheave],
    /// Derivative of the residuals by the lengths, in N/m.
    slope: DMatrix<f64>,
    /// The last residuals in N, and the lengths in m that ran since.
    before: Option<(DVector<f64>, DVector<f64>)>,
    /// What the pulls were when material last ran.
    unbalanced: Option<EquilibriumFailure>,
    passes: usize,
}

/// What the sheaves do in an equilibrium.
pub(super) enum Balance {
    /// All pulls balance.
    Rest,
    /// Material ran over some: the equilibrium is another.
    Moved,
    /// They do not come to balance.
    Never,
}

impl<'a> Passing<'a> {
    pub fn new(sheaves: &'a [Sheave], cables: &[&mut Cable]) -> Self {
        let compliance = |cable: usize| cables[cable].elements().iter().map(|e| e.length / e.section.axial_stiffness);
        let stiffness = |(cable, _): (usize, Side)| 1.0 / compliance(cable).sum::<f64>();
        let own = sheaves.iter().map(|sheave| -sheave.ends().map(stiffness).iter().sum::<f64>());
        let slope = DMatrix::from_diagonal(&DVector::from_iterator(sheaves.len(), own));
        Passing { sheaves, slope, before: None, unbalanced: None, passes: 0 }
    }

    /// Returns why a search failed after material ran over: what had run let it find nothing.
    pub fn explain(&mut self, failure: EquilibriumFailure) -> EquilibriumFailure {
        if failure.is_final() { failure } else { self.unbalanced.take().unwrap_or(failure) }
    }

    /// Lets material run over the sheaves of cables that are in equilibrium, up to residuals of
    /// `tolerance` (N); `pins` follow their nodes.
    ///
    /// # Errors
    /// If elements cannot be split or merged.
    pub fn pass(
        &mut self,
        cables: &mut [&mut Cable],
        pins: &mut [PinConstraint],
        tolerance: f64,
    ) -> Result<Balance, Error> {
        if self.sheaves.is_empty() {
            return Ok(Balance::Rest);
        }
        let pulls: Vec<Pulls> = self.sheaves.iter().map(|sheave| Pulls::of(sheave, cables)).collect();
        let residuals = DVector::from_iterator(self.sheaves.len(), pulls.iter().map(Pulls::residual));
        let worst = residuals.iamax();
        if residuals[worst].abs() <= tolerance {
            return Ok(Balance::Rest);
        }
        let Pulls { pulls, largest } = pulls[worst];
        self.unbalanced = Some(EquilibriumFailure::Unbalanced { pulls, largest });
        if let Some((before, moved)) = &self.before {
            let missed = &residuals - before - &self.slope * moved;
            self.slope += missed * moved.transpose() / moved.norm_squared();
        }
        self.passes += 1;
        let solved = self.slope.clone().lu().solve(&-&residuals);
        let Some(mut lengths) = solved.filter(|x| self.passes < MAX_PASSES && x.iter().all(|x| x.is_finite())) else {
            return Ok(Balance::Never);
        };
        for (sheave, length) in self.sheaves.iter().zip(lengths.iter_mut()) {
            let shortest =
                sheave.ends().map(|(cable, _)| cables[cable].length()).into_iter().fold(f64::INFINITY, f64::min);
            *length = length.clamp(-MOST_PASSED * shortest, MOST_PASSED * shortest);
        }
        for (sheave, length) in self.sheaves.iter().zip(&lengths) {
            for ((cable, side), share) in sheave.ends().into_iter().zip([-1.0, 1.0]) {
                let own = &mut cables[cable];
                let before = (own.nodes(), own.nodes_from_start());
                if !own.feed_at_rest(side, share * length)? {
                    return Ok(Balance::Never);
                }
                follow(own, before, pins.iter_mut().filter(|pin| pin.cable == cable));
            }
        }
        self.before = Some((residuals, lengths));
        Ok(Balance::Moved)
    }
}

/// What pulls at a sheave.
struct Pulls {
    /// In N, of the cables before and after it.
    pulls: [f64; 2],
    /// Largest difference in N that its friction holds.
    largest: f64,
}

impl Pulls {
    fn of(sheave: &Sheave, cables: &[&mut Cable]) -> Self {
        let ends = sheave.ends();
        let pulls = ends.map(|(cable, side)| cables[cable].pull_at_rest(side));
        let tangents = ends.map(|(cable, side)| cables[cable].tangent_at_eye(side));
        Pulls { pulls, largest: sheave.friction_at_rest(tangents, pulls) }
    }

    /// Returns by how much in N they differ beyond the friction.
    fn residual(&self) -> f64 {
        let difference = self.pulls[1] - self.pulls[0];
        difference - difference.clamp(-self.largest, self.largest)
    }
}

/// Moves pins to where their nodes are in a cable that had so many, and from the start.
fn follow<'p>(cable: &Cable, (nodes, from_start): (usize, i64), pins: impl Iterator<Item = &'p mut PinConstraint>) {
    let has = |side| cable.model.reels.get(side).is_some();
    let added = cable.nodes_from_start() - from_start;
    for pin in pins {
        pin.node = match pin.node {
            node if node + 1 == nodes && has(Side::End) => cable.nodes() - 1,
            0 if has(Side::Start) => 0,
            node => node.saturating_add_signed(added as isize),
        };
    }
}
