//! What the coupling to Rapier does to error, gap, energy and momentum, by host step and by Rapier's solver iterations.
//!
//! *Payload.* The scene of `payload`; error against the independent monolithic code, energy of crate and cable, which is conserved.
//! *Dumbbell.* Two balls of 2 and 6 kg on 1.8 m of cable, spinning free of gravity at 5 rad/s: linear momentum is zero and stays so,
//! angular momentum and energy stay what they were.

use super::payload;
use super::section::{Cell, Format, Section, Table, both, raw};
use super::{Bench, clock, failed};
use crate::error::Error;
use cpu_time::ProcessTime;
use lariat_ancf::{Fidelity, Rule, Vector3};
use lariat_figures::{LogLog, Series};
use lariat_scene::run::World;
use lariat_scene::scene::{Purpose, Scene};

/// Host steps per second at Rapier's own number of iterations, and iterations at 60 host steps per second.
const RATES: [u32; 5] = [30, 60, 120, 240, 480];
const ITERATIONS: [usize; 5] = [1, 2, 4, 8, 16];
/// What Rapier has by default.
const DEFAULT: usize = 4;
/// Simulated time in s.
const DURATION: u32 = 1;

const DUMBBELL: &str = r#"
name = "dumbbell"
duration = 1.0
gravity = [0.0, 0.0, 0.0]
engine = "rapier"
[[body]]
name = "light"
shape = { ball = 0.1 }
mass = 2.0
position = [-1.5, 0.0, 0.0]
velocity = [0.0, -7.293577981651376, 0.0]
angular_velocity = [0.0, 0.0, 5.0]
[[body]]
name = "heavy"
shape = { ball = 0.1 }
mass = 6.0
position = [0.5, 0.0, 0.0]
velocity = [0.0, 2.706422018348624, 0.0]
angular_velocity = [0.0, 0.0, 5.0]
[[cable]]
name = "line"
points = [[-1.4, 0.0, 0.0], [0.4, 0.0, 0.0]]
elements = 10
section = { square = 0.01 }
density = 4000.0
youngs_modulus = 1.0e9
velocity = [0.0, -6.793577981651376, 0.0]
angular_velocity = [0.0, 0.0, 5.0]
[[attachment]]
name = "light"
cable = "line"
at = "start"
body = "light"
[[attachment]]
name = "heavy"
cable = "line"
at = "end"
body = "heavy"
"#;

/// What came of a run.
#[derive(Default)]
struct Drift {
    error: Option<f64>,
    /// Largest distance between an end of the cable and its place on the body as Rapier has it, in m.
    gap: f64,
    /// Largest change of energy over the largest kinetic energy.
    energy: f64,
    /// Change of momentum over that of the heavier ball; of angular momentum over its own.
    momentum: Option<[f64; 2]>,
}

/// Places of the ends of the cable on bodies: end (0 or 1), body, and anchor in the body's axes in m.
type Pins = &'static [(usize, usize, [f64; 3])];
const PAYLOAD_PINS: Pins = &[(1, 0, [0.0, 0.1, 0.0])];
const DUMBBELL_PINS: Pins = &[(0, 0, [0.1, 0.0, 0.0]), (1, 1, [-0.1, 0.0, 0.0])];

fn gap(world: &World, pins: Pins) -> f64 {
    let cables = world.cables();
    let distance = |&(end, body, anchor): &(usize, usize, [f64; 3])| {
        let (cable, body) = (cables.first()?, world.body(body)?);
        let node = if end == 0 { 0 } else { cable.nodes() - 1 };
        Some((cable.node_position(node) - body.position - body.rotation * Vector3::from(anchor)).norm())
    };
    pins.iter().filter_map(distance).fold(0.0, f64::max)
}

fn run(world: &mut World, hz: u32, free: bool) -> Result<Drift, Error> {
    let start = (world.energy(None), world.momentum(None));
    let (mut drift, mut kinetic, mut change, mut moved) = (Drift::default(), start.0.kinetic, 0.0f64, [0.0f64; 2]);
    let mut error = 0.0f64;
    for k in 1..=hz * DURATION {
        world.advance(f64::from(k) / f64::from(hz))?;
        let (energy, momentum) = (world.energy(None), world.momentum(None));
        kinetic = kinetic.max(energy.kinetic);
        change = change.max((energy.total() - start.0.total()).abs());
        moved[0] = moved[0].max((momentum.linear - start.1.linear).norm());
        moved[1] = moved[1].max((momentum.angular - start.1.angular).norm());
        error = error.max(payload::distance(world, k, hz));
        drift.gap = drift.gap.max(gap(world, if free { DUMBBELL_PINS } else { PAYLOAD_PINS }));
    }
    drift.energy = change / kinetic;
    if free {
        let heavy = world.body(1).map_or(1.0, |body| 6.0 * body.velocity.norm());
        drift.momentum = Some([moved[0] / heavy, moved[1] / start.1.angular.norm()]);
    } else {
        drift.error = Some(error);
    }
    Ok(drift)
}

fn row(bench: &Bench<'_>, name: &str, scene: &Scene, fidelity: Fidelity, hz: u32, free: bool) -> Vec<Cell> {
    let iterations = scene.solver_iterations.unwrap_or(DEFAULT);
    let mut row: Vec<Cell> = vec![name.into(), fidelity.name().into(), u64::from(hz).into(), iterations.into()];
    let outcome = || -> Result<Vec<Cell>, Error> {
        let mut world = payload::start(scene)?;
        let drift = run(&mut world, hz, free)?;
        let counts = payload::counts(&world);
        let time = clock::repeat(&bench.options, || {
            let mut world = payload::start(scene)?;
            let clock = ProcessTime::now();
            for k in 1..=hz * DURATION {
                world.advance(f64::from(k) / f64::from(hz))?;
            }
            Ok::<f64, Error>(clock.elapsed().as_secs_f64() * 1e6 / f64::from(hz * DURATION))
        })?;
        Ok(vec![
            drift.error.into(),
            drift.gap.into(),
            drift.energy.into(),
            drift.momentum.map(|m| m[0]).into(),
            drift.momentum.map(|m| m[1]).into(),
            time.map(|t| t.median).into(),
            time.map(|t| t.least).into(),
            time.map(|t| t.most).into(),
            counts.steps.into(),
            counts.newton_iterations.into(),
            counts.factorisations.into(),
            counts.element_evaluations().into(),
            "".into(),
        ])
    };
    row.extend(outcome().unwrap_or_else(|reason| {
        let mut cells = vec![Cell::Empty; 12];
        cells.push(reason.to_string().into());
        cells
    }));
    row
}

/// The section.
///
/// # Errors
/// [`Error::Scene`], [`Error::Figure`]; not for a run that fails, which is a row.
pub fn section(bench: &mut Bench<'_>) -> Result<Section, Error> {
    let mut rows = Vec::new();
    let rates: Vec<(u32, usize)> = bench.rungs(&RATES).iter().map(|&hz| (hz, DEFAULT)).collect();
    let iterations = bench.rungs(&ITERATIONS).iter().filter(|n| **n != DEFAULT).map(|&n| (60, n));
    let cases: Vec<(u32, usize)> = rates.into_iter().chain(iterations).collect();
    let dumbbell = Scene::parse("dumbbell", DUMBBELL, &[], Purpose::Run)?;
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        for &(hz, iterations) in &cases {
            bench.tell(&format!("coupling, {}, {hz} Hz, {iterations} iterations", fidelity.name()));
            let scenes =
                [("payload", payload::scene(Rule::default(), 10, hz)?, false), ("dumbbell", dumbbell.clone(), true)];
            for (name, mut scene, free) in scenes {
                scene.dt = 1.0 / f64::from(hz);
                scene.solver_iterations = Some(iterations);
                scene.cables[0].integrator = fidelity.into();
                rows.push(row(bench, name, &scene, fidelity, hz, free));
            }
        }
    }
    let (e, n) = (Format::Scientific(1), Format::Plain);
    let columns = vec![
        both("scene", "scene", n),
        both("fidelity", "fidelity", n),
        both("host_steps_per_s", "host steps per s", n),
        both("solver_iterations", "solver iterations", n),
        both("error_m", "error m", e),
        both("gap_m", "gap m", e),
        both("energy_drift", "energy", e),
        both("momentum_drift", "momentum", e),
        both("angular_momentum_drift", "angular momentum", e),
        both("cpu_median_us", "CPU us per host step", Format::Fixed(1)),
        raw("cpu_least_us"),
        raw("cpu_most_us"),
        raw("steps"),
        raw("newton_iterations"),
        raw("factorisations"),
        raw("element_evaluations"),
        both("failed", "failed", n),
    ];
    let mut section = Section::new("Coupling: error, gap, energy and momentum");
    section.text(
        "*Payload*: the crate of 50 kg on its cable (10 elements, projected-3), 1 s; *error* against the independent monolithic code as \
         above. *Dumbbell*: balls of 2 and 6 kg on a cable of 0.72 kg, spinning at 5 rad/s without gravity, 1 s. *Gap* is the largest \
         distance in m between a cable's end and its place on the body as Rapier has it, at the host's times: single precision. *Energy* is the largest change of the total over \
         the largest kinetic energy; *momentum* the largest change over that of the heavier ball, *angular momentum* over its own. Host \
         steps vary at Rapier's 4 solver iterations, iterations at 60 host steps per second; each host step is four Rapier steps, and \
         bodies are in single precision. What a cable costs beside Rapier's own ropes: `docs/coupling.md`.",
    );
    let pick = |row: &[Cell], column: usize| if let Cell::Number(x) = row[column] { Some(x) } else { None };
    let words = |row: &[Cell], column: usize, word: &str| matches!(&row[column], Cell::Text(t) if t == word);
    let mut series = Vec::new();
    for fidelity in ["game", "engineering"] {
        let curves =
            [("payload", "error", 4), ("payload", "gap", 5), ("dumbbell", "energy", 6), ("dumbbell", "spin", 8)];
        for (scene, name, column) in curves {
            let fits = |row: &&Vec<Cell>| {
                words(row, 0, scene) && words(row, 1, fidelity) && row[3] == Cell::Count(DEFAULT as u64)
            };
            let point = |row: &Vec<Cell>| match row[2] {
                Cell::Count(hz) => Some((1.0 / hz as f64, pick(row, column)?)),
                _ => None,
            };
            let points = rows.iter().filter(fits).filter_map(point).collect();
            series.push(Series { name: format!("{fidelity}: {scene}, {name}"), points });
        }
    }
    let title = "Coupling against the host step".to_string();
    let axes = ["host step [s]".to_string(), "m, or share of the whole".to_string()];
    let svg = LogLog { title, axes, series, floor: None }.svg();
    section.figure(
        "coupling",
        "Error and gap in m, energy and angular momentum (spin) as shares, against the host step",
        failed("coupling", svg)?,
    );
    section.table(Table { name: "coupling", columns, rows, folded: false });
    Ok(section)
}
