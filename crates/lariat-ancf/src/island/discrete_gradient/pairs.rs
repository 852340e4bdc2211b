//! Contacts between the cables of an island, in a step of the discrete gradient.

use super::super::layout::Layout;
use super::{IslandStep, StepBuffers};
use crate::cable::Cable;
use crate::contact::{CablePair, ContactBalance, PairStep, Strand, Strands};
use crate::one_leg::OneLeg;

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
        let (q, velocity, memory) = (&state.q[..], &state.v[..], &state.memory.pairs[..]);
        Strand { key, model, q, change: &step_buffers.change, velocity, memory, damped: state.memory.damped, passed }
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
        let found = with_strands(self.cables, self.layout, may_touch.as_deref(), |strands| f(pairs, strands));
        self.cables[0].diagnostics_mut().search_tests += self.buffers.pairs.take_tests();
        found
    }

    /// Finds the contacts of a step of a length in s with a formula.
    pub(super) fn find_pairs(&mut self, step: (f64, OneLeg), close: bool) {
        self.with_pairs(|pairs, strands| pairs.begin(step, close, strands));
    }

    /// Makes them linear.
    pub(super) fn linearise_pairs(&mut self) {
        self.buffers.cables.iter_mut().for_each(|own| own.pairs.clear());
        if self.buffers.pairs.is_empty() {
            return;
        }
        self.with_pairs(PairStep::linearise);
        self.pass_pairs(true);
        let StepBuffers { cables, pairs, .. } = &mut *self.buffers;
        for (k, [one, other]) in pairs.columns.iter().enumerate() {
            cables[one.strand].pairs.push(k);
            if other.strand != one.strand {
                cables[other.strand].pairs.push(k);
            }
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

    /// Returns whether centre lines go through each other in the step.
    pub(super) fn do_pairs_cross(&mut self) -> bool {
        self.with_pairs(PairStep::crosses)
    }

    /// Remembers those that touch at the end of the step.
    pub(super) fn remember_pairs(&mut self) {
        let (cables, pairs) = (&mut *self.cables, &self.buffers.pairs);
        for c in 0..cables.len() {
            cables[c].diagnostics_mut().touching_steps += u64::from(pairs.touches(c));
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
