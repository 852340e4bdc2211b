//! Vector instructions: the best that the processor has, found at run time.
//!
//! Every level runs the same source with the same order of operations and no fused multiply-add, so
//! the choice changes the time and nothing else: a run is bitwise the same at every level.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/elements.md.

use fearless_simd::{Simd, SimdBase, f64x8};

/// Layout: elements evaluated together.
pub(crate) const LANES: usize = 8;

/// Runs an expression with the instructions of a level: AVX-512, AVX2 or SSE2 on x86-64, with
/// `$simd` bound to its token. An expression that takes no token has no lanes of its own; AVX-512
/// would not make it faster, so it is compiled for AVX2 and SSE2.
#[cfg(target_arch = "x86_64")]
macro_rules! dispatch {
    ($level:expr, $simd:ident => $body:expr) => {
        match $level {
            fearless_simd::Level::Avx512($simd) => crate::simd::with_instructions!($simd => $body),
            fearless_simd::Level::Avx2($simd) => crate::simd::with_instructions!($simd => $body),
            other => {
                let $simd = other.as_sse2().expect("every x86-64 processor has SSE2");
                crate::simd::with_instructions!($simd => $body)
            }
        }
    };
    ($level:expr => $body:expr) => {
        match $level.as_avx2() {
            Some(simd) => crate::simd::with_instructions!(simd => $body),
            None => $body,
        }
    };
}

/// Runs an expression in a function of its own with the instructions of a token.
#[cfg(target_arch = "x86_64")]
macro_rules! with_instructions {
    ($simd:ident => $body:expr) => {
        fearless_simd::Simd::vectorize(
            $simd,
            #[inline(always)]
            || $body,
        )
    };
}

#[cfg(not(target_arch = "x86_64"))]
macro_rules! dispatch {
    ($level:expr, $simd:ident => $body:expr) => { fearless_simd::dispatch!($level, $simd => $body) };
    ($level:expr => $body:expr) => { fearless_simd::dispatch!($level, _ => $body) };
}

pub(crate) use dispatch;
#[cfg(target_arch = "x86_64")]
pub(crate) use with_instructions;

/// Eight consecutive values from `first` on.
#[inline(always)]
pub(crate) fn load<S: Simd>(simd: S, values: &[f64], first: usize) -> f64x8<S> {
    f64x8::from_slice(simd, &values[first..first + LANES])
}

/// Values by element, padded by copies of the last one to a multiple of [`LANES`].
pub(crate) fn padded(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    if let Some(&last) = values.last() {
        values.resize(values.len().next_multiple_of(LANES), last);
    }
    values
}
