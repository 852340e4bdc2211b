//! Newton's iteration of an implicit stage.
//!
//! # Equation
//!
//! Full increments under a cap on the change of slope. A factored tangent is tried again in the
//! next iteration, and in the next stage of the same step, as long as each increment is less than
//! 0.3 of the one before (a force and a solve cost a third of a new tangent); the first increment
//! that is not smaller is discarded together with the tangent.
//!
//! The error after increment d_k is predicted as 2 d_k^2/d_{k-1} with a kept tangent,
//! d_k^3/d_{k-1}^2 with a fresh one; the iteration ends when that, or d_k itself, is below the
//! tolerance, and the residual, which shrinks as the increments do, leaves at most 1e-3 of the
//! impulses unbalanced. The second condition is asked for where forces depend on velocities, which
//! no tolerance of positions bounds (without it a damped rope that carries an arm reads 2 % less
//! than it carries, steadily), and in the first four iterations: a slack cable has hardly any
//! impulses.
//!
//! Axial damping of a rope acts while it is taut, so its force jumps where the rope becomes taut or
//! slack; an iteration that goes to and fro between both ends with its last iterate, if that is
//! within the tolerance of the step, whose error estimate sees what is left.
//!
//! # References
//!
//! Deuflhard 2011, section 2.1 (contraction as the monitor); Hairer & Wanner 1996, IV.8.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

use crate::error::StepFailure;
use crate::scales::integrate::{FORCE_TOLERANCE, MAX_CHORD_CONTRACTION, MAX_FOR_FORCES, MAX_ITERATIONS, MAX_ROTATION};

/// Size of a Newton increment.
#[derive(Clone, Copy, Debug)]
pub struct Increment {
    /// Largest displacement in m; NaN if the increment is not finite.
    pub displacement: f64,
    /// Largest change of a slope, or rotation in rad.
    pub rotation: f64,
    /// Share of the impulses that the residual before the increment leaves unbalanced; 0 if forces
    /// do not depend on velocities.
    pub imbalance: f64,
}

/// A system of equations that Newton's iteration solves.
pub trait Linearised {
    /// Evaluates the residual at the present iterate, with a new tangent if `fresh`, and solves for
    /// the increment.
    ///
    /// # Errors
    /// If the tangent is singular.
    fn increment(&mut self, fresh: bool) -> Result<Increment, StepFailure>;
    /// Adds this share of the increment to the iterate.
    fn apply(&mut self, share: f64);
    /// Returns whether a fresh tangent is the exact derivative; if not, increments shrink linearly
    /// with fresh tangents too.
    fn exact(&self) -> bool {
        true
    }
    /// Returns the tolerance in m of a stage in which forces jump, as those of a rope do that
    /// becomes taut or slack: increments do not end there, however short the step is. 0 where none
    /// do.
    fn corner_tolerance(&self) -> f64 {
        0.0
    }
    /// Returns the failure for an increment that is not finite.
    fn not_finite(&self) -> StepFailure;
}

/// Iterates to `tolerance` (m). With `keep`, the last factored tangent is tried first.
///
/// # Errors
/// [`StepFailure::NotConverged`], or the failure of an increment.
pub fn iterate(problem: &mut impl Linearised, tolerance: f64, keep: bool) -> Result<(), StepFailure> {
    let mut chord = keep;
    let mut chords_contract = true;
    let mut before = f64::INFINITY;
    for iteration in 1..=MAX_ITERATIONS {
        let Increment { displacement, rotation, imbalance } = problem.increment(!chord)?;
        let damp = if rotation > MAX_ROTATION { MAX_ROTATION / rotation } else { 1.0 };
        let size = damp * displacement;
        let ratio = size / before;
        if chord && !(ratio < MAX_CHORD_CONTRACTION || iteration == 1 && damp == 1.0) {
            // the old tangent does not contract: discard this increment and factor a new one
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
        // the predicted error: increments shrink linearly with one tangent, quadratically with
        // fresh ones
        let contraction = match (iteration, chord) {
            (1, _) => 1.0,
            (_, true) => (2.0 * ratio).min(1.0),
            (_, false) if !problem.exact() => (2.0 * ratio).min(1.0),
            (_, false) => (ratio * ratio).min(1.0),
        };
        let are_forces_right = imbalance * contraction <= FORCE_TOLERANCE || iteration >= MAX_FOR_FORCES;
        if damp == 1.0 && size * contraction <= tolerance && are_forces_right {
            return Ok(());
        }
        if iteration == MAX_ITERATIONS || (!chord && iteration > 5 && ratio > 2.0) {
            if damp == 1.0 && size <= problem.corner_tolerance() {
                return Ok(());
            }
            return Err(StepFailure::NotConverged { iterations: iteration, increment: size });
        }
        chord = chords_contract && damp == 1.0;
        before = size;
    }
    Err(StepFailure::NotConverged { iterations: MAX_ITERATIONS, increment: before })
}
