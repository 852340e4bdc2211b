//! Work and precision of the falling pendulum: against the real beam, and in time alone against an independent solver.
//!
//! *Against the real beam.* The error is the largest 3D distance of the tip from `pendulum_converged_tip.csv` at 200 host steps of
//! 0.01 s: mesh, rule and time together. Rungs refine mesh and steps together, so that both errors fall.
//!
//! *In time.* 10 elements of the rule G10-10; the error is the largest distance of the tip from `pendulum_G10-10_10el.csv`, the same
//! elements solved by an independent code to 1e-12 m.

use super::point::{self, Point, Setting};
use super::section::Section;
use super::{Bench, failed};
use crate::error::Error;
use lariat_ancf::integrate::NewtonMode;
use lariat_ancf::{Integrator, Method, Rule, StepControl, Vector3};
use lariat_figures::reference_pendulum::{self as pendulum, INTERVAL, SAMPLES};

/// Elements, tolerance in m and substeps of the rungs.
const RUNGS: [(usize, f64, u32); 8] = [
    (5, 1e-4, 2),
    (10, 1e-5, 4),
    (14, 3e-6, 8),
    (20, 1e-6, 16),
    (28, 3e-7, 24),
    (40, 1e-7, 32),
    (56, 3e-8, 64),
    (80, 1e-8, 128),
];
/// Rules that are run down the rungs, the default first.
const RULES: [&str; 6] = ["projected-3", "G5-3", "G3-3", "ST2", "L2T2", "G10-10"];
/// Controls in time alone.
const TOLERANCES: [f64; 5] = [1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
const SUBSTEPS: [u32; 6] = [4, 8, 16, 32, 64, 128];
const SHARES: [f64; 3] = [0.95, 0.5, 0.25];

const INDEPENDENT: &str = include_str!("../../../../assets/reference/pendulum_G10-10_10el.csv");

/// Whether a method chooses its steps here by a tolerance; else by substeps.
pub fn adaptive(method: Method) -> bool {
    let once = matches!(method, Method::GeneralisedAlpha { newton: NewtonMode::Once, .. });
    method.properties().estimate_order.is_some() && !once
}

/// The step control of a method with this tolerance, or these substeps, or near its stability limit.
pub fn control(method: Method, tolerance: f64, substeps: u32) -> StepControl {
    match method {
        _ if !method.properties().implicit => StepControl::Stable(0.95),
        _ if adaptive(method) => StepControl::Tolerance(tolerance),
        _ => StepControl::Substeps(substeps),
    }
}

/// Largest tip distance from the beam, as a point.
pub fn against_beam(bench: &Bench<'_>, setting: Setting, rule: Rule, integrator: Integrator) -> Point {
    let beam = pendulum::beam();
    measure(bench, setting, rule, integrator, &beam)
}

fn measure(bench: &Bench<'_>, setting: Setting, rule: Rule, integrator: Integrator, exact: &[Vector3<f64>]) -> Point {
    let cable = pendulum::cable(rule, setting.elements, integrator);
    point::run(&bench.options, setting, cable, SAMPLES - 1, |k, cable| {
        (cable.node_position(cable.nodes() - 1) - exact[k]).norm()
    })
}

/// The rungs of a rule and a method against the real beam.
fn line(bench: &mut Bench<'_>, name: &str, rule: Rule, method: Method) -> Vec<Point> {
    bench.tell(&format!("pendulum, {name}"));
    let rungs = bench.rungs(&RUNGS).iter();
    rungs
        .map(|&(elements, tolerance, substeps)| {
            let integrator = Integrator { method, control: control(method, tolerance, substeps) };
            let setting = Setting::new(name, rule, integrator, elements, INTERVAL);
            against_beam(bench, setting, rule, integrator)
        })
        .collect()
}

/// Every integrator in time alone.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a point.
pub fn in_time(bench: &mut Bench<'_>) -> Result<Vec<Point>, Error> {
    let exact = independent();
    let rule = Rule::gauss(10, 10)?;
    let mut points = Vec::new();
    for method in Method::ALL {
        bench.tell(&format!("pendulum in time, {method}"));
        let controls: Vec<StepControl> = match method {
            _ if !method.properties().implicit => {
                bench.rungs(&SHARES).iter().map(|&s| StepControl::Stable(s)).collect()
            }
            _ if adaptive(method) => bench.rungs(&TOLERANCES).iter().map(|&t| StepControl::Tolerance(t)).collect(),
            _ => bench.rungs(&SUBSTEPS).iter().map(|&n| StepControl::Substeps(n)).collect(),
        };
        for control in controls {
            let integrator = Integrator { method, control };
            let setting = Setting::new(method.to_string(), rule, integrator, 10, INTERVAL);
            points.push(measure(bench, setting, rule, integrator, &exact));
        }
    }
    Ok(points)
}

/// Tip of the independent solver's G10-10 run at `k` times [`INTERVAL`], in m.
fn independent() -> Vec<Vector3<f64>> {
    let number = |cell: Option<&str>| cell.and_then(|x| x.parse().ok()).unwrap_or(f64::NAN);
    let position = |line: &str| {
        let mut cells = line.split(',').skip(1);
        Vector3::from_fn(|_, _| number(cells.next()))
    };
    INDEPENDENT.lines().skip(1).map(position).collect()
}

/// What was measured.
pub struct Measured {
    /// Against the real beam: rules with the default method, then methods with the default rule.
    pub beam: Vec<Point>,
    /// In time alone.
    pub time: Vec<Point>,
}

/// Measures the ladders.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a point.
pub fn measure_all(bench: &mut Bench<'_>) -> Result<Measured, Error> {
    let default = Integrator::default().method;
    let mut beam = Vec::new();
    for name in RULES {
        beam.extend(line(bench, name, name.parse()?, default));
    }
    for method in Method::ALL.into_iter().filter(|m| *m != default) {
        beam.extend(line(bench, &method.to_string(), Rule::default(), method));
    }
    Ok(Measured { beam, time: in_time(bench)? })
}

/// The section.
///
/// # Errors
/// [`Error::Figure`].
pub fn section(measured: &Measured) -> Result<Section, Error> {
    let mut section = Section::new("Pendulum: work and precision");
    let (default, rule) = (Integrator::default().method, Rule::default());
    section.text(
        "The paper's pendulum (2 m, square of 0.01 m, E = 1e8 Pa, 4000 kg/m^3, released from horizontal), 2 s in 200 host steps of \
         0.01 s. *Error* is the largest distance of the tip from the real beam (`assets/reference/pendulum_converged_tip.csv`, an \
         independent solver, extrapolated from 80 and 160 elements, good to about 1e-6 m). Down a curve mesh and steps are refined \
         together: 5 to 80 elements, tolerances of 1e-4 to 1e-8 m per host step or 2 to 128 substeps, explicit methods at 0.95 of \
         their stable step."
    );
    let is_rule = |line: &str| RULES.contains(&line);
    let rules =
        point::chart(&format!("Pendulum against the real beam: rules, {default}"), &measured.beam, None, is_rule);
    section.figure("pendulum_rules", "Error against CPU time, a curve for each rule", failed("pendulum_rules", rules)?);
    let title = format!("Pendulum against the real beam: integrators, rule {rule}");
    // the default method is among the rules, by the name of its rule
    let mut named = measured.beam.clone();
    let own = |p: &&mut Point| p.setting.line == rule.to_string();
    named.iter_mut().filter(own).for_each(|p| p.setting.line = default.to_string());
    let methods = point::chart(&title, &named, None, |line| !is_rule(line));
    let caption = "Error against CPU time, a curve for each integrator";
    section.figure("pendulum_integrators", caption, failed("pendulum_integrators", methods)?);
    section.table(point::table("pendulum", &measured.beam));
    section.text(
        "In time alone: 10 elements of the rule G10-10, which an independent solver (double precision, time error below 1e-12 m) ran \
         too (`assets/reference/pendulum_G10-10_10el.csv`). *Error* is the largest distance of the two tips: no mesh and no rule in it. \
         Tolerances of 1e-5 to 1e-9 m per host step, or 4 to 128 substeps; explicit methods at 0.95, 0.5 and 0.25 of their stable step.",
    );
    let time = point::chart("Pendulum in time alone, 10 elements, G10-10", &measured.time, None, |_| true);
    section.figure(
        "pendulum_time",
        "Error in time against CPU time, a curve for each integrator",
        failed("pendulum_time", time)?,
    );
    section.table(point::table("pendulum_time", &measured.time));
    Ok(section)
}
