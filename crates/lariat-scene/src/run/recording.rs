//! A run that is kept in memory, for programs that read its results at once.

use super::output::{Kept, Output};
use super::{Options, Recorded, Summary, World, columns, conduct};
use crate::error::Error;
use crate::scene::{Purpose, Scene};
use crate::view::Recorder;

/// The rows of a probe.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProbeRecord {
    /// Name of the probe.
    pub name: String,
    /// What a row holds; the first is the time in s.
    pub columns: &'static [&'static str],
    /// The numbers of all rows, one after the other.
    pub rows: Vec<f64>,
}

/// A run in memory. One that failed has the samples until then.
pub struct Recording {
    /// The probes, in the order of the scene.
    pub probes: Vec<ProbeRecord>,
    /// The summary.
    pub summary: Summary,
    /// Why the run failed, if it did.
    pub failed: Option<Error>,
    /// The cables and bodies at the end.
    pub world: World,
    view: Recorder,
}

impl Recording {
    /// Returns the page that plays the motion.
    pub fn page(&self) -> String {
        self.view.page(&self.world, &self.summary)
    }

    /// Returns the motion as an animated SVG.
    pub fn svg(&self) -> String {
        self.view.svg(&self.world)
    }

    /// Returns the motion as OpenUSD.
    pub fn usd(&self) -> String {
        self.view.usd(&self.world)
    }
}

/// Runs a scene for its duration, or finds its equilibrium, and writes no files.
///
/// # Errors
/// As [`World::build`]; not for a checked scene. A run that fails later is a [`Recording`] with its error.
pub fn collect(scene: &Scene, purpose: Purpose, options: &mut Options<'_>) -> Result<Recording, Error> {
    let open = |scene: &Scene| Ok(Output::in_memory(scene));
    let Recorded { world, summary, kept, outcome } = conduct(scene, &open, purpose, options)?;
    let Kept { rows, view } = kept?;
    let probes = scene.probes.iter().zip(rows).map(|(probe, rows)| ProbeRecord {
        name: probe.name.clone(),
        columns: columns(probe.target),
        rows,
    });
    Ok(Recording { probes: probes.collect(), summary, failed: outcome.err(), world, view })
}
