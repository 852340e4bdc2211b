//! What came of a run.

use super::host::{Host, Make};
use std::fmt;

/// A number that a case reads, with what it must lie in and who says so.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The quantity, with its unit.
    pub what: &'static str,
    /// What was measured.
    pub value: f64,
    /// Least and greatest that is right.
    pub bounds: (f64, f64),
    /// Where the bounds come from.
    pub source: &'static str,
}

impl Reading {
    /// A reading between two bounds.
    pub fn between(what: &'static str, value: f64, bounds: (f64, f64), source: &'static str) -> Self {
        Reading { what, value, bounds, source }
    }

    /// A reading that must not be more than `most`.
    pub fn at_most(what: &'static str, value: f64, most: f64, source: &'static str) -> Self {
        Reading { what, value, bounds: (f64::NEG_INFINITY, most), source }
    }

    /// A reading near an expected value, within a share of it.
    pub fn near(what: &'static str, value: f64, expected: f64, share: f64, source: &'static str) -> Self {
        let span = share * expected.abs();
        Reading { what, value, bounds: (expected - span, expected + span), source }
    }

    /// Whether it is right; one that is not a number never is.
    pub fn holds(&self) -> bool {
        self.value >= self.bounds.0 && self.value <= self.bounds.1
    }
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = self.bounds;
        write!(f, "{} {:.3e}", self.what, self.value)?;
        match (low.is_finite(), high.is_finite()) {
            (true, true) => write!(f, ", bounds {low:.3e} to {high:.3e}"),
            (false, _) => write!(f, ", at most {high:.3e}"),
            (true, false) => write!(f, ", at least {low:.3e}"),
        }
    }
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All invariants held to the end.
    Held,
    /// Some did not: what and by how much.
    Missed(Vec<Reading>),
    /// A step was refused with this message, where the case allows it, and the last good state was intact.
    Refused(String),
    /// A step was refused where the case does not allow it.
    Failed(String),
    /// A number that is not finite came out.
    NotFinite,
    /// It panicked.
    Panicked(String),
    /// The budget of CPU time ran out at this share of the run, with all invariants intact so far.
    OverBudget(f64),
}

impl Outcome {
    /// Whether the library did what it promises.
    pub fn is_kept(&self) -> bool {
        matches!(self, Outcome::Held | Outcome::Refused(_))
    }

    /// In a word, for tables.
    pub fn word(&self) -> &'static str {
        match self {
            Outcome::Held => "held",
            Outcome::Missed(_) => "missed",
            Outcome::Refused(_) => "refused",
            Outcome::Failed(_) => "failed",
            Outcome::NotFinite => "not finite",
            Outcome::Panicked(_) => "panicked",
            Outcome::OverBudget(_) => "over budget",
        }
    }

    /// What went wrong, with its numbers.
    pub fn reason(&self) -> String {
        match self {
            Outcome::Held | Outcome::NotFinite => self.word().to_string(),
            Outcome::Missed(readings) => readings.iter().map(Reading::to_string).collect::<Vec<_>>().join("; "),
            Outcome::Refused(text) | Outcome::Failed(text) | Outcome::Panicked(text) => text.clone(),
            Outcome::OverBudget(share) => format!("{:.0} % done", 100.0 * share),
        }
    }
}

/// One run of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the family.
    pub family: &'static str,
    /// Name of the case.
    pub case: String,
    /// How it was run.
    pub host: Host,
    /// What made the cables.
    pub make: Make,
    /// How it ended.
    pub outcome: Outcome,
    /// Change of energy, less work put in, over the largest kinetic and strain energy of the run.
    pub energy: f64,
    /// Widest gap of an attachment in m.
    pub gap: f64,
    /// Worst error of Rapier's own joints and of locked axes in m.
    pub constraint: f64,
    /// Largest stretch of a cable, as a polyline.
    pub stretch: f64,
    /// Integration steps, and those that were rejected.
    pub steps: u64,
    /// Integration steps tried and thrown away.
    pub rejected: u64,
    /// CPU time of the thread per host step in us, building and measuring included.
    pub micros: f64,
    /// CPU time of the thread in s.
    pub seconds: f64,
}
