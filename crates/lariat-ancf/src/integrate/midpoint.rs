//! Implicit midpoint rule: order 2, symplectic, no numerical damping.
//!
//! `Q = q_n + (h/2) v_n + (h/2)^2 k`, `q_{n+1} = q_n + h V`, `v_{n+1} = v_n + h k`. *Source.* Hairer, Lubich & Wanner 2006, II.1.
//! *Validity.* Soft cables, or steps that resolve the axial waves: it is A-stable, not L-stable, so on a stiff cable at 1/60 s
//! unresolved modes ring with kilonewtons. No error estimate of its own.

use super::dirk::Tableau;

/// The tableau.
pub const TABLEAU: Tableau = Tableau { a: &[&[0.5]], b: &[1.0], error: &[], calibration: 1.0 };
