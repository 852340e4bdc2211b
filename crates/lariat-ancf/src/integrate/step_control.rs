//! The choice of steps from one host step to the next, which the last step reaches exactly.
//!
//! # Equation
//!
//! With a tolerance, a step is accepted if its estimated error is within the
//! [error budget](super::error_budget) of the host step H, from which the next step follows. The
//! remainder of the host step is split evenly once fewer than two steps remain, and the time after
//! the last step is the host's to the bit.
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
//! Steps of implicit methods that make energy are rejected by the [energy
//! check](super::energy_check), and tried at a quarter as well.
//!
//! Steps of fixed length are divided for failures that are rare. One at the shortest length, and
//! the growth back by 1.2, take 10 + 76 tries. A host step fails once it has taken more than those
//! of two of them in each of its regular steps: the method does not take steps of this length
//! there, as the midpoint rule with a stiff cable whose end is set in motion by a jolt, which else
//! took 1e5 steps per host step.
//!
//! # References
//!
//! Hairer & Wanner 1996, IV.8.

use super::dynamics::Dynamics;
use super::energy_check::EnergyCheck;
use super::error_budget::ErrorBudget;
use super::error_norm::ErrorNorm;
use super::integrator::{IntegratorRef, StepControl};
use super::one_step::{Scratch, StepRequest};
use crate::error::StepFailure;
use crate::scales::integrate::{
    BOUND_GROWTH, FIXED_STEP_NEWTON_TOLERANCE, MAX_SHARE_OF_FAILED, MIN_CHECKED_SHARE, MIN_STEP_SHARE, RETRY_SHARE,
    SINGLE_PRECISION_ROUNDING, TRIES,
};
use crate::state::State;

/// Numbers of steps taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Accepted steps of the shortest length with an error above the tolerance.
    pub unresolved: u64,
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
    let estimate_order = method.estimate_order().unwrap_or(2);
    let coherence = if integrator.norm() == ErrorNorm::Every { 1.0 } else { state.memory.coherence };
    let mut budget =
        integrator.tolerance().map(|t| ErrorBudget::new(t, horizon, estimate_order, coherence, &mut scratch.error_sum));
    let regular = regular_step(system, integrator, horizon, state.memory.step);
    check_length(system, integrator, regular, horizon).map_err(|failure| FailedStep {
        time: state.time,
        step: regular,
        failure,
    })?;
    let implicit = method.stability_limit().is_none();
    let is_checked = implicit && (system.is_isolated() || method.estimate_order().is_none());
    let mut energy = EnergyCheck::new(is_checked, &state.memory);
    let mut checked = energy;
    let tries = integrator.tolerance().is_none().then(|| TRIES * (horizon / regular).ceil() as u64);
    let mut proposal = regular;
    let mut max_step = f64::INFINITY;
    let mut done = 0.0;
    while done < horizon {
        let (h, last) = fit(proposal, horizon - done, budget.is_some());
        let newton_tolerance = budget.as_ref().map_or(FIXED_STEP_NEWTON_TOLERANCE, |b| b.newton_tolerance(h));
        let request = StepRequest { h, newton_tolerance, estimate: budget.is_some() };
        if let Some(limit) = integrator.limit
            && limit.reduces()
        {
            return Err(FailedStep { time: state.time, step: h, failure: StepFailure::WorkLimit });
        }
        let iterations = system.newton_iterations();
        let outcome = method
            .step(system, state, request, scratch)
            .and_then(|estimate| check_finite(&scratch.next, estimate).map(|()| estimate))
            .and_then(|estimate| {
                scratch.next.time = state.time + h;
                checked = energy.after(system, state, &scratch.next, h)?;
                Ok(estimate)
            });
        if let Some(limit) = integrator.limit {
            // a method without iterations is counted by its steps
            limit.spend((system.newton_iterations() - iterations).max(1));
        }
        let failed = |failure| Err(FailedStep { time: state.time, step: h, failure });
        match (outcome, &mut budget) {
            (Err(failure), _) => {
                counts.rejected += 1;
                proposal = RETRY_SHARE * h;
                let energy_made = matches!(failure, StepFailure::EnergyMade { .. });
                if energy_made || !system.has_exact_tangent() {
                    max_step = MAX_SHARE_OF_FAILED * h;
                }
                let least =
                    if energy_made { MIN_CHECKED_SHARE * regular.min(horizon) } else { MIN_STEP_SHARE * horizon };
                if proposal < least {
                    return failed(failure);
                }
                if tries.is_some_and(|most| counts.steps + counts.rejected >= most) {
                    return failed(StepFailure::Divided { step: regular, cause: Box::new(failure) });
                }
                continue;
            }
            (Ok(_), None) | (Ok(None), Some(_)) => proposal = (2.0 * proposal).min(regular),
            (Ok(Some(estimate)), Some(budget)) => {
                let allowed = budget.allowed(h);
                if estimate > allowed {
                    counts.rejected += 1;
                    proposal = h * budget.growth(h, estimate).min(0.9);
                    if proposal < MIN_STEP_SHARE * horizon {
                        return failed(StepFailure::ErrorTooLarge { estimate, allowed });
                    }
                    continue;
                }
                checked.take(system, &mut scratch.next, (allowed - estimate) / h);
                budget.add(system, &scratch.error, estimate, &mut scratch.error_sum);
                let growth = budget.growth(h, estimate);
                // the last step may have been shortened to end with the host step, which does not
                // lower the proposal
                proposal = if last { proposal.max(h * growth).min(3.0 * h.max(proposal)) } else { h * growth };
            }
        }
        proposal = proposal.min(max_step);
        max_step *= BOUND_GROWTH;
        accept(state, &mut scratch.next, method.has_algorithmic_acceleration());
        energy = checked;
        counts.steps += 1;
        done += h;
        // works depend on the time at the end of the step
        state.time = if last { end } else { end - (horizon - done) };
        system.step_accepted(&scratch.next, state, h);
        system.state_reached(state);
        if last {
            break;
        }
    }
    state.memory.step = if budget.is_some() { proposal } else { 0.0 };
    energy.keep(&mut state.memory);
    state.memory.coherence = budget.map_or(1.0, |budget| budget.next_coherence());
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
    system.place(state);
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
        StepControl::Tolerance(_) | StepControl::ToleranceOf(..) if remembered > 0.0 => remembered,
        StepControl::Tolerance(_) | StepControl::ToleranceOf(..) => 0.1 * horizon,
        StepControl::Substeps(substeps) => horizon / f64::from(substeps),
        // of the discrete gradient alone, which has a control of its own
        StepControl::Adaptive(_) => horizon,
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

fn check_finite(next: &State, estimate: Option<f64>) -> Result<(), StepFailure> {
    let [q, v, a] = [&next.q, &next.v, &next.memory.acceleration];
    if !is_sum_finite(q, v, a) {
        for (what, x) in [("position", q), ("velocity", v), ("acceleration", a)] {
            if let Some(i) = x.iter().position(|x| !x.is_finite()) {
                return Err(StepFailure::NotFinite { what, node: i / 6 });
            }
        }
    }
    match estimate {
        Some(estimate) if !estimate.is_finite() => Err(StepFailure::NotFinite { what: "error estimate", node: 0 }),
        _ => Ok(()),
    }
}

/// Returns whether `x + y + z` is finite in every place: then each of them is. A branch for each
/// number takes a tenth of an explicit step.
fn is_sum_finite(x: &[f64], y: &[f64], z: &[f64]) -> bool {
    let ((x, rest), (y, _), (z, _)) = (x.as_chunks::<6>(), y.as_chunks::<6>(), z.as_chunks::<6>());
    let mut zeros = [0.0; 6];
    for ((x, y), z) in x.iter().zip(y).zip(z) {
        for k in 0..6 {
            zeros[k] += 0.0 * (x[k] + y[k] + z[k]);
        }
    }
    rest.is_empty() && (x.len(), y.len()) == (y.len(), z.len()) && zeros == [0.0; 6]
}
