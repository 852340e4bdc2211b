//! Runs of scenes, and sweeps over them. Tables, progress and clusters are in `lariat.run` and `lariat.sweep`.

use crate::convert::{Count, data, object, table};
use crate::error::{Raise, raise};
use lariat_ancf::study::{InvalidTarget, Target};
use lariat_scene::command;
use lariat_scene::folder;
use lariat_scene::run::{self, Options, Recording, State};
use lariat_scene::signed::{self, Comment};
use lariat_scene::sweep::{self, Row, Source, Store};
use lariat_scene::{Error, Purpose, Scene};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Shortest wall time between two calls into Python.
const TELL_EVERY: Duration = Duration::from_millis(100);

/// What a run in memory leaves: summary, probes, page, motion.
type Run<'py> = (Bound<'py, PyAny>, Bound<'py, PyDict>, Option<Bound<'py, PyAny>>, Recorded);

/// A run that is kept, for its page and its motion.
#[pyclass(frozen, module = "lariat_cables._lariat")]
pub struct Recorded(Mutex<Recording>);

#[pymethods]
impl Recorded {
    /// The page that plays the motion.
    fn page(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).page())
    }

    /// The motion as an animated SVG.
    fn svg(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).svg())
    }

    /// The state of the world, from which a run of the same scene can start.
    fn state(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| State::of(&self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).world))
            .map(|state| state.to_text())
            .map_err(raise)
    }

    /// The motion as OpenUSD.
    fn usd(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).usd())
    }
}

/// Calls into Python from a computation, not too often.
struct Teller {
    function: Option<Py<PyAny>>,
    last: Option<Instant>,
    failed: Option<PyErr>,
}

impl Teller {
    fn new(function: Option<Py<PyAny>>) -> Self {
        Teller { function, last: None, failed: None }
    }

    /// Tells a number and looks for signals; returns whether to go on.
    fn tell(&mut self, number: f64) -> bool {
        if self.last.is_some_and(|last| last.elapsed() < TELL_EVERY) {
            return self.failed.is_none();
        }
        self.last = Some(Instant::now());
        let outcome = Python::attach(|py| {
            py.check_signals()?;
            match &self.function {
                Some(function) => function.call1(py, (number,)).map(|_| ()),
                None => Ok(()),
            }
        });
        self.failed = self.failed.take().or(outcome.err());
        self.failed.is_none()
    }
}

/// Returns a scene as TOML.
#[pyfunction]
pub fn to_toml(scene: &Bound<'_, PyDict>) -> PyResult<String> {
    let wrong = |problem: String| raise(Raise::new("SceneError", format!("not a scene: {problem}")));
    let value: toml::Table = serde_json::from_value(data(scene)?).map_err(|error| wrong(error.to_string()))?;
    toml::to_string(&value).map_err(|error| wrong(error.to_string()))
}

/// Returns the cables of a MuJoCo model as a scene in TOML.
#[pyfunction]
pub fn import_mjcf(file: &str, text: &str) -> PyResult<String> {
    lariat_scene::mjcf::import(file, text).map_err(raise)
}

/// Returns the keys of a scene file, those of one table or key (`cable.drag`), or all, as Markdown.
#[pyfunction]
pub fn scene_keys(path: Option<&str>) -> PyResult<String> {
    command::keys(path).map_err(raise)
}

/// Returns the table of the rules of the elastic forces.
#[pyfunction]
pub fn scene_rules() -> String {
    command::rules()
}

/// Writes files, by their names, to a folder, in place of those of the last run.
#[pyfunction]
pub fn save_files(py: Python<'_>, folder: PathBuf, files: Vec<(String, String)>) -> PyResult<()> {
    py.detach(|| folder::save(&folder, &files)).map_err(raise)
}

/// Writes a picture (`svg`) or a motion (`usd`) to a file, in place of one that was written so and that nobody changed.
#[pyfunction]
pub fn save_file(py: Python<'_>, path: PathBuf, text: &str, format: &str) -> PyResult<()> {
    let comment = if format == "svg" { Comment::XML } else { Comment::HASH };
    py.detach(|| signed::write(&path, text, comment)).map_err(raise)
}

/// Runs the `lariat` command, and returns its exit code.
#[pyfunction]
pub fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| command::run(arguments))
}

/// An error as Python says it: of positions in m, or a text as of `--error`.
#[derive(FromPyObject)]
pub enum AskedError {
    Positions(f64),
    Text(String),
}

impl AskedError {
    fn target(self) -> PyResult<Target> {
        match self {
            AskedError::Positions(error) => Ok(error.into()),
            AskedError::Text(text) => {
                let named = |error: InvalidTarget| {
                    raise(Raise::new("InvalidValueError", error.to_string()).with("value", text.clone()))
                };
                text.parse().map_err(named)
            }
        }
    }
}

/// Runs a scene, from a state if there is one, or finds its equilibrium. Returns the summary, the rows of the
/// probes, the exception of a run that failed, and the run.
#[pyfunction]
#[pyo3(signature = (file, text, overrides, *, statics=false, error=None, start=None, progress=None))]
pub fn run_scene<'py>(
    py: Python<'py>,
    file: &str,
    text: &str,
    overrides: Vec<String>,
    statics: bool,
    error: Option<AskedError>,
    start: Option<(String, String)>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Run<'py>> {
    let purpose = match (statics, &start) {
        (true, _) => Purpose::Static,
        (false, Some(_)) => Purpose::Resume,
        (false, None) => Purpose::Run,
    };
    let error = error.map(AskedError::target).transpose()?;
    let stop = Arc::new(AtomicBool::new(false));
    let mut teller = Teller::new(progress);
    let recording = py.detach(|| {
        let scene = Scene::parse(file, text, &overrides, purpose)?;
        let from = start.as_ref().map(|(text, source)| State::parse(text, source)).transpose()?;
        let flag = Arc::clone(&stop);
        let mut report = |time: f64| {
            if !teller.tell(time) {
                flag.store(true, Ordering::Relaxed);
            }
        };
        run::collect(
            &scene,
            purpose,
            &mut Options { stop, progress: Some(&mut report), error, from, ..Options::default() },
        )
    });
    if let Some(error) = teller.failed {
        return Err(error);
    }
    kept(py, recording.map_err(raise::<Error>)?)
}

/// Returns what a run leaves, as Python's objects.
fn kept(py: Python<'_>, mut recording: Recording) -> PyResult<Run<'_>> {
    let summary = object(py, &serde_json::to_value(&recording.summary).unwrap_or_default())?;
    let probes = PyDict::new(py);
    for probe in &mut recording.probes {
        let rows = table(py, core::mem::take(&mut probe.rows), probe.columns.len())?;
        probes.set_item(&probe.name, (probe.columns, rows))?;
    }
    let failed = recording.failed.take().map(|error| raise(error).into_value(py).into_bound(py).into_any());
    Ok((summary, probes, failed, Recorded(Mutex::new(recording))))
}

fn line(row: &Row) -> String {
    serde_json::to_string(row).unwrap_or_default()
}

/// Runs a scene with overrides and returns its row, as JSON.
#[pyfunction]
pub fn sweep_row(py: Python<'_>, file: &str, text: &str, settings: Vec<String>) -> String {
    py.detach(|| line(&Source { file, text }.row(&settings)))
}

/// Ends the runs that were given it, after their present host step.
#[pyclass(frozen, module = "lariat_cables._lariat")]
#[derive(Default)]
pub struct Stop(Arc<AtomicBool>);

#[pymethods]
impl Stop {
    #[new]
    fn new() -> Self {
        Stop::default()
    }

    /// Ends the runs.
    fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Runs a scene with overrides. Returns its row, as JSON, and what the run left, unless the scene was refused.
#[pyfunction]
pub fn sweep_run<'py>(
    py: Python<'py>,
    file: &str,
    text: &str,
    settings: Vec<String>,
    stop: &Stop,
) -> PyResult<(String, Option<Run<'py>>)> {
    let (row, recording) = py.detach(|| Source { file, text }.run(&settings, &stop.0));
    Ok((line(&row), recording.map(|recording| kept(py, recording)).transpose()?))
}

/// Returns the rows of a folder that are done, as JSON; None for the others.
#[pyfunction]
pub fn sweep_done(file: &str, text: &str, points: Vec<Vec<String>>, out: PathBuf) -> PyResult<Vec<Option<String>>> {
    let store = Store::open(&out, &Source { file, text }).map_err(raise)?;
    Ok(points.iter().map(|point| store.done(point).map(line)).collect())
}

/// Appends a row to the rows of a folder.
#[pyfunction]
pub fn sweep_append(file: &str, text: &str, row: &str, out: PathBuf) -> PyResult<()> {
    let row: Row = serde_json::from_str(row).map_err(|e| raise(Raise::new("FormatError", e.to_string())))?;
    Store::open(&out, &Source { file, text }).and_then(|store| store.append(&row)).map_err(raise)
}

/// Writes `table.csv`.
#[pyfunction]
pub fn sweep_table(rows: Vec<String>, out: PathBuf) -> PyResult<()> {
    let rows = rows.iter().map(|row| serde_json::from_str(row)).collect::<Result<Vec<Row>, _>>();
    let rows = rows.map_err(|e| raise(Raise::new("FormatError", e.to_string())))?;
    sweep::write_table(&out, &rows).map(|_| ()).map_err(raise)
}

/// Runs a scene with each of these settings on `threads` threads (0: all), and returns the rows as JSON.
#[pyfunction]
#[pyo3(signature = (file, text, points, out=None, *, threads=Count(0), progress=None), text_signature = "(file, text, points, out=None, *, threads=0, progress=None)")]
pub fn sweep_local(
    py: Python<'_>,
    file: &str,
    text: &str,
    points: Vec<Vec<String>>,
    out: Option<PathBuf>,
    threads: Count,
    progress: Option<Py<PyAny>>,
) -> PyResult<Vec<String>> {
    let (stop, done) = (Arc::new(AtomicBool::new(false)), AtomicUsize::new(0));
    let mut teller = Teller::new(progress);
    let rows = py.detach(|| {
        let source = Source { file, text };
        let store = out.as_deref().map(|out: &Path| Store::open(out, &source)).transpose()?;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.0).build();
        let each = |_: &Row, _: bool| _ = done.fetch_add(1, Ordering::Relaxed);
        let run = || sweep::sweep(&source, &points, store.as_ref(), &stop, &each);
        std::thread::scope(|scope| {
            let runs = scope.spawn(|| match pool {
                Ok(pool) => pool.install(run),
                Err(_) => run(),
            });
            // Python looks for signals in the thread that called alone
            while !runs.is_finished() {
                std::thread::sleep(TELL_EVERY / 10);
                if !teller.tell(done.load(Ordering::Relaxed) as f64) {
                    stop.store(true, Ordering::Relaxed);
                }
            }
            let rows = runs.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            teller.last = None;
            teller.tell(done.load(Ordering::Relaxed) as f64);
            rows
        })
    });
    if let Some(error) = teller.failed {
        return Err(error);
    }
    Ok(rows.map_err(raise::<Error>)?.iter().map(line).collect())
}

/// Raises the error of settings if a scene refuses all of them, as those of a key that does not
/// exist.
#[pyfunction]
pub fn sweep_check(py: Python<'_>, file: &str, text: &str, points: Vec<Vec<String>>) -> PyResult<()> {
    py.detach(|| Source { file, text }.check(&points)).map_err(raise)
}
