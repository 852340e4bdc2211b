//! What a system with discrete gradients must be able to do.

use super::Pace;
use crate::error::StepFailure;
use crate::term::{Balance, Reason, Settled, Stage, StepStart, Verdict};

/// A mechanical system with discrete gradients, at its present state. What acts in it are its
/// [terms](crate::term).
pub(crate) trait DiscreteGradientSystem {
    /// Returns the present time in s.
    fn time(&self) -> f64;

    /// Sets the present time to `time` (s), from which it differs by rounding.
    fn set_time(&mut self, time: f64);

    /// Begins a host step: puts prescribed coordinates in place if supports or the state were
    /// changed.
    fn begin(&mut self);

    /// Begins a step: sets the first iterate.
    fn predict(&mut self, step: &StepStart);

    /// Takes one Newton iteration, with a new tangent if `fresh`, else with the factors of the last
    /// one, adds a share of the increment, and returns what its result does to the energy.
    ///
    /// # Errors
    /// If the matrix is singular or a number is not finite.
    fn iterate(&mut self, fresh: bool, share: f64) -> Result<Balance, StepFailure>;

    /// Returns the verdict of the terms about the iterate.
    fn verdict(&self, balance: &Balance, stage: Stage) -> Verdict;

    /// Lets the terms change their laws for this step by an iterate that was accepted.
    fn settle(&mut self, balance: &Balance) -> Settled;

    /// Returns what the terms find in the last iterate that no other iteration makes good.
    fn inspect(&mut self, balance: &Balance) -> Verdict;

    /// Scales velocities relative to rigid motion down until the step makes no energy; returns
    /// false, and changes nothing, if that would take a larger share of them than `largest_share`
    /// (0 to 1).
    fn rescale(&mut self, balance: &mut Balance, largest_share: f64) -> bool;

    /// Returns the estimated error of the step in m; 0 where it is not known.
    fn error(&mut self) -> f64;

    /// Returns the estimated error of the step in m, of all cables and bodies; `None` where it is
    /// not known.
    fn estimate(&mut self) -> Option<f64>;

    /// Returns whether the host step may not have longer steps than those of games: what has
    /// contact, reels, twists, or was changed by the host since the last step.
    fn needs_short_steps(&self) -> bool;

    /// Returns the size in m of which errors are a share: the length of the shortest cable, and at
    /// most 1 m.
    fn size(&self) -> f64;

    /// Returns what is remembered of the numbers of steps.
    fn pace(&self) -> Pace;

    /// Remembers it.
    fn set_pace(&mut self, pace: Pace);

    /// Returns the length in s that error control proposed for the next step, or 0.
    fn proposal(&self) -> f64;

    /// Remembers the length in s that error control proposes for the next step; 0 if errors are not
    /// controlled.
    fn propose(&mut self, step: f64);

    /// Lets the terms take what must not be left when the step ends, and returns their verdict
    /// about that end.
    fn finish(&mut self, balance: &mut Balance) -> Verdict;

    /// Makes the end of the step, which is finished, the present state.
    fn accept(&mut self, balance: Balance);

    /// Counts an event.
    fn count(&mut self, event: Event);

    /// Returns how many steps were divided.
    fn splits(&self) -> u64;
}

/// What happened to a step for which one iteration was not enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Event {
    /// Another iteration was taken.
    Iterated(Reason),
    /// A step was accepted that is not solved: a division could go no further.
    Unsolved,
    /// Velocities were scaled down.
    Rescaled,
    /// The step was divided.
    Divided(Reason),
}

/// Returns the sum of the magnitudes of the forces on positions in a nodal vector.
pub(crate) fn sum_of_forces(x: &[f64]) -> f64 {
    x.as_chunks::<6>().0.iter().map(|x| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt()).sum()
}

/// Returns the smaller share u for which v - u w has less kinetic energy than v by the excess, from
/// `1/2 w.M w` and `v.M w`; `None` if there is none up to `largest_share`.
pub(crate) fn share_to_take(energy: f64, product: f64, excess: f64, largest_share: f64) -> Option<f64> {
    let root = product * product - 4.0 * energy * excess;
    let share = (product - root.max(0.0).sqrt()) / (2.0 * energy);
    (root >= 0.0 && (0.0..=largest_share).contains(&share)).then_some(share)
}
