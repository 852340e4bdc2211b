//! Vectors of Rapier and of nalgebra.

use super::engine::rapier::prelude::*;
use lariat_ancf::Vector3;

/// Converts to a vector of Rapier.
pub fn to_rapier(x: [f64; 3]) -> Vector {
    Vector::new(x[0] as Real, x[1] as Real, x[2] as Real)
}

/// Converts from a vector of Rapier.
pub fn from_rapier(x: Vector) -> Vector3<f64> {
    Vector3::new(f64::from(x.x), f64::from(x.y), f64::from(x.z))
}
