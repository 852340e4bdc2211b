//! `lariat report`: accuracy against cost of rules, integrators, meshes, effects and the coupling,
//! as Markdown, CSV and SVG.
//!
//! # What is measured
//!
//! | module | scene or section | error, in m | reference |
//! |---|---|---|---|
//! | [`cheapest`] | the three fidelities; the cheapest setting for an error | as the scenes | as the scenes |
//! | [`table_1`] | the paper's Table 1 and figures | vertical tip difference from G10-10, and 3D distance from the beam | our own G10-10 run with a negligible error in time (within 1e-12 m of an independent solver's); `pendulum_converged_tip.csv` |
//! | [`pendulum`] | falling pendulum | largest tip distance after a host step | `pendulum_converged_tip.csv` (independent solver, extrapolated in the mesh); in time alone `pendulum_G10-10_10el.csv` (the same solver) |
//! | [`payload`] | crate of 50 kg in Rapier on a cable | distance of its centre at 0.5 s and 1 s | an independent monolithic code, accurate to 2e-5 m |
//! | [`payload_mesh`] | the same with time resolved: error of the mesh | distance of its centre at 0.5 s and 1 s | the finest mesh, and another rule's |
//! | [`taut`] | taut steel cable, plucked | largest distance along the cable after a host step | analytic modes of a rod under tension; derived there |
//! | [`catenary`] | static catenary | largest distance along the cable | the same law by shooting, [`catenary_reference`] |
//! | [`model_error`] | errors of T1, T2 and mean strain, separated from those of the mesh | tip distances | `pendulum_converged_tip.csv` |
//! | [`claims`] | the scenes of assets/scenes: errors of mesh and time, and the cost of an error that is asked for | largest distance of cables and bodies at host times | twice the elements and a quarter of the tolerance |
//! | [`forces`] | moments that are asked for at clamps; kinks at a point load | moments; largest distance of five points | beam under tension; catenaries and fine meshes |
//! | [`thrown`] | thrown cables in fidelity game, and a minute of the pendulum: energy law, constant cost | | the energy law, read from the outside |
//! | [`contact`] | the scenes of assets/contact | tensions, accelerations, depths, energy | formulas and bounds, derived there |
//! | [`effects`], [`effect_cases`] | cost of an element and of each effect | | |
//! | [`coupling`] | gap, energy and momentum with Rapier | distance as in [`payload`]; drifts | the same; conservation |
//!
//! CPU time is that of the process, on one thread: median and extremes of repeated runs of `step`
//! alone. A run that fails is a row with its reason; a section that fails is a line on the page,
//! and the others are measured. Each section is written when it is done.

pub mod catenary;
pub mod catenary_reference;
pub mod cheapest;
pub mod claims;
pub mod contact;
pub mod coupling;
pub mod effect_cases;
pub mod effects;
pub mod forces;
pub mod model_error;
pub mod options;
pub mod payload;
pub mod payload_mesh;
pub mod pendulum;
pub mod point;
pub mod readme;
pub mod table_1;
pub mod taut;
pub mod thrown;

use crate::error::Error;
use crate::machine;
use crate::page::{self, Section};
use crate::table::Table;
pub use options::Options;
use std::path::Path;
use std::time::Instant;

/// What a report tells while it is made.
pub enum Progress<'a> {
    /// A section of this title is begun.
    Begun(&'a str),
    /// It is done and written, after this time in s.
    Done(f64),
    /// It failed.
    Failed(&'a Error),
}

/// A report that was made.
#[derive(Debug, Default)]
pub struct Report {
    /// The sections in the order of the page.
    pub sections: Vec<Section>,
    /// Titles of the sections that failed, with their errors.
    pub failures: Vec<String>,
    /// Processor, compiler, commit, load.
    pub machine: String,
    /// Wall time in s.
    pub seconds: f64,
}

impl Report {
    /// Returns a table by its name.
    pub fn find(&self, name: &str) -> Option<&Table> {
        self.sections.iter().flat_map(|s| s.tables()).find(|t| t.name == name)
    }

    /// Returns an error if sections failed.
    ///
    /// # Errors
    /// [`Error::Sections`].
    pub fn check(&self) -> Result<(), Error> {
        if self.failures.is_empty() { Ok(()) } else { Err(Error::Sections { titles: self.failures.clone() }) }
    }

    fn markdown(&self, options: &Options) -> String {
        let introduction = format!(
            "Made by `{}` in {:.0} s; do not edit. {}\n\nTimes are CPU time on one thread, the median of repeated runs. Counts are the same on \
             every machine. All runs are in the CSV files beside this page, with the smallest and largest times and the counts of steps, \
             Newton iterations and element evaluations. What is measured and compared: `crates/lariat-bench/src/report/mod.rs`.",
            options.command, self.seconds, self.machine
        );
        page::markdown("Accuracy against cost", &introduction, &self.sections)
    }
}

/// A report in the making.
struct Recorder<'a> {
    out: &'a Path,
    options: &'a Options,
    progress: &'a mut dyn FnMut(Progress<'_>),
    begun: Instant,
    report: Report,
}

impl Recorder<'_> {
    /// Measures a section, inserts it at a place of the page, and writes it and the page.
    fn record<T: Default>(
        &mut self,
        place: usize,
        title: &'static str,
        measure: impl FnOnce(&Options) -> Result<(Section, T), Error>,
    ) -> Result<T, Error> {
        let begun = Instant::now();
        (self.progress)(Progress::Begun(title));
        let outcome = measure(self.options);
        match &outcome {
            Ok((section, _)) => section.save(self.out)?,
            Err(error) => (self.progress)(Progress::Failed(error)),
        }
        let (section, result) = outcome.unwrap_or_else(|error| {
            let mut section = Section::new(title);
            section.text(format!("This section failed: {error}"));
            self.report.failures.push(format!("{title}: {error}"));
            (section, T::default())
        });
        self.report.sections.insert(place.min(self.report.sections.len()), section);
        self.report.seconds = self.begun.elapsed().as_secs_f64();
        page::write(&self.out.join("README.md"), &self.report.markdown(self.options))?;
        (self.progress)(Progress::Done(begun.elapsed().as_secs_f64()));
        Ok(result)
    }
}

/// Measures everything, and writes each section to a folder as soon as it is done; the folder is
/// created if it does not exist.
///
/// # Errors
/// [`Error::Output`] if the folder cannot be written, before anything is measured. Sections that
/// fail are in [`Report::failures`].
pub fn run(out: &Path, options: &Options, progress: &mut dyn FnMut(Progress<'_>)) -> Result<Report, Error> {
    page::create_folder(out, "README.md", "Accuracy against cost")?;
    let report = Report { machine: machine::line(), ..Report::default() };
    let mut recorder = Recorder { out, options, progress, begun: Instant::now(), report };
    let plain = |section: Result<Section, Error>| section.map(|section| (section, ()));
    let last = usize::MAX;
    recorder.record(last, table_1::TITLE, |o| plain(table_1::section(o)))?;
    let pendulum = recorder.record(last, pendulum::TITLE, pendulum::section)?;
    let payload = recorder.record(last, payload::TITLE, payload::section)?;
    recorder.record(last, payload_mesh::TITLE, |o| plain(payload_mesh::section(o)))?;
    let taut = recorder.record(last, taut::TITLE, taut::section)?;
    let catenary = recorder.record(last, catenary::TITLE, catenary::section)?;
    let scenes = [
        cheapest::Scene { name: "pendulum", points: &pendulum, errors: &[1e-1, 1e-2, 1e-3, 1e-4, 1e-5] },
        cheapest::Scene { name: "payload", points: &payload, errors: &[1e-1, 1e-2, 1e-3, 1e-4] },
        cheapest::Scene { name: "taut steel", points: &taut, errors: &[1e-4, 1e-5, 1e-6, 1e-7] },
        cheapest::Scene { name: "catenary", points: &catenary, errors: &[1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] },
    ];
    recorder.record(0, cheapest::TITLE, |o| plain(cheapest::section(o, &scenes)))?;
    recorder.record(last, model_error::TITLE, |o| plain(model_error::section(o)))?;
    recorder.record(last, claims::TITLE, |o| plain(claims::section(o)))?;
    recorder.record(last, forces::TITLE, |o| plain(forces::section(o)))?;
    recorder.record(last, thrown::TITLE, |o| plain(thrown::section(o)))?;
    recorder.record(last, contact::TITLE, |o| plain(contact::section(o)))?;
    recorder.record(last, effects::TITLE, |o| plain(effects::section(o)))?;
    recorder.record(last, coupling::TITLE, |o| plain(coupling::section(o)))?;
    Ok(recorder.report)
}

/// Measures a section alone, and replaces it in the page of a report that was made before.
///
/// # Errors
/// [`Error::Read`] without a page; [`Error::Output`]; those of the section.
pub fn renew(out: &Path, section: impl FnOnce() -> Result<Section, Error>) -> Result<(), Error> {
    let path = out.join("README.md");
    let page = std::fs::read_to_string(&path).map_err(|source| Error::Read { path: path.clone(), source })?;
    let section = section()?;
    section.save(out)?;
    page::write(&path, &page::replaced(&page, &section))
}
