//! Integration of all islands that are ready, each with its cables and bodies as one system.
//!
//! # Threads
//! With the feature `parallel`, islands are integrated on the threads of rayon's present pool. One
//! reads and writes nothing of another, nor of Rapier's world, so results are bitwise the same for
//! any number of threads.

use crate::contents::{Contents, Slot};
use crate::error::Error;
use crate::islands::Island;
use crate::step::budget::step_within;
use crate::step::prediction::Prediction;
use core::cell::RefCell;
#[cfg(feature = "parallel")]
use lariat_ancf::coupling::{cost_of_step, jobs_of_task};
use lariat_ancf::integrate::WorkLimit;
use lariat_ancf::island::{Island as IslandSolver, Wheels};
use lariat_ancf::{Cable, Integrator};

thread_local! {
    /// Buffers of the islands that this thread integrates.
    static SOLVERS: RefCell<Vec<IslandSolver>> = const { RefCell::new(Vec::new()) };
}

/// An island that is ready, with its cables.
#[derive(Debug)]
struct Job<'a> {
    island: &'a Island,
    cables: Vec<&'a mut Cable>,
    prediction: &'a mut Prediction,
    integrator: Integrator,
    /// Time step in s.
    h: f64,
}

impl Job<'_> {
    fn run(&mut self) {
        let limit = self.prediction.budget.limit(&self.integrator);
        let outcome = if self.island.is_loose() {
            let (h, integrator) = (self.h, &self.integrator);
            self.cables
                .iter_mut()
                .try_for_each(|cable| step_within(&limit, integrator, |integrator| cable.step_with(h, integrator)))
        } else {
            let mut solver = SOLVERS.with_borrow_mut(Vec::pop).unwrap_or_default();
            let outcome = self.step_island(&mut solver, &limit);
            SOLVERS.with_borrow_mut(|solvers| solvers.push(solver));
            outcome
        };
        self.prediction.budget.update(&limit);
        self.prediction.degraded |= limit.has_reduced();
        self.prediction.error = outcome.err().map(Error::from);
    }

    /// Steps cables and members in equal parts, and adds up the accounts of the pins.
    fn step_island(&mut self, solver: &mut IslandSolver, limit: &WorkLimit) -> Result<(), lariat_ancf::Error> {
        let Job { island, cables, prediction, integrator, h } = self;
        let Prediction { start, end, accounts, parts, wheels, coupled, .. } = &mut **prediction;
        solver.set_cable_pairs(Some(&island.pairs));
        solver.couple(coupled);
        for part in 0..*parts {
            for (body, start) in end.iter_mut().zip(&*start) {
                let [first, last] = start.unsteadiness;
                let first = if part == 0 { first } else { Default::default() };
                body.unsteadiness = [first, if part + 1 == *parts { last } else { Default::default() }];
            }
            let h = *h / f64::from(*parts);
            step_within(limit, integrator, |integrator| {
                let wheels = Wheels { sheaves: wheels, drums: &island.wheels.drums };
                solver.step_with_wheels(cables, end, &island.pins, wheels, integrator, h)
            })?;
            if part == 0 {
                accounts.clear();
                accounts.extend_from_slice(solver.accounts());
            } else {
                accounts.iter_mut().zip(solver.accounts()).for_each(|(sum, account)| sum.add(account));
            }
        }
        Ok(())
    }
}

/// The memory of the vectors of references that a step needs; they are empty between steps.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    slots: Vec<Option<&'static mut Slot>>,
    jobs: Vec<Job<'static>>,
    cables: Vec<Vec<&'static mut Cable>>,
}

impl Clone for Buffers {
    fn clone(&self) -> Self {
        Buffers::default()
    }
}

/// Returns the memory of a vector for items of another lifetime: the standard library collects in
/// place what has the same layout.
fn recycled<A, B>(mut vector: Vec<A>) -> Vec<B> {
    vector.clear();
    vector.into_iter().map(|_| unreachable!("an empty vector")).collect()
}

/// Integrates the islands that are ready over a step of `h` (s), into their predictions.
pub(crate) fn integrate(
    contents: &mut Contents,
    islands: &[Island],
    predictions: &mut [Prediction],
    buffers: &mut Buffers,
    h: f64,
) {
    let Buffers { slots, jobs, cables: unused } = buffers;
    let mut free: Vec<Option<&mut Slot>> = recycled(core::mem::take(slots));
    free.extend(contents.cables.all_mut());
    let mut ready: Vec<Job<'_>> = recycled(core::mem::take(jobs));
    for (island, prediction) in islands.iter().zip(predictions) {
        let Some(integrator) = prediction.integrator else { continue };
        let mut cables: Vec<&mut Cable> = recycled(unused.pop().unwrap_or_default());
        cables.extend(island.cables.iter().filter_map(|&c| Some(&mut free[c].take()?.cable)));
        ready.push(Job { island, cables, prediction, integrator, h });
    }
    run(&mut ready);
    unused.extend(ready.drain(..).map(|job| recycled(job.cables)));
    *jobs = recycled(ready);
    *slots = recycled(free);
}

fn run(jobs: &mut [Job<'_>]) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        let cost = jobs.iter().flat_map(|job| &job.cables).map(|cable| cost_of_step(cable)).sum();
        let of_task = jobs_of_task(jobs.len(), cost);
        if of_task < jobs.len() {
            jobs.par_iter_mut().with_min_len(of_task).for_each(Job::run);
            return;
        }
    }
    jobs.iter_mut().for_each(Job::run);
}
