//! A cable alone that touches itself, in a step of the discrete gradient.

use super::Equations;
use crate::contact::{ContactBalance, LowRank, PairStep, PairSystem, Row, Strand, Strands};
use crate::effect::EffectWork;
use crate::error::StepFailure;
use crate::state::State;
use crate::system::StepVectors;

/// The equations with the factored matrix of a cable.
struct OnCable<'a, 'b> {
    equations: &'a mut Equations<'b>,
    x: &'a mut [f64],
    saved: &'a mut [f64],
}

impl PairSystem for OnCable<'_, '_> {
    fn clear(&mut self) {
        self.x.fill(0.0);
    }

    fn add(&mut self, row: &Row, scale: f64) {
        for (_, element, part) in row {
            self.x[6 * element..6 * element + 12].iter_mut().zip(part).for_each(|(x, part)| *x += scale * part);
        }
    }

    fn solve(&mut self) {
        self.equations.solve(self.x);
    }

    fn read(&self, row: &Row) -> f64 {
        row.iter().flat_map(|(_, e, part)| self.x[6 * e..6 * e + 12].iter().zip(part)).map(|(x, part)| x * part).sum()
    }

    fn save(&mut self) {
        self.saved.copy_from_slice(self.x);
    }

    fn subtract(&mut self) {
        self.x.iter_mut().zip(&*self.saved).for_each(|(x, saved)| *x = saved - *x);
    }
}

impl<'b> Equations<'b> {
    /// Calls `f` with the contacts of the cable with itself, and the cable.
    fn with_pairs<T>(
        &self,
        state: &State,
        b: &mut StepVectors,
        f: impl FnOnce(&mut PairStep, &Strands<'_, '_>) -> T,
    ) -> T {
        let (model, StepVectors { pairs, change, .. }) = (self.model, b);
        let strand = Strand { key: model.contact_key, model, q: &state.q, change, memory: &state.memory.pairs };
        f(pairs, &Strands { count: 1, get: &|_| strand, over_bodies: &|_, _| f64::INFINITY, pairs: None })
    }

    /// Finds the contacts of a step of the cable with itself.
    pub fn find_pairs(&self, state: &State, b: &mut StepVectors, close: bool) {
        let h = b.h;
        self.with_pairs(state, b, |pairs, strands| pairs.begin(h, close, strands));
    }

    /// Makes them linear.
    pub fn linearise_pairs(&mut self, state: &State, b: &mut StepVectors) {
        b.pair_impulses.clear();
        if !b.pairs.is_empty() {
            self.diagnostics.effects.contact += b.pairs.count();
            self.with_pairs(state, b, PairStep::linearise);
            pass(b, true);
        }
    }

    /// Factors what they add to the matrix.
    ///
    /// # Errors
    /// If it is singular.
    pub fn factor_pairs(&mut self, b: &mut StepVectors) -> Result<(), StepFailure> {
        let StepVectors { pairs, product, external, .. } = b;
        pairs.low_rank.factor(&mut OnCable { equations: self, x: product, saved: external })
    }

    /// Solves in place, with them; `buffer` is of the same size.
    pub fn solve_with_pairs(&mut self, low_rank: &mut LowRank, x: &mut [f64], buffer: &mut [f64]) {
        self.solve(x);
        low_rank.complete(&mut OnCable { equations: self, x, saved: buffer });
    }

    /// Returns whether the centre line goes through itself in the step.
    pub fn do_pairs_cross(&self, state: &State, b: &mut StepVectors) -> bool {
        self.with_pairs(state, b, PairStep::crosses)
    }

    /// Evaluates them at the present iterate, and returns what they do, if any are near.
    pub fn balance_pairs(
        &mut self,
        state: &State,
        b: &mut StepVectors,
        work: &mut EffectWork,
    ) -> Option<ContactBalance> {
        self.with_pairs(state, b, PairStep::complete);
        b.pair_impulses.clear();
        if b.pairs.is_empty() {
            return None;
        }
        self.diagnostics.effects.contact += b.pairs.count();
        let contacts = self.with_pairs(state, b, PairStep::balance);
        pass(b, false);
        work.contact += contacts.work;
        Some(contacts)
    }
}

/// Passes their impulses to the residual.
fn pass(b: &mut StepVectors, linear: bool) {
    let StepVectors { pairs, pair_impulses, change, .. } = b;
    pair_impulses.resize(change.len(), 0.0);
    pairs.pass_impulses(linear, |_, element, impulse| {
        let out = &mut pair_impulses[6 * element..6 * element + 12];
        out.iter_mut().zip(impulse).for_each(|(out, impulse)| *out += impulse);
    });
}
