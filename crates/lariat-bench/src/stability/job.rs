//! The runs of a family, and their execution.

use super::family::Family;
use super::host::{CableModel, Host, Precision};
use super::outcome::Row;
use super::recipe::Recipe;
use crate::{double, single};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A run: a case by its place in its family, a host, and the model of the cables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// The family.
    pub family: Family,
    /// Place of the case in it.
    pub case: usize,
    /// How it is run.
    pub host: Host,
    /// The model of the cables.
    pub model: CableModel,
}

/// Which runs of a family are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection {
    /// All: every case on every host, and Rapier's own ropes.
    Full,
    /// Every case on one of its hosts, a different one for each; the first case of a family with
    /// effects too; 300 random scenes.
    Long,
    /// As `Long`, without the cases that take longest, and 60 random scenes.
    Quick,
}

impl Selection {
    fn random_scenes(self) -> usize {
        match self {
            Selection::Full => usize::MAX,
            Selection::Long => 300,
            Selection::Quick => 60,
        }
    }
}

/// Returns the names of the cases of a family, by their place.
pub fn names(family: Family) -> Vec<String> {
    single::cases::of(family).into_iter().map(|case| case.name).collect()
}

/// Returns the selected runs of a family.
pub fn jobs(family: Family, selection: Selection) -> Vec<Job> {
    let cases = single::cases::of(family);
    let mut jobs = Vec::new();
    for (index, case) in cases.iter().enumerate() {
        let job = |(host, model)| Job { family, case: index, host, model };
        let runs = hosts(family, index).into_iter().flat_map(|host| CableModel::ALL.map(|model| (host, model)));
        let runs = runs.filter(|(host, model)| *model == CableModel::Lariat || host.compares_peers());
        let all: Vec<Job> = runs.filter(|(host, model)| case.applies(host, *model)).map(job).collect();
        match selection {
            Selection::Full => jobs.extend(all),
            _ if family == Family::Random => jobs.extend(all.into_iter().filter(|_| index < selection.random_scenes())),
            Selection::Quick if case.long => {}
            _ => jobs.extend(one_host(family, index, &all)),
        }
    }
    jobs
}

/// Returns the hosts that a case may be run on; a random scene has its own.
fn hosts(family: Family, case: usize) -> Vec<Host> {
    match family {
        Family::Random => vec![Recipe::from_seed(case as u64).host()],
        _ => Host::all(),
    }
}

/// Chooses one host for a case, and one with effects for the first case of a family.
fn one_host(family: Family, case: usize, all: &[Job]) -> Vec<Job> {
    let choose = |effects: bool, place: usize| {
        let of = || all.iter().filter(|j| j.model == CableModel::Lariat && j.host.effects == effects);
        // 1/1000 s costs most and is the easiest step: the full run has it
        let coarse: Vec<&Job> = of().filter(|j| j.host.rate < 1000).collect();
        let of = if coarse.is_empty() { of().collect() } else { coarse };
        (!of.is_empty()).then(|| *of[place % of.len()])
    };
    let plain = choose(false, 7 * case + 3 * family as usize);
    let effects = if case == 0 { choose(true, family as usize) } else { None };
    plain.into_iter().chain(effects).collect()
}

/// Makes a run.
pub fn run(job: Job) -> Row {
    match job.host.precision {
        Precision::Single => single::world::run::run(&single::cases::of(job.family)[job.case], job.host, job.model),
        Precision::Double => double::world::run::run(&double::cases::of(job.family)[job.case], job.host, job.model),
    }
}

/// Makes the run of a random scene.
pub fn run_recipe(recipe: Recipe) -> Row {
    let (name, host) = (format!("{recipe:?}"), recipe.host());
    match host.precision {
        Precision::Single => {
            single::world::run::run(&single::cases::random::scene(name, recipe), host, CableModel::Lariat)
        }
        Precision::Double => {
            double::world::run::run(&double::cases::random::scene(name, recipe), host, CableModel::Lariat)
        }
    }
}

/// Makes runs in parallel, and returns them in the order of `jobs`; `done` is called after each.
///
/// Those of `first` come first and the others are scattered, so that the runs that are not begun
/// within `limit` are spread evenly.
pub fn run_all(jobs: &[Job], first: &[Job], limit: Duration, done: &(dyn Fn(&Row) + Sync)) -> Vec<Row> {
    let begun = Instant::now();
    // Knuth's multiplicative hash
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
