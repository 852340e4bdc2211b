//! Linear equations whose matrix is known by its products alone.
//!
//! # Equation
//!
//! With P the symmetric part of the matrix J, which is factored, and the products `P^-1 J x`, the
//! solution of `P^-1 J x = P^-1 r` is built from the Krylov space of `P^-1 r`: the residual is the
//! smallest over the space (GMRES, by Arnoldi's orthogonalisation and Givens rotations).
//!
//! # Validity
//!
//! The number of products is about that of the eigenvalues of `P^-1 J` that are not near 1: in a
//! flow, of the shapes that its skew part reaches. A solution that has not converged in
//! [`MOST_PRODUCTS`] is the best of its space.
//!
//! # References
//!
//! Saad & Schultz 1986; with products by differences, Knoll & Keyes 2004.
//!
//! # Alternatives considered
//!
//! The symmetric part alone, which converges linearly in a slow flow, and not at all in a fast one.

use crate::scales::statics::{MOST_PRODUCTS, PRODUCTS_CONVERGED};

/// Solves in place: `x` is `P^-1 r`, and becomes the solution. `product` returns `P^-1 J v`.
pub(super) fn solve(x: &mut [f64], mut product: impl FnMut(&[f64], &mut [f64])) {
    let size = norm(x);
    if !(size > 0.0 && size.is_finite()) {
        return;
    }
    let mut basis: Vec<Vec<f64>> = vec![x.iter().map(|x| x / size).collect()];
    // the triangle of the least squares by columns, its right side, and the rotations
    let (mut columns, mut right, mut turns): (Vec<Vec<f64>>, Vec<f64>, Vec<[f64; 2]>) =
        (Vec::new(), vec![size], Vec::new());
    while columns.len() < MOST_PRODUCTS {
        let k = columns.len();
        let mut next = vec![0.0; x.len()];
        product(&basis[k], &mut next);
        let mut column = Vec::with_capacity(k + 2);
        for old in &basis {
            let along = dot(old, &next);
            next.iter_mut().zip(old).for_each(|(next, old)| *next -= along * old);
            column.push(along);
        }
        let rest = norm(&next);
        for (i, [cosine, sine]) in turns.iter().enumerate() {
            let (a, b) = (column[i], column[i + 1]);
            (column[i], column[i + 1]) = (cosine * a + sine * b, cosine * b - sine * a);
        }
        let diagonal = column[k].hypot(rest);
        if !(diagonal > 0.0 && diagonal.is_finite()) {
            break;
        }
        let turn = [column[k] / diagonal, rest / diagonal];
        column[k] = diagonal;
        columns.push(column);
        turns.push(turn);
        let left = right[k];
        right[k] = turn[0] * left;
        right.push(-turn[1] * left);
        if rest == 0.0 || right[k + 1].abs() <= PRODUCTS_CONVERGED * size {
            break;
        }
        basis.push(next.into_iter().map(|x| x / rest).collect());
    }
    let mut weights = vec![0.0; columns.len()];
    for i in (0..columns.len()).rev() {
        let known: f64 = (i + 1..columns.len()).map(|k| columns[k][i] * weights[k]).sum();
        weights[i] = (right[i] - known) / columns[i][i];
    }
    if weights.is_empty() {
        return;
    }
    x.fill(0.0);
    for (weight, vector) in weights.iter().zip(&basis) {
        x.iter_mut().zip(vector).for_each(|(x, v)| *x += weight * v);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// A matrix whose skew part is three times its symmetric one, with which the iteration with the
    /// symmetric part diverges.
    ///
    /// *Source.* The equation itself.
    #[test]
    fn a_matrix_that_is_far_from_symmetric_is_solved() {
        let n = 12;
        let matrix = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { 3.0 * (i as f64 - j as f64).sin() });
        let right = DVector::from_fn(n, |i, _| 1.0 + i as f64);
        let mut x = right.as_slice().to_vec();
        let mut products = 0;
        solve(&mut x, |v, out| {
            products += 1;
            out.copy_from_slice((&matrix * DVector::from_column_slice(v)).as_slice());
        });
        let off = (&matrix * DVector::from_vec(x) - &right).norm() / right.norm();
        assert!(off <= 1.01 * PRODUCTS_CONVERGED && products <= n, "{off} {products}");
        let mut none = [0.0; 3];
        solve(&mut none, |_, _| unreachable!());
    }
}
