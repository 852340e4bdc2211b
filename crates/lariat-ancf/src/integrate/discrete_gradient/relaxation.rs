//! What share of its increments Newton's iteration takes where a nonsmooth term acts, most often
//! contact.
//!
//! # Equation
//!
//! What the tangent leaves out makes a slack cable that is hit swing between two iterates for ever.
//! From the fourth iteration on, one that leaves more than half of the imbalance is followed by
//! halves of the increments (under-relaxation). The share s of an increment d leaves of the
//! residual
//!
//! ```text
//! r(x + s d) = (1 - s) r(x) + what is not linear
//! ```
//!
//! so a half that leaves half of the energy `r . D q/h`, to 0.1 of it, was on a tangent that is
//! right, and a whole increment follows it. By halves alone such an iteration goes on halving what
//! a whole one solves.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

use crate::scales::integrate::{HALF, LINEAR, SWINGING, WHOLE_INCREMENTS};
use crate::term::Balance;

/// The share of the next increment, and what it is judged by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relaxation {
    pub share: f64,
    swings: bool,
    /// Number of iterations since the equations were changed.
    taken: usize,
    /// What the last iteration left: of the impulses, and of the energy.
    imbalance: f64,
    energy: f64,
}

impl Relaxation {
    /// Before the first iteration.
    pub fn new() -> Self {
        Relaxation { share: 1.0, swings: false, taken: 0, imbalance: f64::INFINITY, energy: f64::INFINITY }
    }

    /// Begins anew with other equations, those of other bounds of friction.
    pub fn restart(&mut self) {
        (self.share, self.swings, self.taken) = (1.0, false, 0);
    }

    /// Sets the share of the next increment by what the last one left.
    pub fn note(&mut self, balance: &Balance) {
        self.taken += 1;
        self.swings |=
            balance.nonsmooth && self.taken >= WHOLE_INCREMENTS && balance.imbalance > SWINGING * self.imbalance;
        let left = balance.residual / self.energy;
        let linear = self.share < 1.0 && (left - (1.0 - self.share)).abs() < LINEAR;
        self.share = if self.swings && !linear { HALF } else { 1.0 };
        (self.imbalance, self.energy) = (balance.imbalance, balance.residual);
    }
}
