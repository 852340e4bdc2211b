//! Rigid motions of an island.

use crate::scales::island::VELOCITY_ROUNDING;
use nalgebra::Vector3;

/// A rigid motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::island) struct RigidMotion {
    pub centre: Vector3<f64>,
    pub velocity: Vector3<f64>,
    pub spin: Vector3<f64>,
}

impl RigidMotion {
    /// Returns the velocity in m/s at a point.
    pub fn at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.velocity + self.spin.cross(&(point - self.centre))
    }

    /// Returns whether it is that of another, but for rounding: what holds a node is prescribed in
    /// any case.
    pub fn agrees_with(&self, other: &RigidMotion) -> bool {
        let same = |a: Vector3<f64>, b: Vector3<f64>| (a - b).norm() <= VELOCITY_ROUNDING * a.norm().max(b.norm());
        same(self.spin, other.spin) && same(self.at(&self.centre), other.at(&self.centre))
    }
}
