//! The three fidelities, and the cheapest setting for an error, from the points that were measured.

use super::options::Options;
use super::point::{Point, Setting};
use super::{catenary, payload, pendulum, taut};
use crate::error::Error;
use crate::page::Section;
use crate::table::{Cell, Format, Table, hidden, shown};
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{BendingRule, Fidelity, Rule};
use lariat_figures::reference_pendulum::INTERVAL;

/// A scene with its measured points.
pub struct Scene<'a> {
    /// Name.
    pub name: &'static str,
    /// Its points.
    pub points: &'a [Point],
    /// Errors in m for which the cheapest setting is looked for, from the largest.
    pub errors: &'static [f64],
}

/// Returns the point with the smallest time of those below an error.
pub fn cheapest(points: &[Point], error: f64) -> Option<&Point> {
    let time = |p: &&Point| p.time.map_or(f64::INFINITY, |t| t.median);
    let good = points.iter().filter(|p| p.error.is_some_and(|e| e < error) && p.time.is_some());
    good.min_by(|a, b| time(a).total_cmp(&time(b)))
}

fn cheapest_table(scenes: &[Scene<'_>]) -> Table {
    let mut rows = Vec::new();
    for scene in scenes {
        for &error in scene.errors {
            let mut row: Vec<Cell> = vec![scene.name.into(), error.into()];
            match cheapest(scene.points, error) {
                Some(p) => row.extend([
                    p.setting.rule.clone().into(),
                    p.setting.integrator.clone().into(),
                    p.setting.control.clone().into(),
                    p.setting.elements.into(),
                    p.error.into(),
                    p.time.map(|t| 1e3 * t.median).into(),
                ]),
                None => {
                    row.push("not reached".into());
                    row.extend(vec![Cell::Empty; 5]);
                }
            }
            rows.push(row);
        }
    }
    let columns = vec![
        shown("scene", "scene", Format::Plain),
        shown("error_below_m", "for an error below m", Format::Scientific(0)),
        shown("rule", "rule", Format::Plain),
        shown("integrator", "integrator", Format::Plain),
        shown("control", "control", Format::Plain),
        shown("elements", "elements", Format::Plain),
        shown("error_m", "its error m", Format::Scientific(1)),
        shown("cpu_median_ms", "CPU ms", Format::Fixed(3)),
    ];
    Table { name: "cheapest", columns, rows }
}

/// Runs each fidelity on each scene, with its own rule, elements and integrator.
fn fidelities(options: &Options) -> Result<Vec<(Fidelity, &'static str, Point)>, Error> {
    let mut out = Vec::new();
    for fidelity in Fidelity::ALL {
        let (rule, elements) = (fidelity.rule(), fidelity.elements());
        let soft = lariat_figures::reference_pendulum::cable(rule, elements, Default::default())?.frequency_bound();
        let integrator = fidelity.integrator(soft);
        let setting = Setting::new("", rule, integrator, elements, INTERVAL);
        out.push((fidelity, "pendulum", pendulum::against_beam(options, setting, rule, integrator)));

        // with the mesh of the reference
        let mut scene = payload::scene(rule, payload::ELEMENTS, 60)?;
        scene.cables[0].integrator = fidelity;
        let integrator = scene.build_cable(0)?.integrator();
        let setting = Setting::new("", rule, integrator, payload::ELEMENTS, scene.dt);
        out.push((fidelity, "payload", payload::against_monolithic(options, setting, &scene, 60)));

        let integrator = fidelity.integrator(f64::INFINITY);
        let setting = Setting::new("", rule, integrator, elements, taut::HOST);
        out.push((fidelity, "taut steel", taut::against_modes(options, setting, rule, integrator)?));

        let without_bending = Rule::new(rule.axial, BendingRule::None);
        out.push((fidelity, "catenary", catenary::against_shooting(options, "", without_bending, elements)));
    }
    Ok(out)
}

fn fidelity_table(measured: &[(Fidelity, &'static str, Point)], scenes: &[Scene<'_>]) -> Table {
    let rows = measured.iter().map(|(fidelity, name, p)| {
        let points = scenes.iter().find(|s| s.name == *name).map_or(&[][..], |s| s.points);
        // slightly larger, so that the same setting counts
        let best = p.error.and_then(|e| cheapest(points, e * (1.0 + 1e-9)));
        vec![
            Cell::from(fidelity.name()),
            (*name).into(),
            p.setting.rule.clone().into(),
            p.setting.integrator.clone().into(),
            p.setting.control.clone().into(),
            p.setting.elements.into(),
            p.setting.host.into(),
            p.error.into(),
            p.time.map(|t| 1e3 * t.median).into(),
            p.time.map(|t| 1e3 * t.least).into(),
            p.time.map(|t| 1e3 * t.most).into(),
            p.counts.steps.into(),
            p.counts.newton_iterations.into(),
            p.counts.factorisations.into(),
            p.counts.element_evaluations().into(),
            best.and_then(|r| r.time).map(|t| 1e3 * t.median).into(),
            best.map_or(String::new(), |r| {
                format!(
                    "{} {}, {}, {} elements",
                    r.setting.rule, r.setting.integrator, r.setting.control, r.setting.elements
                )
            })
            .into(),
            p.failed.clone().unwrap_or_default().into(),
        ]
    });
    let (n, ms) = (Format::Plain, Format::Fixed(3));
    let columns = vec![
        shown("fidelity", "fidelity", n),
        shown("scene", "scene", n),
        hidden("rule"),
        shown("integrator", "integrator", n),
        shown("control", "control", n),
        shown("elements", "elements", n),
        hidden("host_step_s"),
        shown("error_m", "error m", Format::Scientific(1)),
        shown("cpu_median_ms", "CPU ms", ms),
        hidden("cpu_least_ms"),
        hidden("cpu_most_ms"),
        hidden("steps"),
        hidden("newton_iterations"),
        hidden("factorisations"),
        shown("element_evaluations", "element evaluations", n),
        shown("cheapest_ms", "cheapest ms", ms),
        hidden("cheapest"),
        hidden("failed"),
    ];
    Table { name: "fidelity", columns, rows: rows.collect() }
}

/// Title of the section.
pub const TITLE: &str = "Summary: three fidelities, and the cheapest setting for an error";

/// Measures the fidelities, and selects the cheapest settings from the points of the scenes.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a row.
pub fn section(options: &Options, scenes: &[Scene<'_>]) -> Result<Section, Error> {
    let mut section = Section::new(TITLE);
    section.text(
        "`Fidelity::Game`, `Fidelity::Engineering` (the default) and `Fidelity::Reference` are presets: an integrator with its step control, \
         a rule (projected-T1 for `Game`, else the default), and a recommended number of elements. The scenes are those of the sections below, with host steps of 0.01 s, \
         1/60 s and 0.004 s (pendulum, payload and steel); the payload has the 10 elements of its reference, and the catenary is an \
         equilibrium without bending. *Cheapest* is the time of the cheapest setting below that is as accurate on that scene.",
    );
    section.table(fidelity_table(&fidelities(options)?, scenes));
    section.text(
        "The cheapest setting whose error is below a bound, of all that were measured. It is selected after the fact and for one scene, and \
         need not be good for another: explicit methods need steps as short as the stiffest mode requires.",
    );
    section.table(cheapest_table(scenes));
    Ok(section)
}
