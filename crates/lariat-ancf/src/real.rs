//! The number type of the element kernels: one source for `f64` and for lanes of `f64`.
//!
//! A kernel written over [`Real`] evaluates one element with `f64` and eight elements with
//! [`fearless_simd::f64x8`], whose width in registers (SSE2, AVX2, AVX-512, NEON) is chosen at run
//! time.
//!
//! # Validity
//!
//! [`Real`] has no fused multiply-add and no horizontal sum, so each lane performs the same IEEE
//! 754 operations in the same order as the scalar kernel: the kernel chosen at run time changes the
//! speed, never the result.
//!
//! # Alternatives considered
//!
//! Fused multiply-add: faster, and different bits on different machines, which lock-step networking
//! cannot use.

use core::ops::{Add, Div, Mul, Neg, Sub};
use fearless_simd::{ExtractToken, Simd, SimdBase, SimdFloat, f64x8, prelude::*};

/// A number, or lanes of numbers, in the element kernels.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The constant `value` in every lane of a number like `self`.
    fn splat(self, value: f64) -> Self;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The larger of the number and a constant; of a number that is none, either.
    fn at_least(self, least: f64) -> Self;
    /// Whether it is above a constant in every lane.
    fn is_above(self, limit: f64) -> bool;
}

/// A number that can be combined with those of a type of fewer derivatives, or of the same.
pub(crate) trait Over<T>: Real + Sub<T, Output = Self> + Mul<T, Output = Self> {}

impl<T, U: Real + Sub<T, Output = U> + Mul<T, Output = U>> Over<T> for U {}

impl Real for f64 {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        f64::max(self, least)
    }
    #[inline(always)]
    fn is_above(self, limit: f64) -> bool {
        self > limit
    }
}

impl<S: Simd> Real for f64x8<S> {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        <f64x8<S> as SimdBase<S>>::splat(self.token(), value)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        <f64x8<S> as SimdFloat<S>>::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        <f64x8<S> as SimdBase<S>>::abs(self)
    }
    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        <f64x8<S> as SimdBase<S>>::max(self, self.splat(least))
    }
    #[inline(always)]
    fn is_above(self, limit: f64) -> bool {
        self.simd_gt(self.splat(limit)).to_bitmask() == 0xff
    }
}
