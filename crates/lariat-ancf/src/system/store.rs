//! The energy that the [discrete gradient](crate::integrate::discrete_gradient) holds between steps.
//!
//! # Equation
//!
//! ```text
//! S = a/2 (|D v|^2 + |D y|^2 + |D d|^2)
//! ```
//!
//! of the last step; its energy law is about the sum of mechanical energy and S.

use super::lanes::discrete_gradient::CoordinateStep;
use crate::cable::Cable;
use crate::integrate::discrete_gradient::ALPHA;

impl Cable {
    /// Returns the energy in J that the method `discrete-gradient` holds beyond the mechanical energy: S of the last step. Its law is about
    /// the sum of both.
    pub fn energy_in_store(&self) -> f64 {
        let (q, differences) = (self.positions(), &self.snapshot().state.memory.differences);
        if differences.is_empty() {
            return 0.0;
        }
        let still = vec![0.0; q.len()];
        let mut buffer = still.clone();
        let mut before = differences.displacement.clone();
        self.system.flows.shift_eyes_before(q, &mut before);
        let step = CoordinateStep {
            start: q,
            change: &still,
            before: &before,
            kept: 1.0,
            linearised: &[],
            h: 1.0,
            near: false,
        };
        let elastic =
            self.system.forces.elements.add_discrete_gradient(self.system.level, None, step, &mut buffer).numerical;
        elastic + 0.5 * ALPHA * self.system.mass_square(&differences.velocity, &mut buffer)
    }
}
