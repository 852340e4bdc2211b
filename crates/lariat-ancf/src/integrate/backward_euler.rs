//! Backward Euler: order 1, L-stable. Not offered as a method: the fallback of the [energy
//! guard](super::energy_guard) for steps at which another method creates energy.
//!
//! # Equation
//!
//! ```text
//! q_{n+1} = q_n + h v_{n+1}        M (v_{n+1} - v_n) = h F(q_{n+1})
//! E_{n+1} - E_n <= -1/2 dv.M dv + 1/2 kappa |dq|^2
//! ```
//!
//! -kappa is the lowest eigenvalue of the stiffness along the step. It is zero in tension: no step
//! of any length creates energy. In a slack cable under compression the second term is h^2 kappa
//! |v_{n+1}|^2/2, so the energy created in a given time falls with h.
//!
//! # Validity
//!
//! Single steps that would otherwise create energy.
//!
//! # References
//!
//! Taylor's formula for the potential about q_{n+1}; Hairer & Wanner 1996, IV.3.
//!
//! # Alternatives considered
//!
//! Backward Euler as the integrator of whole runs: it loses between one half and 87 % of a
//! pendulum's energy.

use super::dirk::Tableau;

/// The tableau.
pub const TABLEAU: Tableau = Tableau { name: "backward-euler", a: &[&[1.0]], b: &[1.0], estimate: None };
