//! Where the samples of a run go: to a folder, as `probes/NAME.csv`, `view.html` and `summary.json`, or to memory.
//!
//! Numbers are the shortest text that reads back to the same f64. Every row is written to the file at once. The names of all files
//! of a run are kept in `.lariat-files`, so that the next run into the same folder removes these and no others: a file that
//! is in the way and not in the list is an error. The list is locked while a run writes, so that two runs do not share a folder.

use super::folder::Folder;
use super::state::State;
use super::{Summary, World, probe};
use crate::error::Error;
use crate::scene::Scene;
use crate::view::Recorder;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
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

/// The file of a probe.
struct ProbeFile {
    path: PathBuf,
    file: File,
    /// Bytes of whole rows.
    length: u64,
}

/// Where rows are written.
enum Sink {
    Folder {
        folder: Folder,
        files: Vec<ProbeFile>,
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
        let names = scene.probes.iter().map(|probe| format!("{PROBES}/{}.csv", probe.name));
        let Extras { svg, usd, state } = extras;
        let asked =
            [(svg, SVG), (usd, USD), (state, STATE)].into_iter().filter(|(asked, _)| *asked).map(|(_, name)| name);
        let own = [SUMMARY, PAGE].into_iter().chain(asked).map(String::from);
        let folder = Folder::take(folder, &own.chain(names).collect::<Vec<_>>(), is_result)?;
        let fail = |path: &Path| {
            let path = path.to_path_buf();
            move |source| Error::Output { path, source }
        };
        let probes = folder.file(PROBES);
        fs::create_dir_all(&probes).map_err(fail(&probes))?;
        let mut files = Vec::new();
        for p in &scene.probes {
            let path = probes.join(format!("{}.csv", p.name));
            let mut file = File::create(&path).map_err(fail(&path))?;
            let header = probe::columns(p.target).join(",") + "\n";
            file.write_all(header.as_bytes()).map_err(fail(&path))?;
            files.push(ProbeFile { path, file, length: header.len() as u64 });
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
        let (folder, Extras { svg, usd, state }) = match sink {
            Sink::Memory(rows) => return Ok(Kept { rows, view }),
            Sink::Folder { folder, extras, .. } => (folder, extras),
        };
        let write = |name: &str, text: String| {
            let (path, time) = (folder.file(name), world.time());
            fs::write(&path, text).map_err(|source| {
                // a part of a file would be misleading
                let _ = fs::remove_file(&path);
                Error::Write { path, time, source }
            })
        };
        let written = write(SUMMARY, summary.to_json() + "\n");
        let page = write(PAGE, view.page(world, summary));
        let picture = if svg { write(SVG, view.svg(world)) } else { Ok(()) };
        let motion = if usd { write(USD, view.usd(world)) } else { Ok(()) };
        let kept = if state && summary.failed.is_none() { write(STATE, State::of(world)?.to_text()) } else { Ok(()) };
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
                files[index].append(text, row.first().copied().unwrap_or(f64::NAN))?;
            }
        }
        Ok(())
    }
}

impl ProbeFile {
    /// Appends a row; nothing stays of one that does not fit on the disk.
    fn append(&mut self, row: &str, time: f64) -> Result<(), Error> {
        let written = self.file.write_all(row.as_bytes());
        if written.is_err() {
            let _ = self.file.set_len(self.length);
        }
        self.length += row.len() as u64;
        written.map_err(|source| Error::Write { path: self.path.clone(), time, source })
    }
}

/// Returns whether a name is one that runs give to their files: nothing outside the folder, whatever a list says.
fn is_result(name: &str) -> bool {
    let probe = name.strip_prefix("probes/").is_some_and(|file| file.ends_with(".csv") && !file.contains(['/', '\\']));
    probe || [SUMMARY, PAGE, SVG, USD, STATE].contains(&name)
}
