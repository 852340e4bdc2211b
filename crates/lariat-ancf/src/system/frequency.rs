//! An upper bound of a cable's angular frequencies, for the step of explicit methods.
//!
//! # Equation
//!
//! The largest frequency of an assembled model is at most the largest of its elements taken alone.
//! For a straight element of unit stretch the problem splits into the axial and the bending one,
//! each 4x4 with the matrices of Hermite's functions; in units of l they are constants:
//!
//! ```text
//! omega_axial = c_a sqrt(EA/rhoA)/l          omega_bending = c_b sqrt(EI/rhoA)/l^2
//! ```
//!
//! # Validity
//!
//! Stretch within a few percent of 1 (the axial tangent is EA (3 f^2 - 1)/2); 5 % is added.
//!
//! # References
//!
//! Irons & Treharne 1971.

use crate::element::{mass, shape};
use crate::model::Model;
use crate::quadrature::gauss_legendre;
use crate::rule::BendingRule;
use nalgebra::Matrix4;

/// Returns the largest eigenvalue of `M^-1 K` for unit mass per length, length and stiffness, `K =
/// int D^T D`.
fn largest(derivative: fn(f64, f64) -> [f64; 4]) -> f64 {
    let m = Matrix4::from_fn(|i, j| mass::consistent(1.0, 1.0)[i][j]);
    let k = Matrix4::from_fn(|i, j| {
        gauss_legendre(4).iter().map(|&(x, w)| w * derivative(x, 1.0)[i] * derivative(x, 1.0)[j]).sum::<f64>()
    });
    let lower = m.cholesky().expect("the mass matrix is positive definite").l();
    let inverse = lower.try_inverse().expect("a Cholesky factor is regular");
    (inverse * k * inverse.transpose()).symmetric_eigenvalues().max()
}

/// Returns the bound in rad/s.
pub(crate) fn bound(model: &Model) -> f64 {
    // tangent EA (3 f^2 - f_0^2)/2 at f = f_0 and at f = 1
    let pieces = model.effects.rest_shape.iter().flat_map(|rest| &rest.pieces);
    let prestrain = pieces.map(|p| p.stretch * p.stretch).fold(1.0f64, |worst, s| worst.max(s).max(0.5 * (3.0 - s)));
    let (axial, bending) = (largest(shape::slope).sqrt(), largest(shape::second_derivative).sqrt());
    let worst = model.elements.iter().fold(0.0f64, |worst, e| {
        let (s, mass) = (&e.section, model.inertia(e));
        let wave = (s.axial_stiffness * prestrain / mass).sqrt() / e.length;
        let flexure = (s.bending_stiffness / mass).sqrt() / (e.length * e.length);
        let flexure = if model.rule.bending == BendingRule::None { 0.0 } else { flexure };
        worst.max(axial * wave).max(bending * flexure)
    });
    1.05 * worst
}
