//! A reel whose rate is an unknown: a motor of limited force turns a wheel that the cable pulls.
//!
//! # Equation
//!
//! The acceleration a of the length over a step of the discrete gradient is unknown, `l' = l'0 + a
//! t`. With F the [pull](super::work) of the winch, m the inertia of the wheel and of the stock on
//! it, and T the force of the motor,
//!
//! ```text
//! m a = F - T        T in T_max Sign(a - a_0)
//! ```
//!
//! a_0 is what the *commanded rate* c needs. The shaft of the motor turns with it: c approaches the
//! rate asked for, linearly over a host step and within the limit on acceleration, whether the
//! wheel follows or slips. c comes to rest at the end of the stock, at the least length and at a
//! length that is asked for within the limit on acceleration; a wheel that slips comes there with
//! its own rate, and the first two stop it at once, whatever T is: a stop is rigid, and the stretch
//! of the rope brakes what hangs on it. A slipping motor opposes the slip, so it only dissipates. A
//! T_max that the host lowers is approached linearly over a host step.
//!
//! # Solution
//!
//! With `A dv + c da = r` the linear equations of a Newton iteration and `T + row.dv + T_a da` the
//! force,
//!
//! ```text
//! dv = A^-1 r - y da,  y = A^-1 c        T(da) = T + row.(A^-1 r) - S da        S = row.y - T_a
//! ```
//!
//! S > 0 is the apparent stiffness of all cables and bodies to the feed, so the
//! [graph](super::graph) is met exactly; several reels one after the other
//! ([`unknowns`](super::unknowns)). c, row and T_a are of the element at the eye alone
//! ([`linear`](super::linear)). Where all motors stick in an iterate, within the forces that are
//! known of them last, da = 0 is tried first: such a reel costs what one with a given rate does.
//! Whether the forces are within their limits is judged by the result.
//!
//! # Validity
//!
//! The discrete gradient. Forces are means of a step. The linear solution must meet the law to 1e-3
//! of the forces of all motors, else the step is iterated further.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/reels.md.

use super::graph::{Bound, Graph};
use crate::element::variable_length::Extent;
use crate::error::{Error, require};
use crate::scales::reel::{ALL, REACH};
use serde::{Deserialize, Serialize};

/// What drives a reel during a host step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Motor {
    /// Largest force of the motor in N at the beginning and at the end of the host step.
    pub limits: [f64; 2],
    /// Length in s over which a lowered limit is approached.
    pub duration: f64,
    /// What is left in s of the host step, over which the commanded rate approaches what is asked
    /// for.
    pub host: f64,
    /// Inertia of the wheel in kg.
    pub wheel: f64,
    /// Rate in m/s asked for, and largest acceleration of the commanded rate to it in m/s^2.
    pub asked: f64,
    pub acceleration: f64,
    /// Largest deceleration in m/s^2 of a wheel that comes to an end of what it may have.
    pub stop: f64,
    /// Length in m of the element at which the commanded rate is to end.
    pub target: Option<f64>,
    /// What it was left in; `None` where the rate is not that of a motor, and the commanded one
    /// begins every step at it.
    pub before: Option<MotorState>,
    /// Least and largest length in m that the element may have.
    pub bounds: [f64; 2],
}

/// What a motor leaves to the next host step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MotorState {
    /// Commanded rate in m/s.
    pub commanded: f64,
    /// Largest force in N.
    pub limit: f64,
    /// Force in N over the last step.
    pub force: f64,
    /// By how much that exceeds in N what the motor has at its end, where its largest force was
    /// lowered.
    #[serde(default)]
    pub excess: f64,
}

impl MotorState {
    /// Returns the largest force in N at the beginning of a host step that ends with this one: a
    /// smaller one is approached linearly from the force. At once, the rope would let go twice the
    /// stretch that it must, since forces are means of steps, and a motor that then holds the rate
    /// keeps it so.
    pub fn limit_before(&self, limit: f64) -> f64 {
        if limit < self.limit { self.force.abs().max(limit).min(self.limit) } else { limit }
    }

    /// Refuses numbers that make no state.
    pub fn check(&self) -> Result<(), Error> {
        require("commanded rate of a reel (m/s)", self.commanded, true, "a number")?;
        require("force of a motor of a reel (N)", self.force, true, "a number")?;
        require("force of a motor of a reel (N)", self.excess, true, "a number")?;
        require("largest force of a motor of a reel (N)", self.limit, self.limit >= 0.0, ">= 0")
    }
}

/// A motor, and the unknown over a step of the integrator.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Law {
    pub(super) motor: Motor,
    /// Time in s at which the host step began.
    pub(super) begun: f64,
    /// Commanded rate in m/s at the end of the step.
    pub(super) commanded: f64,
    /// Largest force of the motor in N, in the mean of the step.
    pub(super) limit: f64,
    /// Accelerations of the step.
    pub(super) graph: Graph,
    /// Accelerations beyond which no iterate goes.
    pub(super) reach: [f64; 2],
    /// Derivatives of the force of the motor by the velocity changes of the element, and by the
    /// acceleration.
    pub(super) row: [f64; 12],
    pub(super) own: f64,
    /// Force of the motor in the last iterate, in N; at a sheave the pull.
    pub(super) force: f64,
}

/// Returns the least and the largest rate in m/s after a step of length `h` (s) from where a reel
/// can still stop, by an acceleration, within what is `left` of the cable, in and out.
///
/// A rate that is braked by a h in every step and to zero in the last one takes, over steps in
/// which it is linear, the way `D((k + x) a h) = a h^2 (k^2/2 + k x + x/2)`, 0 <= x < 1. The
/// largest rate r with `D(r) <= left - h (r_0 + r)/2` is followed by that of the next step, so the
/// cable ends at the stop to rounding.
pub(crate) fn rates(acceleration: f64, rate: f64, left: [f64; 2], h: f64) -> [f64; 2] {
    let a = acceleration;
    // towards an end that is `left` away, at the present rate r towards it
    let bound = |left: f64, r: f64| {
        let left = (left - 0.5 * h * r) / (a * h * h);
        if left <= 0.0 || left.is_infinite() {
            return left.max(0.0);
        }
        // D + h r/2 = a h^2 (k (k + 1)/2 + x (k + 1))
        let steps = (0.5 * ((1.0 + 8.0 * left).sqrt() - 1.0)).floor();
        a * h * (steps + (left - 0.5 * steps * (steps + 1.0)) / (steps + 1.0))
    };
    let [least, largest] = [-bound(left[0], -rate), bound(left[1], rate)];
    [least, largest.max(least)]
}

/// Returns the rate in m/s after a step of length `h` (s) of what is to end in a length that is
/// `way` (m) ahead: `asked`, or the largest from where it can still stop there by an acceleration,
/// within limits of what the acceleration gives. Where it is too fast, it comes back.
pub(crate) fn towards(
    acceleration: f64,
    (rate, asked): (f64, f64),
    (way, h): (f64, f64),
    [low, high]: [f64; 2],
) -> f64 {
    let left = if way < 0.0 { [-way, 0.0] } else { [0.0, way] };
    let [least, largest] = rates(acceleration, rate, left, h);
    asked.clamp(least, largest).clamp(low, high)
}

impl Law {
    /// Creates the law of a motor for a host step that begins at a time in s.
    pub fn new(motor: Motor, begun: f64) -> Self {
        let force = motor.before.map_or(0.0, |before| before.force);
        Law { motor, begun, force, ..Law::default() }
    }

    /// Returns what the motor leaves to the next host step.
    pub fn state(&self) -> MotorState {
        let limit = self.motor.limits[1];
        // a stop pulls as it must, whatever the motor has
        let beyond = (self.force.abs() - limit).clamp(0.0, (self.limit - limit).max(0.0));
        MotorState { commanded: self.commanded, limit, force: self.force, excess: beyond.copysign(self.force) }
    }

    /// Begins a step of length `h` (s) at `time` (s) from an extent.
    pub(super) fn begin(&mut self, feed: &Extent, time: f64, h: f64) {
        let Extent { length, rate, .. } = *feed;
        let Motor { limits, duration, host, asked, acceleration, stop, target: end, bounds, before, .. } = self.motor;
        let left = [length - bounds[0], bounds[1] - length];
        let [least, largest] = rates(stop, rate, left, h);
        let [low, high] = rates(acceleration, rate, left, h);
        let (from, over, share) = before.map_or((rate, h, 1.0), |before| {
            let share = (time + h - self.begun) / host;
            // a sum of steps ends there to rounding
            (before.commanded, host, if share > ALL { 1.0 } else { share })
        });
        let target = asked.clamp(from - acceleration * over, from + acceleration * over);
        let mut commanded = if share == 1.0 { target } else { from + share * (target - from) };
        if let Some(end) = end {
            let reached = acceleration * share * over;
            commanded = towards(acceleration, (rate, commanded), (end - length, h), [from - reached, from + reached]);
        }
        self.commanded = commanded.clamp(low, high).clamp(least, largest);
        let [least, wanted, largest] = [least, self.commanded, largest].map(|end| (end - rate) / h);
        self.graph = Graph { least, wanted, balanced: wanted, largest };
        let middle = (time + 0.5 * h - self.begun) / duration;
        self.limit = limits[1] + (1.0 - middle).clamp(0.0, 1.0) * (limits[0] - limits[1]);
        self.reach = REACH.map(|share| 2.0 * ((share - 1.0) * length - h * rate) / (h * h));
    }

    /// Returns the acceleration that is nearest to one, within the stops and the reach of an
    /// iterate.
    pub(super) fn bounded(&self, acceleration: f64) -> f64 {
        self.graph.bounded(acceleration).max(self.reach[0]).min(self.reach[1])
    }

    /// Returns the largest force of the motor.
    pub(super) fn bound(&self) -> Bound {
        Bound { limit: self.limit, ..Bound::default() }
    }
}
