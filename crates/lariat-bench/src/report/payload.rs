//! Error against cost for the payload pendulum: a cable and a body of Rapier, compared with an
//! independent monolithic code.
//!
//! A crate of 50 kg hangs by its top face on 2 m of cable (0.8 kg, E = 1e9 Pa), released from
//! horizontal. The error is the larger of the distances of its centre from (1.70292, -1.21801) m at
//! 0.5 s and (-0.82138, -1.91419) m at 1 s: a fine run of an independent code that solves cable and
//! body as one system, accurate to 2e-5 m. Ours agrees with it to that with 10 elements of the
//! exact axial energy, and departs from it with more of them, as the curve "G5-3, elements" shows.
//! We conclude that its mesh has 10 elements, and refine time alone along the other curves.

use super::options::Options;
use super::pendulum::control;
use super::point::{self, Point, Setting};
use crate::clock;
use crate::error::Error;
use crate::numbers::largest;
use crate::page::Section;
use cpu_time::ProcessTime;
use lariat_ancf::{Diagnostics, Integrator, Method, Rule, StepControl};
use lariat_scene::run::World;
use lariat_scene::scene::{Purpose, Scene};

/// Centre of the crate at 0.5 s and 1 s in m.
const CENTRES: [(f64, f64); 2] = [(1.70292, -1.21801), (-0.82138, -1.91419)];
/// Elements of the reference.
pub const ELEMENTS: usize = 10;
/// Accuracy of the reference in m.
const ACCURACY: f64 = 2e-5;
/// Host steps per second, tolerance in m, substeps and share of the stable step of the settings of
/// a curve.
const RUNGS: [(u32, f64, u32, f64); 5] =
    [(30, 1e-4, 8, 0.95), (60, 1e-5, 4, 0.7), (120, 1e-6, 8, 0.5), (240, 1e-7, 16, 0.35), (480, 1e-8, 32, 0.25)];
const RULES: [&str; 3] = ["G5-3", "projected-3", "ST2"];
const MESHES: [usize; 4] = [5, 10, 20, 40];

/// The scene; integrator, rule, mesh and host step are replaced.
const SCENE: &str = r#"
name = "payload pendulum"
duration = 1.0
engine = "rapier"
[[body]]
name = "crate"
shape = { cuboid = [0.1, 0.1, 0.1] }
mass = 50.0
position = [2.0, -0.1, 0.0]
[[cable]]
name = "sling"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
elements = 10
section = { square = 0.01 }
density = 4000.0
youngs_modulus = 1.0e9
rule = "G5-3"
[[attachment]]
name = "pin"
cable = "sling"
at = "start"
body = "world"
[[attachment]]
name = "hook"
cable = "sling"
at = "end"
body = "crate"
anchor = [0.0, 0.1, 0.0]
"#;

/// Returns the scene with other values.
///
/// # Errors
/// [`Error::Scene`]; not for valid ones.
pub fn scene(rule: Rule, elements: usize, hz: u32) -> Result<Scene, Error> {
    let mut scene = Scene::parse("payload pendulum", SCENE, &[], Purpose::Run)?;
    scene.dt = 1.0 / f64::from(hz);
    scene.cables[0].elements = elements;
    scene.cables[0].rule = rule;
    Ok(scene)
}

/// Builds a scene and starts it.
///
/// # Errors
/// As [`World::start`].
pub fn start(scene: &Scene) -> Result<World, Error> {
    let mut world = World::build(scene)?;
    world.start(Purpose::Run)?;
    Ok(world)
}

/// Returns the distance of the crate from the reference in m after a host step that ends at 0.5 s
/// or 1 s, otherwise 0.
pub fn distance(world: &World, step: u32, hz: u32) -> f64 {
    let at = [hz / 2, hz].iter().position(|k| *k == step);
    let (Some(k), Some(body)) = (at, world.body(0)) else { return 0.0 };
    (body.position.x - CENTRES[k].0).hypot(body.position.y - CENTRES[k].1)
}

/// Returns the counts of all cables.
pub fn counts(world: &World) -> Diagnostics {
    let mut sum = Diagnostics::default();
    world.cables().iter().for_each(|cable| sum += *cable.diagnostics());
    sum
}

/// Runs a scene of 1 s and compares it with the reference.
pub fn against_monolithic(options: &Options, setting: Setting, scene: &Scene, hz: u32) -> Point {
    let outcome = || -> Result<Point, Error> {
        let mut world = start(scene)?;
        let mut error = 0.0f64;
        for k in 1..=hz {
            world.advance(f64::from(k) * scene.dt)?;
            let now = distance(&world, k, hz);
            error = largest(error, now);
        }
        let time = clock::repeat(options.repeats, || {
            let mut world = start(scene)?;
            let clock = ProcessTime::now();
            for k in 1..=hz {
                world.advance(f64::from(k) * scene.dt)?;
            }
            Ok::<f64, Error>(clock.elapsed().as_secs_f64())
        })?;
        Ok(Point { setting: setting.clone(), error: Some(error), time, counts: counts(&world), failed: None })
    };
    outcome().unwrap_or_else(|reason| Point::failed(setting.clone(), reason))
}

/// Measures all curves.
///
/// # Errors
/// [`Error::Mechanics`]; not for a run that fails, which is a point.
pub fn measure_all(options: &Options) -> Result<Vec<Point>, Error> {
    let default = Integrator::default().method;
    let reference: Rule = RULES[0].parse()?;
    let rules = RULES.iter().map(|name| Ok((name.to_string(), name.parse::<Rule>()?, default)));
    let methods = Method::ALL.into_iter().filter(|m| *m != default);
    let methods = methods.map(|method| Ok((method.to_string(), reference, method)));
    let lines: Vec<(String, Rule, Method)> = rules.chain(methods).collect::<Result<_, lariat_ancf::Error>>()?;
    let mut points = Vec::new();
    let mut one = |options: &Options, name: &str, rule, integrator: Integrator, elements, hz| {
        let mut scene = scene(rule, elements, hz)?;
        scene.cables[0].integrator = integrator.into();
        let setting = Setting::new(name, rule, integrator, elements, scene.dt);
        points.push(against_monolithic(options, setting, &scene, hz));
        Ok::<(), Error>(())
    };
    for (name, rule, method) in lines {
        for &(hz, tolerance, substeps, share) in options.rungs(&RUNGS) {
            let control = match control(method, tolerance, substeps) {
                StepControl::Stable(_) => StepControl::Stable(share),
                other => other,
            };
            let integrator = Integrator { method, control };
            one(options, &name, rule, integrator, ELEMENTS, hz)?;
        }
    }
    for &elements in options.rungs(&MESHES) {
        let integrator = Integrator { method: Method::Verlet, control: StepControl::Stable(0.95) };
        one(options, "G5-3, elements", reference, integrator, elements, 60)?;
    }
    Ok(points)
}

/// Title of the section.
pub const TITLE: &str = "Payload pendulum";

/// Measures the section, and returns it with its points.
///
/// # Errors
/// [`Error::Mechanics`], [`Error::Figure`]; not for a run that fails, which is a point.
pub fn section(options: &Options) -> Result<(Section, Vec<Point>), Error> {
    let points = measure_all(options)?;
    let mut section = Section::new(TITLE);
    let default = Integrator::default().method;
    section.text(format!(
        "A crate of 50 kg in Rapier hangs by its top face on 2 m of cable (square of 0.01 m, E = 1e9 Pa, 4000 kg/m^3), released from \
         horizontal, 1 s. *Error* is the larger of the distances of its centre from (1.70292, -1.21801) m at 0.5 s and (-0.82138, \
         -1.91419) m at 1 s, by an independent code that solves cable and body as one system, accurate to {ACCURACY:.0e} m. Ours \
         agrees with it to that with 10 elements of the exact axial energy and departs from it with more, as the curve \"G5-3, elements\" \
         shows (5 to 40 of them, verlet): its mesh is taken to have 10. The other curves have 10 elements; *projected-3* and *ST2* converge to \
         what the rule changes. Host steps of 1/30 to 1/480 s, each of four Rapier steps, with tolerances of 1e-4 to 1e-8 m per host step \
         or 4 to 32 substeps; explicit methods at 0.95 to 0.25 of their stable step. The cable becomes taut with a jerk and vibrates \
         undamped, so that errors of implicit methods do not fall evenly. CPU time is that of the whole world."
    ));
    let floor = Some((ACCURACY, "accuracy of the reference"));
    let is_rule = |line: &str| RULES.contains(&line) || line == "G5-3, elements";
    let title = format!("Payload pendulum: rules with {default}");
    let caption = "Payload pendulum: error against CPU time, a curve for each rule";
    section.figure("payload_rules", caption, point::chart(&title, &points, floor, is_rule)?);
    let named = point::renamed(&points, RULES[0], &default.to_string());
    let chart = point::chart("Payload pendulum: integrators with rule G5-3", &named, floor, |line| !is_rule(line))?;
    let caption = "Payload pendulum: error against CPU time, a curve for each integrator";
    section.figure("payload_integrators", caption, chart);
    point::add(&mut section, "payload", &points);
    Ok((section, points))
}
