//! Unknown rates of reels in an iteration of one cable.

use super::{Equations, Unknowns};
use crate::state::State;
use crate::system::StepVectors;

/// Linearises the laws of reels whose rate is unknown, and solves for their columns.
pub(super) fn linearise_laws(equations: &mut Equations<'_>, state: &State, b: &mut StepVectors) {
    let mut unknowns = core::mem::take(&mut b.unknowns);
    unknowns.begin([&equations.system.flows].into_iter());
    if !unknowns.reels.is_empty() {
        equations.read_motors(state, b);
    }
    let Unknowns { reels, columns, .. } = &mut unknowns;
    for (&(_, k), columns) in reels.iter().zip(columns) {
        equations.linearise_law(k, state, b, &mut columns[0]);
        equations.solve_with_pairs(&mut b.pairs.low_rank, &mut columns[0], &mut b.product);
    }
    b.unknowns = unknowns;
}

/// Solves for the rates of reels that are unknown, and completes the increment in `rhs`.
pub(super) fn add_to_laws(equations: &mut Equations<'_>, b: &mut StepVectors) {
    let StepVectors { unknowns, rhs, h, .. } = b;
    if unknowns.reels.is_empty() {
        return;
    }
    unknowns.solve(|_| &equations.system.flows, |_| rhs, (&[], *h));
    for ((&(_, k), columns), &increment) in unknowns.reels.iter().zip(&unknowns.columns).zip(&unknowns.increments) {
        equations.add_to_law(k, increment);
        rhs.iter_mut().zip(&columns[0]).for_each(|(x, y)| *x -= increment * y);
    }
}
