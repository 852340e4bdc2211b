//! Vectors of Rapier and of nalgebra.

use super::engine;
use super::engine::rapier::math::Vector;
use lariat_ancf::Vector3;

/// Converts to a vector of Rapier.
pub fn to_rapier(x: [f64; 3]) -> Vector {
    engine::convert::to_vector(&x.into())
}

/// Converts from a vector of Rapier.
pub fn from_rapier(x: Vector) -> Vector3<f64> {
    engine::convert::vector(x)
}
