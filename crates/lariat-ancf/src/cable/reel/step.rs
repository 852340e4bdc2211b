//! The reels of a cable in a part of a host step, in which little material passes the eye.

use crate::cable::Cable;
use crate::element::side::Side;
use crate::element::variable_length::Extent;
use crate::error::{Error, require};
use crate::integrate::OneStep;
use crate::reel::{Feed, Reel};
use crate::scales::reel::{LARGEST_SHARE, MOST_PARTS, MOST_PARTS_OF_WAVE, PASSING, PLANNED_SHARE, STANDING_RATE};

impl Cable {
    /// Returns the number of parts in which a host step of `dt` (s) is to be taken; 1 without a
    /// reel.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a rate that needs more than 1e5.
    pub(crate) fn reel_parts(&self, dt: f64) -> Result<usize, Error> {
        let mut most = 1.0;
        for side in self.model.reels.sides() {
            let full = self.model.reels.least_length();
            let parts = |rate: f64| (rate * dt / (PASSING * full)).ceil();
            let has_law = self.model.reels.get(side).is_some_and(Reel::has_law);
            // what an unknown rate gains in a wave is over soon
            let (rate, fastest) = (self.rate(side).abs(), self.fastest_rate(side, dt));
            let parts = if has_law { parts(rate).max(parts(fastest).min(MOST_PARTS_OF_WAVE)) } else { parts(fastest) };
            require("parts of a host step for the rate of its reel", parts, parts <= MOST_PARTS, "<= 1e5")
                .map_err(|e| e.of_cable(self.name()))?;
            most = f64::max(most, parts);
        }
        Ok(most as usize)
    }

    /// Returns whether the rate of a reel in the coming `dt` (s) is planned already.
    pub(crate) fn is_reel_planned(&self, dt: f64) -> bool {
        let plans = self.snapshot.windings.iter().flatten().filter_map(|winding| winding.plan);
        plans.into_iter().any(|plan| plan.left(self.time(), dt).is_some())
    }

    /// Sets the rates of the reels for a part of length `h` (s).
    pub(crate) fn begin_reel(&mut self, h: f64) {
        if !self.has_reel() {
            return;
        }
        self.sync_reel();
        for k in 0..self.system.feeds.list.len() {
            let side = self.system.feeds.list[k].side;
            let (Some(reel), Some(winding)) = (self.model.reels.get(side), &self.snapshot.windings[side as usize])
            else {
                continue;
            };
            let planned = winding.plan.and_then(|plan| Some((plan, plan.left(self.time(), h)?)));
            let left = planned.map_or(h, |(_, left)| left);
            let reach = self.system.feeds.list[k].beside.filter(|(revision, _)| *revision == self.revision);
            let law = self.law((side, reel, winding), [h, left], reach.map(|(_, reach)| reach));
            let plan = || planned.map_or_else(|| self.plan(side, reel, winding, h), |(plan, _)| plan);
            let plan = law.is_none().then(plan);
            let feed = &mut self.system.feeds.list[k];
            (feed.kind, feed.law, feed.pull) = (reel.feed, law.map(|(law, _)| law), None);
            feed.beside = law.map(|(_, reach)| (self.revision, reach));
            if let Some(plan) = plan {
                feed.extent.acceleration = plan.acceleration(feed.extent.rate, left);
                feed.stopped = plan.stopped;
            }
        }
    }

    /// Takes over what the reels did in a part, if that succeeded.
    pub(crate) fn end_reel(&mut self, succeeded: bool) {
        if !self.has_reel() {
            return;
        }
        for feed in self.system.feeds.list.iter().filter(|_| succeeded) {
            let Some(winding) = &mut self.snapshot.windings[feed.side as usize] else { continue };
            let Extent { length, rate, acceleration } = feed.at(self.snapshot.state.time);
            // braking to rest ends at rest
            let rate = if rate.abs() < STANDING_RATE { 0.0 } else { rate };
            let passed = length - winding.extent[0];
            winding.passed += passed;
            winding.extent = [length, rate, acceleration];
            winding.length_before = feed.length_before;
            winding.motor = feed.law.map(|law| law.state());
            (winding.stopped, winding.pull) = (feed.stopped, feed.pull);
            let h = self.snapshot.state.time - feed.start;
            winding.plan = winding.plan.filter(|plan| plan.left(self.snapshot.state.time, h).is_some());
            let e = feed.side.element(self.model.elements.len());
            self.model.elements[e].length = length;
        }
        if succeeded && self.model.pulled_points().next().is_some() {
            self.model.move_loads(self.snapshot.passed_at_start());
            self.system.loads.locate(&self.model);
            self.system.potentials.locate(&self.model);
        }
        self.sync_reel();
    }

    /// Checks that an island can step a cable with reels by `dt` (s); `moves` says of a node
    /// whether a body holds it that moves freely.
    ///
    /// # Errors
    /// [`Error::ReelPlace`] for an eye on a body that the cable moves, without a stock or without
    /// the discrete gradient; [`Error::FastReel`] if more than half of an element would pass the
    /// eye.
    pub(crate) fn check_reel_in_island(
        &self,
        moves: impl Fn(usize) -> bool,
        method: &dyn OneStep,
        dt: f64,
    ) -> Result<(), Error> {
        for side in self.model.reels.sides() {
            let Some(winding) = &self.snapshot.windings[side as usize] else { continue };
            if moves(side.nodes(self.nodes())[1]) {
                let refused = |reason| Err(Error::ReelPlace { cable: self.name().to_string(), reason });
                if !method.uses_discrete_gradients() {
                    return refused(
                        "its eye is on a body that moves freely, whose momentum only discrete-gradient keeps",
                    );
                }
                if self.model.reels.get(side).is_some_and(|reel| reel.stock.is_none() && reel.feed != Feed::Sheave) {
                    return refused(
                        "its eye is on a body that moves freely, whose mass changes with what is on the reel: \
                        say by `stock` how much cable there is",
                    );
                }
            }
            let full = self.model.reels.element(self.number(side.element(self.elements().len()))).length;
            let [length, ..] = winding.extent;
            // the acceleration of an unknown rate may be that of a wave, which is over soon
            let rate = if self.model.reels.get(side).is_some_and(Reel::has_law) {
                winding.extent[1].abs()
            } else {
                self.fastest_rate(side, dt)
            };
            self.require_share(rate * dt / full)?;
            let share = length / full;
            require("length of the element at the eye over its full one", share, share < 2.5, "< 2.5")
                .map_err(|e| e.of_cable(self.name()))?;
        }
        Ok(())
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn steps_of_reels(&self, dt: f64) -> f64 {
        let of_side = |side: Side| {
            let full = self.model.reels.element(self.number(side.element(self.elements().len()))).length;
            let length = self.snapshot.windings[side as usize].as_ref().map_or(full, |winding| winding.extent[0]);
            self.fastest_rate(side, dt) * dt / (PLANNED_SHARE * full.min(length))
        };
        self.model.reels.sides().map(of_side).fold(0.0, f64::max)
    }

    /// Checks, after a step of an island of `dt` (s) failed, that its reels had not to move more
    /// than half of the element at the eye, of its full or its present length: an unknown rate may
    /// grow within the step.
    ///
    /// # Errors
    /// [`Error::FastReel`].
    pub(crate) fn check_reach_of_reels(&self, dt: f64) -> Result<(), Error> {
        for feed in &self.system.feeds.list {
            let Some(winding) = &self.snapshot.windings[feed.side as usize] else { continue };
            let full = self.model.reels.element(self.number(feed.side.element(self.elements().len()))).length;
            let [length, rate, _] = winding.extent;
            let moved = feed.at(self.snapshot.state.time).length - length;
            let passing = moved.abs().max(rate.abs() * dt);
            self.require_share(passing / full.min(length))?;
        }
        Ok(())
    }

    /// Refuses a share of an element that is more than half.
    fn require_share(&self, share: f64) -> Result<(), Error> {
        let most = LARGEST_SHARE;
        // a share that is not a number is none
        let fits = share <= most;
        if fits { Ok(()) } else { Err(Error::FastReel { cable: self.name().to_string(), share, most }) }
    }

    /// Notes at which eyes the stock rides with a body; `moves` as above.
    pub(crate) fn set_riding_stock(&mut self, moves: impl Fn(usize) -> bool) {
        let nodes = self.nodes();
        for side in Side::BOTH {
            if let Some(winding) = &mut self.snapshot.windings[side as usize] {
                winding.rides = moves(side.nodes(nodes)[1]);
            }
        }
    }

    /// Lets the stock at the eye at a node ride with a body.
    pub(crate) fn add_riding_stock(&mut self, node: usize) {
        let nodes = self.nodes();
        let at_eye = Side::BOTH.into_iter().filter(|side| side.nodes(nodes)[1] == node);
        for side in at_eye {
            if let Some(winding) = &mut self.snapshot.windings[side as usize] {
                winding.rides = true;
            }
        }
        self.sync_reel();
    }

    /// Returns the rate in m/s of a reel.
    fn rate(&self, side: Side) -> f64 {
        self.snapshot.windings[side as usize].as_ref().map_or(0.0, |winding| winding.extent[1])
    }

    /// Returns the largest rate in m/s of a reel in the coming `dt` (s).
    fn fastest_rate(&self, side: Side, dt: f64) -> f64 {
        let (Some(reel), Some(winding)) = (self.model.reels.get(side), &self.snapshot.windings[side as usize]) else {
            return 0.0;
        };
        let rate = winding.extent[1].abs();
        if reel.has_law() {
            return rate + winding.extent[2].abs() * dt;
        }
        let rows = reel.rate.iter().filter(|row| row[0] > self.time() && row[0] < self.time() + dt);
        let asked = rows.map(|row| row[1].abs()).fold(reel.asked(self.time(), None).abs(), f64::max);
        rate.max(asked.min(rate + reel.acceleration * dt))
    }
}
