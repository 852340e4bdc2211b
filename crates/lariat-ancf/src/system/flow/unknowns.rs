//! The unknown rates of a system of cables: of reels with a [motor](super::law) and of [sheaves](super::wheel).
//!
//! # Solution
//!
//! The forces of all are linear in the increments of all accelerations; the laws are met by projected Gauss-Seidel iteration, one reel or
//! sheave after the other.

use super::Flows;
use super::law::Law;
use super::wheel::{Pulls, Wheel};

/// Most sweeps over several reels and sheaves.
const SWEEPS: usize = 1000;
/// Change of an acceleration in m/s^2 that ends the sweeps.
const SMALL: f64 = 1e-12;

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
    /// Cable and flow of each.
    pub reels: Vec<(usize, usize)>,
    /// By reel and cable, c and then y; by reel, the rows of bodies.
    pub columns: Vec<Vec<Vec<f64>>>,
    pub rows: Vec<Vec<f64>>,
    /// Sheaves, each with two of the reels.
    pub wheels: Vec<Wheel>,
    /// A buffer.
    pub saved: Vec<f64>,
    list: Vec<Unknown>,
    stiffness: Vec<f64>,
    /// Increments of the accelerations.
    pub increments: Vec<f64>,
}

impl Unknowns {
    /// Lists the unknowns of cables, each with its equations.
    pub fn begin<'a>(&mut self, cables: impl ExactSizeIterator<Item = &'a Flows>) {
        self.reels.clear();
        let count = cables.len();
        for (c, flows) in cables.enumerate() {
            for (k, flow) in flows.list.iter().enumerate().filter(|(_, flow)| flow.law.is_some()) {
                for wheel in &mut self.wheels {
                    for (end, unknown) in wheel.sheave.ends().iter().zip(&mut wheel.flows) {
                        if *end == (c, flow.side) {
                            *unknown = self.reels.len();
                        }
                    }
                }
                self.reels.push((c, k));
            }
        }
        self.columns.resize_with(self.reels.len(), Vec::new);
        self.columns.iter_mut().for_each(|column| column.resize_with(count, Vec::new));
        self.rows.resize_with(self.reels.len(), Vec::new);
    }

    /// Solves for the increments of all accelerations and adds them to the iterate. `flows` and `increment` return those of a cable,
    /// the increments of its velocity changes with all rates as they are.
    pub fn solve<'a>(&mut self, flows: impl Fn(usize) -> &'a Flows, increment: impl Fn(usize) -> &'a [f64]) {
        let count = self.reels.len();
        self.list.clear();
        self.stiffness.clear();
        for (i, &(c, k)) in self.reels.iter().enumerate() {
            let flow = &flows(c).list[k];
            let Some(law) = flow.law else { continue };
            let force = law.force + law.along_row(flow, increment(c));
            self.list.push(Unknown { law, acceleration: flow.extent.acceleration, force });
            for (j, columns) in self.columns.iter().enumerate() {
                let own = if i == j { -law.own } else { 0.0 };
                self.stiffness.push(law.along_row(flow, &columns[c]) + own);
            }
        }
        self.increments.clear();
        self.increments.resize(count, 0.0);
        let stiffness = |i: usize, j: usize| self.stiffness[i * count + j];
        solve_unknowns(&self.list, &self.wheels, stiffness, &mut self.increments);
    }
}

/// Solves for the increments of the accelerations; `stiffness` is S.
fn solve_unknowns(
    unknowns: &[Unknown],
    wheels: &[Wheel],
    stiffness: impl Fn(usize, usize) -> f64,
    increments: &mut [f64],
) {
    increments.fill(0.0);
    let of_wheel = |i: usize| wheels.iter().any(|wheel| wheel.flows.contains(&i));
    // with all increments but those of some
    let force = |increments: &[f64], i: usize, own: &[usize]| {
        let others = (0..unknowns.len()).filter(|j| !own.contains(j));
        unknowns[i].force - others.map(|j| stiffness(i, j) * increments[j]).sum::<f64>()
    };
    let sweeps = if unknowns.len() > 1 { SWEEPS } else { 1 };
    for _ in 0..sweeps {
        let mut moved = 0.0f64;
        for i in (0..unknowns.len()).filter(|&i| !of_wheel(i)) {
            let unknown = &unknowns[i];
            let own = stiffness(i, i);
            let own = if own > 0.0 { own } else { f64::MIN_POSITIVE };
            let new = unknown.law.acceleration_for(unknown.acceleration, force(increments, i, &[i]), own)
                - unknown.acceleration;
            moved = moved.max((new - increments[i]).abs());
            increments[i] = new;
        }
        for wheel in wheels {
            let [a, b] = wheel.flows;
            let acceleration = unknowns[b].acceleration;
            let pulls = Pulls {
                force: [a, b].map(|i| force(increments, i, &wheel.flows)),
                stiffness: [a, b].map(|i| stiffness(i, b) - stiffness(i, a)),
                acceleration,
            };
            let new = wheel.acceleration_for(&pulls) - acceleration;
            moved = moved.max((new - increments[b]).abs());
            (increments[a], increments[b]) = (-new, new);
        }
        if moved <= SMALL {
            break;
        }
    }
}
