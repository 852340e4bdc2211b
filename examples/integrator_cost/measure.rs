//! One whole run, timed, against a reference.

use crate::Outcome;
use cpu_time::ProcessTime;
use lariat::{At, Cable, Diagnostics, Integrator, StepControl, Vector3};
use std::fmt::Write as _;

/// What the host reads after each of its steps.
#[derive(Clone, Copy)]
pub struct Reading {
    pub tip: Vector3<f64>,
    /// Force at the first support in N.
    pub tension: f64,
    /// Kinetic energy in J.
    pub kinetic: f64,
}

/// A setting and what came of it.
pub struct Row {
    pub integrator: Integrator,
    pub milliseconds: f64,
    /// Largest tip error in m.
    pub error: f64,
    /// Largest force at the first support at the host's steps, in N.
    pub tension: f64,
    /// Change of the total energy in J.
    pub energy: f64,
    pub diagnostics: Diagnostics,
    /// Why the run ended early, if it did.
    pub outcome: Option<String>,
}

/// Steps a cable `count` times by `host` (s) and reads it after each.
pub fn readings(cable: &mut Cable, host: f64, count: usize) -> Outcome<Vec<Reading>> {
    let end = cable.node(At::End)?;
    (0..count)
        .map(|_| {
            cable.step(host)?;
            let tension = cable.reactions()?[0].force.norm();
            Ok(Reading { tip: cable.node_position(end), tension, kinetic: cable.energy().kinetic })
        })
        .collect()
}

/// Runs a cable against a reference: once read after every step, then `repeats` times for the clock alone.
pub fn run(cable: &Cable, integrator: Integrator, host: f64, exact: &[Reading], repeats: usize) -> Outcome<Row> {
    let mut start = cable.clone();
    start.set_integrator(integrator)?;
    let mut row = Row {
        integrator,
        milliseconds: f64::INFINITY,
        error: 0.0,
        tension: 0.0,
        energy: 0.0,
        diagnostics: Diagnostics::default(),
        outcome: None,
    };
    let end = start.node(At::End)?;
    let mut read = start.clone();
    for exact in exact {
        if let Err(error) = read.step(host) {
            row.outcome = Some(error.to_string());
            break;
        }
        row.error = row.error.max((read.node_position(end) - exact.tip).norm());
        row.diagnostics = *read.diagnostics();
        row.tension = row.tension.max(read.reactions()?[0].force.norm());
    }
    row.energy = read.energy().total() - start.energy().total();
    for _ in 0..repeats {
        let mut cable = start.clone();
        let clock = ProcessTime::now();
        for _ in 0..row.diagnostics.host_steps {
            cable.step(host)?;
        }
        // CPU time: what else the machine runs counts only where it takes caches and clock rate
        row.milliseconds = row.milliseconds.min(clock.elapsed().as_secs_f64() * 1e3);
    }
    Ok(row)
}

impl Row {
    /// The step control in words.
    pub fn control(&self) -> String {
        match self.integrator.control {
            StepControl::Tolerance(t) => format!("tolerance {t:.0e} m"),
            StepControl::Substeps(n) => format!("{n} substeps"),
            StepControl::MaxStep(h) => format!("steps <= 1/{:.0} s", 1.0 / h),
            StepControl::Stable(share) => format!("{share} of the stable step"),
        }
    }

    /// Method and step control as two columns.
    pub fn setting(&self) -> String {
        format!("{} | {}", self.integrator.method, self.control())
    }
}

/// A Markdown table of runs.
pub fn table<'a>(rows: impl IntoIterator<Item = &'a Row>) -> String {
    let mut out = String::from(
        "| integrator | control | time ms | tip error m | energy J | steps | rejected | Newton | factorisations | forces | tangents |\n\
         |---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for r in rows {
        let d = &r.diagnostics;
        let counts = [
            d.steps,
            d.rejected_steps,
            d.newton_iterations,
            d.factorisations,
            d.force_evaluations,
            d.tangent_evaluations,
        ];
        let counts = counts.map(|n| n.to_string()).join(" | ");
        let result = match &r.outcome {
            None => format!("{:.2} | {:.1e} | {:+.0e}", r.milliseconds, r.error, r.energy),
            Some(_) => format!("refused at host step {} | - | -", d.host_steps + 1),
        };
        let _ = writeln!(out, "| {} | {result} | {counts} |", r.setting());
    }
    out
}
