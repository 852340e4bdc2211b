//! Error against cost for the falling pendulum: from the real beam, and in time alone from an
//! independent solver.
//!
//! *From the real beam.* The error is the largest 3D distance of the tip from
//! `pendulum_converged_tip.csv` at 200 host steps of 0.01 s: mesh, rule and time together. Rungs
//! refine mesh and steps together, so that both errors fall.
//!
//! *In time.* 10 elements of the rule G10-10; the error is the largest distance of the tip from
//! `pendulum_G10-10_10el.csv`, the same elements solved by an independent code to 1e-12 m.

use super::options::Options;
use super::point::{self, Point, Setting};
use crate::error::Error;
use crate::page::Section;
use lariat_ancf::{Integrator, Method, Rule, StepControl, Vector3};
use lariat_figures::reference_pendulum::{self as pendulum, INTERVAL, SAMPLES};

/// Elements, tolerance in m and substeps of the settings of a curve.
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
/// Rules that are compared, the default first.
const RULES: [&str; 6] = ["projected-3", "G5-3", "G3-3", "ST2", "L2T2", "G10-10"];
/// Step controls in time alone.
const TOLERANCES: [f64; 5] = [1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
const SUBSTEPS: [u32; 6] = [4, 8, 16, 32, 64, 128];
const SHARES: [f64; 3] = [0.95, 0.5, 0.25];

const INDEPENDENT: &str = include_str!("../../../../assets/reference/pendulum_G10-10_10el.csv");

/// Returns whether a method is run with a tolerance here; otherwise with substeps.
pub fn adaptive(method: Method) -> bool {
    // the discrete gradient is measured at fixed steps, as games take them
    method.properties().estimate_order.is_some() && method != Method::DiscreteGradient
}

/// Returns the step control of a method: a tolerance, substeps, or a share of its stability limit.
pub fn control(method: Method, tolerance: f64, substeps: u32) -> StepControl {
    match method {
        _ if !method.properties().implicit => StepControl::Stable(0.95),
        _ if adaptive(method) => StepControl::Tolerance(tolerance),
        _ => StepControl::Substeps(substeps),
    }
}

/// Measures the largest tip distance from the beam.
pub fn against_beam(options: &Options, setting: Setting, rule: Rule, integrator: Integrator) -> Point {
    let beam = pendulum::beam();
    measure(options, setting, rule, integrator, &beam)
}

fn measure(options: &Options, setting: Setting, rule: Rule, integrator: Integrator, exact: &[Vector3<f64>]) -> Point {
    let cable = pendulum::cable(rule, setting.elements, integrator);
    point::run(options, setting, cable, SAMPLES - 1, |k, cable| {
        (cable.node_position(cable.nodes() - 1) - exact[k]).norm()
    })
}

/// Measures the curve of a rule and a method against the real beam.
fn line(options: &Options, name: &str, rule: Rule, method: Method) -> Vec<Point> {
    let rungs = options.rungs(&RUNGS).iter();
    rungs
        .map(|&(elements, tolerance, substeps)| {
            let integrator = Integrator { method, control: control(method, tolerance, substeps) };
            let setting = Setting::new(name, rule, integrator, elements, INTERVAL);
            against_beam(options, setting, rule, integrator)
        })
        .collect()
}

/// Measures every integrator in time alone.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a point.
pub fn in_time(options: &Options) -> Result<Vec<Point>, Error> {
    let exact = independent();
    let rule = Rule::gauss(10, 10)?;
    let mut points = Vec::new();
    for method in Method::ALL {
        let controls: Vec<StepControl> = match method {
            _ if !method.properties().implicit => {
                options.rungs(&SHARES).iter().map(|&s| StepControl::Stable(s)).collect()
            }
            _ if adaptive(method) => options.rungs(&TOLERANCES).iter().map(|&t| StepControl::Tolerance(t)).collect(),
            _ => options.rungs(&SUBSTEPS).iter().map(|&n| StepControl::Substeps(n)).collect(),
        };
        for control in controls {
            let integrator = Integrator { method, control };
            let setting = Setting::new(method.to_string(), rule, integrator, 10, INTERVAL);
            points.push(measure(options, setting, rule, integrator, &exact));
        }
    }
    Ok(points)
}

/// Returns the tip of the independent solver's G10-10 run at multiples of [`INTERVAL`], in m.
fn independent() -> Vec<Vector3<f64>> {
    let number = |cell: Option<&str>| cell.and_then(|x| x.parse().ok()).unwrap_or(f64::NAN);
    let position = |line: &str| {
        let mut cells = line.split(',').skip(1);
        Vector3::from_fn(|_, _| number(cells.next()))
    };
    INDEPENDENT.lines().skip(1).map(position).collect()
}

/// Measures every rule with the default method, and every method with the default rule, from the
/// real beam.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a point.
pub fn from_beam(options: &Options) -> Result<Vec<Point>, Error> {
    let default = Integrator::default().method;
    let mut points = Vec::new();
    for name in RULES {
        points.extend(line(options, name, name.parse()?, default));
    }
    for method in Method::ALL.into_iter().filter(|m| *m != default) {
        points.extend(line(options, &method.to_string(), Rule::default(), method));
    }
    Ok(points)
}

/// Title of the section.
pub const TITLE: &str = "Falling pendulum";

/// Measures the section, and returns it with the points from the real beam.
///
/// # Errors
/// [`Error::Mechanics`], [`Error::Figure`]; not for a run that fails, which is a point.
pub fn section(options: &Options) -> Result<(Section, Vec<Point>), Error> {
    let beam = from_beam(options)?;
    let mut section = Section::new(TITLE);
    let (default, rule) = (Integrator::default().method, Rule::default());
    section.text(
        "The paper's pendulum (2 m, square of 0.01 m, E = 1e8 Pa, 4000 kg/m^3, released from horizontal), 2 s in 200 host steps of \
         0.01 s. *Error* is the largest distance of the tip from the real beam (`assets/reference/pendulum_converged_tip.csv`, an \
         independent solver, extrapolated from 80 and 160 elements, accurate to about 1e-6 m). Along a curve the mesh and the steps are \
         refined together: 5 to 80 elements, tolerances of 1e-4 to 1e-8 m per host step or 2 to 128 substeps; explicit methods at 0.95 of \
         their stable step.",
    );
    let is_rule = |line: &str| RULES.contains(&line);
    let title = format!("Pendulum, error from the real beam: rules with {default}");
    let caption = "Pendulum: error from the real beam against CPU time, a curve for each rule";
    section.figure("pendulum_rules", caption, point::chart(&title, &beam, None, is_rule)?);
    let title = format!("Pendulum, error from the real beam: integrators with rule {rule}");
    // the default method is among the rules, under the name of its rule
    let named = point::renamed(&beam, &rule.to_string(), &default.to_string());
    let caption = "Pendulum: error from the real beam against CPU time, a curve for each integrator";
    section.figure("pendulum_integrators", caption, point::chart(&title, &named, None, |line| !is_rule(line))?);
    point::add(&mut section, "pendulum", &beam);
    section.text(
        "In time alone: 10 elements of the rule G10-10, which an independent solver (double precision, time error below 1e-12 m) ran \
         too (`assets/reference/pendulum_G10-10_10el.csv`). *Error* is the largest distance of the two tips, free of errors of the mesh \
         and the rule. Tolerances of 1e-5 to 1e-9 m per host step, or 4 to 128 substeps; explicit methods at 0.95, 0.5 and 0.25 of their \
         stable step.",
    );
    let time = in_time(options)?;
    let chart = point::chart("Pendulum in time alone, 10 elements, G10-10", &time, None, |_| true)?;
    section.figure("pendulum_time", "Pendulum: error in time against CPU time, a curve for each integrator", chart);
    point::add(&mut section, "pendulum_time", &time);
    Ok((section, beam))
}
