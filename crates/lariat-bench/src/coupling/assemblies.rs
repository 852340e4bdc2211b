//! Assemblies: a rope bridge on which a box falls, and cables on a pile of boxes.

use super::scene::RATE;
use crate::error::Error;
use crate::single::convert::from_rapier;
use crate::table::{Format, Table, shown};
use cpu_time::ProcessTime;
use lariat_ancf::coupling::Coupling;
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Diagnostics, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use std::time::Instant;

/// Boxes of the pile.
const BOXES: usize = 500;
/// Host steps of a run.
const STEPS: usize = 420;
/// Numbers of threads, as far as the machine has them.
const THREADS: [usize; 5] = [1, 2, 4, 8, 16];
/// How often a run of the pile is repeated; the smallest time counts.
const REPEATS: usize = 3;

/// A world with its cables.
struct Assembly {
    physics: PhysicsWorld,
    set: CableSet,
    cables: Vec<CableHandle>,
}

/// Times of host steps in us.
struct Times {
    /// CPU time, of all threads.
    mean: f64,
    worst: f64,
    /// Mean wall time.
    wall: f64,
    /// Counts per host step, of all cables.
    counts: Diagnostics,
}

/// What steps an assembly.
#[derive(Clone, Copy, PartialEq)]
enum Stepping {
    /// Rapier alone.
    Alone,
    /// Rapier alone, after the host took a body to change it.
    Changed,
    WithSet,
}

impl Assembly {
    /// Runs host steps, and returns their times.
    fn run(&mut self, steps: usize, stepping: Stepping) -> Result<Times, Error> {
        let mut times = Times { mean: 0.0, worst: 0.0, wall: 0.0, counts: Diagnostics::default() };
        for &cable in &self.cables {
            self.set.get_mut(cable)?.diagnostics_mut().reset();
        }
        for _ in 0..steps {
            let (clock, wall) = (ProcessTime::now(), Instant::now());
            match stepping {
                Stepping::Alone => self.physics.step(),
                Stepping::Changed => {
                    let last = self.physics.bodies.iter().last().map(|(handle, _)| handle);
                    let last = last.and_then(|handle| self.physics.bodies.get_mut(handle));
                    last.into_iter().for_each(|body| body.wake_up(true));
                    self.physics.step();
                }
                Stepping::WithSet => self.set.step(&mut self.physics)?,
            }
            times.wall += wall.elapsed().as_secs_f64() * 1e6 / steps as f64;
            let micros = clock.elapsed().as_secs_f64() * 1e6;
            times.mean += micros / steps as f64;
            times.worst = times.worst.max(micros);
        }
        for &cable in &self.cables {
            times.counts += *self.set.get(cable)?.diagnostics();
        }
        Ok(times)
    }
}

/// Two ropes of 10.3 m over 10 m with ten planks of 15 kg, each on two hooks per rope if `hooks`
/// is 2; a box of 60 kg falls on it from 2 m.
fn bridge(hooks: usize) -> Result<Assembly, Error> {
    let (mut physics, mut set) = (PhysicsWorld::new(), CableSet::new());
    let mut ropes = Vec::new();
    for z in [-0.6, 0.6] {
        let mut rope = Cable::builder()
            .points([Vector3::new(0.0, 5.0, z), Vector3::new(10.0, 5.0, z)])
            .length(10.3)
            .elements(20)
            .section(Section::from_stiffness(5e5, 0.2, 0.4)?)
            .damping(Damping { axial: 0.01, bending: 0.01 })
            .fix(At::Start)
            .fix(At::End)
            .build()?;
        rope.equilibrium()?;
        ropes.push(set.insert(rope));
    }
    for i in 0..10 {
        let s = 1.03 * (f64::from(i) + 0.5);
        let at = set.get(ropes[0])?.sample(s)?.position;
        let plank = RigidBodyBuilder::dynamic().translation(Vector::new(at.x as Real, at.y as Real, 0.0));
        let (plank, _) = physics.insert(plank, ColliderBuilder::cuboid(0.4, 0.03, 0.6).mass(15.0));
        for &rope in &ropes {
            for s in if hooks == 2 { vec![s - 0.3, s + 0.3] } else { vec![s] } {
                set.attach_here(&physics, rope, s, plank, AttachmentKind::Ball)?;
            }
        }
    }
    let load = RigidBodyBuilder::dynamic().translation(Vector::new(5.0, 7.0, 0.0));
    physics.insert(load, ColliderBuilder::cuboid(0.3, 0.3, 0.3).mass(60.0));
    Ok(Assembly { physics, set, cables: ropes })
}

/// A pile of boxes on a floor that has settled, with cables of 2 m on some of them.
fn pile(cables: usize) -> Result<Assembly, Error> {
    let (mut physics, mut set) = (PhysicsWorld::new(), CableSet::new());
    physics.insert_collider(ColliderBuilder::cuboid(20.0, 0.5, 20.0).translation(Vector::new(0.0, -0.5, 0.0)), None);
    let boxes: Vec<RigidBodyHandle> = (0..BOXES)
        .map(|k| {
            let (layer, i, j) = (k / 50, k % 10, k / 10 % 5);
            let shift = 0.03 * (layer % 3) as Real;
            let at = Vector::new(0.45 * i as Real + shift, 0.2 + 0.41 * layer as Real, 0.45 * j as Real - shift);
            let body = RigidBodyBuilder::dynamic().translation(at).can_sleep(false);
            physics.insert(body, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(10.0)).0
        })
        .collect();
    for _ in 0..120 {
        physics.step();
    }
    let mut handles = Vec::new();
    for k in 0..cables {
        let load = boxes[BOXES - 1 - k];
        let top = from_rapier(*physics.bodies[load].position() * Vector::new(0.0, 0.2, 0.0));
        let cable = Cable::builder()
            .points([top + Vector3::new(0.0, 1.9, 0.0), top])
            .length(2.0)
            .elements(10)
            .section(Section::from_stiffness(1e5, 0.1, 0.4)?)
            .damping(Damping { axial: 1e-3, bending: 1e-2 })
            .fix(At::Start);
        let cable = set.insert(cable.build()?);
        set.attach(&physics, cable, At::End, load, Vector::new(0.0, 0.2, 0.0), AttachmentKind::Ball)?;
        handles.push(cable);
    }
    Ok(Assembly { physics, set, cables: handles })
}

fn columns() -> Vec<crate::table::Column> {
    vec![
        shown("assembly", "assembly", Format::Plain),
        shown("mean_us", "mean us", Format::Short),
        shown("worst_us", "worst us", Format::Short),
        shown("ratio", "times Rapier alone", Format::Fixed(2)),
        shown("wall_us", "wall us", Format::Short),
        shown("wall_ratio", "wall, times Rapier alone", Format::Fixed(2)),
        shown("newton_iterations", "Newton iterations", Format::Fixed(1)),
        shown("steps", "steps", Format::Fixed(1)),
    ]
}

/// Returns the table of the assemblies; `progress` is called with a line for each.
///
/// # Errors
/// [`Error::Mechanics`], [`Error::Coupling`] if a run fails.
pub fn table(progress: &mut dyn FnMut(&str)) -> Result<Table, Error> {
    let mut rows = Vec::new();
    let mut row = |name: String, times: &Times, steps: usize, alone: Option<&Times>| {
        progress(&format!("{name}: mean {:.0} us, worst {:.0} us", times.mean, times.worst));
        let per_step = |count: u64| count as f64 / steps as f64;
        rows.push(vec![
            name.into(),
            times.mean.into(),
            times.worst.into(),
            alone.map(|alone| times.mean / alone.mean).into(),
            times.wall.into(),
            alone.map(|alone| times.wall / alone.wall).into(),
            per_step(times.counts.newton_iterations).into(),
            per_step(times.counts.steps).into(),
        ]);
    };
    for hooks in [1, 2] {
        let mut assembly = bridge(hooks)?;
        // the box falls for 0.6 s
        let fall = RATE * 3 / 5;
        row(
            format!("bridge, {} pins, the box in the air", 20 * hooks),
            &assembly.run(fall, Stepping::WithSet)?,
            fall,
            None,
        );
        row(
            format!("bridge, {} pins, the box on it", 20 * hooks),
            &assembly.run(STEPS - fall, Stepping::WithSet)?,
            STEPS - fall,
            None,
        );
    }
    let best = |cables: usize, stepping: Stepping| -> Result<Times, Error> {
        let mut best: Option<Times> = None;
        for _ in 0..REPEATS {
            let times = pile(cables)?.run(STEPS / 2, stepping)?;
            if best.as_ref().is_none_or(|best| times.mean < best.mean) {
                best = Some(times);
            }
        }
        best.ok_or_else(|| unreachable!("at least one run"))
    };
    let alone = best(0, Stepping::Alone)?;
    row(format!("{BOXES} boxes, Rapier alone"), &alone, STEPS / 2, Some(&alone));
    let changed = best(0, Stepping::Changed)?;
    row(format!("{BOXES} boxes, Rapier alone, one box changed by the host"), &changed, STEPS / 2, Some(&alone));
    for cables in [0, 1, 10, 50] {
        let times = best(cables, Stepping::WithSet)?;
        row(format!("{BOXES} boxes, {cables} cables"), &times, STEPS / 2, Some(&alone));
    }
    let most = std::thread::available_parallelism().map_or(1, usize::from);
    for (cables, threads) in [10, 50].into_iter().flat_map(|cables| THREADS.map(|threads| (cables, threads))) {
        if threads > most {
            continue;
        }
        let pool =
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| Error::Threads(e.to_string()))?;
        let times = pool.install(|| best(cables, Stepping::WithSet))?;
        let name = format!("{BOXES} boxes, {cables} cables, {threads} thread{}", if threads == 1 { "" } else { "s" });
        row(name, &times, STEPS / 2, Some(&alone));
    }
    Ok(Table { name: "coupling_assemblies", columns: columns(), rows })
}
