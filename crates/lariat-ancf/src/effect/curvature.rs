//! The squared curvature at Gauss points as a function of the Gram numbers: what damping and rest shape of bending build on.
//!
//! `w = (kappa l/2)^2 = P/Q^3` ([`gauss`](crate::bending::gauss) for P, Q), so a function f(w) has the weighted derivatives
//!
//! ```text
//! n = f' w_g        h = f' w_gg + f'' w_g w_g^T        w_g = P_g/Q^3 - 3 P b/Q^4
//! w_gg = P_gg/Q^3 - 3 (P_g b^T + b P_g^T)/Q^4 + 12 P b b^T/Q^5
//! ```
//!
//! *Source.* As the bending rule. *Validity.* |r'| > 0 at the points.

use crate::Real;
use crate::bending::gauss::{add_weighted_minor_hessian, minor_coefficients, minors, weighted_minor_gradient};
use crate::element::gram::{PAIR_WEIGHT, Six, Upper, form, slope_square, upper, weighted};
use crate::quadrature::gauss_legendre;

/// Constants of one Gauss point.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub weight: f64,
    b: Six<f64>,
    weighted_b: Six<f64>,
    m: Six<f64>,
}

/// The squared curvature at a point of an element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Squared<T> {
    /// w, not below 0.
    pub w: T,
    /// Weighted gradient.
    pub gradient: Six<T>,
    /// 1/Q.
    inverse: T,
}

/// Gauss points of the rule, ascending.
pub(crate) fn points(count: usize) -> Vec<Point> {
    gauss_legendre(count).into_iter().map(|(xi, weight)| Point::at(xi, weight)).collect()
}

impl Point {
    /// The point at xi in `[0, 1]`.
    pub fn at(xi: f64, weight: f64) -> Self {
        let b = slope_square(xi);
        Point { weight, b, weighted_b: weighted(&b), m: minor_coefficients(xi) }
    }

    /// w and its gradient.
    #[inline(always)]
    pub fn squared<T: Real>(&self, g: &Six<T>) -> Squared<T> {
        let one = g[0].splat(1.0);
        let inverse = one / form(&self.b, g);
        let cube = inverse * inverse * inverse;
        let p = form(&self.m, &minors(g));
        // P >= 0; rounding of the minors of a straight element may leave it at -1e-16
        let p = (p + p.abs()) * 0.5;
        let slope = cube * inverse * p * -3.0;
        let mut gradient = weighted_minor_gradient(&self.m, g);
        for i in 0..6 {
            gradient[i] = cube * gradient[i] + slope * self.weighted_b[i];
        }
        Squared { w: cube * p, gradient, inverse }
    }

    /// Adds `scale w_gg` to a weighted Hessian.
    #[inline(always)]
    pub fn add_second<T: Real>(&self, g: &Six<T>, at: &Squared<T>, scale: T, h: &mut Upper<T>) {
        let cube = scale * at.inverse * at.inverse * at.inverse;
        let mut m = *g;
        for i in 0..6 {
            m[i] = cube * self.m[i];
        }
        add_weighted_minor_hessian(&m, h);
        // -3 (P_g b^T + b P_g^T)/Q^4 + 12 P b b^T/Q^5 = b u^T + u b^T, u = -3 w_g/Q - 3 w b/Q^2
        let first = scale * at.inverse * -3.0;
        let second = first * at.inverse * at.w;
        let mut u = *g;
        for i in 0..6 {
            u[i] = first * at.gradient[i] + second * self.weighted_b[i];
        }
        for i in 0..6 {
            for j in i..6 {
                let k = upper(i, j);
                h[k] = h[k] + u[j] * self.weighted_b[i] + u[i] * self.weighted_b[j];
            }
        }
    }
}

impl<T: Real> Squared<T> {
    /// dw/dt for the plain rates of the Gram numbers.
    #[inline(always)]
    pub fn rate(&self, rates: &Six<T>) -> T {
        let mut sum = self.gradient[0] * rates[0] * (1.0 / PAIR_WEIGHT[0]);
        for a in 1..6 {
            sum = sum + self.gradient[a] * rates[a] * (1.0 / PAIR_WEIGHT[a]);
        }
        sum
    }

    /// Adds `scale w_g` to a weighted gradient.
    #[inline(always)]
    pub fn add_gradient(&self, scale: T, n: &mut Six<T>) {
        for i in 0..6 {
            n[i] = n[i] + scale * self.gradient[i];
        }
    }

    /// Adds `scale w_g w_g^T` to a weighted Hessian.
    #[inline(always)]
    pub fn add_square(&self, scale: T, h: &mut Upper<T>) {
        for i in 0..6 {
            let row = scale * self.gradient[i];
            for j in i..6 {
                let k = upper(i, j);
                h[k] = h[k] + row * self.gradient[j];
            }
        }
    }
}
