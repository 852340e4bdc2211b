//! How a run ended.

use super::family::Family;
use super::host::{CableModel, Host};
use std::fmt;

/// A measured number with its bounds and their source.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The quantity, with its unit.
    pub quantity: &'static str,
    /// What was measured.
    pub value: f64,
    /// Smallest and largest accepted value.
    pub bounds: (f64, f64),
    /// Source of the bounds.
    pub source: &'static str,
}

impl Check {
    /// Returns a check between two bounds.
    pub fn between(quantity: &'static str, value: f64, bounds: (f64, f64), source: &'static str) -> Self {
        Check { quantity, value, bounds, source }
    }

    /// Returns a check against a largest value.
    pub fn at_most(quantity: &'static str, value: f64, most: f64, source: &'static str) -> Self {
        Check { quantity, value, bounds: (f64::NEG_INFINITY, most), source }
    }

    /// Returns a check against an expected value within a share of it.
    pub fn near(quantity: &'static str, value: f64, expected: f64, share: f64, source: &'static str) -> Self {
        let span = share * expected.abs();
        Check { quantity, value, bounds: (expected - span, expected + span), source }
    }

    /// Returns whether the value is within its bounds; NaN is not.
    pub fn holds(&self) -> bool {
        self.value >= self.bounds.0 && self.value <= self.bounds.1
    }

    /// Returns the bound that is nearer to the value.
    pub fn nearer_bound(&self) -> f64 {
        if self.value < self.bounds.0 { self.bounds.0 } else { self.bounds.1 }
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = self.bounds;
        write!(f, "{} {:.3e}", self.quantity, self.value)?;
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
    /// All checks passed to the end.
    Passed,
    /// Some checks failed.
    OutOfBounds(Vec<Check>),
    /// A step ended in this error, which the case allows; it names the culprit, and the state is as
    /// before.
    StepError(String),
    /// A step ended in an error that the case does not allow.
    Failed(String),
    /// A number of the state is not finite.
    NotFinite,
    /// It panicked.
    Panicked(String),
    /// The budget was used up before the end, with all bounds kept so far.
    OverBudget,
}

impl Outcome {
    /// Returns whether the library did what it promises.
    pub fn is_good(&self) -> bool {
        matches!(self, Outcome::Passed | Outcome::StepError(_))
    }

    /// Returns the outcome in a word or two.
    pub fn name(&self) -> &'static str {
        match self {
            Outcome::Passed => "passed",
            Outcome::OutOfBounds(_) => "out of bounds",
            Outcome::StepError(_) => "error, as allowed",
            Outcome::Failed(_) => "failed",
            Outcome::NotFinite => "not finite",
            Outcome::Panicked(_) => "panicked",
            Outcome::OverBudget => "over budget",
        }
    }

    /// Returns the message or the failed checks; empty if there is nothing more to say.
    pub fn details(&self) -> String {
        match self {
            Outcome::Passed | Outcome::NotFinite | Outcome::OverBudget => String::new(),
            Outcome::OutOfBounds(checks) => checks.iter().map(Check::to_string).collect::<Vec<_>>().join("; "),
            Outcome::StepError(text) | Outcome::Failed(text) | Outcome::Panicked(text) => text.clone(),
        }
    }
}

/// One run of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The family.
    pub family: Family,
    /// Name of the case.
    pub case: String,
    /// How it was run.
    pub host: Host,
    /// The model of the cables.
    pub model: CableModel,
    /// How it ended.
    pub outcome: Outcome,
    /// What was told of a run that is out of bounds, up to what is coarse: names of warnings.
    pub told: Vec<String>,
    /// Share of the run that was done.
    pub completed: f64,
    /// The reason why the energy balance has no bounds, if it has none.
    pub energy_not_checked: Option<&'static str>,
    /// Change of energy, minus the work from outside, plus what damping and drag dissipated, over
    /// the largest kinetic and strain energy of the run.
    pub energy: f64,
    /// Largest energy made beyond the work from outside, over the same.
    pub energy_made: f64,
    /// Largest energy lost beyond what damping and drag dissipated, over the same, that at the
    /// start included.
    pub energy_lost: f64,
    /// Widest gap of an attachment in m.
    pub gap: f64,
    /// Worst error of Rapier's own joints and of locked axes in m.
    pub constraint: f64,
    /// Largest stretch of a rope.
    pub stretch: f64,
    /// Integration steps taken.
    pub steps: u64,
    /// Integration steps tried and rejected.
    pub rejected: u64,
    /// Elements evaluated, over all cables.
    pub evaluations: u64,
    /// CPU time per host step in us, building and measuring included.
    pub micros: f64,
    /// CPU time in s.
    pub seconds: f64,
}
