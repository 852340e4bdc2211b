//! Buoyancy and added mass of a cable in a fluid.
//!
//! ```text
//! w = (rhoA - rho_f A_d) g          M = int S^T (rhoA + C_a rho_f A_d) S ds
//! ```
//!
//! A_d is the displaced area per length. The weight and the mass matrix are changed once; a step does no more work than without.
//! *Source.* Archimedes; Morison et al. 1950 for the added mass C_a rho_f A_d of a cylinder (C_a = 1 for a circle in ideal flow, Lamb
//! 1932, art. 68). *Validity.* A closed, fully immersed cable in a fluid at rest or in slow change: the term (1 + C_a) rho_f A_d u' of
//! an accelerated fluid is left out. A constant force per length is exact for a cable whose ends are closed; the tension that is read
//! is then the *effective* tension (that of the wall plus the fluid's pressure times the area). Added mass acts in all directions
//! alike: the true one acts across the cable only, so waves along it come out slower, by sqrt(1 + C_a rho_f A_d/rhoA). *Rejected.* Added
//! mass across the cable alone: a mass matrix that depends on the configuration, with its quadratic velocity terms, in every step.

use serde::{Deserialize, Serialize};

/// Buoyancy and added mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Buoyancy {
    /// Density of the fluid in kg/m^3, > 0.
    pub fluid_density: f64,
    /// Coefficient of added mass C_a, >= 0; 0 = none.
    pub added_mass: f64,
    /// Displaced area in m^2. Default: that inside the section's outline.
    #[serde(default)]
    pub area: Option<f64>,
}

impl Buoyancy {
    /// Buoyancy in a fluid of this density (kg/m^3), with the coefficient of added mass.
    pub fn new(fluid_density: f64, added_mass: f64) -> Self {
        Buoyancy { fluid_density, added_mass, area: None }
    }
}
