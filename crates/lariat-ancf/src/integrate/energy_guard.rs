//! The check of fixed steps for spurious energy.
//!
//! Generalised-alpha without error control does not detect steps that are too long for a slack
//! cable in fast motion, and creates energy there.
//!
//! # Equation
//!
//! The spurious energy of a step is its change of energy minus the external work. It is computed if
//! Newton's iteration needed more than one iteration and its check, or if the rates of slopes
//! jumped: by a strain of 1e-3 over the step and by a quarter of the largest rate. Other steps skip
//! the check. If the sum within the host step exceeds 1e-3 of the kinetic and strain energy, the
//! step is rejected and retried at 1/4 of its length, below 1/8 of the regular step by backward
//! Euler, down to 1/1024 of it.
//!
//! # Validity
//!
//! Systems that know the work of their loads; others are not checked. `lariat stability --family
//! random`: none of 500 scenes exceeds its bound of energy; 16 do if only the number of iterations
//! decides on the check.

use super::backward_euler;
use super::dynamics::Dynamics;
use super::one_step::{OneStep, Scratch, StepRequest};
use super::state::State;
use crate::error::StepFailure;

/// Newton iterations of a linearly implicit step, its check included.
const USUAL_ITERATIONS: u64 = 2;
/// Largest spurious energy of a host step, as a share of the kinetic and strain energy.
const MAX_ENERGY_SHARE: f64 = 1e-3;
/// Shortest step that is checked, as a share of the regular one.
const MIN_CHECKED_SHARE: f64 = 1.0 / 1024.0;
/// Change of the rate of a slope, times the step, above which a step is checked.
const SLOPE_RATE_JUMP: f64 = 1e-3;
/// The same change, as a share of the largest rate.
const SLOPE_RATE_JUMP_SHARE: f64 = 0.25;
/// After a step was rejected, steps shorter than this share of the regular one are backward
/// Euler's.
const FALLBACK_SHARE: f64 = 1.0 / 8.0;

/// The check during one host step.
pub(super) struct EnergyGuard {
    active: bool,
    /// Regular step in s.
    regular: f64,
    /// Spurious energy in J of the accepted steps.
    spurious_energy: f64,
    /// Whether a step was rejected.
    rejected: bool,
    /// Whether the last step was backward Euler's.
    used_fallback: bool,
    /// Whether Newton's iteration of the last step needed more iterations than usual.
    newton_struggled: bool,
}

impl EnergyGuard {
    /// Begins a host step of regular steps of `regular` (s). A guard that is not active accepts
    /// everything.
    pub fn new(active: bool, regular: f64) -> Self {
        let (rejected, used_fallback, newton_struggled) = (false, false, false);
        EnergyGuard { active, regular, spurious_energy: 0.0, rejected, used_fallback, newton_struggled }
    }

    /// Takes a step by `method` or by the fallback.
    pub fn step(
        &mut self,
        system: &mut dyn Dynamics,
        method: &dyn OneStep,
        state: &State,
        request: StepRequest,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        let iterations = system.newton_iterations();
        self.used_fallback = self.rejected && request.h < FALLBACK_SHARE * self.regular;
        let outcome = if self.used_fallback {
            let outcome = backward_euler::TABLEAU.step(system, state, request, scratch);
            let memory = &mut scratch.next.memory;
            memory.algorithmic.copy_from_slice(&memory.acceleration);
            outcome
        } else {
            method.step(system, state, request, scratch)
        };
        self.newton_struggled = system.newton_iterations() - iterations > USUAL_ITERATIONS;
        outcome
    }

    /// Returns whether the last step, of length `h` (s) from `before` to `after`, is accepted.
    pub fn accepts(&mut self, system: &mut dyn Dynamics, before: &State, after: &State, h: f64) -> bool {
        if !self.active {
            return true;
        }
        let check_energy = self.newton_struggled || self.used_fallback || slope_rates_jump(before, after, h);
        if !check_energy || h <= MIN_CHECKED_SHARE * self.regular {
            return true;
        }
        let Some((energy, scale)) = system.spurious_energy(before, after, h) else { return true };
        if self.spurious_energy + energy > MAX_ENERGY_SHARE * scale && energy > 0.0 {
            self.rejected = true;
            return false;
        }
        self.spurious_energy += energy;
        true
    }
}

/// Returns whether the rates of slopes change so much that the step may have created energy: by
/// [`SLOPE_RATE_JUMP`] over the step, and by [`SLOPE_RATE_JUMP_SHARE`] of the largest rate, more
/// than those of a swinging rope do.
fn slope_rates_jump(before: &State, after: &State, h: f64) -> bool {
    let (mut change, mut rate) = (0.0f64, 0.0f64);
    for (v, w) in before.v.chunks_exact(6).zip(after.v.chunks_exact(6)) {
        let d = [w[3] - v[3], w[4] - v[4], w[5] - v[5]];
        change = change.max(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        rate = rate.max(v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
    }
    change * h * h > SLOPE_RATE_JUMP * SLOPE_RATE_JUMP && change > SLOPE_RATE_JUMP_SHARE * SLOPE_RATE_JUMP_SHARE * rate
}
