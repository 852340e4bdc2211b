//! A fluid: its density, how it moves, and where it ends.
//!
//! # Validity
//!
//! What [`drag`](super::drag) and [`buoyancy`](super::buoyancy) of cables take, and bodies in water
//! (`lariat_rapier::water`). Current and wave are added, each as if the other were not there.

use super::flow::Flow;
use super::{Buoyancy, Drag};
use crate::error::{Error, require};
use crate::water::{Surface, Wave};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A fluid that cables and bodies are in.
///
/// ```
/// use lariat_ancf::{Flow, Surface, Vector3, Water, Wave};
///
/// let gravity = Vector3::new(0.0, -9.81, 0.0);
/// // level at y = 0, waves of 1 m from trough to crest along x, a current of 0.3 m/s
/// let surface = Surface::at(0.0, gravity).with_wave(Wave::deep(0.5, 6.0, Vector3::x()));
/// let water = Water::new(1025.0).with_flow(Flow::uniform(Vector3::new(0.3, 0.0, 0.0))).with_surface(surface);
/// assert!(water.check().is_ok());
/// assert!((water.flow.surface.unwrap().sea().depth(0.0, &Vector3::zeros()) - 0.5).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Water {
    /// Density in kg/m^3, > 0.
    pub density: f64,
    /// Current, and the free surface with its wave; samples of it are not read. Default: at rest,
    /// and everywhere.
    #[serde(default)]
    pub flow: Flow,
}

impl Water {
    /// Creates a fluid at rest, that is everywhere, of a density in kg/m^3.
    pub fn new(density: f64) -> Self {
        Water { density, flow: Flow::default() }
    }

    /// Returns the same fluid with a current.
    pub fn with_flow(mut self, flow: Flow) -> Self {
        let surface = self.flow.surface.take();
        self.flow = flow;
        self.flow.surface = self.flow.surface.or(surface);
        self
    }

    /// Returns the same fluid below a free surface.
    pub fn with_surface(mut self, surface: Surface) -> Self {
        self.flow = self.flow.with_surface(surface);
        self
    }

    /// Returns the wave on its surface.
    pub fn wave(&self) -> Option<&Wave> {
        self.flow.surface.as_ref()?.wave.as_ref()
    }

    /// Returns drag of a cable in it, with coefficients on the diameter.
    pub fn drag(&self, normal: f64, tangential: f64) -> Drag {
        Drag::new(self.density, normal, tangential, self.flow.clone())
    }

    /// Returns buoyancy of a cable in it, with a coefficient of added mass.
    pub fn buoyancy(&self, added_mass: f64) -> Buoyancy {
        Buoyancy { surface: self.flow.surface.as_deref().copied(), ..Buoyancy::new(self.density, added_mass) }
    }

    /// Checks its numbers.
    ///
    /// # Errors
    /// [`Error::InvalidValue`].
    pub fn check(&self) -> Result<(), Error> {
        require("density of the water (kg/m^3)", self.density, self.density > 0.0, "> 0")?;
        self.flow.check()
    }

    /// Returns the velocity of the current in m/s at a position and a time, without the wave.
    pub fn current(&self, time: f64, position: &Vector3<f64>) -> Vector3<f64> {
        self.flow.at(time, position)
    }
}
