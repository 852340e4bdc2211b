//! What is kept of the prescribed motion of a body from host step to host step.
//!
//! # Equation
//! The user's poses are in single precision. As long as they lie on a line in time, within their
//! rounding, the body follows the line of least squares through all of them: after the k-th, with
//! the residual e of the position that the last line gives,
//! ```text
//! x += 2 (2k - 1)/(k (k + 1)) e        V += 6/(k (k + 1)) e/H
//! ```
//! Taken for motion, the rounding u of a pose makes a straight cable of stiffness EA/L with axial
//! retardation time T pull by u EA/L (1 + T/H).

use crate::body::pose::OriginPose;
use ::nalgebra::Vector3;
use rapier::math::Real;
use serde::{Deserialize, Serialize};

/// Velocity in m/s and angular velocity in rad/s.
pub(crate) type Velocities = [Vector3<f64>; 2];

/// The line of least squares through the last positions of a body: its velocity in m/s, and how
/// many positions.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Line {
    velocity: Vector3<f64>,
    pub count: u32,
}

impl Line {
    /// Returns the position on the line after a step of `h` (s) from `before` to about `to`.
    pub fn follow(&mut self, before: &Vector3<f64>, to: Vector3<f64>, h: f64) -> Vector3<f64> {
        let predicted = before + self.velocity * h;
        let residual = to - predicted;
        if self.count == 0 || residual.amax() > f64::from(Real::EPSILON) * to.amax() {
            (self.velocity, self.count) = ((to - before) / h, 2);
            return to;
        }
        self.count = self.count.saturating_add(1);
        let k = f64::from(self.count);
        self.velocity += residual * (6.0 / (k * (k + 1.0)) / h);
        predicted + residual * (2.0 * (2.0 * k - 1.0) / (k * (k + 1.0)))
    }
}

/// What is kept of a host step for the next: the poses at both ends, the accelerations of the
/// reference point and of the rotation, the velocities of the origin at the end, and its length in
/// s.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct MotionMemory {
    pub poses: [OriginPose; 2],
    pub acceleration: Velocities,
    pub end: Velocities,
    pub step: f64,
    #[serde(default)]
    pub line: Line,
    /// Whether its last two positions were on no line with those before.
    #[serde(default)]
    pub curved: bool,
}

impl MotionMemory {
    /// Returns whether positions and attitudes of a body that is moved to poses are rounded.
    pub fn is_rounded(&self) -> (bool, bool) {
        (self.curved, self.poses[0].1 != self.poses[1].1)
    }
}
