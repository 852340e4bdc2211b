//! CPU time of repeated runs: median and spread.

use std::time::Instant;

/// CPU time of repeated runs in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// The median.
    pub median: f64,
    /// The smallest.
    pub least: f64,
    /// The largest.
    pub most: f64,
    /// Number of runs.
    pub runs: usize,
}

impl Timing {
    /// Returns median and extremes of measured times; `None` if there are none.
    pub fn of(mut times: Vec<f64>) -> Option<Self> {
        times.sort_by(f64::total_cmp);
        let (least, most) = (*times.first()?, *times.last()?);
        let middle = times.len() / 2;
        let even = times.len().is_multiple_of(2);
        let median = if even { 0.5 * (times[middle - 1] + times[middle]) } else { times[middle] };
        Some(Timing { median, least, most, runs: times.len() })
    }
}

/// How often a run is repeated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeats {
    /// Smallest number of runs.
    pub least: usize,
    /// Largest number of runs.
    pub most: usize,
    /// Wall time in s after which the smallest number is enough.
    pub enough: f64,
    /// Wall time in s after which one run is enough.
    pub limit: f64,
}

/// Repeats a run that returns its own time in s.
///
/// # Errors
/// That of the run.
pub fn repeat<E>(repeats: Repeats, mut run: impl FnMut() -> Result<f64, E>) -> Result<Option<Timing>, E> {
    let begun = Instant::now();
    let mut times = Vec::new();
    loop {
        times.push(run()?);
        let spent = begun.elapsed().as_secs_f64();
        let enough = times.len() >= repeats.most || times.len() >= repeats.least && spent > repeats.enough;
        if enough || spent > repeats.limit {
            return Ok(Timing::of(times));
        }
    }
}
