//! Forces at points of an element, added to the coordinates of its nodes.

use crate::linalg::BlockTridiagonal;
use nalgebra::{Matrix3, Vector3};

/// Adds a force or impulse, whose work is on the vector with these weights, to the rows of an
/// element.
#[inline]
pub(crate) fn add_force(rows: &mut [f64], element: usize, weights: &[f64; 4], force: &Vector3<f64>) {
    let out = &mut rows[6 * element..6 * element + 12];
    for (k, weight) in weights.iter().enumerate() {
        for x in 0..3 {
            out[3 * k + x] += weight * force[x];
        }
    }
}

/// Adds the tangent of such a force to the blocks of an element, of which one triangle is stored.
#[inline]
pub(crate) fn add_tangent(matrix: &mut BlockTridiagonal, element: usize, weights: &[f64; 4], tangent: &Matrix3<f64>) {
    for (p, left) in weights.iter().enumerate() {
        for (q, right) in weights.iter().enumerate() {
            let block = match (p / 2, q / 2) {
                (0, 0) => &mut matrix.diag[element],
                (1, 1) => &mut matrix.diag[element + 1],
                (1, 0) => &mut matrix.lower[element],
                _ => continue,
            };
            let (row, column, weight) = (3 * (p % 2), 3 * (q % 2), left * right);
            for c in 0..3 {
                for r in 0..3 {
                    block.0[column + c][row + r] += weight * tangent[(r, c)];
                }
            }
        }
    }
}
