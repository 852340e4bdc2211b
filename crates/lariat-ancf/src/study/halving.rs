//! The error in time where a study is coupled: of whole runs, each with all steps half as long.
//!
//! # Equation
//!
//! Run k divides each host step into `2^k` parts of length `H` and gives a part the tolerance
//! `tau_k = tau_0/8^k`. A step of length h errs by `C h^3` and may err by `tau h/H`
//! ([`discrete_gradient`](crate::integrate::discrete_gradient)), so that `h = (tau/(C H))^(1/2)` is
//! half of that of run k - 1; so are the least step `H/64`, the step across an impact, and the host
//! step itself, whatever limits a step. With the distance `d_k` between the runs k - 1 and k
//!
//! ```text
//! e_k = max(d_k, d_(k-1)/4)/(2^p - 1)
//! ```
//!
//! is the error of run k, where p is the order that the last two distances show, at most 1. The
//! method is of the second order where the motion is smooth; of the first across an impact, or
//! where friction begins to hold, at a time that a run knows to a step. A distance that falls by
//! more than the second order does so by chance, and is not believed. Nothing is claimed unless
//! three distances show the order 1/2 each, or are far below what is asked for.
//!
//! # Validity
//!
//! The host step of an engine, its contacts with cables and bodies that are free between two host
//! steps are part of these distances. Where they do not fall, as where an impact decides on which
//! side of an edge a cable falls, the motion is not determined by its start, from the horizon on.
//! Where a run with shorter steps fails they say no more than those before it.
//!
//! # References
//!
//! Roache 1998, *Verification and validation in computational science and engineering*, chapter 5.
//! Order of time-stepping schemes across impacts: Acary & Brogliato 2008, *Numerical methods for
//! nonsmooth dynamical systems*, chapter 10.

use super::claim::StudyError;
use super::order::{self, Difference};
use super::record::Record;
use super::runs::{Resolution, Run, Runs, Span};
use super::time::{Pilots, Time};
use crate::scales::study::{AT_LEAST, LOOSER, MOST_HALVINGS, SECOND, SHARE, SMALL};

/// The runs of two meshes, and their error in time.
pub(super) type Pair<W> = (Run<W>, Run<W>, Time);

impl Time {
    /// Returns the resolution of a run that has this error in time.
    pub(super) fn resolution(&self, elements: usize) -> Resolution {
        let parts = 1 << self.halvings.unwrap_or(0);
        Resolution { elements, tolerance: self.tolerance, max_step: None, parts, coupled: self.halvings.is_some() }
    }

    /// Returns the same after a number of halvings.
    fn halved(self, halvings: u32) -> Self {
        let before = self.halvings.unwrap_or(0);
        let share = LOOSER.powi(before as i32 - halvings as i32);
        Time { tolerance: self.tolerance.map(|tolerance| share * tolerance), halvings: Some(halvings), ..self }
    }
}

/// Returns the error in m of the last of several runs, each with steps half as long.
fn error_of_last(differences: &[Difference]) -> f64 {
    let [before @ .., last] = differences else { return f64::INFINITY };
    let least = before.last().map_or(0.0, |before| before.distance / SECOND);
    order::factor(differences, None, 1.0) * last.distance.max(least)
}

impl<F> Runs<F> {
    /// Returns the runs with `first` and twice as many elements in the steps that have their error
    /// in time, and that error.
    pub(super) fn in_halves<W, E>(&mut self, first: usize, span: Span) -> Result<Pilots<W>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let allowed = SHARE[0] * self.error;
        let tolerance = LOOSER.powi(AT_LEAST as i32) * self.length / (4.0 * span.steps);
        let mut time = Time { tolerance: Some(tolerance), halvings: Some(0), ..Time::default() };
        let mut fine: Run<W> = self.run(time.resolution(2 * first))?;
        let mut differences = Vec::new();
        let mut proven = false;
        while time.halvings < Some(MOST_HALVINGS) && !proven {
            let halved = time.halved(differences.len() as u32 + 1);
            let next = match self.run(halved.resolution(2 * first)) {
                Err(StudyError::Run { .. }) if !differences.is_empty() => {
                    time.failed = self.failed;
                    break;
                }
                outcome => outcome?,
            };
            time = halved;
            let loose = std::mem::replace(&mut fine, next);
            let distance = loose.record.distance(&fine.record)?;
            differences.push(Difference { distance, ratio: 2.0 });
            time.error = error_of_last(&differences);
            time.horizon = self.not_together(&loose, &fine, allowed * distance / time.error);
            proven = time.error <= allowed && order::converge(&differences, AT_LEAST, self.error);
            if !proven && order::stuck(&differences) {
                break;
            }
        }
        time.stuck = !proven;
        time.horizon = time.horizon.filter(|_| time.stuck);
        Ok((self.run(time.resolution(first))?, fine, time))
    }

    /// Returns two meshes in steps whose error in time is at most `left` (m) on the finer one, too,
    /// and that error.
    pub(super) fn confirmed<W, E>(
        &mut self,
        (coarse, mut fine, before): Pair<W>,
        left: f64,
    ) -> Result<Pair<W>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let mut time = before;
        let Some(halvings) = before.halvings else { return Ok((coarse, fine, time)) };
        let mut differences = Vec::new();
        let elements = fine.elements;
        let looser = |coarser: u32| before.halved(halvings - coarser).resolution(elements);
        let Some(mut loose) = self.attempt(looser(AT_LEAST as u32))? else {
            let time = self.unknown(time, &fine);
            return Ok((coarse, fine, time));
        };
        for coarser in (1..AT_LEAST as u32).rev() {
            let Some(next) = self.attempt(looser(coarser))? else {
                let time = self.unknown(time, &fine);
                return Ok((coarse, fine, time));
            };
            differences.push(Difference { distance: loose.record.distance(&next.record)?, ratio: 2.0 });
            loose = next;
        }
        loop {
            let distance = loose.record.distance(&fine.record)?;
            differences.push(Difference { distance, ratio: 2.0 });
            // where the first mesh erred by more, agreement of this one is chance
            let fallen = before.error / SECOND.powi((differences.len() - AT_LEAST) as i32);
            time.error = error_of_last(&differences).max(fallen);
            if time.error <= left && order::converge(&differences, AT_LEAST, self.error) {
                break;
            }
            if time.halvings >= Some(MOST_HALVINGS) || order::stuck(&differences) {
                time.stuck = true;
                time.horizon = self.not_together(&loose, &fine, left * distance / time.error);
                break;
            }
            let halved = time.halved(time.halvings.unwrap_or(0) + 1);
            let Some(next) = self.attempt(halved.resolution(elements))? else {
                time = self.unknown(time, &fine);
                time.horizon = loose.record.first_beyond(&fine.record, left * distance / time.error).or(time.horizon);
                break;
            };
            time = halved;
            loose = std::mem::replace(&mut fine, next);
        }
        if time.halvings == before.halvings {
            return Ok((coarse, fine, time));
        }
        match self.attempt(time.resolution(coarse.elements))? {
            Some(coarse) => Ok((coarse, fine, time)),
            None => {
                let time = self.unknown(time, &fine);
                Ok((coarse, fine, time))
            }
        }
    }

    /// Returns the first time in s at which two runs are further apart than a distance in m, or,
    /// where they are near each other and come no closer, than is small beside the error.
    fn not_together<W>(&self, loose: &Run<W>, fine: &Run<W>, distance: f64) -> Option<f64> {
        let beyond = |distance: f64| loose.record.first_beyond(&fine.record, distance);
        beyond(distance).or_else(|| beyond(SMALL * self.error))
    }

    /// Returns the error in time where the run that should show it failed.
    fn unknown<W>(&self, time: Time, fine: &Run<W>) -> Time {
        Time { stuck: true, failed: self.failed, horizon: fine.record.first_time(), ..time }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* Series of a known order: the sum of all later distances.
    #[test]
    fn the_error_of_the_last_run_is_that_of_the_series() {
        for order in [0.3, 0.5, 1.0, 2.0, 3.0] {
            let all: Vec<_> =
                (0..3).map(|k| Difference { distance: 2f64.powf(-order * f64::from(k)), ratio: 2.0 }).collect();
            let rest: f64 = (3..400).map(|k| 2f64.powf(-order * f64::from(k))).sum();
            let found = error_of_last(&all);
            assert!(found >= (1.0 - 1e-9) * rest, "{order}: {found} {rest}");
        }
        // one that is small by chance
        let lucky = [1.0, 1e-6].map(|distance| Difference { distance, ratio: 2.0 });
        assert!(error_of_last(&lucky) >= 0.25);
        assert_eq!(error_of_last(&[]), f64::INFINITY);
    }

    /// A halving divides the tolerance of a part by eight, and the host step by two.
    #[test]
    fn tolerances_follow_the_halvings() {
        let time = Time { tolerance: Some(1.0), halvings: Some(1), ..Time::default() };
        let [less, more] = [0, 3].map(|halvings| time.halved(halvings).resolution(4));
        assert_eq!((less.tolerance, less.parts, more.tolerance, more.parts), (Some(8.0), 1, Some(1.0 / 64.0), 8));
        assert!(less.coupled && !Time::default().resolution(4).coupled);
    }
}
