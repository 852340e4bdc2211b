//! Directions of slopes, regularised where a slope is short, and their secants.
//!
//! # Equation
//!
//! ```text
//! dir(d) = q d        q(Q) = Q^-1/2, Q = |d|^2; below Q_c its Taylor polynomial of second order
//! D dir = [(q0 + q1)/2 I + 2 q[Q0, Q1] d_m d_m^T] D d        d_m = (d0 + d1)/2
//! ```
//!
//! with the divided difference q[Q0, Q1] = (q1 - q0)/(Q1 - Q0), evaluated without cancellation.
//! Both are symmetric.
//!
//! # Validity
//!
//! A slope is a direction only if it is not compressed to half of its length; below, dir(d) is
//! shorter than one, smooth, and zero with d. So no slope makes an infinite force.
//!
//! # References
//!
//! The power of bending is regularised alike (`element/bending/regularisation.rs`).

use nalgebra::{Matrix3, Vector3};

/// Coefficient of the polynomial, Q_c: a slope of half the unstretched length.
const SHORT: f64 = 0.25;

/// Returns q and its first two derivatives.
fn power(square: f64) -> [f64; 3] {
    if square >= SHORT {
        let q = square.sqrt().recip();
        return [q, -0.5 * q / square, 0.75 * q / (square * square)];
    }
    let x = square - SHORT;
    [2.0 - 4.0 * x + 12.0 * x * x, -4.0 + 24.0 * x, 24.0]
}

/// Returns q[Q0, Q1].
fn divided_difference(a: f64, b: f64) -> f64 {
    match (a >= SHORT, b >= SHORT) {
        (true, true) => {
            let (a, b) = (a.sqrt(), b.sqrt());
            -1.0 / (a * b * (a + b))
        }
        (false, false) => -4.0 + 12.0 * (a + b - 2.0 * SHORT),
        // by way of Q_c: a mean of both, with weights that are not negative
        (false, true) => {
            let (below, above) = (SHORT - a, b - SHORT);
            (divided_difference(SHORT, b) * above + (-4.0 + 12.0 * (a - SHORT)) * below) / (above + below)
        }
        (true, false) => divided_difference(b, a),
    }
}

/// A direction, with what maps covectors on it to covectors on its slope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Direction {
    slope: Vector3<f64>,
    power: [f64; 3],
    /// dir(d).
    pub at: Vector3<f64>,
}

impl Direction {
    /// Returns that of a slope.
    pub fn of(slope: Vector3<f64>) -> Self {
        let power = power(slope.norm_squared());
        Direction { slope, power, at: slope * power[0] }
    }

    /// Returns the covector on the slope of a covector on the direction.
    pub fn pull(&self, v: &Vector3<f64>) -> Vector3<f64> {
        let [q, dq, _] = self.power;
        v * q + self.slope * (2.0 * dq * self.slope.dot(v))
    }

    /// Returns the derivative of the direction by the slope.
    pub fn jacobian(&self) -> Matrix3<f64> {
        let [q, dq, _] = self.power;
        Matrix3::from_diagonal_element(q) + self.slope * self.slope.transpose() * (2.0 * dq)
    }

    /// Returns the derivative of [`pull`](Self::pull) by the slope, the covector kept.
    pub fn curvature(&self, v: &Vector3<f64>) -> Matrix3<f64> {
        let (d, [_, dq, ddq]) = (&self.slope, self.power);
        let along = d.dot(v);
        let mixed = v * d.transpose();
        (mixed + mixed.transpose()) * (2.0 * dq)
            + Matrix3::from_diagonal_element(2.0 * dq * along)
            + d * d.transpose() * (4.0 * ddq * along)
    }
}

/// A direction at both ends of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct DirectionStep {
    pub start: Vector3<f64>,
    pub end: Vector3<f64>,
    mean_slope: Vector3<f64>,
    mean_power: f64,
    difference: f64,
}

impl DirectionStep {
    /// Returns that of a slope that changes.
    pub fn of(slope: Vector3<f64>, change: &Vector3<f64>) -> Self {
        let last = slope + change;
        let (a, b) = (slope.norm_squared(), last.norm_squared());
        let (p, q) = (power(a)[0], power(b)[0]);
        DirectionStep {
            start: slope * p,
            end: last * q,
            mean_slope: slope + change * 0.5,
            mean_power: 0.5 * (p + q),
            difference: divided_difference(a, b),
        }
    }

    /// Returns the mean of both ends.
    pub fn mean(&self) -> Vector3<f64> {
        (self.start + self.end) * 0.5
    }

    /// Returns the change.
    pub fn change(&self) -> Vector3<f64> {
        self.end - self.start
    }

    /// Returns the covector on the change of the slope of a covector on the change of the
    /// direction: the transpose of the secant, which is symmetric.
    pub fn pull(&self, v: &Vector3<f64>) -> Vector3<f64> {
        v * self.mean_power + self.mean_slope * (2.0 * self.difference * self.mean_slope.dot(v))
    }
}
