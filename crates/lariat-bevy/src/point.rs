//! Conversion of points and vectors from the types that users have.

use lariat_ancf::Vector3;
use lariat_rapier::convert::vector;
use lariat_rapier::rapier::math::Vector;

/// A point or vector: from arrays of `f32` or `f64`, nalgebra's vectors, or Rapier's (which are
/// those of glam, and so of Bevy).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point(pub Vector3<f64>);

impl From<[f64; 3]> for Point {
    fn from(p: [f64; 3]) -> Self {
        Point(p.into())
    }
}

impl From<[f32; 3]> for Point {
    fn from(p: [f32; 3]) -> Self {
        Point(p.map(f64::from).into())
    }
}

impl From<Vector3<f64>> for Point {
    fn from(p: Vector3<f64>) -> Self {
        Point(p)
    }
}

impl From<Vector> for Point {
    fn from(p: Vector) -> Self {
        Point(vector(p))
    }
}
