//! Spurious energy of a step of an island: the gain of cables and bodies beyond the work of the
//! forces on the bodies.
//!
//! # Equation
//!
//! ```text
//! rotation   T1 - T0 = 1/2 (w0 + w1) . I (w1 - w0)
//! work       f . (x1 - x0) + h tau . (w0 + w1)/2
//! ```
//!
//! The gyroscopic torque w x I w has no power, whether an engine applies it or not.
//!
//! # Validity
//!
//! No result where a driven body moves, a gap closes fast, a clamp rotates a slope into place, or a
//! cable does not know the work of its loads.

use super::equations::IslandEquations;
use super::hold::{stack, vector};
use super::layout::Motion;
use crate::effect::acts::ForceInput;
use crate::scales::island::{FAST_CLOSING, SLOW_CLOSING};
use crate::state::State;
use nalgebra::Vector3;

/// Returns the spurious energy between two states in J, and the kinetic and strain energy to
/// compare it with; `None` where it is not known. `rhs` is a buffer.
pub(super) fn spurious_energy(
    equations: &mut IslandEquations<'_, '_>,
    before: &State,
    after: &State,
    h: f64,
    rhs: &mut [f64],
) -> Option<(f64, f64)> {
    let layout = equations.layout;
    if layout.clamp_rotates() {
        return None;
    }
    if layout.bodies.iter().any(|body| body.is_driven() && body.moves()) {
        return None;
    }
    let closing = |pin: usize, time: f64| layout.gap(pin, time).1;
    let fastest = (0..layout.pins.len())
        .map(|pin| closing(pin, before.time).norm().max(closing(pin, after.time).norm()))
        .fold(0.0, f64::max);
    if fastest > FAST_CLOSING {
        return None;
    }
    let mut energy = if fastest > SLOW_CLOSING { work_on_gaps(equations, before, after, h, rhs) } else { 0.0 };
    let mut scale = [0.0; 2];
    for (cable, part) in equations.cables.iter_mut().zip(&layout.parts) {
        let of_cable = cable.equations().0.energy_between(before, after, h, part.range())?;
        energy += of_cable.spurious;
        scale[0] += of_cable.before;
        scale[1] += of_cable.after;
    }
    for (i, body) in layout.bodies.iter().enumerate() {
        let at = layout.body_at(i);
        let [start, end] = [before, after].map(|s| layout.motion(i, &s.q[at..at + 6], &s.v[at..at + 6]));
        if body.is_driven() {
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
        energy += gained - body.force.dot(&(end.position - start.position)) - h * body.torque.dot(&mean);
        scale[0] += kinetic(&start);
        scale[1] += kinetic(&end);
    }
    if !layout.coupled.is_empty() {
        for (at, state, sign) in [(0, before, -0.5), (1, after, 0.5)] {
            let coupled = layout.coupled_energy(|i| {
                let at = layout.body_at(i);
                let motion = layout.motion(i, &state.q[at..at + 6], &state.v[at..at + 6]);
                stack(&motion.velocity, &motion.spin)
            });
            energy += sign * coupled;
            scale[at] += 0.5 * coupled;
        }
    }
    Some((energy, scale[0].max(scale[1])))
}

/// Returns the work of the cables on their pins against the remaining gaps in J, by the trapezoidal
/// rule: energy that a cable loses as it pulls its gap shut.
fn work_on_gaps(
    equations: &mut IslandEquations<'_, '_>,
    before: &State,
    after: &State,
    h: f64,
    rhs: &mut [f64],
) -> f64 {
    let layout = equations.layout;
    let mut work = 0.0;
    for state in [before, after] {
        let at = ForceInput { time: state.time, scale: 1.0, q: &state.q, v: &state.v, dv_dq: 0.0 };
        equations.cable_rows(&at, &state.memory.acceleration, rhs);
        for pin in 0..layout.pins.len() {
            work += 0.5 * h * vector(&rhs[layout.pin_at(pin)..]).dot(&layout.gap(pin, state.time).1);
        }
    }
    work
}
