//! Buoyancy and added mass of a cable in a fluid.
//!
//! # Equation
//!
//! ```text
//! w = (rhoA - rho_f A_d) g          M = int S^T (rhoA + C_a rho_f A_d) S ds
//! ```
//!
//! A_d is the displaced area per length. The weight and the mass matrix change once; a step does no
//! more work than without. With a free surface, forces at Gauss points take away what is dry: see
//! `at_surface`.
//!
//! # Validity
//!
//! A closed cable; without a free surface fully immersed in a fluid at rest or in slow change: the
//! term (1 + C_a) rho_f A_d u' of an accelerated fluid is that of a [wave](crate::water::wave)
//! alone. A constant force per length is exact for a cable whose ends are closed; the tension that
//! is read is then the *effective* tension (that of the wall plus the fluid's pressure times the
//! area). Added mass acts in all directions alike: the true one acts across the cable only, so
//! waves along it are slower by sqrt(1 + C_a rho_f A_d/rhoA).
//!
//! # References
//!
//! Archimedes; Morison et al. 1950 for the added mass C_a rho_f A_d of a cylinder (C_a = 1 for a
//! circle in ideal flow, Lamb 1932, art. 68).
//!
//! # Alternatives considered
//!
//! Added mass across the cable alone: a mass matrix that depends on the configuration, with its
//! quadratic velocity terms, in every step.

mod at_surface;

use super::acts::{Acts, Nothing};
use super::{Cut, Effect, Target};
use crate::error::{Error, Requirement, require};
use crate::section::Section;
use crate::water::Surface;
use at_surface::SurfaceTable;
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
    /// Free surface, with a wave or without. Default: none, the fluid is everywhere.
    #[serde(default)]
    pub surface: Option<Surface>,
}

impl Buoyancy {
    /// Creates buoyancy in a fluid of this density (kg/m^3), with the coefficient of added mass.
    pub fn new(fluid_density: f64, added_mass: f64) -> Self {
        Buoyancy { fluid_density, added_mass, area: None, surface: None }
    }
}

impl Effect for Buoyancy {
    const DISSIPATIVE: bool = false;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        let Buoyancy { fluid_density, added_mass, area, surface } = *self;
        require("fluid density (kg/m^3)", fluid_density, fluid_density > 0.0, "> 0")?;
        require("coefficient of added mass", added_mass, added_mass >= 0.0, ">= 0")?;
        require("displaced area (m^2)", area.unwrap_or(1.0), area.is_none_or(|a| a > 0.0), "> 0")?;
        if area.is_none() && cable.elements.iter().any(|e| e.section.outer_area.is_none()) {
            return Err(cable.missing("buoyancy", Requirement::DisplacedArea));
        }
        surface.map_or(Ok(()), |surface| at_surface::check(&surface, cable))
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    /// Returns whether there is no surface: the gradient of a wave is left out.
    fn has_exact_tangent(&self) -> bool {
        self.surface.is_none()
    }

    fn needs_implicit_integrator(&self) -> bool {
        false
    }

    fn is_steady(&self, _from: f64, _to: f64) -> bool {
        self.surface.is_none_or(|surface| surface.wave.is_none())
    }

    fn cut(&self, _: Cut<'_>) -> [Option<Self>; 2] {
        [Some(*self); 2]
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

impl Acts for Buoyancy {
    type InElement = Nothing;
    type AtPoints = SurfaceTable;

    fn at_points(&self, cable: &Target<'_>) -> Option<SurfaceTable> {
        self.surface
            .as_ref()
            .map(|surface| SurfaceTable::new(surface, (self.fluid_density, self.added_mass, self.area), cable))
    }

    fn added_mass(&self, section: &Section) -> f64 {
        self.added_mass * self.displaced_mass(section)
    }

    fn displaced_mass(&self, section: &Section) -> f64 {
        self.fluid_density * self.area.or(section.outer_area).unwrap_or(0.0)
    }
}
