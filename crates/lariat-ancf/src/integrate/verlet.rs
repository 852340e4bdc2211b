//! Velocity Verlet: order 2, one force evaluation per step.
//!
//! *Source.* Verlet 1967; Hairer, Lubich & Wanner 2003. *Validity.* h omega_max < 2.

use super::explicit::Composition;

/// Half a kick, a drift, half a kick.
pub const METHOD: Composition = Composition { kicks: &[0.5], drifts: &[1.0], stages: 1, stability_limit: 2.0 };
