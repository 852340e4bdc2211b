//! What goes through Python's `warnings`: the first warning of each kind.

use lariat_ancf::Cable;
use lariat_ancf::warning::fold::explained;
use lariat_ancf::warning::{Interface, Warning, name_of};
use pyo3::prelude::*;
use std::ffi::CString;

/// Gives lines to Python's `warnings`, where the filters of the user decide.
pub fn warn(py: Python<'_>, lines: impl IntoIterator<Item = String>) -> PyResult<()> {
    let mut lines = lines.into_iter().peekable();
    if lines.peek().is_none() {
        return Ok(());
    }
    let category = py.import("lariat_cables.errors")?.getattr("ResultWarning")?;
    lines.try_for_each(|line| PyErr::warn(py, &category, &CString::new(line)?, 1))
}

/// The kinds that were told.
#[derive(Default)]
pub struct Told {
    kinds: Vec<String>,
    /// Number of warnings that a cable had raised when it was last read; none before its first
    /// step.
    read_at: Option<u64>,
}

impl Told {
    /// Returns whether a warning is the first of its kind.
    pub fn is_first(&mut self, kind: String) -> bool {
        let first = !self.kinds.contains(&kind);
        if first {
            self.kinds.push(kind);
        }
        first
    }

    /// Returns the lines to tell of a cable that was stepped beside others, of which `all` were
    /// told; reads it if it has raised a warning since it was last read.
    pub fn of_cable(&mut self, cable: &Cable, all: &mut Told) -> Vec<String> {
        let raised = cable.diagnostics().warnings;
        if self.read_at.replace(raised) == Some(raised) {
            return Vec::new();
        }
        let level = cable.warn_level();
        let mut warnings = unexplained(cable);
        warnings.retain(|warning| {
            warning.level() <= level && self.is_first(name_of(warning)) && all.is_first(name_of(warning))
        });
        warnings.iter().map(|warning| Interface::Python.text(warning)).collect()
    }
}

/// Returns the warnings of a cable that no other one explains.
pub fn unexplained(cable: &Cable) -> Vec<Warning> {
    let warnings = cable.warnings();
    let causes = explained(&warnings, |_| Some(()), |_| true);
    warnings.into_iter().zip(causes).filter(|(_, cause)| cause.is_none()).map(|(warning, _)| warning).collect()
}
