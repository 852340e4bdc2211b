//! Forces between a cable and what holds it.
//!
//! # Equation
//!
//! ```text
//! f = M q'' - F on the position        m = t x (M q'' - F) of the slope t
//! ```

use super::Cable;
use crate::effect::acts::ForceInput;
use crate::error::Error;
use crate::integrate::Dynamics;
use crate::system::Buffers;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Force and moment of a support on the cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Reaction {
    /// Node number.
    pub node: usize,
    /// Force on the cable in N.
    pub force: Vector3<f64>,
    /// Moment on the cable in N m.
    pub moment: Vector3<f64>,
}

impl Cable {
    /// Returns the reactions of all supports at the present state, by ascending node: force and
    /// moment of the support on the cable.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the present state has no finite acceleration.
    pub fn reactions(&mut self) -> Result<Vec<Reaction>, Error> {
        let mut reactions = self.with_torsion(Cable::reactions_of_forces)?;
        if self.model.effects.torsion.is_some() {
            reactions.iter_mut().for_each(|reaction| reaction.moment -= self.torsion_moment(reaction.node));
        }
        Ok(reactions)
    }

    fn reactions_of_forces(&mut self) -> Result<Vec<Reaction>, Error> {
        let n = self.positions().len();
        self.refresh_memory();
        let mut acceleration = self.snapshot.state.memory.acceleration.clone();
        if !self.snapshot.state.memory.valid {
            acceleration.resize(n, 0.0);
            let outcome = self.with_workspace(|cable| {
                let (mut dynamics, state) = cable.dynamics();
                dynamics.acceleration(state.time, &state.q, &state.v, &mut acceleration)
            });
            outcome.map_err(|failure| self.step_failed(self.time(), 0.0, failure))?;
        }
        let mut residual = vec![0.0; n];
        let mut inertia = vec![0.0; n];
        let (mut equations, state) = self.equations();
        equations
            .force(ForceInput { time: state.time, q: &state.q, v: &state.v, dv_dq: 0.0, scale: -1.0 }, &mut residual);
        equations.system.mass.multiply(equations.system.level, &acceleration, &mut inertia);
        let vector = |x: &[f64], y: &[f64]| Vector3::new(x[0] + y[0], x[1] + y[1], x[2] + y[2]);
        let reaction = |&(node, _): &(usize, _)| {
            let i = 6 * node;
            let slope = Vector3::from_column_slice(&state.q[i + 3..i + 6]);
            Reaction {
                node,
                force: vector(&residual[i..i + 3], &inertia[i..i + 3]),
                moment: slope.cross(&vector(&residual[i + 3..i + 6], &inertia[i + 3..i + 6])),
            }
        };
        Ok(equations.model.supports.iter().map(reaction).collect())
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn pull(&mut self, node: usize) -> (Vector3<f64>, Vector3<f64>) {
        let (force, moment) = self.with_torsion(|cable| cable.with_workspace(|cable| cable.pull_in_workspace(node)));
        if self.model.effects.torsion.is_none() {
            return (force, moment);
        }
        (force, moment + self.torsion_moment(node))
    }

    fn pull_in_workspace(&mut self, node: usize) -> (Vector3<f64>, Vector3<f64>) {
        self.refresh_memory();
        let (dynamics, state) = self.dynamics();
        let (mut equations, Buffers { rhs, product, .. }) = (dynamics.equations, dynamics.buffers);
        equations.force(ForceInput { time: state.time, q: &state.q, v: &state.v, dv_dq: 0.0, scale: 1.0 }, rhs);
        if state.memory.valid {
            equations.system.mass.multiply(equations.system.level, &state.memory.acceleration, product);
            rhs.iter_mut().zip(product.iter()).for_each(|(r, m)| *r -= m);
        } else if !state.memory.differences.is_empty() && state.memory.differences.step > 0.0 {
            // the discrete gradient knows the mean ones of its last step
            let differences = &state.memory.differences;
            equations.system.mass.multiply(equations.system.level, &differences.velocity, product);
            rhs.iter_mut().zip(product.iter()).for_each(|(r, m)| *r -= m / differences.step);
        }
        let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);
        let (force, slope) = (vector(&rhs[6 * node..]), vector(&rhs[6 * node + 3..]));
        (force, vector(&state.q[6 * node + 3..]).cross(&slope))
    }
}
