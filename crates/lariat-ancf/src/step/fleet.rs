//! A step of many cables that nothing connects.
//!
//! # Validity
//!
//! A cable reads and writes nothing of another, so results are bitwise the same for any number of
//! threads. Cables connected by bodies are an [`island`](crate::island).
//!
//! # Alternatives considered
//!
//! Equal cables in SIMD lanes, one cable per lane, eight at a time, each lane with the bits of its
//! cable alone and at an iteration of its own. On the example `fleet` this took 1.5 to 1.7 times
//! less processor time with AVX-512 (1.9 times for cables that swing calmly, 1.25 times for thrown
//! steel), 1.3 times with AVX2, and 1.05 times with SSE2: the kernels of the elements fill the
//! lanes of a cable alone as well, and are half of its time. That is less than the twofold that
//! would be worth a second copy of the factorisation.
//!
//! Fewer factorisations, on the same example, when its cables began strained at corners, with the
//! rule `projected-3`, where a step takes 1.65 of them and 2.9 iterations because the first leaves
//! a third of the impulses unbalanced (median): keeping the factors where the first iterate makes
//! energy takes 1.46 and as much time, in more iterations; a first iterate by the acceleration
//! extrapolated with a half or all of its last change takes 1.64 and 1.76.
//!
//! More impulse unbalanced than 1 %: with 2, 5, 10, 30 % and any a step takes 2.7, 2.4, 2.3, 1.9
//! and 1.5 iterations, and 2.4, 2.2, 2.1, 1.6 and 1.2 with `projected-T1` (2.7 at 1 %). Errors of
//! 40 thrown cables stay the same up to any share, but a steady error of tension stays too, as on a
//! rotor. New factors where those at hand leave more than 30 % of the imbalance in place of 10 %: 4
//! % fewer factorisations; 60 %: 8 %, more iterations.

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
/// `parallel`, on the threads of rayon's present pool if there is more than one cable. `cables` are
/// cables or mutable references to some.
///
/// # Errors
/// [`FleetError`] if some could not step: these are as before, and all others have advanced.
pub fn step_all<C: BorrowMut<Cable> + Send>(cables: &mut [C], dt: f64) -> Result<(), FleetError> {
    let failures = failures(cables, |cable| cable.borrow_mut().step(dt));
    if failures.is_empty() { Ok(()) } else { Err(FleetError { failures }) }
}

#[cfg(feature = "parallel")]
fn failures<C: Send>(cables: &mut [C], step: impl Fn(&mut C) -> Result<(), Error> + Sync) -> Vec<(usize, Error)> {
    use rayon::prelude::*;
    if cables.len() <= 1 {
        return serial_failures(cables, step);
    }
    // collecting them from the threads would allocate where there are none
    let failures = Mutex::new(Vec::new());
    cables.par_iter_mut().enumerate().for_each(|(i, cable)| {
        if let Err(error) = step(cable) {
            failures.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).push((i, error));
        }
    });
    let mut failures = failures.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    failures.sort_by_key(|(i, _)| *i);
    failures
}

#[cfg(not(feature = "parallel"))]
use serial_failures as failures;

fn serial_failures<C>(cables: &mut [C], step: impl Fn(&mut C) -> Result<(), Error>) -> Vec<(usize, Error)> {
    cables.iter_mut().enumerate().filter_map(|(i, cable)| Some((i, step(cable).err()?))).collect()
}
