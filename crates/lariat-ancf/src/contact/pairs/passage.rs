//! How a contact that lasts passes along both cables in a step.
//!
//! # Equation
//!
//! The closest points move along the cables, from s0 when the step begins to s1 when it ends, while
//! the contact acts on the material points half way, `s = (s0 + s1)/2` on each. With y from one to
//! the other, and n across both tangents there, n turning with them,
//!
//! ```text
//! n = (y - T c)/|y - T c|,   (T^T T + e) c = T^T y,   T = (t_a, t_b) when the step begins
//! depth = r_a + r_b - |y(s0)| + n . y(s) when it begins - n . y(s) now
//! ```
//!
//! So the depth begins with the true one. What a plane through fixed points hides while strands
//! that bend slide is of second order in `s1 - s0`; from half way it is as much when the step
//! begins as when it ends, so that the depth also ends with the true one, but for the third order.
//! A depth that ended with less would be born anew in every step, and forgiven: a ratchet.
//!
//! The closest points at the end are those of the prediction.
//!
//! # Validity
//!
//! Closest points that stay on one element of each; those that leave one are held at its end, for
//! a step. Strands that bend by their radius within the slide of a step are not resolved.

use super::chords::{Piece, refine_within};
use crate::scales::contact::CENTRING;
use nalgebra::{Matrix2, Vector2, Vector3};

/// Where a contact that lasts acts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    /// Local coordinates in the elements.
    pub xi: [f64; 2],
    /// Local coordinates of the closest points when the step begins.
    pub start: [f64; 2],
    /// From the second of them to the first.
    pub apart: Vector3<f64>,
    /// Across both tangents when the step begins, from the second cable to the first.
    pub normal: Vector3<f64>,
}

impl Passage {
    /// Returns that of two elements, from the closest points that the search found on a chord of
    /// the first one.
    pub fn new(pieces: [&Piece<'_>; 2], chord: usize, found: [f64; 2]) -> Self {
        let [a, b] = pieces;
        // beside others of a strand that is parallel it stays within its chord, elsewhere near it
        let [low, high] = a.ends_of(chord);
        let beside = if found[0] > low && found[0] < high { 0.5 * (high - low) } else { 0.0 };
        let limits = [(low - beside).max(0.0), (high + beside).min(1.0)];
        let closest = |share: f64| refine_within(a, (chord, limits), b, found, share);
        let [start, end] = [closest(0.0), closest(1.0)];
        let xi = [0, 1].map(|k| 0.5 * (start[k] + end[k]));
        let between = |xi: [f64; 2]| a.at(xi[0], 0.0) - b.at(xi[1], 0.0);
        let y = between(xi);
        // at its tip a cable may be met from any direction
        let tangents = [0, 1].map(|k| {
            let is_tip = pieces[k].is_tip(start[k]) || pieces[k].is_tip(end[k]);
            let slope = if is_tip { Vector3::zeros() } else { pieces[k].slope(xi[k], 0.0) };
            slope.try_normalize(0.0).unwrap_or_default()
        });
        let normal = across(&y, &tangents).unwrap_or_else(|| y.try_normalize(0.0).unwrap_or(Vector3::y()));
        Passage { xi, start, apart: between(start), normal }
    }

    /// Returns the gap in m when the step begins between cables that were on a side, negative where
    /// they are on the other one, and the normal of that side.
    pub fn on_side(&self, side: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let normal = if self.normal.dot(side) < 0.0 { -self.normal } else { self.normal };
        (self.apart.norm().copysign(self.apart.dot(side)), normal)
    }
}

/// Returns the direction of what two unit tangents leave of a vector.
fn across(y: &Vector3<f64>, [a, b]: &[Vector3<f64>; 2]) -> Option<Vector3<f64>> {
    let (diagonal, off) = (1.0 + CENTRING, a.dot(b));
    let shares = Matrix2::new(diagonal, off, off, diagonal).try_inverse()? * Vector2::new(a.dot(y), b.dot(y));
    (y - a * shares.x - b * shares.y).try_normalize(0.0)
}
