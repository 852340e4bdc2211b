//! Hard cases: where others blow up, a cable keeps its answer, or refuses with an error that says why.
//!
//! | module | what it holds |
//! |---|---|
//! | `stage` | a world with cables made in one way: Lariat's, or what Rapier offers |
//! | `cases` | the cases, one file per family |
//! | [`host`] | how a case is run |
//! | [`outcome`] | what came of it |
//! | [`recipe`] | random scenes |
//! | [`report`] | the table |
//!
//! `stage` and `cases` are compiled twice, over rapier3d and rapier3d-f64 (`single`, `double`). The tests of the facade and
//! `lariat stability` run the same cases.

mod double;
pub mod host;
pub mod outcome;
pub mod recipe;
pub mod report;
mod single;

use host::{Host, Make, Precision};
use outcome::Row;
use rayon::prelude::*;
use recipe::Recipe;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Families of hard cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Loads from a hundredth to a hundred thousand times their cable.
    MassRatio,
    /// Soft and stiff, thick and thin, few and many elements.
    Stiffness,
    /// Slack ropes that become taut.
    Snatch,
    /// Whips and spins.
    Whip,
    /// Ends pushed together, rods that buckle, folds.
    Compression,
    /// Nodes that coincide, slopes of zero, elements inside out.
    Collapse,
    /// No bending, no tension, no gravity; then all at once.
    Limp,
    /// Wedged bodies and sudden release.
    Jam,
    /// What users do to a running world.
    Changes,
    /// An hour, ten minutes, sleep.
    Long,
    /// Far from the origin, tiny and huge.
    Scale,
    /// Many cables, many bodies, loops.
    Many,
    /// Joints, motors, limits, CCD, locked axes, kinematic bodies.
    Mechanisms,
    /// Drawn by chance from all of the above.
    Random,
}

impl Family {
    /// All of them.
    pub const ALL: [Family; 14] = [
        Family::MassRatio,
        Family::Stiffness,
        Family::Snatch,
        Family::Whip,
        Family::Compression,
        Family::Collapse,
        Family::Limp,
        Family::Jam,
        Family::Changes,
        Family::Long,
        Family::Scale,
        Family::Many,
        Family::Mechanisms,
        Family::Random,
    ];

    /// Name in tables and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Family::MassRatio => "mass-ratio",
            Family::Stiffness => "stiffness",
            Family::Snatch => "snatch",
            Family::Whip => "whip",
            Family::Compression => "compression",
            Family::Collapse => "collapse",
            Family::Limp => "limp",
            Family::Jam => "jam",
            Family::Changes => "changes",
            Family::Long => "long",
            Family::Scale => "scale",
            Family::Many => "many",
            Family::Mechanisms => "mechanisms",
            Family::Random => "random",
        }
    }
}

impl std::str::FromStr for Family {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Family::ALL.map(Family::name).join(", ");
        Family::ALL.into_iter().find(|f| f.name() == text).ok_or_else(|| format!("{text:?}; accepted: {}", names()))
    }
}

/// A run to be done: a case, by its place in its family, a host, and what makes the cables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// The family.
    pub family: Family,
    /// Place of the case in it.
    pub case: usize,
    /// How it is run.
    pub host: Host,
    /// What makes the cables.
    pub make: Make,
}

/// Random scenes that every change must pass.
const QUICK_SCENES: usize = 300;

/// Names of the cases of a family, by their place.
pub fn names(family: Family) -> Vec<String> {
    single::cases::of(family).into_iter().map(|case| case.name).collect()
}

/// Every run of a family: all hosts, those with effects, and the rivals (single precision, 4 iterations).
pub fn jobs(family: Family) -> Vec<Job> {
    let cases = single::cases::of(family);
    let mut jobs = Vec::new();
    for (index, case) in cases.iter().enumerate() {
        for host in hosts(family, index) {
            let usual = host.iterations == 4 && host.precision == Precision::Single;
            let makes = [Make::Lariat].into_iter().chain(Make::RIVALS.into_iter().filter(|_| usual));
            let makes = makes.filter(|make| case.applies(&host, *make));
            jobs.extend(makes.map(|make| Job { family, case: index, host, make }));
        }
    }
    jobs
}

/// The hosts that a case may be asked on; a random scene brings its own.
fn hosts(family: Family, index: usize) -> Vec<Host> {
    match family {
        Family::Random => vec![Recipe::from_seed(index as u64).host()],
        _ => Host::all().into_iter().chain(Host::with_effects()).collect(),
    }
}

/// Does the run of a random scene.
pub fn run_recipe(recipe: Recipe) -> Row {
    let (name, host) = (format!("{recipe:?}"), recipe.host());
    match host.precision {
        Precision::Single => single::stage::play(&single::cases::random_scene(name, recipe), host, Make::Lariat),
        Precision::Double => double::stage::play(&double::cases::random_scene(name, recipe), host, Make::Lariat),
    }
}

/// The runs that every change must pass: each case on one of its hosts, another for each, so that a family meets many of them, and the
/// first case of each family with effects.
pub fn quick_jobs(family: Family) -> Vec<Job> {
    let all: Vec<Job> = jobs(family).into_iter().filter(|j| j.make == Make::Lariat).collect();
    let cases = all.iter().map(|j| j.case).max().map_or(0, |last| last + 1);
    let mut chosen = Vec::new();
    if family == Family::Random {
        return all.into_iter().take(QUICK_SCENES).collect();
    }
    for case in 0..cases {
        // 1/1000 s costs most, and is the easiest step: the full run has it
        let mine = |effects: bool| {
            let of = all.iter().filter(move |j| j.case == case && j.host.effects == effects);
            let coarse: Vec<&Job> = of.clone().filter(|j| j.host.rate < 1000).collect();
            if coarse.is_empty() { of.collect() } else { coarse }
        };
        let plain = mine(false);
        if !plain.is_empty() {
            chosen.push(*plain[(7 * case + 3 * family as usize) % plain.len()]);
        }
        let effects = mine(true);
        if case == 0 && !effects.is_empty() {
            chosen.push(*effects[family as usize % effects.len()]);
        }
    }
    chosen
}

/// Does a run.
pub fn run(job: Job) -> Row {
    match job.host.precision {
        Precision::Single => single::play(job),
        Precision::Double => double::play(job),
    }
}

/// Does runs side by side, those of `first` first, the others scattered, so that what is not begun within `limit` is missing evenly;
/// `done` hears of each. What was run comes back in the order of `jobs`.
pub fn run_all(jobs: &[Job], first: &[Job], limit: Duration, done: &(dyn Fn(&Row) + Sync)) -> Vec<Row> {
    let begun = Instant::now();
    // Knuth's multiplicative hash scatters them
    let rank = |i: usize| (!first.contains(&jobs[i]), (i as u32).wrapping_mul(2_654_435_761));
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_cached_key(|i| rank(*i));
    let next = AtomicUsize::new(0);
    let worker = |_| {
        let mut rows = Vec::new();
        while begun.elapsed() < limit
            && let Some(&i) = order.get(next.fetch_add(1, Ordering::Relaxed))
        {
            let row = run(jobs[i]);
            done(&row);
            rows.push((i, row));
        }
        rows
    };
    let workers = rayon::current_num_threads();
    let mut rows: Vec<(usize, Row)> = (0..workers).into_par_iter().with_max_len(1).flat_map_iter(worker).collect();
    rows.sort_by_key(|(i, _)| *i);
    rows.into_iter().map(|(_, row)| row).collect()
}

/// Does runs one after another: tests run side by side themselves.
pub fn run_in_turn(jobs: &[Job]) -> Vec<Row> {
    jobs.iter().map(|job| run(*job)).collect()
}
