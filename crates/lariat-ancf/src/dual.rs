//! Dual numbers: a value with a derivative, which make a tangent of a kernel that computes a force.
//!
//! # Equation
//!
//! `(a, a')` with the rules of differentiation: sums, products `(ab)' = a'b + ab'`, quotients, roots, |a|. A kernel over [`Real`] with
//! (x, 1) for one argument and (y, 0) for the others returns its value and its exact partial derivative.
//!
//! # Validity
//!
//! Exact to rounding wherever the function is smooth; at the kinks, sqrt(0) and |0|, the derivative is taken as 0. Used by
//! [`Cable::jacobians`](crate::coupling::Linearisation::jacobians): one pass per coordinate of an element, so not for the step.
//!
//! # References
//!
//! Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, chapter 3 (forward mode).

use crate::Real;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dual {
    pub value: f64,
    pub slope: f64,
}

/// A constant: the derivative is 0.
pub(crate) fn constant(value: f64) -> Dual {
    Dual { value, slope: 0.0 }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Dual { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Dual { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl Add<f64> for Dual {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        Dual { value: self.value + other, ..self }
    }
}

impl Sub<f64> for Dual {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        Dual { value: self.value - other, ..self }
    }
}

impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        Dual { value: self.value * other, slope: self.slope * other }
    }
}

impl Real for Dual {
    fn splat(self, value: f64) -> Self {
        constant(value)
    }
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Dual { value, slope: if value == 0.0 { 0.0 } else { 0.5 * self.slope / value } }
    }
    fn abs(self) -> Self {
        let slope = if self.value == 0.0 { 0.0 } else { self.slope * self.value.signum() };
        Dual { value: self.value.abs(), slope }
    }
    fn at_least(self, least: f64) -> Self {
        if self.value < least { constant(least) } else { self }
    }
    #[inline]
    fn is_above(self, limit: f64) -> bool {
        self.value > limit
    }
}
