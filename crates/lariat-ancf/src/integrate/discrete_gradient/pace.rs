//! How many equal steps a host step has: 1, 2, 4 or 8 in 1/60 s, by the error of the last one.
//!
//! # Equation
//!
//! With n steps in F = 1/60 s, a step of length h has the [estimated error](crate::island) e, which
//! is `E = e F/(h L)` as a share of the size L in F, and falls by n^-2. L is the length of the
//! shortest cable, and at most 1 m: a rope that turns about its end by x rad in a step has `e =
//! (1/12 + a) x^3 L`, whatever its length. Of 1, 2 and 4 the next host step has the smallest n'
//! with
//!
//! ```text
//! E (n/n')^2 <= tolerance/2
//! ```
//!
//! A step longer than F/4 has the dissipation a = 1/256, and is not taken if E is above the
//! tolerance: the rest of the host step has more. So what a calm swing of angular frequency w
//! loses, `a (h w)^3` of its energy per radian, is at most four times that of steps of F/4 with
//! 1/16.
//!
//! After the number has risen to 2 or 4 it does not fall for half a second: where it does, the next
//! step is of order 1, and where it rises, a part of the energy in the store is lost.
//!
//! It has 8 if E with 4 is above 3e-3; but if E did not halve from 4 to 8, the motion is not
//! resolved by either, and it has 4 until E is below that with 4.
//!
//! At least 4 are taken where the estimate says nothing about what comes: by the first host step,
//! after an edit, a wake, or a change of a body by the host; with contact,
//! torsion, and where reels move; after a step that was divided or rescaled. A host step that is no
//! multiple of F/n has the fewest equal steps that are no longer.
//!
//! # Validity
//!
//! All that is asked for is the state, so that a restored run continues bitwise. Vibrations that a
//! long step does not resolve fall to 0.97 in each of them, in place of 1/3.
//!
//! # References
//!
//! Hairer, Norsett & Wanner 1993, II.4 (step size control).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

use super::safeguard::{Advanced, Demand, Estimate};
use super::{DiscreteGradientSystem, Pace, safeguard};
use crate::error::StepFailure;
use crate::integrate::WorkLimit;
use crate::integrate::step_control::{Counts, FailedStep};
use crate::one_leg::OneLeg;
use crate::scales::integrate::{
    CALM_TIME, COARSE, FRAME, LITTLE_DISSIPATION, MIN_STEP_SHARE, MOST_IN_FRAME, SINGLE_PRECISION_ROUNDING,
    TARGET_ERROR_SHARE, USUAL_IN_FRAME,
};

/// Advances by `horizon` (s) with a tolerance, a share of the [size](DiscreteGradientSystem::size).
pub(super) fn advance<S: DiscreteGradientSystem>(
    system: &mut S,
    mut demand: Demand<'_>,
    (tolerance, horizon): (f64, f64),
    counts: &mut Counts,
) -> Result<(), FailedStep> {
    let (end, splits) = (system.time() + horizon, system.splits());
    let (proposal, disturbed, size) = (system.proposal(), system.needs_short_steps(), system.size());
    let is_known = proposal > 0.0 && !disturbed;
    let mut number = if is_known { (FRAME / proposal).clamp(1.0, MOST_IN_FRAME) } else { USUAL_IN_FRAME };
    let (mut steps, mut h) = equal_steps(horizon, number);
    let leg = demand.leg;
    let least = MIN_STEP_SHARE * horizon;
    if h < least {
        let failure = StepFailure::TooShort { step: h, least };
        return Err(FailedStep { time: system.time(), step: h, failure });
    }
    system.begin();
    let (mut taken, mut error, mut rejected) = (0, f64::INFINITY, false);
    while taken < steps {
        let time = system.time();
        let is_spent = demand.limit.is_some_and(WorkLimit::is_spent);
        let is_long = h * USUAL_IN_FRAME > FRAME * (1.0 + 2.0 * SINGLE_PRECISION_ROUNDING);
        let is_last = taken + 1 == steps && !disturbed;
        demand.leg = if is_long { OneLeg::new(leg.a.min(LITTLE_DISSIPATION)) } else { leg };
        demand.estimate = if is_long || is_last { Estimate::Pace } else { Estimate::No };
        demand.allowed = if is_long && !is_spent { tolerance * size * h / FRAME } else { f64::INFINITY };
        match safeguard::step(system, h, 0, &demand) {
            Ok(Advanced::Ended) => break,
            Ok(Advanced::TooFar(error)) => {
                counts.rejected += 1;
                rejected = true;
                let needed = fewest(error * FRAME / (h * size), FRAME / h, tolerance);
                number = needed.max(2.0 * number).min(USUAL_IN_FRAME);
                (steps, h) = equal_steps((steps - taken) as f64 * h, number);
                taken = 0;
                continue;
            }
            Ok(Advanced::Whole(estimate)) => error = estimate,
            Err(failure) => return Err(FailedStep { time, step: h, failure }),
        }
        taken += 1;
        counts.steps += 1;
        // the sum of the parts of a step is off by rounding
        system.set_time(if taken == steps { end } else { end - (steps - taken) as f64 * h });
    }
    let mut pace = system.pace();
    pace.wary = pace.wary.saturating_sub(1);
    let next = if disturbed {
        pace = Pace::default();
        0.0
    } else {
        let known = system.splits() == splits && taken == steps;
        let error = if known { error * FRAME / (h * size) } else { f64::INFINITY };
        let next = next(&mut pace, error, FRAME / h, tolerance);
        if next.min(USUAL_IN_FRAME) > number.min(USUAL_IN_FRAME) || rejected {
            pace.wary = (CALM_TIME / horizon).min(f64::from(u8::MAX)) as u8;
        }
        FRAME / if pace.wary > 0 { next.max(number.min(USUAL_IN_FRAME)) } else { next }
    };
    system.propose(next);
    system.set_pace(pace);
    Ok(())
}

/// Returns the fewest equal steps of a time in s that are not longer than with `number` in 1/60 s,
/// and their length in s.
fn equal_steps(time: f64, number: f64) -> (u64, f64) {
    let longest = FRAME / number * (1.0 + SINGLE_PRECISION_ROUNDING);
    let steps = (time / longest - 1e-9).ceil().max(1.0);
    (steps as u64, time / steps)
}

/// Returns the fewest steps in 1/60 s, up to those of games, that keep a tolerance, if `number` had
/// this error, a share of the size in 1/60 s.
fn fewest(error: f64, number: f64, tolerance: f64) -> f64 {
    let mut fewest = 1.0;
    while fewest < USUAL_IN_FRAME && error * (number / fewest).powi(2) > TARGET_ERROR_SHARE * tolerance {
        fewest *= 2.0;
    }
    fewest
}

/// Returns how many steps in 1/60 s follow on `number` with an error, a share of the size in
/// 1/60 s; infinite if it is not known.
fn next(pace: &mut Pace, error: f64, number: f64, tolerance: f64) -> f64 {
    if !error.is_finite() {
        pace.halved_at = 0.0;
        return USUAL_IN_FRAME;
    }
    let with_usual = error * (number / USUAL_IN_FRAME).powi(2);
    let is_halved = number > USUAL_IN_FRAME * (1.0 + 2.0 * SINGLE_PRECISION_ROUNDING);
    if is_halved && pace.halved_at > 0.0 && error > 0.5 * f64::from(pace.halved_at) {
        pace.unresolved = true;
    }
    pace.unresolved &= with_usual > COARSE;
    if with_usual <= COARSE || pace.unresolved {
        pace.halved_at = 0.0;
        return fewest(error, number, tolerance);
    }
    if !is_halved {
        pace.halved_at = error as f32;
    }
    MOST_IN_FRAME
}
