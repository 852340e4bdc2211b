//! What a linear solve of a step misses of the axial forces, taken away with the factors at hand.
//!
//! # Equation
//!
//! Strains are quadratic in the coordinates, and the axial stiffness multiplies what a linear solve misses of them, so that it is most of the residual r
//! that the solve leaves. It is found by itself (lanes/discrete_gradient/remainder.rs) for a quarter of the cost of an iteration:
//!
//! ```text
//! S D^2 v = r_axial
//! ```
//!
//! This is a simplified step of Newton's iteration. It is taken if r_axial unbalances more of the impulses than an
//! [accepted](crate::integrate::discrete_gradient) step may, and if its increment is at most half of that of the solve (Deuflhard's test of
//! monotonicity). The energy law is then that of the result.
//!
//! # Validity
//!
//! Away from contacts and reels, whose forces are linear together with the strains: there it is not taken.
//!
//! # References
//!
//! Deuflhard, Newton Methods for Nonlinear Problems, Springer 2004, section 3.3.

use super::lanes::discrete_gradient::SolvedStep;
use super::{Equations, dot};
use crate::error::StepFailure;
use crate::integrate::State;
use crate::integrate::discrete_gradient::{Buffers, FORCE_TOLERANCE, sum_of_forces};

/// Returns whether an increment is at most half of the one before, both by their squares.
pub(crate) fn contracts(square: f64, before: f64) -> bool {
    square <= 0.25 * before
}

impl Equations<'_> {
    /// Returns whether what a solve misses of the axial forces may be taken away by itself.
    pub fn may_correct(&self, b: &Buffers) -> bool {
        b.contact.is_empty() && b.pairs.is_empty() && self.system.flows.is_empty()
    }

    /// Computes into `rhs` what the last solve missed of the axial forces, and returns the sum of its impulses in N s. The solve was the `first` of the step, with a
    /// `fresh` matrix.
    pub fn find_remainder(&self, state: &State, b: &mut Buffers, (first, fresh): (bool, bool)) -> f64 {
        if fresh {
            b.about.clone_from(&b.linearised);
        }
        let Buffers { h, about, linearised, solved, change, change_before, kept, rhs, .. } = b;
        let step = SolvedStep {
            start: &state.q,
            about,
            before: linearised,
            solved: if solved.is_empty() { change } else { solved },
            change,
            last_step: first.then_some((change_before, *kept)),
            h: *h,
            damping: self.model.effects.damping.map_or(0.0, |damping| damping.axial),
        };
        let (level, forces) = (self.system.level, &self.system.forces);
        rhs.fill(0.0);
        forces.elements.add_remainder(level, forces.in_element.as_ref(), step, rhs);
        sum_of_forces(rhs)
    }

    /// Takes away what the solve for the increment in `rhs` missed on a cable alone; `first` and `fresh` as above.
    pub fn correct(&mut self, state: &State, b: &mut Buffers, solve: (bool, bool)) -> Result<(), StepFailure> {
        if !self.may_correct(b) {
            return Ok(());
        }
        let square = dot(&b.rhs, &b.rhs);
        if self.find_remainder(state, b, solve) <= FORCE_TOLERANCE * b.impulse {
            return Ok(());
        }
        self.solve(&mut b.rhs);
        let correction = dot(&b.rhs, &b.rhs);
        if !correction.is_finite() {
            return Err(self.not_finite("Newton increment", &b.rhs));
        }
        if contracts(correction, square) {
            Self::apply_increment(b, 1.0);
        }
        Ok(())
    }
}
