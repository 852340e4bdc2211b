//! Symmetric scaling by powers of two, and a scan of all entries.
//!
//! # Equation
//!
//! A' = S A S with s_i = 2^k_i such that the largest entry of every row is about 1, computed on the
//! exponents alone, so that scaling is exact except for overflow and underflow.
//!
//! # Validity
//!
//! Finite entries; a zero row is an error.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 3.5.2; the iteration after Ruiz,
//! RAL-TR-2001-034.
//!
//! # Alternatives considered
//!
//! - Scaling by the diagonal: it may be zero.
//! - Scaling by exact maxima: it rounds.

use super::block::BlockTridiagonal;
use super::outcome::{Reason, SingularMatrix};

/// Calls `visit(row, column, value)` for the lower triangle, diagonal included.
pub(super) fn for_lower_triangle(a: &BlockTridiagonal, mut visit: impl FnMut(usize, usize, f64)) {
    for i in 0..a.diag.len() {
        for c in 0..6 {
            for r in c..6 {
                visit(6 * i + r, 6 * i + c, a.diag[i].0[c][r]);
            }
            if let Some(lower) = a.lower.get(i) {
                for r in 0..6 {
                    visit(6 * i + 6 + r, 6 * i + c, lower.0[c][r]);
                }
            }
        }
    }
}

/// Returns an error unless every entry (except the padding) is finite.
pub(super) fn check_finite(a: &BlockTridiagonal) -> Result<(), SingularMatrix> {
    for i in 0..a.diag.len() {
        let blocks = [Some(&a.diag[i]), a.lower.get(i)];
        let mut entries = blocks.into_iter().flatten().flat_map(|b| b.0.iter().flat_map(|c| &c[..6]));
        if !entries.all(|v| v.is_finite()) {
            return Err(SingularMatrix { node: i, pivot: 0.0, scale: 0.0, reason: Reason::NonFinite });
        }
    }
    Ok(())
}

/// Returns the binary exponent of a finite number; `None` for 0. Subnormal numbers count as the
/// smallest normal.
fn exponent(value: f64) -> Option<i32> {
    (value != 0.0).then(|| ((((value.to_bits() >> 52) & 0x7ff) as i32) - 1023).max(-1022))
}

/// Returns 2^k for |k| <= 1000.
fn power(k: i32) -> f64 {
    f64::from_bits(((k.clamp(-1000, 1000) + 1023) as u64) << 52)
}

/// Fills `scale` with s_i; `exponents` and `largest` are buffers.
pub(super) fn equilibrate(
    a: &BlockTridiagonal,
    scale: &mut Vec<f64>,
    exponents: &mut Vec<i32>,
    largest: &mut Vec<i32>,
) -> Result<(), SingularMatrix> {
    let n = 6 * a.nodes();
    exponents.clear();
    exponents.resize(n, 0);
    for _ in 0..4 {
        largest.clear();
        largest.resize(n, i32::MIN);
        for_lower_triangle(a, |r, c, value| {
            if let Some(e) = exponent(value) {
                let e = e + exponents[r] + exponents[c];
                largest[r] = largest[r].max(e);
                largest[c] = largest[c].max(e);
            }
        });
        if let Some(row) = largest.iter().position(|&e| e == i32::MIN) {
            let reason = Reason::Pivot;
            return Err(SingularMatrix { node: row / 6, pivot: 0.0, scale: 0.0, reason });
        }
        for i in 0..n {
            exponents[i] -= largest[i].div_euclid(2);
        }
    }
    scale.clear();
    scale.extend(exponents.iter().map(|&k| power(k)));
    Ok(())
}
