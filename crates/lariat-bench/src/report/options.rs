//! How much a report measures.

use crate::clock::Repeats;

/// How much is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The command that makes the report, printed on its page.
    pub command: &'static str,
    /// Settings of each curve, from the coarsest.
    pub rungs: usize,
    /// How often a run is repeated for its time.
    pub repeats: Repeats,
    /// Readings of the clock for the cost of an element.
    pub readings: usize,
}

impl Options {
    /// Everything: some minutes.
    pub fn full() -> Self {
        let command = "cargo run --release --bin lariat -- report --out docs/accuracy --readme README.md";
        let repeats = Repeats { least: 5, most: 15, enough: 0.1, limit: 2.0 };
        Options { command, rungs: usize::MAX, repeats, readings: 300 }
    }

    /// The coarsest settings of each curve, with few runs: below a minute.
    pub fn quick() -> Self {
        let command = "cargo run --release --bin lariat -- report --out out/report --quick";
        let repeats = Repeats { least: 2, most: 3, enough: 0.02, limit: 0.1 };
        Options { command, rungs: 2, repeats, readings: 50 }
    }

    /// Returns the settings of a curve that are measured.
    pub fn rungs<'t, T>(&self, all: &'t [T]) -> &'t [T] {
        &all[..self.rungs.min(all.len())]
    }
}
