//! From one host step to the next, which the last step reaches exactly: in equal steps, or in those
//! that keep a tolerance.
//!
//! # Equation
//!
//! With a tolerance, a step of length h in a host step H may have the [estimated
//! error](crate::island)
//!
//! ```text
//! e <= tolerance max(h/H, 1/1024)          next h = h (tolerance h/(2 H e))^(1/2), 1/5 to 2 times h
//! ```
//!
//! and the rest of the host step is divided evenly. Steps are not shorter than H/64: one of that
//! length is accepted whatever its error, and [counted](crate::Diagnostics::unresolved_steps),
//! because the energy law holds at any step. Beyond a [limit](crate::integrate::WorkLimit) to the
//! work, steps are as long as those of games, and taken whatever their error. Where the error is
//! not known, after an impact or a change by the host, the length stays.

use super::safeguard::{Advanced, Demand};
use super::{DiscreteGradientSystem, pace, safeguard};
use crate::error::StepFailure;
use crate::integrate::step_control::{Counts, FailedStep};
use crate::integrate::{IntegratorRef, StepControl, WorkLimit};
use crate::one_leg::OneLeg;
use crate::scales::integrate::{
    FIRST_STEPS, LARGEST_RETRY, MIN_ERROR_SHARE, MIN_STEP_SHARE, MOST_STEPS, RATIOS_OF_STEPS,
    SINGLE_PRECISION_ROUNDING, STEP_BEYOND_LIMIT, TARGET_ERROR_SHARE,
};

/// Advances the system by `horizon` (s), and returns the numbers of steps with the outcome. After a
/// failure the state is the last accepted one.
pub(crate) fn advance<S: DiscreteGradientSystem>(
    system: &mut S,
    integrator: IntegratorRef<'_>,
    horizon: f64,
) -> (Counts, Result<(), FailedStep>) {
    let mut counts = Counts::default();
    let leg = OneLeg::new(integrator.method.dissipation());
    if let Some(tolerance) = integrator.tolerance() {
        let demand = Demand { leg, limit: integrator.limit, ..Demand::CONTROLLED };
        let outcome = controlled(system, demand, (tolerance, horizon), &mut counts);
        return (counts, outcome);
    }
    if let StepControl::Adaptive(tolerance) = integrator.control {
        let demand = Demand { leg, limit: integrator.limit, ..Demand::FIXED };
        let outcome = pace::advance(system, demand, (tolerance, horizon), &mut counts);
        return (counts, outcome);
    }
    let longest = match integrator.control {
        StepControl::Substeps(substeps) => horizon / f64::from(substeps),
        StepControl::MaxStep(longest) => longest * (1.0 + SINGLE_PRECISION_ROUNDING),
        // rejected by `IntegratorRef::check`, or handled above
        StepControl::Tolerance(_)
        | StepControl::ToleranceOf(..)
        | StepControl::Adaptive(_)
        | StepControl::Stable(_) => horizon,
    };
    let steps = (horizon / longest - 1e-9).ceil().max(1.0);
    let (h, end) = (horizon / steps, system.time() + horizon);
    let failed = |time, failure| FailedStep { time, step: h, failure };
    let least = MIN_STEP_SHARE * horizon;
    if h < least {
        return (counts, Err(failed(system.time(), StepFailure::TooShort { step: h, least })));
    }
    let demand = Demand { leg, limit: integrator.limit, ..Demand::FIXED };
    system.begin();
    system.propose(0.0);
    let steps = steps as u64;
    for i in 1..=steps {
        let time = system.time();
        match safeguard::step(system, h, 0, &demand) {
            Ok(Advanced::Whole(_) | Advanced::TooFar(_)) => {}
            Ok(Advanced::Ended) => break,
            Err(failure) => return (counts, Err(failed(time, failure))),
        }
        // the sum of the parts of a step is off by rounding
        system.set_time(if i == steps { end } else { end - (steps - i) as f64 * h });
        counts.steps += 1;
    }
    (counts, Ok(()))
}

/// Advances in steps that keep a tolerance in m.
fn controlled<S: DiscreteGradientSystem>(
    system: &mut S,
    mut demand: Demand<'_>,
    (tolerance, horizon): (f64, f64),
    counts: &mut Counts,
) -> Result<(), FailedStep> {
    let (end, least) = (system.time() + horizon, horizon / MOST_STEPS);
    let proposal = system.proposal();
    let mut proposal = if proposal > 0.0 { proposal } else { horizon / FIRST_STEPS };
    let mut left = horizon;
    system.begin();
    while left > 0.0 {
        let spent = demand.limit.is_some_and(WorkLimit::is_spent);
        let least_now = if spent { least.max(STEP_BEYOND_LIMIT) } else { least };
        let parts = (left / proposal.max(least_now) - 1e-9).ceil().max(1.0);
        let (h, time) = (left / parts, system.time());
        let allowed = tolerance * (h / horizon).max(MIN_ERROR_SHARE);
        let shortest = h <= least * (1.0 + 1e-9);
        demand.allowed = if shortest || spent { f64::INFINITY } else { allowed };
        let next = |error: f64| {
            h * (TARGET_ERROR_SHARE * allowed / error).sqrt().clamp(RATIOS_OF_STEPS[0], RATIOS_OF_STEPS[1])
        };
        match safeguard::step(system, h, 0, &demand) {
            Ok(Advanced::Ended) => break,
            Ok(Advanced::TooFar(error)) => {
                counts.rejected += 1;
                proposal = next(error).min(LARGEST_RETRY * h);
                continue;
            }
            Ok(Advanced::Whole(error)) => {
                counts.steps += 1;
                counts.unresolved += u64::from(shortest && error > allowed);
                // one that was shortened to end with the host step does not lower the proposal
                // unless its error asks for it
                let fitting = if error > 0.0 { next(error) } else { h };
                proposal = if fitting < h { fitting } else { fitting.max(proposal) };
            }
            Err(failure) => return Err(FailedStep { time, step: h, failure }),
        }
        left = if parts == 1.0 { 0.0 } else { left - h };
        system.set_time(end - left);
    }
    system.propose(proposal);
    Ok(())
}
