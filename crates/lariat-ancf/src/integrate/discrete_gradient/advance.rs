//! From one host step to the next, which the last step reaches exactly, in equal steps.

use super::{DiscreteGradientSystem, safeguard};
use crate::error::StepFailure;
use crate::integrate::step_control::{Counts, FailedStep};
use crate::integrate::{IntegratorRef, StepControl};
use crate::scales::integrate::{MIN_STEP_SHARE, SINGLE_PRECISION_ROUNDING};

/// Advances the system by `horizon` (s), and returns the numbers of steps with the outcome. After a failure the state is the last accepted
/// one.
pub(crate) fn advance<S: DiscreteGradientSystem>(
    system: &mut S,
    integrator: IntegratorRef<'_>,
    horizon: f64,
) -> (Counts, Result<(), FailedStep>) {
    let mut counts = Counts::default();
    let longest = match integrator.control {
        StepControl::Substeps(substeps) => horizon / f64::from(substeps),
        StepControl::MaxStep(longest) => longest * (1.0 + SINGLE_PRECISION_ROUNDING),
        // rejected by `IntegratorRef::check`
        StepControl::Tolerance(_) | StepControl::ToleranceOf(..) | StepControl::Stable(_) => horizon,
    };
    let steps = (horizon / longest - 1e-9).ceil().max(1.0);
    let (h, end) = (horizon / steps, system.time() + horizon);
    let failed = |time, failure| FailedStep { time, step: h, failure };
    let least = MIN_STEP_SHARE * horizon;
    if h < least {
        return (counts, Err(failed(system.time(), StepFailure::TooShort { step: h, least })));
    }
    system.begin();
    let steps = steps as u64;
    for i in 1..=steps {
        let time = system.time();
        match safeguard::step(system, h, 0, integrator.limit) {
            Ok(true) => {}
            Ok(false) => break,
            Err(failure) => return (counts, Err(failed(time, failure))),
        }
        // the sum of the parts of a step is off by rounding
        system.set_time(if i == steps { end } else { end - (steps - i) as f64 * h });
        counts.steps += 1;
    }
    (counts, Ok(()))
}
