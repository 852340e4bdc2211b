//! The matrix as a page: how pairs ended, which are refused and why, which are wrong; every pair as
//! CSV.

use super::feature::Feature;
use super::misses::{self, Miss};
use super::run::{Outcome, Row};
use crate::page::{self, Section};
use crate::table::{Cell, Format, Table, hidden, shown};
use std::fmt::Write;

/// Says what is run and what must hold.
const INTRODUCTION: &str = "\
Every pair of features runs on a small scene for half a second: a rope of 1.2 m with six elements, and what the two features bring. It \
must keep these laws.\n\n\
- *Energy.* Energy of all, less the work from outside, grows by at most 1 % of the largest kinetic and strain energy; the run's own \
account says the same.\n\
- *Momentum* of systems that nothing from outside acts on stays within 1e-4.\n\
- *Snapshot.* A state that is saved in the middle and read back runs on bitwise.\n\
- *Finer.* Positions are those of a host step an eighth as long, within 5 % of how far anything moved, or \
9 mm, what fidelity game is documented to miss; or its warnings, coarse ones with the others, tell that the steps are too long.\n\
- *Beside.* Both features in one world, far apart, are each as alone, to 1e-6 m, the precision of bodies.\n\
- *Statics.* A scene that starts in equilibrium, and has nothing that moves, rests within 1e-5 m.\n\
- *Sleep.* A weight sleeps on its rope, the feature changes after 6 s, and all is where it is in a world that may not sleep, to 1.5e-3 m.\n\
- *Given error.* What a run to a given error claims holds against a finer run, or it is told that it claims nothing.\n\n\
Of a pair that differs from its finer run it is told what is left at an eighth of the step, and by how much runs part whose velocities \
differ by 1e-9 m/s.\n\n\
A pair that is refused without a reason of physics is a miss. With a drum, energy is judged by the run's own account alone: what a drum \
winds up has no entry in the sum. The list of features is checked against the lists of effects and of terms of the \
code, so that a new one fails a test until it is in the matrix.";

/// Returns the page; `machine` and `command` say how it was made.
pub fn page(rows: &[Row], machine: &str, command: &str) -> (String, Vec<Section>) {
    let count = |of: fn(&Outcome) -> bool| rows.iter().filter(|row| of(&row.outcome)).count();
    let right = count(|outcome| *outcome == Outcome::Right);
    let refused = count(|outcome| matches!(outcome, Outcome::Excluded(_)));
    let told = count(Outcome::is_told);
    let misses: Vec<Miss> = rows.iter().flat_map(misses::of).collect();
    let introduction = format!(
        "Made by `{command}`; do not edit. {machine}\n\nOf {} pairs {right} are right, {refused} are excluded for a reason of physics, {told} tell \
         that they are off or claim no error, and {} are not as they should be; these are listed below.\n\n{INTRODUCTION}",
        rows.len(),
        rows.len() - right - refused - told
    );
    let mut matrix = Section::new("Matrix");
    matrix
        .text("`+` right, `r` excluded for a reason, `x` refused without one, `t` the run tells that it is off or claims no error, `!` a law is missed or the run failed.");
    matrix.text(drawn(rows));
    matrix.data(all(rows));
    let mut reasons = Section::new("Excluded for a reason");
    if refused == 0 {
        reasons.text("None.");
    } else {
        reasons.table(refusals(rows));
    }
    let mut wrong = Section::new("Not as they should be");
    if misses.is_empty() {
        wrong.text("None.");
    } else {
        wrong.text(
            "The tests compare with `crates/lariat-bench/matrix_misses.csv`: they fail if a pair becomes wrong that is not listed, if one is \
             missed by twice as much, and if one is mended.",
        );
        wrong.table(misses::table(&misses));
    }
    let sections = vec![matrix, reasons, wrong];
    (page::markdown("Every pair of features", &introduction, &sections), sections)
}

/// Draws the matrix, a letter for each pair, with the features numbered.
fn drawn(rows: &[Row]) -> String {
    let sign = |a: Feature, b: Feature| {
        let row = rows.iter().find(|row| row.pair.has(a) && row.pair.has(b));
        match row.map(|row| &row.outcome) {
            None => ' ',
            Some(Outcome::Right) => '+',
            Some(Outcome::Excluded(_)) => 'r',
            Some(Outcome::Refused(_)) => 'x',
            Some(outcome) if outcome.is_told() => 't',
            Some(_) => '!',
        }
    };
    let mut text = String::from("```text\n");
    let width = Feature::ALL.map(|feature| feature.name().len()).into_iter().max().unwrap_or(0);
    let digits = |divisor: usize| -> String {
        (1..=Feature::ALL.len()).map(|k| char::from_digit((k / divisor % 10) as u32, 10).unwrap_or(' ')).collect()
    };
    for divisor in [10, 1] {
        // writing to a string does not fail
        let _ = writeln!(text, "{:width$}    {}", "", digits(divisor));
    }
    for (k, a) in Feature::ALL.into_iter().enumerate() {
        let signs: String = Feature::ALL.into_iter().map(|b| if a == b { '.' } else { sign(a, b) }).collect();
        let _ = writeln!(text, "{:width$} {:2} {signs}", a.name(), k + 1);
    }
    text + "```"
}

/// Returns the pairs that are refused for a reason.
fn refusals(rows: &[Row]) -> Table {
    let columns = vec![shown("pair", "pair", Format::Plain), shown("reason", "reason", Format::Plain)];
    let of = |row: &Row| match &row.outcome {
        Outcome::Excluded(reason) => Some(vec![row.pair.to_string().into(), (*reason).into()]),
        _ => None,
    };
    Table { name: "matrix_refused", columns, rows: rows.iter().filter_map(of).collect() }
}

/// Returns every pair with all that was measured.
fn all(rows: &[Row]) -> Table {
    let columns = ["first", "second", "outcome", "measured", "details"].map(hidden).to_vec();
    let cells = |row: &Row| -> Vec<Cell> {
        let measured = row.checks.iter().map(|check| format!("{} {:.3e}", check.quantity, check.value));
        vec![
            row.pair.0.name().into(),
            row.pair.1.name().into(),
            row.outcome.name().into(),
            measured.collect::<Vec<_>>().join("; ").into(),
            row.outcome.details().into(),
        ]
    };
    Table { name: "matrix", columns, rows: rows.iter().map(cells).collect() }
}
