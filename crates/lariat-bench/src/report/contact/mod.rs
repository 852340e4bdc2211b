//! Cables that touch: the scenes of assets/contact against friction laws, rigid bodies and the energy law.
//!
//! # Measures
//!
//! *Exact* values are formulas: the tensions on both sides of a drum differ by `exp(mu angle)` (Euler, Eytelwein); loads over a drum
//! accelerate with `(m1 - m2) g/(m1 + m2 + m_rope + I/(R + r)^2)`; on a slope of angle a a rope stays if `tan a <= mu`, else it
//! slides with `g (sin a - mu cos a)`. *Bounds* without an exact value are what contact must keep: depths as shares of the
//! rope's radius, energy made as a share of that at the start.

pub mod beside;
mod cases;
mod cost;
mod iterations;
mod run;

use super::options::Options;
use crate::error::Error;
use crate::page::Section;
use crate::table::{Cell, Format, Table, shown};
pub use cases::cases;
use run::Run;

/// What is measured of a scene.
pub struct Case {
    /// Name of the file in assets/contact.
    pub scene: &'static str,
    /// What is measured, with its unit.
    pub quantity: &'static str,
    /// What is changed in the scene: in words, and `key=value`.
    changed: String,
    overrides: Vec<String>,
    /// What it must be, if there is a formula.
    exact: Option<f64>,
    /// Largest deviation from it as a share; without, the largest value.
    bound: f64,
    measure: fn(&mut Run) -> Result<f64, Error>,
}

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Scene and quantity.
    pub name: String,
    /// What was measured.
    pub value: f64,
    /// Deviation from the exact value as a share, or the value itself.
    pub deviation: f64,
    /// Its bound.
    pub bound: f64,
    exact: Option<f64>,
    mean: f64,
    longest: f64,
}

impl Case {
    /// Runs it.
    ///
    /// # Errors
    /// [`Error::Scene`], [`Error::Mechanics`] if the run fails.
    pub fn run(&self) -> Result<Outcome, Error> {
        let mut run = Run::start(self.scene, &self.overrides)?;
        let value = (self.measure)(&mut run)?;
        let deviation = self.exact.map_or(value, |exact| (value / exact - 1.0).abs());
        let name = format!("{}{}: {}", self.scene, self.changed, self.quantity);
        let mean = run.seconds / f64::from(run.steps);
        Ok(Outcome { name, value, deviation, bound: self.bound, exact: self.exact, mean, longest: run.longest })
    }
}

/// Title of the section.
pub const TITLE: &str = "Cables that touch";

/// Measures the section.
///
/// # Errors
/// As [`Case::run`].
pub fn section(_: &Options) -> Result<Section, Error> {
    let columns = vec![
        shown("case", "scene: quantity", Format::Plain),
        shown("value", "value", Format::Short),
        shown("exact", "exact", Format::Short),
        shown("deviation", "deviation", Format::Scientific(1)),
        shown("bound", "bound", Format::Scientific(0)),
        shown("mean_us", "us per host step", Format::Short),
        shown("longest_us", "longest, us", Format::Short),
    ];
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for case in cases() {
        let outcome = case.run()?;
        rows.push(vec![
            outcome.name.into(),
            outcome.value.into(),
            outcome.exact.into(),
            outcome.deviation.into(),
            outcome.bound.into(),
            (1e6 * outcome.mean).into(),
            (1e6 * outcome.longest).into(),
        ]);
    }
    let mut section = Section::new(TITLE);
    section.text(
        "The scenes of `assets/contact` in fidelity game, host steps of 1/60 s. *Deviation* is that from the exact value as a share; without \
         one, the value itself. Tension over the weight is a mean of 1.5 s while the rope slips over the drum. CPU time is that of the whole \
         scene with Rapier: the mean and the longest of its host steps, in one run.",
    );
    section.table(Table { name: "contact", columns, rows });
    section.text(
        "A rope of 5 m that touches a floor with all of its samples, friction 0.3, fidelity game, without Rapier: host steps of 1/60 s, two seconds of them, the least of five \
         runs.",
    );
    section.table(cost::table()?);
    iterations::add(&mut section)?;
    section.text(
        "The same ropes as Rapier itself offers them, with as many particles or capsules as the cable has elements, 60 host steps per second, Rapier's \
         defaults: 3 and 2 kg over a fixed drum of 0.1 m radius, without friction (acceleration) and with friction 0.3, which holds them (slip, CPU time); \
         and 2 kg on both sides of a drum of 20 mm, where the depth is that of the rope's axis below the sum of the radii.",
    );
    section.table(beside::table()?);
    Ok(section)
}
