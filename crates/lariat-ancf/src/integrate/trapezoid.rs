//! Trapezoidal rule: order 2, no numerical damping; Newmark's method with beta = 1/4, gamma = 1/2.
//!
//! # Equation
//!
//! [`generalised_alpha`](super::generalised_alpha) with rho = 1, where algorithmic and true
//! accelerations coincide. The local error `h^2/12 (k_{n+1} - k_n)` is that method's estimate.
//!
//! # Validity
//!
//! As the midpoint rule: soft cables, or steps that resolve the axial waves.
//!
//! # References
//!
//! Newmark 1959.

use super::generalised_alpha::GeneralisedAlpha;

/// The trapezoidal rule.
pub const METHOD: GeneralisedAlpha = GeneralisedAlpha { rho: 1.0 };
