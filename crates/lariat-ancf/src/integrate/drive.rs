//! Choosing the steps: from one host step to the next, exactly.
//!
//! With a tolerance, a step h of a host step H is accepted if its estimated error is below `tolerance h/H` (error per unit
//! step; a step shorter than H/1024 is allowed tolerance/1024), so that the errors of up to 1024 steps add up to the
//! tolerance. The next h follows from the estimate's order p, `h (0.5 allowed/error)^(1/(p-1))`, within 1/5 and 3. What is left of the host step is split evenly once fewer than two steps
//! remain, and the last step ends on the host's time to the bit. *Source.* Hairer & Wanner 1996, IV.8.
//!
//! Generalised-alpha without a tolerance does not see that a step is too long for a slack cable that is thrown about, and makes energy. Where
//! Newton needed more than its iteration and the check of it, or slopes changed their rates by a strain of 1e-3 over the step and by a
//! quarter, the energy made beyond the work from outside is asked for. If with it more than 1e-3 of the kinetic and strain energy was made in
//! this host step, the step is retried at 1/4, and below 1/8 of the regular step by `backward_euler`, down to 1/1024
//! of it. Calm steps are not asked. *Measured.* `lariat stability --family random`: none of 500 scenes misses its bound of energy; 16 did when
//! only steps with more iterations were asked, and none was backward Euler's.
//!
//! A step that fails (Newton, a pivot, a number that is not finite) is retried at 1/4 of its length down to H/2^20; then the drive
//! stops, and the phase is the last good one, restored to the beginning of the host step by the caller. Where the tangent is
//! not exact, Newton's contraction is linear, worse with the length, and as bad in the next step: the steps after one that failed are at most half as
//! long, and 1.2 times that with every step; error control knows nothing of Newton and would try the same length at once.
//! *Measured.* `lariat stability --case "hanging 1e4"`, 1/30 s with effects: 988 of 5466 steps rejected; 3889 of 9227 without this bound.

use super::fidelity::StepControl;
use super::method::{Method, Stepper};
use super::{Dynamics, Memory, OneStep, Scratch, State, backward_euler};
use crate::error::StepFailure;

/// Steps are not shortened below H times this.
const SHORTEST: f64 = 1.0 / (1u64 << 20) as f64;
/// A step is allowed at least this share of the tolerance: after a jump of velocity errors fall only as fast as h.
const LEAST_SHARE: f64 = 1.0 / 1024.0;
/// Newton stops below this share of the error allowed to a step.
const NEWTON_SHARE: f64 = 0.1;
/// The next step aims at this share of the allowed error: fewer rejections (one half costs less than 0.8, measured).
const SAFETY: f64 = 0.5;
/// Newton's tolerance in m where no error is controlled.
const FIXED_STEP_NEWTON: f64 = 1e-10;

/// A host's step may be off by this share: 1/60 s in single precision is longer than four steps of 1/240 s.
const SINGLE: f64 = 1e-7;

/// A linearly implicit step takes this many Newton iterations, with the check.
const CALM_ITERATIONS: u64 = 2;
/// Share of the kinetic and strain energy that a laboured step of a method without error control may make.
const ENERGY_MADE: f64 = 1e-3;
/// Steps below H times this are not asked for their energy.
const LEAST_CHECKED: f64 = 1.0 / 1024.0;

/// A step in which the rate of a slope changes by less than this over its length is calm.
const BRISK: f64 = 1e-3;
/// ... or by less than this share of the largest of these rates.
const BRISK_SHARE: f64 = 0.25;
/// After a step that made energy, steps below the regular one times this are backward Euler's.
const EULER_BELOW: f64 = 1.0 / 8.0;

/// Of a step that Newton failed at, the share that the steps after it may have.
const BELOW_FAILED: f64 = 0.5;
/// ... and by which it grows with every step.
const RECOVERY: f64 = 1.2;

/// What a drive did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Steps accepted.
    pub steps: u64,
    /// Steps rejected.
    pub rejected: u64,
}

/// A host step that could not be done.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// Time at which the step that failed began, in s.
    pub time: f64,
    /// Its length in s.
    pub step: f64,
    /// Why it failed.
    pub failure: StepFailure,
}

/// Advances `phase` by `horizon` (s).
///
/// # Errors
/// [`Refusal`] if a step cannot be done; `phase` is then the last state reached.
pub fn advance(
    system: &mut dyn Dynamics,
    method: Method,
    control: StepControl,
    phase: &mut State,
    horizon: f64,
    scratch: &mut Scratch,
    counts: &mut Counts,
) -> Result<(), Refusal> {
    let stepper = method.stepper();
    let one_step = stepper.one_step();
    scratch.resize(system.size(), one_step.stages().max(1));
    prepare(system, phase, matches!(stepper, Stepper::Alpha(_)))?;
    system.reached(phase);
    let end = phase.time + horizon;
    let tolerance = match control {
        StepControl::Tolerance(tolerance) => Some(tolerance),
        _ => None,
    };
    let order = method.properties().estimate_order.unwrap_or(2);
    let regular = regular_step(system, &stepper, control, horizon, phase.memory.step);
    check_stability(system, &stepper, regular, phase.time)?;
    if regular < SHORTEST * horizon && tolerance.is_none() {
        let failure = StepFailure::TooShort { step: regular, least: SHORTEST * horizon };
        return Err(Refusal { time: phase.time, step: regular, failure });
    }
    let mut proposal = regular;
    let checked = tolerance.is_none() && matches!(stepper, Stepper::Alpha(_));
    // energy made since the host step began, and whether a step was rejected for it
    let (mut made_so_far, mut troubled) = (0.0, false);
    // after Newton has failed with an inexact tangent, steps come near the length that it failed at only slowly
    let mut most = f64::INFINITY;
    let mut done = 0.0;
    while done < horizon {
        let (h, last) = fit(proposal, horizon - done, tolerance.is_some());
        let newton = tolerance.map_or(FIXED_STEP_NEWTON, |t| NEWTON_SHARE * t * (h / horizon).clamp(LEAST_SHARE, 1.0));
        let iterations = system.iterations();
        let euler = troubled && h < EULER_BELOW * regular;
        let one_step: &dyn OneStep = if euler { &backward_euler::TABLEAU } else { one_step };
        let outcome = one_step.step(system, phase, h, newton, tolerance.is_some(), scratch).and_then(|estimate| {
            if euler {
                let Memory { acceleration, algorithmic, .. } = &mut scratch.next.memory;
                algorithmic.copy_from_slice(acceleration);
            }
            finite(&scratch.next.q, "position")?;
            finite(&scratch.next.v, "velocity")?;
            finite(&scratch.next.memory.acceleration, "acceleration")?;
            match estimate {
                Some(e) if !e.is_finite() => Err(StepFailure::NotFinite { what: "error estimate", node: 0 }),
                _ => Ok(estimate),
            }
        });
        let laboured = system.iterations() - iterations > CALM_ITERATIONS;
        let asked = checked && outcome.is_ok() && (laboured || euler || is_brisk(phase, &scratch.next, h));
        if asked && h > LEAST_CHECKED * regular {
            scratch.next.time = phase.time + h;
            if let Some((made, scale)) = system.energy_made(phase, &scratch.next, h) {
                if made_so_far + made > ENERGY_MADE * scale && made > 0.0 {
                    counts.rejected += 1;
                    proposal = 0.25 * h;
                    troubled = true;
                    continue;
                }
                made_so_far += made;
            }
        }
        let refuse = |failure, time| Err(Refusal { time, step: h, failure });
        match (outcome, tolerance) {
            (Err(failure), _) => {
                counts.rejected += 1;
                proposal = 0.25 * h;
                if !system.exact_tangent() {
                    most = BELOW_FAILED * h;
                }
                if proposal < SHORTEST * horizon {
                    return refuse(failure, phase.time);
                }
                continue;
            }
            (Ok(Some(estimate)), Some(tolerance)) => {
                let allowed = tolerance * (h / horizon).max(LEAST_SHARE);
                let factor = root(SAFETY * allowed / estimate.max(1e-300), order - 1).clamp(0.2, 3.0);
                if estimate > allowed {
                    counts.rejected += 1;
                    proposal = h * factor.min(0.9);
                    if proposal < SHORTEST * horizon {
                        return refuse(StepFailure::ErrorTooLarge { estimate, allowed }, phase.time);
                    }
                    continue;
                }
                // a step cut short to land does not lower the proposal
                proposal = if last { proposal.max(h * factor).min(3.0 * h.max(proposal)) } else { h * factor };
            }
            _ => proposal = (2.0 * proposal).min(regular),
        }
        proposal = proposal.min(most);
        most *= RECOVERY;
        accept(phase, scratch, matches!(stepper, Stepper::Alpha(_)));
        scratch.next.time = phase.time;
        system.accepted(&scratch.next, phase, h);
        counts.steps += 1;
        done += h;
        phase.time = end - (horizon - done);
        if last {
            phase.time = end;
        }
        system.reached(phase);
        if last {
            break;
        }
    }
    phase.memory.step = if tolerance.is_some() { proposal } else { 0.0 };
    Ok(())
}

/// Makes the phase consistent: prescribed coordinates in place, acceleration known.
fn prepare(system: &mut dyn Dynamics, phase: &mut State, algorithmic: bool) -> Result<(), Refusal> {
    let n = system.size();
    if phase.memory.valid && (!algorithmic || phase.memory.algorithmic.len() == n) {
        return Ok(());
    }
    phase.memory.acceleration.resize(n, 0.0);
    system.prescribe(phase.time, &mut phase.q, &mut phase.v);
    system.acceleration(phase.time, &phase.q, &phase.v, &mut phase.memory.acceleration).map_err(|failure| Refusal {
        time: phase.time,
        step: 0.0,
        failure,
    })?;
    phase.memory.algorithmic.clear();
    if algorithmic {
        phase.memory.algorithmic.extend_from_slice(&phase.memory.acceleration);
    }
    phase.memory.valid = true;
    Ok(())
}

/// Refuses an explicit step that would blow up: the frequency bound is that of one element plus 5 %, and tight.
fn check_stability(system: &dyn Dynamics, stepper: &Stepper, step: f64, time: f64) -> Result<(), Refusal> {
    if let Stepper::Explicit(composition) = stepper {
        let limit = 1.05 * composition.stability_limit / system.frequency_bound().max(1e-12);
        if step > limit {
            return Err(Refusal { time, step, failure: StepFailure::Unstable { step, limit } });
        }
    }
    Ok(())
}

/// The step to begin with.
fn regular_step(system: &dyn Dynamics, stepper: &Stepper, control: StepControl, horizon: f64, memory: f64) -> f64 {
    let equal = |longest: f64| horizon / (horizon / longest - 1e-9).ceil().max(1.0);
    match control {
        StepControl::Tolerance(_) if memory > 0.0 => memory,
        StepControl::Tolerance(_) => 0.1 * horizon,
        StepControl::Substeps(substeps) => horizon / f64::from(substeps),
        StepControl::MaxStep(longest) => equal(longest * (1.0 + SINGLE)),
        StepControl::Stable(share) => match stepper {
            Stepper::Explicit(composition) => {
                equal(share * composition.stability_limit / system.frequency_bound().max(1e-12))
            }
            _ => horizon,
        },
    }
}

/// The next step and whether it is the last.
fn fit(proposal: f64, left: f64, even: bool) -> (f64, bool) {
    if proposal >= left * (1.0 - 1e-9) {
        (left, true)
    } else if even && proposal > 0.5 * left {
        (0.5 * left, false)
    } else {
        (proposal, false)
    }
}

/// Whether slopes change their rates by so much that the step may have made energy: by a strain of [`BRISK`] within it, and by
/// [`BRISK_SHARE`] of the largest rate, as those of a rope that swings do not.
fn is_brisk(before: &State, after: &State, h: f64) -> bool {
    let (mut change, mut rate) = (0.0f64, 0.0f64);
    for (v, w) in before.v.chunks_exact(6).zip(after.v.chunks_exact(6)) {
        let d = [w[3] - v[3], w[4] - v[4], w[5] - v[5]];
        change = change.max(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        rate = rate.max(v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
    }
    change * h * h > BRISK * BRISK && change > BRISK_SHARE * BRISK_SHARE * rate
}

/// Takes over the step in `scratch`; only generalised-alpha has algorithmic accelerations.
fn accept(phase: &mut State, scratch: &mut Scratch, algorithmic: bool) {
    core::mem::swap(&mut phase.q, &mut scratch.next.q);
    core::mem::swap(&mut phase.v, &mut scratch.next.v);
    core::mem::swap(&mut phase.memory.acceleration, &mut scratch.next.memory.acceleration);
    if algorithmic {
        core::mem::swap(&mut phase.memory.algorithmic, &mut scratch.next.memory.algorithmic);
    }
}

/// The `degree`-th root, 1 to 3, by basic arithmetic: a library's `powf` may give other bits on another processor.
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

fn finite(x: &[f64], what: &'static str) -> Result<(), StepFailure> {
    match x.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(i) => Err(StepFailure::NotFinite { what, node: i / 6 }),
    }
}
