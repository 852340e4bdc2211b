//! Coefficients of the one-leg formula of the [discrete
//! gradient](crate::integrate::discrete_gradient).
//!
//! # Equation
//!
//! ```text
//! x^ = x0 + b D x - a O x        b = 1/2 + a        b L^2 + (1/2 - 2a) L + a = 0
//! ```
//!
//! The formula of order 2 and step h damps a vibration of frequency omega by the share `pi a (h
//! omega)^3` of its amplitude in a period, which is `a (h omega)^3/2` per radian. What a step does
//! not resolve is multiplied by L in each step: -1/3 for a = 1/16, where the root is double and a
//! larger a damps no more; -0.97 for a = 1/256; -1 for a = 0, that is not damped.

use crate::scales::integrate::{ALPHA, OF_MIDPOINT};

/// a and b = 1/2 + a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OneLeg {
    pub a: f64,
    pub b: f64,
}

/// Factors of an estimate of the error on the change of velocity in a step, and on that in the step
/// before.
pub(crate) type Factors = fn(&OneLeg, f64, f64) -> [f64; 2];

impl OneLeg {
    pub const fn new(a: f64) -> Self {
        OneLeg { a, b: 0.5 + a }
    }

    /// Returns the share of the changes of a step with dissipation `before` and length `step` (s)
    /// that counts in one of length `h` (s): all of them, unless that step was longer, or its
    /// energy in the store would grow.
    pub fn share_kept(&self, (before, step): (f64, f64), h: f64) -> f64 {
        let of_length = if step > h { h / step } else { 1.0 };
        if before < self.a { of_length * (before / self.a).sqrt() } else { of_length }
    }

    /// Returns the share of the energy in the store that a step takes up which keeps a share of the
    /// changes of one with dissipation `before`.
    pub fn share_held(&self, before: f64, kept: f64) -> f64 {
        if before > 0.0 { (self.a / before * kept * kept).min(1.0) } else { 1.0 }
    }

    /// Returns the factors on D v and on what counts of O v in the estimated error of a step, which
    /// is `ratio` times as long as the one before, of which `kept` counts.
    pub fn error_factors(&self, ratio: f64, kept: f64) -> [f64; 2] {
        [OF_MIDPOINT + self.a, OF_MIDPOINT * ratio / kept + self.a]
    }

    /// Returns the same factors for the error that the formula makes in every step of a length:
    /// without that of one step that is longer than the one before, of which O v is not scaled up.
    pub fn smooth_error_factors(&self, ratio: f64, kept: f64) -> [f64; 2] {
        let factor = OF_MIDPOINT + self.a;
        [factor, factor * ratio / kept]
    }
}

impl Default for OneLeg {
    fn default() -> Self {
        OneLeg::new(ALPHA)
    }
}

/// The dissipation of a state that was stored without it.
pub(crate) fn of_games() -> f64 {
    ALPHA
}
