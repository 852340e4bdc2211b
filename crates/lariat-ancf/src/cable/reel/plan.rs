//! The rate of a reel over a step: as its table asks, with a limit on acceleration, and to a soft stop at the ends.
//!
//! # Equation
//!
//! The rate is linear within a step of length h. It may end at r if it can still stop within what is left of the cable:
//! `r^2/(2 a) <= left - h (r_0 + r)/2`.

use super::{Reel, Winding};
use crate::cable::Cable;
use crate::element::side::Side;

/// Least length of the element at the eye, as a share of its full length.
pub(super) const LEAST: f64 = 0.4;

/// The rate of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan {
    /// Acceleration in m/s^2.
    pub acceleration: f64,
    /// Whether an end stops it.
    pub stopped: bool,
}

impl Cable {
    /// Returns the length in m that the reel of an end can take in: up to the next held node, load or element at another eye, less the
    /// least element.
    fn left(&self, side: Side) -> f64 {
        let (model, count) = (&self.model, self.elements().len());
        let element = |k: usize| if side == Side::End { count - 1 - k } else { k };
        let two = model.reels.sides().count() > 1;
        let (mut left, mut last) = (0.0, 0);
        for k in 0..count {
            last = element(k);
            left += model.elements[last].length;
            let far = if side == Side::End { last } else { last + 1 };
            if model.support(far).is_some() || two && k + 2 == count {
                break;
            }
        }
        let length = self.length();
        let from_eye = |s: f64| if side == Side::End { length - s } else { s };
        let load = model.loads.iter().map(|load| from_eye(load.arc_length)).fold(left, f64::min);
        load - LEAST * model.reels.element(self.number(last)).length
    }

    /// Returns the rate of a reel for a step of length `h` (s).
    pub(super) fn plan(&self, side: Side, reel: &Reel, winding: &Winding, h: f64) -> Plan {
        let (a, rate) = (reel.acceleration, winding.extent[1]);
        let wanted = reel.asked(self.time()).clamp(rate - a * h, rate + a * h);
        // towards an end that is `left` away, at the present rate r towards it
        let bound = |left: f64, r: f64| {
            let left = left - 0.5 * h * r;
            if left <= 0.0 { 0.0 } else { a * ((0.25 * h * h + 2.0 * left / a).sqrt() - 0.5 * h) }
        };
        let highest = reel.stock.map_or(f64::INFINITY, |stock| bound(stock - self.length(), rate));
        let lowest = -bound(self.left(side), -rate);
        let end = wanted.clamp(lowest, highest.max(lowest));
        Plan { acceleration: (end - rate) / h, stopped: end != wanted }
    }
}
