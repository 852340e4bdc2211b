//! CPU time of repeated runs: median and spread.

use super::Options;
use std::time::Instant;

/// CPU time of repeated runs in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// The median.
    pub median: f64,
    /// The least.
    pub least: f64,
    /// The most.
    pub most: f64,
    /// Number of runs.
    pub runs: usize,
}

impl Timing {
    /// Of measured times; `None` of none.
    pub fn of(mut times: Vec<f64>) -> Option<Self> {
        times.sort_by(f64::total_cmp);
        let (least, most) = (*times.first()?, *times.last()?);
        let middle = times.len() / 2;
        let even = times.len().is_multiple_of(2);
        let median = if even { 0.5 * (times[middle - 1] + times[middle]) } else { times[middle] };
        Some(Timing { median, least, most, runs: times.len() })
    }
}

/// Repeats what returns its own time in s: as often as the options say, less often what takes seconds.
///
/// # Errors
/// That of the run.
pub fn repeat<E>(options: &Options, mut run: impl FnMut() -> Result<f64, E>) -> Result<Option<Timing>, E> {
    let begun = Instant::now();
    let mut times = Vec::new();
    loop {
        times.push(run()?);
        let spent = begun.elapsed().as_secs_f64();
        let enough = times.len() >= options.most_runs || times.len() >= options.least_runs && spent > options.budget;
        if enough || spent > options.patience {
            return Ok(Timing::of(times));
        }
    }
}
