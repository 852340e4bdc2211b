//! Thrown cables in fidelity game: the energy law, its cost beside calm motion, and a constant cost over a minute.
//!
//! # Scenes
//!
//! A cable of random shape, stiffness (EA 1e3 to 1e7 N, EI 1e-6 to 10 N m^2 or none), mass, mesh and hold is thrown at up to 5 m/s and 10 rad/s,
//! slack or stretched by up to 5 %; after 0.15 s of 0.6 s gravity is flipped, an end is kicked by up to 10 m/s, or released. The same cable
//! at rest from its equilibrium is *calm*; one that nothing holds falls.
//!
//! *Law broken* is the growth of H = E + S beyond the work of loads in a host step, read from the cable's energies, as a share of the run's
//! largest kinetic and strain energy with the weight times 1 mm. Of calm cables it would be the rounding error of reading an energy. Seeds are fresh: no choice of the method was made on them.

use super::options::Options;
use crate::error::Error;
use crate::page::Section;
use crate::stability::recipe::Recipe;
use crate::table::{Format, Table, shown};
use cpu_time::ProcessTime;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Diagnostics, Fidelity, Integrator, Rule, Section as CableSection, Vector3};
use lariat_figures::reference_pendulum as pendulum;

/// Seeds of the thrown cables.
const SEEDS: core::ops::Range<u64> = 700_000..701_000;
/// Length of a host step in s.
const HOST_STEP: f64 = 1.0 / 60.0;
/// Host steps of a run.
const STEPS: usize = 36;
/// Host step before which a cable is disturbed.
const DISTURBED: usize = 9;
/// Seconds of the pendulum.
const MINUTE: usize = 60;

/// Title of the section.
pub const TITLE: &str = "Thrown cables, and a minute of motion";

/// What the runs of one kind did.
#[derive(Debug, Default)]
pub struct Tally {
    /// Number of cables.
    pub scenes: usize,
    /// Number of cables of which a step was refused.
    pub refused: usize,
    /// Most by which the law was broken in a host step, as a share; of thrown cables.
    pub broken: Option<f64>,
    /// CPU time of the slowest host step in s.
    pub slowest: f64,
    /// Largest number of Newton iterations in a host step.
    pub most: u64,
    /// Counts of all.
    pub counts: Diagnostics,
}

/// Builds the cable of a seed in fidelity game, thrown or calm.
fn cable(recipe: &Recipe, thrown: bool) -> Result<Cable, Error> {
    let vector = |i: usize| Vector3::new(recipe.signed(i), recipe.signed(i + 1), recipe.signed(i + 2));
    let mut points = vec![Vector3::zeros()];
    for corner in 0..=recipe.choose(4, 2) {
        let angle = core::f64::consts::PI * recipe.signed(5 + corner);
        points.push(points[corner] + Vector3::new(angle.cos(), 0.4 * angle.sin(), 0.5 * angle.sin()) * 0.8);
    }
    let drawn: f64 = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    let bending = if recipe.choose(8, 4) == 0 { 0.0 } else { recipe.power(9, -6.0, 1.0) };
    let section = CableSection::from_stiffness(recipe.power(10, 3.0, 7.0), bending, recipe.power(11, -2.0, 0.5))?;
    let mut builder = Cable::builder()
        .points(points)
        .section(section)
        .length(drawn * (0.95 + 0.4 * recipe.0[12]))
        .elements(2 + recipe.choose(13, 11));
    let hold = recipe.choose(14, 4);
    builder = match hold {
        0 => builder,
        1 => builder.fix(At::Start),
        2 => builder.fix(At::Start).fix(At::End),
        _ => builder.clamp(At::Start),
    };
    if thrown {
        builder = builder.velocity(vector(15) * 5.0).angular_velocity(vector(18) * 10.0);
    }
    let mut cable = builder.build()?;
    cable.set_integrator(cable.integrator_for(Fidelity::Game))?;
    if !thrown && hold > 0 {
        // a cable without a unique equilibrium swings gently from where it is drawn
        let _ = cable.equilibrium();
        cable.diagnostics_mut().reset();
    }
    Ok(cable)
}

/// Disturbs a thrown cable.
fn disturb(cable: &mut Cable, recipe: &Recipe) -> Result<(), Error> {
    match recipe.choose(21, 4) {
        0 => cable.set_gravity(-cable.gravity())?,
        1 => {
            let (q, mut v) = (cable.positions().to_vec(), cable.velocities().to_vec());
            let end = v.len() - 6;
            (0..3).for_each(|x| v[end + x] += 10.0 * recipe.signed(22 + x));
            cable.set_coordinates(&q, &v)?;
        }
        2 => cable.release(At::Start)?,
        _ => {}
    }
    Ok(())
}

/// Returns H, and the energy it is compared with.
fn energies(cable: &Cable) -> [f64; 2] {
    let energy = cable.energy();
    let mass: f64 = cable.elements().iter().map(|e| e.length * e.section.mass_per_length).sum();
    let weight = mass * cable.gravity().norm() * 1e-3;
    [energy.total() + cable.energy_in_store(), energy.kinetic + energy.axial + energy.bending + weight]
}

/// Runs the cables of `seeds`.
///
/// # Errors
/// [`Error::Mechanics`] if a cable cannot be built or disturbed.
pub fn run(seeds: core::ops::Range<u64>, thrown: bool) -> Result<Tally, Error> {
    let mut tally = Tally::default();
    for seed in seeds {
        let recipe = Recipe::from_seed(seed);
        let mut cable = cable(&recipe, thrown)?;
        tally.scenes += 1;
        let (mut largest, mut broken) = (0.0f64, 0.0f64);
        for step in 0..STEPS {
            if thrown && step == DISTURBED {
                disturb(&mut cable, &recipe)?;
            }
            let ([before, scale], counts) = (energies(&cable), *cable.diagnostics());
            largest = largest.max(scale);
            let clock = ProcessTime::now();
            if cable.step(HOST_STEP).is_err() {
                tally.refused += 1;
                break;
            }
            tally.slowest = tally.slowest.max(clock.elapsed().as_secs_f64());
            let [after, scale] = energies(&cable);
            largest = largest.max(scale);
            // a step after a change by the host puts supports in place
            if step != 0 && !(thrown && step == DISTURBED) {
                broken = broken.max(after - before);
            }
            tally.most = tally.most.max(cable.diagnostics().since(&counts).newton_iterations);
        }
        if thrown {
            tally.broken = Some(tally.broken.unwrap_or(0.0).max(broken / largest));
        }
        tally.counts += *cable.diagnostics();
    }
    Ok(tally)
}

/// Returns the Newton iterations per step of the paper's pendulum in each second of a minute, in fidelity game.
///
/// # Errors
/// [`Error::Mechanics`] if a step fails.
pub fn minute(elements: usize) -> Result<Vec<f64>, Error> {
    let mut cable = pendulum::cable(Rule::default(), elements, Integrator::default())?;
    cable.set_integrator(cable.integrator_for(Fidelity::Game))?;
    let mut seconds = Vec::new();
    for _ in 0..MINUTE {
        let before = *cable.diagnostics();
        (0..60).try_for_each(|_| cable.step(HOST_STEP).map(drop))?;
        let done = cable.diagnostics().since(&before);
        seconds.push(done.newton_iterations as f64 / done.steps as f64);
    }
    Ok(seconds)
}

/// Measures the section.
///
/// # Errors
/// As [`run`] and [`minute`].
pub fn section(options: &Options) -> Result<Section, Error> {
    let columns = vec![
        shown("cables", "cables", Format::Plain),
        shown("runs", "runs", Format::Plain),
        shown("refused", "refused", Format::Plain),
        shown("law_broken", "law broken", Format::Short),
        shown("iterations", "iterations per step", Format::Fixed(2)),
        shown("factorisations", "factorisations per step", Format::Fixed(2)),
        shown("ratio", "factorisations, times calm", Format::Fixed(2)),
        shown("most_iterations", "most iterations in a host step", Format::Plain),
        shown("slowest_ms", "slowest host step ms", Format::Fixed(2)),
    ];
    let mut table = Table { name: "thrown", columns, rows: Vec::new() };
    let count = if options.rungs == usize::MAX { SEEDS.end - SEEDS.start } else { 50 };
    let mut calm_solves = None;
    for (name, thrown) in [("calm", false), ("thrown", true)] {
        let tally = run(SEEDS.start..SEEDS.start + count, thrown)?;
        let per_step = |n: u64| n as f64 / tally.counts.steps as f64;
        let solves = per_step(tally.counts.factorisations);
        let calm = *calm_solves.get_or_insert(solves);
        table.rows.push(vec![
            name.into(),
            tally.scenes.into(),
            tally.refused.into(),
            tally.broken.into(),
            per_step(tally.counts.newton_iterations).into(),
            solves.into(),
            (solves / calm).into(),
            (tally.most as usize).into(),
            (1e3 * tally.slowest).into(),
        ]);
    }
    let seconds = minute(20)?;
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (first, last) = (mean(&seconds[..10]), mean(&seconds[MINUTE - 10..]));
    let most = seconds.iter().copied().fold(0.0, f64::max);
    let mut section = Section::new(TITLE);
    section.text(format!(
        "Random cables in fidelity game, 0.6 s by host steps of 1/60 s: any stiffness from 1e3 to 1e7 N, slack or stretched, thrown at up to 5 m/s \
         and 10 rad/s and disturbed on the way, and the same cables calm. *Law broken* is the most that a host step made beyond the work on the \
         cable, as a share of the run's kinetic and strain energy. The paper's undamped pendulum of 20 elements takes {first:.2} iterations per \
         step in the first ten of 60 s, {last:.2} in the last ten, {most:.2} in the dearest second."
    ));
    section.table(table);
    Ok(section)
}
