//! The unknown rates of a system of cables: of reels with a [motor](super::law) and of
//! [sheaves](super::wheel).
//!
//! # Solution
//!
//! The forces of all are linear in the increments of all accelerations; the laws are met by
//! projected Gauss-Seidel iteration, one reel, sheave or [drum](super::drum) after the other.

use super::Feeds;
use super::drum::{Pair, Winch};
use super::graph::Line;
use super::law::Law;
use super::wheel::Wheel;
use crate::one_leg::OneLeg;
use crate::scales::reel::{SMALL, SWEEPS};

/// A reel in the linear equations of an iteration.
#[derive(Clone, Copy, Debug)]
struct Unknown {
    law: Law,
    /// Acceleration of the iterate.
    acceleration: f64,
    /// Force of the motor after the increment of all velocities.
    force: f64,
}

/// The unknown rates of a system of cables, and the columns of its linear equations.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unknowns {
    /// Cable and feed of each.
    pub reels: Vec<(usize, usize)>,
    /// By reel and cable, c and then y; by reel, the rows of bodies. Behind those of the reels,
    /// those of the drums.
    pub columns: Vec<Vec<Vec<f64>>>,
    pub rows: Vec<Vec<f64>>,
    /// Sheaves, each with two of the reels.
    pub wheels: Vec<Wheel>,
    /// Drums, each with one of the reels.
    pub winches: Vec<Winch>,
    list: Vec<Unknown>,
    stiffness: Vec<f64>,
    /// By drum, what increments turn it by: with all rates as they are, then by column.
    pub(super) turned: Vec<f64>,
    /// By drum, the sign of the stop at which it is.
    pub(super) stops: Vec<f64>,
    /// Increments of the accelerations, then of the forces of the drums.
    pub increments: Vec<f64>,
}

impl Unknowns {
    /// Lists the unknowns of cables, each with its equations and the forces of its motors; where
    /// all of these stick, no rate is unknown.
    pub fn begin<'a>(&mut self, cables: impl ExactSizeIterator<Item = &'a Feeds>) {
        self.reels.clear();
        let (count, mut stick) = (cables.len(), self.winches.is_empty());
        for (c, feeds) in cables.enumerate() {
            stick &= feeds.stick();
            for (k, feed) in feeds.list.iter().enumerate().filter(|(_, feed)| feed.law.is_some()) {
                for wheel in &mut self.wheels {
                    for (end, unknown) in wheel.sheave.ends().iter().zip(&mut wheel.feeds) {
                        if *end == (c, feed.side) {
                            *unknown = self.reels.len();
                        }
                    }
                }
                for winch in self.winches.iter_mut().filter(|winch| winch.end == (c, feed.side)) {
                    winch.reel = self.reels.len();
                }
                self.reels.push((c, k));
            }
        }
        let unknowns = self.reels.len() + self.winches.len();
        self.columns.resize_with(unknowns, Vec::new);
        self.columns.iter_mut().for_each(|column| column.resize_with(count, Vec::new));
        self.rows.resize_with(unknowns, Vec::new);
        if stick {
            self.reels.clear();
        }
    }

    /// Computes what increments of the bodies turn the drums by: `rows` are those with all rates as
    /// they are.
    pub(super) fn turn_drums(&mut self, rows: &[f64], step: (f64, OneLeg)) {
        self.turned.clear();
        for winch in &self.winches {
            self.turned.push(winch.turned(rows, step));
            self.turned.extend(self.rows.iter().map(|column| winch.turned(column, step)));
        }
    }

    /// Adds the increments of T to the iterate.
    pub fn add_to_drums(&mut self) {
        let count = self.reels.len();
        for (k, winch) in self.winches.iter_mut().enumerate() {
            winch.force += self.increments[count + k];
            winch.stop = self.stops[k];
        }
    }

    /// Solves for the increments of all accelerations and adds them to the iterate. `feeds` and
    /// `increment` return those of a cable, the increments of its velocity changes with all rates
    /// as they are; `rows` are those of the bodies over a step of a length in s with a formula.
    pub fn solve<'a>(
        &mut self,
        feeds: impl Fn(usize) -> &'a Feeds,
        increment: impl Fn(usize) -> &'a [f64],
        (rows, step): (&[f64], (f64, OneLeg)),
    ) {
        let count = self.columns.len();
        self.turn_drums(rows, step);
        self.list.clear();
        self.stiffness.clear();
        for (i, &(c, k)) in self.reels.iter().enumerate() {
            let feed = &feeds(c).list[k];
            let Some(law) = feed.law else { continue };
            let force = law.force + law.along_row(feed, increment(c));
            self.list.push(Unknown { law, acceleration: feed.extent.acceleration, force });
            for (j, columns) in self.columns.iter().enumerate() {
                let own = if i == j { -law.own } else { 0.0 };
                self.stiffness.push(law.along_row(feed, &columns[c]) + own);
            }
        }
        self.increments.clear();
        self.increments.resize(count, 0.0);
        self.stops.clear();
        self.stops.resize(self.winches.len(), 0.0);
        let mut increments = core::mem::take(&mut self.increments);
        let mut stops = core::mem::take(&mut self.stops);
        self.solve_unknowns(&mut increments, &mut stops);
        (self.increments, self.stops) = (increments, stops);
    }

    /// Solves for the increments; at which stops drums are.
    fn solve_unknowns(&self, increments: &mut [f64], stops: &mut [f64]) {
        let Unknowns { list: unknowns, wheels, winches, turned, .. } = self;
        let count = increments.len();
        let stiffness = |i: usize, j: usize| self.stiffness[i * count + j];
        let law_of_other = |i: usize| {
            wheels.iter().any(|wheel| wheel.feeds.contains(&i)) || winches.iter().any(|winch| winch.reel == i)
        };
        // with all increments but those of some
        let without = |base: f64, increments: &[f64], own: &[usize], column: &dyn Fn(usize) -> f64| {
            base - (0..count).filter(|j| !own.contains(j)).map(|j| column(j) * increments[j]).sum::<f64>()
        };
        let force = |increments: &[f64], i: usize, own: &[usize]| {
            without(unknowns[i].force, increments, own, &|j| stiffness(i, j))
        };
        let sweeps = if unknowns.len() > 1 { SWEEPS } else { 1 };
        for _ in 0..sweeps {
            let mut moved = 0.0f64;
            for i in (0..unknowns.len()).filter(|&i| !law_of_other(i)) {
                let unknown = &unknowns[i];
                let Unknown { law, acceleration, .. } = unknown;
                let line = Line { value: force(increments, i, &[i]), stiffness: stiffness(i, i) };
                let at = law.graph.meet(*acceleration, line, &law.bound(), &[Line::default(); 2]);
                let new = law.bounded(at) - acceleration;
                moved = moved.max((new - increments[i]).abs());
                increments[i] = new;
            }
            for wheel in wheels {
                let [a, b] = wheel.feeds;
                let acceleration = unknowns[b].acceleration;
                let pulls = [a, b].map(|i| Line {
                    value: force(increments, i, &wheel.feeds),
                    stiffness: stiffness(i, b) - stiffness(i, a),
                });
                let new = wheel.acceleration_for(acceleration, &pulls) - acceleration;
                moved = moved.max((new - increments[b]).abs());
                (increments[a], increments[b]) = (-new, new);
            }
            for (k, winch) in winches.iter().enumerate() {
                let own = [winch.reel, unknowns.len() + k];
                let turned = &turned[k * (count + 1)..(k + 1) * (count + 1)];
                let pair = Pair {
                    spin: without(turned[0], increments, &own, &|j| turned[1 + j]),
                    force: force(increments, own[0], &own) - winch.force,
                    turned: own.map(|j| turned[1 + j]),
                    stiffness: own.map(|j| stiffness(own[0], j)),
                };
                let Unknown { law, acceleration, .. } = unknowns[own[0]];
                let (new, stop) = pair.solve(|x| law.graph.stop(acceleration + x).map(|end| end - acceleration));
                moved = moved.max((new[0] - increments[own[0]]).abs());
                (increments[own[0]], increments[own[1]], stops[k]) = (new[0], new[1], stop);
            }
            if moved <= SMALL {
                break;
            }
        }
    }
}
