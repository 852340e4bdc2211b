//! Newton's method from a shape whose residual is within its tolerance, until its increments are
//! rounding.
//!
//! # Equation
//!
//! `K dq = F(q)`. A small residual is no measure of the error of a soft shape: the rounding of the
//! axial force, of the order of EA times 1e-16, may hide a transverse force that bends a column
//! near its critical load by its whole deflection. The increment is the error itself, to second
//! order: force and moment balance of every part is as good as the increment is small.
//!
//! # Validity
//!
//! Positive definite K, and a start within the range of quadratic convergence, which is checked:
//! each increment must be at most half of the one before, down to rounding.
//!
//! # References
//!
//! Kelley 1995, section 5.4 (the increment as an estimate of the error).
//!
//! # Alternatives considered
//!
//! A smaller tolerance of the residual: it is below rounding where the cable is stiff.

use super::attempt::{Budget, largest_change};
use super::pseudo_transient::{Minimisation, Polished};
use crate::linalg::Definiteness;
use crate::model::largest_force;
use crate::scales::statics::{CONVERGED, MAX_ITERATIONS, MAX_STAGNATIONS, STAGNATION};
use crate::system::project_vector;

impl Minimisation<'_> {
    /// Improves `q` until the increments of Newton's method are rounding.
    pub(super) fn polish(&mut self, q: &mut [f64], budget: &mut Budget) -> Polished {
        self.best.copy_from_slice(q);
        let mu = core::mem::replace(&mut self.mu, 0.0);
        let outcome = self.polish_in_place(q, budget);
        self.mu = mu;
        if !matches!(outcome, Polished::Converged(_)) {
            q.copy_from_slice(&self.best);
        }
        outcome
    }

    fn polish_in_place(&mut self, q: &mut [f64], budget: &mut Budget) -> Polished {
        let (mut before, mut stagnations) = (f64::INFINITY, 0);
        for iteration in 0..MAX_ITERATIONS {
            // the first evaluation is that of the caller
            if iteration > 0 && !budget.take() {
                break;
            }
            let residual = self.evaluate(q);
            match self.equations.factor() {
                Ok(Definiteness::PositiveDefinite) => {}
                _ => return Polished::Indefinite,
            }
            self.equations.solve(&mut self.rhs);
            let (displacement, slope) = largest_change(&self.rhs);
            let change = slope.max(displacement / self.scale.length);
            if change > 0.5 * before {
                stagnations += 1;
                if stagnations == MAX_STAGNATIONS && before <= STAGNATION {
                    return Polished::Converged(residual);
                }
            }
            // NaN fails too
            if !(change <= 0.5 * before || change.max(before) <= STAGNATION) {
                break;
            }
            q.iter_mut().zip(&self.rhs).for_each(|(q, dq)| *q += dq);
            if change < CONVERGED {
                self.equations.static_force(self.load, q, 1.0, &mut self.rhs);
                project_vector(self.equations.model, &mut self.rhs);
                return Polished::Converged(largest_force(&self.rhs, self.scale.element));
            }
            before = change;
        }
        Polished::Failed
    }
}
