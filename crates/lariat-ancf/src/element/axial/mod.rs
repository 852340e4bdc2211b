//! Axial rules: how the energy of the Green strain eps = (r'.r' - 1)/2 is integrated over an
//! element.
//!
//! Since r'.r' = b(xi).g, *every* rule here is a constant quadratic form of the six Gram numbers g
//! (see [`gram`](crate::element::gram)):
//!
//! ```text
//! U = EA l/8 (g.A.g - 2 a.g + 1)        dU/dg = EA l/4 (A g - a)        d2U/dg2 = EA l/4 A
//! ```
//!
//! so a rule is a table (a, A) made once, the Hessian is a constant, and a ten-point Gauss rule
//! costs what mean strain costs. *Validity.* Any strain; the Green law softens in compression
//! (dN/df = 0 at f = 0.577).
//!
//! | file | rule | paper's name |
//! |---|---|---|
//! | [`exact`] | the integral itself | S |
//! | [`gauss`] | Gauss quadrature, 1 to 10 points | G*L* |
//! | [`mean`] | mean Green strain | L2 |
//! | [`projected`] | strain projected on linear functions (default) | - |

pub mod exact;
pub mod gauss;
pub mod mean;
pub mod projected;

use crate::Real;
use crate::element::gram::{PAIR_WEIGHT, Six, Upper, form, quadratic_form, slope_square, upper};
use crate::quadrature::gauss_legendre;

/// An axial rule as numbers: `U = EA l/8 (g.A.g - 2 a.g + 1)`.
#[derive(Clone, Debug, PartialEq)]
pub struct AxialTable {
    /// The vector a (plain, not weighted).
    pub a: Six<f64>,
    /// The matrix A (plain, not weighted).
    pub matrix: Upper<f64>,
    /// `int (xi - 1/2) b` by the rule's own quadrature: what it sees of a strain that is linear in
    /// xi. Zero for a rule with one strain per element.
    linear: Six<f64>,
    /// a, weighted by [`PAIR_WEIGHT`].
    weighted_a: Six<f64>,
    /// Rows of A weighted, columns plain: from g to the weighted gradient.
    weighted_rows: [Six<f64>; 6],
    /// A weighted on both sides: the weighted Hessian of a unit `EA l/4`.
    weighted_matrix: Upper<f64>,
}

impl AxialTable {
    /// Makes a table from `a` and `A`.
    pub fn new(a: Six<f64>, matrix: Upper<f64>) -> Self {
        let entry = |i: usize, j: usize| matrix[upper(i, j)];
        let mut weighted_matrix = [0.0; 21];
        for i in 0..6 {
            for j in i..6 {
                weighted_matrix[upper(i, j)] = PAIR_WEIGHT[i] * PAIR_WEIGHT[j] * entry(i, j);
            }
        }
        AxialTable {
            a,
            matrix,
            linear: [0.0; 6],
            weighted_a: core::array::from_fn(|i| PAIR_WEIGHT[i] * a[i]),
            weighted_rows: core::array::from_fn(|i| core::array::from_fn(|j| PAIR_WEIGHT[i] * entry(i, j))),
            weighted_matrix,
        }
    }

    /// Returns the table of a rule that sees linear strains, too.
    fn with_linear(self, linear: Six<f64>) -> Self {
        AxialTable { linear, ..self }
    }

    /// Returns the Green strain at xi that the rule resists, projected on linear functions by its
    /// own moments a and d: `a.g/2 - 1/2 + 6 d.g (xi - 1/2)`. Of a rule with one strain per element
    /// it is that one: what varies inside has no energy and makes no force.
    pub(crate) fn strain(&self, g: &Six<f64>, xi: f64) -> f64 {
        let dot = |x: &Six<f64>| (0..6).map(|i| x[i] * g[i]).sum::<f64>();
        0.5 * ((dot(&self.a) - 1.0) + 12.0 * dot(&self.linear) * (xi - 0.5))
    }

    /// Energy of an element divided by `EA l/8`.
    pub fn energy(&self, g: &Six<f64>) -> f64 {
        quadratic_form(&self.matrix, g, g) - 2.0 * form(&self.a, g) + 1.0
    }

    /// Weighted gradient n, with `quarter = EA l/4`.
    #[inline(always)]
    pub fn gradient<T: Real>(&self, g: &Six<T>, quarter: T) -> Six<T> {
        let mut n = *g;
        for i in 0..6 {
            n[i] = (form(&self.weighted_rows[i], g) - self.weighted_a[i]) * quarter;
        }
        n
    }

    /// Adds `scale A x`, weighted, to `n`.
    #[inline(always)]
    pub(crate) fn add_product<T: Real>(&self, x: &Six<T>, scale: T, n: &mut Six<T>) {
        for i in 0..6 {
            n[i] = n[i] + form(&self.weighted_rows[i], x) * scale;
        }
    }

    /// Adds `scale a`, weighted, to `n`.
    #[inline(always)]
    pub(crate) fn add_mean<T: Real>(&self, scale: T, n: &mut Six<T>) {
        for i in 0..6 {
            n[i] = n[i] + scale * self.weighted_a[i];
        }
    }

    /// Adds `scale A`, weighted on both sides, to `h`.
    #[inline(always)]
    pub(crate) fn add_hessian<T: Real>(&self, scale: T, h: &mut Upper<T>) {
        for i in 0..21 {
            h[i] = h[i] + scale * self.weighted_matrix[i];
        }
    }

    /// Weighted Hessian h, with `quarter = EA l/4`.
    #[inline(always)]
    pub fn hessian<T: Real>(&self, quarter: T) -> Upper<T> {
        let mut h = [quarter; 21];
        for i in 0..21 {
            h[i] = quarter * self.weighted_matrix[i];
        }
        h
    }
}

/// Adds `weight * x y^T` (symmetric part) to a matrix stored as [`Upper`].
pub(crate) fn add_outer(m: &mut Upper<f64>, weight: f64, x: &Six<f64>) {
    for a in 0..6 {
        for b in a..6 {
            m[upper(a, b)] += weight * x[a] * x[b];
        }
    }
}

/// `integral of f(xi) b(xi)` over the element, exact for polynomials f of degree 5 at most.
pub(crate) fn moment(f: impl Fn(f64) -> f64) -> Six<f64> {
    let mut sum = [0.0; 6];
    for (xi, w) in gauss_legendre(5) {
        let b = slope_square(xi);
        for i in 0..6 {
            sum[i] += w * f(xi) * b[i];
        }
    }
    sum
}
