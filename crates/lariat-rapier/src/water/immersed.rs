//! What water does to a body: its numbers.

use crate::error::Error;
use ::nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;
use serde::{Deserialize, Deserializer, Serialize};

/// What water does to a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Immersed {
    /// Displaced volume in m^3, > 0. Default: that of its colliders.
    pub volume: Option<f64>,
    /// Drag coefficient times area in m^2, along the axes of the body, >= 0. Default: none.
    pub drag_area: Vector3<f64>,
    /// Coefficient of the quadratic drag of rotation in m^5, about the axes of the body, >= 0.
    /// Default: none.
    pub spin_drag: Vector3<f64>,
    /// Coefficients of added mass C_a along the axes of the body, >= 0, on the mass that it
    /// displaces when it floats, or all of it if it sinks: 0.5 of a sphere, 1 of a long cylinder
    /// across. One number stands for three equal ones where it is read from text. Default: none.
    #[serde(deserialize_with = "one_or_axes")]
    pub added_mass: Vector3<f64>,
}

impl Immersed {
    /// Creates buoyancy and drag of a body, by drag coefficient times area (m^2) along its axes.
    pub fn with_drag_area(drag_area: impl Into<[f64; 3]>) -> Self {
        Immersed { drag_area: drag_area.into().into(), ..Immersed::default() }
    }

    /// Returns the same with a coefficient of added mass, alike in all directions.
    pub fn with_added_mass(self, coefficient: f64) -> Self {
        self.with_added_mass_along([coefficient; 3])
    }

    /// Returns the same with coefficients of added mass along the axes of the body.
    pub fn with_added_mass_along(mut self, coefficients: impl Into<[f64; 3]>) -> Self {
        self.added_mass = coefficients.into().into();
        self
    }

    /// Returns the same with a displaced volume in m^3.
    pub fn with_volume(mut self, volume: f64) -> Self {
        self.volume = Some(volume);
        self
    }

    pub(super) fn check(&self, body: RigidBodyHandle) -> Result<(), Error> {
        let numbers = [("volume (m^3)", self.volume.unwrap_or(1.0), self.volume.is_none_or(|v| v > 0.0))];
        let areas = self.drag_area.iter().map(|&x| ("drag area (m^2)", x, x >= 0.0));
        let spins = self.spin_drag.iter().map(|&x| ("drag of rotation (m^5)", x, x >= 0.0));
        let added = self.added_mass.iter().map(|&x| ("coefficient of added mass", x, x >= 0.0));
        let wrong = |&(_, x, fine): &(&str, f64, bool)| !(x.is_finite() && fine);
        match numbers.into_iter().chain(areas).chain(spins).chain(added).find(wrong) {
            None => Ok(()),
            Some((what, value, _)) => Err(Error::WaterValue { body, what, value }),
        }
    }
}

/// Reads three numbers, or, from text, one that stands for them.
fn one_or_axes<'de, D: Deserializer<'de>>(from: D) -> Result<Vector3<f64>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Given {
        One(f64),
        Axes(Vector3<f64>),
    }
    // data that do not say what they hold cannot be asked
    if !from.is_human_readable() {
        return Vector3::deserialize(from);
    }
    Ok(match Given::deserialize(from)? {
        Given::One(x) => Vector3::repeat(x),
        Given::Axes(axes) => axes,
    })
}
