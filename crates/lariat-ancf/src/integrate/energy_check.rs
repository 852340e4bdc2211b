//! The check of every implicit step for spurious energy.
//!
//! # Equation
//!
//! The spurious energy d of a step is its change of energy minus the work of external forces. The
//! account
//!
//! ```text
//! m = max(0, m + d)
//! ```
//!
//! is the largest amount that was made in any interval of time that ends now (a cumulative sum). A
//! step after which it exceeds 1 % of the largest kinetic and strain energy of the run so far (with
//! that of a strain of 1e-5, for a run that begins at rest) is rejected and tried at a quarter of
//! its length; if a step of 1/1024 of the first one still makes it, the host step fails with
//! [`StepFailure::EnergyMade`]. The account is part of a snapshot. So no run gains more than this
//! share between any two times.
//!
//! The errors of many steps within a tolerance are no blow-up, but they add up: an undamped
//! pendulum at the default tolerance and 1/90 s makes 1 % in 20 000 host steps, however each is
//! divided. Where the error is controlled, what the account holds beyond half of that share is
//! therefore taken from velocities at the end of the step (a projection onto the energy), as far as
//! that moves no point by more over the step than the error budget leaves beside the estimate. What
//! is left is taken in later steps: near its turning point a pendulum has hardly any velocity. The
//! order of the method stays, for what is taken is an error of the step.
//!
//! # Validity
//!
//! Systems that know the work on them: `None` of
//! [`spurious_energy`](super::Dynamics::spurious_energy) is not checked. In an island only methods
//! without an error estimate (the midpoint rule) are: what contacts and joints do to its bodies
//! between two steps would count as made, and jams under 5 kN were refused. The share is a bound of
//! what a wrong setting may do, not an accuracy: error control at the default tolerance stays far
//! below it. A-stability bounds the energy of a linear system only; on a cable the midpoint rule,
//! the trapezoidal rule, and L-stable methods with tolerances of millimetres and more make energy
//! without this check.
//!
//! # References
//!
//! Page 1954 (the cumulative sum); Simo & Tarnow 1992 (A-stable methods make energy in nonlinear
//! dynamics); Hairer, Lubich & Wanner 2006, IV.4 (projection onto an invariant keeps the order).
//!
//! # Alternatives considered
//!
//! - A bound for each step: many steps below it make any amount.
//! - The net sum since the start: what a damping method has lost long ago would pay for a blow-up.
//! - Scaling velocities down by all of the excess: it hides a step that is wrong.
//! - Taking all that each step makes: a swing makes energy in one half and loses it in the other,
//!   so that the sum of what is made is a loss. Below half of the share nothing is taken.
//! - Giving back what is lost as well: an L-stable method damps vibrations that it does not
//!   resolve, and their energy would go into the slow motion.

use super::dynamics::Dynamics;
use crate::error::StepFailure;
use crate::scales::integrate::{MAX_ENERGY_SHARE, MAX_LEFT_SHARE};
use crate::state::{Memory, State};

/// The account of spurious energy.
#[derive(Clone, Copy)]
pub(super) struct EnergyCheck {
    active: bool,
    /// Spurious energy in J of the accepted steps.
    made: f64,
    /// Largest kinetic and strain energy in J so far.
    largest: f64,
}

impl EnergyCheck {
    /// Continues the account of a state. A check that is not active accepts everything.
    pub fn new(active: bool, memory: &Memory) -> Self {
        EnergyCheck { active, made: memory.energy_made, largest: memory.largest_energy }
    }

    /// Returns the account after a step of length `h` (s) from `before` to `after`.
    ///
    /// # Errors
    /// [`StepFailure::EnergyMade`] if the step must not be accepted.
    pub fn after(self, system: &mut dyn Dynamics, before: &State, after: &State, h: f64) -> Result<Self, StepFailure> {
        if !self.active {
            return Ok(self);
        }
        let Some((spurious, energy)) = system.spurious_energy(before, after, h) else { return Ok(self) };
        let made = (self.made + spurious).max(0.0);
        let largest = self.largest.max(energy);
        if made > MAX_ENERGY_SHARE * largest {
            return Err(StepFailure::EnergyMade { energy: made, scale: largest });
        }
        Ok(EnergyCheck { made, largest, ..self })
    }

    /// Takes what the account holds beyond half of the largest share from the velocities of a
    /// state, but changes none by more than `largest` (m/s).
    pub fn take(&mut self, system: &mut dyn Dynamics, state: &mut State, largest: f64) {
        let excess = self.made - MAX_LEFT_SHARE * self.largest;
        if self.active && excess > 0.0 && largest > 0.0 {
            self.made -= system.take_energy(state, excess, largest);
        }
    }

    /// Stores the account with a state.
    pub fn keep(self, memory: &mut Memory) {
        memory.energy_made = self.made;
        memory.largest_energy = self.largest;
    }
}
