//! Error against cost for a static catenary, compared with a solution by shooting.
//!
//! 12 m of cable without bending stiffness between pins 10 m apart and 2 m of height between them,
//! EA = 1e5 N, 1 kg/m. The error is the largest distance, at 33 arc lengths, from [`Catenary`]: the
//! same law, solved without elements.

use super::catenary_reference::Catenary;
use super::options::Options;
use super::point::{self, Point, Setting};
use crate::clock;
use crate::error::Error;
use crate::numbers::largest;
use crate::page::Section;
use cpu_time::ProcessTime;
use lariat_ancf::{At, AxialRule, BendingRule, Cable, Rule, Section as CrossSection, Vector3};

const AXIAL: f64 = 1e5;
const LENGTH: f64 = 12.0;
const SPAN: (f64, f64) = (10.0, 2.0);
const GRAVITY: f64 = 9.81;
const RUNGS: [usize; 7] = [4, 8, 16, 32, 64, 128, 256];
const AXIAL_RULES: [AxialRule; 5] =
    [AxialRule::Projected, AxialRule::Exact, AxialRule::Gauss(3), AxialRule::Gauss(2), AxialRule::Mean];

fn cable(rule: Rule, elements: usize) -> Result<Cable, lariat_ancf::Error> {
    Cable::builder()
        .name("catenary")
        .points([Vector3::zeros(), Vector3::new(SPAN.0, SPAN.1, 0.0)])
        .length(LENGTH)
        .section(CrossSection::from_stiffness(AXIAL, 0.0, 1.0)?)
        .rule(rule)
        .elements(elements)
        .fix(At::Start)
        .fix(At::End)
        .build()
}

/// Finds the equilibrium with a rule, and compares it with the reference.
pub fn against_shooting(options: &Options, line: &str, rule: Rule, elements: usize) -> Point {
    let setting = Setting {
        line: line.to_string(),
        rule: rule.to_string(),
        integrator: "equilibrium".to_string(),
        control: String::new(),
        elements,
        host: 0.0,
    };
    let reference = Catenary::between(AXIAL, GRAVITY, LENGTH, SPAN.0, SPAN.1);
    let start = match cable(rule, elements) {
        Ok(cable) => cable,
        Err(reason) => return Point::failed(setting, reason),
    };
    let mut found = start.clone();
    let report = match found.equilibrium() {
        Ok(report) => report,
        Err(reason) => return Point { counts: *found.diagnostics(), ..Point::failed(setting, reason) },
    };
    let off = |i: i32| {
        let s = LENGTH * f64::from(i) / 32.0;
        let [x, y] = reference.at(s);
        found.sample(s).map_or(f64::NAN, |p| (p.position - Vector3::new(x, y, 0.0)).norm())
    };
    let error = (0..=32).map(off).fold(0.0, largest);
    let timed = clock::repeat(options.repeats, || {
        let mut cable = start.clone();
        let clock = ProcessTime::now();
        cable.equilibrium()?;
        Ok::<f64, lariat_ancf::Error>(clock.elapsed().as_secs_f64())
    });
    let mut counts = *found.diagnostics();
    counts.newton_iterations = report.iterations as u64;
    match timed {
        Ok(time) => Point { setting, error: Some(error), time, counts, failed: None },
        Err(reason) => Point::failed(setting, reason),
    }
}

/// Measures the curves of all axial rules.
pub fn measure_all(options: &Options) -> Vec<Point> {
    let mut points = Vec::new();
    for axial in AXIAL_RULES {
        let rule = Rule::new(axial, BendingRule::None);
        for &elements in options.rungs(&RUNGS) {
            points.push(against_shooting(options, &rule.to_string(), rule, elements));
        }
    }
    points
}

/// Title of the section.
pub const TITLE: &str = "Static catenary";

/// Measures the section, and returns it with its points.
///
/// # Errors
/// [`Error::Figure`].
pub fn section(options: &Options) -> Result<(Section, Vec<Point>), Error> {
    let points = measure_all(options);
    let [x, y] = Catenary::between(AXIAL, GRAVITY, LENGTH, SPAN.0, SPAN.1).miss(SPAN.0, SPAN.1);
    let mut section = Section::new(TITLE);
    section.text(format!(
        "{LENGTH} m of cable without bending stiffness (EA = {AXIAL:.0e} N, 1 kg/m) between pins {} m apart, one {} m higher; from the \
         slack arc of a new cable to equilibrium. *Error* is the largest distance, at 33 arc lengths, from the catenary of Green's law by \
         shooting with adaptive quadrature (it ends within {:.0e} m of the pin). 4 to 256 elements. A rule with zero-energy modes is \
         rejected, and listed as failed with the reason.",
        SPAN.0,
        SPAN.1,
        x.hypot(y),
    ));
    let chart = point::chart("Static catenary: axial rules, no bending", &points, None, |_| true)?;
    section.figure("catenary", "Catenary: error against CPU time of the equilibrium, a curve for each rule", chart);
    point::add(&mut section, "catenary", &points);
    Ok((section, points))
}
