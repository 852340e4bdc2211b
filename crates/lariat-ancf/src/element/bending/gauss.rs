//! Gauss quadrature of the full squared curvature with 1 to 10 points.
//!
//! # Equation
//!
//! `u = sum_q w_q P_q/Q_q^3`, `Q = |r'|^2 = b.g`, and with `p01 = (1-xi)^2`, `p02 = xi(1-xi) -
//! (1-xi)^2 - xi^2`, `p12 = xi^2`
//!
//! ```text
//! (l/2) r' x r'' = p01 d0xd1 + p02 d0xd2 + p12 d1xd2        P = m . X(g)
//! ```
//!
//! where X are the six products of those cross products, which are the 2x2 minors of the Gram
//! matrix (Binet-Cauchy), and m the monomials of p. The degree of r' x r'' is two, not three: the
//! cubic terms cancel.
//!
//! # Validity
//!
//! Any: where |r'| < 1/2 at a point, Q^-3 is continued smoothly (`regularisation`). Two points or
//! more: one leaves zero-energy modes.
//!
//! # References
//!
//! Gerstmayr & Shabana 2006 (curvature); Bulin & Hajzman, *T* points.
//!
//! # Alternatives considered
//!
//! Three-vectors at the points (three times the work); the rational integral in closed form (paper:
//! too long).

use super::Bending;
use super::regularisation::RegularisedPower;
use super::secant::PowerSecant;
use crate::Real;
use crate::element::gram::{Six, Upper, form, slope_square, upper, weighted};
use crate::quadrature::gauss_legendre;

/// Constants of one Gauss point.
#[derive(Clone, Debug)]
struct Point {
    weight: f64,
    b: Six<f64>,
    weighted_b: Six<f64>,
    m: Six<f64>,
}

/// Gauss quadrature of the full curvature.
#[derive(Clone, Debug)]
pub struct Gauss {
    points: Vec<Point>,
}

impl Gauss {
    /// The rule with `points` Gauss points.
    pub fn new(points: usize) -> Self {
        let points = gauss_legendre(points)
            .into_iter()
            .map(|(xi, weight)| {
                let b = slope_square(xi);
                Point { weight, b, weighted_b: weighted(&b), m: minor_coefficients(xi) }
            })
            .collect();
        Gauss { points }
    }
}

/// The monomials m with `(l^2/4) |r' x r''|^2 = m . X(g)` at xi.
pub(crate) fn minor_coefficients(xi: f64) -> Six<f64> {
    let p01 = (1.0 - xi) * (1.0 - xi);
    let p12 = xi * xi;
    let p02 = xi * (1.0 - xi) - p01 - p12;
    [p01 * p01, 2.0 * p01 * p02, 2.0 * p01 * p12, p02 * p02, 2.0 * p02 * p12, p12 * p12]
}

/// The 2x2 minors of the Gram matrix, for the pairs of cross products (01,01), (01,02), (01,12),
/// (02,02), (02,12), (12,12).
#[inline(always)]
pub(crate) fn minors<T: Real>(g: &Six<T>) -> Six<T> {
    let [g00, g01, g02, g11, g12, g22] = *g;
    [
        g00 * g11 - g01 * g01,
        g00 * g12 - g02 * g01,
        g01 * g12 - g02 * g11,
        g00 * g22 - g02 * g02,
        g01 * g22 - g02 * g12,
        g11 * g22 - g12 * g12,
    ]
}

/// Weighted gradient of `m . X(g)`, for numbers m (constants or lanes).
#[inline(always)]
pub(crate) fn weighted_minor_gradient<T, M: Copy>(m: &Six<M>, g: &Six<T>) -> Six<T>
where
    T: Real + core::ops::Mul<M, Output = T>,
{
    let [g00, g01, g02, g11, g12, g22] = *g;
    let first = g11 * m[0] + g12 * m[1] + g22 * m[3];
    let fourth = g00 * m[0] - g02 * m[2] + g22 * m[5];
    let sixth = g00 * m[3] + g01 * m[4] + g11 * m[5];
    let g01m0 = g01 * m[0];
    let g02m3 = g02 * m[3];
    let g12m5 = g12 * m[5];
    [
        first + first,
        g12 * m[2] + g22 * m[4] - g02 * m[1] - (g01m0 + g01m0),
        -(g01 * m[1]) - g11 * m[2] - g12 * m[4] - (g02m3 + g02m3),
        fourth + fourth,
        g00 * m[1] + g01 * m[2] - g02 * m[4] - (g12m5 + g12m5),
        sixth + sixth,
    ]
}

/// Adds the weighted Hessian of `m . X(g)`, which does not depend on g.
#[inline(always)]
pub(crate) fn add_weighted_minor_hessian<T: Real>(m: &Six<T>, h: &mut Upper<T>) {
    let two = [m[0] + m[0], m[1] + m[1], m[2] + m[2], m[3] + m[3], m[4] + m[4], m[5] + m[5]];
    let entries = [
        (0, 3, two[0] + two[0]),
        (0, 4, two[1]),
        (0, 5, two[3] + two[3]),
        (1, 1, -two[0]),
        (1, 2, -m[1]),
        (1, 4, m[2]),
        (1, 5, two[4]),
        (2, 2, -two[3]),
        (2, 3, -two[2]),
        (2, 4, -m[4]),
        (3, 5, two[5] + two[5]),
        (4, 4, -two[5]),
    ];
    for (a, b, value) in entries {
        h[upper(a, b)] = h[upper(a, b)] + value;
    }
}

impl Bending for Gauss {
    fn energy(&self, g: &Six<f64>) -> f64 {
        let x = minors(g);
        // P >= 0; rounding of the minors of a straight element may leave it at -1e-16
        self.points
            .iter()
            .map(|p| p.weight * form(&p.m, &x).max(0.0) * RegularisedPower::new(form(&p.b, g)).cube())
            .sum()
    }

    #[inline(always)]
    fn add_gradient<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>) {
        let x = minors(g);
        let zero = scale.splat(0.0);
        // gradient of sum_q c_q P_q at fixed c_q = w_q/Q_q^3 is one sweep over the minors: collect
        // c_q m_q first
        let mut minor_weights = [zero; 6];
        for point in &self.points {
            let at = RegularisedPower::new(form(&point.b, g));
            let cube = scale * at.inverse * at.inverse * at.inverse * point.weight;
            let slope = cube * at.inverse * form(&point.m, &x) * -3.0 * at.derivative(3.0);
            let cube = cube * at.value(3.0);
            for i in 0..6 {
                minor_weights[i] = minor_weights[i] + cube * point.m[i];
                n[i] = n[i] + slope * point.weighted_b[i];
            }
        }
        let v = weighted_minor_gradient(&minor_weights, g);
        for i in 0..6 {
            n[i] = n[i] + v[i];
        }
    }

    #[inline(always)]
    fn add_hessian<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>, h: &mut Upper<T>) {
        let x = minors(g);
        let zero = scale.splat(0.0);
        let mut minor_weights = [zero; 6];
        for point in &self.points {
            let at = RegularisedPower::new(form(&point.b, g));
            let cube = scale * at.inverse * at.inverse * at.inverse * point.weight;
            let fourth = cube * at.inverse;
            let p = form(&point.m, &x);
            // Hessian: c Pi + b u^T + u b^T, u = -3 v/Q^4 + 6 P b/Q^5, v = dP/dg
            let v = weighted_minor_gradient(&point.m, g);
            let square = fourth * p * at.inverse * 6.0;
            let cross = fourth * -3.0 * at.derivative(3.0);
            let slope = cross * p;
            let cube = cube * at.value(3.0);
            let mut u = v;
            for i in 0..6 {
                u[i] = cross * v[i] + square * point.weighted_b[i];
            }
            for i in 0..6 {
                minor_weights[i] = minor_weights[i] + cube * point.m[i];
                n[i] = n[i] + slope * point.weighted_b[i];
                for j in i..6 {
                    let k = upper(i, j);
                    h[k] = h[k] + u[j] * point.weighted_b[i] + u[i] * point.weighted_b[j];
                }
            }
        }
        let v = weighted_minor_gradient(&minor_weights, g);
        for i in 0..6 {
            n[i] = n[i] + v[i];
        }
        add_weighted_minor_hessian(&minor_weights, h);
    }

    #[inline(always)]
    fn add_discrete_gradient<T: Real>(&self, g: [&Six<T>; 2], scale: T, n: &mut Six<T>) {
        // D(P f) = f_mean DP + P_mean Df, and DP = P_g at the mean numbers, since P is quadratic in
        // them
        let (x, mean) = middle(g);
        let zero = scale.splat(0.0);
        let mut minor_weights = [zero; 6];
        for point in &self.points {
            let power = PowerSecant::cube(form(&point.b, g[0]), form(&point.b, g[1]));
            let (first, second) = (scale * power.mean * point.weight, scale * power.slope * point.weight);
            let second = second * form(&point.m, &x);
            for i in 0..6 {
                minor_weights[i] = minor_weights[i] + first * point.m[i];
                n[i] = n[i] + second * point.weighted_b[i];
            }
        }
        let v = weighted_minor_gradient(&minor_weights, &mean);
        for i in 0..6 {
            n[i] = n[i] + v[i];
        }
    }
}

/// The mean of the minors at both ends of a step, and the mean of the Gram numbers.
#[inline(always)]
pub(crate) fn middle<T: Real>(g: [&Six<T>; 2]) -> (Six<T>, Six<T>) {
    let (mut x, last) = (minors(g[0]), minors(g[1]));
    let mut mean = *g[0];
    for i in 0..6 {
        x[i] = (x[i] + last[i]) * 0.5;
        mean[i] = (mean[i] + g[1][i]) * 0.5;
    }
    (x, mean)
}
