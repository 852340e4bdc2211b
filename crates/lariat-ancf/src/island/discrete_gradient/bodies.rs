//! Rigid bodies as a term of a step. Equations: [`body`](super::body).

use super::body::BodyStep;
use super::coupled::{add_coupled_energies, complete_rows};
use super::{IslandStep, StepBuffers};
use crate::term::{Balance, StepStart, StepTerm};

/// The bodies, with the inertia that couples them.
pub(super) struct Bodies;

impl StepTerm<IslandStep<'_, '_>> for Bodies {
    fn name(names: &mut Vec<&'static str>) {
        names.push("bodies");
    }

    fn begin(island: &mut IslandStep<'_, '_>, step: &StepStart) {
        island.buffers.bodies.iter_mut().for_each(|body| body.predict(step.h, step.leg));
    }

    fn balance(island: &mut IslandStep<'_, '_>, balance: &mut Balance) {
        let StepBuffers { bodies, coupled, rows, .. } = &mut *island.buffers;
        complete_rows(bodies, coupled, rows);
        add_coupled_energies(bodies, coupled, island.cables[0].step_buffers.leg, balance);
        for (body, row) in bodies.iter().zip(rows.chunks_exact_mut(6)) {
            body.add_balance(row, balance);
        }
    }

    fn accept(island: &mut IslandStep<'_, '_>) {
        island.buffers.bodies.iter_mut().for_each(BodyStep::accept);
    }
}
