//! Headless runs: host steps of `dt`, probes at their own times, results in a folder.
//!
//! The host step is split where a probe falls between two host times, so that a sample is a computed state, not an interpolated
//! one. Each sample is written to its file at once: a run that fails, is interrupted or fills the disk leaves every sample so
//! far, a `summary.json` with the reason, and a [`view.html`](crate::view).
//!
//! ```
//! use lariat_scene::{Purpose, Scene, run};
//!
//! let text = r#"
//! duration = 0.1
//! [[cable]]
//! name = "rope"
//! points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
//! section = { square = 0.01 }
//! density = 4000.0
//! youngs_modulus = 1.0e8
//! [[attachment]]
//! cable = "rope"
//! at = "start"
//! body = "world"
//! [[probe]]
//! name = "tip"
//! every = 0.01
//! cable = "rope"
//! at = "end"
//! "#;
//! let scene = Scene::parse("rope.toml", text, &[], Purpose::Run)?;
//! let out = std::env::temp_dir().join("lariat-run-doc");
//! let summary = run::run(&scene, &out, &mut run::Options::default())?;
//! assert!(summary.failed.is_none() && summary.simulated_s == 0.1);
//! assert_eq!(std::fs::read_to_string(out.join("probes/tip.csv")).unwrap().lines().count(), 12);
//! # Ok::<(), lariat_scene::Error>(())
//! ```

mod balance;
mod coarse_tension;
mod error_target;
mod fine;
mod hinges;
mod output;
mod parts;
mod pieces;
mod probe;
mod readings;
mod recording;
pub mod schedule;
mod size;
mod start;
mod state;
mod statics;
mod summary;
mod watch;
mod wheels;
mod world;

pub use crate::physics::{Parts, Script};
pub use error_target::ErrorClaim;
pub use lariat_ancf::warning::EnergyBalance;
pub use pieces::{Parted, Piece};
pub(crate) use probe::columns;
pub use recording::{ProbeRecord, Recording, collect};
pub use state::State;
pub use statics::{BodyPlace, BodyStatics, CableStatics, StaticReaction};
pub use summary::Summary;
pub use world::World;

use crate::error::Error;
use crate::scene::body::BodyKind;
use crate::scene::{Purpose, Scene, Target};
use cpu_time::ProcessTime;
use lariat_ancf::Level;
use lariat_ancf::study::{Record, Resolution, Target as ErrorTarget};
use output::{Extras, Kept, Output};
use schedule::{Schedule, nominal};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use watch::Watch;

/// Options of a run.
#[derive(Default)]
pub struct Options<'a> {
    /// Set it to true from another thread (or a signal handler) to stop after the present host step.
    pub stop: Arc<AtomicBool>,
    /// Called after each host step with the simulated time in s.
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Called with each line of [`Summary::told`], once, as soon as it is known.
    pub warn: Option<&'a mut dyn FnMut(&str)>,
    /// Up to which level warnings are told. Default: of each cable up to
    /// [`Cable::warn_level`](lariat_ancf::Cable::warn_level).
    pub warn_level: Option<Level>,
    /// Error that is asked for, of all positions in m (`Some(1e-3.into())`) or of tensions or moments: the scene is run with several meshes and tolerances, in place of its own `elements` and
    /// `integrator`, until two agree, and the results are those of the finest. See [`lariat_ancf::study`].
    pub error: Option<ErrorTarget>,
    /// Called before each run of a scene that an error is asked of.
    pub pilot: Option<&'a mut dyn FnMut(&Resolution)>,
    /// Whether [`run`] and [`statics`] write `run.svg`, the motion as an animated picture, too.
    pub svg: bool,
    /// Whether [`run`] and [`statics`] write `run.usda`, the motion as OpenUSD, too.
    pub usd: bool,
    /// Where a run begins, in place of what the scene says; not together with `error`. The scene is read with [`Purpose::Resume`].
    pub from: Option<State>,
}

/// Runs a scene for its duration and writes `summary.json`, `probes/*.csv` and [`view.html`](crate::view) to the folder `out`.
///
/// # Errors
/// [`Error::Output`] if the folder cannot be written, [`Error::ErrorTooSmall`] for an error that cannot be proven (both before anything
/// runs); [`Error::Mechanics`], [`Error::Write`] or [`Error::Interrupted`] later: samples, page and summary are then on disk.
pub fn run(scene: &Scene, out: &Path, options: &mut Options<'_>) -> Result<Summary, Error> {
    to_folder(scene, out, Purpose::Run, options)
}

/// Finds the static equilibrium of a scene and writes the same files as [`run`], at t = 0.
///
/// # Errors
/// As [`run`]; [`Error::Mechanics`] if there is no equilibrium.
pub fn statics(scene: &Scene, out: &Path, options: &mut Options<'_>) -> Result<Summary, Error> {
    to_folder(scene, out, Purpose::Static, options)
}

fn to_folder(scene: &Scene, out: &Path, purpose: Purpose, options: &mut Options<'_>) -> Result<Summary, Error> {
    let extras = Extras { svg: options.svg, usd: options.usd, state: purpose == Purpose::Static };
    let open = |scene: &Scene| Output::create(scene, out, extras);
    let Recorded { summary, kept, outcome, .. } = conduct(scene, &open, purpose, options)?;
    outcome.and(kept.map(|_| ())).map(|()| summary)
}

/// Opens what the samples of a run go to.
type Open<'a> = &'a dyn Fn(&Scene) -> Result<Output, Error>;

/// Runs a scene once, or to the error that is asked for.
fn conduct(scene: &Scene, open: Open<'_>, purpose: Purpose, options: &mut Options<'_>) -> Result<Recorded, Error> {
    size::check(scene, purpose)?;
    match options.error {
        Some(_) if options.from.is_some() => {
            let problem = "an error that is asked for changes the mesh, and the state has one".to_string();
            Err(Error::State { problem })
        }
        Some(target) => error_target::conduct(scene, open, purpose, target, options),
        None => Ok(simulate(scene, open, purpose, options, None)?.finish(None)),
    }
}

/// A run that has ended, or failed, with its samples; the summary is still to be written.
struct Done {
    world: World,
    output: Output,
    cpu: Duration,
    wall: Duration,
    balance: Option<EnergyBalance>,
    outcome: Result<(), Error>,
}

impl Done {
    /// Writes the summary and the page.
    fn finish(self, claim: Option<ErrorClaim>) -> Recorded {
        let Done { mut world, output, cpu, wall, balance, outcome } = self;
        let told = world.told();
        let summary = Summary::of(&world, cpu, wall, outcome.as_ref().err());
        let summary = Summary { error: claim, energy_balance: balance, told, ..summary };
        let kept = output.finish(&summary, &world);
        Recorded { world, summary, kept, outcome }
    }
}

/// What takes the positions of a run, and of how many host times it takes one; the last one, too.
type Recorder<'a> = Option<(&'a mut Record, u32)>;

/// Advances a world to the end of its scene.
fn advance(
    scene: &Scene,
    world: &mut World,
    output: &mut Output,
    watch: &mut Watch,
    options: &mut Options<'_>,
    mut record: Recorder<'_>,
) -> Result<(), Error> {
    let parts = record.as_ref().map_or(1, |(_, parts)| u64::from(*parts));
    let mut host_times = 0;
    let mut schedule = Schedule::new(scene);
    // a copy that is stepped to the probe times between two host steps, so that probes change nothing
    let mut ahead: Option<World> = None;
    while let Some(event) = schedule.next_event() {
        let read = if event.host {
            ahead = None;
            &mut *world
        } else {
            ahead.get_or_insert_with(|| world.unbreakable())
        };
        read.advance(event.time)?;
        for (probe, sample) in event.probes {
            let every = scene.probes[probe].every.unwrap_or(scene.dt);
            output.sample(probe, nominal(sample, every).min(scene.duration), read)?;
        }
        if event.host {
            watch.note(world)?;
            if host_times % parts == 0 || event.time >= scene.duration {
                output.frame(world)?;
                note(&mut record, world);
            }
            host_times += 1;
        }
        if let Some(progress) = options.progress.as_mut().filter(|_| event.host) {
            progress(event.time);
        }
        if options.stop.load(Ordering::Relaxed) && event.time < scene.duration {
            return Err(Error::Interrupted { time: event.time });
        }
    }
    Ok(())
}

/// A run that ended, as it should or not.
struct Recorded {
    world: World,
    summary: Summary,
    kept: Result<Kept, Error>,
    outcome: Result<(), Error>,
}

/// Runs a scene, and keeps its samples; `record` takes positions at host times.
///
/// # Errors
/// What hinders it before it begins; later errors are in [`Done`].
fn simulate(
    scene: &Scene,
    open: Open<'_>,
    purpose: Purpose,
    options: &mut Options<'_>,
    mut record: Recorder<'_>,
) -> Result<Done, Error> {
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    let mut world = World::build(scene)?;
    // a scene that cannot be built leaves nothing in the folder
    let mut output = open(&world.scene)?;
    let mut watch = Watch::new(&world, purpose);
    world.warn_level = options.warn_level;
    let mut told: Vec<String> = Vec::new();
    let mut tell = |world: &mut World, options: &mut Options<'_>| {
        // the runs of a study have the same warnings, and the last one's are told at its end
        if let (Some(warn), None) = (&mut options.warn, options.error) {
            for line in world.told() {
                if !told.contains(&line) {
                    warn(&line);
                    told.push(line);
                }
            }
        }
    };
    let started = match options.from.as_ref().filter(|_| purpose != Purpose::Static) {
        Some(state) => world.resume(state),
        None => world.start(purpose),
    };
    let outcome = started.and_then(|()| {
        world.note_start();
        if options.error.is_none() && (purpose == Purpose::Static || scene.equilibrium && options.from.is_none()) {
            let off = coarse_tension::warnings(&world, purpose);
            world.warnings.extend(off);
        }
        if purpose != Purpose::Static {
            watch = Watch::new(&world, purpose);
        }
        watch.note(&world)?;
        tell(&mut world, options);
        if purpose != Purpose::Static {
            return advance(scene, &mut world, &mut output, &mut watch, options, record.take());
        }
        (0..scene.probes.len()).try_for_each(|probe| output.sample(probe, 0.0, &mut world))?;
        note(&mut record, &world);
        output.frame(&world)
    });
    let noted = watch.warnings(&world, options.error.and_then(|target| target.of_positions()));
    world.warnings.extend(noted);
    tell(&mut world, options);
    let (cpu, wall, spent) = (cpu.elapsed(), wall.elapsed(), output.spent());
    let (cpu, wall) = (cpu.saturating_sub(spent.0), wall.saturating_sub(spent.1));
    let balance = (purpose != Purpose::Static).then(|| watch.balance());
    Ok(Done { world, output, cpu, wall, balance, outcome })
}

/// Records the cables, the points that probes read, and the dynamic bodies.
fn note(record: &mut Recorder<'_>, world: &World) {
    let Some((record, _)) = record else { return };
    record.frame(world.time());
    let cables = world.cables();
    for cable in &cables {
        record.cable(cable);
    }
    for probe in &world.scene.probes {
        if let Target::Point { cable, arc_length } = probe.target
            && let (part, s) = world.part(cable, arc_length)
            && let Ok(sample) = cables[part].sample(s)
        {
            record.point(sample.position).sample(part, &sample);
        }
    }
    for (index, body) in world.scene.bodies.iter().enumerate() {
        if let Some(state) = world.body(index).filter(|_| body.kind == BodyKind::Dynamic) {
            record.point(state.position);
        }
    }
}
