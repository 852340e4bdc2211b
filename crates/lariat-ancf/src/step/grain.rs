//! How many cables or islands one task of a thread pool steps.
//!
//! # Equation
//!
//! ```text
//! jobs of a task >= n G/C      C = sum over cables of elements times evaluations per host step
//! ```
//!
//! Waking a thread takes some 10 us. A task of G = 1000 evaluations of an element takes some 100
//! us, so that threads are never paid for with more than about a tenth of the work, and what is
//! less than two tasks is stepped where it is called.
//!
//! # Validity
//!
//! Evaluations are the mean of the host steps that a cable has taken; results do not depend on
//! them, for no cable or island reads what another one writes.

use crate::cable::Cable;
use crate::scales::integrate::EVALUATIONS_OF_TASK;

/// Returns about how many evaluations of an element a host step of a cable takes: the mean of those
/// so far.
pub fn cost_of_step(cable: &Cable) -> f64 {
    let counts = cable.diagnostics();
    let evaluations = (counts.force_evaluations + counts.tangent_evaluations).max(2 * counts.newton_iterations);
    let mean = evaluations as f64 / counts.host_steps.max(1) as f64;
    mean.max(2.0) * cable.elements().len() as f64
}

/// Returns how many of some jobs, which together cost so many evaluations of an element, one task
/// of a thread pool should take at least; all of them where threads do not pay.
pub fn jobs_of_task(jobs: usize, cost: f64) -> usize {
    let tasks = (cost / EVALUATIONS_OF_TASK).floor().max(1.0);
    (jobs as f64 / tasks).ceil().max(1.0) as usize
}
