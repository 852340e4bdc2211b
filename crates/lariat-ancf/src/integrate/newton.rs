//! Newton's iteration of an implicit stage.
//!
//! Full steps under a cap on the change of slope. A factored tangent is tried again at the next iteration, and at the next stage
//! of the same step, as long as increments shrink by 0.3 or more with it (a force and a solve cost a third of a new tangent); at
//! the first that does not, it is dropped.
//!
//! *Stop.* What is left after increment d_k is predicted as 2 d_k^2/d_{k-1} with a kept tangent, d_k^3/d_{k-1}^2 with a fresh one;
//! the iteration ends when that, or d_k itself, is below the tolerance. *Source.* Deuflhard 2011, section 2.1 (contraction as the
//! monitor); Hairer & Wanner 1996, IV.8. *Rejected.* A line search on the residual (stagnates on thin cables: the residual of
//! stiff axial modes hides the progress of the bending modes); a tangent kept blindly over a step (diverges on steel, and steps
//! shrink); tangents kept across host steps (a restored snapshot would not replay bitwise).

use crate::error::StepFailure;

/// Newton iterations before a stage is given up.
const MAX_ITERATIONS: usize = 12;
/// Largest change of a slope vector, or rotation of a body in rad, in one Newton iteration.
const ROTATION_CAP: f64 = 0.5;
/// A tangent is kept for the next iteration or stage while increments shrink by this factor.
const CHORD_CONTRACTION: f64 = 0.3;
/// One iteration and its check are enough if the second increment is below this share of the first.
const ONCE_CONTRACTION: f64 = 0.1;

/// Size of a Newton increment.
#[derive(Clone, Copy, Debug)]
pub struct Increment {
    /// Largest displacement in m; NaN if the increment is not finite.
    pub displacement: f64,
    /// Largest change of a slope, or rotation in rad.
    pub rotation: f64,
}

/// A system of equations that Newton can solve.
pub trait Linearised {
    /// Evaluates the residual at the present iterate, with a new tangent if `fresh`, and solves for the increment.
    ///
    /// # Errors
    /// If the tangent is singular.
    fn increment(&mut self, fresh: bool) -> Result<Increment, StepFailure>;
    /// Adds this share of the increment to the iterate.
    fn apply(&mut self, share: f64);
    /// Whether a fresh tangent is the exact derivative: without, fresh increments shrink linearly too.
    fn exact(&self) -> bool {
        true
    }
    /// The failure that an increment that is not finite means.
    fn not_finite(&self) -> StepFailure;
}

/// Iterates to `tolerance` (m). With `once`, one iteration with a fresh tangent and one with the same suffice if they contract.
/// With `keep`, the tangent at hand is tried first.
///
/// # Errors
/// [`StepFailure::NotConverged`], or what an increment fails with.
pub fn iterate(problem: &mut impl Linearised, tolerance: f64, once: bool, keep: bool) -> Result<(), StepFailure> {
    let mut chord = keep;
    let mut chords_contract = true;
    let mut before = f64::INFINITY;
    for iteration in 1..=MAX_ITERATIONS {
        let Increment { displacement, rotation } = problem.increment(!chord)?;
        let damp = if rotation > ROTATION_CAP { ROTATION_CAP / rotation } else { 1.0 };
        let size = damp * displacement;
        let ratio = size / before;
        if chord && !(ratio < CHORD_CONTRACTION || iteration == 1 && damp == 1.0) {
            // the old tangent does not serve: drop this increment and take a new one
            chord = false;
            chords_contract = false;
            if size.is_finite() {
                continue;
            }
        }
        if !size.is_finite() {
            return Err(problem.not_finite());
        }
        problem.apply(damp);
        // what is left, if increments go on as they did: with one tangent linearly, with fresh ones quadratically
        let left = match (iteration, chord) {
            (1, _) => size,
            (_, true) => size * (2.0 * ratio).min(1.0),
            (_, false) if !problem.exact() => size * (2.0 * ratio).min(1.0),
            (_, false) => size * ratio * ratio,
        };
        if damp == 1.0 && (left.min(size) <= tolerance || once && chord && ratio <= ONCE_CONTRACTION) {
            return Ok(());
        }
        if iteration == MAX_ITERATIONS || (!chord && iteration > 5 && ratio > 2.0) {
            return Err(StepFailure::NotConverged { iterations: iteration, increment: size });
        }
        chord = chords_contract && damp == 1.0;
        before = size;
    }
    Err(StepFailure::NotConverged { iterations: MAX_ITERATIONS, increment: before })
}
