//! `lariat report`: accuracy against cost of everything that can be chosen, as Markdown, CSV, SVG and one HTML page.
//!
//! # What is measured
//!
//! | file | scene or section | error, in m | reference |
//! |---|---|---|---|
//! | [`table_1`] | the paper's Table 1 and figures | vertical tip difference from G10-10, and 3D distance from the beam | our own G10-10 run exact in time (it is within 1e-12 m of an independent solver's); `pendulum_converged_tip.csv` |
//! | [`choice`] | the cheapest choice for an error; the three fidelities | as the scenes | as the scenes |
//! | [`pendulum`] | falling pendulum | largest tip distance at the host's steps | `pendulum_converged_tip.csv` (independent solver, extrapolated in the mesh); in time alone `pendulum_G10-10_10el.csv` (the same) |
//! | [`payload`] | crate of 50 kg in Rapier on a cable | distance of its centre at 0.5 s and 1 s | an independent monolithic code, good to 2e-5 m |
//! | [`taut`] | taut steel cable, plucked | largest distance along the cable at the host's steps | analytic modes of a rod under tension; derived there |
//! | [`catenary`] | static catenary | largest distance along the cable | the same law by shooting, [`catenary_reference`] |
//! | [`model_error`] | T1, T2, mean strain apart from the mesh | tip distances | `pendulum_converged_tip.csv` |
//! | [`effects`] | cost of an element and of each effect | | |
//! | [`coupling`] | gap, energy and momentum with Rapier | distance as in [`payload`]; drifts | the same; conservation |
//!
//! CPU time is that of the process, on one thread: median, least and most of repeated runs of `step` alone. A run that fails is a row
//! with its reason. Nothing is written before all is measured; the folder is tried first.

pub mod catenary;
pub mod catenary_reference;
pub mod choice;
pub mod clock;
pub mod coupling;
pub mod effects;
pub mod model_error;
mod output;
pub mod payload;
pub mod pendulum;
pub mod point;
pub mod section;
pub mod table_1;
pub mod taut;

use crate::error::Error;
use crate::machine;
use section::Section;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// How much is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The command that asks for this, printed in the report.
    pub command: &'static str,
    /// The first so many rungs of every ladder, the coarsest.
    pub rungs: usize,
    /// Runs for the clock of each point, at least and at most.
    pub least_runs: usize,
    /// See `least_runs`.
    pub most_runs: usize,
    /// Time in s after which the least runs are enough.
    pub budget: f64,
    /// Time in s after which one run is enough.
    pub patience: f64,
    /// Readings of the clock for the cost of one element.
    pub readings: usize,
}

impl Options {
    /// Everything: some minutes.
    pub fn full() -> Self {
        let command = "cargo run --release -p lariat-scene -- report --out docs/accuracy --readme README.md";
        Options { command, rungs: usize::MAX, least_runs: 5, most_runs: 15, budget: 0.1, patience: 2.0, readings: 300 }
    }

    /// The coarse part of the ladders, few runs: below a minute.
    pub fn quick() -> Self {
        let command = "cargo run --release -p lariat-scene -- report --out out/report --quick";
        Options { command, rungs: 3, least_runs: 2, most_runs: 3, budget: 0.02, patience: 0.1, readings: 50 }
    }
}

/// Options, and who wants to know what is being measured.
pub struct Bench<'a> {
    /// How much is measured.
    pub options: Options,
    /// Told in words what begins.
    pub progress: &'a mut dyn FnMut(&str),
}

impl Bench<'_> {
    fn tell(&mut self, what: &str) {
        (self.progress)(what);
    }

    fn rungs<'t, T>(&self, ladder: &'t [T]) -> &'t [T] {
        &ladder[..self.options.rungs.min(ladder.len())]
    }
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The command that makes one like it.
    pub command: &'static str,
    /// The sections in their order.
    pub sections: Vec<Section>,
    /// Machine, compiler, commit.
    pub machine: String,
    /// Wall time of it all in s.
    pub seconds: f64,
}

/// Measures everything.
///
/// # Errors
/// [`Error::Mechanics`] where a reference or a table of the paper fails, [`Error::Figure`] if a figure cannot be drawn. A run of a ladder
/// that fails is no error.
pub fn measure(bench: &mut Bench<'_>) -> Result<Report, Error> {
    let (begun, machine) = (Instant::now(), machine::line());
    let table_1 = table_1::section(bench)?;
    let pendulum = pendulum::measure_all(bench)?;
    let payload = payload::measure_all(bench)?;
    let taut = taut::measure_all(bench)?;
    let catenary = catenary::measure_all(bench);
    let scenes = [
        choice::Scene { name: "pendulum", points: &pendulum.beam, errors: &[1e-1, 1e-2, 1e-3, 1e-4, 1e-5] },
        choice::Scene { name: "payload", points: &payload, errors: &[1e-1, 1e-2, 1e-3, 1e-4] },
        choice::Scene { name: "taut steel", points: &taut, errors: &[1e-4, 1e-5, 1e-6, 1e-7] },
        choice::Scene { name: "catenary", points: &catenary, errors: &[1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] },
    ];
    let sections = vec![
        table_1,
        choice::section(bench, &scenes)?,
        pendulum::section(&pendulum)?,
        payload::section(&payload)?,
        taut::section(bench, &taut)?,
        catenary::section(&catenary)?,
        model_error::section(bench)?,
        effects::section(bench)?,
        coupling::section(bench)?,
    ];
    let command = bench.options.command;
    Ok(Report { command, sections, machine, seconds: begun.elapsed().as_secs_f64() })
}

/// Measures everything and writes it to a folder, which is made if it is not there.
///
/// # Errors
/// [`Error::Output`] if the folder cannot be written, before anything is measured; else as [`measure`].
pub fn run(out: &Path, options: Options, progress: &mut dyn FnMut(&str)) -> Result<Report, Error> {
    output::try_folder(out)?;
    let report = measure(&mut Bench { options, progress })?;
    output::write(&report, out)?;
    Ok(report)
}

/// Puts the table that the README shows between its marks `<!-- fidelity -->` and `<!-- /fidelity -->`.
///
/// # Errors
/// [`Error::Read`] or [`Error::Output`], also where the marks are missing.
pub fn update_readme(report: &Report, readme: &Path) -> Result<(), Error> {
    output::update_readme(report, readme)
}

/// A drawing, or the error that names its file.
fn failed(name: &str, svg: Result<String, String>) -> Result<String, Error> {
    svg.map_err(|reason| lariat_figures::Error::Draw { path: PathBuf::from(format!("{name}.svg")), reason }.into())
}
