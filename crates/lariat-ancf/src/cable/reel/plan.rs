//! The rate of a reel over a step: as its table asks, with a limit on acceleration, and to a soft
//! stop at the ends.
//!
//! # Equation
//!
//! The rate is linear within a host step of length h, and so is the rate that a motor is commanded;
//! the bounds of its end are those of [`rates`]. A host step that is taken in several steps is
//! planned once, when it begins; where the table has a row in it, each of its steps is planned by
//! itself. A step ends with the rate that the table gives from the time of the row on, so that it
//! does not matter on which side of the end of a step rounding has a row.
//!
//! # Alternatives considered
//!
//! A plan for every step: what is asked for is reached within the first one. At 60 to 120 Hz in
//! steps of 1/240 s a sine of the rate was followed by a staircase, and a pendulum whose length has
//! that rate was off by up to 2e-3 of its length in 10 s.

use super::winding::{Plan, Winding};
use crate::cable::Cable;
use crate::element::side::Side;
use crate::reel::{Feed, Reel};
use crate::scales::SAME;
use crate::scales::reel::{LEAST, RIGID, STOP};
use crate::system::{Law, Motor, MotorState, rates, towards};

impl Cable {
    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn plan_reels(&mut self, dt: f64) {
        let (begin, end) = (self.time(), self.time() + dt);
        let within = |row: &[f64; 2]| row[0] > begin && row[0] < end;
        for side in self.model.reels.sides() {
            let (Some(reel), Some(winding)) = (self.model.reels.get(side), &self.snapshot.windings[side as usize])
            else {
                continue;
            };
            let plan = (!reel.rate.iter().any(within)).then(|| self.plan(side, reel, winding, dt));
            self.snapshot.windings[side as usize].iter_mut().for_each(|winding| winding.plan = plan);
        }
    }

    /// Returns the length in m that the reel of an end can take in beside the element at the eye:
    /// up to the next held node, element with a load or of another section, or at another eye, less
    /// the least element; or a length with which that element makes more than `enough` (m), and
    /// less than that.
    fn reach(&self, side: Side, enough: f64) -> f64 {
        let (model, count) = (&self.model, self.elements().len());
        let element = |k: usize| if side == Side::End { count - 1 - k } else { k };
        let least = |e: usize| LEAST * model.reels.element(self.number(e)).length;
        let two = model.reels.sides().count() > 1;
        let own = model.elements[element(0)].length;
        let (mut beside, mut last) = (0.0, 0);
        for k in 0..count {
            last = element(k);
            beside += if k > 0 { model.elements[last].length } else { 0.0 };
            let far = if side == Side::End { last } else { last + 1 };
            let held = model.support(far).is_some() || self.keeps_node_behind(side, own + beside, k);
            if own + beside - least(last) > enough || held || two && k + 2 == count {
                break;
            }
        }
        beside - least(last)
    }

    /// Returns the length in m that the reel of an end can take in, or one that is more than
    /// `enough` (m) and less than that.
    fn left(&self, side: Side, enough: f64) -> f64 {
        self.elements()[side.element(self.elements().len())].length + self.reach(side, enough)
    }

    /// Returns whether the far node of element number `k` from the eye, `from_eye` m from there,
    /// has to stay: because the next element is of another section, or has a point load on it, but
    /// at its own far node.
    pub(super) fn keeps_node_behind(&self, side: Side, from_eye: f64, k: usize) -> bool {
        let count = self.elements().len();
        if k + 1 >= count {
            return false;
        }
        let [own, next] = [k, k + 1].map(|k| &self.elements()[if side == Side::End { count - 1 - k } else { k }]);
        let loaded = |distance: f64| distance < from_eye + next.length * (1.0 - SAME);
        own.section != next.section || self.model.loads_from(side).any(loaded)
    }

    /// Returns the rate of a reel for a host step of length `h` (s).
    pub(super) fn plan(&self, side: Side, reel: &Reel, winding: &Winding, h: f64) -> Plan {
        let way = self.way(side, reel);
        let plan = Plan { begin: self.time(), end: self.time() + h, rate: 0.0, stopped: false };
        let (rate, a) = (winding.extent[1], reel.acceleration);
        let asked = reel.wanted(rate, [plan.begin, plan.end], way);
        if reel.has_law() || rate == 0.0 && asked == 0.0 {
            return plan;
        }
        // the way to brake from r in steps is at most r^2/2a + a h^2/8, and h r passes before
        let r = rate.abs().max(asked.abs());
        let enough = r * (0.5 * r / a + h) + a * h * h;
        let left = [self.left(side, enough), self.left_of_stock(side, reel)];
        let [lowest, highest] = rates(a, rate, left, h);
        let limits = [rate - a * h, rate + a * h];
        let wanted = way.map_or(asked, |way| towards(a, (rate, asked), (way, h), limits));
        let end = wanted.clamp(lowest, highest);
        Plan { rate: end, stopped: end != wanted, ..plan }
    }

    /// Returns how much in m the length that a reel is to come to is beyond the present one.
    pub(super) fn way(&self, side: Side, reel: &Reel) -> Option<f64> {
        reel.to_length.filter(|_| !reel.needs_island()).map(|length| length - self.out(side))
    }

    /// Returns the length in m that is left of the stock.
    fn left_of_stock(&self, side: Side, reel: &Reel) -> f64 {
        let stock = reel.stock.filter(|_| reel.feed != Feed::Sheave);
        stock.map_or(f64::INFINITY, |stock| stock - self.out(side))
    }

    /// Returns what drives a reel whose rate is an unknown, for a part of a host step, of length
    /// `h` (s); so much in s is left of that. `reach` is what it can take in beside the element at
    /// the eye, if that is known.
    pub(super) fn law(
        &self,
        (side, reel, winding): (Side, &Reel, &Winding),
        [h, host]: [f64; 2],
        reach: Option<f64>,
    ) -> Option<(Law, f64)> {
        let [length, rate, _] = winding.extent;
        let in_island = reel.needs_island();
        let limit = reel.max_force.or(in_island.then_some(0.0))?;
        // what was as strong as it must be had no limit
        let held = |force| MotorState { commanded: rate, limit: f64::INFINITY, force, excess: 0.0 };
        let before = winding.motor.or(winding.pull.map(held)).filter(|_| !in_island);
        let reach = reach.unwrap_or_else(|| self.reach(side, f64::INFINITY));
        let way = self.way(side, reel);
        let commanded = before.map_or(rate, |before| before.commanded);
        let asked = reel.wanted(commanded, [self.time(), self.time() + host], way);
        let motor = Motor {
            limits: [before.map_or(limit, |before| before.limit_before(limit)), limit],
            duration: h,
            host,
            wheel: if reel.feed == Feed::Sheave { 0.0 } else { reel.inertia },
            asked,
            acceleration: if in_island { STOP } else { reel.acceleration },
            stop: if in_island { STOP } else { RIGID },
            target: way.map(|way| length + way),
            before: before.or((!in_island).then_some(MotorState { commanded: rate, limit, force: 0.0, excess: 0.0 })),
            bounds: [-reach, length + self.left_of_stock(side, reel)],
        };
        Some((Law::new(motor, self.time()), reach))
    }
}
