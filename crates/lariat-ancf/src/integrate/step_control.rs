//! The choice of steps from one host step to the next, which the last step reaches exactly.
//!
//! # Equation
//!
//! With a tolerance, a step h of a host step H is accepted if its estimated error is below
//! `tolerance h/H` (error per unit step; a step shorter than H/1024 may err by tolerance/1024), so
//! that the errors of up to 1024 steps add up to the tolerance. The next step follows from the
//! estimate's order p as `h (0.5 allowed/error)^(1/(p-1))`, within h/5 and 3 h. The remainder of
//! the host step is split evenly once fewer than two steps remain, and the time after the last step
//! is the host's to the bit.
//!
//! A step that fails (Newton's iteration, a pivot, a number that is not finite) is retried at 1/4
//! of its length down to H/2^20; then the host step fails with the last good state, which the
//! caller replaces by that of the beginning of the host step.
//!
//! If the tangent is not exact, Newton's iteration contracts linearly, at a rate that grows with
//! the step and is the same in the next step. The step after a failure is therefore at most half as
//! long as the failed one, and the bound grows by 1.2 with every step; error control, which does
//! not take Newton's iteration into account, would try the failed length again at once. `lariat
//! stability --case "hanging 1e4"` (1/30 s with effects) rejects 988 of 5466 steps; without this
//! bound 3889 of 9227.
//!
//! # References
//!
//! Hairer & Wanner 1996, IV.8.

use super::dynamics::Dynamics;
use super::integrator::{IntegratorRef, StepControl};
use super::one_step::{Scratch, StepRequest};
use super::state::State;
use crate::error::StepFailure;

/// Shortest step, as a share of the host step.
pub(super) const MIN_STEP_SHARE: f64 = 1.0 / (1u64 << 20) as f64;
/// Smallest error allowed to a step, as a share of the tolerance: after a jump of velocity errors
/// fall only in proportion to h.
const MIN_ERROR_SHARE: f64 = 1.0 / 1024.0;
/// Newton's tolerance, as a share of the error allowed to a step.
const NEWTON_TOLERANCE_SHARE: f64 = 0.1;
/// Error for which the next step is chosen, as a share of the allowed one: one half costs less than
/// 0.8, with fewer rejections.
const TARGET_ERROR_SHARE: f64 = 0.5;
/// Newton's tolerance in m where no error is controlled.
const FIXED_STEP_NEWTON_TOLERANCE: f64 = 1e-10;
/// Relative rounding error of a host step given in single precision: 1/60 s is then longer than
/// four steps of 1/240 s.
pub(super) const SINGLE_PRECISION_ROUNDING: f64 = 1e-7;
/// Length of the retry of a failed step, as a share of the step.
const RETRY_SHARE: f64 = 0.25;
/// Longest step after one at which Newton's iteration failed with an inexact tangent, as a share of
/// it.
const MAX_SHARE_OF_FAILED: f64 = 0.5;
/// Growth of that bound with every accepted step.
const BOUND_GROWTH: f64 = 1.2;

/// Numbers of steps taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
}

/// A host step that failed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FailedStep {
    /// Time in s at which the failed step began.
    pub time: f64,
    /// Its length in s.
    pub step: f64,
    /// The reason.
    pub failure: StepFailure,
}

/// Advances `state` by `horizon` (s), and returns the numbers of steps with the outcome. After a
/// failure `state` is the last accepted one.
pub(crate) fn advance(
    system: &mut dyn Dynamics,
    integrator: IntegratorRef<'_>,
    state: &mut State,
    horizon: f64,
    scratch: &mut Scratch,
) -> (Counts, Result<(), FailedStep>) {
    let mut counts = Counts::default();
    let outcome = run(system, integrator, state, horizon, scratch, &mut counts);
    (counts, outcome)
}

fn run(
    system: &mut dyn Dynamics,
    integrator: IntegratorRef<'_>,
    state: &mut State,
    horizon: f64,
    scratch: &mut Scratch,
    counts: &mut Counts,
) -> Result<(), FailedStep> {
    let method = integrator.method;
    scratch.resize(system.size(), method.stages());
    prepare(system, state, method.has_algorithmic_acceleration())?;
    system.state_reached(state);
    let end = state.time + horizon;
    let tolerance = integrator.tolerance();
    let estimate_order = method.estimate_order().unwrap_or(2);
    let regular = regular_step(system, integrator, horizon, state.memory.step);
    check_length(system, integrator, regular, horizon).map_err(|failure| FailedStep {
        time: state.time,
        step: regular,
        failure,
    })?;
    let mut proposal = regular;
    let mut max_step = f64::INFINITY;
    let mut done = 0.0;
    while done < horizon {
        let (h, last) = fit(proposal, horizon - done, tolerance.is_some());
        let newton_tolerance = tolerance.map_or(FIXED_STEP_NEWTON_TOLERANCE, |t| {
            NEWTON_TOLERANCE_SHARE * t * (h / horizon).clamp(MIN_ERROR_SHARE, 1.0)
        });
        let request = StepRequest { h, newton_tolerance, estimate: tolerance.is_some() };
        let outcome = method
            .step(system, state, request, scratch)
            .and_then(|estimate| check_finite(&scratch.next, estimate).map(|()| estimate));
        let failed = |failure| Err(FailedStep { time: state.time, step: h, failure });
        match (outcome, tolerance) {
            (Err(failure), _) => {
                counts.rejected += 1;
                proposal = RETRY_SHARE * h;
                if !system.has_exact_tangent() {
                    max_step = MAX_SHARE_OF_FAILED * h;
                }
                if proposal < MIN_STEP_SHARE * horizon {
                    return failed(failure);
                }
                continue;
            }
            (Ok(_), None) | (Ok(None), Some(_)) => proposal = (2.0 * proposal).min(regular),
            (Ok(Some(estimate)), Some(tolerance)) => {
                let allowed = tolerance * (h / horizon).max(MIN_ERROR_SHARE);
                let growth =
                    root(TARGET_ERROR_SHARE * allowed / estimate.max(1e-300), estimate_order - 1).clamp(0.2, 3.0);
                if estimate > allowed {
                    counts.rejected += 1;
                    proposal = h * growth.min(0.9);
                    if proposal < MIN_STEP_SHARE * horizon {
                        return failed(StepFailure::ErrorTooLarge { estimate, allowed });
                    }
                    continue;
                }
                // the last step may have been shortened to end with the host step, which does not
                // lower the proposal
                proposal = if last { proposal.max(h * growth).min(3.0 * h.max(proposal)) } else { h * growth };
            }
        }
        proposal = proposal.min(max_step);
        max_step *= BOUND_GROWTH;
        accept(state, &mut scratch.next, method.has_algorithmic_acceleration());
        system.step_accepted(&scratch.next, state, h);
        counts.steps += 1;
        done += h;
        state.time = if last { end } else { end - (horizon - done) };
        system.state_reached(state);
        if last {
            break;
        }
    }
    state.memory.step = if tolerance.is_some() { proposal } else { 0.0 };
    Ok(())
}

/// Makes the state consistent: puts prescribed coordinates in place and computes the acceleration.
fn prepare(system: &mut dyn Dynamics, state: &mut State, algorithmic: bool) -> Result<(), FailedStep> {
    let n = system.size();
    if !algorithmic {
        // those of another method belong to another state
        state.memory.algorithmic.clear();
    }
    if state.memory.valid && (!algorithmic || state.memory.algorithmic.len() == n) {
        return Ok(());
    }
    state.memory.acceleration.resize(n, 0.0);
    system.prescribe(state.time, &mut state.q, &mut state.v);
    system
        .acceleration(state.time, &state.q, &state.v, &mut state.memory.acceleration)
        .map_err(|failure| FailedStep { time: state.time, step: 0.0, failure })?;
    state.memory.algorithmic.clear();
    if algorithmic {
        state.memory.algorithmic.extend_from_slice(&state.memory.acceleration);
    }
    state.memory.valid = true;
    Ok(())
}

/// Checks that a regular step is within the stability limit of an explicit method (the frequency
/// bound is that of one element plus 5 %, and tight), and that a fixed one is not too short.
fn check_length(
    system: &dyn Dynamics,
    integrator: IntegratorRef<'_>,
    step: f64,
    horizon: f64,
) -> Result<(), StepFailure> {
    if let Some(limit) = integrator.method.stability_limit() {
        let limit = 1.05 * limit / system.frequency_bound().max(1e-12);
        if step > limit {
            return Err(StepFailure::Unstable { step, limit });
        }
    }
    let least = MIN_STEP_SHARE * horizon;
    if step < least && integrator.tolerance().is_none() {
        return Err(StepFailure::TooShort { step, least });
    }
    Ok(())
}

/// Returns the length of the first step. `remembered` is the step that error control proposed at
/// the end of the last host step.
fn regular_step(system: &dyn Dynamics, integrator: IntegratorRef<'_>, horizon: f64, remembered: f64) -> f64 {
    let equal = |longest: f64| horizon / (horizon / longest - 1e-9).ceil().max(1.0);
    match integrator.control {
        StepControl::Tolerance(_) if remembered > 0.0 => remembered,
        StepControl::Tolerance(_) => 0.1 * horizon,
        StepControl::Substeps(substeps) => horizon / f64::from(substeps),
        StepControl::MaxStep(longest) => equal(longest * (1.0 + SINGLE_PRECISION_ROUNDING)),
        StepControl::Stable(share) => match integrator.method.stability_limit() {
            Some(limit) => equal(share * limit / system.frequency_bound().max(1e-12)),
            None => horizon,
        },
    }
}

/// Returns the next step and whether it is the last.
fn fit(proposal: f64, remaining: f64, even: bool) -> (f64, bool) {
    if proposal >= remaining * (1.0 - 1e-9) {
        (remaining, true)
    } else if even && proposal > 0.5 * remaining {
        (0.5 * remaining, false)
    } else {
        (proposal, false)
    }
}

/// Exchanges `state` and the result of a step, so that `next` is the state before; the times are
/// not exchanged.
fn accept(state: &mut State, next: &mut State, algorithmic: bool) {
    core::mem::swap(&mut state.q, &mut next.q);
    core::mem::swap(&mut state.v, &mut next.v);
    core::mem::swap(&mut state.memory.acceleration, &mut next.memory.acceleration);
    if algorithmic {
        core::mem::swap(&mut state.memory.algorithmic, &mut next.memory.algorithmic);
    }
    next.time = state.time;
}

/// Returns the root of the given degree, 1 to 3, by basic arithmetic: a library's `powf` may give
/// other bits on another processor.
fn root(x: f64, degree: u32) -> f64 {
    match degree {
        1 => x,
        2 => x.sqrt(),
        _ => {
            let x = x.clamp(1e-12, 1e12);
            let mut y = if x > 1.0 { x.sqrt() } else { 1.0 };
            for _ in 0..60 {
                y = (2.0 * y + x / (y * y)) / 3.0;
            }
            y
        }
    }
}

fn check_finite(next: &State, estimate: Option<f64>) -> Result<(), StepFailure> {
    for (what, x) in [("position", &next.q), ("velocity", &next.v), ("acceleration", &next.memory.acceleration)] {
        if let Some(i) = x.iter().position(|x| !x.is_finite()) {
            return Err(StepFailure::NotFinite { what, node: i / 6 });
        }
    }
    match estimate {
        Some(estimate) if !estimate.is_finite() => Err(StepFailure::NotFinite { what: "error estimate", node: 0 }),
        _ => Ok(()),
    }
}
