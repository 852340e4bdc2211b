//! Point force and moment at an arc length: dead loads in world axes, ramped linearly from zero, or
//! with a history.
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
//! that plane. A history is read at the middle of a step, so that its corners belong between steps:
//! what happens within one is seen by its value there. A static equilibrium is under the loads at
//! the full ramp and, with a history, at the cable's time.
//!
//! # References
//!
//! Virtual work.

use crate::error::{Error, require, require_finite};
use crate::point::Point;
use crate::rows::{check_rows, interpolate, is_constant};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// A force and a moment at one point of a cable.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointLoad {
    /// Where, as arc length of the unstretched cable in m.
    pub arc_length: f64,
    /// Force in N, world axes.
    pub force: Vector3<f64>,
    /// Moment in N m, world axes.
    pub moment: Vector3<f64>,
    /// Time from zero to full load in s; 0 = at once.
    pub ramp: f64,
    /// Time at which the ramp and the history begin, in s.
    /// [`Cable::add_load`](crate::Cable::add_load) sets it to the cable's time.
    #[serde(default)]
    pub start: f64,
    /// Factor beside the ramp: rows of the time since `start` in s, ascending, and the factor,
    /// linear between them and constant outside; empty = 1.
    #[serde(default)]
    pub history: Vec<[f64; 2]>,
}

impl PointLoad {
    /// Creates a constant force in N at an arc length in m.
    pub fn force(arc_length: f64, force: impl Into<Point>) -> Self {
        let force = force.into().0;
        PointLoad { arc_length, force, ..PointLoad::default() }
    }

    /// Creates a constant moment in N m at an arc length in m.
    pub fn moment(arc_length: f64, moment: impl Into<Point>) -> Self {
        let moment = moment.into().0;
        PointLoad { arc_length, moment, ..PointLoad::default() }
    }

    /// Returns the same load with a factor in time: rows of the time in s since it was added, and
    /// factor.
    pub fn with_history(mut self, rows: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.history = rows.into_iter().collect();
        self
    }

    /// Returns whether it is the same load except for the time at which it began.
    pub fn is_same(&self, other: &Self) -> bool {
        let PointLoad { arc_length, force, moment, ramp, start: _, history } = self;
        (arc_length, force, moment, ramp) == (&other.arc_length, &other.force, &other.moment, &other.ramp)
            && *history == other.history
    }

    /// Returns the fraction of the full load at `time`.
    pub fn factor(&self, time: f64) -> f64 {
        let since = time - self.start;
        let grown = if self.ramp > 0.0 { (since / self.ramp).clamp(0.0, 1.0) } else { 1.0 };
        if self.history.is_empty() { grown } else { grown * self.history_at(time) }
    }

    /// Returns the factor of its history at `time`.
    pub fn history_at(&self, time: f64) -> f64 {
        interpolate(&self.history, time - self.start)
    }

    /// Returns whether it does not change from one time to another, in s.
    pub(crate) fn is_steady(&self, from: f64, to: f64) -> bool {
        let grown = self.ramp <= 0.0 || from - self.start >= self.ramp;
        grown && is_constant(&self.history, from - self.start, to - self.start)
    }

    /// Stays as it is at `time` (s) when its ramp is over.
    pub(crate) fn stay(&mut self, time: f64) {
        let factor = self.history_at(time);
        (self.force, self.moment) = (self.force * factor, self.moment * factor);
        self.ramp = 0.0;
        self.history.clear();
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        require_finite("force (N)", &self.force)?;
        require_finite("moment (N m)", &self.moment)?;
        require("ramp (s)", self.ramp, self.ramp >= 0.0, ">= 0")?;
        check_rows("the history of a load", &self.history)
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
