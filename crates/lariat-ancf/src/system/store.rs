//! The energy that the [discrete gradient](crate::integrate::discrete_gradient) holds between
//! steps.
//!
//! # Equation
//!
//! ```text
//! S = a/2 (|D v|^2 + |D y|^2 + |D d|^2)
//! ```
//!
//! of the last step; its energy law is about the sum of mechanical energy and S.

use super::System;
use super::lanes::discrete_gradient::CoordinateStep;
use crate::one_leg::OneLeg;
use crate::state::State;

impl System {
    /// Returns S of the last step in J, computed in these vectors.
    pub fn energy_in_store_by(&self, state: &State, [still, buffer, before]: &mut [Vec<f64>; 3]) -> f64 {
        let (q, differences) = (&state.q, &state.memory.differences);
        if differences.is_empty() {
            return 0.0;
        }
        for vector in [&mut *still, &mut *buffer] {
            vector.clear();
            vector.resize(q.len(), 0.0);
        }
        before.clone_from(&differences.displacement);
        self.feeds.shift_eyes_before(q, before);
        let step = CoordinateStep {
            start: q,
            change: still,
            before,
            kept: 1.0,
            linearised: &[],
            h: 1.0,
            leg: OneLeg::new(differences.dissipation),
            across: false,
        };
        let elastic = self.forces.elements.add_discrete_gradient(self.level, None, step, buffer).numerical;
        elastic + 0.5 * differences.dissipation * self.mass_square(&differences.velocity, buffer)
    }
}
