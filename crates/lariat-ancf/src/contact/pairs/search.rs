//! Which chords of cables can touch each other in a step, and where.
//!
//! # Validity
//!
//! Elements that come near each other at any time of the step are found by boxes (boxes.rs), their
//! chords by halves (halves.rs), so that a fast one is not missed. Where chords pass more than half
//! their reach in the step, the closest points are those when they first touch, by conservative
//! advancement; else those at the predicted end.
//!
//! # References
//!
//! Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996 (conservative
//! advancement).

use super::boxes::{Boxes, Place};
use super::chords::{Piece, closest, refine};
use super::crossing::crossing;
use super::halves::{ChordPair, Chords, Halves, Near};
use super::strands::Strands;
use crate::scales::contact::{ADVANCES, APART, FAST, LEAST_ADVANCE, ONE, TILT};
use nalgebra::Vector3;

/// Chords that can touch, with the closest points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub strands: [usize; 2],
    pub elements: [usize; 2],
    pub chords: [usize; 2],
    pub xi: [f64; 2],
    pub arcs: [f64; 2],
    /// Sum of the radii in m.
    pub reach: f64,
    /// From the second to the first when they are closest.
    pub normal: Vector3<f64>,
    /// How far they are apart in m.
    pub distance: f64,
}

/// Where centre lines go through each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossed {
    pub strands: [usize; 2],
    /// Arc lengths in m.
    pub arcs: [f64; 2],
}

/// Buffers of the search.
#[derive(Clone, Debug, Default)]
pub(super) struct Search {
    elements: Boxes,
    /// By strand and element, where its chords are in the list, and one more; 0 if that is not
    /// said.
    slots: Vec<Vec<usize>>,
    chords: Chords,
    halves: Halves,
    /// Number of tests of whether pieces of cables are near each other.
    pub tests: u64,
    pub found: Vec<Candidate>,
}

impl Search {
    /// Finds all candidates at the present iterate with a gap of at most `near` reaches.
    pub fn run(&mut self, strands: &Strands<'_, '_>, near: f64) {
        self.found.clear();
        self.find_near(strands);
        self.forget(strands);
        for k in 0..self.elements.near.len() {
            let own = self.elements.near[k];
            let pair = self.pair(strands, &own);
            self.tests += self.halves.find(&pair, &mut self.chords);
            for found in &self.halves.found {
                let chords = pair.pair(&mut self.chords, *found);
                compare(&mut self.found, strands, &own, (&pair, *found, &chords), near);
            }
        }
    }

    /// Forgets all chords.
    fn forget(&mut self, strands: &Strands<'_, '_>) {
        self.chords.clear();
        self.slots.resize_with(strands.count, Vec::new);
        for (strand, slots) in self.slots.iter_mut().enumerate() {
            slots.clear();
            slots.resize((strands.get)(strand).model.elements.len(), 0);
        }
    }

    /// Returns two elements, whose chords are compared.
    fn pair<'a>(&mut self, strands: &Strands<'_, 'a>, own: &[Place; 2]) -> Near<'a> {
        let [first, second] = own;
        let pieces = own.map(|own| Piece::new((strands.get)(own.strand), own.element));
        let slots = [0, 1].map(|k| {
            let slot = &mut self.slots[own[k].strand][own[k].element];
            if *slot == 0 {
                *slot = self.chords.reserve(pieces[k].chords) + 1;
            }
            *slot - 1
        });
        let (from, reach) = ([first.from, second.from], first.radius + second.radius);
        Near { pieces, slots, from, reach, same: first.strand == second.strand }
    }

    /// Finds the elements that are near each other at some time of the step.
    pub fn find_near(&mut self, strands: &Strands<'_, '_>) {
        self.tests += self.elements.find(strands);
    }

    /// Returns the first place found where centre lines go through each other in the step.
    pub fn crossing(&mut self, strands: &Strands<'_, '_>) -> Option<Crossed> {
        self.forget(strands);
        for k in 0..self.elements.near.len() {
            let own = self.elements.near[k];
            let pair = self.pair(strands, &own);
            self.tests += self.halves.find(&pair, &mut self.chords);
            let names = own.map(|own| own.strand);
            let crosses = |chords: &[usize; 2]| -> Option<Crossed> {
                let ChordPair { one: [a0, a1], other: [b0, b1], size, way, apart, along } =
                    pair.pair(&mut self.chords, *chords);
                if apart > size + way || pair.same && along < APART * pair.reach {
                    return None;
                }
                let at = crossing([&a0, &a1], [&b0, &b1])?.at.map(|share| share.clamp(0.0, 1.0));
                let arcs = pair.arcs(*chords, at);
                let is_apart = (strands.over_bodies)(names, arcs) < APART * pair.reach;
                (!is_apart).then_some(Crossed { strands: names, arcs })
            };
            let found = self.halves.found.iter().find_map(crosses);
            if found.is_some() {
                return found;
            }
        }
        None
    }
}

/// Adds two chords that are near each other, if they can touch.
fn compare(
    found: &mut Vec<Candidate>,
    strands: &Strands<'_, '_>,
    [first, second]: &[Place; 2],
    (pair, [i, j], chords): (&Near<'_>, [usize; 2], &ChordPair),
    near: f64,
) {
    let ([a, b], reach) = (&pair.pieces, pair.reach);
    let ChordPair { one: [a0, a1], other: [b0, b1], way, .. } = *chords;
    let at = |[x, change]: [Vector3<f64>; 2], share: f64| x + change * share;
    let segments = |share: f64| ([at(a0, share), at(a1, share)], [at(b0, share), at(b1, share)]);
    let between = |share: f64| {
        let (one, other) = segments(share);
        let (s, t) = closest(one, other);
        (s, t, one[0] + (one[1] - one[0]) * s - other[0] - (other[1] - other[0]) * t)
    };
    let share = if way < FAST * reach { 1.0 } else { touch(|share| between(share).2.norm(), reach, way) };
    let (s, t, y) = between(share);
    if y.norm() > reach * (1.0 + near) {
        return;
    }
    // of two chords that share the closest point on b, one has it
    let last = b.strand.model.ends_contact(second.element) && j + 1 == b.chords;
    if t >= 1.0 && !last {
        return;
    }
    if t <= 0.0
        && let Some(previous) = b.before(j)
        && y.dot(&(at(b0, share) - at(previous, share))) < 0.0
    {
        return;
    }
    let from = [(i as f64 + s) / a.chords as f64, (j as f64 + t) / b.chords as f64];
    let xi = refine(a, i, b, from, share);
    let arcs = [first.from + xi[0] * a.length, second.from + xi[1] * b.length];
    let strands_of = [first.strand, second.strand];
    let along = if pair.same { (arcs[0] - arcs[1]).abs() } else { f64::INFINITY };
    if along.min((strands.over_bodies)(strands_of, arcs)) < APART * reach {
        return;
    }
    // chords that meet in the closest point are one contact: that of the nearest points
    let same = |other: &Candidate| {
        other.strands == strands_of && (other.arcs[0] - arcs[0]).abs() + (other.arcs[1] - arcs[1]).abs() < ONE * reach
    };
    let known = found.iter().position(same);
    let y = a.at(xi[0], share) - b.at(xi[1], share);
    if known.is_some_and(|k| found[k].distance <= y.norm()) {
        return;
    }
    // beside a crossing the end of a chord is no place of contact
    let slope = a.slope(xi[0], share);
    if !a.is_tip(xi[0]) && y.dot(&slope).abs() > TILT * y.norm() * slope.norm() {
        return;
    }
    let normal = y.try_normalize(1e-9 * reach);
    let candidate = Candidate {
        strands: strands_of,
        elements: [first.element, second.element],
        chords: [i, j],
        xi,
        arcs,
        reach,
        normal: normal.unwrap_or_else(|| y.try_normalize(0.0).unwrap_or(Vector3::y())),
        distance: y.norm(),
    };
    match known {
        Some(k) => found[k] = candidate,
        None => found.push(candidate),
    }
}

/// Returns the share of a step at which chords that move by at most `way` come within `reach`; 1 if
/// they do not.
fn touch(distance: impl Fn(f64) -> f64, reach: f64, way: f64) -> f64 {
    let mut share = 0.0;
    for _ in 0..ADVANCES {
        let gap = distance(share) - reach;
        if gap <= LEAST_ADVANCE * reach {
            return share;
        }
        share += gap / way;
        if share >= 1.0 {
            return 1.0;
        }
    }
    share
}
