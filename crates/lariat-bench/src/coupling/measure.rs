//! One model of the cables in a scene: its cost, its stretch and its error.

use super::model::{CableModel, Split};
use super::scene::{LENGTH, RATE, Scene};
use super::world::{self, World, host_steps};
use crate::clock::{Repeats, repeat};
use crate::error::Error;
use cpu_time::ProcessTime;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Diagnostics, Vector3};
use std::time::Instant;

/// Host steps of a run: 2 s.
pub const STEPS: usize = 120;
/// Times in s at which the centre of the box is read.
pub const READ: [f64; 2] = [0.5, 1.0];
/// A box, or a stretch, this many times the length of its cable away from where it should be has
/// flown apart.
const FLOWN_APART: f64 = 10.0;
/// How often a run is repeated for its time.
const REPEATS: Repeats = Repeats { least: 2, most: 25, enough: 0.5, limit: f64::INFINITY };

/// A run of [`STEPS`].
pub struct Row {
    pub model: CableModel,
    pub split: Split,
    /// CPU time per host step in us: the mean over a run, the smallest of several.
    pub micros: f64,
    /// Largest stretch after a host step.
    pub stretch: f64,
    /// Stretch at the end.
    pub last: f64,
    /// Centre of the box at [`READ`] in m.
    pub centres: [Vector3<f64>; 2],
    /// Counts of the first cable over the run, if it is Lariat's.
    pub counts: Option<Diagnostics>,
    /// When it flew apart, in s.
    pub flew_apart: Option<f64>,
}

fn settled(scene: &Scene, model: CableModel, split: Split) -> Result<World, Error> {
    let mut world = World::new(scene, model, split)?;
    for _ in 0..scene.settling() {
        world.step()?;
    }
    Ok(world)
}

/// Runs once to measure, then several times for the time alone.
pub fn row(scene: &Scene, model: CableModel, split: Split) -> Result<Row, Error> {
    let mut world = settled(scene, model, split)?;
    if let Some(cable) = world.first_cable() {
        cable.diagnostics_mut().reset();
    }
    let centres = [Vector3::repeat(f64::NAN); 2];
    let mut row =
        Row { model, split, micros: 0.0, stretch: f64::MIN, last: 0.0, centres, counts: None, flew_apart: None };
    for k in 1..=STEPS {
        world.step()?;
        let stretch = world.stretch();
        // written so that NaN has flown apart
        if !(stretch.abs() < FLOWN_APART && world.centre().norm() < FLOWN_APART * LENGTH) {
            row.flew_apart.get_or_insert(k as f64 / RATE as f64);
        }
        if row.flew_apart.is_none() {
            row.stretch = row.stretch.max(stretch);
        }
        row.last = stretch;
        for (centre, t) in row.centres.iter_mut().zip(READ) {
            if k == host_steps(t) {
                *centre = world.centre();
            }
        }
    }
    row.counts = world.first_cable().map(|cable| *cable.diagnostics());
    let time = repeat(REPEATS, || {
        let mut world = settled(scene, model, split)?;
        let clock = ProcessTime::now();
        for _ in 0..STEPS {
            world.step()?;
        }
        Ok::<f64, Error>(clock.elapsed().as_secs_f64() * 1e6 / STEPS as f64)
    })?;
    row.micros = time.map_or(f64::NAN, |t| t.least);
    Ok(row)
}

/// Returns the time of a cable of the scene without its box, its end free, in us per host step.
pub fn alone(scene: &Scene, model: CableModel) -> Result<f64, Error> {
    let time = repeat(REPEATS, || {
        let mut cable = world::cable(scene, model, 0)?;
        let clock = ProcessTime::now();
        for _ in 0..STEPS {
            cable.step(1.0 / RATE as f64)?;
        }
        Ok::<f64, Error>(clock.elapsed().as_secs_f64() * 1e6 / STEPS as f64)
    })?;
    Ok(time.map_or(f64::NAN, |t| t.least))
}

/// Returns the wall times of prediction, Rapier and reconciliation in us per host step, each the
/// smallest of several runs.
pub fn stages(scene: &Scene, model: CableModel, split: Split) -> Result<[f64; 3], Error> {
    let mut least = [f64::INFINITY; 3];
    for _ in 0..REPEATS.most {
        let mut scene = World::new(scene, model, Split { steps: 1, ..split })?;
        scene.physics.integration_parameters.dt /= split.steps as f32;
        let Some((physics, set)) = scene.parts() else { return Ok([f64::NAN; 3]) };
        let mut spent = [0.0; 3];
        for _ in 0..STEPS * split.steps as usize {
            let mut host = set.begin(physics)?;
            while host.is_unfinished() {
                let clock = Instant::now();
                set.predict_next(physics, &mut host)?;
                let predicted = clock.elapsed();
                physics.step();
                let stepped = clock.elapsed();
                set.reconcile(physics);
                let times = [predicted, stepped - predicted, clock.elapsed() - stepped];
                for (spent, time) in spent.iter_mut().zip(times) {
                    *spent += time.as_secs_f64() * 1e6 / STEPS as f64;
                }
            }
            set.finish(physics, host)?;
        }
        for (least, spent) in least.iter_mut().zip(spent) {
            *least = least.min(spent);
        }
    }
    Ok(least)
}
