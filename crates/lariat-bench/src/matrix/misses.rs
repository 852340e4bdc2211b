//! Pairs that are known to be refused without a reason, or wrong, [as others](crate::misses).

use super::laws::FINER_RUN;
use super::limits;
use super::run::{Outcome, Row};
use crate::misses;
use crate::stability::outcome::Check;
use crate::table::{Format, Table, shown};
use serde::Deserialize;

/// A change of a missed value by more than this factor is reported.
const SIGNIFICANT: f64 = 2.0;

/// Share of its bound above which a value may be listed as missed.
const NEAR: f64 = 0.9;

/// A law that a pair misses.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Miss {
    /// Name of the pair.
    pub pair: String,
    /// The law that it misses, or how it ended.
    pub kind: String,
    /// What was measured; empty if it ended before its time.
    pub value: Option<f64>,
    /// What is known of it, for the page.
    pub note: String,
}

/// Returns what a pair misses.
pub fn of(row: &Row) -> Vec<Miss> {
    let miss =
        |kind: &str, value, note: String| Miss { pair: row.pair.to_string(), kind: kind.to_string(), value, note };
    match &row.outcome {
        outcome if outcome.is_good() => Vec::new(),
        Outcome::Wrong(checks) => {
            let why =
                |check: &Check| if check.quantity == FINER_RUN { limits::told(&row.checks) } else { String::new() };
            let each = checks.iter().map(|check| miss(check.quantity, Some(check.value), why(check)));
            each.collect()
        }
        outcome => vec![miss(outcome.name(), None, outcome.details())],
    }
}

/// Returns misses as a table, in the format of the file.
pub fn table(misses: &[Miss]) -> Table {
    let columns = vec![
        shown("pair", "pair", Format::Plain),
        shown("kind", "missed", Format::Plain),
        shown("value", "value", Format::Short),
        shown("note", "what is told", Format::Plain),
    ];
    let row = |m: &Miss| vec![m.pair.clone().into(), m.kind.clone().into(), m.value.into(), m.note.clone().into()];
    Table { name: "matrix_misses", columns, rows: misses.iter().map(row).collect() }
}

/// Compares pairs with the known misses, and returns a line for each difference.
pub fn differences(rows: &[Row], known: &[Miss]) -> Vec<String> {
    let of_row = |row: &Row| {
        let name = row.pair.to_string();
        let listed: Vec<&Miss> = known.iter().filter(|m| m.pair == name).collect();
        let near = |c: &Check| c.value.abs() > NEAR * c.nearer_bound().abs();
        let is_near = |kind: &str| row.checks.iter().any(|c| c.quantity == kind && near(c));
        misses::differences(&name, (&of(row), &row.outcome.details()), &listed, is_near)
    };
    rows.iter().flat_map(of_row).collect()
}

impl misses::Miss for Miss {
    const PASSED: &'static str = ": mended: remove it from matrix_misses.csv";

    fn kind(&self) -> &str {
        &self.kind
    }

    fn told_as_new(&self, details: &str) -> String {
        format!("{}: a new miss. {details}", self.kind)
    }

    fn change_from(&self, listed: &Self) -> Option<String> {
        let (now, then) = (self.value?, listed.value?);
        // NaN is worse than any number
        let worse = now.is_nan() && !then.is_nan() || now.abs() > SIGNIFICANT * then.abs();
        worse.then(|| format!("{}: {now:?}, listed {then:?}: worse", self.kind))
    }
}
