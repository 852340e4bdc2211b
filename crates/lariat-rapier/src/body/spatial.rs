//! Spatial vectors: a linear and an angular quantity of a body in one vector of six numbers.
//!
//! Order: linear before angular, world axes, about the centre of mass. *Reference:* Featherstone
//! 2008, chapter 2 (which puts the angular part first).

use ::nalgebra::{Vector3, Vector6};

/// Stacks a linear and an angular vector into a spatial one.
pub(crate) fn stack_spatial(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

/// Splits a spatial vector into its linear and its angular part.
pub(crate) fn split_spatial(v: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]))
}
