//! The squared curvature at Gauss points as a function of the Gram numbers: shared by damping and
//! rest shape of bending.
//!
//! # Equation
//!
//! `w = (kappa l/2)^2 = P/Q^3` ([`gauss`](crate::element::bending::gauss) for P, Q), so a function
//! f(w) has the weighted derivatives
//!
//! ```text
//! n = f' w_g        h = f' w_gg + f'' w_g w_g^T        w_g = P_g/Q^3 - 3 P b/Q^4
//! w_gg = P_gg/Q^3 - 3 (P_g b^T + b P_g^T)/Q^4 + 12 P b b^T/Q^5
//! ```
//!
//! with Q^-3 and its derivatives continued where an element is crumpled
//! ([`regularisation`](crate::element::bending::regularisation)).
//!
//! # Validity
//!
//! Any element state.

use crate::Real;
use crate::element::bending::PowerSecant;
use crate::element::bending::gauss::{add_weighted_minor_hessian, minor_coefficients, minors, weighted_minor_gradient};
use crate::element::bending::regularisation::RegularisedPower;
use crate::element::gram::{PAIR_WEIGHT, Six, Upper, form, slope_square, upper, weighted};
use crate::quadrature::gauss_legendre;
use crate::rule::BendingRule;
use crate::scales::effect::POINTS;

/// Constants of one Gauss point.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub weight: f64,
    b: Six<f64>,
    weighted_b: Six<f64>,
    m: Six<f64>,
    /// |l r''/2|^2 in Gram numbers.
    second: Six<f64>,
}

/// The squared curvature at a point of an element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Squared<T> {
    /// w, not below 0.
    pub w: T,
    /// Weighted gradient.
    pub gradient: Six<T>,
    p: T,
    /// P_g, weighted.
    minor: Six<T>,
    /// Q^-3, its first derivative and half of its second.
    powers: [T; 3],
    /// 1/Q, at most 4.
    pub inverse: T,
}

/// Points of a bending rule, ascending; none without bending.
pub(crate) fn points_of(rule: BendingRule) -> Vec<Point> {
    let count = match rule {
        BendingRule::None => return Vec::new(),
        BendingRule::Gauss(count) => count as usize,
        BendingRule::T1 | BendingRule::T2 => POINTS,
    };
    gauss_legendre(count).into_iter().map(|(xi, weight)| Point::at(xi, weight)).collect()
}

impl Point {
    /// Creates the point at xi in `[0, 1]`.
    pub fn at(xi: f64, weight: f64) -> Self {
        let b = slope_square(xi);
        // l r''/2 in control vectors
        let [s0, s1, s2] = [3.0 * xi - 2.0, 1.0 - 2.0 * xi, 3.0 * xi - 1.0];
        let second = [s0 * s0, s0 * s1, s0 * s2, s1 * s1, s1 * s2, s2 * s2];
        Point { weight, b, weighted_b: weighted(&b), m: minor_coefficients(xi), second }
    }

    /// Returns w and its gradient.
    #[inline(always)]
    pub fn squared<T: Real>(&self, g: &Six<T>) -> Squared<T> {
        let at = RegularisedPower::new(form(&self.b, g));
        let cube = at.inverse * at.inverse * at.inverse;
        let fourth = cube * at.inverse;
        let powers = [cube * at.value(3.0), fourth * at.derivative(3.0) * -3.0, fourth * at.inverse * 6.0];
        let p = form(&self.m, &minors(g));
        // P >= 0; rounding of the minors of a straight element may leave it at -1e-16
        let p = (p + p.abs()) * 0.5;
        let minor = weighted_minor_gradient(&self.m, g);
        let slope = powers[1] * p;
        let mut gradient = minor;
        for i in 0..6 {
            gradient[i] = powers[0] * minor[i] + slope * self.weighted_b[i];
        }
        Squared { w: powers[0] * p, gradient, p, minor, powers, inverse: at.inverse }
    }

    /// w at both ends of a step, and the weighted discrete gradient: its product with the change of
    /// the Gram numbers is the change of w. `x` and `mean` are the means of the minors and of the
    /// Gram numbers.
    #[inline(always)]
    pub fn secant<T: Real>(&self, g: [&Six<T>; 2], x: &Six<T>, mean: &Six<T>) -> ([T; 2], Six<T>) {
        let power = PowerSecant::cube(form(&self.b, g[0]), form(&self.b, g[1]));
        let second = power.slope * form(&self.m, x);
        let mut gradient = weighted_minor_gradient(&self.m, mean);
        for i in 0..6 {
            gradient[i] = power.mean * gradient[i] + second * self.weighted_b[i];
        }
        ([self.squared(g[0]).w, self.squared(g[1]).w], gradient)
    }

    /// Adds the pairs of `scale |l r''/2|^2`: the [`gradient`](crate::element::gram::gradient) of
    /// any three vectors with these pairs is the gradient of half of it.
    #[inline(always)]
    pub fn add_second_derivative<T: Real>(&self, scale: T, n: &mut Six<T>) {
        for i in 0..6 {
            n[i] = n[i] + scale * self.second[i];
        }
    }

    /// Adds `scale w_gg` to a weighted Hessian.
    #[inline(always)]
    pub fn add_second<T: Real>(&self, g: &Six<T>, at: &Squared<T>, scale: T, h: &mut Upper<T>) {
        let value = scale * at.powers[0];
        let mut m = *g;
        for i in 0..6 {
            m[i] = value * self.m[i];
        }
        add_weighted_minor_hessian(&m, h);
        // -3 (P_g b^T + b P_g^T)/Q^4 + 12 P b b^T/Q^5 = b u^T + u b^T, u = -3 P_g/Q^4 + 6 P b/Q^5
        let first = scale * at.powers[1];
        let second = scale * at.powers[2] * at.p;
        let mut u = *g;
        for i in 0..6 {
            u[i] = first * at.minor[i] + second * self.weighted_b[i];
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
    /// Returns dw/dt for the plain rates of the Gram numbers.
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

    /// Adds `scale P_g/Q^3`: pairs of the squared change of `r' x r''`, never negative for a
    /// positive scale.
    #[inline(always)]
    pub fn add_minor(&self, scale: T, n: &mut Six<T>) {
        let scale = scale * self.powers[0];
        for i in 0..6 {
            n[i] = n[i] + scale * self.minor[i];
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
