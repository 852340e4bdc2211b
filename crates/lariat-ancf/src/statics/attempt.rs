//! One attempt to find an equilibrium: its report, its budget of iterations and its failure.

use crate::error::StepFailure;
use crate::scales::statics::{MAX_ATTEMPTS, MAX_ITERATIONS_OF_ATTEMPT};

/// The result of [`Cable::equilibrium`](crate::Cable::equilibrium).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct EquilibriumReport {
    /// Iterations of all attempts together.
    pub iterations: usize,
    /// Largest residual force in N.
    pub residual: f64,
    /// True if the tangent stiffness is positive definite and the increments of Newton's method
    /// fell to rounding; false for an unstable or indifferent shape. Thick elements of the
    /// projected axial rule, which is the default, are unstable where they are compressed by more
    /// than 1e-3, although the rod is not: use an exact axial rule (`exact-3`) there.
    pub stable: bool,
}

impl EquilibriumReport {
    /// Returns the report of a search by another crate.
    pub fn new(iterations: usize, residual: f64, stable: bool) -> Self {
        EquilibriumReport { iterations, residual, stable }
    }
}

/// Tolerance and number of iterations of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumOptions {
    /// Largest residual force over the sum of the loads. Default 1e-9.
    pub tolerance: f64,
    /// Largest number of steps of each attempt; an attempt takes at most twice as many iterations,
    /// all attempts together at most five times as many. Default 400.
    pub iterations: usize,
}

impl Default for EquilibriumOptions {
    fn default() -> Self {
        EquilibriumOptions { tolerance: 1e-9, iterations: 400 }
    }
}

/// Iterations done and remaining.
pub(crate) struct Budget {
    /// Largest residual force over the sum of the loads.
    pub tolerance: f64,
    /// Largest number of steps of one attempt.
    pub attempt: usize,
    /// Iterations done.
    pub done: usize,
    /// Iterations done when the present attempt began.
    began: usize,
}

impl Budget {
    /// Returns an unspent budget.
    pub fn new(options: &EquilibriumOptions) -> Self {
        Budget { tolerance: options.tolerance, attempt: options.iterations, done: 0, began: 0 }
    }

    /// Begins an attempt.
    pub fn begin_attempt(&mut self) {
        self.began = self.done;
    }

    /// Takes one iteration, and returns whether one remained.
    pub fn take(&mut self) -> bool {
        let more = !self.spent() && self.done - self.began < MAX_ITERATIONS_OF_ATTEMPT.saturating_mul(self.attempt);
        self.done += usize::from(more);
        more
    }

    /// Returns the number of steps that a search of an island may take.
    pub fn left(&self) -> usize {
        self.attempt.min(MAX_ATTEMPTS.saturating_mul(self.attempt) - self.done)
    }

    /// Returns whether no iteration remains.
    pub fn spent(&self) -> bool {
        self.done >= MAX_ATTEMPTS.saturating_mul(self.attempt)
    }
}

/// Why an attempt failed.
pub(crate) struct Failure {
    /// The failure of a matrix or a step, if that was the reason.
    pub cause: Option<StepFailure>,
    /// Largest residual force in N where it ended.
    pub residual: f64,
    /// The first folded element of a shape that was found, if there was one.
    pub fold: Option<usize>,
}

impl Default for Failure {
    fn default() -> Self {
        Failure { cause: None, residual: f64::NAN, fold: None }
    }
}

/// Returns the largest change of a position component in m and of a slope component.
pub(super) fn largest_change(dq: &[f64]) -> (f64, f64) {
    let largest = |from: usize| {
        dq.chunks_exact(6).flat_map(|x| &x[from..from + 3]).fold(0.0f64, |m, x| {
            if x.is_nan() {
                f64::NAN
            } else if m.is_nan() {
                m
            } else {
                m.max(x.abs())
            }
        })
    };
    (largest(0), largest(3))
}
