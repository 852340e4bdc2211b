//! A step of one element in Gram numbers: what discrete gradients are made of.
//!
//! # Equation
//!
//! The Gram numbers g are quadratic in the control vectors d. With the mean `dm = (d0 + d1)/2` and
//! the change `D d = d1 - d0` of a step
//!
//! ```text
//! D g_ij = dm_i . D d_j + dm_j . D d_i                  (exact)
//! ```
//!
//! so for any pairs n with `n . D g = D U + loss` the force `sum_j n_ij dm_j` on the control
//! vectors does the work D U + loss over the step. It sums to zero over the nodes and has no moment
//! about the mean configuration.
//!
//! Numerical dissipation is that of the one-leg G-stable formula
//! ([`discrete_gradient`](crate::integrate::discrete_gradient)), with the change `O x` of the step
//! before:
//!
//! ```text
//! axial     U = EA l/8 y.A.y, y = g - (1,3,1,9,3,1)     g^ = g0 + b D g - a O g, b = 1/2 + a
//!           n = (EA l/4) A y^                            n.D g = D U + a/2 D|D y|^2 + a/2 |D y - O y|^2
//! bending   + a (2EI/l) sum_j rho_ij (D d_j - O d_j)     the same, in the norm rho of rule T1
//! ```
//!
//! with `|y|^2 = EA l/4 y.A.y` and `|d|^2 = 2 (2EI/l) rho . gram(d)`. (1,3,1,9,3,1) are the Gram
//! numbers of the straight unstretched element, where every axial rule is zero; so no rule needs a
//! factorisation of A.
//!
//! # References
//!
//! Gonzalez, J. Nonlinear Sci. 6 (1996) 449, and CMAME 190 (2000) 1763; Simo & Tarnow, ZAMP 43
//! (1992) 757; Dahlquist, BIT 18 (1978) 384.

use super::gram::{Control, Six, dot, gram, gram_rates};
use crate::Real;

/// Gram numbers of the straight unstretched element.
pub const STRAIGHT: Six<f64> = [1.0, 3.0, 1.0, 9.0, 3.0, 1.0];

/// A step of the control vectors of an element.
#[derive(Clone, Copy, Debug)]
pub struct ElementStep<T> {
    /// Mean control vectors dm.
    pub mean: Control<T>,
    /// Change of the control vectors D d.
    pub change: Control<T>,
    /// Change of the control vectors less that of the step before, D d - O d.
    pub second: Control<T>,
    /// Gram numbers at the beginning.
    pub start: Six<T>,
    /// Gram numbers at the end.
    pub end: Six<T>,
    /// Change of the Gram numbers D g.
    pub gram_change: Six<T>,
    /// Change of the Gram numbers in the step before, O g.
    pub gram_before: Six<T>,
}

impl<T: Real> ElementStep<T> {
    /// From the control vectors at the beginning, their change, and their change in the step
    /// before, of which the share `kept` counts.
    #[inline(always)]
    pub fn new(d: &Control<T>, change: &Control<T>, before: &Control<T>, kept: f64) -> Self {
        let (mean, middle_before) = (shifted(d, change, 0.5), shifted(d, before, -0.5));
        let (start, gram_change) = (gram(d), gram_rates(&mean, change));
        ElementStep {
            mean,
            change: *change,
            second: shifted(change, before, -kept),
            start,
            end: combined(&start, &gram_change, 1.0),
            gram_change,
            gram_before: scaled(&gram_rates(&middle_before, before), kept),
        }
    }

    /// `g0 + b D g - a O g`, b = 1/2 + a.
    #[inline(always)]
    pub fn one_leg(&self, a: f64) -> Six<T> {
        combined(&combined(&self.start, &self.gram_change, 0.5 + a), &self.gram_before, -a)
    }

    /// `D g - O g`.
    #[inline(always)]
    pub fn gram_second(&self) -> Six<T> {
        combined(&self.gram_change, &self.gram_before, -1.0)
    }
}

/// `factor x`, of Gram numbers.
#[inline(always)]
pub fn scaled<T: Real>(x: &Six<T>, factor: f64) -> Six<T> {
    let mut out = *x;
    for i in 0..6 {
        out[i] = x[i] * factor;
    }
    out
}

/// `x + factor y`, of Gram numbers.
#[inline(always)]
pub fn combined<T: Real>(x: &Six<T>, y: &Six<T>, factor: f64) -> Six<T> {
    let mut out = *x;
    for i in 0..6 {
        out[i] = x[i] + y[i] * factor;
    }
    out
}

/// `d + factor v`, of control vectors.
#[inline(always)]
pub fn shifted<T: Real>(d: &Control<T>, v: &Control<T>, factor: f64) -> Control<T> {
    let mut out = *d;
    for i in 0..3 {
        for x in 0..3 {
            out[i][x] = d[i][x] + v[i][x] * factor;
        }
    }
    out
}

/// Sum of the products of control vectors.
#[inline(always)]
pub fn product<T: Real>(x: &Control<T>, y: &Control<T>) -> T {
    dot(&x[0], &y[0]) + dot(&x[1], &y[1]) + dot(&x[2], &y[2])
}
