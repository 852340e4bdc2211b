//! Gravity, scaled for one cable.
//!
//! # Equation
//!
//! ```text
//! w = scale (rhoA - rho_f A_d) g        force per unstretched length, N/m
//! ```
//!
//! rho_f A_d is the displaced mass, zero without [`buoyancy`](super::buoyancy): the scale also acts
//! on the hydrostatic pressure that gravity makes, so a scale of zero leaves neither weight nor
//! lift. The weight is integrated with Hermite's functions
//! ([`load_weights`](crate::element::mass::load_weights)) into a constant vector: no work in a
//! step.
//!
//! # Validity
//!
//! Uniform gravity.

use super::acts::{Acts, Nothing};
use super::{Cut, Effect, Target};
use crate::error::{Error, require};
use serde::{Deserialize, Serialize};

/// Factor on gravity for one cable; default 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct GravityScale(pub f64);

impl Default for GravityScale {
    fn default() -> Self {
        GravityScale(1.0)
    }
}

impl Effect for GravityScale {
    const DISSIPATIVE: bool = false;

    fn check(&self, _: &Target<'_>) -> Result<(), Error> {
        require("gravity scale", self.0, true, "a number")
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn has_exact_tangent(&self) -> bool {
        true
    }

    fn needs_implicit_integrator(&self) -> bool {
        false
    }

    fn is_steady(&self, _from: f64, _to: f64) -> bool {
        true
    }

    fn cut(&self, _: Cut<'_>) -> [Option<Self>; 2] {
        [Some(*self); 2]
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

impl Acts for GravityScale {
    type InElement = Nothing;
    type AtPoints = Nothing;

    fn gravity_factor(&self) -> f64 {
        self.0
    }
}
