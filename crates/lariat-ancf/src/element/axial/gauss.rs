//! Gauss quadrature of the squared Green strain with 1 to 10 points.
//!
//! # Equation
//!
//! `A = sum_q w_q b_q b_q^T`, `a = sum_q w_q b_q`.
//!
//! # Validity
//!
//! Five points and more are exact. Three and four under-integrate, which reduces locking a little.
//! One and two points leave zero-energy modes of the slope: rejected beside a full-curvature rule
//! ([`Rule::check`](crate::Rule::check)).
//!
//! # References
//!
//! Bulin & Hajzman, strategies "G*L*-*T*".
//!
//! # Alternatives considered
//!
//! Summing over points at run time: the sum is a constant matrix.

use super::{AxialTable, add_outer};
use crate::element::gram::slope_square;
use crate::quadrature::gauss_legendre;

/// The rule with `points` Gauss points.
pub fn table(points: usize) -> AxialTable {
    let (mut a, mut matrix) = ([0.0; 6], [0.0; 21]);
    let mut linear = [0.0; 6];
    for (xi, w) in gauss_legendre(points) {
        let b = slope_square(xi);
        for i in 0..6 {
            a[i] += w * b[i];
            linear[i] += w * (xi - 0.5) * b[i];
        }
        add_outer(&mut matrix, w, &b);
    }
    AxialTable::new(a, matrix).with_linear(linear)
}
