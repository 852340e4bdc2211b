//! Whether the twist of a segment was followed, where shapes are tried far from each other.
//!
//! # Equation
//!
//! Directors u of the first hold and v of the last go with them by smallest rotations from shape to
//! shape. The twist that the curve has added is then, modulo a full turn,
//!
//! ```text
//! Phi - Phi0 = angle from u, carried along the curve, to v - (sum det/6 - sum det0/6)
//! ```
//!
//! ([`curve`](super::curve)), whatever slipped between the shapes and was turned back.

use super::curve::{Curve, rotated};
use crate::scales::effect::LOST_TWIST;
use core::f64::consts::{PI, TAU};
use nalgebra::Vector3;

/// The directors of both holds, and what was added since the first shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Check {
    directors: [Vector3<f64>; 2],
    along: [Vector3<f64>; 2],
    det: f64,
    /// Twist in rad.
    added: f64,
    slips: u64,
}

impl Check {
    /// Begins with a shape.
    pub fn of(curve: &Curve) -> Self {
        let along = curve.ends();
        let first = Vector3::ith(along[0].iamin(), 1.0).cross(&along[0]);
        let (last, _, det) = curve.carry(first);
        Check { directors: [first, last], along, det, added: 0.0, slips: 0 }
    }

    /// Goes on to the next shape, by what the curve adds to the twist and how many pairs slip.
    pub fn follow(&mut self, curve: &Curve, (added, slips): (f64, u64)) {
        let along = curve.ends();
        for ((director, from), to) in self.directors.iter_mut().zip(&self.along).zip(&along) {
            *director = rotated(*director, from, to);
        }
        (self.along, self.added, self.slips) = (along, self.added + added, self.slips + slips);
    }

    /// Returns how many pairs slipped, if the twist is another one for it at the shape of the last
    /// [`follow`](Self::follow).
    pub fn lost(&self, curve: &Curve) -> u64 {
        let (carried, axis, det) = curve.carry(self.directors[0]);
        let angle = carried.cross(&self.directors[1]).dot(&axis).atan2(carried.dot(&self.directors[1]));
        let off = self.added - (angle - (det - self.det));
        let off = (off + PI).rem_euclid(TAU) - PI;
        if off.abs() > LOST_TWIST { self.slips } else { 0 }
    }
}
