//! Bending rules: how the energy EI kappa^2/2 of the curvature kappa = |r' x r''| / |r'|^3 is
//! integrated over an element.
//!
//! # Equation
//!
//! With `P = |r' x r''|^2 l^2/4` and `Q = |r'|^2`, both scalar functions of the Gram numbers
//! ([`gram`](crate::element::gram)), every rule has the form `U = (2 EI/l) u(g)`:
//!
//! | file | u(g) | paper's name |
//! |---|---|---|
//! | [`gauss`] | sum_q w_q P_q/Q_q^3 | *T* points |
//! | [`t1`] | rho.g: mean of \|r''\|^2, |r'| taken as 1 | T1 |
//! | [`t2`] | rho.g/(a.g)^2: mean stretch divided out | T2 |
//! | [`NoBending`] | 0: a chain, a rope without bending stiffness | - |
//!
//! # Validity
//!
//! Any element state: where |r'| falls below one half, the powers of 1/Q are continued smoothly
//! (`regularisation`).
//!
//! A new rule implements [`Bending`], a scalar function with its weighted gradient and Hessian; it
//! needs a name in [`BendingRule`](crate::BendingRule) and a variant of the kernel in
//! `system/elements.rs`, which the compiler asks for.

pub mod gauss;
pub(crate) mod regularisation;
mod secant;
pub mod t1;
pub mod t2;

pub(crate) use secant::PowerSecant;

use crate::Real;
use crate::element::gram::{Six, Upper};

/// A bending energy `u(g)` per `2 EI/l`, with weighted derivatives (see
/// [`gram`](crate::element::gram)).
pub trait Bending {
    /// Returns the energy u(g).
    fn energy(&self, g: &Six<f64>) -> f64;
    /// Adds `scale * e_a du/dg_a` to `n`.
    fn add_gradient<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>);
    /// Adds the weighted gradient to `n` and the weighted Hessian to `h`, both times `scale`.
    fn add_hessian<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>, h: &mut Upper<T>);
    /// Adds `scale` times a weighted discrete gradient to `n`. With the Gram numbers `g` at both
    /// ends of a step, its product with their change is the change of the energy, to rounding;
    /// where they do not change it is the gradient.
    fn add_discrete_gradient<T: Real>(&self, g: [&Six<T>; 2], scale: T, n: &mut Six<T>);
}

/// No bending stiffness: no bending code runs.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoBending;

impl Bending for NoBending {
    fn energy(&self, _: &Six<f64>) -> f64 {
        0.0
    }
    #[inline(always)]
    fn add_gradient<T: Real>(&self, _: &Six<T>, _: T, _: &mut Six<T>) {}
    #[inline(always)]
    fn add_hessian<T: Real>(&self, _: &Six<T>, _: T, _: &mut Six<T>, _: &mut Upper<T>) {}
    #[inline(always)]
    fn add_discrete_gradient<T: Real>(&self, _: [&Six<T>; 2], _: T, _: &mut Six<T>) {}
}
