//! Pairs that are known to be refused without a reason, or wrong: a CSV file that the tests compare
//! with, so that the table is true.
//!
//! A pair that becomes worse fails a test, and so does one that is mended and still listed.

use super::run::{Outcome, Row};
use crate::table::{Format, Table, shown};
use serde::Deserialize;

/// A change of a missed value by more than this factor is reported.
const SIGNIFICANT: f64 = 2.0;

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
            let each = checks.iter().map(|check| miss(check.quantity, Some(check.value), String::new()));
            each.collect()
        }
        outcome => vec![miss(outcome.name(), None, outcome.details())],
    }
}

/// Reads the file of known misses.
///
/// # Errors
/// Those of the CSV format, with the line.
pub fn read(text: &str) -> Result<Vec<Miss>, csv::Error> {
    csv::Reader::from_reader(text.as_bytes()).deserialize().collect()
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
    let mut lines = Vec::new();
    for row in rows {
        let name = row.pair.to_string();
        let now = of(row);
        let before: Vec<&Miss> = known.iter().filter(|m| m.pair == name).collect();
        for miss in &now {
            match before.iter().find(|m| m.kind == miss.kind) {
                None => lines.push(format!("{name}: {}: a new miss. {}", miss.kind, row.outcome.details())),
                Some(listed) => {
                    // NaN is worse than any number
                    let worse =
                        |now: f64, then: f64| now.is_nan() && !then.is_nan() || now.abs() > SIGNIFICANT * then.abs();
                    let grown = miss.value.zip(listed.value).is_some_and(|(now, then)| worse(now, then));
                    if grown {
                        lines
                            .push(format!("{name}: {}: {:?}, listed {:?}: worse", miss.kind, miss.value, listed.value));
                    }
                }
            }
        }
        for miss in before.iter().filter(|m| now.iter().all(|n| n.kind != m.kind)) {
            lines.push(format!("{name}: {}: mended: remove it from matrix_misses.csv", miss.kind));
        }
    }
    lines
}
