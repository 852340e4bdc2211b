//! Dual numbers: a value with a derivative, which make a tangent of a kernel that computes a force.
//!
//! # Equation
//!
//! `(a, a')` with the rules of differentiation: sums, products `(ab)' = a'b + ab'`, quotients,
//! roots, |a|. A kernel over [`Real`] with (x, 1) for one argument and (y, 0) for the others
//! returns its value and its exact partial derivative.
//!
//! # Validity
//!
//! Exact to rounding wherever the function is smooth; at the kinks, sqrt(0) and |0|, the derivative
//! is taken as 0. With one derivative,
//! [`Cable::jacobians`](crate::coupling::Linearisation::jacobians) makes a pass per coordinate of
//! an element; with several at once, an unknown rate of a reel makes one per iteration.
//!
//! # References
//!
//! Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, chapter 3 (forward mode).

use crate::Real;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A derivative, or several.
pub(crate) trait Slope: Copy {
    /// Of a constant.
    const ZERO: Self;
    /// Returns `a x + b y`.
    fn combined(a: f64, x: Self, b: f64, y: Self) -> Self;
}

impl Slope for f64 {
    const ZERO: Self = 0.0;
    #[inline(always)]
    fn combined(a: f64, x: Self, b: f64, y: Self) -> Self {
        a * x + b * y
    }
}

impl<const N: usize> Slope for [f64; N] {
    const ZERO: Self = [0.0; N];
    #[inline(always)]
    fn combined(a: f64, x: Self, b: f64, y: Self) -> Self {
        let mut out = x;
        for i in 0..N {
            out[i] = a * x[i] + b * y[i];
        }
        out
    }
}

/// A value and its derivative, or its derivatives by several arguments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dual<S = f64> {
    pub value: f64,
    pub slope: S,
}

/// A constant: the derivative is 0.
#[inline(always)]
pub(crate) fn constant<S: Slope>(value: f64) -> Dual<S> {
    Dual { value, slope: S::ZERO }
}

impl<const N: usize> Dual<[f64; N]> {
    /// Returns a number that changes by `rate` with argument `i`.
    #[inline(always)]
    pub fn along(value: f64, i: usize, rate: f64) -> Self {
        let mut slope = [0.0; N];
        slope[i] = rate;
        Dual { value, slope }
    }
}

impl<S: Slope> Dual<S> {
    /// Returns what a function of this value is, with its derivative.
    #[inline(always)]
    fn map(self, value: f64, rate: f64) -> Self {
        Dual { value, slope: S::combined(rate, self.slope, 0.0, S::ZERO) }
    }
}

impl<S: Slope> Add for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, slope: S::combined(1.0, self.slope, 1.0, other.slope) }
    }
}

impl<S: Slope> Sub for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, slope: S::combined(1.0, self.slope, -1.0, other.slope) }
    }
}

impl<S: Slope> Mul for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Dual { value: self.value * other.value, slope: S::combined(other.value, self.slope, self.value, other.slope) }
    }
}

impl<S: Slope> Div for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (value, rate) = (self.value / other.value, 1.0 / other.value);
        Dual { value, slope: S::combined(rate, self.slope, -value * rate, other.slope) }
    }
}

impl<S: Slope> Neg for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(-self.value, -1.0)
    }
}

impl<S: Slope> Add<f64> for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Dual { value: self.value + other, ..self }
    }
}

impl<S: Slope> Sub<f64> for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Dual { value: self.value - other, ..self }
    }
}

impl<S: Slope> Mul<f64> for Dual<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.map(self.value * other, other)
    }
}

impl<S: Slope> Real for Dual<S> {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        constant(value)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        self.map(value, if value == 0.0 { 0.0 } else { 0.5 / value })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(self.value.abs(), if self.value == 0.0 { 0.0 } else { self.value.signum() })
    }
    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        if self.value < least { constant(least) } else { self }
    }
    #[inline(always)]
    fn is_above(self, limit: f64) -> bool {
        self.value > limit
    }
}
