//! Shape functions of the element: cubic Hermite in the rest arc length.
//!
//! # Equation
//!
//! `r(xi) = s1 r_i + s2 l t_i + s3 r_j + s4 l t_j`, `s1 = 1 - 3 xi^2 + 2 xi^3`, `s2 = xi - 2 xi^2 +
//! xi^3`, `s3 = 3 xi^2 - 2 xi^3`, `s4 = xi^3 - xi^2`. Element coordinates are four 3-vectors (r_i,
//! t_i, r_j, t_j), t = dr/dx dimensionless.
//!
//! # References
//!
//! Gerstmayr & Shabana 2006, eq. 2.

use nalgebra::Vector3;

/// Weights of (r_i, t_i, r_j, t_j) in the position at xi; those of the slopes in m.
pub fn position(xi: f64, length: f64) -> [f64; 4] {
    let (x2, x3) = (xi * xi, xi * xi * xi);
    [1.0 - 3.0 * x2 + 2.0 * x3, length * (xi - 2.0 * x2 + x3), 3.0 * x2 - 2.0 * x3, length * (x3 - x2)]
}

/// Weights in the slope r' at xi; those of the positions in 1/m.
pub fn slope(xi: f64, length: f64) -> [f64; 4] {
    let bubble = 6.0 * xi * (1.0 - xi);
    [-bubble / length, 1.0 - 4.0 * xi + 3.0 * xi * xi, bubble / length, 3.0 * xi * xi - 2.0 * xi]
}

/// Weights in r'' at xi; those of the positions in 1/m^2, of the slopes in 1/m.
pub fn second_derivative(xi: f64, length: f64) -> [f64; 4] {
    let bend = (12.0 * xi - 6.0) / (length * length);
    [bend, (6.0 * xi - 4.0) / length, -bend, (6.0 * xi - 2.0) / length]
}

/// Returns what weights of (r_i, t_i, r_j, t_j) make of the nodal coordinates `q` of a cable, at a
/// point of an element.
#[inline]
pub fn combine(q: &[f64], element: usize, shape: &[f64; 4]) -> Vector3<f64> {
    let d = &q[6 * element..6 * element + 12];
    let part = |x: usize| shape[0] * d[x] + shape[1] * d[3 + x] + shape[2] * d[6 + x] + shape[3] * d[9 + x];
    Vector3::new(part(0), part(1), part(2))
}
