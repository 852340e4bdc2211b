//! Which cables can touch each other in a Rapier step: those move in one island.
//!
//! # Method
//!
//! A cable that touches cables is boxed by eight elements at a time: their Bezier points, now and
//! after twice the way of the step, grown by some radii. Cables whose boxes meet are a pair. What a
//! cable does within the step is not known before, so the boxes that it really swept are compared
//! afterwards: if two met that were no pair, they become one, and the step begins anew.
//!
//! # Validity
//!
//! A cable that leaves the hull of its beginning and its end within the step, and is back by then,
//! may be missed. The order of pairs does not depend on the order of insertion once they are
//! numbered within an island.

use crate::contents::rules::ContactRules;
use crate::contents::{Contents, Slot};
use crate::islands::Island;
use crate::scales::contact::{CHUNK, MARGIN, REACH, SWEEP};
use ::nalgebra::Vector3;
use lariat_ancf::contact::CablePair;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Cable, Contact};

/// A piece of a cable with the box that it is in.
#[derive(Clone, Copy, Debug)]
struct Boxed {
    low: Vector3<f64>,
    high: Vector3<f64>,
    cable: usize,
}

/// Finds the pairs, with its buffers. Nothing in it is state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    boxes: Vec<Boxed>,
    active: Vec<usize>,
    found: Vec<[usize; 2]>,
    /// The pairs of the present Rapier step by the indices of cables, in ascending order, with the
    /// friction between them.
    pub pairs: Vec<CablePair>,
}

impl Neighbours {
    /// Begins a Rapier step of `h` (s): finds the pairs. Does nothing unless two cables touch
    /// cables.
    pub fn begin(&mut self, contents: &Contents, h: f64) {
        self.pairs.clear();
        self.boxes.clear();
        if contents.cables.values().filter(|slot| touches(slot)).count() < 2 {
            return;
        }
        for (index, slot) in contents.cables.iter().filter(|(_, slot)| touches(slot)) {
            let (q, v) = (slot.cable.positions(), slot.cable.velocities());
            self.add(&slot.cable, index, MARGIN, |i| [q[i], q[i] + SWEEP * h * v[i]]);
        }
        self.sweep();
        self.take(contents);
    }

    /// Adds the pairs that the islands met in a step and that were not known, and returns whether
    /// there are any. `before` returns the coordinates before the step, by island and cable in it;
    /// `None` for an island that did not move.
    pub fn complete<'a>(
        &mut self,
        contents: &Contents,
        islands: &[Island],
        before: impl Fn(usize, usize) -> Option<&'a [f64]>,
    ) -> bool {
        if self.boxes.is_empty() {
            return false;
        }
        self.boxes.clear();
        for (i, island) in islands.iter().enumerate() {
            for (k, &index) in island.cables.iter().enumerate() {
                let Some(slot) = contents.cables.get(index).filter(|slot| touches(slot)) else { continue };
                let end = slot.cable.positions();
                let start = before(i, k).filter(|start| start.len() == end.len()).unwrap_or(end);
                self.add(&slot.cable, index, REACH, |i| [start[i], end[i]]);
            }
        }
        self.sweep();
        let known = self.pairs.len();
        self.take(contents);
        self.pairs.len() > known
    }

    /// Adds the boxes of a cable, whose coordinates have two values each, grown by radii.
    fn add(&mut self, cable: &Cable, index: usize, radii: f64, at: impl Fn(usize) -> [f64; 2]) {
        let (elements, margin) = (cable.elements(), Vector3::repeat(radii * cable.contact_radius()));
        for first in (0..elements.len()).step_by(CHUNK) {
            let mut low = Vector3::repeat(f64::INFINITY);
            let mut high = -low;
            for (e, element) in elements.iter().enumerate().skip(first).take(CHUNK) {
                for moment in 0..2 {
                    let read = |k: usize| Vector3::from_fn(|x, _| at(6 * e + 3 * k + x)[moment]);
                    let third = element.length / 3.0;
                    let [from, leaving, to, arriving] = [read(0), read(1), read(2), read(3)];
                    for x in [from, from + leaving * third, to - arriving * third, to] {
                        (low, high) = (low.inf(&x), high.sup(&x));
                    }
                }
            }
            self.boxes.push(Boxed { low: low - margin, high: high + margin, cable: index });
        }
    }

    /// Finds the cables whose boxes meet, by sweeping along the longest axis.
    fn sweep(&mut self) {
        let Neighbours { boxes, active, found, .. } = self;
        found.clear();
        active.clear();
        let Some(first) = boxes.first() else { return };
        let spread = boxes.iter().fold([first.low; 2], |[low, high], b| [low.inf(&b.low), high.sup(&b.low)]);
        let axis = (spread[1] - spread[0]).imax();
        boxes.sort_by(|a, b| a.low[axis].total_cmp(&b.low[axis]));
        for i in 0..boxes.len() {
            let own = boxes[i];
            active.retain(|&k| boxes[k].high[axis] >= own.low[axis]);
            for other in active.iter().map(|&k| &boxes[k]).filter(|other| other.cable != own.cable) {
                if (0..3).all(|x| other.high[x] >= own.low[x] && own.high[x] >= other.low[x]) {
                    found.push([own.cable.min(other.cable), own.cable.max(other.cable)]);
                }
            }
            active.push(i);
        }
        found.sort_unstable();
        found.dedup();
    }

    /// Takes over what was found and what the rules allow.
    fn take(&mut self, contents: &Contents) {
        for &cables in &self.found {
            let place = self.pairs.binary_search_by_key(&cables, |pair| pair.cables);
            let [Some(one), Some(other)] = cables.map(|c| contents.cables.get(c)) else { continue };
            if let (Err(place), Some([friction, restitution])) = (place, coefficients(one, other)) {
                self.pairs.insert(place, CablePair { cables, friction, restitution });
            }
        }
    }
}

/// Returns the coefficients of friction and of restitution between two cables that may touch.
fn coefficients(one: &Slot, other: &Slot) -> Option<[f64; 2]> {
    let [mine, theirs] = [one, other].map(|slot| slot.cable.effects().contact);
    let own = |contact: Contact| [contact.friction, contact.restitution];
    ContactRules::between((&one.rules, own(mine?)), (&other.rules, own(theirs?)))
}

/// Returns whether a cable touches cables.
fn touches(slot: &Slot) -> bool {
    slot.cable.effects().contact.is_some_and(|contact| contact.cables)
}
