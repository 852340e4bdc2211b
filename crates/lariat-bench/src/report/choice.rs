//! The cheapest choice for an error, from the points that were measured; and the three fidelities that the library offers, measured on
//! the same scenes.

use super::point::{Point, Setting};
use super::section::{Cell, Format, Section, Table, both, raw};
use super::{Bench, catenary, payload, pendulum, taut};
use crate::error::Error;
use lariat_ancf::{BendingRule, Fidelity, Rule};
use lariat_figures::reference_pendulum::INTERVAL;

/// A scene by name with its points, and the errors in m that are asked for.
pub struct Scene<'a> {
    /// Name.
    pub name: &'static str,
    /// Its points.
    pub points: &'a [Point],
    /// Errors in m, from the largest.
    pub errors: &'static [f64],
}

/// The point of least time among those below an error.
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
        both("scene", "scene", Format::Plain),
        both("error_below_m", "for an error below m", Format::Scientific(0)),
        both("rule", "rule", Format::Plain),
        both("integrator", "integrator", Format::Plain),
        both("control", "control", Format::Plain),
        both("elements", "elements", Format::Plain),
        both("error_m", "its error m", Format::Scientific(1)),
        both("cpu_median_ms", "CPU ms", Format::Fixed(3)),
    ];
    Table { name: "cheapest", columns, rows, folded: false }
}

/// Every fidelity on every scene, with its own rule, elements and integrator.
fn fidelities(bench: &mut Bench<'_>) -> Result<Vec<(Fidelity, &'static str, Point)>, Error> {
    let mut out = Vec::new();
    for fidelity in Fidelity::ALL {
        bench.tell(&format!("fidelity {}", fidelity.name()));
        let (rule, elements) = (fidelity.rule(), fidelity.elements());
        let soft = lariat_figures::reference_pendulum::cable(rule, elements, Default::default())?.frequency_bound();
        let integrator = fidelity.integrator(soft);
        let setting = Setting::new("", rule, integrator, elements, INTERVAL);
        out.push((fidelity, "pendulum", pendulum::against_beam(bench, setting, rule, integrator)));

        // the mesh of its reference
        let mut scene = payload::scene(rule, payload::ELEMENTS, 60)?;
        scene.cables[0].integrator = fidelity.into();
        let integrator = scene.build_cable(0)?.integrator();
        let setting = Setting::new("", rule, integrator, payload::ELEMENTS, scene.dt);
        out.push((fidelity, "payload", payload::against_monolithic(bench, setting, &scene, 60)));

        let integrator = fidelity.integrator(f64::INFINITY);
        let setting = Setting::new("", rule, integrator, elements, taut::HOST);
        out.push((fidelity, "taut steel", taut::against_modes(bench, setting, rule, integrator)?));

        let limp = Rule::new(rule.axial, BendingRule::None);
        out.push((fidelity, "catenary", catenary::against_shooting(bench, "", limp, elements)));
    }
    Ok(out)
}

fn fidelity_table(measured: &[(Fidelity, &'static str, Point)], scenes: &[Scene<'_>]) -> Table {
    let rows = measured.iter().map(|(fidelity, name, p)| {
        let points = scenes.iter().find(|s| s.name == *name).map_or(&[][..], |s| s.points);
        // a hair above, so that the same setting counts as reaching it
        let rival = p.error.and_then(|e| cheapest(points, e * (1.0 + 1e-9)));
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
            rival.and_then(|r| r.time).map(|t| 1e3 * t.median).into(),
            rival
                .map_or(String::new(), |r| {
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
        both("fidelity", "fidelity", n),
        both("scene", "scene", n),
        raw("rule"),
        both("integrator", "integrator", n),
        both("control", "control", n),
        both("elements", "elements", n),
        raw("host_step_s"),
        both("error_m", "error m", Format::Scientific(1)),
        both("cpu_median_ms", "CPU ms", ms),
        both("cpu_least_ms", "least", ms),
        both("cpu_most_ms", "most", ms),
        both("steps", "steps", n),
        both("newton_iterations", "Newton", n),
        both("factorisations", "factorisations", n),
        both("element_evaluations", "element evaluations", n),
        both("cheapest_ms", "cheapest as good ms", ms),
        raw("cheapest"),
        both("failed", "failed", n),
    ];
    Table { name: "fidelity", columns, rows: rows.collect(), folded: false }
}

/// The section.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a row.
pub fn section(bench: &mut Bench<'_>, scenes: &[Scene<'_>]) -> Result<Section, Error> {
    let mut section = Section::new("For an error below x, the cheapest choice");
    section.text(
        "Of all points of the diagrams below, the one of least median CPU time whose error is below x. Chosen so, \
         after the fact and scene by scene, a setting need not be good on another: explicit methods need steps as short as the stiffest \
         mode asks.",
    );
    section.table(cheapest_table(scenes));
    section.text(
        "The library offers three choices, `Fidelity::Game`, `Fidelity::Engineering` (the default) and `Fidelity::Reference`: an \
         integrator for any stiffness, the default rule, and an advice on the number of elements. On the same scenes (host steps of \
         0.01 s, 1/60 s and 0.004 s, pendulum, payload and steel; the payload has the 10 elements of its reference; the catenary has no \
         integrator, and its rule no bending); right is the \
         time of the cheapest point above that is as good on that scene, chosen after the fact:",
    );
    let measured = fidelities(bench)?;
    section.table(fidelity_table(&measured, scenes));
    Ok(section)
}
