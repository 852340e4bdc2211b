//! Sections of ropes and chains by name and nominal diameter.
//!
//! # Equation
//!
//! By the nominal diameter d (m), of a chain that of its bar:
//!
//! ```text
//! mass m = c d^2        breaking load B = b1 d + b2 d^2 + b3 d^3        EA = k B, of chain e2 d^2 + e3 d^3
//! ```
//!
//! | name | c kg/m^3 | b1, b2, b3 N/m, N/m^2, N/m^3 | EA | solid kg/m^3 |
//! |---|---|---|---|---|
//! | nylon | 585.15 | 0, 207.0e6, 230.29e6 | 5 B | 1140 |
//! | polyester | 678.75 | 0, 308.2e6, 0 | 14 B | 1380 |
//! | hmpe | 495.72 | 0, 579.5e6, 650.65e6 | 56.54 B | 975 |
//! | chain (studless, R4) | 20.01e3 | 910.7, 1.206e9, -2.192e9 | 85.61e9 d^2 - 3.927e7 d^3 | 7850 |
//! | wire rope | [`Section::wire_rope`] | 0, 0.356 * 1.77e9, 0 | as there | |
//!
//! # Validity
//!
//! Quasi-static EA of new ropes at moderate loads; that of nylon ranges from 1 to 10 B, and all
//! fibre ropes are stiffer to fast loads. They are given without bending stiffness: yarns and links
//! slide. The area for buoyancy is that of the solid; the diameter of a chain, for contact and
//! drag, is that of a round bar of its volume, 1.8 d. Diameters of fibre ropes of mooring lines
//! are 0.05 to 0.3 m, and thinner ones of the same make scale alike.
//!
//! # References
//!
//! Nylon, polyester, HMPE and chain: the property coefficients that ship with MoorPy (NREL), after
//! manufacturers' catalogues, chain EA after DNV-OS-E301. Wire rope: EN 12385-4, class 6 x 36 with
//! a steel core, factor K = 0.356, rope grade 1770.
//!
//! # Alternatives considered
//!
//! Young's modulus times the area of the circle: a fibre rope has a quarter of it, or less.

use crate::error::{Error, require};
use crate::scales::cable::LARGEST_ROPE;
use crate::section::{Make, Section, WIRE_ROPE_BREAKS};
use serde::{Deserialize, Serialize};

/// What a rope or chain is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum RopeMaterial {
    /// Rope of nylon (polyamide).
    Nylon,
    /// Rope of polyester.
    Polyester,
    /// Rope of high-modulus polyethylene.
    Hmpe,
    /// Steel wire rope with a steel core.
    WireRope,
    /// Studless chain of steel.
    Chain,
}

/// Coefficients of a material, of powers of the diameter.
struct Coefficients {
    /// kg/m^3.
    mass: f64,
    /// N/m, N/m^2, N/m^3.
    breaking: [f64; 3],
    /// EA over the breaking load.
    stiffness: f64,
    /// Density of the solid in kg/m^3.
    solid: f64,
}

impl RopeMaterial {
    /// All of them.
    pub const ALL: [RopeMaterial; 5] =
        [RopeMaterial::Nylon, RopeMaterial::Polyester, RopeMaterial::Hmpe, RopeMaterial::WireRope, RopeMaterial::Chain];

    // coefficients of an equation, from the sources above
    fn coefficients(self) -> Coefficients {
        let of = |mass, breaking, stiffness, solid| Coefficients { mass, breaking, stiffness, solid };
        match self {
            RopeMaterial::Nylon => of(585.15, [0.0, 207.0e6, 230.29e6], 5.0, 1140.0),
            RopeMaterial::Polyester => of(678.75, [0.0, 308.2e6, 0.0], 14.0, 1380.0),
            RopeMaterial::Hmpe => of(495.72, [0.0, 579.5e6, 650.65e6], 56.54, 975.0),
            // mass and EA are those of the section
            RopeMaterial::WireRope => of(0.0, [0.0, WIRE_ROPE_BREAKS, 0.0], 0.0, 0.0),
            RopeMaterial::Chain => of(20.01e3, [910.7, 1.206e9, -2.192e9], 0.0, 7850.0),
        }
    }

    /// Returns the section of a nominal diameter in m.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a diameter that is not positive and at most 0.35 m.
    pub fn section(self, diameter: f64) -> Result<Section, Error> {
        self.check(diameter)?;
        if self == RopeMaterial::WireRope {
            return Section::wire_rope(diameter);
        }
        let Coefficients { mass, stiffness, solid, .. } = self.coefficients();
        let axial = match self {
            RopeMaterial::Chain => diameter.powi(2) * (85.61e9 - 3.927e7 * diameter),
            _ => stiffness * self.breaking_load(diameter)?,
        };
        let mass = mass * diameter * diameter;
        let area = mass / solid;
        let mut section = Section::from_stiffness(axial, 0.0, mass)?;
        let outer = if self == RopeMaterial::Chain { (4.0 * area / std::f64::consts::PI).sqrt() } else { diameter };
        let breaking_load = self.breaking_load(diameter)?;
        (section.diameter, section.outer_area) = (Some(outer), Some(area));
        section.make = Make::Rope(Some(breaking_load));
        Ok(section)
    }

    /// Returns the breaking load in N of a nominal diameter in m.
    ///
    /// # Errors
    /// As [`section`](Self::section).
    pub fn breaking_load(self, diameter: f64) -> Result<f64, Error> {
        self.check(diameter)?;
        let [first, second, third] = self.coefficients().breaking;
        Ok(diameter * (first + diameter * (second + diameter * third)))
    }

    fn check(self, diameter: f64) -> Result<(), Error> {
        let made = diameter > 0.0 && diameter <= LARGEST_ROPE;
        require("nominal diameter (m)", diameter, made, "> 0 and at most 0.35")
    }
}

impl Section {
    /// The section of a rope or chain of this material and nominal diameter in m.
    ///
    /// # Errors
    /// As [`RopeMaterial::section`].
    pub fn of(material: RopeMaterial, diameter: f64) -> Result<Self, Error> {
        material.section(diameter)
    }
}
