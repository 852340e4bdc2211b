//! Forces, impulses and work at the pins of an island over a host step.
//!
//! # Equation
//!
//! ```text
//! f = F_r - (M q'')_r          m = t x (F_t - (M q'')_t)
//! impulse = int f dt           work = int f.v + m.omega dt
//! ```
//!
//! f and m are force and moment of the cable on the body at the anchor: the residual of the cable
//! at the pinned rows after every step of the integrator. The integrals are by the trapezoidal rule
//! over these steps; those of the discrete gradient are exact. What they miss of the momentum of
//! the cable is given to [driven pins](super::pin_momentum), and what they miss of the momentum of
//! a free body to its pins:
//!
//! ```text
//! sum of J over the pins of a body = m (v1 - v0) - F h        J += its share of what is missed, by the changes of its force in the steps
//! ```
//!
//! A body with one pin has that pin's impulse to rounding; of several, the error is where forces
//! changed.
//!
//! # Validity
//!
//! Work and angular impulse are those of the trapezoidal rule, also where a step begins with a
//! jolt, which that does not resolve. Of two cables on one body that is struck, impulses are off by
//! up to 1 % of the largest, with the right sum.
//!
//! # References
//!
//! Virtual work; the residual of a held row is its reaction; Newton's second law.

use super::body::RigidBody;
use super::equations::IslandEquations;
use super::hold::{stack, vector};
use super::layout::Layout;
use super::pin_momentum::PinMomentum;
use crate::cable::Cable;
use crate::effect::acts::ForceInput;
use crate::state::State;
use nalgebra::Vector3;

/// What the cable did to the body at one pin during the last step. World axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PinAccount {
    /// Force at the end of the step in N.
    pub force: Vector3<f64>,
    /// Moment about the anchor at the end of the step in N m; zero at a ball.
    pub moment: Vector3<f64>,
    /// Impulse over the step in N s: those on a free body sum up to what it gains beside its loads.
    pub impulse: Vector3<f64>,
    /// Angular impulse about the anchor over the step in N m s.
    pub angular_impulse: Vector3<f64>,
    /// Work over the step in J.
    pub work: f64,
    power: f64,
}

impl PinAccount {
    /// Adds the account of the step that follows.
    pub fn add(&mut self, next: &PinAccount) {
        let (impulse, angular_impulse) = (self.impulse, self.angular_impulse);
        let work = self.work;
        *self = *next;
        self.impulse += impulse;
        self.angular_impulse += angular_impulse;
        self.work += work;
    }

    /// Adds a step of length `h` (s) of mean force, moment and power; of a slope only the moment
    /// counts.
    pub(super) fn add_mean(&mut self, h: f64, slope: bool, (force, moment, power): (Vector3<f64>, Vector3<f64>, f64)) {
        if slope {
            self.moment = moment;
        } else {
            self.force = force;
        }
        self.impulse += force * h;
        self.angular_impulse += moment * h;
        self.work += power * h;
    }
}

/// The accounts of all pins.
#[derive(Clone, Debug, Default)]
pub(super) struct PinAccounts {
    /// By pin.
    pub pins: Vec<PinAccount>,
    /// What the pins of driven bodies take of the momentum of the cables.
    pub momentum: PinMomentum,
    /// Time in s up to which they are integrated; `None` before the first state of a step.
    until: Option<f64>,
    /// By pin, the sum of the changes of its force from state to state times their distance in
    /// time, in N s.
    changes: Vec<f64>,
}

impl PinAccounts {
    /// Begins a host step.
    pub fn begin(&mut self, cables: &[&mut Cable], layout: &Layout) {
        self.pins.clear();
        self.pins.resize(layout.pins.len(), PinAccount::default());
        self.momentum.begin(cables, layout);
        self.until = None;
        self.changes.clear();
        self.changes.resize(layout.pins.len(), 0.0);
    }

    /// Ends a host step: driven pins take their shares of the momentum of the cables.
    pub fn end(&mut self, cables: &[&mut Cable], layout: &Layout) {
        if !self.momentum.is_active() {
            return;
        }
        for (account, impulse) in self.pins.iter_mut().zip(&self.momentum.impulses) {
            account.impulse += impulse;
        }
        for (c, cable) in cables.iter().enumerate() {
            let of = |pin: usize| [self.pins[pin].impulse, self.pins[pin].angular_impulse];
            if let Some(left) = self.momentum.left_to_clamps(c, layout, cable, of) {
                let of_cable = |pin: usize| layout.pins[pin].cable == c && layout.clamps[pin].is_some();
                let clamps = self.pins.iter_mut().enumerate().filter(|(pin, _)| of_cable(*pin));
                clamps.for_each(|(_, account)| account.angular_impulse += left);
            }
        }
    }

    /// Gives the pins of free bodies what the impulses over a step of `h` (s), at the end of which
    /// the bodies are as in `bodies`, miss of their momentum. The discrete gradient needs none of
    /// it.
    pub fn balance(&mut self, layout: &Layout, bodies: &[RigidBody], h: f64) {
        let change = |i: usize| {
            let (first, last) = (&layout.bodies[i], &bodies[i]);
            stack(&(last.velocity - first.velocity), &(last.angular_velocity - first.angular_velocity))
        };
        for (i, body) in layout.bodies.iter().enumerate().filter(|(_, body)| !body.is_driven()) {
            let own = change(i);
            let mut missed = vector(own.as_slice()) * body.mass - body.force * h;
            if let Some((carried, _)) = body.carried_momentum(&vector(own.as_slice()), &vector(&own.as_slice()[3..])) {
                missed += carried;
            }
            for coupled in &layout.coupled {
                let of_body = coupled.momenta(change).into_iter().filter(|(of, _)| *of == i);
                of_body.for_each(|(_, momentum)| missed += vector(momentum.as_slice()));
            }
            let pins = || (0..layout.pins.len()).filter(|&pin| layout.pins[pin].body == i);
            missed -= pins().map(|pin| self.pins[pin].impulse).sum::<Vector3<f64>>();
            (0..3).filter(|&x| !body.free[x]).for_each(|x| missed[x] = 0.0);
            let (count, all) = (pins().count() as f64, pins().map(|pin| self.changes[pin]).sum::<f64>());
            for pin in pins() {
                let share = if all > 0.0 { self.changes[pin] / all } else { 1.0 / count };
                self.pins[pin].impulse += missed * share;
            }
        }
    }

    /// Adds the impulses of an inelastic impact: `momentum` is what the nodes of the cables gained,
    /// `change` the change of all velocities `v`. The work is that on the body; the cable's
    /// remaining energy loss is heat.
    pub fn add_impact(&mut self, layout: &Layout, q: &[f64], v: &[f64], change: &[f64], momentum: &[f64]) {
        for (pin, account) in self.pins.iter_mut().enumerate() {
            let (at, body) = (layout.pin_at(pin), layout.body_at(layout.pins[pin].body));
            let impulse = -vector(&momentum[at..]);
            let mean = vector(&v[at..]) + 0.5 * vector(&change[at..]);
            account.impulse += impulse;
            account.work += impulse.dot(&mean);
            if layout.clamps[pin].is_some() {
                let angular = -vector(&q[at + 3..]).cross(&vector(&momentum[at + 3..]));
                account.angular_impulse += angular;
                account.work += angular.dot(&(vector(&v[body + 3..]) + 0.5 * vector(&change[body + 3..])));
            }
        }
        if self.momentum.is_active() {
            self.momentum.add_impact(layout, q, momentum);
        }
    }

    /// Integrates the accounts to a state whose accelerations are known; `rhs` is a buffer.
    pub fn integrate_to(&mut self, equations: &mut IslandEquations<'_, '_>, state: &State, rhs: &mut [f64]) {
        if self.pins.is_empty() {
            return;
        }
        let (q, v) = (&state.q, &state.v);
        let at = ForceInput { time: state.time, scale: 1.0, q, v, dv_dq: 0.0 };
        equations.cable_rows(&at, &state.memory.acceleration, rhs);
        let half = match self.until {
            Some(before) => 0.5 * (state.time - before),
            None => 0.0,
        };
        let layout = equations.layout;
        if self.momentum.is_active() {
            self.momentum.read(layout, state, |force, momentum| {
                equations.multiply_mass(&state.memory.acceleration, force);
                force.iter_mut().zip(&*rhs).for_each(|(force, row)| *force += row);
                equations.multiply_mass(v, momentum);
            });
            if half > 0.0 {
                self.momentum.end_step(layout, 2.0 * half);
            }
        }
        for (pin, account) in self.pins.iter_mut().enumerate() {
            let at = layout.pin_at(pin);
            let (motion, rho) = layout.lever(pin, q, v);
            let force = vector(&rhs[at..]);
            let clamped = layout.clamps[pin].is_some();
            let moment = if clamped { vector(&q[at + 3..]).cross(&vector(&rhs[at + 3..])) } else { Vector3::zeros() };
            let power = force.dot(&(motion.velocity + motion.spin.cross(&rho))) + moment.dot(&motion.spin);
            // that of a driven pin is in the momentum
            if !layout.bodies[layout.pins[pin].body].is_driven() {
                account.impulse += (account.force + force) * half;
                self.changes[pin] += (force - account.force).norm() * half;
            }
            account.angular_impulse += (account.moment + moment) * half;
            account.work += (account.power + power) * half;
            account.force = force;
            account.moment = moment;
            account.power = power;
        }
        self.until = Some(state.time);
    }
}
