//! Error against cost for a taut steel cable, compared with the modes of a rod under tension.
//!
//! # Equation
//! A straight rod between two pins, stretched evenly by f, plucked sideways. With material
//! coordinate s and small deflection y the energies of the Green law are, to second order in y,
//!
//! ```text
//! axial    EA/8 (r'.r' - 1)^2 = const + EA eps y'^2/2, eps = (f^2 - 1)/2, x' = f
//! bending  EI/2 |r' x r''|^2/|r'|^6 = EI/2 y''^2/f^4
//! kinetic  m y_t^2/2
//! ```
//!
//! so that sin(k s), k = j pi/L, is a mode with `m omega^2 = EA eps k^2 + EI k^4/f^4`, and from
//! rest `y(s, t) = sum a_j sin(j pi s/L) cos(omega_j t)`. The formula is that of
//! `D03_eigenfrequencies.json`, "taut", which an independent code confirms.
//!
//! # Validity
//! The largest neglected term is the motion along the cable that y'^2/2 drives, of the order k a^2;
//! the next is the stretch by the deflection itself, (pi a/L)^2/4 beside eps, which shifts the
//! frequencies in proportion to a^2 and so y by a^3. The section measures them: the finest run
//! again with half the amplitude, whose error is 4 times smaller if the first term dominates.

use super::options::Options;
use super::pendulum::control;
use super::point::{self, Point, Setting};
use crate::error::Error;
use crate::numbers::largest;
use crate::page::Section;
use crate::table::{Cell, Format, Table, shown};
use lariat_ancf::{At, Cable, Integrator, Method, Rule, Section as CrossSection, StepControl, Vector3};
use std::f64::consts::PI;

/// Unstretched length in m.
const LENGTH: f64 = 2.0;
/// Tension in N.
const TENSION: f64 = 2.0e4;
/// Amplitudes of the first three modes in m.
const AMPLITUDES: [f64; 3] = [1e-4, 0.5e-4, 0.25e-4];
/// Host step in s; 0.1 s in all, four periods of the first mode.
pub const HOST: f64 = 4e-3;
const STEPS: usize = 25;
/// Points at which the shape is compared, as shares of the length.
const READ: [f64; 7] = [0.11, 0.23, 0.37, 0.5, 0.61, 0.78, 0.93];
/// Elements, tolerance in m and substeps of the settings of a curve.
const RUNGS: [(usize, f64, u32); 5] = [(4, 3e-7, 16), (6, 1e-7, 32), (8, 3e-8, 64), (12, 1e-8, 128), (16, 3e-9, 256)];
/// Rules that are compared, the default first.
const RULES: [&str; 4] = ["projected-3", "G5-3", "ST2", "L2T2"];

fn steel() -> Result<CrossSection, lariat_ancf::Error> {
    CrossSection::round(0.01, 2.1e11, 7850.0)
}

/// Returns the stretch under the tension by Green's law, `EA f (f^2 - 1)/2 = T`.
fn stretch(axial: f64) -> f64 {
    let mut f = 1.0f64;
    for _ in 0..50 {
        f -= (0.5 * f * (f * f - 1.0) - TENSION / axial) / (1.5 * f * f - 0.5);
    }
    f
}

/// Returns the deflection in m and its slope at an unstretched arc length and a time.
fn deflection(section: &CrossSection, f: f64, size: f64, s: f64, t: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (j, a) in AMPLITUDES.iter().enumerate() {
        let k = (j + 1) as f64 * PI / LENGTH;
        let squared = section.axial_stiffness * 0.5 * (f * f - 1.0) * k * k
            + section.bending_stiffness * (k * k / (f * f)).powi(2);
        let swing = size * a * ((squared / section.mass_per_length).sqrt() * t).cos();
        sum[0] += swing * (k * s).sin();
        sum[1] += swing * k * (k * s).cos();
    }
    sum
}

/// Builds the cable at the start, its amplitudes multiplied by `size`.
fn cable(rule: Rule, elements: usize, integrator: Integrator, size: f64) -> Result<Cable, lariat_ancf::Error> {
    let section = steel()?;
    let f = stretch(section.axial_stiffness);
    let mut cable = Cable::builder()
        .name("taut steel")
        .points([Vector3::zeros(), Vector3::new(f * LENGTH, 0.0, 0.0)])
        .length(LENGTH)
        .section(section)
        .elements(elements)
        .rule(rule)
        .integrator(integrator)
        .gravity(Vector3::zeros())
        .fix(At::Start)
        .fix(At::End)
        .build()?;
    let start = |s: &f64| {
        let [y, slope] = deflection(&section, f, size, *s, 0.0);
        // the ends are on the line, however the sine is rounded
        let y = if *s == 0.0 || *s == LENGTH { 0.0 } else { y };
        [f * s, y, 0.0, f, slope, 0.0]
    };
    let q: Vec<f64> = cable.node_arc_lengths().iter().flat_map(start).collect();
    cable.set_coordinates(&q, &vec![0.0; q.len()])?;
    Ok(cable)
}

fn measure(options: &Options, setting: Setting, rule: Rule, integrator: Integrator, size: f64) -> Result<Point, Error> {
    let section = steel()?;
    let f = stretch(section.axial_stiffness);
    let cable = cable(rule, setting.elements, integrator, size);
    Ok(point::run(options, setting, cable, STEPS, |k, cable| {
        let t = k as f64 * HOST;
        let off = |share: &f64| {
            let s = share * LENGTH;
            let [y, _] = deflection(&section, f, size, s, t);
            cable.sample(s).map_or(f64::NAN, |p| (p.position - Vector3::new(f * s, y, 0.0)).norm())
        };
        READ.iter().map(off).fold(0.0, largest)
    }))
}

/// Runs a setting and compares it with the modes.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails.
pub fn against_modes(options: &Options, setting: Setting, rule: Rule, integrator: Integrator) -> Result<Point, Error> {
    measure(options, setting, rule, integrator, 1.0)
}

/// Measures all curves: rules with the default method, then methods with the default rule.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a point.
pub fn measure_all(options: &Options) -> Result<Vec<Point>, Error> {
    let default = Integrator::default().method;
    let rules = RULES.iter().map(|name| Ok((name.to_string(), name.parse::<Rule>()?, default)));
    let methods = Method::ALL.into_iter().filter(|m| *m != default);
    let methods = methods.map(|method| Ok((method.to_string(), Rule::default(), method)));
    let lines: Vec<(String, Rule, Method)> = rules.chain(methods).collect::<Result<_, lariat_ancf::Error>>()?;
    let mut points = Vec::new();
    for (name, rule, method) in lines {
        for &(elements, tolerance, substeps) in options.rungs(&RUNGS) {
            let integrator = Integrator { method, control: control(method, tolerance, substeps) };
            let setting = Setting::new(name.as_str(), rule, integrator, elements, HOST);
            points.push(measure(options, setting, rule, integrator, 1.0)?);
        }
    }
    Ok(points)
}

/// Measures the errors of a fine run with the whole amplitude and with half of it.
fn validity(options: &Options) -> Result<Table, Error> {
    let integrator = Integrator { method: Method::Rkn4, control: StepControl::Stable(0.5) };
    let mut rows = Vec::new();
    for size in [1.0, 0.5] {
        let setting = Setting::new("", Rule::default(), integrator, 40, HOST);
        let point = measure(options, setting, Rule::default(), integrator, size)?;
        rows.push(vec![(size * AMPLITUDES[0]).into(), 40usize.into(), point.error.into()]);
    }
    let columns = vec![
        shown("amplitude_m", "amplitude of the first mode m", Format::Scientific(1)),
        shown("elements", "elements", Format::Plain),
        shown("error_m", "error m", Format::Scientific(1)),
    ];
    Ok(Table { name: "taut_validity", columns, rows })
}

/// Title of the section.
pub const TITLE: &str = "Taut steel cable";

/// Measures the section, and returns it with its points.
///
/// # Errors
/// [`Error::Mechanics`], [`Error::Figure`]; not for a run that fails, which is a point.
pub fn section(options: &Options) -> Result<(Section, Vec<Point>), Error> {
    let points = measure_all(options)?;
    let mut section = Section::new(TITLE);
    let (default, rule) = (Integrator::default().method, Rule::default());
    section.text(format!(
        "2 m of steel wire, round, 10 mm, E = 2.1e11 Pa, 7850 kg/m^3, between two pins under {TENSION:.0e} N, plucked in its first three \
         modes (amplitudes {:.1e}, {:.1e}, {:.1e} m), 0.1 s in {STEPS} host steps of 4 ms. *Error* is the largest distance of {} points \
         along the cable from the analytic motion of a rod under tension, y = sum a_j sin(j pi s/L) cos(omega_j t), \
         m omega^2 = EA eps k^2 + EI k^4/f^4, k = j pi/L, f the stretch, eps = (f^2 - 1)/2: Green's law, linear in the deflection. Along \
         a curve there are 4 to 16 elements, tolerances of 3e-7 to 3e-9 m per host step or 16 to 256 substeps; explicit methods at 0.95 \
         of their stable step. The linear formula neglects a motion along the cable that falls with the square of the amplitude; errors \
         near that of the first row are those of the formula:",
        AMPLITUDES[0],
        AMPLITUDES[1],
        AMPLITUDES[2],
        READ.len()
    ));
    let table = validity(options)?;
    let floor = match table.rows[0][2] {
        Cell::Number(x) => Some((x, "accuracy of the linear reference")),
        _ => None,
    };
    section.table(table);
    let is_rule = |line: &str| RULES.contains(&line);
    let chart = point::chart(&format!("Taut steel cable: rules with {default}"), &points, floor, is_rule)?;
    section.figure("taut_rules", "Taut steel cable: error against CPU time, a curve for each rule", chart);
    let named = point::renamed(&points, &rule.to_string(), &default.to_string());
    let title = format!("Taut steel cable: integrators with rule {rule}");
    let caption = "Taut steel cable: error against CPU time, a curve for each integrator";
    section.figure("taut_integrators", caption, point::chart(&title, &named, floor, |l| !is_rule(l))?);
    point::add(&mut section, "taut", &points);
    Ok((section, points))
}
