//! The free surface of water.
//!
//! # Equation
//!
//! ```text
//! depth = level + eta(x, t) - up . r
//! ```
//!
//! eta is the elevation of the [wave](super::wave), 0 without one.
//!
//! # Validity
//!
//! The surface is a function of place: depth is measured along `up`, not across a sloping surface.
//! What is above it is dry: nothing of the water acts there.

use super::wave::{Airy, Wave};
use crate::error::{Error, require, require_finite};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A free surface: level of the water at rest, and a wave on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// Height of the water at rest above the origin along `up`, in m. Default: 0.
    #[serde(default)]
    pub level: f64,
    /// Direction against gravity, of any length but zero.
    pub up: Vector3<f64>,
    /// Gravity in m/s^2, > 0, which the wave number depends on.
    pub gravity: f64,
    /// A wave. Default: none.
    #[serde(default)]
    pub wave: Option<Wave>,
}

impl Surface {
    /// Creates a surface at a level (m) of water at rest, under gravity (m/s^2) that is not zero.
    pub fn at(level: f64, gravity: Vector3<f64>) -> Self {
        Surface { level, up: -gravity, gravity: gravity.norm(), wave: None }
    }

    /// Returns the same surface with a wave.
    pub fn with_wave(self, wave: Wave) -> Self {
        Surface { wave: Some(wave), ..self }
    }

    /// Checks its numbers.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers out of range, and for a wave that breaks.
    pub fn check(&self) -> Result<(), Error> {
        require("level of the water (m)", self.level, true, "a number")?;
        require_finite("up of a free surface", &self.up)?;
        require("length of up of a free surface", self.up.norm(), self.up.norm() > 0.0, "> 0")?;
        require("gravity of a free surface (m/s^2)", self.gravity, self.gravity > 0.0, "> 0")?;
        let up = self.up / self.up.norm();
        self.wave.map_or(Ok(()), |wave| wave.check(&up, self.gravity))
    }

    /// Prepares its evaluation.
    pub fn sea(&self) -> Sea {
        let up = self.up / self.up.norm();
        let airy = self.wave.as_ref().map(|wave| Airy::new(wave, &up, self.gravity));
        Sea { level: self.level, up, gravity: self.gravity, airy }
    }
}

/// A free surface, prepared for its evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sea {
    level: f64,
    up: Vector3<f64>,
    gravity: f64,
    airy: Option<Airy>,
}

/// The water at a position and a time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SeaPoint {
    /// Distance below the surface along its `up` in m; negative above it.
    pub depth: f64,
    /// Velocity in m/s.
    pub velocity: Vector3<f64>,
    /// Acceleration in m/s^2.
    pub acceleration: Vector3<f64>,
    /// Dynamic pressure over the density in m^2/s^2: what the wave adds to that of the level at
    /// rest.
    pub pressure: f64,
}

impl Sea {
    /// Returns the direction against gravity, of length 1.
    pub fn up(&self) -> Vector3<f64> {
        self.up
    }

    /// Returns whether there is a wave.
    pub fn has_wave(&self) -> bool {
        self.airy.is_some()
    }

    /// Returns how far a position is below the surface in m, along `up`.
    pub fn depth(&self, time: f64, position: &Vector3<f64>) -> f64 {
        let still = self.level - self.up.dot(position);
        self.airy.map_or(still, |airy| still + airy.elevation(time, position))
    }

    /// Returns the unit normal of the surface over a position.
    pub fn normal(&self, time: f64, position: &Vector3<f64>) -> Vector3<f64> {
        match &self.airy {
            None => self.up,
            Some(airy) => (self.up - airy.slope(time, position)).normalize(),
        }
    }

    /// Returns depth and motion of the water at a position (m) and a time (s); above the surface
    /// the motion on it.
    pub fn at(&self, time: f64, position: &Vector3<f64>) -> SeaPoint {
        let depth = self.depth(time, position);
        match &self.airy {
            None => {
                let zero = Vector3::zeros();
                SeaPoint { depth, velocity: zero, acceleration: zero, pressure: 0.0 }
            }
            Some(airy) => {
                let z = self.up.dot(position) - self.level;
                let orbit = airy.orbit(time, position, z, &self.up, self.gravity);
                SeaPoint { depth, velocity: orbit.velocity, acceleration: orbit.acceleration, pressure: orbit.pressure }
            }
        }
    }

    /// Returns the wave number in rad/m and the angular frequency in rad/s; zeros without a wave.
    pub fn wave_number_and_frequency(&self) -> (f64, f64) {
        self.airy.map_or((0.0, 0.0), |airy| (airy.number, airy.frequency))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* Wheeler's stretching puts the pressure of the linear theory at its mean level onto
    /// the surface.
    #[test]
    fn the_pressure_on_the_surface_is_zero_in_a_crest_and_in_a_trough() {
        let wave = Wave { depth: Some(20.0), ..Wave::deep(1.5, 8.0, Vector3::x()) };
        let sea = Surface::at(3.0, Vector3::new(0.0, 0.0, -9.81)).with_wave(wave).sea();
        for x in [0.0, 11.0, 25.0, 40.0] {
            let height = sea.depth(0.0, &Vector3::new(x, 0.0, 0.0));
            let on = sea.at(0.0, &Vector3::new(x, 0.0, height));
            assert!(on.depth.abs() < 1e-14, "{x}");
            assert!((on.pressure - 9.81 * (height - 3.0)).abs() < 1e-13, "{x} {on:?}");
        }
    }
}
