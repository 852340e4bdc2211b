//! Backward Euler: order 1, L-stable. Not offered as a method: what the drive takes where another makes energy.
//!
//! ```text
//! q_{n+1} = q_n + h v_{n+1}    M (v_{n+1} - v_n) = h F(q_{n+1})    E_{n+1} - E_n <= -1/2 dv.M dv + 1/2 kappa |dq|^2
//! ```
//!
//! kappa is how negative the stiffness is on the way: zero in tension, so that no energy is made at any step; in a slack cable under
//! compression the second term is h^2 kappa |v_{n+1}|^2/2, and what is made in a given time falls as h. *Source.* Taylor's formula for the
//! potential about q_{n+1}; Hairer & Wanner 1996, IV.3. *Validity.* Steps that have to be lived through. *Rejected.* As an integrator:
//! it loses half to 87 % of a pendulum's energy.

use super::dirk::Tableau;

/// The tableau.
pub const TABLEAU: Tableau = Tableau { a: &[&[1.0]], b: &[1.0], error: &[], calibration: 1.0 };
