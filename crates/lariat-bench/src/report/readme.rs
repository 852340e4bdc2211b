//! The table of a report that a README shows, between the marks `<!-- fidelity -->` and `<!-- /fidelity -->`.

use super::Report;
use crate::error::Error;
use crate::page;
use crate::table::{Cell, Format, Table, shown};
use std::path::Path;

/// Name of the marks.
const MARK: &str = "fidelity";

/// Replaces the table between the marks of a README, and the line that names the machine.
///
/// # Errors
/// [`Error::Read`], [`Error::Output`]; [`Error::NoMark`] if it has no marks.
pub fn update(report: &Report, readme: &Path) -> Result<(), Error> {
    let read = |source| Error::Read { path: readme.to_path_buf(), source };
    let text = std::fs::read_to_string(readme).map_err(read)?;
    let table = report.find(MARK).map(fidelity).unwrap_or_default();
    let Some(text) = replace(&text, &format!("{table}\n{}\n", report.machine)) else {
        let expected = format!("<!-- {MARK} --> ... <!-- /{MARK} -->");
        return Err(Error::NoMark { path: readme.to_path_buf(), expected });
    };
    page::write(readme, &text)
}

/// The presets on the scenes that move.
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
    table.select(&columns, |row| !matches!(&row[1], Cell::Text(scene) if scene == "catenary")).markdown()
}

/// Replaces the text between the marks.
fn replace(text: &str, new: &str) -> Option<String> {
    let (open, close) = (format!("<!-- {MARK} -->\n"), format!("<!-- /{MARK} -->"));
    let (before, rest) = text.split_once(&open)?;
    let (_, after) = rest.split_once(&close)?;
    Some(format!("{before}{open}{new}{close}{after}"))
}
