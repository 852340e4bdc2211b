//! The forces of cables on bodies at one instant.
//!
//! # Equation
//!
//! ```text
//! M q'' = F(q, v)  with q'' of the pinned rows from the bodies      f = F_r - (M q'')_r      m = t x (F_t - (M q'')_t)
//! ```
//!
//! # Validity
//!
//! For forces that are functions of positions and velocities: the impulses of contacts and the
//! rates of reels are known only over steps. What the steps do not resolve, as the tension of waves
//! that pass within one, is in the state as the integrator left it.
//!
//! # References
//!
//! The residual of a held row is its reaction.
//!
//! # Alternatives
//!
//! The mean over the last step, [`PinAccount::impulse`] by its length.

use super::body::RigidBody;
use super::dynamics::IslandDynamics;
use super::equations::IslandEquations;
use super::hold::vector;
use super::pin::{PinConstraint, check};
use super::step::{Island, gather};
use crate::cable::Cable;
use crate::effect::acts::ForceInput;
use crate::error::{Error, StepFailure};
use crate::integrate::{Dynamics, ErrorNorm};
use nalgebra::Vector3;

impl Island {
    /// Returns force (N) and moment about the anchor (N m; zero at a ball) of each pin on its body
    /// at the present state, for driven bodies that accelerate by `accelerations`, linear (m/s^2)
    /// and angular (rad/s^2). Changes nothing.
    ///
    /// # Errors
    /// As [`step`](Self::step), of which it takes the arguments.
    pub fn forces_now(
        &mut self,
        cables: &mut [&mut Cable],
        bodies: &[RigidBody],
        pins: &[PinConstraint],
        accelerations: &[[Vector3<f64>; 2]],
    ) -> Result<Vec<[Vector3<f64>; 2]>, Error> {
        check(cables, bodies, pins)?;
        let mut bodies = bodies.to_vec();
        for (body, acceleration) in bodies.iter_mut().zip(accelerations) {
            // the cubic of a step of 1 s that begins at the present velocity with this acceleration
            body.unsteadiness = [[Vector3::zeros(); 2], acceleration.map(|a| -0.5 * a)];
        }
        cables.iter_mut().for_each(|cable| cable.take_workspace());
        let forces = self.forces_in_workspaces(cables, &bodies, pins);
        cables.iter_mut().rev().for_each(|cable| cable.return_workspace());
        forces.map_err(|failure| cables[0].step_failed(cables[0].time(), 0.0, failure))
    }

    fn forces_in_workspaces(
        &mut self,
        cables: &mut [&mut Cable],
        bodies: &[RigidBody],
        pins: &[PinConstraint],
    ) -> Result<Vec<[Vector3<f64>; 2]>, StepFailure> {
        let Island { layout, matrices, accounts, vectors, state, .. } = self;
        layout.begin(cables, bodies, pins, 1.0);
        matrices.begin(layout);
        vectors.resize(layout.size());
        gather(cables, bodies, state);
        let mut acceleration = vec![0.0; layout.size()];
        let equations = IslandEquations { cables, layout, matrices };
        let mut system = IslandDynamics { equations, accounts, norm: ErrorNorm::Every, vectors };
        system.prescribe(state.time, &mut state.q, &mut state.v);
        let (time, q, v) = (state.time, &state.q, &state.v);
        system.acceleration(time, q, v, &mut acceleration)?;
        let mut rows = vec![0.0; q.len()];
        let at = ForceInput { time, scale: 1.0, q, v, dv_dq: 0.0 };
        system.equations.cable_rows(&at, &acceleration, &mut rows);
        let layout = system.equations.layout;
        let of_pin = |pin: usize| {
            let at = layout.pin_at(pin);
            let moment = vector(&q[at + 3..]).cross(&vector(&rows[at + 3..]));
            [vector(&rows[at..]), if layout.clamps[pin].is_some() { moment } else { Vector3::zeros() }]
        };
        Ok((0..pins.len()).map(of_pin).collect())
    }
}
