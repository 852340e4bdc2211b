//! Number of negative eigenvalues of the equilibrated matrix.
//!
//! # Equation
//!
//! The inertia of A is the sum of the inertias of the Schur complements S_i of block elimination
//! without interchanges. Each 6x6 S_i is diagonalised, so that a zero leading pivot does no harm.
//!
//! # Validity
//!
//! The count is that of A + E with |E|_2 <= 3 * 64 ulp * max |S_i| (1 + |G_i|)^2; it is returned
//! only if this bound is below the smallest singular value of A (Weyl's inequality), otherwise
//! `None`.
//!
//! # References
//!
//! Haynsworth's inertia additivity and Sylvester's law: Golub & Van Loan, Matrix Computations, 4th
//! ed., section 8.1.5; Weyl's inequality: section 8.1.2.
//!
//! # Alternatives considered
//!
//! - Signs of unpivoted scalar pivots: undefined for a zero leading entry.
//! - Sturm sequences on a tridiagonal reduction: O(n^2) for a band.

use super::block::{Block, BlockTridiagonal};
use nalgebra::{Matrix6, SymmetricEigen, Vector6};

/// Returns the scaled block S_row b S_column.
fn scaled(b: &Block, row: &[f64], column: &[f64]) -> Matrix6<f64> {
    Matrix6::from_fn(|r, c| b.0[c][r] * row[r] * column[c])
}

/// Returns the number of negative eigenvalues, or `None` if it is uncertain; `smallest` is a lower
/// bound of the smallest singular value of the scaled matrix.
pub(super) fn negative(a: &BlockTridiagonal, scale: &[f64], smallest: f64) -> Option<usize> {
    let mut count = 0;
    let mut worst: f64 = 0.0;
    let mut update = Matrix6::zeros();
    for i in 0..a.nodes() {
        let here = &scale[6 * i..6 * i + 6];
        let s = scaled(&a.diag[i], here, here) - update;
        let s = (s + s.transpose()) * 0.5;
        if !s.iter().all(|v| v.is_finite()) {
            return None;
        }
        let eigen = SymmetricEigen::try_new(s, f64::EPSILON, 200)?;
        count += eigen.eigenvalues.iter().filter(|&&v| v < 0.0).count();
        let norm = eigen.eigenvalues.amax();
        let mut gain_norm = 0.0;
        if let Some(lower) = a.lower.get(i) {
            let b = scaled(lower, &scale[6 * i + 6..6 * i + 12], here);
            let bv = b * eigen.eigenvectors;
            let inverse: Vector6<f64> = eigen.eigenvalues.map(|v| 1.0 / v);
            let g = bv * Matrix6::from_diagonal(&inverse);
            gain_norm = g.norm();
            update = g * bv.transpose();
        }
        worst = worst.max(norm * (1.0 + gain_norm) * (1.0 + gain_norm));
    }
    (3.0 * 64.0 * f64::EPSILON * worst < smallest).then_some(count)
}
