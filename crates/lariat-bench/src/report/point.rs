//! One point of a work-precision diagram: a setting, its error, its time, its counts.

use super::Options;
use super::clock::{self, Timing};
use super::section::{Cell, Column, Format, Table, both, raw};
use cpu_time::ProcessTime;
use lariat_ancf::{Cable, Diagnostics, Error, Integrator, Rule, StepControl};
use lariat_figures::{LogLog, Series};

/// What is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The curve that it is a point of.
    pub line: String,
    /// Force strategy.
    pub rule: String,
    /// Integrator.
    pub integrator: String,
    /// Step control in words.
    pub control: String,
    /// Number of elements.
    pub elements: usize,
    /// Host step in s; 0 in statics.
    pub host: f64,
}

impl Setting {
    /// A rule, an integrator and a mesh.
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

/// A step control in words.
pub fn control(control: StepControl) -> String {
    match control {
        StepControl::Tolerance(t) => format!("tolerance {t:.0e} m"),
        StepControl::Substeps(n) => format!("{n} substeps"),
        StepControl::MaxStep(h) => format!("steps <= 1/{:.0} s", 1.0 / h),
        StepControl::Stable(share) => format!("{share} of the stable step"),
    }
}

/// A setting and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What was run.
    pub setting: Setting,
    /// Error in m; `None` if the run failed.
    pub error: Option<f64>,
    /// Time of repeated runs.
    pub time: Option<Timing>,
    /// Counts of one run.
    pub counts: Diagnostics,
    /// Why it failed.
    pub failed: Option<String>,
}

impl Point {
    /// A run that failed.
    pub fn failed(setting: Setting, reason: impl ToString) -> Self {
        let (counts, failed) = (Diagnostics::default(), Some(reason.to_string()));
        Point { setting, error: None, time: None, counts, failed }
    }
}

/// Runs a cable `steps` host steps: once to read the error after each, then for the clock alone. A failure is a point too.
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
        // f64::max would pass over one that is not a number
        worst = if now.is_nan() { now } else { worst.max(now) };
    }
    let timed = clock::repeat(options, || {
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

/// Columns of a table of points.
const COLUMNS: [Column; 19] = [
    raw("line"),
    both("rule", "rule", Format::Plain),
    both("integrator", "integrator", Format::Plain),
    both("control", "control", Format::Plain),
    both("elements", "elements", Format::Plain),
    raw("host_step_s"),
    both("error_m", "error m", Format::Scientific(1)),
    both("cpu_median_ms", "CPU ms", Format::Fixed(3)),
    both("cpu_least_ms", "least", Format::Fixed(3)),
    both("cpu_most_ms", "most", Format::Fixed(3)),
    raw("runs"),
    both("steps", "steps", Format::Plain),
    both("rejected_steps", "rejected", Format::Plain),
    both("newton_iterations", "Newton", Format::Plain),
    both("factorisations", "factorisations", Format::Plain),
    raw("solves"),
    both("element_evaluations", "element evaluations", Format::Plain),
    raw("tangent_evaluations"),
    both("failed", "failed", Format::Plain),
];

/// Points as a table.
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
    let mut columns = COLUMNS.to_vec();
    if points.iter().all(|p| p.failed.is_none()) {
        // a column of nothing is not shown
        columns[COLUMNS.len() - 1].head = None;
    }
    Table { name, columns, rows: rows.collect(), folded: true }
}

/// Points as a work-precision diagram, a curve for each line that `shown` takes, in the order of the points.
///
/// # Errors
/// As [`LogLog::svg`].
pub fn chart(
    title: &str,
    points: &[Point],
    floor: Option<(f64, &str)>,
    shown: impl Fn(&str) -> bool,
) -> Result<String, String> {
    let mut series: Vec<Series> = Vec::new();
    for point in points.iter().filter(|p| shown(&p.setting.line)) {
        let name = &point.setting.line;
        if series.last().is_none_or(|s| s.name != *name) {
            series.push(Series { name: name.clone(), points: Vec::new() });
        }
        if let (Some(error), Some(time), Some(last)) = (point.error, point.time, series.last_mut()) {
            last.points.push((1e3 * time.median, error));
        }
    }
    let axes = ["CPU time [ms]".to_string(), "error [m]".to_string()];
    let floor = floor.map(|(level, why)| (level, why.to_string()));
    LogLog { title: title.to_string(), axes, series, floor }.svg()
}
