//! A reel whose rate is an unknown: a motor of limited force turns a wheel that the cable pulls.
//!
//! # Equation
//!
//! The acceleration a of the length over a step of the discrete gradient is unknown, `l' = l'0 + a t`. With F the
//! [pull](super::work) of the winch, m the inertia of the wheel and of the stock on it, and T the force of the motor,
//!
//! ```text
//! m a = F - T        a = a_0 and |T| <= T_max,   or   T = T_max and a > a_0,   or   T = -T_max and a < a_0
//! ```
//!
//! a_0 is what the *commanded rate* c needs. The shaft of the motor turns with it: c approaches the rate asked for, linearly over a host step and within the limit on
//! acceleration, whether the wheel follows or slips. At the end of the stock and at the least length the acceleration, and with it c, is bounded whatever T is. A slipping motor opposes the
//! slip, so it only dissipates. A T_max that the host lowers is approached linearly over a host step.
//!
//! # Solution
//!
//! With `A dv + c da = r` the linear equations of a Newton iteration and `T + row.dv + T_a da` the force,
//!
//! ```text
//! dv = A^-1 r - y da,  y = A^-1 c        T(da) = T + row.(A^-1 r) - S da        S = row.y - T_a
//! ```
//!
//! S > 0 is the apparent stiffness of all cables and bodies to the flow, so the alternative is decided by `T(a_0 - a)` exactly; several reels
//! one after the other ([`unknowns`](super::unknowns)). c, row and T_a are of the element at the eye alone ([`linear`](super::linear)). Where all
//! motors stick in an iterate, within the forces that are known of them last, da = 0 is tried first: such a reel costs what one with a given rate does. Whether the forces
//! are within their limits is judged by the result.
//!
//! # Validity
//!
//! The discrete gradient. Forces are means of a step. The linear solution must meet the law to 1e-3 of the forces of all motors, else the step is
//! iterated further.
//!
//! # Alternatives considered
//!
//! An elastic clutch with a slip as state: stiff, and its constant is arbitrary. Stages of other methods: the reel would be one more
//! coordinate of every integrator. A limit on acceleration that begins at the rate of the wheel: a wheel that has slipped, because stretch was let go, is led back
//! so slowly that the rope falls slack, and a brake stops nothing faster than that limit.

use super::{Flow, Flows};
use crate::element::flow::Extent;
use crate::error::{Error, require};
use crate::integrate::State;
use crate::integrate::discrete_gradient::{Balance, Buffers};
use crate::model::Model;
use crate::reel::Feed;
use crate::system::Equations;
use serde::{Deserialize, Serialize};

/// Least and largest length of an element at the end of an iterate, as a multiple of that at the beginning.
const REACH: [f64; 2] = [0.5, 1.5];

/// Share of a host step that is all of it.
const ALL: f64 = 1.0 - 1e-9;

/// What drives a reel during a host step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Motor {
    /// Largest force of the motor in N at the beginning and at the end of the host step.
    pub limits: [f64; 2],
    /// Length in s over which a lowered limit is approached.
    pub duration: f64,
    /// What is left in s of the host step, over which the commanded rate approaches what is asked for.
    pub host: f64,
    /// Inertia of the wheel in kg.
    pub wheel: f64,
    /// Rate in m/s asked for, and largest acceleration of the commanded rate to it in m/s^2.
    pub asked: f64,
    pub acceleration: f64,
    /// What it was left in; `None` where the rate is not that of a motor, and the commanded one begins every step at it.
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
    /// By how much that exceeds in N what the motor has at its end, where its largest force was lowered.
    #[serde(default)]
    pub excess: f64,
}

impl MotorState {
    /// Returns the largest force in N at the beginning of a host step that ends with this one: a smaller one is approached linearly from the force. At once, the rope
    /// would let go twice the stretch that it must, since forces are means of steps, and a motor that then holds the rate keeps it so.
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
    motor: Motor,
    /// Time in s at which the host step began.
    begun: f64,
    /// Commanded rate in m/s at the end of the step.
    commanded: f64,
    /// Largest force of the motor in N, in the mean of the step.
    limit: f64,
    /// Accelerations of the step: least, wanted, largest.
    planned: [f64; 3],
    /// Accelerations beyond which no iterate goes.
    reach: [f64; 2],
    /// Derivatives of the force of the motor by the velocity changes of the element, and by the acceleration.
    pub(super) row: [f64; 12],
    pub(super) own: f64,
    /// Force of the motor in the last iterate, in N; at a sheave the pull.
    pub(super) force: f64,
}

impl Flow {
    /// Returns the pull in N in the last iterate, at a sheave.
    pub(super) fn pull_of_iterate(&self) -> f64 {
        self.law.map_or(0.0, |law| law.force)
    }

    /// Begins a step of length `h` (s) with another rate in m/s, that of a drum.
    pub fn restart(&mut self, rate: f64, h: f64) {
        self.extent.rate = rate;
        if let Some(law) = &mut self.law {
            law.begin(&self.extent, self.start, h);
        }
    }

    /// Sets the acceleration that a drum gives; one beyond the reach of an iterate divides the step.
    pub fn follow(&mut self, acceleration: f64) {
        let [least, largest] = self.reach();
        self.linearised = self.extent.acceleration;
        self.extent.acceleration = acceleration.max(least).min(largest);
        self.stopped = self.law.is_some_and(|law| law.stop(acceleration).is_some());
    }

    /// Returns whether a motor holds the rate that is asked for, with a force in N of the last iterate that it has.
    fn sticks(&self) -> bool {
        self.law.is_none_or(|law| {
            let alone = !matches!(self.feed, Feed::Sheave | Feed::BodyDrum);
            alone && self.extent.acceleration == law.bounded(law.planned[1]) && law.force.abs() <= law.limit
        })
    }

    /// Returns the length in m that it can still take in.
    pub(super) fn left(&self) -> f64 {
        self.law.map_or(0.0, |law| self.extent.length - law.motor.bounds[0])
    }

    /// Returns the accelerations beyond which no iterate goes.
    pub(super) fn reach(&self) -> [f64; 2] {
        self.law.map_or([0.0; 2], |law| law.reach)
    }
}

/// Returns the least and the largest rate in m/s after a step of length `h` (s) from where a reel can still stop, by an acceleration, within what is `left` of
/// the cable, in and out.
///
/// A rate that is braked by a h in every step and to zero in the last one takes, over steps in which it is linear, the way
/// `D((k + x) a h) = a h^2 (k^2/2 + k x + x/2)`, 0 <= x < 1. The largest rate r with `D(r) <= left - h (r_0 + r)/2` is followed by that of
/// the next step, so the cable ends at the stop to rounding.
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

impl Flows {
    /// Returns whether all rates that could be unknown are as the last iterate has them: the motors of all [stick](Flow::sticks). If the result
    /// of an iteration breaks a law, the next one solves for the rates.
    pub fn stick(&self) -> bool {
        self.list.iter().all(Flow::sticks)
    }
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
    fn begin(&mut self, flow: &Extent, time: f64, h: f64) {
        let Extent { length, rate, .. } = *flow;
        let Motor { limits, duration, host, asked, acceleration, bounds, before, .. } = self.motor;
        let left = [length - bounds[0], bounds[1] - length];
        let [least, largest] = rates(acceleration, rate, left, h);
        let (from, over, share) = before.map_or((rate, h, 1.0), |before| {
            let share = (time + h - self.begun) / host;
            // a sum of steps ends there to rounding
            (before.commanded, host, if share > ALL { 1.0 } else { share })
        });
        let target = asked.clamp(from - acceleration * over, from + acceleration * over);
        self.commanded = if share == 1.0 { target } else { from + share * (target - from) }.clamp(least, largest);
        self.planned = [least, self.commanded, largest].map(|end| (end - rate) / h);
        let middle = (time + 0.5 * h - self.begun) / duration;
        self.limit = limits[1] + (1.0 - middle).clamp(0.0, 1.0) * (limits[0] - limits[1]);
        self.reach = REACH.map(|share| 2.0 * ((share - 1.0) * length - h * rate) / (h * h));
    }

    /// Returns the acceleration that is nearest to one, within the stops and the reach of an iterate.
    fn bounded(&self, acceleration: f64) -> f64 {
        let [least, _, largest] = self.planned;
        acceleration.max(least).min(largest).max(self.reach[0]).min(self.reach[1])
    }

    /// Returns the acceleration of a stop at an end of the cable, if this one goes beyond it.
    pub(super) fn stop(&self, acceleration: f64) -> Option<f64> {
        let [least, _, largest] = self.planned;
        let rounding = 1e-9 * (1.0 + acceleration.abs());
        if acceleration > largest - rounding {
            Some(largest)
        } else {
            (acceleration < least + rounding).then_some(least)
        }
    }

    /// Returns the acceleration of an iterate at which the motor would have the force `at(a)`, which falls with the slope `-stiffness`.
    pub(super) fn acceleration_for(&self, present: f64, force: f64, stiffness: f64) -> f64 {
        let wanted = self.planned[1];
        let stuck = force - stiffness * (wanted - present);
        let slipping = present + (force - self.limit.copysign(stuck)) / stiffness;
        let wished = if stuck.abs() <= self.limit { wanted } else { slipping };
        self.bounded(wished)
    }

    /// Returns the product of the row of a flow and the increments of the velocity changes of its cable.
    pub(super) fn along_row(&self, flow: &Flow, increment: &[f64]) -> f64 {
        self.row.iter().zip(flow.side.gather(increment)).map(|(a, b)| a * b).sum()
    }

    /// Returns by how much the force of the motor in N breaks the law at an acceleration.
    fn violation(&self, acceleration: f64) -> f64 {
        let [least, wanted, largest] = self.planned;
        let rounding = 1e-12 * (1.0 + acceleration.abs());
        let limit = self.limit;
        if (acceleration - wanted).abs() <= rounding {
            // a motor that is asked to stand at a stop: that pulls what the motor cannot
            let beyond = if wanted >= largest - rounding { 0.0 } else { (self.force - limit).max(0.0) };
            let below = if wanted <= least + rounding { 0.0 } else { (-limit - self.force).max(0.0) };
            beyond.max(below)
        } else if acceleration >= largest - rounding {
            // a stop pulls as it must
            (limit - self.force).max(0.0)
        } else if acceleration <= least + rounding {
            (limit + self.force).max(0.0)
        } else {
            (self.force - limit.copysign(acceleration - wanted)).abs()
        }
    }
}

impl Flow {
    /// Returns the force in N of the motor at an extent, from the force on the length.
    pub(super) fn motor(&self, model: &Model, extent: Extent, q: &[f64; 12], on_length: f64) -> f64 {
        let element = self.with(model, extent);
        let wheel = self.law.map_or(0.0, |law| {
            let stock = (law.motor.bounds[1] - extent.length).max(0.0);
            let wound = matches!(self.feed, Feed::Drum | Feed::BodyDrum) && stock.is_finite();
            law.motor.wheel + if wound { element.inertia * stock } else { 0.0 }
        });
        self.feed.pull(&element, q, on_length) - wheel * extent.acceleration
    }
}

impl Equations<'_> {
    /// Begins a step of length `h` (s) for reels whose rate is unknown: sets the first iterate.
    pub fn begin_laws(&mut self, time: f64, h: f64) {
        for flow in self.system.flows.list.iter_mut() {
            if !flow.extent.acceleration.is_finite() {
                // left by the last iterate of a step that failed
                flow.extent.acceleration = 0.0;
            }
            let extent = flow.at(time);
            let Some(law) = &mut flow.law else { continue };
            flow.on_length.begin = None;
            if flow.feed == Feed::BodyDrum && (flow.start != time || flow.left_rate.is_none()) {
                flow.left_rate = Some(extent.rate);
            }
            let slipped = flow.extent.acceleration != law.planned[1];
            (flow.start, flow.extent) = (time, extent);
            law.begin(&extent, time, h);
            let [least, wanted, largest] = law.planned;
            flow.extent.acceleration = law.bounded(if slipped { extent.acceleration } else { wanted });
            flow.stopped = wanted == least || wanted == largest;
        }
    }

    /// Returns the middle and the mean rates of the element at an eye over the present iterate.
    pub(super) fn motion_of_step(&self, flow: &Flow, state: &State, b: &Buffers) -> [[f64; 12]; 3] {
        let rate = 1.0 / b.h;
        let [velocity, acceleration] = [&b.change, &b.velocity_change].map(|x| flow.side.gather(x).map(|x| rate * x));
        [self.middle_of_step(flow, state, b), velocity, acceleration]
    }

    /// Computes the forces of the motors of the present iterate.
    pub fn read_motors(&mut self, state: &State, b: &Buffers) {
        for k in 0..self.system.flows.list.len() {
            let flow = &self.system.flows.list[k];
            if flow.law.is_none() {
                continue;
            }
            let on_length = self.on_length_of_step(flow, state, b);
            let (mean, q) = (flow.over(state.time, b.h).0, self.middle_of_step(flow, state, b));
            let force = flow.motor(self.model, mean, &q, on_length.force) + flow.lost(self.model, &q, mean.rate);
            let flow = &mut self.system.flows.list[k];
            flow.on_length = on_length;
            flow.law.iter_mut().for_each(|law| law.force = force);
        }
    }

    /// Adds to a balance by how much the motors break their laws.
    pub fn balance_motors(&mut self, state: &State, b: &Buffers, balance: &mut Balance) {
        self.read_motors(state, b);
        for flow in &self.system.flows.list {
            if let Some(law) = &flow.law {
                let acceleration = flow.extent.acceleration;
                // a sheave has one law for both of its flows, and a drum that of its body
                if !matches!(flow.feed, Feed::Sheave | Feed::BodyDrum) {
                    balance.slip[0] += law.violation(acceleration);
                    balance.slip[1] += law.force.abs();
                }
                if law.reach.contains(&acceleration) {
                    // no law of energy: the step is divided
                    balance.residual = f64::NAN;
                }
            }
        }
    }

    /// Adds an increment to the acceleration of the iterate.
    pub fn add_to_law(&mut self, k: usize, increment: f64) {
        let flow = &mut self.system.flows.list[k];
        flow.linearised = flow.extent.acceleration;
        flow.extent.acceleration += increment;
    }
}
