//! The velocity of a fluid as a function of position and time.
//!
//! # Equation
//!
//! ```text
//! u(r, t) = U profile(up . r) history(t) + samples at the nodes, linear between them + wave(r, t)
//! ```
//!
//! profile and history are piecewise linear, constant beyond their first and last row. With a free
//! surface, what is above it is dry, and its [wave](crate::water::wave) is added.
//!
//! # Validity
//!
//! One direction by the tables; any field by samples, which the caller takes anew as often as it
//! changes ([`Cable::sample_flow`]) and which are held in between: of order 2 in the time between
//! them if taken for its middle. Times are those of the cable's clock; `set_time` changes the
//! clock, not the flow history. Tables and samples are data of the cable: serialised with it, and a
//! copy read back continues bitwise until samples are taken again. A [`Snapshot`] holds none, as it
//! holds no loads.
//!
//! # References
//!
//! The power law of wind (Hellmann 1916) and other profiles by tables.
//!
//! # Alternatives considered
//!
//! A function of the user's inside the cable: it cannot be serialised, and a snapshot would not
//! replay (for any force per length there is [`ForceDensity`], which says so). Powers and sines
//! evaluated in the step: their last bits differ between machines.
//!
//! [`Cable::sample_flow`]: crate::Cable::sample_flow
//! [`Snapshot`]: crate::Snapshot
//! [`ForceDensity`]: crate::ForceDensity

use crate::error::{Error, require, require_finite};
use crate::point::Point;
use crate::rows::{check_rows, interpolate, is_constant};
use crate::scales::effect::ROWS;
use crate::water::Surface;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A factor of the flow by height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Profile {
    /// Direction along which height is measured from the origin; of any length but zero.
    pub up: Vector3<f64>,
    /// Height in m and factor, heights ascending.
    pub rows: Vec<[f64; 2]>,
}

/// The velocity of a fluid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flow {
    /// Velocity in m/s where the factors are 1.
    pub velocity: Vector3<f64>,
    /// Change with height.
    #[serde(default)]
    pub profile: Option<Profile>,
    /// Time in s and factor, times ascending; empty = constant in time.
    #[serde(default)]
    pub history: Vec<[f64; 2]>,
    /// Velocity in m/s at the nodes, on top of the rest; empty = none. Set by
    /// [`Cable::sample_flow`](crate::Cable::sample_flow).
    #[serde(default)]
    pub samples: Vec<Vector3<f64>>,
    /// Free surface, with a wave or without. Default: none, the fluid is everywhere.
    #[serde(default)]
    pub surface: Option<Box<Surface>>,
}

impl Flow {
    /// Creates a flow of the same velocity (m/s) everywhere and always; zero for a fluid at rest.
    pub fn uniform(velocity: impl Into<Point>) -> Self {
        Flow { velocity: velocity.into().0, ..Flow::default() }
    }

    /// Creates wind after the power law: `velocity` (m/s) at `reference` (m) above the origin along
    /// `up`, times (height/reference)^exponent, up to `top` (m); none below the origin. A table of
    /// 64 pieces, denser near the ground.
    pub fn power_law(velocity: Vector3<f64>, up: Vector3<f64>, reference: f64, exponent: f64, top: f64) -> Self {
        let row = |i: usize| {
            let height = top * (i as f64 / (ROWS - 1) as f64).powi(3);
            [height, (height / reference).powf(exponent)]
        };
        Flow { velocity, profile: Some(Profile { up, rows: (0..ROWS).map(row).collect() }), ..Flow::default() }
    }

    /// Returns the same flow with a factor in time: rows of time (s) and factor.
    pub fn with_history(mut self, rows: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.history = rows.into_iter().collect();
        self
    }

    /// Returns the same flow below a free surface, with the velocity of its wave.
    pub fn with_surface(mut self, surface: Surface) -> Self {
        self.surface = Some(Box::new(surface));
        self
    }

    /// Returns the velocity in m/s at a position and a time, without samples and without that of a
    /// wave.
    pub fn at(&self, time: f64, position: &Vector3<f64>) -> Vector3<f64> {
        let velocity = self.in_time(time);
        match &self.profile {
            None => velocity,
            Some(profile) => velocity * profile.factor(position),
        }
    }

    /// Returns the largest speed in m/s by its tables, without samples and waves.
    pub(crate) fn largest_speed(&self) -> f64 {
        let largest = |rows: &[[f64; 2]]| rows.iter().map(|row| row[1].abs()).reduce(f64::max).unwrap_or(1.0);
        let by_height = self.profile.as_ref().map_or(1.0, |profile| largest(&profile.rows));
        self.velocity.norm() * by_height * largest(&self.history)
    }

    /// Returns the velocity where the profile is 1.
    pub(crate) fn in_time(&self, time: f64) -> Vector3<f64> {
        if self.history.is_empty() { self.velocity } else { self.velocity * interpolate(&self.history, time) }
    }

    /// Returns whether it is the same from one time to another, in s.
    pub fn is_steady(&self, from: f64, to: f64) -> bool {
        if self.surface.as_ref().is_some_and(|surface| surface.wave.is_some()) {
            return false;
        }
        if self.history.is_empty() || self.velocity == Vector3::zeros() {
            return true;
        }
        is_constant(&self.history, from, to)
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        require_finite("flow (m/s)", &self.velocity)?;
        if let Some(Profile { up, rows }) = &self.profile {
            require_finite("up of a flow's profile", up)?;
            require("length of up of a flow's profile", up.norm(), up.norm() > 0.0, "> 0")?;
            check_rows("a flow's profile", rows)?;
            require("rows of a flow's profile", rows.len() as f64, !rows.is_empty(), ">= 1")?;
        }
        self.surface.as_ref().map_or(Ok(()), |surface| surface.check())?;
        self.samples.iter().try_for_each(|sample| require_finite("sampled flow (m/s)", sample))?;
        check_rows("a flow's history", &self.history)
    }
}

impl Profile {
    pub(crate) fn factor(&self, position: &Vector3<f64>) -> f64 {
        interpolate(&self.rows, position.dot(&self.up) / self.up.norm())
    }

    /// Returns the factor's gradient in 1/m; 0 on a row.
    pub(crate) fn gradient(&self, position: &Vector3<f64>) -> Vector3<f64> {
        let up = self.up / self.up.norm();
        let height = position.dot(&up);
        let piece = self.rows.windows(2).find(|r| r[0][0] < height && height < r[1][0]);
        up * piece.map_or(0.0, |r| (r[1][1] - r[0][1]) / (r[1][0] - r[0][0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_a_power_law_agrees_with_it_at_and_between_its_rows() {
        let flow = Flow::power_law(Vector3::new(10.0, 0.0, 0.0), Vector3::new(0.0, 2.0, 0.0), 10.0, 0.14, 40.0);
        for height in [1.0, 5.0, 10.0, 25.0] {
            let u = flow.at(0.0, &Vector3::new(3.0, height, -1.0));
            assert!((u.x - 10.0 * (height / 10.0f64).powf(0.14)).abs() < 5e-3, "{height}: {u}");
        }
        assert_eq!(flow.at(0.0, &Vector3::new(0.0, -1.0, 0.0)).x, 0.0);
        assert_eq!(flow.at(0.0, &Vector3::new(0.0, 90.0, 0.0)), flow.at(0.0, &Vector3::new(0.0, 40.0, 0.0)));
    }

    #[test]
    fn a_history_is_linear_between_its_rows_and_constant_outside() {
        let flow = Flow::uniform(Vector3::new(0.0, 0.0, 2.0)).with_history([[1.0, 0.0], [3.0, 4.0]]);
        let z = |t: f64| flow.at(t, &Vector3::zeros()).z;
        assert_eq!([z(0.0), z(1.0), z(2.0), z(3.0), z(9.0)], [0.0, 0.0, 4.0, 8.0, 8.0]);
    }

    #[test]
    fn tables_that_do_not_ascend_or_are_not_finite_are_rejected() {
        let flow = Flow::uniform(Vector3::x());
        assert!(flow.check().is_ok());
        assert!(flow.clone().with_history([[1.0, 0.0], [1.0, 4.0]]).check().is_err());
        assert!(flow.clone().with_history([[1.0, f64::NAN]]).check().is_err());
        let profile = Some(Profile { up: Vector3::zeros(), rows: vec![[0.0, 1.0]] });
        assert!(Flow { profile, ..flow }.check().is_err());
    }
}
