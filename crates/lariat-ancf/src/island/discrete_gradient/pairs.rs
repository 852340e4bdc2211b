//! Contacts between the cables of an island, in a step of the discrete gradient.

use super::super::hold::vector;
use super::super::layout::Layout;
use super::aside::Aside;
use super::{IslandStep, StepBuffers};
use crate::cable::Cable;
use crate::contact::{CablePair, ContactBalance, LowRank, PairStep, PairSystem, Row, Strand, Strands};
use crate::error::StepFailure;
use core::mem::{swap, take};

/// The equations of an island without these contacts.
struct OnIsland<'x, 'a, 'b> {
    island: &'x mut IslandStep<'a, 'b>,
    aside: &'x mut Aside,
}

impl OnIsland<'_, '_, '_> {
    fn exchange(&mut self) {
        let (cables, aside) = (&mut *self.island.cables, &mut *self.aside);
        cables.iter_mut().zip(&mut aside.cables).for_each(|(cable, own)| swap(&mut cable.step_buffers.rhs, own));
        swap(&mut self.island.buffers.rows, &mut aside.rows);
    }
}

impl PairSystem for OnIsland<'_, '_, '_> {
    fn clear(&mut self) {
        self.island.cables.iter_mut().for_each(|cable| cable.step_buffers.rhs.fill(0.0));
        self.island.buffers.rows.fill(0.0);
    }

    fn add(&mut self, row: &Row, scale: f64) {
        let IslandStep { cables, buffers, .. } = &mut *self.island;
        for (cable, element, part) in row {
            let range = 6 * element..6 * element + 12;
            cables[*cable].step_buffers.rhs[range.clone()]
                .iter_mut()
                .zip(part)
                .for_each(|(x, part)| *x += scale * part);
            for hold in buffers.cables[*cable].holds.iter().filter(|hold| range.contains(&hold.at)) {
                hold.pass(&(vector(&part[hold.at - range.start..]) * scale), &mut buffers.rows);
            }
        }
    }

    fn solve(&mut self) {
        self.island.solve_apart();
    }

    fn read(&self, row: &Row) -> f64 {
        let parts = row.iter().flat_map(|(cable, element, part)| {
            self.island.cables[*cable].step_buffers.rhs[6 * element..6 * element + 12].iter().zip(part)
        });
        parts.map(|(x, part)| x * part).sum()
    }

    fn save(&mut self) {
        let (cables, aside) = (&*self.island.cables, &mut *self.aside);
        aside.cables.iter_mut().zip(cables).for_each(|(own, cable)| own.clone_from(&cable.step_buffers.rhs));
        aside.rows.clone_from(&self.island.buffers.rows);
    }

    fn subtract(&mut self) {
        let (cables, aside) = (&mut *self.island.cables, &*self.aside);
        let own = cables.iter_mut().zip(&aside.cables).map(|(cable, own)| (&mut cable.step_buffers.rhs, own));
        for (x, saved) in own.chain([(&mut self.island.buffers.rows, &aside.rows)]) {
            x.iter_mut().zip(saved).for_each(|(x, saved)| *x = saved - *x);
        }
    }
}

/// Calls `f` with the cables as they are.
fn with_strands<T>(
    cables: &[&mut Cable],
    layout: &Layout,
    pairs: Option<&[CablePair]>,
    f: impl FnOnce(&Strands<'_, '_>) -> T,
) -> T {
    let get = |c: usize| {
        let Cable { model, snapshot, step_buffers, .. } = &*cables[c];
        let state = &snapshot.state;
        let key = if model.contact_key == 0 { c as u64 } else { model.contact_key };
        let passed = snapshot.passed_at_start();
        Strand { key, model, q: &state.q, change: &step_buffers.change, memory: &state.memory.pairs, passed }
    };
    let over_bodies = |strands: [usize; 2], arcs: [f64; 2]| {
        let on = |k: usize| {
            layout.pins.iter().filter(move |pin| pin.cable == strands[k]).map(move |pin| {
                let elements = &cables[pin.cable].model.elements[..pin.node];
                let at = elements.iter().map(|element| element.length).sum::<f64>();
                (pin, (at - arcs[k]).abs())
            })
        };
        let between = on(0).flat_map(|(pin, way)| {
            let same = on(1).filter(move |(other, _)| other.body == pin.body);
            same.map(move |(other, rest)| way + rest + (pin.anchor - other.anchor).norm())
        });
        between.fold(f64::INFINITY, f64::min)
    };
    f(&Strands { count: cables.len(), get: &get, over_bodies: &over_bodies, pairs })
}

impl IslandStep<'_, '_> {
    /// Calls `f` with the contacts and the cables.
    fn with_pairs<T>(&mut self, f: impl FnOnce(&mut PairStep, &Strands<'_, '_>) -> T) -> T {
        let StepBuffers { pairs, may_touch, .. } = &mut *self.buffers;
        with_strands(self.cables, self.layout, may_touch.as_deref(), |strands| f(pairs, strands))
    }

    /// Finds the contacts of a step of length `h` (s).
    pub(super) fn find_pairs(&mut self, h: f64, close: bool) {
        self.with_pairs(|pairs, strands| pairs.begin(h, close, strands));
    }

    /// Makes them linear.
    pub(super) fn linearise_pairs(&mut self) {
        if !self.buffers.pairs.is_empty() {
            self.with_pairs(PairStep::linearise);
            self.pass_pairs(true);
        }
    }

    /// Passes their impulses to the residuals of the cables.
    fn pass_pairs(&mut self, linear: bool) {
        let (cables, pairs) = (&mut *self.cables, &self.buffers.pairs);
        cables[0].diagnostics_mut().effects.contact += pairs.count();
        for cable in cables.iter_mut() {
            let size = cable.positions().len();
            cable.step_buffers.pair_impulses.clear();
            cable.step_buffers.pair_impulses.resize(size, 0.0);
        }
        pairs.pass_impulses(linear, |cable, element, impulse| {
            let out = &mut cables[cable].step_buffers.pair_impulses[6 * element..6 * element + 12];
            out.iter_mut().zip(impulse).for_each(|(out, impulse)| *out += impulse);
        });
    }

    /// Factors what they add to the matrix.
    pub(super) fn factor_pairs(&mut self) -> Result<(), StepFailure> {
        let outcome = self.with_low_rank(|low_rank, system| {
            system.save();
            system.exchange();
            let outcome = low_rank.factor(system);
            system.exchange();
            outcome
        });
        outcome.unwrap_or(Ok(()))
    }

    /// Solves the linear equations in place: the residuals of cables and the rows of bodies become their increments.
    pub(super) fn solve(&mut self) {
        self.solve_apart();
        self.with_low_rank(|low_rank, system| low_rank.complete(system));
    }

    /// Calls `f` with their rows and the equations without them, if any are near.
    fn with_low_rank<T>(&mut self, f: impl FnOnce(&mut LowRank, &mut OnIsland<'_, '_, '_>) -> T) -> Option<T> {
        if self.buffers.pairs.is_empty() {
            return None;
        }
        let (mut pairs, mut aside) = (take(&mut self.buffers.pairs), take(&mut self.buffers.aside));
        aside.cables.resize_with(self.cables.len(), Vec::new);
        let out = f(&mut pairs.low_rank, &mut OnIsland { island: self, aside: &mut aside });
        (self.buffers.pairs, self.buffers.aside) = (pairs, aside);
        Some(out)
    }

    /// Returns whether centre lines go through each other in the step.
    pub(super) fn do_pairs_cross(&mut self) -> bool {
        self.with_pairs(PairStep::crosses)
    }

    /// Remembers those that touch at the end of the step.
    pub(super) fn remember_pairs(&mut self) {
        let (cables, pairs) = (&mut *self.cables, &self.buffers.pairs);
        for c in 0..cables.len() {
            let mut memory = core::mem::take(&mut cables[c].snapshot.state.memory.pairs);
            pairs.remember(c, |other| cables[other].snapshot.passed_at_start(), &mut memory);
            cables[c].snapshot.state.memory.pairs = memory;
        }
    }

    /// Evaluates them at the present iterate, and returns what they do, if any are near.
    pub(super) fn balance_pairs(&mut self) -> Option<ContactBalance> {
        self.with_pairs(PairStep::complete);
        if self.buffers.pairs.is_empty() {
            return None;
        }
        let contacts = self.with_pairs(PairStep::balance);
        self.pass_pairs(false);
        Some(contacts)
    }
}
