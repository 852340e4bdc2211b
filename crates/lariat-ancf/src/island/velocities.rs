//! Matching the velocities of pinned nodes and their bodies at the beginning of a host step.
//!
//! # Equation
//!
//! ```text
//! M dv = M J
//! ```
//!
//! dv is the change of all velocities, J the velocity of the pinned nodes relative to their bodies.
//! The impulses P on the pinned nodes lose the energy `-sum P . J / 2`: their work is that along
//! the mean of the relative velocities before, J, and after, none.
//!
//! An inelastic impact: cable and body exchange the impulse that makes them move together, so that
//! momentum is conserved when an engine, a user or a collision has changed a body's velocity.

use super::dynamics::IslandDynamics;
use super::equations::MatrixKind;
use super::hold::vector;
use crate::error::StepFailure;
use crate::integrate::Dynamics;
use crate::scales::island::JUMP_ROUNDING;
use crate::state::State;

impl IslandDynamics<'_, '_> {
    /// Gives pinned nodes the velocity of their bodies, by an inelastic impact.
    pub(super) fn match_velocities(&mut self, state: &mut State) -> Result<(), StepFailure> {
        self.vectors.jump.copy_from_slice(&state.v);
        self.place(state);
        let State { time, q, v, memory } = state;
        let layout = self.equations.layout;
        let jump = &mut self.vectors.jump;
        for (jump, v) in jump.iter_mut().zip(v.iter()) {
            *jump -= v;
        }
        let mut largest = 0.0f64;
        for part in &layout.parts {
            // held coordinates alone have one
            let mut end = part.at;
            for hold in &part.holds {
                jump[end..hold.at].fill(0.0);
                end = hold.at + 3;
                largest = largest.max(vector(&jump[hold.at..]).norm());
            }
            jump[end..part.at + part.size].fill(0.0);
        }
        if largest > JUMP_ROUNDING {
            memory.valid = false;
            self.share_jump(q, v)?;
        }
        layout.follow(*time, q, v);
        Ok(())
    }

    /// Shares the momentum of the jump among cables and bodies.
    fn share_jump(&mut self, q: &[f64], v: &mut [f64]) -> Result<(), StepFailure> {
        let Self { equations, accounts, vectors, .. } = self;
        let super::dynamics::Vectors { rhs, z, velocity, jump, .. } = &mut **vectors;
        equations.factor_mass(q, v)?;
        rhs.fill(0.0);
        equations.multiply_mass(jump, rhs);
        equations.layout.pass_pinned_rows(q, rhs);
        equations.solve(MatrixKind::Mass, q, rhs);
        for part in &equations.layout.parts {
            for i in part.range() {
                z[i] = rhs[i] - jump[i];
            }
        }
        equations.multiply_mass(z, velocity);
        accounts.add_impact(equations.layout, q, v, rhs, velocity);
        // what sets driven nodes in motion, or stops them, is work of the bodies that drive them;
        // others lose it
        let layout = equations.layout;
        for (pin, of) in layout.pins.iter().enumerate() {
            let at = layout.pin_at(pin);
            let rows = if layout.clamps[pin].is_some() { at..at + 6 } else { at..at + 3 };
            let law = &mut equations.cables[of.cable].equations().0.system.meter.law;
            if layout.bodies[of.body].is_driven() {
                law.supports += rows.map(|i| velocity[i] * (v[i] + 0.5 * (jump[i] + rhs[i]))).sum::<f64>();
            } else {
                law.impacts -= 0.5 * rows.map(|i| velocity[i] * jump[i]).sum::<f64>();
            }
        }
        // the chart is at its origin: rates of the rotation vector are angular velocities
        for (v, change) in v.iter_mut().zip(rhs.iter()) {
            *v += change;
        }
        Ok(())
    }
}
