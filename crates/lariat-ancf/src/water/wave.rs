//! A linear regular wave (Airy).
//!
//! # Equation
//!
//! ```text
//! eta = a cos(theta)                    theta = k x - omega t + phase        omega^2 = g k tanh(k d)
//! u = a omega C cos(theta)              w = a omega S sin(theta)
//! du/dt = a omega^2 C sin(theta)        dw/dt = -a omega^2 S cos(theta)      p = rho g a P cos(theta)
//! C, S = cosh, sinh(k (z' + d))/sinh(k d)        P = cosh(k (z' + d))/cosh(k d)        z' = d (z - eta)/(d + eta)
//! ```
//!
//! x along the direction of the wave, z upwards from the level of the water at rest, d the depth;
//! in deep water C = S = P = exp(k z') and z' = z - eta. z' is Wheeler's: the wave at the surface
//! itself is that of the linear theory at its mean level, so that velocities stay bounded in a
//! crest, and the pressure, p - rho g z, is zero on the surface. p is the dynamic pressure.
//!
//! # Validity
//!
//! Of first order in the steepness a k: velocities are off by a share of about a k. No set-down, no
//! drift (Stokes). A steepness beyond that at which waves break, 0.142 pi tanh(k d), is refused.
//! The acceleration is the local one, without u grad u, which is of second order. A current is
//! added without a change of the wave: the period is that which a fixed observer sees, and k is off
//! by a share of 2 U/(omega/k).
//!
//! # References
//!
//! Airy 1845; Dean & Dalrymple 1991, ch. 3; J. D. Wheeler, "Method for calculating forces produced
//! by irregular waves", J. Petroleum Technology 22 (1970) 359. Breaking: Miche 1944. First guess of
//! k: Eckart 1952.
//!
//! # Alternatives considered
//!
//! Evaluation at the mean level alone, with the values of z = 0 above: discontinuous slopes at z =
//! 0 for what floats there. Powers and sines of the platform: their last bits differ between
//! machines.

use crate::error::{Error, require, require_finite};
use crate::scales::water::{DISPERSION_ROUNDS, STEEPEST};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A regular wave on a [`Surface`](super::Surface).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wave {
    /// Amplitude a in m, half the height from trough to crest; > 0.
    pub amplitude: f64,
    /// Period in s, > 0.
    pub period: f64,
    /// Direction in which it goes; its part along the surface, of any length but zero, counts.
    pub direction: Vector3<f64>,
    /// Phase in rad: 0 puts a crest over the origin at time zero. Default: 0.
    #[serde(default)]
    pub phase: f64,
    /// Depth of the water at rest in m, > 0. Default: deep.
    #[serde(default)]
    pub depth: Option<f64>,
}

impl Wave {
    /// Creates a wave on deep water, with amplitude (m), period (s) and direction, and a crest over
    /// the origin at time zero.
    pub fn deep(amplitude: f64, period: f64, direction: Vector3<f64>) -> Self {
        Wave { amplitude, period, direction, phase: 0.0, depth: None }
    }

    /// Returns the wave number k in rad/m under a gravity in m/s^2: the root of omega^2 = g k
    /// tanh(k d), to rounding.
    pub fn number(&self, gravity: f64) -> f64 {
        let omega = core::f64::consts::TAU / self.period;
        let deep = omega * omega / gravity;
        self.depth.map_or(deep, |depth| dispersion(deep * depth) / depth)
    }

    /// Returns a k over that at which the wave breaks.
    pub fn steepness(&self, gravity: f64) -> f64 {
        let k = self.number(gravity);
        self.amplitude * k / (STEEPEST * self.depth.map_or(1.0, |depth| libm::tanh(k * depth)))
    }

    pub(super) fn check(&self, up: &Vector3<f64>, gravity: f64) -> Result<(), Error> {
        require("amplitude of a wave (m)", self.amplitude, self.amplitude > 0.0, "> 0")?;
        require("period of a wave (s)", self.period, self.period > 0.0, "> 0")?;
        require("phase of a wave (rad)", self.phase, true, "a number")?;
        require("depth of the water (m)", self.depth.unwrap_or(1.0), self.depth.is_none_or(|d| d > 0.0), "> 0")?;
        require("gravity on a wave (m/s^2)", gravity, gravity > 0.0, "> 0")?;
        require_finite("direction of a wave", &self.direction)?;
        let along = (self.direction - up * up.dot(&self.direction)).norm();
        require("length of a wave's direction along the surface", along, along > 0.0, "> 0")?;
        let share = self.steepness(gravity);
        let breaks = "a steepness a k below 0.142 pi tanh(k d), where waves break";
        require("steepness of a wave over that at which it breaks", share, share <= 1.0, breaks)
    }
}

/// Returns the root x of `x tanh x = y`, to rounding.
fn dispersion(y: f64) -> f64 {
    let mut x = y / libm::tanh(y).sqrt();
    for _ in 0..DISPERSION_ROUNDS {
        let t = libm::tanh(x);
        let change = (x * t - y) / (t + x * (1.0 - t * t));
        x -= change;
        if change.abs() <= f64::EPSILON * x {
            break;
        }
    }
    x
}

/// A wave, prepared for its evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Airy {
    amplitude: f64,
    pub number: f64,
    pub frequency: f64,
    along: Vector3<f64>,
    phase: f64,
    depth: Option<f64>,
}

/// Velocity (m/s) and acceleration (m/s^2) of the water, and its dynamic pressure over its density
/// (m^2/s^2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Orbit {
    pub velocity: Vector3<f64>,
    pub acceleration: Vector3<f64>,
    pub pressure: f64,
}

impl Airy {
    /// Prepares a checked wave.
    pub fn new(wave: &Wave, up: &Vector3<f64>, gravity: f64) -> Self {
        let along = wave.direction - up * up.dot(&wave.direction);
        Airy {
            amplitude: wave.amplitude,
            number: wave.number(gravity),
            frequency: core::f64::consts::TAU / wave.period,
            along: along / along.norm(),
            phase: wave.phase,
            depth: wave.depth,
        }
    }

    fn angle(&self, time: f64, position: &Vector3<f64>) -> f64 {
        self.number * self.along.dot(position) - self.frequency * time + self.phase
    }

    /// Returns the elevation in m.
    pub fn elevation(&self, time: f64, position: &Vector3<f64>) -> f64 {
        self.amplitude * libm::cos(self.angle(time, position))
    }

    /// Returns the gradient of the elevation along the surface.
    pub fn slope(&self, time: f64, position: &Vector3<f64>) -> Vector3<f64> {
        self.along * (-self.amplitude * self.number * libm::sin(self.angle(time, position)))
    }

    /// Returns the motion of the water at a position at a height z (m) above the level at rest;
    /// above the surface that on it.
    pub fn orbit(&self, time: f64, position: &Vector3<f64>, z: f64, up: &Vector3<f64>, gravity: f64) -> Orbit {
        let (sine, cosine) = libm::sincos(self.angle(time, position));
        let below = z - self.amplitude * cosine;
        let k = self.number;
        let [c, s, p] = match self.depth {
            None => [libm::exp(k * below.min(0.0)); 3],
            Some(depth) => {
                let stretched = (depth * below / (depth + self.amplitude * cosine)).clamp(-depth, 0.0);
                let (rising, falling) = (libm::exp(k * stretched), libm::exp(-k * (stretched + 2.0 * depth)));
                let bottom = libm::exp(-2.0 * k * depth);
                let (sum, difference) = (rising + falling, rising - falling);
                [sum / (1.0 - bottom), difference / (1.0 - bottom), sum / (1.0 + bottom)]
            }
        };
        let speed = self.amplitude * self.frequency;
        let rate = speed * self.frequency;
        Orbit {
            velocity: self.along * (speed * c * cosine) + up * (speed * s * sine),
            acceleration: self.along * (rate * c * sine) - up * (rate * s * cosine),
            pressure: gravity * self.amplitude * p * cosine,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.81;

    fn wave(depth: Option<f64>) -> Wave {
        Wave { phase: 0.3, depth, ..Wave::deep(0.4, 6.0, Vector3::new(1.0, 5.0, 1.0)) }
    }

    /// *Source.* The relation itself, over eight decades of depth; omega^2/g in deep and
    /// omega/sqrt(g d) in shallow water.
    #[test]
    fn the_wave_number_solves_the_dispersion_relation_to_rounding() {
        for period in [0.5, 2.0, 8.0, 20.0] {
            let omega = core::f64::consts::TAU / period;
            for power in -4..=4 {
                let depth = 10f64.powi(power);
                let k = Wave { period, ..wave(Some(depth)) }.number(G);
                let error = G * k * libm::tanh(k * depth) / (omega * omega) - 1.0;
                assert!(error.abs() < 1e-14, "{period} {depth} {error:e}");
            }
            let shallow = Wave { period, ..wave(Some(1e-4)) }.number(G);
            assert!((shallow / (omega / (G * 1e-4).sqrt()) - 1.0).abs() < 1e-2);
            assert!((Wave { period, ..wave(None) }.number(G) / (omega * omega / G) - 1.0).abs() < 1e-15);
        }
    }

    /// *Source.* Central differences of the velocity in time with z' held, and of velocity in
    /// place: the flow is free of divergence and rotation, and the pressure obeys Bernoulli's
    /// linear law, grad p = -rho du/dt, at the mean level.
    #[test]
    fn the_motion_is_that_of_an_ideal_fluid_to_first_order() {
        for depth in [None, Some(7.0)] {
            // so low that the stretching of z, which is of second order, does not count
            let wave = Wave { amplitude: 1e-6, direction: Vector3::x(), ..wave(depth) };
            let airy = Airy::new(&wave, &Vector3::z(), G);
            let at = |t: f64, x: f64, z: f64| airy.orbit(t, &Vector3::new(x, 0.0, z), z, &Vector3::z(), G);
            let (t, x, z, h) = (0.7, 2.3, -1.9, 1e-4);
            let d = |a: Vector3<f64>, b: Vector3<f64>| (a - b) / (2.0 * h);
            let in_time = d(at(t + h, x, z).velocity, at(t - h, x, z).velocity);
            let in_x = d(at(t, x + h, z).velocity, at(t, x - h, z).velocity);
            let in_z = d(at(t, x, z + h).velocity, at(t, x, z - h).velocity);
            let scale = 1e-6 * airy.frequency * airy.frequency;
            assert!((in_time - at(t, x, z).acceleration).norm() < 1e-5 * scale, "{in_time}");
            assert!((in_x.x + in_z.z).abs() < 1e-5 * scale && (in_x.z - in_z.x).abs() < 1e-5 * scale);
            let gradient = Vector3::new(
                (at(t, x + h, z).pressure - at(t, x - h, z).pressure) / (2.0 * h),
                0.0,
                (at(t, x, z + h).pressure - at(t, x, z - h).pressure) / (2.0 * h),
            );
            assert!((gradient + at(t, x, z).acceleration).norm() < 1e-5 * scale, "{gradient}");
            let rise = (airy.elevation(t + h, &Vector3::x()) - airy.elevation(t - h, &Vector3::x())) / (2.0 * h);
            assert!((rise - at(t, 1.0, 0.0).velocity.z).abs() < 1e-5 * 1e-6, "the surface moves with the water");
        }
    }

    #[test]
    fn a_wave_that_breaks_or_stands_upright_is_refused() {
        let good = wave(Some(7.0));
        assert!(good.check(&Vector3::z(), G).is_ok());
        for bad in [
            Wave { amplitude: 0.0, ..good },
            Wave { period: -1.0, ..good },
            Wave { direction: Vector3::z(), ..good },
            Wave { depth: Some(0.0), ..good },
            Wave { amplitude: 3.5, ..good },
            Wave { phase: f64::NAN, ..good },
        ] {
            assert!(bad.check(&Vector3::z(), G).is_err(), "{bad:?}");
        }
    }
}
