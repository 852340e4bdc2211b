//! Runs that are known to miss a bound: a CSV file that the tests compare with.
//!
//! A run that misses a bound more than before fails a test, and so does one that passes, so that
//! the file tells what is true. Of a value near its bound, which is on either side of it by the
//! rounding of another processor, the file may tell either.

use serde::de::DeserializeOwned;

/// A bound that a run misses, as a file lists it.
pub trait Miss {
    /// What it is told to do with a line of the file for a bound that is not missed any more.
    const PASSED: &'static str;

    /// The quantity that is out of bounds, or how the run ended before its time.
    fn kind(&self) -> &str;

    /// Describes it, and how the run ended, where the file does not list it.
    fn told_as_new(&self, details: &str) -> String;

    /// Describes what is reported of it beside the one that is listed.
    fn change_from(&self, listed: &Self) -> Option<String>;
}

/// Reads the file of known misses.
///
/// # Errors
/// Those of the CSV format, with the line.
pub fn read<M: DeserializeOwned>(text: &str) -> Result<Vec<M>, csv::Error> {
    csv::Reader::from_reader(text.as_bytes()).deserialize().collect()
}

/// Compares what a run misses `now`, and how it ended, with what is listed for it; returns a line
/// for each difference. `is_near` tells of a quantity whether it is nearly missed.
pub fn differences<M: Miss>(
    run: &str,
    (now, details): (&[M], &str),
    listed: &[&M],
    is_near: impl Fn(&str) -> bool,
) -> Vec<String> {
    let mut lines = Vec::new();
    for miss in now {
        lines.extend(match listed.iter().find(|m| m.kind() == miss.kind()) {
            None => Some(miss.told_as_new(details)),
            Some(listed) => miss.change_from(listed),
        });
    }
    let passed = listed.iter().filter(|m| now.iter().all(|n| n.kind() != m.kind()) && !is_near(m.kind()));
    lines.extend(passed.map(|m| format!("{}{}", m.kind(), M::PASSED)));
    lines.iter().map(|line| format!("{run}: {line}")).collect()
}
