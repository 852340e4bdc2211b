//! Runs of the hard cases that are known to miss a bound, [as others](crate::misses); one that
//! improves fails a test, too. `lariat stability` writes `stability_misses.csv` in the same format.

use super::outcome::{Outcome, Row};
use crate::misses;
use crate::table::{Format, Table, shown};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A change of a missed value by more than this share of it is reported.
const SIGNIFICANT: f64 = 0.2;

/// A bound that a run misses.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Miss {
    /// Name of the family.
    pub family: String,
    /// Name of the case.
    pub case: String,
    /// How it was run.
    pub host: String,
    /// The quantity that is out of bounds, or how the run ended before its time.
    pub kind: String,
    /// What was measured; the share of the run that was done if it ended before its time.
    pub value: f64,
    /// The bound; 1 if the run ended before its time.
    pub bound: f64,
    /// Names of the warnings of the run.
    #[serde(default)]
    pub told: String,
}

impl Miss {
    /// Identifies the run.
    fn run(&self) -> String {
        format!("{}: {} | {}", self.family, self.case, self.host)
    }
}

/// Identifies a run.
pub fn run_name(row: &Row) -> String {
    format!("{}: {} | {}", row.family.name(), row.case, row.host)
}

/// Returns the bounds that a run misses.
pub fn of(row: &Row) -> Vec<Miss> {
    let miss = |kind: &str, value: f64, bound: f64| Miss {
        family: row.family.name().to_string(),
        case: row.case.clone(),
        host: row.host.to_string(),
        kind: kind.to_string(),
        value,
        bound,
        told: row.told.join(" "),
    };
    match &row.outcome {
        outcome if outcome.is_good() => Vec::new(),
        Outcome::OutOfBounds(checks) => checks.iter().map(|c| miss(c.quantity, c.value, c.nearer_bound())).collect(),
        outcome => vec![miss(outcome.name(), row.completed, 1.0)],
    }
}

/// Returns misses as a table, in the format of the file.
pub fn table(misses: &[Miss]) -> Table {
    let columns = vec![
        shown("family", "family", Format::Plain),
        shown("case", "case", Format::Plain),
        shown("host", "host", Format::Plain),
        shown("kind", "missed", Format::Plain),
        shown("value", "value", Format::Short),
        shown("bound", "bound", Format::Short),
        shown("told", "told", Format::Plain),
    ];
    let rows = misses.iter().map(|m| {
        let words = [&m.family, &m.case, &m.host, &m.kind].map(|text| text.clone().into());
        words.into_iter().chain([m.value.into(), m.bound.into(), m.told.clone().into()]).collect()
    });
    Table { name: "stability_misses", columns, rows: rows.collect() }
}

/// Returns the misses as a short table: a line for each case and kind, with the number of hosts and
/// the worst value.
pub fn summary(misses: &[Miss]) -> Table {
    let mut groups: BTreeMap<(&str, &str, &str), Vec<&Miss>> = BTreeMap::new();
    for miss in misses {
        let case = if miss.family == "random" { "scenes" } else { miss.case.as_str() };
        groups.entry((&miss.family, case, &miss.kind)).or_default().push(miss);
    }
    let rows = groups.into_iter().map(|((family, case, kind), group)| {
        let by_distance = |a: &&&Miss, b: &&&Miss| outside(a).total_cmp(&outside(b));
        let worst = group.iter().max_by(by_distance);
        vec![
            format!("{family}: {case}").into(),
            kind.into(),
            group.len().into(),
            worst.map(|m| m.value).into(),
            worst.map(|m| m.bound).into(),
            group.iter().filter(|m| m.told.is_empty()).count().into(),
        ]
    });
    let columns = vec![
        shown("case", "case", Format::Plain),
        shown("kind", "missed", Format::Plain),
        shown("hosts", "runs", Format::Plain),
        shown("value", "worst value", Format::Short),
        shown("bound", "bound", Format::Short),
        shown("silent", "runs of which nothing is told", Format::Plain),
    ];
    Table { name: "stability_misses", columns, rows: rows.collect() }
}

/// Distance of a missed value from its bound.
fn outside(miss: &Miss) -> f64 {
    (miss.value - miss.bound).abs()
}

/// Compares runs with the known misses, and returns a line for each difference.
pub fn differences(rows: &[Row], known: &[Miss]) -> Vec<String> {
    let of_row = |row: &Row| {
        let name = run_name(row);
        let listed: Vec<&Miss> = known.iter().filter(|m| m.run() == name).collect();
        misses::differences(&name, (&of(row), &row.outcome.details()), &listed, |_| false)
    };
    rows.iter().flat_map(of_row).collect()
}

impl misses::Miss for Miss {
    const PASSED: &'static str = " is within its bound now: remove it from stability_misses.csv";

    fn kind(&self) -> &str {
        &self.kind
    }

    fn told_as_new(&self, details: &str) -> String {
        format!("{} {:.4}, bound {:.4}: a new miss. {details}", self.kind, self.value, self.bound)
    }

    fn change_from(&self, listed: &Self) -> Option<String> {
        let now = self;
        if (now.bound - listed.bound).abs() > 1e-6 * listed.bound.abs() {
            return Some(format!("{}: the bound is {:e}, listed {:e}", now.kind, now.bound, listed.bound));
        }
        // away from the bound is worse
        let outward = (now.value - listed.value) * (listed.value - listed.bound).signum();
        // a run that failed in its first step has done nothing: its value is 0
        let share = outward / listed.value.abs().max(1e-3 * listed.bound.abs());
        let numbers = format!("{} {:.4}, listed {:.4}, bound {:.4}", now.kind, now.value, listed.value, now.bound);
        // written so that NaN is worse
        if share < -SIGNIFICANT {
            Some(format!("{numbers}: better, update stability_misses.csv"))
        } else if share <= SIGNIFICANT {
            None
        } else {
            Some(format!("{numbers}: worse"))
        }
    }
}
