//! Patches: what the surface of an obstacle looks like from a point of the cable.
//!
//! # Equation
//!
//! With y from a point of the patch, its axis a and its radius R, the gap is
//!
//! ```text
//! plane         g = n . y
//! point         g = |y| - R
//! line          g = |z| - R        z = y - s a, s = a . y
//! ```

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A part of a surface, in the obstacle's axes; lengths in m, unit directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Patch {
    /// A face.
    Plane {
        /// A point of it.
        point: Vector3<f64>,
        /// Its outward normal.
        normal: Vector3<f64>,
    },
    /// A cylinder; an edge if its radius is 0.
    Line {
        /// A point of its axis.
        point: Vector3<f64>,
        /// Its axis.
        direction: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A ball; a corner if its radius is 0.
    Point {
        /// Its centre.
        point: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
}

impl Default for Patch {
    fn default() -> Patch {
        Patch::Point { point: Vector3::zeros(), radius: 0.0 }
    }
}

impl Patch {
    /// Returns the gap and the outward normal at a point in the obstacle's axes.
    #[inline]
    pub(crate) fn gap(&self, y: &Vector3<f64>) -> (f64, Vector3<f64>) {
        match *self {
            Patch::Plane { point, normal } => (normal.dot(&(y - point)), normal),
            Patch::Line { point, direction, radius } => {
                let z = y - point;
                away(&(z - direction * direction.dot(&z)), radius)
            }
            Patch::Point { point, radius } => away(&(y - point), radius),
        }
    }

    /// Returns its radius in m; `None` for a plane.
    pub(crate) fn radius(&self) -> Option<f64> {
        match *self {
            Patch::Plane { .. } => None,
            Patch::Line { radius, .. } | Patch::Point { radius, .. } => Some(radius),
        }
    }
}

/// Returns the gap and the direction of z.
fn away(z: &Vector3<f64>, radius: f64) -> (f64, Vector3<f64>) {
    let l = z.norm();
    (l - radius, if l > 0.0 { z / l } else { Vector3::x() })
}
