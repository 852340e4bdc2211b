//! Solving with what [torsion](super::torsion) adds to a factored step matrix, of a cable by
//! itself.
//!
//! # Equation
//!
//! That of [`rank`](crate::effect::torsion::rank); the columns are those of the segments.

use super::torsion::TorsionForces;
use super::{Equations, dot, project_vector};
use crate::error::StepFailure;
use crate::linalg::Definiteness;

impl Equations<'_> {
    /// Adds torsion to the factored step matrix; returns what that makes of a kind.
    pub(super) fn factor_torsion(&mut self, kind: Definiteness) -> Result<Definiteness, StepFailure> {
        let Some(mut torsion) = self.system.torsion_forces.take_if(|torsion| !torsion.is_empty() && !torsion.in_island)
        else {
            return Ok(kind);
        };
        for own in &mut torsion.segments {
            own.factored.clone_from(&own.gradient);
            own.column.clear();
            own.column.resize(6 * self.model.nodes(), 0.0);
            own.column[own.segment.range()].copy_from_slice(&own.gradient);
            project_vector(self.model, &mut own.column);
            self.diagnostics.solves += 1;
            self.system.step.factorisation.solve(self.system.level, &mut own.column);
        }
        let TorsionForces { segments, scale, rank, .. } = &mut *torsion;
        let product = |s: usize, t: usize| dot(&segments[s].factored, &segments[t].column[segments[s].segment.range()]);
        let outcome = rank.factor(segments.len(), |s| *scale * segments[s].segment.stiffness, product);
        let removed = rank.negative();
        self.system.torsion_forces = Some(torsion);
        outcome?;
        Ok(match kind {
            Definiteness::Indefinite { negative: Some(count) } if count == removed => Definiteness::PositiveDefinite,
            Definiteness::Indefinite { negative: Some(count) } => {
                Definiteness::Indefinite { negative: count.checked_sub(removed) }
            }
            kind => kind,
        })
    }

    /// Completes a solution with the step matrix by torsion.
    pub(super) fn complete_by_torsion(&mut self, x: &mut [f64]) {
        let Some(torsion) = &mut self.system.torsion_forces else { return };
        let TorsionForces { segments, rank, .. } = &mut **torsion;
        if segments.is_empty() {
            return;
        }
        let product = |s: usize| dot(&segments[s].factored, &x[segments[s].segment.range()]);
        let forces = rank.forces(segments.len(), product);
        for (own, force) in segments.iter().zip(forces) {
            x.iter_mut().zip(&own.column).for_each(|(x, y)| *x -= force * y);
        }
    }
}
