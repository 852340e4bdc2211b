//! Cross-section and material of a cable, as the three numbers that the equations need.
//!
//! # Equation
//!
//! `EA` (N), `EI` (N m^2), `rho A` (kg/m). Round: `A = pi d^2/4`, `I = pi d^4/64`; square: `A =
//! a^2`, `I = a^4/12`; tube: differences of round ones.
//!
//! # Validity
//!
//! A homogeneous elastic section. A stranded rope has about half of the solid's EA and far less EI:
//! use [`Section::from_stiffness`] with measured values.

use crate::error::{Error, require};
use crate::scales::watch::{STIFF, STRAIN};
use serde::{Deserialize, Serialize};

/// Axial stiffness, bending stiffness and mass per length of an element; all that mechanics needs
/// of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Axial stiffness EA in N, > 0.
    pub axial_stiffness: f64,
    /// Bending stiffness EI in N m^2, >= 0.
    pub bending_stiffness: f64,
    /// Mass per unstretched length in kg/m, > 0.
    pub mass_per_length: f64,
    /// Outer diameter (side, for a square) in m, if a shape was given: for contact, drag and
    /// drawing.
    pub diameter: Option<f64>,
    /// Area inside the outer outline in m^2, if a shape was given: for buoyancy.
    #[serde(default)]
    pub outer_area: Option<f64>,
    /// What it is the section of.
    #[serde(default)]
    pub make: Make,
}

/// Coefficient: breaking load of a wire rope over the square of its diameter in N/m^2 (EN 12385-4,
/// class 6 x 36 with a steel core, factor K = 0.356, rope grade 1770).
pub(crate) const WIRE_ROPE_BREAKS: f64 = 0.356 * 1.77e9;

/// What a section is that of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Make {
    /// Anything: its stiffnesses were measured.
    #[default]
    Unknown,
    /// A solid of this Young's modulus in Pa: for [warnings](crate::warning).
    Solid(f64),
    /// A rope or chain, with its breaking load in N if that is known, for
    /// [warnings](crate::warning): its EA is force over elongation, and it folds rather than be
    /// pushed. A cable of such sections has the axial law [`Rope`](crate::AxialLaw::Rope), unless
    /// it has another one.
    Rope(Option<f64>),
}

/// One element: unstretched length in m and section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Element {
    /// Unstretched length in m.
    pub length: f64,
    /// Section of the whole element.
    pub section: Section,
}

/// Shape of a solid cross-section, in m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Solid round of this diameter.
    Round(f64),
    /// Solid square of this side.
    Square(f64),
    /// Tube of outer and inner diameter.
    Tube(f64, f64),
}

impl Shape {
    /// Area in m^2.
    pub fn area(self) -> f64 {
        let disc = |d: f64| std::f64::consts::FRAC_PI_4 * d * d;
        match self {
            Shape::Round(d) => disc(d),
            Shape::Square(a) => a * a,
            Shape::Tube(outer, inner) => disc(outer) - disc(inner),
        }
    }

    /// Second moment of area in m^4.
    pub fn second_moment(self) -> f64 {
        let disc = |d: f64| std::f64::consts::PI / 64.0 * d.powi(4);
        match self {
            Shape::Round(d) => disc(d),
            Shape::Square(a) => a.powi(4) / 12.0,
            Shape::Tube(outer, inner) => disc(outer) - disc(inner),
        }
    }

    /// Area inside the outer outline in m^2: what a closed cable displaces.
    pub fn outer_area(self) -> f64 {
        match self {
            Shape::Tube(outer, _) => Shape::Round(outer).area(),
            solid => solid.area(),
        }
    }

    /// Outer diameter or side in m.
    pub fn outer(self) -> f64 {
        match self {
            Shape::Round(d) | Shape::Tube(d, _) => d,
            Shape::Square(a) => a,
        }
    }
}

impl Section {
    /// A homogeneous section of Young's modulus `youngs_modulus` in Pa and `density` in kg/m^3.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a dimension, modulus or density that is not positive and finite.
    pub fn new(shape: Shape, youngs_modulus: f64, density: f64) -> Result<Self, Error> {
        require("section size (m)", shape.outer(), shape.outer() > 0.0, "> 0")?;
        if let Shape::Tube(outer, inner) = shape {
            require("inner diameter (m)", inner, inner >= 0.0 && inner < outer, ">= 0 and below the outer diameter")?;
        }
        require("Young's modulus (Pa)", youngs_modulus, youngs_modulus > 0.0, "> 0")?;
        require("density (kg/m^3)", density, density > 0.0, "> 0")?;
        let mut section = Self::from_stiffness(
            youngs_modulus * shape.area(),
            youngs_modulus * shape.second_moment(),
            density * shape.area(),
        )?;
        section.diameter = Some(shape.outer());
        section.outer_area = Some(shape.outer_area());
        section.make = Make::Solid(youngs_modulus);
        Ok(section)
    }

    /// A steel wire rope, 6x36WS with an independent wire rope core, of this nominal diameter d in
    /// m.
    ///
    /// Mass 4.09e3 d^2 kg/m and metallic area 0.460 d^2 (EN 12385-4, factors W = 0.409 and C =
    /// 0.460 of the class), rope modulus 1.0e11 Pa on that area (Feyrer, Wire Ropes, 2015, chapter
    /// 2: 0.95 to 1.1e11 after bedding). Bending stiffness: wires of 0.046 d that slide without
    /// friction, EI = 2.06e11 * 0.460 d^2 * (0.046 d)^2/16, the lower bound; friction between wires
    /// raises it several times.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a diameter that is not positive and finite.
    pub fn wire_rope(diameter: f64) -> Result<Self, Error> {
        require("rope diameter (m)", diameter, diameter > 0.0, "> 0")?;
        let (metal, wire) = (0.460 * diameter * diameter, 0.046 * diameter);
        let mut section =
            Self::from_stiffness(1.0e11 * metal, 2.06e11 * metal * wire * wire / 16.0, 4.09e3 * diameter * diameter)?;
        section.diameter = Some(diameter);
        section.outer_area = Some(Shape::Round(diameter).area());
        section.make = Make::Rope(Some(WIRE_ROPE_BREAKS * diameter * diameter));
        Ok(section)
    }

    /// Returns Young's modulus in Pa of the section of a solid.
    pub fn youngs_modulus(&self) -> Option<f64> {
        match self.make {
            Make::Solid(modulus) => Some(modulus),
            Make::Unknown | Make::Rope(_) => None,
        }
    }

    /// Returns whether it is that of a rope or chain.
    pub fn is_rope(&self) -> bool {
        matches!(self.make, Make::Rope(_))
    }

    /// Returns the tension in N that nothing of its make bears: the breaking load of a rope, or a
    /// strain at which no stiff solid is elastic; `None` where its make says nothing.
    pub(crate) fn bears(&self) -> Option<f64> {
        match self.make {
            Make::Rope(breaking_load) => breaking_load,
            Make::Solid(modulus) if modulus >= STIFF => Some(STRAIN * self.axial_stiffness),
            Make::Solid(_) | Make::Unknown => None,
        }
    }

    /// The same, if its numbers are in range.
    ///
    /// # Errors
    /// As [`Section::from_stiffness`].
    pub fn checked(self) -> Result<Self, Error> {
        let (axial, bending, mass) = (self.axial_stiffness, self.bending_stiffness, self.mass_per_length);
        require("axial stiffness EA (N)", axial, axial > 0.0, "> 0")?;
        require("bending stiffness EI (N m^2)", bending, bending >= 0.0, ">= 0")?;
        require("mass per length (kg/m)", mass, mass > 0.0, "> 0")?;
        Ok(self)
    }

    /// A solid round section: diameter in m, Young's modulus in Pa, density in kg/m^3.
    ///
    /// # Errors
    /// As [`Section::new`].
    pub fn round(diameter: f64, youngs_modulus: f64, density: f64) -> Result<Self, Error> {
        Self::new(Shape::Round(diameter), youngs_modulus, density)
    }

    /// A solid square section: side in m, Young's modulus in Pa, density in kg/m^3.
    ///
    /// # Errors
    /// As [`Section::new`].
    pub fn square(side: f64, youngs_modulus: f64, density: f64) -> Result<Self, Error> {
        Self::new(Shape::Square(side), youngs_modulus, density)
    }

    /// A tube: outer and inner diameter in m, Young's modulus in Pa, density in kg/m^3.
    ///
    /// # Errors
    /// As [`Section::new`].
    pub fn tube(outer: f64, inner: f64, youngs_modulus: f64, density: f64) -> Result<Self, Error> {
        Self::new(Shape::Tube(outer, inner), youngs_modulus, density)
    }

    /// Measured stiffness: EA in N, EI in N m^2, mass per unstretched length in kg/m.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a value that is not finite, or not positive (EI may be zero).
    pub fn from_stiffness(axial: f64, bending: f64, mass_per_length: f64) -> Result<Self, Error> {
        Section {
            axial_stiffness: axial,
            bending_stiffness: bending,
            mass_per_length,
            diameter: None,
            outer_area: None,
            make: Make::Unknown,
        }
        .checked()
    }
}
