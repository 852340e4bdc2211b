//! Contact and friction of a cable: its parameters. The mechanics are in
//! [`contact`](crate::contact).

use super::acts::{Acts, Nothing};
use super::{Cut, Effect, Target};
use crate::error::{Error, Requirement, require};
use crate::scales::effect::SOFTNESS;
use crate::section::Section;
use serde::{Deserialize, Serialize};

/// Contact with the [obstacles](crate::Cable::set_obstacles) of a cable, and with other cables and
/// itself if it is asked for. Needs the method `discrete-gradient`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Contact {
    /// Radius in m, > 0. Default: half the diameter of the section.
    pub radius: Option<f64>,
    /// Normal force per length and depth in N/m^2, > 0. Default: EA/(40 r^2).
    pub stiffness: Option<f64>,
    /// Coefficient of friction of the cable, >= 0, which a host combines with that of what it
    /// touches. Default: 0.5.
    pub friction: f64,
    /// Coefficient of restitution of the cable, 0 to 1, which a host combines with that of what it
    /// touches; [obstacles](crate::contact::Obstacle) have their own, and on itself it has this
    /// one, at most 15/17. Default: 0.
    pub restitution: f64,
    /// Whether it touches other cables that have this too. Default: false.
    pub cables: bool,
    /// Whether it touches itself. Default: false.
    pub itself: bool,
}

impl Default for Contact {
    fn default() -> Self {
        Contact { radius: None, stiffness: None, friction: 0.5, restitution: 0.0, cables: false, itself: false }
    }
}

impl Contact {
    /// Creates contact with a coefficient of friction.
    pub fn with_friction(friction: f64) -> Self {
        Contact { friction, ..Contact::default() }
    }

    /// Returns it for a cable with a coefficient of restitution.
    pub fn with_restitution(self, restitution: f64) -> Self {
        Contact { restitution, ..self }
    }

    /// Returns it for a cable of this radius (m).
    pub fn with_radius(self, radius: f64) -> Self {
        Contact { radius: Some(radius), ..self }
    }

    /// Returns it for a cable that touches other cables and itself.
    pub fn with_cables(self) -> Self {
        Contact { cables: true, itself: true, ..self }
    }

    pub(crate) fn radius_of(&self, section: &Section) -> f64 {
        self.radius.or(section.diameter.map(|d| 0.5 * d)).unwrap_or(0.0)
    }

    /// Returns the stiffness in N/m^2 of a cable of this section.
    pub(crate) fn stiffness_of(&self, section: &Section) -> f64 {
        let r = self.radius_of(section);
        self.stiffness.unwrap_or(section.axial_stiffness / (SOFTNESS * r * r))
    }
}

impl Effect for Contact {
    // it stores energy, and bodies that move work through it: what it loses is in the energy law of
    // the method
    const DISSIPATIVE: bool = false;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        let Contact { radius, stiffness, friction, restitution, .. } = *self;
        require("radius of contact (m)", radius.unwrap_or(1.0), radius.is_none_or(|r| r > 0.0), "> 0")?;
        require("stiffness of contact (N/m^2)", stiffness.unwrap_or(1.0), stiffness.is_none_or(|k| k > 0.0), "> 0")?;
        require("coefficient of friction", friction, friction >= 0.0, ">= 0")?;
        require("coefficient of restitution", restitution, (0.0..=1.0).contains(&restitution), "from 0 to 1")?;
        if radius.is_none() && cable.elements.iter().any(|e| e.section.diameter.is_none()) {
            return Err(cable.missing("contact", Requirement::Radius));
        }
        Ok(())
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn has_exact_tangent(&self) -> bool {
        true
    }

    fn needs_implicit_integrator(&self) -> bool {
        true
    }

    fn is_steady(&self, _from: f64, _to: f64) -> bool {
        true
    }

    fn cut(&self, _: Cut<'_>) -> [Option<Self>; 2] {
        [Some(*self); 2]
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

impl Acts for Contact {
    type InElement = Nothing;
    type AtPoints = Nothing;
}
