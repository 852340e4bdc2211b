//! Energy that a step of an island makes: what cables and bodies gain beyond the work of the forces on the bodies.
//!
//! ```text
//! rotation   T1 - T0 = 1/2 (w0 + w1) . I (w1 - w0)       (w x I w has no power, whether an engine knows it or not)
//! work       f . (x1 - x0) + h tau . (w0 + w1)/2
//! ```

use super::body::RigidBody;
use super::system::Work;
use super::workspace::{Motion, vector};
use crate::effect::acts::VelocityInput;
use crate::integrate::State;
use nalgebra::Vector3;

/// Speed in m/s with which a gap may close without its work being asked for.
const CLOSING: f64 = 1e-6;
/// Speed in m/s above which the work of a closing gap is not known well enough.
const FAST_CLOSING: f64 = 1e-2;

impl Work<'_, '_> {
    /// Energy made between two phases in J, and the energy to measure it by; none where bodies are driven or gaps close.
    pub(super) fn energy_between(&mut self, before: &State, after: &State, h: f64) -> Option<(f64, f64)> {
        let moves = |body: &RigidBody| body.velocity != Vector3::zeros() || body.angular_velocity != Vector3::zeros();
        let driven = |body: &RigidBody| body.free == [false; 6] && moves(body);
        if self.workspace.bodies.iter().any(driven) {
            return None;
        }
        let closing = |pin: usize, time: f64| self.workspace.gap(pin, time).1;
        let fastest = (0..self.pins.len())
            .map(|pin| closing(pin, before.time).norm().max(closing(pin, after.time).norm()))
            .fold(0.0, f64::max);
        if fastest > FAST_CLOSING {
            return None;
        }
        let mut made = if fastest > CLOSING { self.work_on_gaps(before, after, h) } else { 0.0 };
        let mut scale = [0.0; 2];
        for c in 0..self.cables.len() {
            let (mut equations, part) = self.equations(c);
            let of_cable = equations.energy_between(before, after, h, part.at..part.at + part.size)?;
            made += of_cable.spurious;
            scale[0] += of_cable.before;
            scale[1] += of_cable.after;
        }
        for i in 0..self.bodies.len() {
            let at = self.body_at(i);
            let [start, end] = [before, after].map(|p| self.workspace.motion(i, &p.q[at..at + 6], &p.v[at..at + 6]));
            let body = &self.workspace.bodies[i];
            if body.free == [false; 6] {
                continue;
            }
            let mean = 0.5 * (start.spin + end.spin);
            let inertia = body.world_inertia(&end.rotation);
            let carried = |a: &Motion, velocity: &Vector3<f64>, spin: &Vector3<f64>| {
                body.carried_momentum(&a.velocity, &a.spin).map_or(0.0, |(p, l)| p.dot(velocity) + l.dot(spin))
            };
            let kinetic = |m: &Motion| {
                let own = body.mass * m.velocity.norm_squared() + m.spin.dot(&(inertia * m.spin));
                0.5 * (own + carried(m, &m.velocity, &m.spin))
            };
            let gained = 0.5 * body.mass * (end.velocity.norm_squared() - start.velocity.norm_squared())
                + mean.dot(&(inertia * (end.spin - start.spin)))
                + 0.5 * (carried(&end, &end.velocity, &end.spin) - carried(&start, &start.velocity, &start.spin));
            made += gained - body.force.dot(&(end.position - start.position)) - h * body.torque.dot(&mean);
            scale[0] += kinetic(&start);
            scale[1] += kinetic(&end);
        }
        Some((made, scale[0].max(scale[1])))
    }

    /// Work of the cables on their pins against what is left of gaps, by the trapezoidal rule, in J: energy that is not made, but lost where
    /// a cable pulls its gap shut.
    fn work_on_gaps(&mut self, before: &State, after: &State, h: f64) -> f64 {
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        let mut work = 0.0;
        for phase in [before, after] {
            let rates = VelocityInput { v: &phase.v, dv_dq: 0.0 };
            let (time, k) = (phase.time, &phase.memory.acceleration);
            // without a matrix nothing is factored, and nothing can fail
            let rows = self.cable_rows(time, 1.0, &phase.q, rates, k, &mut rhs, false);
            debug_assert!(rows.is_ok());
            for pin in 0..self.pins.len() {
                work += 0.5 * h * vector(&rhs[self.pin_at(pin)..]).dot(&self.workspace.gap(pin, time).1);
            }
        }
        self.workspace.rhs = rhs;
        work
    }
}
