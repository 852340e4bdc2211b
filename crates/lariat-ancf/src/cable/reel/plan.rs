//! The rate of a reel over a step: as its table asks, with a limit on acceleration, and to a soft stop at the ends.
//!
//! # Equation
//!
//! The rate is linear within a step of length h; its bounds are those of [`rates`].

use super::{Feed, Reel, Winding};
use crate::cable::Cable;
use crate::element::side::Side;
use crate::system::{Law, Motor, STOP, rates};

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
        let rate = winding.extent[1];
        let left = [self.left(side), self.left_of_stock(reel)];
        let [lowest, wanted, highest] = rates(reel.asked(self.time()), reel.acceleration, rate, left, h);
        let end = wanted.clamp(lowest, highest);
        Plan { acceleration: (end - rate) / h, stopped: end != wanted }
    }

    /// Returns the length in m that is left of the stock.
    fn left_of_stock(&self, reel: &Reel) -> f64 {
        let stock = reel.stock.filter(|_| reel.feed != Feed::Sheave);
        stock.map_or(f64::INFINITY, |stock| stock - self.length())
    }

    /// Returns what drives a reel whose rate is an unknown, for a part of a host step.
    pub(super) fn law(&self, side: Side, reel: &Reel, winding: &Winding) -> Option<Law> {
        let length = winding.extent[0];
        let in_island = reel.needs_island();
        Some(Law::new(Motor {
            limit: reel.max_force.or(in_island.then_some(0.0))?,
            wheel: if reel.feed == Feed::Sheave { 0.0 } else { reel.inertia },
            asked: reel.asked(self.time()),
            acceleration: if in_island { STOP } else { reel.acceleration },
            bounds: [length - self.left(side), length + self.left_of_stock(reel)],
        }))
    }
}
