//! A limit to the work of a step, so that no frame of a game waits for it.
//!
//! # Scheme
//! Newton iterations are counted. Once they are spent, error-controlled methods and methods of
//! fixed steps stop with [`StepFailure::WorkLimit`](crate::StepFailure::WorkLimit), and the cable
//! is as before. The [discrete gradient](crate::integrate::discrete_gradient) then takes one
//! iteration per step: what a step would make is taken from velocities relative to rigid motion,
//! all of them if need be. So it cannot make energy either, but forces, and the motion that they
//! drive, have errors without a bound. Where even that does not keep the energy law, it *stops
//! before the end of the step*: the time of the cable, and the bodies of its island, are then
//! behind, at a state that keeps the law. It stops after one part of a step at least, so that it
//! always goes on.
//!
//! # Validity
//! A limit of iterations is exceeded by the stages of one step at most, then by one iteration per
//! step of the discrete gradient, and in the first of them by those of one step and its first
//! divisions, 20 for each of 7 lengths. A limit of time is compared at the same points, and its
//! results are not repeatable.

use core::cell::Cell;
use web_time::Instant;

/// How much work is left.
#[derive(Clone, Debug)]
pub struct WorkLimit {
    iterations: Cell<u64>,
    spent: Cell<u64>,
    deadline: Option<Instant>,
    reduced: Cell<bool>,
    progressed: Cell<bool>,
    stopped: Cell<bool>,
}

impl WorkLimit {
    /// Returns a limit to the number of Newton iterations. Repeatable to the bit.
    pub fn iterations(iterations: u64) -> Self {
        let [reduced, progressed, stopped] = [const { Cell::new(false) }; 3];
        WorkLimit {
            iterations: Cell::new(iterations),
            spent: Cell::new(0),
            deadline: None,
            reduced,
            progressed,
            stopped,
        }
    }

    /// Returns a limit to time. Not repeatable.
    pub fn until(deadline: Instant) -> Self {
        WorkLimit { deadline: Some(deadline), ..WorkLimit::iterations(u64::MAX) }
    }

    /// Returns whether nothing is left.
    pub fn is_spent(&self) -> bool {
        self.iterations.get() == 0 || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Returns the number of Newton iterations that are left; `u64::MAX` if only time is limited.
    pub fn left(&self) -> u64 {
        self.iterations.get()
    }

    /// Returns the number of Newton iterations that were taken.
    pub fn spent(&self) -> u64 {
        self.spent.get()
    }

    /// Returns whether a step was taken with reduced accuracy because nothing was left.
    pub fn has_reduced(&self) -> bool {
        self.reduced.get()
    }

    /// Returns whether a step ended early, so that the time of the cable is behind.
    pub fn has_stopped(&self) -> bool {
        self.stopped.get()
    }

    /// Counts iterations.
    pub(crate) fn spend(&self, iterations: u64) {
        self.spent.set(self.spent.get() + iterations);
        if self.deadline.is_none() {
            self.iterations.set(self.iterations.get().saturating_sub(iterations));
        }
    }

    /// Notes that a step, or a part of it, was accepted.
    pub(super) fn note_progress(&self) {
        self.progressed.set(true);
    }

    /// Returns whether the step may end where it is, which it then does.
    pub(super) fn stops(&self) -> bool {
        self.stopped.set(self.progressed.get());
        self.stopped.get()
    }

    /// Returns whether nothing is left, which then reduces the accuracy of a step.
    pub(super) fn reduces(&self) -> bool {
        let spent = self.is_spent();
        self.reduced.set(self.reduced.get() | spent);
        spent
    }
}
