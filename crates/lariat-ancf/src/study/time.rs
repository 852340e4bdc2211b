//! The error in time of the first runs, and the tolerance of the others.
//!
//! # Equation
//!
//! Two runs of the same mesh are `d` apart, one with `r` times as many steps as the other. With an
//! error `C h^p` in the mean step `h` the one with longer steps is off by `d r^p/(r^p - 1)`, the
//! other by `d/(r^p - 1)`.
//!
//! - Runs at `q tau` and `tau`, q = 8 at first, with `r >= q^(1/4)`, as steps have that follow a
//!   tolerance: the error at `tau` is `d/(q^(1/2) - 1)`, p = 2 with `r = q^(1/4)`. Steps that a
//!   vibration makes shorter than that are no measure of the rest.
//! - Below, the host step limits the steps of the looser one, or of both, so that they are near
//!   each other whatever their error. The run at `tau` is compared with one in equal steps, 1.6 to
//!   3 times as short in the mean: its error is `d r/(r - 1)`, p = 1, and one `tau` for vibrations
//!   that are faster than the steps of both, which damp them: the error estimate of a step sees
//!   their amplitude.
//!
//! Where a run takes hardly more steps than the host, none at a looser tolerance is taken. By two
//! tolerances, the error is at least the sum `T/dt tau` of the tolerances; where the host step
//! limits the steps, errors are far below the tolerance, and the sum would claim up to 1e5 times
//! the true error. If the error is above 0.4 of what is asked for, the next run has a tolerance
//! that the error asks for, and is judged in the same way.
//!
//! # Validity
//!
//! ESDIRK4 with local extrapolation has order 4 in the step, and 2 or more where stiff modes reduce
//! it. Errors per step that a motion amplifies, as a rotation whose rate is off, are in the
//! distance, but not in any bound by the sum of tolerances: a bar that swings for two seconds in
//! steps of 1/30 s is off by 2.4 times that sum. The run in equal steps has the mesh of the coarser
//! pilot if both take as many steps. Vibrations that are faster than all steps, and smaller than
//! the tolerance, are in no run. Runs that do not come closer with the tolerance, or not enough in
//! a few rounds, have no error in time: the motion is not determined by its start, from the horizon
//! on. Neither have those of which one at a tighter tolerance fails: rounding keeps its steps from
//! being solved, and what is known is what looser ones say.
//!
//! # References
//!
//! Hairer, Norsett, Wanner 1993, section II.4 (local extrapolation, tolerance proportionality).
//!
//! # Alternatives considered
//!
//! - A run at a smaller tolerance instead of equal steps: up to 115 times the cost of the run it
//!   judges, where a stiff cable then rings.

use super::claim::{FailedRun, StudyError};
use super::record::Record;
use super::runs::{Resolution, Run, Runs, Span};
use crate::scales::study::{CLOSER, LOOSER, ROUNDS, SATURATED, SHARE, SHORTER, TIGHTEST};

/// Error in time of the first runs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Time {
    /// In m.
    pub error: f64,
    /// True if the host step limits the steps.
    pub saturated: bool,
    /// True if smaller tolerances do not bring runs together.
    pub stuck: bool,
    /// First time in s at which they are not together.
    pub horizon: Option<f64>,
    /// The run whose failure keeps it from being known.
    pub failed: Option<FailedRun>,
    /// Tolerance that has it.
    pub tolerance: Option<f64>,
    /// How often the host step was halved for it, where the study is coupled.
    pub halvings: Option<u32>,
}

/// The runs of a mesh and of one twice as fine, and their error in time.
pub(super) type Pilots<W> = (Run<W>, Run<W>, Time);

impl<F> Runs<F> {
    /// Returns the runs with `first` and twice as many elements at the tolerance that they have
    /// their error in time for, and that error.
    pub(super) fn in_time<W, E>(&mut self, first: usize, span: Span) -> Result<Pilots<W>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let at = |elements, tolerance| Resolution { elements, tolerance: Some(tolerance), ..Resolution::default() };
        let [allowed, aim] = SHARE.map(|share| share * self.error);
        let (mut tau, mut looser, mut before) = (self.length / (4.0 * span.steps), LOOSER, f64::INFINITY);
        let mut fine = self.run(at(2 * first, tau))?;
        // no tolerance has fewer steps than the host: a looser one says nothing where this one has
        // hardly more
        let one_each = |run: &Run<W>| run.record.steps() > 0 && run.record.steps_of_one() < SATURATED * span.steps;
        let mut loose = if one_each(&fine) { None } else { Some(self.run(at(2 * first, LOOSER * tau))?) };
        let least = TIGHTEST * fine.record.longest();
        for round in 1.. {
            // not a number without cables, whose steps are not known: then the tolerance is taken
            // to be kept
            let (ratio, distance) = match &loose {
                Some(loose) => {
                    (fine.record.steps() as f64 / loose.record.steps() as f64, loose.record.distance(&fine.record)?)
                }
                None => (1.0, 0.0),
            };
            let time = Time { saturated: ratio < SATURATED, tolerance: Some(tau), ..Time::default() };
            let limited = ratio < looser.powf(0.25);
            let mut failed = None;
            let error = if limited {
                match self.by_equal_steps(at(first, tau), &fine, span) {
                    Ok((coarse, error)) if error <= allowed => return Ok((coarse, fine, Time { error, ..time })),
                    Ok((_, error)) => error,
                    // of the looser tolerance of the round before all runs worked
                    Err(StudyError::Run { .. }) if round > 1 => {
                        failed = self.failed;
                        allowed.max(distance)
                    }
                    Err(error) => return Err(error),
                }
            } else {
                (distance / (looser.sqrt() - 1.0)).max(self.of_length(span.steps * tau))
            };
            // a difference that is not finite says nothing about the tolerance: the meshes are
            // compared, and do not agree
            if failed.is_none() && (error <= allowed || !error.is_finite()) {
                return Ok((self.run(at(first, tau))?, fine, Time { error, ..time }));
            }
            let next = (tau * aim / error).clamp(tau / 64.0, tau / LOOSER);
            let stuck = round == ROUNDS || next < least || !limited && distance > CLOSER * before;
            let tighter = if stuck || failed.is_some() { None } else { self.attempt(at(2 * first, next))? };
            let Some(tighter) = tighter else {
                // what has no tighter run has failed, unless none was taken
                let failed = if stuck { failed } else { self.failed };
                let horizon = loose.as_ref().and_then(|loose| loose.record.first_beyond(&fine.record, allowed));
                let horizon = horizon.or_else(|| failed.and_then(|_| fine.record.first_time()));
                let (kept, tolerance) = loose.map_or((fine, tau), |loose| (loose, looser * tau));
                let time = Time {
                    error: distance.max(error),
                    stuck: true,
                    horizon,
                    failed,
                    tolerance: Some(tolerance),
                    ..time
                };
                return Ok((self.run(at(first, tolerance))?, kept, time));
            };
            // a run with one step per host step keeps no tolerance, and may be near the next one by
            // chance
            let by_host = limited || loose.as_ref().is_some_and(one_each);
            before = if by_host { f64::INFINITY } else { distance };
            (looser, tau, loose) = (tau / next, next, Some(fine));
            fine = tighter;
        }
        unreachable!("the last round returns")
    }

    /// Returns the run of the coarser mesh at the tolerance of a run, and their error in m by one
    /// in equal steps.
    fn by_equal_steps<W, E>(
        &mut self,
        coarse: Resolution,
        fine: &Run<W>,
        span: Span,
    ) -> Result<(Run<W>, f64), StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let tolerance = coarse.tolerance.unwrap_or(0.0);
        let coarse = self.run(coarse)?;
        let error = self.in_equal_steps(&coarse, fine, span)? + self.of_length(tolerance);
        Ok((coarse, error))
    }

    /// Returns the error in m of the steps of two runs with the same tolerance, by one in equal
    /// steps that are 1.6 times as short or shorter.
    fn in_equal_steps<W, E>(&mut self, coarse: &Run<W>, fine: &Run<W>, span: Span) -> Result<f64, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let [some, others] = [fine, coarse].map(|run| run.record.steps() as f64);
        let same = some.max(others) <= SATURATED * some.min(others);
        let run = if same { coarse } else { fine };
        let mean = span.steps * span.host_step / run.record.steps_of_one();
        let check = Resolution { elements: run.elements, max_step: Some(mean / SHORTER), ..Resolution::default() };
        let check = self.run(check)?;
        let ratio = check.record.steps() as f64 / run.record.steps() as f64;
        let distance = run.record.distance(&check.record)?;
        Ok(if ratio > SATURATED { distance * ratio / (ratio - 1.0) } else { f64::INFINITY })
    }
}
