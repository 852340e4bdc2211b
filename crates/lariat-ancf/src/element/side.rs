//! The two ends of a cable at which material can flow, and the mirror that makes the one of the
//! other.
//!
//! # Equation
//!
//! Seen from its far node, the first element of a cable is the last of the reversed one: `(r_i,
//! t_i, r_j, t_j) -> (r_j, -t_j, r_i, -t_i)`. The map is its own inverse and its own transpose, so
//! coordinates, velocities, forces and momenta take the same one.
//!
//! # Validity
//!
//! Whatever does not know the direction of the arc length: elastic forces, inertia, weight.

use serde::{Deserialize, Serialize};

/// Layout: position of each local vector among (r_i, t_i, r_j, t_j) of the cable, and its sign, at
/// the start.
const MIRROR: [(usize, f64); 4] = [(2, 1.0), (3, -1.0), (0, 1.0), (1, -1.0)];

/// An end of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Side {
    /// At the first node.
    Start,
    /// At the last node.
    End,
}

impl Side {
    /// Both, in the order of lists by side.
    pub const BOTH: [Side; 2] = [Side::Start, Side::End];

    /// Returns the element at this end of a cable with so many.
    pub fn element(self, elements: usize) -> usize {
        match self {
            Side::Start => 0,
            Side::End => elements - 1,
        }
    }

    /// Returns the element's far node and the node at the end, of a cable with so many nodes.
    pub fn nodes(self, nodes: usize) -> [usize; 2] {
        match self {
            Side::Start => [1, 0],
            Side::End => [nodes - 2, nodes - 1],
        }
    }

    /// Returns the vectors of the element at this end from those of a cable, as seen from its far
    /// node.
    #[inline]
    pub fn gather(self, x: &[f64]) -> [f64; 12] {
        match self {
            Side::End => *x.last_chunk().expect("twelve coordinates"),
            Side::Start => core::array::from_fn(|i| {
                let (k, sign) = MIRROR[i / 3];
                sign * x[3 * k + i % 3]
            }),
        }
    }

    /// Adds vectors of the element, as seen from its far node, to those of a cable.
    #[inline]
    pub fn add(self, local: &[f64; 12], x: &mut [f64]) {
        let from = if self == Side::End { x.len() - 12 } else { 0 };
        for (i, local) in local.iter().enumerate() {
            let (k, sign) = if self == Side::End { (i / 3, 1.0) } else { MIRROR[i / 3] };
            x[from + 3 * k + i % 3] += sign * local;
        }
    }

    /// Returns the entry of a table over (r_i, t_i, r_j, t_j) of the cable from that over the
    /// vectors as seen from the far node.
    pub fn entry(self, local: impl Fn(usize, usize) -> f64, a: usize, b: usize) -> f64 {
        match self {
            Side::End => local(a, b),
            Side::Start => {
                let ((a, sign_a), (b, sign_b)) = (MIRROR[a], MIRROR[b]);
                sign_a * sign_b * local(a, b)
            }
        }
    }

    /// Returns the local coordinate, counted from the far node, of one of the element.
    pub fn local(self, xi: f64) -> f64 {
        if self == Side::End { xi } else { 1.0 - xi }
    }

    /// Turns the vectors of a cable so that this end is the last; a second time, back.
    pub fn turn(self, x: &mut Vec<f64>) {
        if self == Side::Start {
            *x = x.chunks_exact(6).rev().flat_map(|n| [n[0], n[1], n[2], -n[3], -n[4], -n[5]]).collect();
        }
    }
}
