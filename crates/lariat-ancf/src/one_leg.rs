//! Coefficients of the one-leg formula of the [discrete gradient](crate::integrate::discrete_gradient).

/// Coefficient a of the one-leg formula.
pub(crate) const ALPHA: f64 = 1.0 / 16.0;
/// Coefficient b = 1/2 + a.
pub(crate) const BETA: f64 = 0.5 + ALPHA;
