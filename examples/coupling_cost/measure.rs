//! One way to make the cables of a scene: what it costs, how far it stretches, how far it errs.

use crate::Outcome;
use crate::rig::{self, Make, Rig, Split, host_steps};
use crate::scene::{LENGTH, RATE, Scene};
use cpu_time::ProcessTime;
use lariat::{Diagnostics, Vector3};
use std::time::Instant;

/// Host steps of a run: 2 s.
pub const STEPS: usize = 120;
/// When the centre of the box is read, in s.
pub const READ: [f64; 2] = [0.5, 1.0];
/// A box that is so many times the length of its cable away from where it should be is lost.
const LOST: f64 = 10.0;
const FEWEST_RUNS: usize = 2;
const MOST_RUNS: usize = 25;
/// Time for the runs of one row in s, if the fewest take no longer.
const BUDGET: f64 = 0.5;

/// What came of a run of [`STEPS`].
pub struct Row {
    pub make: Make,
    pub split: Split,
    /// CPU time per host step in us, the mean over a run, the least of several.
    pub micros: f64,
    /// Largest stretch at the host's steps.
    pub stretch: f64,
    /// Stretch at the end.
    pub last: f64,
    /// Centre of the box at [`READ`] in m.
    pub centres: [Vector3<f64>; 2],
    /// Counts of the first cable over the run, if it is Lariat's.
    pub counts: Option<Diagnostics>,
    /// When the box was lost, in s.
    pub lost: Option<f64>,
}

fn settled(scene: &Scene, make: Make, split: Split) -> Outcome<Rig> {
    let mut rig = Rig::new(scene, make, split)?;
    for _ in 0..scene.settling() {
        rig.step()?;
    }
    Ok(rig)
}

/// Runs once to read, then several times for the clock alone.
pub fn row(scene: &Scene, make: Make, split: Split) -> Outcome<Row> {
    let mut rig = settled(scene, make, split)?;
    let mut row = Row {
        make,
        split,
        micros: f64::INFINITY,
        stretch: f64::MIN,
        last: 0.0,
        centres: [Vector3::repeat(f64::NAN); 2],
        counts: None,
        lost: None,
    };
    if let Some((set, cables)) = rig.lariat() {
        set.get_mut(cables[0])?.diagnostics_mut().reset();
    }
    for k in 1..=STEPS {
        rig.step()?;
        let stretch = rig.stretch();
        // f64::max would pass over one that is not a number
        if !(stretch.abs() < LOST && rig.centre().norm() < LOST * LENGTH) {
            row.lost.get_or_insert(k as f64 / RATE as f64);
        }
        if row.lost.is_none() {
            row.stretch = row.stretch.max(stretch);
        }
        row.last = stretch;
        for (centre, t) in row.centres.iter_mut().zip(READ) {
            if k == host_steps(t) {
                *centre = rig.centre();
            }
        }
    }
    if let Some((set, cables)) = rig.lariat() {
        row.counts = Some(*set.get(cables[0])?.diagnostics());
    }
    let begun = Instant::now();
    for run in 0..MOST_RUNS {
        if run >= FEWEST_RUNS && begun.elapsed().as_secs_f64() > BUDGET {
            break;
        }
        let mut rig = settled(scene, make, split)?;
        // CPU time: what else the machine runs counts only where it takes caches and clock rate
        let clock = ProcessTime::now();
        for _ in 0..STEPS {
            rig.step()?;
        }
        row.micros = row.micros.min(clock.elapsed().as_secs_f64() * 1e6 / STEPS as f64);
    }
    Ok(row)
}

/// A cable of the scene without its box, its end free: us per host step.
pub fn alone(scene: &Scene, make: Make) -> Outcome<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..MOST_RUNS {
        let mut cable = rig::cable(scene, make, 0)?;
        let clock = ProcessTime::now();
        for _ in 0..STEPS {
            cable.step(1.0 / RATE as f64)?;
        }
        least = least.min(clock.elapsed().as_secs_f64() * 1e6 / STEPS as f64);
    }
    Ok(least)
}

/// Where the time of a host step goes, in us.
pub struct Shares {
    pub predict: f64,
    pub rapier: f64,
    pub reconcile: f64,
}

/// The three stages of the coupling, `steps` times per host step, each timed by itself (wall time, the least of several runs).
pub fn shares(scene: &Scene, make: Make, split: Split) -> Outcome<Shares> {
    let mut least = [f64::INFINITY; 3];
    for _ in 0..MOST_RUNS {
        let mut rig = Rig::new(scene, make, Split { steps: 1, ..split })?;
        rig.world.integration_parameters.dt /= split.steps as f32;
        let (world, set) = rig.parts().ok_or("not one of Lariat's")?;
        set.settings.max_rapier_steps = 1;
        let mut spent = [0.0; 3];
        for _ in 0..STEPS * split.steps as usize {
            let clock = Instant::now();
            let mut host = set.begin(world)?;
            set.predict_next(world, &mut host)?;
            let predicted = clock.elapsed();
            world.step();
            let stepped = clock.elapsed();
            set.reconcile(world);
            set.finish(world, host);
            let times = [predicted, stepped - predicted, clock.elapsed() - stepped];
            for (spent, time) in spent.iter_mut().zip(times) {
                *spent += time.as_secs_f64() * 1e6 / STEPS as f64;
            }
        }
        for (least, spent) in least.iter_mut().zip(spent) {
            *least = least.min(spent);
        }
    }
    let [predict, rapier, reconcile] = least;
    Ok(Shares { predict, rapier, reconcile })
}
