//! The coordinates of a cable that follow a body.

use crate::scales::island::MIN_SLOPE;
use nalgebra::{Vector3, Vector6};

/// Three coordinates of a cable that follow a body: a pinned position, or a clamped slope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold {
    /// Index of the pin.
    pub pin: usize,
    /// Node of the cable.
    pub node: usize,
    /// Offset among the island's coordinates.
    pub at: usize,
    /// Whether it is a slope.
    pub slope: bool,
}

/// Three coordinates of a cable, position or slope of a node, that stand in the border of an
/// island.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Held {
    pub node: usize,
    pub slope: bool,
}

/// Returns the vector at the beginning of a slice.
pub(super) fn vector(x: &[f64]) -> Vector3<f64> {
    Vector3::new(x[0], x[1], x[2])
}

/// Returns a linear and an angular vector in one.
pub(super) fn stack(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

/// Returns the direction of a slope, `None` if it is too short to have one.
pub(super) fn direction(slope: &Vector3<f64>) -> Option<Vector3<f64>> {
    slope.try_normalize(MIN_SLOPE)
}

/// Returns the direction of a slope with the sign of `reference`, or `reference` if it has none: a
/// stretch that passes through zero is not a rotation.
pub(super) fn direction_near(slope: &[f64], reference: &Vector3<f64>) -> Vector3<f64> {
    let d = direction(&vector(slope)).unwrap_or(*reference);
    if d.dot(reference) < 0.0 { -d } else { d }
}
