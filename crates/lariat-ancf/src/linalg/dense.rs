//! Small dense symmetric systems, of the bodies of an island and of contacts: L D L^T with diagonal
//! pivoting.
//!
//! # Validity
//!
//! Positive definite matrices, and nearly so; a pivot below rounding is an error. Rows are
//! exchanged only where a pivot has lost most of its diagonal entry, and zeros below the last entry
//! of a column are skipped: a chain of bodies in its order costs O(n), a full matrix O(n^3).
//!
//! # References
//!
//! Golub & Van Loan 2013, section 4.4 (symmetric indefinite systems, here with 1x1 pivots chosen on
//! the diagonal).
//!
//! # Alternatives considered
//!
//! nalgebra's Cholesky: its products choose kernels at run time, with other bits on other machines.

use super::outcome::{Reason, SingularMatrix};
use crate::scales::linalg::MIN_PIVOT_SHARE;
use crate::simd::dispatch;
use fearless_simd::Level;

/// A factored symmetric matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dense {
    n: usize,
    factors: Vec<f64>,
    order: Vec<usize>,
    scratch: Vec<f64>,
    scale: Vec<f64>,
    column: Vec<f64>,
}

impl Dense {
    /// Factors the symmetric `n` x `n` matrix `a` (row-major; the lower triangle is read).
    ///
    /// # Errors
    /// [`SingularMatrix`] if no pivot above rounding is left, or an entry is not finite.
    pub fn factor(&mut self, a: &[f64], n: usize) -> Result<(), SingularMatrix> {
        self.n = n;
        self.factors.clear();
        self.factors.extend_from_slice(&a[..n * n]);
        self.order.clear();
        self.order.extend(0..n);
        self.scratch.resize(n, 0.0);
        let (f, level) = (&mut self.factors, Level::new());
        self.scale.clear();
        self.scale.extend((0..n).map(|i| f[i * n + i].abs()));
        let scale = &self.scale;
        let fail = |node: usize, pivot: f64, scale: f64, reason| Err(SingularMatrix { node, pivot, scale, reason });
        if (0..n).any(|i| f[i * n..=i * n + i].iter().any(|x| !x.is_finite())) {
            return fail(0, 0.0, 0.0, Reason::NonFinite);
        }
        for k in 0..n {
            // the pivot that has lost the smallest share of its diagonal entry: rows of bodies
            // differ in unit and size
            let quality =
                |f: &[f64], i: usize, order: &[usize]| f[i * n + i].abs() / scale[order[i]].max(f64::MIN_POSITIVE);
            if quality(f, k, &self.order) < MIN_PIVOT_SHARE {
                let better = |b, i| if quality(f, i, &self.order) > quality(f, b, &self.order) { i } else { b };
                let best = (k..n).fold(k, better);
                swap(f, n, k, best);
                self.order.swap(k, best);
            }
            let pivot = f[k * n + k];
            let size = scale[self.order[k]];
            if pivot.abs() <= 64.0 * f64::EPSILON * size || pivot == 0.0 {
                return fail(self.order[k] / 6, pivot, size, Reason::Pivot);
            }
            let end = (k + 1..n).rev().find(|i| f[i * n + k] != 0.0).map_or(k + 1, |last| last + 1);
            self.column.clear();
            self.column.extend((k + 1..end).map(|i| f[i * n + k]));
            dispatch!(level => eliminate(&mut f[(k + 1) * n..end * n], (n, k), &self.column, pivot));
        }
        Ok(())
    }

    /// Returns the number of negative eigenvalues (Sylvester).
    pub fn negative(&self) -> usize {
        (0..self.n).filter(|&k| self.factors[k * self.n + k] < 0.0).count()
    }

    /// Solves in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        let n = self.n;
        let (f, x) = (&self.factors, &mut self.scratch);
        for i in 0..n {
            x[i] = rhs[self.order[i]];
        }
        for i in 0..n {
            for j in 0..i {
                x[i] -= f[i * n + j] * x[j];
            }
        }
        for i in 0..n {
            x[i] /= f[i * n + i];
        }
        for j in (0..n).rev() {
            let (before, after) = x.split_at_mut(j);
            before.iter_mut().zip(&f[j * n..]).for_each(|(x, l)| *x -= l * after[0]);
        }
        for i in 0..n {
            rhs[self.order[i]] = x[i];
        }
    }
}

/// Computes l = column/pivot in column `k` of the rows after `k`, of `n` numbers each, and
/// subtracts l column^T from their lower triangle.
#[inline(always)]
fn eliminate(rows: &mut [f64], (n, k): (usize, usize), column: &[f64], pivot: f64) {
    for (i, row) in rows.chunks_exact_mut(n).enumerate().filter(|(i, _)| column[*i] != 0.0) {
        let l = column[i] / pivot;
        row[k] = l;
        row[k + 1..=k + 1 + i].iter_mut().zip(column).for_each(|(x, c)| *x -= l * c);
    }
}

/// Swaps rows and columns `a` and `b`, `a < b`, of a symmetric matrix of which the lower triangle
/// is stored, with factors in its first `a` columns.
fn swap(f: &mut [f64], n: usize, a: usize, b: usize) {
    if a == b {
        return;
    }
    for j in 0..a {
        f.swap(a * n + j, b * n + j);
    }
    f.swap(a * n + a, b * n + b);
    for i in a + 1..b {
        f.swap(i * n + a, b * n + i);
    }
    for i in b + 1..n {
        f.swap(i * n + a, i * n + b);
    }
}

#[cfg(test)]
mod tests {
    use super::Dense;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn solutions_of_random_definite_systems_match_an_independent_factorisation() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for n in 1..20 {
            let b = DMatrix::from_fn(n, n, |_, _| random());
            // rows of very different size, as of positions and rotations
            let d = DMatrix::from_diagonal(&DVector::from_fn(n, |i, _| 10f64.powi(i as i32 % 7 - 3)));
            let a = &d * (&b * b.transpose() + DMatrix::identity(n, n) * 0.1) * &d;
            let x = DVector::from_fn(n, |_, _| random());
            let mut rhs = (&a * &x).as_slice().to_vec();
            let mut dense = Dense::default();
            dense.factor(a.as_slice(), n).unwrap();
            dense.solve(&mut rhs);
            let expected = a.clone().cholesky().unwrap().solve(&(&a * &x));
            for i in 0..n {
                assert!((rhs[i] - x[i]).abs() < 1e-9 * (1.0 + (expected[i] - x[i]).abs() * 1e9), "{n} {i}");
            }
        }
    }

    /// Pivots that vanish are exchanged, whatever else was exchanged before; the reference is the
    /// factorisation of nalgebra with full pivoting.
    #[test]
    fn vanishing_pivots_are_exchanged() {
        let links = |n: usize| {
            DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
                0 => 1.0 + if i % 3 == 2 { i as f64 } else { 0.0 },
                1 => 1.0,
                2 => 0.1 * (i * j) as f64,
                _ => 0.0,
            })
        };
        for n in [3, 4, 7, 12] {
            let a = links(n);
            let x = DVector::from_fn(n, |i, _| 1.0 + i as f64);
            let mut rhs = (&a * &x).as_slice().to_vec();
            let mut dense = Dense::default();
            dense.factor(a.as_slice(), n).unwrap();
            assert_ne!(dense.order, (0..n).collect::<Vec<_>>(), "{n}");
            dense.solve(&mut rhs);
            let expected = a.clone().full_piv_lu().solve(&(&a * &x)).unwrap();
            for i in 0..n {
                assert!((rhs[i] - expected[i]).abs() < 1e-8 * expected.amax(), "{n} {i}: {} {}", rhs[i], expected[i]);
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_an_error() {
        let mut dense = Dense::default();
        assert!(dense.factor(&[1.0, 1.0, 1.0, 1.0], 2).is_err());
        assert!(dense.factor(&[f64::NAN], 1).is_err());
    }
}
