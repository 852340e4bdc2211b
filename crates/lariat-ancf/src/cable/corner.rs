//! Corners of the drawn shape.
//!
//! Of those on nodes that are held or asked for: others are rounded by
//! [`unstrained`](super::unstrained). A cable is smooth at its nodes, so one at a corner of the
//! drawn polyline has the mean direction of both sides, and the elements beside it are bent. Where
//! the cable is parted there, at a sheave, the parts need not be smooth together: each begins with
//! the slope of its own side, as drawn.
//!
//! # Alternatives considered
//!
//! The slope of least strain energy: a part that has moved since would jump, and one of a single
//! element between two corners would be bent in an arc.

use super::Cable;
use super::layout::Laid;
use crate::at::At;
use crate::element::side::Side;
use crate::model::Corner;
use crate::state::State;
use nalgebra::{Matrix3, Vector3};

impl Corner {
    /// Returns the corner that a node was laid on; `None` on a smooth line.
    pub fn of(node: &Laid) -> Option<Self> {
        node.corner.map(|sides| Corner { position: node.position, slope: node.slope, sides })
    }
}

impl Cable {
    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn open_corner(&mut self, at: impl Into<At>) {
        let Some(side) = self.side(at.into()) else { return };
        let [far, end] = side.nodes(self.nodes()).map(|node| 6 * node);
        let State { q, v, .. } = &mut self.snapshot.state;
        let part = |x: &[f64], at: usize| Vector3::from_column_slice(&x[at..at + 3]);
        let (position, slope) = (part(q, end), part(q, end + 3));
        let drawn = |corner: &&Corner| corner.position == position && corner.slope == slope;
        // two corners at one point may have one mean: the slope on this side is nearer to the chord
        let length = self.model.elements[side.element(self.model.elements.len())].length;
        let chord = (position - part(q, far)) * if side == Side::End { 1.0 } else { -1.0 } / length;
        let sides = self.model.corners.iter().filter(drawn).map(|corner| corner.sides[1 - side as usize]);
        let Some(own) = sides.min_by(|a, b| (a - chord).norm().total_cmp(&(b - chord).norm())) else { return };
        let spin = common_spin([far, end].map(|at| [part(q, at + 3), part(v, at + 3)]));
        q[end + 3..end + 6].copy_from_slice(own.as_slice());
        v[end + 3..end + 6].copy_from_slice(spin.cross(&own).as_slice());
        self.disturb();
    }
}

/// Returns the angular velocity in rad/s by which two slopes have their rates.
fn common_spin(slopes: [[Vector3<f64>; 2]; 2]) -> Vector3<f64> {
    let (mut matrix, mut moment) = (Matrix3::zeros(), Vector3::zeros());
    for [slope, rate] in slopes {
        matrix += Matrix3::identity() * slope.norm_squared() - slope * slope.transpose();
        moment += slope.cross(&rate);
    }
    // about two slopes that are parallel any spin will do
    let least = 1e-14 * matrix.trace();
    (matrix + Matrix3::identity() * least).try_inverse().map_or_else(Vector3::zeros, |inverse| inverse * moment)
}
