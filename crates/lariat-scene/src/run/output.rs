//! Where the samples of a run go: to a folder, as `probes/NAME.csv`, `view.html` and `summary.json`, or to memory.
//!
//! Numbers are the shortest text that reads back to the same f64. Every row is written to the file at once. The names of all files
//! of a run are kept in the list of a [folder](crate::folder), so that the next run removes these and no others.

use super::state::State;
use super::{Summary, World, probe};
use crate::error::Error;
use crate::folder::{Folder, OwnFile};
use crate::scene::Scene;
use crate::view::Recorder;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

const SUMMARY: &str = "summary.json";
const PAGE: &str = "view.html";
const PROBES: &str = "probes";
const SVG: &str = "run.svg";
const USD: &str = "run.usda";
/// What a run can start from.
pub(super) const STATE: &str = "state";

/// The files that a run writes only if asked.
#[derive(Clone, Copy)]
pub(super) struct Extras {
    /// Whether `run.svg` is written.
    pub svg: bool,
    /// Whether `run.usda` is written.
    pub usd: bool,
    /// Whether `state` is written.
    pub state: bool,
}

/// Where rows are written.
enum Sink {
    Folder {
        folder: Folder,
        files: Vec<OwnFile>,
        text: String,
        extras: Extras,
    },
    /// The rows of each probe, one after the other.
    Memory(Vec<Vec<f64>>),
}

/// The samples of a run while it goes on.
pub(super) struct Output {
    sink: Sink,
    view: Recorder,
    row: Vec<f64>,
}

/// What remains of the samples when a run has ended.
pub(super) struct Kept {
    /// The rows of each probe, one after the other; empty if they went to a folder.
    pub rows: Vec<Vec<f64>>,
    /// The frames.
    pub view: Recorder,
}

impl Output {
    /// Creates the folder and its files with their headers. Files that the last run wrote there are removed.
    pub fn create(scene: &Scene, folder: &Path, extras: Extras) -> Result<Self, Error> {
        let names = scene.probes.iter().map(|probe| probe_file(&probe.name));
        let Extras { svg, usd, state } = extras;
        let asked =
            [(svg, SVG), (usd, USD), (state, STATE)].into_iter().filter(|(asked, _)| *asked).map(|(_, name)| name);
        let own = [SUMMARY, PAGE].into_iter().chain(asked).map(String::from);
        let folder = Folder::take(folder, &own.chain(names).collect::<Vec<_>>())?;
        let mut files = Vec::new();
        for p in &scene.probes {
            let name = probe_file(&p.name);
            let header = probe::columns(p.target).join(",") + "\n";
            let created = folder.create(&name).and_then(|mut file| file.append(header.as_bytes()).map(|()| file));
            files.push(created.map_err(|source| Error::Output { path: folder.file(&name), source })?);
        }
        let sink = Sink::Folder { folder, files, text: String::new(), extras };
        Ok(Output { sink, view: Recorder::new(scene), row: Vec::new() })
    }

    /// Keeps all samples in memory.
    pub fn in_memory(scene: &Scene) -> Self {
        let sink = Sink::Memory(vec![Vec::new(); scene.probes.len()]);
        Output { sink, view: Recorder::new(scene), row: Vec::new() }
    }

    /// Writes one row of a probe.
    pub fn sample(&mut self, index: usize, time: f64, world: &mut World) -> Result<(), Error> {
        self.row.clear();
        self.row.push(time);
        probe::read(world.scene.probes[index].target, world, &mut self.row)?;
        self.sink.write(index, &self.row)?;
        self.view.row(index, &self.row);
        Ok(())
    }

    /// Moves samples that were kept in memory to where another output writes.
    pub fn move_to(self, scene: &Scene, mut other: Output) -> Result<Self, Error> {
        if let Sink::Memory(kept) = &self.sink {
            for (index, (rows, probe)) in kept.iter().zip(&scene.probes).enumerate() {
                for row in rows.chunks_exact(probe::columns(probe.target).len()) {
                    other.sink.write(index, row)?;
                }
            }
        }
        Ok(Output { view: self.view, ..other })
    }

    /// Records the state at a host time for the page.
    pub fn frame(&mut self, world: &World) -> Result<(), Error> {
        self.view.frame(world)
    }

    /// Returns the CPU and wall time that recording took so far.
    pub fn spent(&self) -> (Duration, Duration) {
        self.view.spent()
    }

    /// Writes the summary, the page and the motion; each even if another cannot be written. Returns what is kept in memory.
    pub fn finish(self, summary: &Summary, world: &World) -> Result<Kept, Error> {
        let Output { sink, mut view, .. } = self;
        view.close(world);
        let (mut folder, files, Extras { svg, usd, state }) = match sink {
            Sink::Memory(rows) => return Ok(Kept { rows, view }),
            Sink::Folder { folder, files, extras, .. } => (folder, files, extras),
        };
        for (file, probe) in files.iter().zip(&world.scene.probes) {
            folder.note(&probe_file(&probe.name), file);
        }
        let mut write = |name: &str, text: String| {
            let path = folder.file(name);
            folder.write(name, &text).map_err(|source| Error::Write { path, time: world.time(), source })
        };
        let written = write(SUMMARY, summary.to_json() + "\n");
        let page = write(PAGE, view.page(world, summary));
        let picture = if svg { write(SVG, view.svg(world)) } else { Ok(()) };
        let motion = if usd { write(USD, view.usd(world)) } else { Ok(()) };
        let kept = if state && summary.failed.is_none() { write(STATE, State::of(world)?.to_text()) } else { Ok(()) };
        // without its checksums the next run sets the files aside, and nothing is lost
        let _ = folder.close();
        page.and(picture).and(motion).and(written).and(kept).map(|()| Kept { rows: Vec::new(), view })
    }
}

impl Sink {
    /// Writes a row of a probe, which begins with the time.
    fn write(&mut self, index: usize, row: &[f64]) -> Result<(), Error> {
        match self {
            Sink::Memory(rows) => rows[index].extend(row),
            Sink::Folder { files, text, .. } => {
                text.clear();
                for (i, x) in row.iter().enumerate() {
                    // the shortest text that reads back to the same number; writing to a String cannot fail
                    let _ = write!(text, "{}{x:?}", if i > 0 { "," } else { "" });
                }
                text.push('\n');
                let (file, time) = (&mut files[index], row.first().copied().unwrap_or(f64::NAN));
                let written = file.append(text.as_bytes());
                written.map_err(|source| Error::Write { path: file.path().to_path_buf(), time, source })?;
            }
        }
        Ok(())
    }
}

/// Returns the name of the file of a probe.
fn probe_file(name: &str) -> String {
    format!("{PROBES}/{name}.csv")
}
