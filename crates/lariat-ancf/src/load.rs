//! Point force and moment at an arc length: dead loads in world axes, ramped linearly from zero.
//!
//! # Equation
//!
//! Force f at arc length s: generalised force `N(s)^T f`. Moment m on the section: the angular
//! velocity of the tangent t = r'(s) is `t x dt/|t|^2`, so the virtual work `m . (t x dt)/|t|^2`
//! gives the generalised force `(m x t)/|t|^2` on the slope at s.
//!
//! # Validity
//!
//! The element has no twist, so the component of m along t does no work. A moment about a fixed
//! axis is conservative only while the cable stays in the plane normal to it; its tangent is made
//! symmetric, which does not change the solution and slows Newton's iteration when the cable leaves
//! that plane.
//!
//! # References
//!
//! Virtual work.

use crate::point::Point;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// A force and a moment at one point of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointLoad {
    /// Where, as arc length of the unstretched cable in m.
    pub arc_length: f64,
    /// Force in N, world axes.
    pub force: Vector3<f64>,
    /// Moment in N m, world axes.
    pub moment: Vector3<f64>,
    /// Time from zero to full load in s; 0 = at once.
    pub ramp: f64,
    /// Time at which the ramp begins, in s. [`Cable::add_load`](crate::Cable::add_load) sets it to
    /// the cable's time.
    #[serde(default)]
    pub start: f64,
}

impl PointLoad {
    /// Creates a constant force in N at an arc length in m.
    pub fn force(arc_length: f64, force: impl Into<Point>) -> Self {
        let force = force.into().0;
        PointLoad { arc_length, force, moment: Vector3::zeros(), ramp: 0.0, start: 0.0 }
    }

    /// Creates a constant moment in N m at an arc length in m.
    pub fn moment(arc_length: f64, moment: impl Into<Point>) -> Self {
        let moment = moment.into().0;
        PointLoad { arc_length, force: Vector3::zeros(), moment, ramp: 0.0, start: 0.0 }
    }

    /// Returns whether it is the same load except for the time at which its ramp began.
    pub fn is_same(&self, other: &Self) -> bool {
        PointLoad { start: other.start, ..*self } == *other
    }

    /// Returns the fraction of the full load at `time`.
    pub fn factor(&self, time: f64) -> f64 {
        if self.ramp > 0.0 { ((time - self.start) / self.ramp).clamp(0.0, 1.0) } else { 1.0 }
    }
}

/// Generalised force `(m x t)/|t|^2` of a moment on the slope t, and the symmetric part of its
/// derivative.
pub(crate) fn moment_on_slope(m: &Vector3<f64>, t: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let square = t.norm_squared();
    let cross = m.cross(t);
    // d/dt = [m]x/|t|^2 - 2 (m x t) t^T/|t|^4; [m]x is antisymmetric and drops out
    let outer = cross * t.transpose();
    (cross / square, -(outer + outer.transpose()) / (square * square))
}
