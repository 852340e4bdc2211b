//! T2: the curvature r''/|r'|^2 with the mean square of the stretch taken out of the integral.
//!
//! # Equation
//!
//! `u = R/A^2`, `R = rho.g`, `A = a.g = int |r'|^2 dxi`; the derivative of A is kept, so the force
//! has an energy. Where A < 1/4, A^-2 is continued smoothly (`regularisation`).
//!
//! # Validity
//!
//! |r'| nearly constant inside the element.
//!
//! # References
//!
//! Berzeri & Shabana 2000, model T2; Bulin & Hajzman ("ST2", "L2T2").
//!
//! # Alternatives considered
//!
//! A frozen while differentiating (the literal reading): it is the gradient of no energy, the
//! pendulum's energy drifts, and it reproduces the paper's number worse (2.8e-4 m from G10-10,
//! 9.6e-5 with the derivative, 1.02e-4 printed: assets/reference/table1_reproduction.csv).

use super::Bending;
use super::regularisation::RegularisedPower;
use super::secant::PowerSecant;
use super::t1::RHO;
use crate::Real;
use crate::element::axial::moment;
use crate::element::gram::{PAIR_WEIGHT, Six, Upper, form, upper, weighted};

/// Rule T2.
#[derive(Clone, Debug)]
pub struct T2 {
    a: Six<f64>,
    weighted_a: Six<f64>,
}

impl Default for T2 {
    fn default() -> Self {
        let a = moment(|_| 1.0);
        T2 { a, weighted_a: weighted(&a) }
    }
}

impl T2 {
    #[inline(always)]
    fn parts<T: Real>(&self, g: &Six<T>) -> (T, RegularisedPower<T>) {
        (form(&RHO, g), RegularisedPower::new(form(&self.a, g)))
    }
}

impl Bending for T2 {
    fn energy(&self, g: &Six<f64>) -> f64 {
        let (r, a) = self.parts(g);
        r * (a.inverse * a.inverse * a.value(2.0))
    }
    #[inline(always)]
    fn add_gradient<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>) {
        let (r, a) = self.parts(g);
        let square = scale * a.inverse * a.inverse;
        let first = square * a.value(2.0);
        let second = square * r * a.inverse * -2.0 * a.derivative(2.0);
        for i in 0..6 {
            n[i] = n[i] + first * (PAIR_WEIGHT[i] * RHO[i]) + second * self.weighted_a[i];
        }
    }
    #[inline(always)]
    fn add_hessian<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>, h: &mut Upper<T>) {
        let (r, a) = self.parts(g);
        let square = scale * a.inverse * a.inverse;
        let first = square * a.value(2.0);
        // -2 (rho a^T + a rho^T)/A^3 + 6 R a a^T/A^4 = a u^T + u a^T,  u = -2 rho/A^3 + 3 R a/A^4
        let cross = square * a.inverse * -2.0 * a.derivative(2.0);
        let second = cross * r;
        let square = square * r * a.inverse * a.inverse * 3.0;
        let mut u = *g;
        for i in 0..6 {
            u[i] = cross * (PAIR_WEIGHT[i] * RHO[i]) + square * self.weighted_a[i];
        }
        for i in 0..6 {
            n[i] = n[i] + first * (PAIR_WEIGHT[i] * RHO[i]) + second * self.weighted_a[i];
            for j in i..6 {
                let k = upper(i, j);
                h[k] = h[k] + u[j] * self.weighted_a[i] + u[i] * self.weighted_a[j];
            }
        }
    }
    #[inline(always)]
    fn add_discrete_gradient<T: Real>(&self, g: [&Six<T>; 2], scale: T, n: &mut Six<T>) {
        let (r0, r1) = (form(&RHO, g[0]), form(&RHO, g[1]));
        let power = PowerSecant::square(form(&self.a, g[0]), form(&self.a, g[1]));
        let (first, second) = (scale * power.mean, scale * power.slope * (r0 + r1) * 0.5);
        for i in 0..6 {
            n[i] = n[i] + first * (PAIR_WEIGHT[i] * RHO[i]) + second * self.weighted_a[i];
        }
    }
}
