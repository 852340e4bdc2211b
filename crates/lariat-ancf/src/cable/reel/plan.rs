//! The rate of a reel over a step: as its table asks, with a limit on acceleration, and to a soft stop at the ends.
//!
//! # Equation
//!
//! The rate is linear within a step of length h; its bounds are those of [`rates`].

use super::{NEAR, Winding};
use crate::cable::Cable;
use crate::element::side::Side;
use crate::reel::{Feed, Reel};
use crate::system::{Law, Motor, MotorState, STOP, rates};

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
    /// Returns the length in m that the reel of an end can take in: up to the next held node, element with a load or of another section, or at another eye, less the
    /// least element; or a length that is more than `enough` (m) and less than that.
    fn left(&self, side: Side, enough: f64) -> f64 {
        let (model, count) = (&self.model, self.elements().len());
        let element = |k: usize| if side == Side::End { count - 1 - k } else { k };
        let two = model.reels.sides().count() > 1;
        let (mut left, mut last) = (0.0, 0);
        for k in 0..count {
            last = element(k);
            left += model.elements[last].length;
            let far = if side == Side::End { last } else { last + 1 };
            let least = LEAST * model.reels.element(self.number(last)).length;
            let held = model.support(far).is_some() || self.keeps_node_behind(side, left, k);
            if left - least > enough || held || two && k + 2 == count {
                break;
            }
        }
        left - LEAST * model.reels.element(self.number(last)).length
    }

    /// Returns whether the far node of element number `k` from the eye, `from_eye` m from there, has to stay: because the next element is of
    /// another section, or has a point load on it, but at its own far node.
    pub(super) fn keeps_node_behind(&self, side: Side, from_eye: f64, k: usize) -> bool {
        let count = self.elements().len();
        if k + 1 >= count {
            return false;
        }
        let [own, next] = [k, k + 1].map(|k| &self.elements()[if side == Side::End { count - 1 - k } else { k }]);
        let loaded = |distance: f64| distance < from_eye + next.length * (1.0 - NEAR);
        own.section != next.section || self.model.loads_from(side).any(loaded)
    }

    /// Returns the rate of a reel for a step of length `h` (s).
    pub(super) fn plan(&self, side: Side, reel: &Reel, winding: &Winding, h: f64) -> Plan {
        let (rate, asked, a) = (winding.extent[1], reel.asked(self.time()), reel.acceleration);
        if rate == 0.0 && asked == 0.0 {
            return Plan { acceleration: 0.0, stopped: false };
        }
        // the way to brake from r in steps is at most r^2/2a + a h^2/8, and h r passes before
        let r = rate.abs().max(asked.abs());
        let enough = r * (0.5 * r / a + h) + a * h * h;
        let left = [self.left(side, enough), self.left_of_stock(reel)];
        let [lowest, highest] = rates(a, rate, left, h);
        let wanted = asked.clamp(rate - a * h, rate + a * h);
        let end = wanted.clamp(lowest, highest);
        Plan { acceleration: (end - rate) / h, stopped: end != wanted }
    }

    /// Returns the length in m that is left of the stock.
    fn left_of_stock(&self, reel: &Reel) -> f64 {
        let stock = reel.stock.filter(|_| reel.feed != Feed::Sheave);
        stock.map_or(f64::INFINITY, |stock| stock - self.length())
    }

    /// Returns what drives a reel whose rate is an unknown, for a part of a host step, of length `h` (s).
    pub(super) fn law(&self, side: Side, reel: &Reel, winding: &Winding, h: f64) -> Option<Law> {
        let [length, rate, _] = winding.extent;
        let in_island = reel.needs_island();
        let limit = reel.max_force.or(in_island.then_some(0.0))?;
        // what was as strong as it must be had no limit
        let held = |force| MotorState { commanded: rate, limit: f64::INFINITY, force, excess: 0.0 };
        let before = winding.motor.or(winding.pull.map(held)).filter(|_| !in_island);
        let motor = Motor {
            limits: [before.map_or(limit, |before| before.limit_before(limit)), limit],
            duration: h,
            wheel: if reel.feed == Feed::Sheave { 0.0 } else { reel.inertia },
            asked: reel.asked(self.time()),
            acceleration: if in_island { STOP } else { reel.acceleration },
            before: before.or((!in_island).then_some(MotorState { commanded: rate, limit, force: 0.0, excess: 0.0 })),
            bounds: [length - self.left(side, f64::INFINITY), length + self.left_of_stock(reel)],
        };
        Some(Law::new(motor, self.time()))
    }
}
