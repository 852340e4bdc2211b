//! Implicit midpoint rule: order 2, symplectic, no numerical damping.
//!
//! # Equation
//!
//! `Q = q_n + (h/2) v_n + (h/2)^2 k`, `q_{n+1} = q_n + h V`, `v_{n+1} = v_n + h k`. No error
//! estimate.
//!
//! # Validity
//!
//! Soft cables, or steps that resolve the axial waves. The rule is A-stable but not L-stable: on a
//! stiff cable at 1/60 s unresolved modes ring with kilonewtons.
//!
//! # References
//!
//! Hairer, Lubich & Wanner 2006, II.1.

use super::dirk::Tableau;

/// The tableau.
pub const TABLEAU: Tableau = Tableau { name: "midpoint", a: &[&[0.5]], b: &[1.0], estimate: None };
