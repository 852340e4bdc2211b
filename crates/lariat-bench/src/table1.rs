//! The paper's Table 1, measured: force strategies of Bulin & Hajzman on the falling pendulum.
//!
//! *Accuracy* is the largest difference of the vertical tip position from the 10-element G10-10 run
//! over 0 to 2 s at 0.01 s. The error in time ([`Table1::time_error_m`]) is negligible beside that
//! of the force strategy. *Cost* is the CPU time of the same run, and the share of it that the
//! elastic forces take: the number of force evaluations in the run times the time of one
//! evaluation, measured without bending (longitudinal) and as the difference with bending
//! (transverse) on the cable's final state, as the fastest of several bursts.

use crate::clock::Timing;
use crate::error::Error;
use crate::table::{Format, Table, hidden, shown};
use cpu_time::ProcessTime;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{BendingRule, Cable, Integrator, Method, Rule, StepControl};
use lariat_figures::reference_pendulum::{self as pendulum, Trace};
use std::time::Instant;

/// One row.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Force strategy.
    pub rule: String,
    /// Number of elements.
    pub elements: usize,
    /// CPU time of the run in ms, the median of all runs.
    pub cpu_ms: f64,
    /// The smallest of them in ms.
    pub cpu_least_ms: f64,
    /// The largest of them in ms.
    pub cpu_most_ms: f64,
    /// Share of it for longitudinal forces in ms.
    pub longitudinal_ms: f64,
    /// Share of it for transverse forces in ms.
    pub transverse_ms: f64,
    /// Integration steps.
    pub steps: u64,
    /// Elements evaluated.
    pub element_evaluations: u64,
    /// Largest vertical tip difference from the 10-element G10-10 run in m.
    pub difference_m: f64,
    /// The same as the paper prints it, in m.
    pub paper_m: Option<f64>,
    /// Largest tip distance from the real beam in m.
    pub beam_m: f64,
    /// Largest vertical tip distance from the real beam in m.
    pub beam_vertical_m: f64,
}

/// The whole table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table1 {
    /// Its rows.
    pub rows: Vec<Row>,
    /// Error in time: largest tip distance between the G10-10 runs with the step of the table and
    /// with half of it, in m.
    pub time_error_m: f64,
}

/// Rule, elements, and the accuracy that the paper prints in m.
const ROWS: [(&str, usize, Option<f64>); 9] = [
    ("G2-2", 10, Some(3.36e-1)),
    ("G3-3", 10, Some(4.16e-3)),
    ("G4-4", 10, Some(1.84e-4)),
    ("G5-5", 10, Some(3.29e-5)),
    ("ST2", 10, Some(1.02e-4)),
    ("L2T2", 10, Some(1.02e-2)),
    ("L2T2", 20, Some(7.72e-3)),
    ("projected-3", 10, None),
    ("G10-10", 10, None),
];

/// Share of the stability limit at which the rows run.
const SHARE: f64 = 0.5;

/// Runs all rows, each `runs` times for the clock and at least once.
///
/// # Errors
/// [`Error::Mechanics`] if a run fails.
pub fn measure(runs: usize) -> Result<Table1, Error> {
    let reference = run(Rule::gauss(10, 10)?, 10, SHARE)?.0.tip;
    let time_error_m = run(Rule::gauss(10, 10)?, 10, 0.5 * SHARE)?.0.distance(&reference);
    let beam = pendulum::beam();
    let rows = ROWS.iter().map(|&(name, elements, paper_m)| {
        let rule: Rule = name.parse()?;
        let (trace, first) = run(rule, elements, SHARE)?;
        let more = (1..runs).map(|_| Ok(run(rule, elements, SHARE)?.1)).collect::<Result<Vec<f64>, Error>>()?;
        let cpu_ms = Timing::of([vec![first], more].concat());
        let diagnostics = *trace.cable.diagnostics();
        let evaluations = diagnostics.element_evaluations() as f64 / elements as f64;
        let [without, with] = kernel_times(&trace.cable)?.map(|seconds| 1e3 * seconds * evaluations);
        Ok(Row {
            rule: rule.to_string(),
            elements,
            cpu_ms: cpu_ms.map_or(first, |t| t.median),
            cpu_least_ms: cpu_ms.map_or(first, |t| t.least),
            cpu_most_ms: cpu_ms.map_or(first, |t| t.most),
            longitudinal_ms: without,
            transverse_ms: (with - without).max(0.0),
            steps: diagnostics.steps,
            element_evaluations: diagnostics.element_evaluations(),
            difference_m: trace.vertical_distance(&reference),
            paper_m,
            beam_m: trace.distance(&beam),
            beam_vertical_m: trace.vertical_distance(&beam),
        })
    });
    Ok(Table1 { rows: rows.collect::<Result<_, Error>>()?, time_error_m })
}

/// Makes a run, and returns it with its CPU time in ms.
fn run(rule: Rule, elements: usize, share: f64) -> Result<(Trace, f64), Error> {
    let integrator = Integrator { method: Method::Rkn6, control: StepControl::Stable(share) };
    let cable = pendulum::cable(rule, elements, integrator)?;
    let cpu = ProcessTime::now();
    let trace = Trace::run(cable)?;
    Ok((trace, 1e3 * cpu.elapsed().as_secs_f64()))
}

/// Returns the time in s of one evaluation of all elements, without bending and with it, at the
/// state of a cable.
fn kernel_times(cable: &Cable) -> Result<[f64; 2], Error> {
    let without = Rule::new(cable.rule().axial, BendingRule::None);
    let mut without = pendulum::cable(without, cable.elements().len(), cable.integrator())?;
    without.set_coordinates(cable.positions(), cable.velocities())?;
    Ok([fastest(&mut without), fastest(&mut cable.clone())])
}

fn fastest(cable: &mut Cable) -> f64 {
    const BURST: u32 = 200;
    let burst = |cable: &mut Cable| {
        let start = Instant::now();
        for _ in 0..BURST {
            std::hint::black_box(cable.force());
        }
        start.elapsed().as_secs_f64() / f64::from(BURST)
    };
    (0..30).map(|_| burst(cable)).fold(f64::INFINITY, f64::min)
}

impl Table1 {
    /// Returns the rows as a table: all columns in its CSV file, the main ones in its text.
    pub fn table(&self) -> Table {
        let (plain, ms) = (Format::Plain, Format::Fixed(2));
        let columns = vec![
            shown("rule", "rule", plain),
            shown("elements", "elements", plain),
            shown("cpu_ms", "CPU ms", ms),
            hidden("cpu_least_ms"),
            hidden("cpu_most_ms"),
            shown("longitudinal_ms", "longit. ms", ms),
            shown("transverse_ms", "transv. ms", ms),
            shown("steps", "steps", plain),
            hidden("element_evaluations"),
            shown("difference_m", "difference m", Format::Scientific(3)),
            shown("paper_m", "paper m", Format::Scientific(2)),
            shown("beam_m", "beam 3D m", Format::Scientific(3)),
            shown("beam_vertical_m", "beam vert. m", Format::Scientific(3)),
        ];
        let rows = self.rows.iter().map(|r| {
            vec![
                r.rule.clone().into(),
                r.elements.into(),
                r.cpu_ms.into(),
                r.cpu_least_ms.into(),
                r.cpu_most_ms.into(),
                r.longitudinal_ms.into(),
                r.transverse_ms.into(),
                r.steps.into(),
                r.element_evaluations.into(),
                r.difference_m.into(),
                r.paper_m.into(),
                r.beam_m.into(),
                r.beam_vertical_m.into(),
            ]
        });
        Table { name: "table1", columns, rows: rows.collect() }
    }

    /// Returns the table for a terminal, with a legend.
    pub fn text(&self) -> String {
        format!(
            "{}\n\
            CPU ms       2 s with rkn6 at {SHARE} of its stability limit, the median of some runs; tip read every 0.01 s\n\
            longit. ms   number of force evaluations times the time of one without bending\n\
            transv. ms   number of force evaluations times what bending adds to one; loads and assembly count as longitudinal\n\
            difference   largest vertical tip difference from the 10-element G10-10 run, 0 to 2 s\n\
            paper        the same as Bulin & Hajzman print it; their 3.29e-5 for G5-5 is their own error in time,\n\
            \x20            and L2 is our reading of a model whose definition was not available (mean Green strain)\n\
            beam         largest tip distance from the real beam (mesh and time converged, assets/reference)\n\
            time error   {:.1e} m: the G10-10 run against itself with half the step\n",
            self.table().text(),
            self.time_error_m
        )
    }
}
