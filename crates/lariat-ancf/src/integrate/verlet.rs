//! Velocity Verlet: order 2, one force evaluation per step.
//!
//! # Equation
//!
//! Half a kick, a drift, half a kick; see [`explicit`](super::explicit).
//!
//! # Validity
//!
//! h omega_max < 2.
//!
//! # References
//!
//! Verlet 1967; Hairer, Lubich & Wanner 2003.

use super::explicit::Composition;

/// The method.
pub const METHOD: Composition =
    Composition { name: "verlet", kicks: &[0.5], drifts: &[1.0], stages: 1, stability_limit: 2.0 };
