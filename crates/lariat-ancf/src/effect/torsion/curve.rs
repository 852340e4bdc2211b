//! What a change of the mesh does to the twist of a segment whose ends stay as they are.
//!
//! # Equation
//!
//! The twist of a segment is, modulo a full turn, the angle at its last hold from the director of
//! the first one, carried along the slopes x, m, y of all elements by smallest rotations, to that
//! of the last one, less the sum of det(x, m, y)/6 ([`element`](super::element)). With u the
//! carried director,
//!
//! ```text
//! Phi' - Phi = angle from u' to u about t - (sum det'/6 - sum det/6)
//! ```
//!
//! # Validity
//!
//! Tangents of both ends that are the same in both meshes; slopes above 1/2, below which directions
//! are regularised; a change of less than half a turn.

use super::element::directions;
use crate::section::Element;
use nalgebra::Vector3;

/// The elements of a segment with their coordinates.
#[derive(Clone, Debug, Default)]
pub(crate) struct Curve {
    /// Lengths of the elements in m.
    pub lengths: Vec<f64>,
    /// r and t of all nodes.
    pub q: Vec<f64>,
}

impl Curve {
    /// Returns that between two nodes of a cable.
    pub fn between([first, last]: [usize; 2], elements: &[Element], q: &[f64]) -> Self {
        let lengths = elements[first..last].iter().map(|element| element.length).collect();
        Curve { lengths, q: q[6 * first..6 * last + 6].to_vec() }
    }

    /// Returns a director of the first node carried to the last one, the tangent there, and the sum
    /// of det/6.
    pub(super) fn carry(&self, director: Vector3<f64>) -> (Vector3<f64>, Vector3<f64>, f64) {
        let (mut carried, mut at, mut sum) = (director, Vector3::zeros(), 0.0);
        for [x, m, y] in slopes_along(&self.q, self.lengths.iter().copied()) {
            sum += x.dot(&m.cross(&y)) / 6.0;
            carried = rotated(rotated(carried, &x, &m), &m, &y);
            at = y;
        }
        (carried, at, sum)
    }

    /// Returns the directions of the slopes at both ends.
    pub(super) fn ends(&self) -> [Vector3<f64>; 2] {
        let (size, last) = (self.q.len(), self.lengths.len().saturating_sub(1));
        let of = |e: usize, k: usize| directions(&self.q[6 * e..6 * e + 12], self.lengths[e])[k];
        if size < 12 {
            return [Vector3::x(); 2];
        }
        [of(0, 0), of(last, 2)].map(|d| d.try_normalize(0.0).unwrap_or(d))
    }

    /// Returns the twist in rad that another mesh in its place adds.
    pub fn change_to(&self, other: &Curve) -> f64 {
        let Some(&length) = self.lengths.first() else { return 0.0 };
        let [first, ..] = directions(&self.q[..12], length);
        let across = Vector3::ith(first.iamin(), 1.0).cross(&first);
        let (from, axis, before) = self.carry(across);
        let (to, _, after) = other.carry(across);
        let angle = to.cross(&from).dot(&axis).atan2(to.dot(&from));
        angle - (after - before)
    }
}

/// Returns the directions x, m, y of elements in a row, by their coordinates and lengths in m.
pub(crate) fn slopes_along(q: &[f64], lengths: impl Iterator<Item = f64>) -> Vec<[Vector3<f64>; 3]> {
    let unit = |d: Vector3<f64>| d.try_normalize(0.0).unwrap_or(d);
    lengths.enumerate().map(|(e, length)| directions(&q[6 * e..6 * e + 12], length).map(unit)).collect()
}

/// Returns a vector across `from` after the smallest rotation from there to another direction.
pub(crate) fn rotated(v: Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    let turn = (1.0 + from.dot(to)).max(f64::MIN_POSITIVE);
    v - (from + to) * (v.dot(to) / turn)
}
