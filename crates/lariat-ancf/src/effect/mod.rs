//! Effects: what a scene adds to inertia and elasticity, one file each. What is absent costs nothing.
//!
//! ```text
//! M q'' = F_elastic(q) + F_gravity + F_effects(q, q', t)
//! ```
//!
//! | file | effect | where it acts |
//! |---|---|---|
//! | [`bending`](crate::bending) | bending stiffness; rule `none` has none | the element kernel |
//! | [`rest_shape`] | stress-free stretch and curvature | the element kernel |
//! | [`damping`] | Kelvin-Voigt damping | the element kernel |
//! | [`drag`], [`flow`] | drag of a fluid or wind, steady, by tables in place and time, or sampled from a function of yours | Gauss points of the element |
//! | [`buoyancy`] | buoyancy and added mass | the weight and the mass matrix, once |
//! | [`line_load`] | force per length | a constant vector, once |
//! | [`gravity`] | scale of gravity | the weight, once |
//!
//! Effects are part of a cable's description: serialised with it, changed between steps ([`Cable::set_effects`]). Internal
//! damping needs an implicit integrator, and explicit ones have order 2 with drag: see [`explicit`].
//!
//! [`Cable::set_effects`]: crate::Cable::set_effects
//! [`explicit`]: crate::integrate::explicit

pub mod account;
pub mod buoyancy;
pub(crate) mod curvature;
pub mod damping;
pub mod drag;
pub mod flow;
pub mod gravity;
pub mod line_load;
pub mod rest_shape;

pub use account::Account;
pub use buoyancy::Buoyancy;
pub use damping::Damping;
pub use drag::Drag;
pub use flow::{Flow, Profile};
pub use gravity::GravityScale;
pub use line_load::LineLoad;
pub use rest_shape::{RestPiece, RestShape};

use serde::{Deserialize, Serialize};

/// The effects of a cable; the default has none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Effects {
    /// Internal damping.
    pub damping: Option<Damping>,
    /// Drag of a fluid or wind.
    pub drag: Option<Drag>,
    /// Buoyancy and added mass.
    pub buoyancy: Option<Buoyancy>,
    /// Stress-free stretch and curvature, if not straight and unstretched.
    pub rest_shape: Option<RestShape>,
    /// Forces per length.
    pub line_loads: Vec<LineLoad>,
    /// Scale of gravity. Default 1.
    pub gravity_scale: GravityScale,
}

impl Effects {
    /// Whether a force depends on velocity.
    pub fn depend_on_velocity(&self) -> bool {
        self.damping.is_some() || self.drag.is_some()
    }

    /// Whether the step matrix holds the exact tangent of the force.
    pub(crate) fn exact_tangent(&self) -> bool {
        let curved = |rest: &RestShape| rest.pieces.iter().any(|piece| piece.curvature > 0.0);
        !self.depend_on_velocity() && !self.rest_shape.as_ref().is_some_and(curved)
    }
}
