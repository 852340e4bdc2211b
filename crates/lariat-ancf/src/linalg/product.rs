//! Product of a block-tridiagonal matrix and a vector.
//!
//! # Equation
//!
//! y_i = D_i x_i + B_{i-1} x_{i-1} + B_i^T x_{i+1}
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 4.5.1.

use super::block::BlockTridiagonal;
use super::lanes::{columns_times, load_block, load_six, store_six, transpose_dots};
use crate::simd::dispatch;
use fearless_simd::{Level, Simd};

impl BlockTridiagonal {
    /// Computes y = A x; both have length 6 * nodes.
    ///
    /// # Panics
    /// If a length does not match.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.check();
        assert_eq!(x.len(), 6 * self.nodes(), "length of x");
        assert_eq!(y.len(), 6 * self.nodes(), "length of y");
        dispatch!(Level::new(), simd => multiply(simd, self, x, y));
    }
}

#[inline(always)]
fn multiply<S: Simd>(simd: S, a: &BlockTridiagonal, x: &[f64], y: &mut [f64]) {
    let (x, _) = x.as_chunks::<6>();
    let (y, _) = y.as_chunks_mut::<6>();
    for i in 0..a.diag.len() {
        let here = load_six(simd, &x[i]);
        let mut sum = columns_times(simd, &load_block(simd, &a.diag[i]), here);
        if i > 0 {
            let before = load_six(simd, &x[i - 1]);
            sum += columns_times(simd, &load_block(simd, &a.lower[i - 1]), before);
        }
        if i + 1 < x.len() {
            let after = load_six(simd, &x[i + 1]);
            sum += transpose_dots(&load_block(simd, &a.lower[i]), after);
        }
        store_six(simd, sum, &mut y[i]);
    }
}
