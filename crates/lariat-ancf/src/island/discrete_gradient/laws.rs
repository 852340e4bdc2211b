//! Reels whose rate is unknown, sheaves and drums of the cables of an island in a step of the
//! discrete gradient. Equations: `system/reel/law.rs`, `wheel.rs` and `drum.rs`.

use super::super::hold::vector;
use super::body::BodyStep;
use super::{IslandStep, StepBuffers};
use crate::cable::Cable;
use crate::element::side::Side;
use crate::system::{CableStep, FeedElement, Unknowns, Wheel, Winch};
use crate::term::Balance;
use nalgebra::Vector3;

/// Returns the feed at an end of a cable.
fn feed_at<'a>(cables: &'a mut [&mut Cable], (cable, side): (usize, Side)) -> Option<&'a mut FeedElement> {
    cables[cable].system.feeds.list.iter_mut().find(|feed| feed.side == side)
}

impl IslandStep<'_, '_> {
    /// Returns the feeds at a sheave.
    fn feeds(&self, wheel: &Wheel) -> Option<[FeedElement; 2]> {
        let of = |(cable, side): (usize, Side)| self.cables[cable].system.feeds.at_side(side).copied();
        let [a, b] = wheel.sheave.ends();
        Some([of(a)?, of(b)?])
    }

    /// Begins a step of length `h` (s) for sheaves: both feeds at one have opposite rates.
    pub(super) fn begin_wheels(&mut self, h: f64) {
        for w in 0..self.buffers.unknowns.wheels.len() {
            let mut wheel = self.buffers.unknowns.wheels[w];
            let Some([a, b]) = self.feeds(&wheel) else { continue };
            let tangents = wheel.sheave.ends().map(|(cable, side)| {
                let local = side.gather(self.cables[cable].positions());
                [local[9], local[10], local[11]]
            });
            let (cable, side) = wheel.sheave.ends()[1];
            let model = &self.cables[cable].model;
            let inertia = model.inertia(&model.elements[side.element(model.elements.len())]);
            let acceleration = wheel.begin([&a, &b], tangents, inertia, h);
            let rate = b.extent.rate;
            for ((cable, side), sign) in wheel.sheave.ends().into_iter().zip([-1.0, 1.0]) {
                if let Some(feed) = feed_at(self.cables, (cable, side)) {
                    (feed.extent.rate, feed.extent.acceleration) = (sign * rate, sign * acceleration);
                }
            }
            self.buffers.unknowns.wheels[w] = wheel;
        }
    }

    /// Begins a step of length `h` (s) for drums: reels have the rates of their spins.
    pub(super) fn begin_drums(&mut self, h: f64) {
        let (cables, StepBuffers { unknowns, bodies, .. }) = (&mut *self.cables, &mut *self.buffers);
        for winch in &mut unknowns.winches {
            winch.begin();
            let [drum, holder] = winch.bodies.map(|body| body.map(|body| &bodies[body]));
            let spin = |body: Option<&BodyStep>| body.map_or_else(Vector3::zeros, BodyStep::spin);
            let arm = drum.map_or(winch.axis, |drum| drum.ends(&winch.axis)[0]) * winch.radius;
            if let Some(feed) = feed_at(cables, winch.end) {
                feed.restart(arm.dot(&(spin(drum) - spin(holder))), h);
            }
        }
    }

    /// Sets the accelerations of reels on drums to those of the iterate of the bodies.
    pub(super) fn follow_drums(&mut self) {
        let (cables, StepBuffers { unknowns, bodies, .. }) = (&mut *self.cables, &mut *self.buffers);
        for winch in &mut unknowns.winches {
            let h = cables[winch.end.0].step_buffers.h;
            let [drum, holder] = winch.bodies.map(|body| body.map(|body| &bodies[body]));
            let spin = |body: Option<&BodyStep>| body.map_or_else(Vector3::zeros, |body| body.mean[1]);
            let [first, last] = drum.map_or([winch.axis; 2], |drum| drum.ends(&winch.axis));
            winch.arm = (first + last).try_normalize(f64::MIN_POSITIVE).unwrap_or(first) * winch.radius;
            let rate = winch.arm.dot(&(spin(drum) - spin(holder)));
            if let Some(feed) = feed_at(cables, winch.end) {
                feed.follow(2.0 * (rate - feed.extent.rate) / h);
            }
        }
    }

    /// Linearises the laws of reels whose rate is unknown, and solves for their columns.
    pub(super) fn linearise_laws(&mut self) {
        let mut unknowns = core::mem::take(&mut self.buffers.unknowns);
        unknowns.begin(self.cables.iter().map(|cable| &cable.system.feeds));
        for cable in self.cables.iter_mut().filter(|_| !unknowns.reels.is_empty()) {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            equations.read_motors(state, buffers);
        }
        let Unknowns { reels, columns, rows, winches, .. } = &mut unknowns;
        let (of_reels, of_winches) = columns.split_at_mut(reels.len());
        let (rows_of_reels, rows_of_winches) = rows.split_at_mut(reels.len());
        for ((&(c, k), columns), rows) in reels.iter().zip(of_reels).zip(rows_of_reels) {
            self.solve_columns(columns, rows, |island, columns, rows| {
                let CableStep { mut equations, state, buffers } = island.cables[c].step_parts();
                equations.linearise_law(k, state, buffers, &mut columns[c]);
                for hold in &island.buffers.cables[c].holds {
                    hold.pass(&vector(&columns[c][hold.at..]), rows);
                }
            });
        }
        for ((winch, columns), rows) in winches.iter().zip(of_winches).zip(rows_of_winches) {
            self.solve_columns(columns, rows, |island, _, rows| {
                winch.pass(-1.0, island.cables[0].step_buffers.h, rows);
            });
        }
        self.buffers.unknowns = unknowns;
    }

    /// Solves the linear equations for the right-hand sides that `fill` makes of zeros, in place.
    pub(super) fn solve_columns(
        &mut self,
        columns: &mut [Vec<f64>],
        rows: &mut Vec<f64>,
        fill: impl FnOnce(&mut Self, &mut [Vec<f64>], &mut [f64]),
    ) {
        for (cable, column) in self.cables.iter().zip(columns.iter_mut()) {
            column.clear();
            column.resize(cable.positions().len(), 0.0);
        }
        rows.clear();
        rows.resize(self.buffers.rows.len(), 0.0);
        fill(self, columns, rows);
        self.swap(columns, rows);
        self.solve();
        self.swap(columns, rows);
    }

    /// Exchanges the right-hand sides of cables and bodies with others.
    fn swap(&mut self, columns: &mut [Vec<f64>], rows: &mut Vec<f64>) {
        for (cable, column) in self.cables.iter_mut().zip(columns) {
            core::mem::swap(&mut cable.step_buffers.rhs, column);
        }
        core::mem::swap(&mut self.buffers.rows, rows);
    }

    /// Solves for the rates of reels that are unknown, and completes the increments.
    pub(super) fn add_to_laws(&mut self) {
        let (cables, StepBuffers { unknowns, rows, .. }) = (&mut *self.cables, &mut *self.buffers);
        if unknowns.reels.is_empty() {
            return;
        }
        let first = &cables[0].step_buffers;
        let step = (first.h, first.leg);
        unknowns.solve(|c| &cables[c].system.feeds, |c| &cables[c].step_buffers.rhs, (rows, step));
        unknowns.add_to_drums();
        for (i, &increment) in unknowns.increments.iter().enumerate() {
            if let Some(&(c, k)) = unknowns.reels.get(i) {
                cables[c].step_parts().equations.add_to_law(k, increment);
            }
            let own = cables.iter_mut().map(|cable| &mut cable.step_buffers.rhs);
            for (x, y) in own.zip(&unknowns.columns[i]).chain(core::iter::once((&mut *rows, &unknowns.rows[i]))) {
                x.iter_mut().zip(y).for_each(|(x, y)| *x -= increment * y);
            }
        }
    }

    /// Adds to a balance by how much the iterate breaks the laws of sheaves.
    pub(super) fn balance_wheels(&self, balance: &mut Balance) {
        for wheel in &self.buffers.unknowns.wheels {
            if let Some([a, b]) = self.feeds(wheel) {
                let step = (self.cables[0].time(), self.cables[0].step_buffers.h);
                wheel.add_balance([&a, &b], step, balance);
            }
        }
        for winch in &self.buffers.unknowns.winches {
            let (cable, side) = winch.end;
            if let Some(feed) = self.cables[cable].system.feeds.at_side(side) {
                winch.add_balance(feed, balance);
            }
        }
    }

    /// Returns whether friction stops a sheave that runs when the step begins.
    pub(super) fn do_sheaves_stop(&self) -> bool {
        let stops = |wheel: &Wheel| self.feeds(wheel).is_some_and(|[a, b]| wheel.stops([&a, &b]));
        self.buffers.unknowns.wheels.iter().any(stops)
    }

    /// Adds the accepted step to what ran over sheaves, and notes the forces of drums.
    pub(super) fn accept_wheels(&mut self) {
        self.buffers.unknowns.winches.iter_mut().for_each(Winch::accept);
        for w in 0..self.buffers.unknowns.wheels.len() {
            let mut wheel = self.buffers.unknowns.wheels[w];
            if let Some([a, b]) = self.feeds(&wheel) {
                wheel.accept([&a, &b], self.cables[0].time(), self.cables[0].step_buffers.h);
            }
            self.buffers.unknowns.wheels[w] = wheel;
        }
    }
}
