//! What a linear solve misses of the axial forces of an island, as of a cable alone (system/correction.rs). Pinned nodes have followed their
//! bodies by then.

use super::IslandStep;
use crate::cable::Cable;
use crate::error::StepFailure;
use crate::integrate::discrete_gradient::FORCE_TOLERANCE;
use crate::system::{CableStep, contracts, dot};

impl IslandStep<'_, '_> {
    /// Takes away what the last solve missed; it was the first of the step, with a fresh matrix, as `solve` says.
    pub(super) fn correct(&mut self, solve: (bool, bool)) -> Result<(), StepFailure> {
        let may_correct = |cable: &mut &mut Cable| {
            let CableStep { equations, buffers, .. } = cable.step_parts();
            equations.may_correct(buffers)
        };
        if !self.buffers.pairs.is_empty() || !self.cables.iter_mut().all(may_correct) {
            return Ok(());
        }
        let square = self.square();
        let mut missed = 0.0;
        let mut impulse = self.buffers.bodies.iter().map(|body| body.impulse()).sum::<f64>();
        for cable in self.cables.iter_mut() {
            let CableStep { equations, state, buffers } = cable.step_parts();
            missed += equations.find_remainder(state, buffers, solve);
            impulse += buffers.impulse;
        }
        if missed <= FORCE_TOLERANCE * impulse {
            return Ok(());
        }
        let (rows, own) = (&mut self.buffers.rows, &mut self.buffers.cables);
        rows.fill(0.0);
        for (cable, own) in self.cables.iter_mut().zip(own) {
            own.pass_impulses(&cable.step_buffers.rhs, rows);
        }
        self.solve_apart();
        let correction = self.square();
        if contracts(correction, square) || !correction.is_finite() {
            self.apply(1.0)?;
            self.follow();
        }
        Ok(())
    }

    /// Returns the square of the increment of the cables.
    fn square(&self) -> f64 {
        self.cables.iter().map(|cable| dot(&cable.step_buffers.rhs, &cable.step_buffers.rhs)).sum()
    }
}
