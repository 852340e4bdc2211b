//! A step of many cables that nothing connects.
//!
//! # Validity
//!
//! A cable reads and writes nothing of another, so results are bitwise the same for any number of
//! threads. Cables connected by bodies are an [`island`](crate::island).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

#[cfg(feature = "parallel")]
use super::grain::{cost_of_step, jobs_of_task};
use crate::cable::Cable;
use crate::error::Error;
use core::borrow::BorrowMut;
#[cfg(feature = "parallel")]
use std::sync::Mutex;

/// Cables of a fleet that could not step.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{} cables could not step; number {}: {}", .failures.len(), .failures[0].0, .failures[0].1)]
#[non_exhaustive]
pub struct FleetError {
    /// Number in the fleet and error of each of them, ascending; there is at least one.
    pub failures: Vec<(usize, Error)>,
}

/// Advances each cable by `dt` (s) with its integrator, as [`Cable::step`] does; with the feature
/// `parallel`, on as many threads of rayon's present pool as the work pays for. `cables` are cables
/// or mutable references to some.
///
/// # Errors
/// [`FleetError`] if some could not step: these are as before, and all others have advanced.
pub fn step_all<C: BorrowMut<Cable> + Send>(cables: &mut [C], dt: f64) -> Result<(), FleetError> {
    let failures = failures(cables, dt);
    if failures.is_empty() { Ok(()) } else { Err(FleetError { failures }) }
}

#[cfg(feature = "parallel")]
fn failures<C: BorrowMut<Cable> + Send>(cables: &mut [C], dt: f64) -> Vec<(usize, Error)> {
    use rayon::prelude::*;
    let cost = cables.iter().map(|cable| cost_of_step(cable.borrow())).sum();
    let of_task = jobs_of_task(cables.len(), cost);
    if of_task >= cables.len() {
        return serial_failures(cables, dt);
    }
    // collecting them from the threads would allocate where there are none
    let failures = Mutex::new(Vec::new());
    cables.par_iter_mut().with_min_len(of_task).enumerate().for_each(|(i, cable)| {
        if let Err(error) = cable.borrow_mut().step(dt) {
            failures.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).push((i, error));
        }
    });
    let mut failures = failures.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    failures.sort_by_key(|(i, _)| *i);
    failures
}

#[cfg(not(feature = "parallel"))]
use serial_failures as failures;

fn serial_failures<C: BorrowMut<Cable>>(cables: &mut [C], dt: f64) -> Vec<(usize, Error)> {
    let step = |(i, cable): (usize, &mut C)| Some((i, cable.borrow_mut().step(dt).err()?));
    cables.iter_mut().enumerate().filter_map(step).collect()
}
