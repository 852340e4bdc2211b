//! Error, gap, energy and momentum of the coupling to Rapier, against the host step and Rapier's
//! solver iterations.
//!
//! *Payload.* The scene of `payload`; error against the independent monolithic code, energy of
//! crate and cable, which is conserved. *Dumbbell.* Two balls of 2 and 6 kg on 1.8 m of cable spin
//! without gravity at 5 rad/s: linear momentum remains zero, angular momentum and energy are
//! conserved.

use super::options::Options;
use super::payload;
use crate::clock;
use crate::error::Error;
use crate::page::Section;
use crate::table::{Cell, Table, hidden};
use cpu_time::ProcessTime;
use lariat_ancf::{Fidelity, Rule, Vector3};
use lariat_figures::{Curve, LogLog};
use lariat_scene::run::World;
use lariat_scene::scene::{Purpose, Scene};

/// Host steps per second at Rapier's own number of iterations, and iterations at 60 host steps per
/// second.
const RATES: [u32; 5] = [30, 60, 120, 240, 480];
const ITERATIONS: [usize; 5] = [1, 2, 4, 8, 16];
/// Rapier's default.
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

/// The errors of a run.
#[derive(Default)]
struct Drift {
    error: Option<f64>,
    /// Largest distance in m between an end of the cable and its anchor on the body in Rapier.
    gap: f64,
    /// Largest change of energy over the largest kinetic energy.
    energy: f64,
    /// Change of momentum over that of the heavier ball; of angular momentum over its own.
    momentum: Option<[f64; 2]>,
}

/// Anchors of the ends of the cable: end (0 or 1), body, and point in the body's axes in m.
type Anchors = &'static [(usize, usize, [f64; 3])];
const PAYLOAD_ANCHORS: Anchors = &[(1, 0, [0.0, 0.1, 0.0])];
const DUMBBELL_ANCHORS: Anchors = &[(0, 0, [0.1, 0.0, 0.0]), (1, 1, [-0.1, 0.0, 0.0])];

fn gap(world: &World, anchors: Anchors) -> f64 {
    let cables = world.cables();
    let distance = |&(end, body, anchor): &(usize, usize, [f64; 3])| {
        let (cable, body) = (cables.first()?, world.body(body)?);
        let node = if end == 0 { 0 } else { cable.nodes() - 1 };
        Some((cable.node_position(node) - body.position - body.rotation * Vector3::from(anchor)).norm())
    };
    anchors.iter().filter_map(distance).fold(0.0, f64::max)
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
        drift.gap = drift.gap.max(gap(world, if free { DUMBBELL_ANCHORS } else { PAYLOAD_ANCHORS }));
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

fn row(options: &Options, name: &str, scene: &Scene, fidelity: Fidelity, hz: u32, free: bool) -> Vec<Cell> {
    let iterations = scene.solver_iterations.unwrap_or(DEFAULT);
    let mut row: Vec<Cell> = vec![name.into(), fidelity.name().into(), u64::from(hz).into(), iterations.into()];
    let outcome = || -> Result<Vec<Cell>, Error> {
        let mut world = payload::start(scene)?;
        let drift = run(&mut world, hz, free)?;
        let counts = payload::counts(&world);
        let time = clock::repeat(options.repeats, || {
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

/// Title of the section.
pub const TITLE: &str = "Coupling: error, gap, energy and momentum";

/// Measures the section.
///
/// # Errors
/// [`Error::Scene`], [`Error::Figure`]; not for a run that fails, which is a row.
pub fn section(options: &Options) -> Result<Section, Error> {
    let mut rows = Vec::new();
    let rates: Vec<(u32, usize)> = options.rungs(&RATES).iter().map(|&hz| (hz, DEFAULT)).collect();
    let iterations = options.rungs(&ITERATIONS).iter().filter(|n| **n != DEFAULT).map(|&n| (60, n));
    let cases: Vec<(u32, usize)> = rates.into_iter().chain(iterations).collect();
    let dumbbell = Scene::parse("dumbbell", DUMBBELL, &[], Purpose::Run)?;
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        for &(hz, iterations) in &cases {
            let scenes =
                [("payload", payload::scene(Rule::default(), 10, hz)?, false), ("dumbbell", dumbbell.clone(), true)];
            for (name, mut scene, free) in scenes {
                scene.dt = 1.0 / f64::from(hz);
                scene.solver_iterations = Some(iterations);
                scene.cables[0].integrator = fidelity;
                rows.push(row(options, name, &scene, fidelity, hz, free));
            }
        }
    }
    let columns = vec![
        hidden("scene"),
        hidden("fidelity"),
        hidden("host_steps_per_s"),
        hidden("solver_iterations"),
        hidden("error_m"),
        hidden("gap_m"),
        hidden("energy_drift"),
        hidden("momentum_drift"),
        hidden("angular_momentum_drift"),
        hidden("cpu_median_us"),
        hidden("cpu_least_us"),
        hidden("cpu_most_us"),
        hidden("steps"),
        hidden("newton_iterations"),
        hidden("factorisations"),
        hidden("element_evaluations"),
        hidden("failed"),
    ];
    let mut section = Section::new(TITLE);
    section.text(
        "*Payload*: the crate of 50 kg on its cable (10 elements, projected-3), 1 s; *error* from the independent monolithic code as above. \
         *Dumbbell*: balls of 2 and 6 kg on a cable of 0.72 kg, spinning at 5 rad/s without gravity, 1 s. *Gap* is the largest distance \
         in m between an end of the cable and its anchor on the body after a host step. *Energy* is the largest change of the total over \
         the largest kinetic energy; *spin* is the largest change of the angular momentum over its own value. The host step varies with \
         Rapier's default of 4 solver iterations (the file also has 1 to 16 iterations at 1/60 s); a host step is four Rapier steps, and \
         bodies are in single precision. The cost beside Rapier's own ropes: `docs/coupling.md`.",
    );
    let pick = |row: &[Cell], column: usize| if let Cell::Number(x) = row[column] { Some(x) } else { None };
    let words = |row: &[Cell], column: usize, word: &str| matches!(&row[column], Cell::Text(t) if t == word);
    let mut all = Vec::new();
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
            all.push(Curve { name: format!("{fidelity}: {scene}, {name}"), points });
        }
    }
    let title = "Coupling against the host step".to_string();
    let axes = ["host step [s]".to_string(), "m, or share".to_string()];
    let svg = LogLog { title, axes, curves: all, floor: None }.svg()?;
    section.figure(
        "coupling",
        "Error and gap in m, energy and angular momentum (spin) as shares, against the host step",
        svg,
    );
    section.data(Table { name: "coupling", columns, rows });
    Ok(section)
}
