//! Damping of real ropes, by name.
//!
//! # Equation
//!
//! A kind of rope has a damping ratio zeta, a fraction of critical damping. Internal damping after
//! Kelvin and Voigt has the ratio tau omega/2 at the angular frequency omega, so a ratio fixes tau
//! at one frequency:
//!
//! ```text
//! tau = 2 zeta/omega        axial omega = pi/int sqrt(m/EA) ds        bending omega = (10 pi/L)^2 sqrt(EI/m)
//! ```
//!
//! for stretch that of the lowest axial mode of a cable with both ends held; for bending that of a
//! beam of ten half waves over the length, without tension: the wiggles that one sees on a rope.
//!
//! # Validity
//!
//! The friction of wires and fibres, from which the damping of ropes comes, hardly depends on
//! frequency, while this ratio grows with it: slower modes are damped less than named, faster ones
//! more. A load M on a rope of length L moves at sqrt(EA/(L M)), far below the axial mode of the
//! rope itself: ask for that frequency ([`RopeKind::damping_at`]). Ratios depend on load,
//! amplitude, age and lubrication by a factor of several.
//!
//! # References
//!
//! | kind | zeta | source |
//! |---|---|---|
//! | parallel wires | 0.001 | logarithmic decrement 0.006: EN 1991-1-4, table F.2, bridge cables of parallel wires |
//! | spiral strand | 0.0032 | logarithmic decrement 0.020: the same, spiral cables |
//! | wire rope | 0.02 | within the 1 to 4 % that ENV 1998-6, annex B, gives for steel elements; its strands slide more than a spiral strand's |
//! | fibre rope | 0.05 | chosen: a loss factor of 0.1, the order of magnitude of polymers (Nashif, Jones & Henderson 1985) |
//! | rubber hose | 0.1 | chosen: a loss factor of 0.2, the same |
//!
//! # Alternatives considered
//!
//! Friction with hysteresis: a ratio that does not depend on frequency, at the price of internal
//! state in every element.

use super::Damping;
use crate::error::{Error, nearest, require};
use crate::scales::effect::HALF_WAVES;
use crate::section::{Element, Section};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use std::fmt;
use std::str::FromStr;

/// A kind of rope, by which its damping is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum RopeKind {
    /// Parallel wires or strands of steel: 0.1 % of critical.
    ParallelWires,
    /// A spiral strand of steel: 0.32 % of critical.
    SpiralStrand,
    /// A steel wire rope of several strands: 2 % of critical.
    WireRope,
    /// A rope of polymer fibres: 5 % of critical.
    FibreRope,
    /// A rubber hose or cord: 10 % of critical.
    RubberHose,
}

impl RopeKind {
    /// All kinds.
    pub const ALL: [RopeKind; 5] = [
        RopeKind::ParallelWires,
        RopeKind::SpiralStrand,
        RopeKind::WireRope,
        RopeKind::FibreRope,
        RopeKind::RubberHose,
    ];

    /// Returns the name, as files have it.
    pub fn name(self) -> &'static str {
        match self {
            RopeKind::ParallelWires => "parallel-wires",
            RopeKind::SpiralStrand => "spiral-strand",
            RopeKind::WireRope => "wire-rope",
            RopeKind::FibreRope => "fibre-rope",
            RopeKind::RubberHose => "rubber-hose",
        }
    }

    /// Returns the damping ratio, a fraction of critical damping.
    pub fn damping_ratio(self) -> f64 {
        match self {
            // from logarithmic decrements
            RopeKind::ParallelWires => 0.006 / TAU,
            RopeKind::SpiralStrand => 0.020 / TAU,
            RopeKind::WireRope => 0.02,
            RopeKind::FibreRope => 0.05,
            RopeKind::RubberHose => 0.1,
        }
    }

    /// Returns the damping of a cable of this kind with one section over its `length` (m): the
    /// named ratio at its lowest axial mode, and at bending in ten half waves.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a length that is not positive and finite.
    pub fn damping(self, section: &Section, length: f64) -> Result<Damping, Error> {
        require("length (m)", length, length > 0.0, "> 0")?;
        Ok(self.damping_of(&[Element { length, section: *section }]))
    }

    /// Returns the damping with the named ratio at these angular frequencies in rad/s.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a frequency that is not positive and finite.
    pub fn damping_at(self, axial: f64, bending: f64) -> Result<Damping, Error> {
        let ratio = self.damping_ratio();
        let axial = Damping::from_ratio(ratio, axial)?.axial;
        Ok(Damping { axial, bending: Damping::from_ratio(ratio, bending)?.bending })
    }

    /// Returns the damping of a cable of these elements; none of bending for a limp one.
    pub(crate) fn damping_of(self, elements: &[Element]) -> Damping {
        let length: f64 = elements.iter().map(|e| e.length).sum();
        let sum = |f: &dyn Fn(&Section) -> f64| elements.iter().map(|e| e.length * f(&e.section)).sum::<f64>();
        let travel = sum(&|s| (s.mass_per_length / s.axial_stiffness).sqrt());
        let stiffness = sum(&|s| (s.bending_stiffness / s.mass_per_length).sqrt()) / length;
        let bending = (HALF_WAVES * PI / length).powi(2) * stiffness;
        let twice = 2.0 * self.damping_ratio();
        Damping { axial: twice * travel / PI, bending: if bending > 0.0 { twice / bending } else { 0.0 } }
    }
}

impl fmt::Display for RopeKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for RopeKind {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        // `RopeMaterial` writes `wire_rope`
        let name = text.to_ascii_lowercase().replace('_', "-");
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| Error::UnknownRopeKind {
            name: text.to_string(),
            expected: Self::ALL.map(RopeKind::name).join(", "),
            suggestion: nearest(text, Self::ALL.map(|kind| kind.name().to_string())),
        })
    }
}
