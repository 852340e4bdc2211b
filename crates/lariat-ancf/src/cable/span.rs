//! The length of a cable by its tension or its sag.
//!
//! # Equation
//!
//! A cable between its drawn ends, held there, hangs in equilibrium under its weight, constant
//! loads per length and the buoyancy of water at rest: as it is installed, before wind, currents
//! and loads at points. Of its length L, the tension at its middle and the sag are functions that
//! the statics of the cable give, and L is the root of
//!
//! ```text
//! |F(L/2; L)| = T_0   or   max_s d(s; L) = d_0        d: distance from the drawn line, along gravity
//! ```
//!
//! by bisection of a bracket, with the secant wherever it is inside. F is in equilibrium with the
//! reactions, so it is right where the elements are too long to read a tension from their strain.
//!
//! # Validity
//!
//! Tension falls and sag grows with the length. A cable without weight has no sag; a tension that a
//! cable of five times the drawn length has not fallen to is refused, as is any below the least
//! one.
//!
//! # References
//!
//! Irvine 1981, chapter 2 (elastic catenary); `tests/span.rs`.
//!
//! # Alternatives considered
//!
//! The elastic catenary in closed form: it knows one section, the Green law not, no buoyancy.

use super::Cable;
use crate::error::{Error, require};
use crate::scales::cable::{SPAN_ROUNDS, SPAN_SLACKEST, SPAN_WITHIN};
use nalgebra::Vector3;

/// What fixes the length of a cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Span {
    /// Tension at the middle in N.
    Tension(f64),
    /// Largest distance from the drawn line along gravity in m.
    Sag(f64),
}

impl Span {
    pub fn is_sag(self) -> bool {
        matches!(self, Span::Sag(_))
    }

    /// Returns the length in m with which a cable, `drawn` m long as drawn between its `ends`, has
    /// it; `hanging` gives the cable of a length in equilibrium.
    pub fn length(
        self,
        drawn: f64,
        ends: &[Vector3<f64>; 2],
        hanging: impl Fn(f64) -> Result<Cable, Error>,
    ) -> Result<f64, Error> {
        let (what, goal) = match self {
            Span::Tension(tension) => ("pretension (N)", tension),
            Span::Sag(sag) => ("sag (m)", sag),
        };
        require(what, goal, goal > 0.0, "> 0")?;
        // what is longer hangs lower, with less tension
        let missed = |length: f64| -> Result<f64, Error> {
            let cable = hanging(length)?;
            Ok(match self {
                Span::Tension(_) => 1.0 - cable.force_at_middle()? / goal,
                Span::Sag(_) => cable.sag(ends)? / goal - 1.0,
            })
        };
        let unreached = || require(what, goal, false, "one that the cable has between its ends, at some length");
        let mut low = [drawn, missed(drawn)?];
        if low[1].abs() <= SPAN_WITHIN {
            return Ok(drawn);
        }
        // a bracket: shorter for more tension or less sag, longer for the other
        let longer = low[1] < 0.0;
        let (mut step, mut high) = (SPAN_WITHIN.sqrt(), low);
        loop {
            let length = if longer { drawn * (1.0 + step) } else { drawn / (1.0 + step) };
            let next = [length, missed(length)?];
            (low, high) = if longer { (high, next) } else { (next, low) };
            if (next[1] >= 0.0) == longer {
                break;
            }
            // whatever hangs from both ends hangs by half of its slack
            let last = match self {
                _ if !longer => 1.0,
                Span::Sag(sag) => 4.0 * sag.max(drawn) / drawn,
                Span::Tension(_) => SPAN_SLACKEST,
            };
            if step >= last {
                unreached()?;
            }
            step = last.min(2.0 * step);
        }
        for _ in 0..SPAN_ROUNDS {
            let secant = low[0] - low[1] * (high[0] - low[0]) / (high[1] - low[1]);
            let middle = 0.5 * (low[0] + high[0]);
            // the secant may creep: every other step halves
            let inside = secant > low[0] && secant < high[0];
            for length in [if inside { secant } else { middle }, middle] {
                if length <= low[0] || length >= high[0] {
                    continue;
                }
                let next = [length, missed(length)?];
                if next[1].abs() <= SPAN_WITHIN {
                    return Ok(length);
                }
                if next[1] < 0.0 { low = next } else { high = next }
            }
        }
        Ok(0.5 * (low[0] + high[0]))
    }
}

impl Cable {
    /// Returns the magnitude in N of the force at the middle, by equilibrium.
    fn force_at_middle(&self) -> Result<f64, Error> {
        let half = 0.5 * self.length();
        let (e, xi) = self.model.locate(half);
        match self.carried(e) {
            Some([first, last]) => Ok(first.force.lerp(&last.force, xi).norm()),
            None => Ok(self.sample(half)?.tension),
        }
    }

    /// Returns the largest distance in m from the drawn line along gravity.
    fn sag(&self, [first, last]: &[Vector3<f64>; 2]) -> Result<f64, Error> {
        let down = self.gravity().try_normalize(0.0);
        let mut most = 0.0f64;
        for k in 0..=8 * self.elements().len() {
            let position = self.sample(self.length() * k as f64 / (8 * self.elements().len()) as f64)?.position;
            let along = last - first;
            // the point of the line that is above or below
            let Some(down) = down else { break };
            let flat = along - down * along.dot(&down);
            let share =
                if flat.norm_squared() > 0.0 { (position - first).dot(&flat) / flat.norm_squared() } else { 0.0 };
            most = most.max((position - first - along * share).dot(&down));
        }
        Ok(most)
    }
}
