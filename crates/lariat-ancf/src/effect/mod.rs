//! Effects: what acts on a cable beside inertia, elasticity and point loads. One file each; what is
//! absent costs nothing.
//!
//! # Equation
//!
//! ```text
//! M q'' = F_elastic(q) + F_gravity + F_effects(q, q', t)
//! ```
//!
//! | file | effect | where it acts |
//! |---|---|---|
//! | [`gravity`] | factor on gravity | the weight, once |
//! | [`buoyancy`] | buoyancy and added mass | the weight and the mass matrix, once; at a free surface Gauss points of the element |
//! | [`line_load`] | force per length | a constant vector, once |
//! | [`axial_law`] | force against strain other than the Green law | Gram numbers of the element |
//! | [`rest_shape`] | stress-free stretch and curvature | Gram numbers of the element |
//! | [`torsion`] | one torque between clamps that hold the spin | the change of the twist of each segment |
//! | [`damping`] | Kelvin-Voigt damping | Gram numbers of the element |
//! | [`contact`] | contact and friction with obstacles | material points of the centre line, in steps of the discrete gradient |
//! | [`water`](mod@water) | a fluid with its motion and its free surface, for drag, buoyancy and bodies | |
//! | [`drag`], [`flow`] | drag of a fluid or wind, steady, by tables in place and time, or sampled from a function of yours | Gauss points of the element |
//!
//! Bending stiffness is part of the [rule](crate::Rule).
//!
//! # A new effect
//!
//! Write its file: parameters, an implementation of [`Effect`], and its force. Add a line to
//! [`for_each_effect`](crate::for_each_effect). The compiler then asks for what is missing, here
//! and in the crates above, which generate their parts from the same list.
//!
//! # Validity
//!
//! Effects are part of a cable's description: serialised with it, changed between steps
//! ([`Cable::set_effects`]). Internal damping needs an implicit integrator, and explicit ones have
//! order 2 with drag: see [`explicit`].
//!
//! [`Cable::set_effects`]: crate::Cable::set_effects
//! [`explicit`]: crate::integrate::explicit

pub(crate) mod acts;
pub mod axial_law;
pub mod buoyancy;
pub mod contact;
pub(crate) mod curvature;
pub mod damping;
pub mod drag;
pub mod flow;
pub mod force_density;
pub mod gravity;
pub mod line_load;
mod list;
pub mod potential;
pub mod rest_shape;
pub mod rope_kind;
pub(crate) mod tables;
pub mod torsion;
pub mod water;
pub mod work;

pub use axial_law::AxialLaw;
pub use buoyancy::Buoyancy;
pub use contact::Contact;
pub use damping::Damping;
pub use drag::Drag;
pub use flow::{Flow, Profile};
pub use force_density::{CablePoint, ForceDensity, ForceDerivatives};
pub use gravity::GravityScale;
pub use line_load::{LineLoad, LineLoads};
pub use list::{EffectCounts, EffectWork, Effects};
pub use potential::Potential;
pub use rest_shape::{RestPiece, RestShape};
pub use rope_kind::RopeKind;
pub use torsion::{EndSpin, Torsion};
pub use water::Water;

use crate::error::{Error, Requirement};
use crate::rule::{BendingRule, Rule};
use crate::section::Element;
use core::fmt::Debug;
use nalgebra::Vector3;
use serde::{Serialize, de::DeserializeOwned};

/// An effect of the list of [`for_each_effect`](crate::for_each_effect): its parameters, and all
/// that the rest of the library has to know.
///
/// Nothing here has a default, so that nothing can be forgotten.
pub trait Effect: Clone + Debug + PartialEq + Serialize + DeserializeOwned {
    /// Whether its work counts as [dissipated](EffectWork::dissipated).
    const DISSIPATIVE: bool;

    /// Checks the parameters, and that the cable has the numbers that the effect needs.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a number out of range, [`Error::MissingForEffect`] for a cable
    /// that lacks one.
    fn check(&self, cable: &Target<'_>) -> Result<(), Error>;

    /// Whether its force depends on velocity.
    fn depends_on_velocity(&self) -> bool;

    /// Whether the step matrix holds the exact tangent of its force.
    fn has_exact_tangent(&self) -> bool;

    /// Whether explicit integrators cannot step it.
    fn needs_implicit_integrator(&self) -> bool;

    /// Whether its force on a cable at rest is the same from one time to another, in s. If not, a
    /// cable that sleeps wakes up.
    fn is_steady(&self, from: f64, to: f64) -> bool;

    /// The effect on the part before and on the part behind a cut.
    fn cut(&self, cut: Cut<'_>) -> [Option<Self>; 2];

    /// Adapts the effect to an element that is split in two at `xi` (in `[0, 1]`).
    fn refine(&mut self, element: usize, xi: f64);
}

/// Where a cable is cut.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Cut<'a> {
    /// The node at the cut.
    pub node: usize,
    /// Elements of the whole cable.
    pub elements: &'a [Element],
}

impl<'a> Cut<'a> {
    /// Arc length of the cut in m.
    pub fn arc_length(&self) -> f64 {
        self.parts()[0].iter().map(|e| e.length).sum()
    }

    /// Elements before and behind the cut.
    pub fn parts(&self) -> [&'a [Element]; 2] {
        let (head, tail) = self.elements.split_at(self.node);
        [head, tail]
    }
}

/// The cable that an effect acts on, as [`Effect::check`] sees it.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// Name of the cable.
    pub name: &'a str,
    /// Rule of the elastic forces.
    pub rule: Rule,
    /// Elements.
    pub elements: &'a [Element],
    /// Gravity in m/s^2, with the factor of the cable.
    pub gravity: Vector3<f64>,
}

impl Target<'_> {
    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.elements.len() + 1
    }

    /// Unstretched length in m.
    pub fn length(&self) -> f64 {
        self.elements.iter().map(|e| e.length).sum()
    }

    /// Whether the cable has no bending stiffness.
    pub fn has_no_bending(&self) -> bool {
        self.rule.bending == BendingRule::None
    }

    /// The error of an effect that needs what the cable does not have.
    pub(crate) fn missing(&self, effect: &'static str, requirement: Requirement) -> Error {
        Error::MissingForEffect { cable: self.name.to_string(), effect, requirement }
    }
}
