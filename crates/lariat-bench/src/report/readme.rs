//! The tables of a report that a README shows, between marks `<!-- name -->` and `<!-- /name -->`.

use super::Report;
use crate::error::Error;
use crate::page;
use crate::table::{Cell, Format, Table, shown};
use std::path::Path;

/// Names of the marks.
const MARKS: [&str; 3] = ["fidelity", "cost", "kernels"];

/// Replaces the tables between the marks that a README has.
///
/// # Errors
/// [`Error::Read`], [`Error::Output`]; [`Error::NoMark`] if it has none of the marks.
pub fn update(report: &Report, readme: &Path) -> Result<(), Error> {
    let read = |source| Error::Read { path: readme.to_path_buf(), source };
    let mut text = std::fs::read_to_string(readme).map_err(read)?;
    let mut found = false;
    for name in MARKS {
        let table = match name {
            "fidelity" => report.find("fidelity").map(fidelity),
            "cost" => report.find("pendulum_time").map(|table| format!("{}\n{}\n", cost(table), report.machine)),
            _ => report.find("kernels").map(kernels),
        };
        if let Some(replaced) = replace(&text, name, &table.unwrap_or_default()) {
            (text, found) = (replaced, true);
        }
    }
    if !found {
        let expected = MARKS.map(|name| format!("<!-- {name} --> ... <!-- /{name} -->")).join(", ");
        return Err(Error::NoMark { path: readme.to_path_buf(), expected });
    }
    page::write(readme, &text)
}

fn is_one_of(cell: &Cell, words: &[&str]) -> bool {
    matches!(cell, Cell::Text(text) if words.contains(&text.as_str()))
}

/// The three fidelities on the scenes that move.
fn fidelity(table: &Table) -> String {
    let columns = [
        shown("fidelity", "fidelity", Format::Plain),
        shown("scene", "scene", Format::Plain),
        shown("integrator", "integrator", Format::Plain),
        shown("control", "control", Format::Plain),
        shown("elements", "elements", Format::Plain),
        shown("error_m", "error m", Format::Scientific(1)),
        shown("cpu_median_ms", "CPU ms", Format::Fixed(2)),
    ];
    table.select(&columns, |row| !is_one_of(&row[1], &["catenary"])).markdown()
}

/// Integrators in time alone, at settings that can be compared.
fn cost(table: &Table) -> String {
    let columns = [
        shown("integrator", "integrator", Format::Plain),
        shown("control", "control", Format::Plain),
        shown("cpu_median_ms", "CPU ms", Format::Fixed(2)),
        shown("error_m", "error in time m", Format::Scientific(1)),
        shown("steps", "steps", Format::Plain),
        shown("newton_iterations", "Newton", Format::Plain),
    ];
    let controls = ["tolerance 1e-6 m", "16 substeps", "0.95 of the stable step"];
    let default = ["tolerance 1e-5 m", "tolerance 1e-6 m", "tolerance 1e-7 m", "tolerance 1e-8 m"];
    let keep = |row: &[Cell]| {
        is_one_of(&row[3], &controls) || is_one_of(&row[2], &["esdirk4"]) && is_one_of(&row[3], &default)
    };
    table.select(&columns, keep).markdown()
}

/// The cost of an element by instruction set.
fn kernels(table: &Table) -> String {
    let columns = [
        shown("case", "instructions", Format::Plain),
        shown("force_ns", "force", Format::Fixed(0)),
        shown("tangent_ns", "force + tangent", Format::Fixed(0)),
        shown("step_ns", "whole implicit step", Format::Fixed(0)),
    ];
    table.select(&columns, |_| true).markdown()
}

/// Replaces the text between the two marks of a name.
fn replace(text: &str, name: &str, new: &str) -> Option<String> {
    let (open, close) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let (before, rest) = text.split_once(&open)?;
    let (_, after) = rest.split_once(&close)?;
    Some(format!("{before}{open}{new}{close}{after}"))
}
