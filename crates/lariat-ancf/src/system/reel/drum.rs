//! A drum that is a body: the rate of a reel is its spin, and it feels the pull of the cable.
//!
//! # Equation
//!
//! With the radius R, the axis a and the spins w of the drum and of the body that holds the eye, if
//! one does, the rate of the reel and the torques on drum and holder are
//!
//! ```text
//! l' = R a.(w - w_h)        R a T        -R a T        T = F - m l''
//! ```
//!
//! F is the [pull](super::work), m the mass of the stock on the drum and what else turns with the
//! rate. Over a step of the discrete gradient `D l = h R a_m.(w^ - w_h^)` with the means of the
//! [bodies](crate::island::RigidBody) and the normed mean of the axis, so what the cable gives the
//! bodies take to rounding. The rate at the beginning of a step is that of the spins; that at the
//! end of the one before differs from it by second differences, and the momentum of the element
//! goes on from that.
//!
//! # Solution
//!
//! The acceleration a of the length follows from the bodies. In the linear equations of a Newton
//! iteration it and T are two unknowns with columns of their own, eliminated together:
//!
//! ```text
//! x = x_0 - y da - z dT        da = s.x        T + dT = F(x, da) - m l''
//! ```
//!
//! At the end of the cable da is that of the stop, and T what that takes.
//!
//! # Validity
//!
//! One layer: the radius is constant. The stock has inertia against the rate alone, no angular
//! momentum with the holder. The moment of the cable about the drum acts through its bearing: the
//! force on the holder is at the eye.
//!
//! # Alternatives considered
//!
//! A rate that follows the spin of the step before: it makes energy with a light drum.

use super::FeedElement;
use crate::element::side::Side;
use crate::one_leg::OneLeg;
use crate::term::{Account, Balance};
use nalgebra::Vector3;

/// A drum in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Winch {
    /// Cable and end.
    pub end: (usize, Side),
    /// Indices of the drum and of the body that holds the eye.
    pub bodies: [Option<usize>; 2],
    /// Axis in the axes of the drum.
    pub axis: Vector3<f64>,
    /// Radius in m.
    pub radius: f64,
    /// Radius times mean axis of the iterate, in m.
    pub arm: Vector3<f64>,
    /// T of the iterate in N.
    pub force: f64,
    /// T of the last accepted step in N, with which the next begins.
    accepted: f64,
    /// Unknown of its feed.
    pub reel: usize,
    /// Sign of the stop at which it is, or 0.
    pub(super) stop: f64,
}

impl Winch {
    /// Creates that of a drum; `force` in N is a first guess.
    pub fn new(end: (usize, Side), bodies: [Option<usize>; 2], axis: Vector3<f64>, radius: f64, force: f64) -> Self {
        Winch { end, bodies, axis, radius, arm: axis * radius, force, accepted: force, reel: 0, stop: 0.0 }
    }

    /// Begins a step: nothing is left of one that failed.
    pub fn begin(&mut self) {
        (self.force, self.stop) = (self.accepted, 0.0);
    }

    /// Makes the iterate the last step.
    pub fn accept(&mut self) {
        self.accepted = self.force;
    }

    /// Returns bodies and signs.
    fn signs(&self) -> impl Iterator<Item = (usize, f64)> {
        self.bodies.into_iter().zip([1.0, -1.0]).filter_map(|(body, sign)| Some((body?, sign)))
    }

    /// Adds the angular impulse of T = `force` (N) over `h` (s) to the rows of the bodies.
    pub fn pass(&self, force: f64, h: f64, rows: &mut [f64]) {
        for (body, sign) in self.signs() {
            for x in 0..3 {
                rows[6 * body + 3 + x] += sign * h * force * self.arm[x];
            }
        }
    }

    /// Returns s.x: the increment of the acceleration by increments of the bodies over a step of
    /// a length in s with a formula.
    pub(super) fn turned(&self, rows: &[f64], (h, leg): (f64, OneLeg)) -> f64 {
        let along = |body: usize| (0..3).map(|x| self.arm[x] * rows[6 * body + 3 + x]).sum::<f64>();
        2.0 * leg.b / h * self.signs().map(|(body, sign)| sign * along(body)).sum::<f64>()
    }

    /// Adds to a balance by how much the iterate breaks the law.
    pub fn add_balance(&self, feed: &FeedElement, balance: &mut Balance) {
        let pull = feed.pull_of_iterate();
        let beyond = self.force - pull;
        // a stop that opposes what goes beyond it
        let entry = balance.to(Account::Reels);
        entry.missed += if self.stop * beyond < 0.0 { 0.0 } else { beyond.abs() };
        entry.forces += pull.abs();
    }
}

/// The coefficients of the two unknowns of a drum, and what the others leave of both equations.
pub(super) struct Pair {
    pub spin: f64,
    pub force: f64,
    /// s.y and s.z, with the sign of the columns.
    pub turned: [f64; 2],
    /// Derivatives of the pull, with the sign of the columns.
    pub stiffness: [f64; 2],
}

impl Pair {
    /// Returns the increments of acceleration and T, and the sign of a stop.
    pub fn solve(&self, stop: impl Fn(f64) -> Option<f64>) -> ([f64; 2], f64) {
        let ([p, q], [s, t]) = (self.turned, self.stiffness);
        let determinant = (1.0 + p) * (1.0 + t) - q * s;
        let x = ((1.0 + t) * self.spin - q * self.force) / determinant;
        let free = [x, ((1.0 + p) * self.force - s * self.spin) / determinant];
        match stop(x) {
            Some(x) if q != 0.0 => ([x, (self.spin - (1.0 + p) * x) / q], (free[0] - x).signum()),
            _ => (free, 0.0),
        }
    }
}
