//! Runs as tables: one of all columns for the CSV file, and views of it for the page.

use super::measure::{Row, STEPS};
use super::model::Split;
use super::scene::Scene;
use crate::table::{Cell, Column, Format, Table, hidden, shown};
use lariat_ancf::{Diagnostics, Vector3};

const COLUMNS: [&str; 20] = [
    "scene",
    "cable",
    "rapier_steps",
    "solver_iterations",
    "split",
    "cpu_us",
    "rapier_alone_us",
    "per_cable_us",
    "largest_stretch_percent",
    "last_stretch_percent",
    "error_at_half_second_m",
    "error_at_one_second_m",
    "flew_apart_at_s",
    "steps",
    "rejected_steps",
    "newton_iterations",
    "factorisations",
    "solves",
    "element_evaluations",
    "tangent_evaluations",
];

/// Returns an empty table of runs; counts are per host step and cable.
pub fn empty() -> Table {
    Table { name: "coupling", columns: COLUMNS.map(hidden).to_vec(), rows: Vec::new() }
}

/// Adds the runs of a scene; `bare` are those without cables, `centres` the reference positions of
/// the box in m.
pub fn add(table: &mut Table, scene: &Scene, runs: &[Row], bare: &[Row], centres: Option<&[Vector3<f64>; 2]>) {
    let alone = |split: Split| bare.iter().find(|r| r.split == split).map(|r| r.micros);
    for r in runs {
        let whole = |x: f64| if r.flew_apart.is_none() { Cell::from(x) } else { Cell::Empty };
        let error = |k: usize| Cell::from(centres.map(|centres| (r.centres[k] - centres[k]).norm()));
        let count = |of: fn(&Diagnostics) -> u64| Cell::from(r.counts.map(|d| of(&d) as f64 / STEPS as f64));
        table.rows.push(vec![
            scene.name.into(),
            r.model.name().into(),
            u64::from(r.split.steps).into(),
            r.split.iterations.into(),
            r.split.name().into(),
            r.micros.into(),
            alone(r.split).into(),
            alone(r.split).map(|alone| (r.micros - alone) / scene.count as f64).into(),
            whole(100.0 * r.stretch),
            whole(100.0 * r.last),
            error(0),
            error(1),
            r.flew_apart.into(),
            count(|d| d.steps),
            count(|d| d.rejected_steps),
            count(|d| d.newton_iterations),
            count(|d| d.factorisations),
            count(|d| d.solves),
            count(Diagnostics::element_evaluations),
            count(|d| d.tangent_evaluations),
        ]);
    }
}

/// Returns the runs of a scene for the page, with some more columns.
pub fn view(table: &Table, scene: &Scene, more: &[Column]) -> Table {
    let mut columns = vec![
        shown("cable", "cable", Format::Plain),
        shown("split", "split", Format::Plain),
        shown("cpu_us", "time us", Format::Short),
        shown("rapier_alone_us", "Rapier alone us", Format::Short),
        shown("per_cable_us", "per cable us", Format::Short),
    ];
    columns.extend(more);
    table.select(&columns, |row| row[0] == Cell::from(scene.name))
}
