//! Runs of one scene over a grid of values, on all threads: one row of results per run.
//!
//! A run that fails is a row with its error, and no other run is lost. With a folder every row is appended to `rows.jsonl` as soon as its
//! run ends, and a later sweep into the same folder takes from there what was done, failed runs included: a run is deterministic. Rows
//! belong to the text of the scene and the version of the program; files that a scene names are not compared.
//!
//! Results do not depend on the number of threads, but for the times `cpu_s`, `wall_s` and `real_time_factor`.

use crate::error::Error;
use crate::folder::Folder;
use crate::run::{self, Options, ProbeRecord, Recording, Summary};
use crate::scene::{Purpose, Scene};
use lariat_ancf::seal::Checksum;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashMap};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

/// The file of the rows.
const ROWS: &str = "rows.jsonl";
/// The table of a whole sweep.
const TABLE: &str = "table.csv";
/// Columns that differ between two runs of the same.
pub const TIMES: [&str; 3] = ["cpu_s", "wall_s", "real_time_factor"];

/// A scene by its text.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// The name of its file, in errors; meshes are looked for in its folder.
    pub file: &'a str,
    /// The text.
    pub text: &'a str,
}

/// The result of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What the run was of: a checksum of the scene and the version of the program.
    pub of: String,
    /// Overrides `KEY=VALUE`.
    pub settings: Vec<String>,
    /// Results by name: the numbers of the summary, and `PROBE.COLUMN.last`, `.min` and `.max` of each probe.
    pub results: BTreeMap<String, Option<f64>>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Why the run failed, if it did.
    pub error: Option<String>,
}

/// Returns all combinations of `KEY=A,B,C`, as overrides; the last key varies fastest.
///
/// # Errors
/// [`Error::Override`] for an argument without a key or values.
pub fn grid(arguments: &[String]) -> Result<Vec<Vec<String>>, Error> {
    let mut points = vec![Vec::new()];
    for argument in arguments {
        let fail = || Error::Override {
            argument: argument.clone(),
            problem: "no values; accepted: KEY=A,B,C, such as cable.sling.elements=10,20".to_string(),
        };
        let (key, list) = argument.split_once('=').ok_or_else(fail)?;
        let values = values_of(list);
        if values.is_empty() || key.trim().is_empty() {
            return Err(fail());
        }
        points = points
            .iter()
            .flat_map(|point| {
                values.iter().map(move |value| [&point[..], &[format!("{}={value}", key.trim())]].concat())
            })
            .collect();
    }
    Ok(points)
}

/// Returns the values of a list: those of a TOML array, else texts between commas.
fn values_of(list: &str) -> Vec<String> {
    let table = format!("x = [{list}]").parse::<toml::Table>();
    match table.ok().and_then(|mut table| table.remove("x")) {
        Some(toml::Value::Array(items)) => items.iter().map(toml::Value::to_string).collect(),
        _ => list.split(',').map(|text| text.trim().to_string()).filter(|text| !text.is_empty()).collect(),
    }
}

impl Source<'_> {
    /// Returns what rows of this scene are of: the FNV-1a checksum of its text, and the version.
    fn checksum(&self) -> String {
        format!("{} {}", Checksum::of(self.text.as_bytes()).digits(), env!("CARGO_PKG_VERSION"))
    }

    /// Runs the scene with overrides.
    pub fn row(&self, settings: &[String]) -> Row {
        self.row_until(settings, &Arc::default()).0
    }

    /// Runs the scene with overrides until it ends, or is stopped; returns its row, and the run unless the scene was refused.
    pub fn run(&self, settings: &[String], stop: &Arc<AtomicBool>) -> (Row, Option<Recording>) {
        let mut row = Row {
            of: self.checksum(),
            settings: settings.to_vec(),
            results: BTreeMap::new(),
            warnings: Vec::new(),
            error: None,
        };
        let recording = Scene::parse(self.file, self.text, settings, Purpose::Run).and_then(|scene| {
            run::collect(&scene, Purpose::Run, &mut Options { stop: stop.clone(), ..Options::default() })
        });
        match recording {
            Err(error) => {
                row.error = Some(error.to_string());
                (row, None)
            }
            Ok(recording) => {
                row.results = results(&recording.summary, &recording.probes);
                row.warnings.clone_from(&recording.summary.told);
                row.error = recording.failed.as_ref().map(ToString::to_string);
                (row, Some(recording))
            }
        }
    }

    /// Runs the scene with overrides until it ends, or is stopped; returns whether it ended.
    fn row_until(&self, settings: &[String], stop: &Arc<AtomicBool>) -> (Row, bool) {
        let (row, recording) = self.run(settings, stop);
        let interrupted = |recording: &Recording| matches!(recording.failed, Some(Error::Interrupted { .. }));
        (row, !recording.as_ref().is_some_and(interrupted))
    }

    /// Checks that the scene accepts some of these settings.
    ///
    /// # Errors
    /// That of the first of them if all are refused, as those of a key that does not exist.
    pub fn check(&self, points: &[Vec<String>]) -> Result<(), Error> {
        let refused = |point: &Vec<String>| Scene::parse(self.file, self.text, point, Purpose::Run).err();
        match points.iter().map(refused).try_fold(None, |first, error| error.map(|error| first.or(Some(error)))) {
            Some(Some(error)) => Err(error),
            _ => Ok(()),
        }
    }
}

fn results(summary: &Summary, probes: &[ProbeRecord]) -> BTreeMap<String, Option<f64>> {
    let mut results = BTreeMap::new();
    if let Ok(serde_json::Value::Object(fields)) = serde_json::to_value(summary) {
        results.extend(fields.into_iter().filter_map(|(key, value)| value.as_f64().map(|x| (key, Some(x)))));
    }
    let finite = |x: f64| Some(x).filter(|x| x.is_finite());
    for probe in probes {
        let columns = probe.columns.len();
        for (c, column) in probe.columns.iter().enumerate().skip(1) {
            let values = || probe.rows.iter().skip(c).step_by(columns).copied();
            let (Some(last), name) = (values().last(), format!("{}.{column}", probe.name)) else { continue };
            results.insert(format!("{name}.last"), finite(last));
            results.insert(format!("{name}.min"), finite(values().fold(f64::INFINITY, f64::min)));
            results.insert(format!("{name}.max"), finite(values().fold(f64::NEG_INFINITY, f64::max)));
        }
    }
    results
}

/// The rows of a sweep in a folder.
pub struct Store {
    path: PathBuf,
    file: Mutex<File>,
    /// Keeps other programs from the folder.
    _folder: Folder,
    done: HashMap<Vec<String>, Row>,
}

impl Store {
    /// Opens the rows of a scene in a folder, which is created if it does not exist, and belongs to this store while it lives. A
    /// line that was not written to its end is ignored.
    ///
    /// # Errors
    /// [`Error::Busy`] while another program writes there; [`Error::InTheWay`] for a `rows.jsonl` that holds anything but rows, and
    /// for a `table.csv` that no sweep wrote, or that was changed; [`Error::Output`].
    pub fn open(folder: &Path, source: &Source<'_>) -> Result<Self, Error> {
        let path = folder.join(ROWS);
        let fail = |source: io::Error| Error::Output { path: path.clone(), source };
        // before the folder is touched, and again once no other sweep writes there
        read_rows(&path)?;
        let mut owned = Folder::open(folder, &[TABLE.to_string()])?;
        owned.claim(&[], |_| false)?;
        let text = read_rows(&path)?;
        let checksum = source.checksum();
        let rows = text.lines().filter_map(|line| serde_json::from_str::<Row>(line).ok());
        let done = rows.filter(|row| row.of == checksum).map(|row| (row.settings.clone(), row)).collect();
        let mut file = OpenOptions::new().create(true).append(true).open(&path).map_err(fail)?;
        if !text.is_empty() && !text.ends_with('\n') {
            file.write_all(b"\n").map_err(fail)?;
        }
        Ok(Store { path: path.clone(), file: Mutex::new(file), _folder: owned, done })
    }

    /// Returns the row of these settings, if it was done before the store was opened.
    pub fn done(&self, settings: &[String]) -> Option<&Row> {
        self.done.get(settings)
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`Error::Output`].
    pub fn append(&self, row: &Row) -> Result<(), Error> {
        let line = serde_json::to_string(row).unwrap_or_default() + "\n";
        let mut file = self.file.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        file.write_all(line.as_bytes()).map_err(|source| Error::Output { path: self.path.clone(), source })
    }
}

/// Runs a scene with each of these settings on the threads of rayon's present pool, and returns the
/// rows in their order. `each` is called when a row is there, with whether it was done before. Once
/// `stop` is true, runs end after their present host step, and the rows that are missing are left
/// out.
///
/// # Errors
/// [`Error::Output`] if a row cannot be written; further runs are not begun then.
pub fn sweep(
    source: &Source<'_>,
    points: &[Vec<String>],
    store: Option<&Store>,
    stop: &Arc<AtomicBool>,
    each: &(dyn Fn(&Row, bool) + Sync),
) -> Result<Vec<Row>, Error> {
    let run = |settings: &Vec<String>| {
        let before = store.and_then(|store| store.done(settings)).cloned();
        let known = before.is_some();
        let (row, ended) = before.map_or_else(|| source.row_until(settings, stop), |row| (row, true));
        if !ended {
            return Ok(None);
        }
        if let (Some(store), false) = (store, known) {
            store.append(&row)?;
        }
        each(&row, known);
        Ok(Some(row))
    };
    let failed = AtomicBool::new(false);
    let guarded = |settings| {
        if stop.load(Ordering::Relaxed) || failed.load(Ordering::Relaxed) {
            return None;
        }
        let outcome = run(settings);
        failed.fetch_or(outcome.is_err(), Ordering::Relaxed);
        outcome.transpose()
    };
    // one by one, so that a thread is never left with a run of several
    let rows: Vec<Option<Result<Row, Error>>> = points.par_iter().with_max_len(1).map(guarded).collect();
    rows.into_iter().flatten().collect()
}

/// Reads the lines of a file of rows; none if there is no file.
fn read_rows(path: &Path) -> Result<String, Error> {
    let fail = |source| Error::Output { path: path.to_path_buf(), source };
    let bytes = match fs::symlink_metadata(path) {
        Ok(metadata) if metadata.is_file() => fs::read(path).map_err(fail)?,
        Ok(_) => return Err(Error::InTheWay { path: path.to_path_buf() }),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(fail(error)),
    };
    let text = String::from_utf8(bytes).ok().filter(|text| are_rows(text));
    text.ok_or_else(|| Error::InTheWay { path: path.to_path_buf() })
}

/// Returns whether a text is lines of rows, of which the last may not be written to its end.
fn are_rows(text: &str) -> bool {
    /// How a row begins.
    const BEGIN: &str = "{\"of\":\"";
    let is_row = |line: &str| line.is_empty() || serde_json::from_str::<Row>(line).is_ok();
    // one that was not written to its end stays in its place
    text.lines().all(|line| is_row(line) || line.starts_with(BEGIN) || BEGIN.starts_with(line))
}

/// Writes rows as one table, `table.csv`: settings by key (empty where a row does not set it), results, number of warnings, error.
/// The folder must belong to nobody: drop the [`Store`] before.
///
/// # Errors
/// As [`Store::open`].
pub fn write_table(folder: &Path, rows: &[Row]) -> Result<PathBuf, Error> {
    let path = folder.join(TABLE);
    let parts = |setting: &String| {
        let (key, value) = setting.split_once('=').unwrap_or((setting.as_str(), ""));
        (key.to_string(), value.to_string())
    };
    // points of a list may set different keys
    let mut keys: Vec<String> = Vec::new();
    for (key, _) in rows.iter().flat_map(|row| row.settings.iter().map(parts)) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let names: std::collections::BTreeSet<&String> = rows.iter().flat_map(|row| row.results.keys()).collect();
    let write = || -> Result<String, csv::Error> {
        let mut table = csv::Writer::from_writer(Vec::new());
        let own = ["warnings".to_string(), "error".to_string()];
        table.write_record(keys.iter().chain(names.iter().copied()).chain(&own))?;
        for row in rows {
            let of: Vec<(String, String)> = row.settings.iter().map(parts).collect();
            let value = |key: &String| of.iter().find(|(own, _)| own == key).map_or(String::new(), |(_, v)| v.clone());
            let settings = keys.iter().map(value);
            let number =
                |name: &&String| row.results.get(*name).copied().flatten().map_or(String::new(), |x| format!("{x:?}"));
            let own = [row.warnings.len().to_string(), row.error.clone().unwrap_or_default()];
            table.write_record(settings.chain(names.iter().map(number)).chain(own))?;
        }
        let bytes = table.into_inner().map_err(|error| error.into_error())?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    let fail = |source| Error::Output { path: path.clone(), source };
    let text = write().map_err(|error| fail(io::Error::other(error)))?;
    let names = [TABLE.to_string()];
    let mut owned = Folder::open(folder, &names)?;
    owned.claim(&names, |name| name == TABLE)?;
    owned.write(TABLE, &text).map_err(fail)?;
    owned.close().map_err(fail)?;
    Ok(path)
}
