//! The error that the steps of a host step may make.
//!
//! # Equation
//!
//! The estimated errors e_1, e_2, ... of the steps of a host step H are added as vectors. Their
//! *coherence* c is the size of the sum as a share of the sum of sizes: 1 for a slow motion, whose
//! errors have one direction, and small for a vibration that turns its phase several times in a
//! host step, whose errors cancel. A step of length h may err by
//!
//! ```text
//! s = |e_1 + ... + e_(n-1)|        c = s/(|e_1| + ... + |e_N|) at the end of the host step
//! allowed = tolerance h/H                                           if c was 1/4 or more
//! allowed = max(tolerance h/H, min(tolerance/2, tolerance - s))     if c was less
//! ```
//!
//! where c is that of the host step before, 1 in the first. The first is error per unit step, the
//! second error per step as long as errors cancel: the sum s never exceeds twice the tolerance. The
//! error of a step grows as h^p with the exponent p of the estimate, so the next step follows from
//! a root of degree p - 1 in the first case, of degree p in the second.
//!
//! # Validity
//!
//! The tolerance is the position error of a motion that is slow beside the host step, whatever
//! vibrates beside it. A vibration is followed only as far as one step's error demands: its phase
//! may be wrong, and an L-stable method damps it. In an island a vibration of a cable moves the
//! bodies, whose errors its amplitude does not bound: there c is always 1, as it is with
//! [`ErrorNorm::Every`](super::ErrorNorm::Every).
//!
//! # References
//!
//! Hairer, Norsett & Wanner 1993, II.4: error per step and per unit step. The coherence is this
//! project's.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

use super::dynamics::Dynamics;
use crate::scales::integrate::{
    MAX_SHARE_OF_ONE_STEP, MIN_COHERENCE, MIN_ERROR_SHARE, NEWTON_TOLERANCE_SHARE, TARGET_ERROR_SHARE,
};

/// The errors that the steps of one host step have made and may make.
pub(super) struct ErrorBudget {
    /// Tolerance in m of the host step.
    tolerance: f64,
    /// The host step in s.
    horizon: f64,
    /// Exponent of h in the error estimate.
    order: u32,
    /// Coherence of the errors before this host step.
    coherence: f64,
    /// Size in m of the sum of errors.
    sum: f64,
    /// Sum in m of the sizes of errors.
    sizes: f64,
}

impl ErrorBudget {
    /// Begins a host step of length `horizon` (s) after errors of this coherence, and clears the
    /// sum of errors.
    pub fn new(tolerance: f64, horizon: f64, order: u32, coherence: f64, sum: &mut [f64]) -> Self {
        sum.fill(0.0);
        ErrorBudget { tolerance, horizon, order, coherence, sum: 0.0, sizes: 0.0 }
    }

    /// Returns the coherence of the errors, 0 to 1, for the next host step.
    pub fn next_coherence(&self) -> f64 {
        if self.sizes > 0.0 { (self.sum / self.sizes).min(1.0) } else { 1.0 }
    }

    /// Returns the error per unit step in m that a step of length `h` (s) may make.
    fn per_unit_step(&self, h: f64) -> f64 {
        self.tolerance * (h / self.horizon).max(MIN_ERROR_SHARE)
    }

    /// Returns the error in m that an incoherent step of any length may make; 0 if errors add up.
    fn per_step(&self) -> f64 {
        if self.coherence >= MIN_COHERENCE {
            return 0.0;
        }
        (MAX_SHARE_OF_ONE_STEP * self.tolerance).min(self.tolerance - self.sum).max(0.0)
    }

    /// Returns the error in m that a step of length `h` (s) may make.
    pub fn allowed(&self, h: f64) -> f64 {
        self.per_unit_step(h).max(self.per_step())
    }

    /// Returns Newton's tolerance in m in a step of length `h` (s): its errors do not cancel.
    pub fn newton_tolerance(&self, h: f64) -> f64 {
        NEWTON_TOLERANCE_SHARE * self.per_unit_step(h)
    }

    /// Adds the error of an accepted step, and its size in m, to `sum`.
    pub fn add(&mut self, system: &dyn Dynamics, error: &[f64], size: f64, sum: &mut [f64]) {
        for (sum, error) in sum.iter_mut().zip(error) {
            *sum += error;
        }
        self.sum = system.norm(sum);
        self.sizes += size;
    }

    /// Returns the factor from a step of length `h` (s) and its estimated error to the next step,
    /// 1/5 to 3.
    pub fn growth(&self, h: f64, estimate: f64) -> f64 {
        let ratio = |allowed: f64| TARGET_ERROR_SHARE * allowed / estimate.max(1e-300);
        let per_unit_step = root(ratio(self.per_unit_step(h)), self.order - 1);
        let per_step = root(ratio(self.per_step()), self.order);
        per_unit_step.max(per_step).clamp(0.2, 3.0)
    }
}

/// Returns the root of the given degree, 1 to 4, by basic arithmetic: a library's `powf` may give
/// other bits on another processor.
fn root(x: f64, degree: u32) -> f64 {
    match degree {
        1 => x,
        2 => x.sqrt(),
        4 => x.sqrt().sqrt(),
        _ => {
            let x = x.clamp(1e-12, 1e12);
            let mut y = if x > 1.0 { x.sqrt() } else { 1.0 };
            for _ in 0..60 {
                y = (2.0 * y + x / (y * y)) / 3.0;
            }
            y
        }
    }
}
