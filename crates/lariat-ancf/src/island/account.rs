//! What passes through the pins of an island over a step.
//!
//! ```text
//! f = F_r - (M q'')_r      m = t x (F_t - (M q'')_t)      impulse = int f dt      work = int f.v + m.omega dt
//! ```
//!
//! f and m are force and moment of the cable on the body at the anchor, read from the cable's residual at the pinned rows after
//! every step of the integrator; integrals by the trapezoidal rule over these steps. *Source.* Virtual work; the residual of a held
//! row is its reaction.

use super::system::Work;
use super::workspace::vector;
use crate::effect::acts::VelocityInput;
use crate::integrate::State;
use nalgebra::Vector3;

/// What the cable did to the body at one pin during the last step. World axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PinAccount {
    /// Force at the end of the step in N.
    pub force: Vector3<f64>,
    /// Moment about the anchor at the end of the step in N m; zero at a ball.
    pub moment: Vector3<f64>,
    /// Impulse over the step in N s.
    pub impulse: Vector3<f64>,
    /// Angular impulse about the anchor over the step in N m s.
    pub angular_impulse: Vector3<f64>,
    /// Work over the step in J.
    pub work: f64,
    power: f64,
}

impl Work<'_, '_> {
    /// Adds what bodies and cables passed to each other when pinned nodes, `jump` (m/s) faster than their bodies, met them: `change` is
    /// that of all velocities. The work is that on the body; what a cable lost beyond it is heat.
    pub(super) fn account_jump(&mut self, jump: &[f64], q: &[f64], v: &[f64], change: &[f64]) {
        let mut gained = core::mem::take(&mut self.workspace.z);
        let mut momentum = core::mem::take(&mut self.workspace.velocity);
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            let range = part.at..part.at + part.size;
            for i in range.clone() {
                gained[i] = change[i] - jump[i];
            }
            cable.system.mass.multiply(cable.system.level, &gained[range.clone()], &mut momentum[range]);
        }
        for pin in 0..self.pins.len() {
            let (at, body) = (self.pin_at(pin), self.body_at(self.pins[pin].body));
            let impulse = -vector(&momentum[at..]);
            let mean = vector(&v[at..]) + 0.5 * vector(&change[at..]);
            let account = &mut self.workspace.accounts[pin];
            account.impulse += impulse;
            account.work += impulse.dot(&mean);
            if self.workspace.clamps[pin].is_some() {
                let turn = -vector(&q[at + 3..]).cross(&vector(&momentum[at + 3..]));
                account.angular_impulse += turn;
                account.work += turn.dot(&(vector(&v[body + 3..]) + 0.5 * vector(&change[body + 3..])));
            }
        }
        self.workspace.z = gained;
        self.workspace.velocity = momentum;
    }

    /// Brings the accounts to a phase whose accelerations are known.
    pub(super) fn account(&mut self, phase: &State) {
        if self.pins.is_empty() {
            return;
        }
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        let (q, v) = (&phase.q, &phase.v);
        // without a matrix nothing is factored, and nothing can fail
        let rows = self.cable_rows(
            phase.time,
            1.0,
            q,
            VelocityInput { v, dv_dq: 0.0 },
            &phase.memory.acceleration,
            &mut rhs,
            false,
        );
        let half = match self.workspace.accounted {
            Some(before) => 0.5 * (phase.time - before),
            None => 0.0,
        };
        for pin in 0..self.pins.len() {
            let at = self.pin_at(pin);
            let (motion, rho) = self.lever(pin, q, v);
            let force = vector(&rhs[at..]);
            let clamped = self.workspace.clamps[pin].is_some();
            let moment = if clamped { vector(&q[at + 3..]).cross(&vector(&rhs[at + 3..])) } else { Vector3::zeros() };
            let power = force.dot(&(motion.velocity + motion.spin.cross(&rho))) + moment.dot(&motion.spin);
            let account = &mut self.workspace.accounts[pin];
            account.impulse += (account.force + force) * half;
            account.angular_impulse += (account.moment + moment) * half;
            account.work += (account.power + power) * half;
            account.force = force;
            account.moment = moment;
            account.power = power;
        }
        self.workspace.accounted = Some(phase.time);
        self.workspace.rhs = rhs;
        debug_assert!(rows.is_ok());
    }
}
