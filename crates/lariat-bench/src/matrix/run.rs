//! Runs a pair, and judges it.

use super::feature::{Feature, Pair};
use super::laws::{self, Ended, FINER_RUN, Plan, STEPS_TOLD};
use super::reasons::reason;
use super::{given, sleep};
use crate::stability::outcome::Check;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How a pair ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All laws hold.
    Right,
    /// It ran, and nothing was measured of it: no error was claimed.
    Unmeasured,
    /// It differs from its finer run, and its warnings tell that the steps are too long.
    Told(Vec<Check>),
    /// No cable has both, for a reason of physics.
    Excluded(&'static str),
    /// Refused without one, with the text of the error.
    Refused(String),
    /// It failed on its way.
    Failed(f64, String),
    /// It panicked.
    Panicked(String),
    /// Laws do not hold.
    Wrong(Vec<Check>),
}

impl Outcome {
    /// Returns the outcome in a word or two.
    pub fn name(&self) -> &'static str {
        match self {
            Outcome::Right => "right",
            Outcome::Unmeasured => "nothing claimed",
            Outcome::Told(_) => "told",
            Outcome::Excluded(_) => "excluded",
            Outcome::Refused(_) => "refused",
            Outcome::Failed(..) => "failed",
            Outcome::Panicked(_) => "panicked",
            Outcome::Wrong(_) => "out of bounds",
        }
    }

    /// Returns whether a pair does what is promised.
    pub fn is_good(&self) -> bool {
        matches!(self, Outcome::Right | Outcome::Excluded(_)) || self.is_told()
    }

    /// Returns whether the run itself tells what it misses.
    pub fn is_told(&self) -> bool {
        matches!(self, Outcome::Unmeasured | Outcome::Told(_))
    }

    /// Returns the message or the failed checks; empty if there is nothing to say.
    pub fn details(&self) -> String {
        match self {
            Outcome::Right => String::new(),
            Outcome::Unmeasured => "the run tells that it claims no error".to_string(),
            Outcome::Excluded(reason) => (*reason).to_string(),
            Outcome::Refused(text) | Outcome::Panicked(text) => text.clone(),
            Outcome::Failed(time, text) => format!("after {time:.3} s: {text}"),
            Outcome::Told(checks) | Outcome::Wrong(checks) => {
                checks.iter().map(Check::to_string).collect::<Vec<_>>().join("; ")
            }
        }
    }
}

/// A pair that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The pair.
    pub pair: Pair,
    /// How it ended.
    pub outcome: Outcome,
    /// All that was measured.
    pub checks: Vec<Check>,
}

/// Runs a pair. A panic is an outcome.
pub fn run(pair: Pair) -> Row {
    if let Some(reason) = reason(pair) {
        return Row { pair, outcome: Outcome::Excluded(reason), checks: Vec::new() };
    }
    let measured = catch_unwind(AssertUnwindSafe(|| measure(pair)));
    let (outcome, checks) = match measured {
        Ok(Ok(checks)) => (judged(&checks), checks),
        Ok(Err(Ended::Refused(text))) => (Outcome::Refused(text), Vec::new()),
        Ok(Err(Ended::Failed(time, text))) => (Outcome::Failed(time, text), Vec::new()),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_string()));
            (Outcome::Panicked(text.unwrap_or_default()), Vec::new())
        }
    };
    Row { pair, outcome, checks }
}

/// Returns how a run ended by what was measured of it.
pub fn judged(checks: &[Check]) -> Outcome {
    let failed: Vec<Check> = checks.iter().filter(|check| !check.holds()).cloned().collect();
    let told = checks.iter().any(|check| check.quantity == STEPS_TOLD && check.value > 0.0);
    match failed.iter().all(|check| check.quantity == FINER_RUN) {
        _ if checks.is_empty() => Outcome::Unmeasured,
        _ if failed.is_empty() => Outcome::Right,
        true if told => Outcome::Told(failed),
        _ => Outcome::Wrong(failed),
    }
}

/// Runs a pair by all laws that apply to it.
fn measure(pair: Pair) -> Result<Vec<Check>, Ended> {
    let beside = |procedure| pair.beside(procedure);
    if let Some(other) = beside(Feature::Sleep) {
        return sleep::beside(other);
    }
    if let Some(other) = beside(Feature::ErrorTarget) {
        return given::run(other);
    }
    let plan = Plan { statics: pair.has(Feature::Statics) };
    let mut checks = laws::together(&pair.both(), plan)?;
    if pair.both().iter().all(|feature| feature.keeps_momentum()) && !plan.statics {
        checks.extend(laws::floating(&pair.both())?);
    }
    if !pair.both().iter().any(|feature| feature.is_procedure()) {
        checks.push(laws::beside(pair)?);
    }
    Ok(checks)
}
