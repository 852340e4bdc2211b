//! Boundary conditions at a node, and their motion in time.
//!
//! # Equation
//!
//! The position and the slope vector of a node are free, prescribed as a cubic polynomial of time,
//! or (the slope) held to a direction with its length free. A prescribed coordinate leaves the
//! equations: rows and columns of the step matrix are projected, `A -> P A P + (I - P)`, P the
//! projector on the free directions.
//!
//! # Alternatives considered
//!
//! - A clamp that fixes the slope *vector*: it also fixes the stretch at the node, which is then
//!   wrong by the tension over EA; a clamp holds the direction alone.
//! - Penalty springs (they limit the step) and Lagrange multipliers (an indefinite matrix without
//!   benefit).

use crate::error::{Error, require};
use crate::integrate::Stage;
use crate::scales::cable::AFTER;
use crate::smooth;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Motion of a vector as a cubic of time: `x(t) = c0 + c1 s + c2 s^2 + c3 s^3`, `s = t - start`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Time at which s = 0, in s.
    pub start: f64,
    /// Coefficients, in the unit of x over s^k.
    pub coefficients: [Vector3<f64>; 4],
    /// Time in s from which on the value is what it is then, and the rate zero. Default: none.
    #[serde(default)]
    pub end: Option<f64>,
}

impl Motion {
    /// No motion: `x` for ever.
    pub fn fixed(x: Vector3<f64>) -> Self {
        Self::uniform(0.0, x, Vector3::zeros())
    }

    /// `x` at time `start`, then constant velocity.
    pub fn uniform(start: f64, x: Vector3<f64>, velocity: Vector3<f64>) -> Self {
        Motion { start, coefficients: [x, velocity, Vector3::zeros(), Vector3::zeros()], end: None }
    }

    /// The cubic from `(x0, v0)` at `start` to `(x1, v1)` a time `duration` later (Hermite);
    /// `duration` > 0.
    pub fn hermite(
        start: f64,
        duration: f64,
        (x0, v0): (Vector3<f64>, Vector3<f64>),
        (x1, v1): (Vector3<f64>, Vector3<f64>),
    ) -> Self {
        let [c1, c2, c3] = smooth::hermite(duration, (x1 - x0) / duration, [v0, v1]);
        let coefficients = [x0, c1, c2, c3];
        Motion { start, coefficients, end: None }
    }

    /// The same until `end` (s), and no motion from then on.
    pub fn until(self, end: f64) -> Self {
        Motion { end: Some(end), ..self }
    }

    /// Makes it later by a time in s.
    pub(crate) fn delay(&mut self, by: f64) {
        self.start += by;
        self.end = self.end.map(|end| end + by);
    }

    /// Value, velocity and acceleration at `time`.
    pub fn at(&self, time: f64) -> [Vector3<f64>; 3] {
        if let Some(end) = self.end.filter(|_| self.is_over(time)) {
            let [x, ..] = self.at(end);
            return [x, Vector3::zeros(), Vector3::zeros()];
        }
        let s = time - self.start;
        let [c0, c1, c2, c3] = self.coefficients;
        [c0 + s * (c1 + s * (c2 + s * c3)), c1 + s * (2.0 * c2 + 3.0 * s * c3), 2.0 * c2 + 6.0 * s * c3]
    }

    /// Whether its end is past.
    pub(crate) fn is_over(&self, time: f64) -> bool {
        self.end.is_some_and(|end| time - end > AFTER * (end - self.start).abs())
    }

    /// Whether nothing moves.
    pub(crate) fn is_still(&self) -> bool {
        self.coefficients[1..].iter().all(|c| *c == Vector3::zeros())
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.start.is_finite()
            && self.end.is_none_or(f64::is_finite)
            && self.coefficients.iter().flatten().all(|x| x.is_finite())
    }
}

/// What holds the slope vector of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum SlopeSupport {
    /// Nothing.
    #[default]
    Free,
    /// Its direction is this unit vector; its length (the stretch) is free.
    Direction(Vector3<f64>),
    /// The whole vector is prescribed.
    Prescribed(Motion),
    /// Its direction follows a body of an [`island`](crate::island), and is this unit vector now;
    /// its length is free. Set by
    /// [`Cable::attach_clamped`](crate::coupling::Coupling::attach_clamped).
    Attached(Vector3<f64>),
}

impl SlopeSupport {
    /// True if a direction is held and the length free.
    pub(crate) fn is_direction(&self) -> bool {
        matches!(self, SlopeSupport::Direction(_) | SlopeSupport::Attached(_))
    }
}

/// What holds a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// Prescribed position, if any.
    pub position: Option<Motion>,
    /// What holds the slope.
    pub slope: SlopeSupport,
    /// The position follows a body of an [`island`](crate::island); set by
    /// [`Cable::attach`](crate::coupling::Coupling::attach).
    #[serde(default)]
    pub attached: bool,
}

impl Support {
    /// Makes what it prescribes later by a time in s.
    pub(crate) fn delay(&mut self, by: f64) {
        let slope = match &mut self.slope {
            SlopeSupport::Prescribed(motion) => Some(motion),
            _ => None,
        };
        self.position.iter_mut().chain(slope).for_each(|motion| motion.delay(by));
    }

    /// Returns what it prescribes.
    fn motions(&self) -> impl Iterator<Item = &Motion> {
        let slope = match &self.slope {
            SlopeSupport::Prescribed(motion) => Some(motion),
            _ => None,
        };
        self.position.iter().chain(slope)
    }

    /// Whether what it prescribes stands still from a time in s on.
    pub(crate) fn is_still_from(&self, time: f64) -> bool {
        self.motions().all(|motion| motion.is_still() || motion.is_over(time))
    }

    /// Whether what it prescribes stands still.
    pub(crate) fn is_still(&self) -> bool {
        self.motions().all(Motion::is_still)
    }

    /// Refuses motions that are not finite and directions that are not unit vectors.
    pub(crate) fn check(&self) -> Result<(), Error> {
        for motion in self.motions() {
            require("prescribed motion", if motion.is_finite() { 0.0 } else { f64::NAN }, true, "a number")?;
        }
        if let SlopeSupport::Direction(d) | SlopeSupport::Attached(d) = &self.slope {
            require("length of a clamp's direction", d.norm(), (d.norm() - 1.0).abs() < 1e-6, "1")?;
        }
        Ok(())
    }

    /// True if nothing is held.
    pub fn is_free(&self) -> bool {
        !self.holds_position() && self.slope == SlopeSupport::Free
    }

    /// True if the position is not free.
    pub(crate) fn holds_position(&self) -> bool {
        self.position.is_some() || self.attached
    }

    /// True if the slope is not free.
    pub(crate) fn holds_slope(&self) -> bool {
        self.slope != SlopeSupport::Free
    }

    /// Returns whether it holds the same components as another.
    pub(crate) fn holds_as(&self, other: &Support) -> bool {
        let slopes = match (&self.slope, &other.slope) {
            (SlopeSupport::Prescribed(_), SlopeSupport::Prescribed(_)) => true,
            (one, other) => one == other,
        };
        slopes && self.holds_position() == other.holds_position()
    }

    /// Removes the held components from a nodal vector (r, t).
    pub(crate) fn project(&self, x: &mut [f64]) {
        if self.holds_position() {
            x[..3].fill(0.0);
        }
        self.project_slope(&mut x[3..6]);
    }

    fn project_slope(&self, t: &mut [f64]) {
        match self.slope {
            SlopeSupport::Free => {}
            SlopeSupport::Prescribed(_) => t.fill(0.0),
            SlopeSupport::Direction(d) | SlopeSupport::Attached(d) => {
                let along = d.x * t[0] + d.y * t[1] + d.z * t[2];
                for i in 0..3 {
                    t[i] = along * d[i];
                }
            }
        }
    }

    /// Turns a slope vector to the direction that holds it, if one does, keeping its length.
    pub(crate) fn turn(&self, t: &mut [f64]) {
        if let SlopeSupport::Direction(d) = self.slope {
            let length = (t[0] * t[0] + t[1] * t[1] + t[2] * t[2]).sqrt();
            for i in 0..3 {
                t[i] = length * d[i];
            }
        }
    }

    /// Makes the held components of an implicit stage come out as prescribed: `base + c2 k` and
    /// `velocity_base + rate c2 k`.
    pub(crate) fn prescribe_stage(&self, stage: &Stage, base: &mut [f64], velocity_base: &mut [f64], k: &mut [f64]) {
        self.prescribe(stage.time, base, velocity_base);
        let held = self.acceleration(stage.time);
        self.project(k);
        for i in 0..6 {
            base[i] -= stage.c2 * held[i];
            velocity_base[i] -= stage.dv_dq * stage.c2 * held[i];
            k[i] += held[i];
        }
    }

    /// Overwrites the held components of nodal coordinates `q` and velocities `v` by their values
    /// at `time`.
    pub(crate) fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        self.keep_direction(&mut q[3..6]);
        self.keep_direction(&mut v[3..6]);
        if let Some(motion) = self.position {
            let [x, dx, _] = motion.at(time);
            q[..3].copy_from_slice(x.as_slice());
            v[..3].copy_from_slice(dx.as_slice());
        }
        if let SlopeSupport::Prescribed(motion) = self.slope {
            let [x, dx, _] = motion.at(time);
            q[3..6].copy_from_slice(x.as_slice());
            v[3..6].copy_from_slice(dx.as_slice());
        }
    }

    /// Removes what is across the direction that holds a slope, if one does, from a change of it.
    pub(crate) fn keep_direction(&self, t: &mut [f64]) {
        if let SlopeSupport::Direction(_) = self.slope {
            self.project_slope(t);
        }
    }

    /// The accelerations of the held components at `time`; zero elsewhere.
    pub(crate) fn acceleration(&self, time: f64) -> [f64; 6] {
        let mut a = [0.0; 6];
        if let Some(motion) = self.position {
            a[..3].copy_from_slice(motion.at(time)[2].as_slice());
        }
        if let SlopeSupport::Prescribed(motion) = self.slope {
            a[3..].copy_from_slice(motion.at(time)[2].as_slice());
        }
        a
    }

    /// The projector on the free directions, as a 6x6 matrix `[column][row]`.
    pub(crate) fn projector(&self) -> [[f64; 6]; 6] {
        core::array::from_fn(|j| {
            let mut column = core::array::from_fn(|i| f64::from(u8::from(i == j)));
            self.project(&mut column);
            column
        })
    }
}

/// A node that is led, and what held it before.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Prescription {
    pub node: usize,
    pub motion: Motion,
    pub before: Support,
}

impl Prescription {
    /// Refuses motions that are not finite.
    pub fn check(&self) -> Result<(), Error> {
        Support { position: Some(self.motion), ..Support::default() }.check()?;
        self.before.check()
    }

    /// Makes it later by a time in s.
    pub fn delay(&mut self, by: f64) {
        self.motion.delay(by);
        self.before.delay(by);
    }
}
