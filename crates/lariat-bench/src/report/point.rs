//! A point of a work-precision diagram: a setting, its error, its time, its counts.

use super::options::Options;
use crate::clock::{self, Timing};
use crate::numbers::largest;
use crate::page::Section;
use crate::table::{Cell, Format, Table, hidden, shown};
use cpu_time::ProcessTime;
use lariat_ancf::{Cable, Diagnostics, Error, Integrator, Rule, StepControl};
use lariat_figures::{Curve, LogLog};

/// A setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The curve that it belongs to.
    pub line: String,
    /// Force strategy.
    pub rule: String,
    /// Integrator.
    pub integrator: String,
    /// Step control, in words.
    pub control: String,
    /// Number of elements.
    pub elements: usize,
    /// Host step in s; 0 in statics.
    pub host: f64,
}

impl Setting {
    /// Returns the setting of a rule, an integrator and a mesh.
    pub fn new(line: impl Into<String>, rule: Rule, integrator: Integrator, elements: usize, host: f64) -> Self {
        Setting {
            line: line.into(),
            rule: rule.to_string(),
            integrator: integrator.method.to_string(),
            control: control(integrator.control),
            elements,
            host,
        }
    }
}

/// Describes a step control.
pub fn control(control: StepControl) -> String {
    match control {
        StepControl::Tolerance(t) => format!("tolerance {t:.0e} m"),
        StepControl::ToleranceOf(t, norm) => format!("tolerance {t:.0e} m of {}", norm.name()),
        StepControl::Substeps(n) => format!("{n} substeps"),
        StepControl::MaxStep(h) => format!("steps <= 1/{:.0} s", 1.0 / h),
        StepControl::Adaptive(t) => format!("1 to 8 steps per 1/60 s by {t:.0e} m"),
        StepControl::Stable(share) => format!("{share} of the stable step"),
    }
}

/// A setting and its results.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The setting.
    pub setting: Setting,
    /// Error in m; `None` if the run failed.
    pub error: Option<f64>,
    /// CPU time of repeated runs.
    pub time: Option<Timing>,
    /// Counts of one run.
    pub counts: Diagnostics,
    /// The reason why it failed.
    pub failed: Option<String>,
}

impl Point {
    /// Returns a run that failed.
    pub fn failed(setting: Setting, reason: impl ToString) -> Self {
        let (counts, failed) = (Diagnostics::default(), Some(reason.to_string()));
        Point { setting, error: None, time: None, counts, failed }
    }
}

/// Runs a cable for some host steps: once to measure the error after each, then for the time alone.
/// A failure is a point too.
pub fn run(
    options: &Options,
    setting: Setting,
    cable: Result<Cable, Error>,
    steps: usize,
    mut error: impl FnMut(usize, &Cable) -> f64,
) -> Point {
    let start = match cable {
        Ok(cable) => cable,
        Err(reason) => return Point::failed(setting, reason),
    };
    let mut read = start.clone();
    let mut worst = 0.0f64;
    for k in 1..=steps {
        if let Err(reason) = read.step(setting.host) {
            return Point { counts: *read.diagnostics(), ..Point::failed(setting, reason) };
        }
        let now = error(k, &read);
        worst = largest(worst, now);
    }
    let timed = clock::repeat(options.repeats, || {
        let mut cable = start.clone();
        let clock = ProcessTime::now();
        for _ in 0..steps {
            cable.step(setting.host)?;
        }
        Ok::<f64, Error>(clock.elapsed().as_secs_f64())
    });
    let counts = *read.diagnostics();
    match timed {
        Ok(_) if worst.is_nan() => Point { counts, ..Point::failed(setting, "the error is not a number") },
        Ok(time) => Point { setting, error: Some(worst), time, counts, failed: None },
        Err(reason) => Point { counts, ..Point::failed(setting, reason) },
    }
}

/// Columns of a table of points; pages show a figure instead.
const COLUMNS: [&str; 19] = [
    "line",
    "rule",
    "integrator",
    "control",
    "elements",
    "host_step_s",
    "error_m",
    "cpu_median_ms",
    "cpu_least_ms",
    "cpu_most_ms",
    "runs",
    "steps",
    "rejected_steps",
    "newton_iterations",
    "factorisations",
    "solves",
    "element_evaluations",
    "tangent_evaluations",
    "failed",
];

/// Returns points as a table.
pub fn table(name: &'static str, points: &[Point]) -> Table {
    let rows = points.iter().map(|p| {
        let (s, d) = (&p.setting, &p.counts);
        let ms = |part: fn(&Timing) -> f64| Cell::from(p.time.as_ref().map(|t| 1e3 * part(t)));
        vec![
            s.line.clone().into(),
            s.rule.clone().into(),
            s.integrator.clone().into(),
            s.control.clone().into(),
            s.elements.into(),
            s.host.into(),
            p.error.into(),
            ms(|t| t.median),
            ms(|t| t.least),
            ms(|t| t.most),
            p.time.map_or(0, |t| t.runs).into(),
            d.steps.into(),
            d.rejected_steps.into(),
            d.newton_iterations.into(),
            d.factorisations.into(),
            d.solves.into(),
            d.element_evaluations().into(),
            d.tangent_evaluations.into(),
            p.failed.clone().unwrap_or_default().into(),
        ]
    });
    Table { name, columns: COLUMNS.map(hidden).to_vec(), rows: rows.collect() }
}

/// Adds all points to a section, and shows those that failed with their reasons.
pub fn add(section: &mut Section, name: &'static str, points: &[Point]) {
    let table = table(name, points);
    let failed = ["rule", "integrator", "control", "elements", "failed"];
    let failed = failed.map(|name| shown(name, name, Format::Plain));
    let failed = table.select(&failed, |row| row.last() != Some(&Cell::from("")));
    if !failed.rows.is_empty() {
        section.text("Runs that failed:");
        section.excerpt(failed);
    }
    section.data(table);
}

/// Returns points with another name for one of the curves.
pub fn renamed(points: &[Point], line: &str, name: &str) -> Vec<Point> {
    let mut points = points.to_vec();
    points.iter_mut().filter(|p| p.setting.line == line).for_each(|p| p.setting.line = name.to_string());
    points
}

/// Draws points as a work-precision diagram, with the curves that `keep` takes, in the order of the
/// points.
///
/// # Errors
/// As [`LogLog::svg`].
pub fn chart(
    title: &str,
    points: &[Point],
    floor: Option<(f64, &str)>,
    keep: impl Fn(&str) -> bool,
) -> Result<String, lariat_figures::Error> {
    let mut curves: Vec<Curve> = Vec::new();
    for point in points.iter().filter(|p| keep(&p.setting.line)) {
        let name = &point.setting.line;
        if curves.last().is_none_or(|s| s.name != *name) {
            curves.push(Curve { name: name.clone(), points: Vec::new() });
        }
        if let (Some(error), Some(time), Some(last)) = (point.error, point.time, curves.last_mut()) {
            last.points.push((1e3 * time.median, error));
        }
    }
    let axes = ["CPU time [ms]".to_string(), "error [m]".to_string()];
    let floor = floor.map(|(level, why)| (level, why.to_string()));
    LogLog { title: title.to_string(), axes, curves, floor }.svg()
}
