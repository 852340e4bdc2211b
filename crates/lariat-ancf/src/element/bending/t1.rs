//! T1: the curvature vector taken as r'' (slopes near 1, small rotations inside the element).
//!
//! # Equation
//!
//! `u = rho.g`, `rho.g = (l^2/4) int |r''|^2 dxi`, `rho = (1, -1, 1, 1/3, -1, 1)` in the pairs of
//! the d basis. The force is linear, the tangent constant.
//!
//! # Validity
//!
//! |r'| within a few percent of 1; it also resists a change of |r'| along the element, so it leaves no zero-energy mode with any axial
//! rule.
//!
//! # References
//!
//! Berzeri & Shabana 2000, model T1.

use super::Bending;
use crate::Real;
use crate::element::gram::{PAIR_WEIGHT, Six, Upper, form};

/// `(l^2/4) int |r''|^2 dxi = rho . g`.
pub const RHO: Six<f64> = [1.0, -1.0, 1.0, 1.0 / 3.0, -1.0, 1.0];

/// Rule T1.
#[derive(Clone, Copy, Debug, Default)]
pub struct T1;

impl Bending for T1 {
    fn energy(&self, g: &Six<f64>) -> f64 {
        form(&RHO, g)
    }
    #[inline(always)]
    fn add_gradient<T: Real>(&self, _: &Six<T>, scale: T, n: &mut Six<T>) {
        for i in 0..6 {
            n[i] = n[i] + scale * (PAIR_WEIGHT[i] * RHO[i]);
        }
    }
    #[inline(always)]
    fn add_hessian<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>, _: &mut Upper<T>) {
        self.add_gradient(g, scale, n);
    }
    #[inline(always)]
    fn add_discrete_gradient<T: Real>(&self, [start, _]: [&Six<T>; 2], scale: T, n: &mut Six<T>) {
        self.add_gradient(start, scale, n);
    }
}
