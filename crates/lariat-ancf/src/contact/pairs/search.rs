//! Which chords of cables can touch each other in a step: boxes of elements, then chords, then the time at which they meet.
//!
//! # Validity
//!
//! The box of an element holds it over the whole step, so that a fast one is not missed. Where chords pass more than half their reach in the step, the closest points
//! are those when they first touch, by conservative advancement; else those at the predicted end.
//!
//! # References
//!
//! Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996 (conservative advancement).

use super::CablePair;
use super::chords::{Piece, Strand, closest, refine};
use super::crossing::crossing;
use crate::scales::contact::{ADVANCES, APART, FAST, LEAST_ADVANCE, NEAR_PAIR, ONE, TILT};
use core::cmp::Ordering;
use nalgebra::Vector3;

/// The cables of a step.
pub(crate) struct Strands<'s, 'a> {
    pub count: usize,
    pub get: &'s dyn Fn(usize) -> Strand<'a>,
    /// Returns the distance in m between points of two cables, by arc length, over a body that holds both.
    pub over_bodies: &'s dyn Fn([usize; 2], [f64; 2]) -> f64,
    /// Those that may touch each other, in ascending order; `None` for all.
    pub pairs: Option<&'s [CablePair]>,
}

impl Strands<'_, '_> {
    /// Returns the coefficient of friction between two strands that may touch, or of one with itself.
    pub fn friction(&self, a: usize, b: usize) -> Option<f64> {
        let contact = |c: usize| (self.get)(c).model.effects.contact;
        let (one, other) = (contact(a)?, contact(b)?);
        if a == b {
            return one.itself.then_some(one.friction);
        }
        if !(one.cables && other.cables) {
            return None;
        }
        let Some(pairs) = self.pairs else { return Some(0.5 * (one.friction + other.friction)) };
        let found = pairs.binary_search_by_key(&[a.min(b), a.max(b)], |pair| pair.cables).ok()?;
        Some(pairs[found].friction)
    }

    /// Returns whether a strand may touch any.
    pub fn may_touch(&self, c: usize) -> bool {
        let Some(contact) = (self.get)(c).model.effects.contact else { return false };
        contact.itself
            || contact.cables
                && match self.pairs {
                    None => (0..self.count).any(|other| {
                        other != c && (self.get)(other).model.effects.contact.is_some_and(|own| own.cables)
                    }),
                    Some(pairs) => pairs.iter().any(|pair| pair.cables.contains(&c)),
                }
    }
}

/// An element with the box that it is in over the step.
#[derive(Clone, Copy, Debug)]
struct Boxed {
    low: Vector3<f64>,
    high: Vector3<f64>,
    strand: usize,
    element: usize,
    /// Arc length in m at which it begins.
    from: f64,
    radius: f64,
}

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

/// Buffers of the search.
#[derive(Clone, Debug, Default)]
pub(super) struct Search {
    boxes: Vec<Boxed>,
    active: Vec<usize>,
    /// Elements whose boxes meet.
    near: Vec<[usize; 2]>,
    nodes: [Vec<[Vector3<f64>; 2]>; 2],
    pub found: Vec<Candidate>,
}

impl Search {
    /// Finds all candidates at the present iterate with a gap of at most `near` reaches.
    pub fn run(&mut self, strands: &Strands<'_, '_>, near: f64) {
        self.found.clear();
        self.find_near(strands);
        for i in 0..self.near.len() {
            let [a, b] = self.near[i].map(|k| self.boxes[k]);
            self.compare(strands, a, b, near);
        }
    }

    /// Finds the elements that are near each other at some time of the step.
    pub fn find_near(&mut self, strands: &Strands<'_, '_>) {
        self.collect(strands);
        self.sweep(strands);
    }

    /// Returns the first strands found whose centre lines go through each other in the step.
    pub fn crossing(&self, strands: &Strands<'_, '_>) -> Option<[usize; 2]> {
        self.near.iter().find_map(|near| {
            let own = near.map(|k| self.boxes[k]);
            let pieces = own.map(|own| Piece::new((strands.get)(own.strand), own.element));
            let ends = |k: usize, i: usize| pieces[k].place(i as f64 / pieces[k].chords as f64);
            let arc = |k: usize, i: usize| own[k].from + (i as f64 + 0.5) * pieces[k].length / pieces[k].chords as f64;
            let reach = own[0].radius + own[1].radius;
            let same = own[0].strand == own[1].strand;
            (0..pieces[0].chords).find_map(|i| {
                let [a0, a1] = [ends(0, i), ends(0, i + 1)];
                (0..pieces[1].chords).find_map(|j| {
                    let [b0, b1] = [ends(1, j), ends(1, j + 1)];
                    let arcs = [arc(0, i), arc(1, j)];
                    let size = 0.5 * ((a1[0] - a0[0]).norm() + (b1[0] - b0[0]).norm());
                    let ways = [[a0, b0], [a0, b1], [a1, b0], [a1, b1]].map(|[p, q]| (p[1] - q[1]).norm());
                    let middles = 0.5 * (a0[0] + a1[0] - b0[0] - b1[0]);
                    let apart = middles.norm() > size + ways.into_iter().fold(0.0, f64::max);
                    if apart || same && (arcs[0] - arcs[1]).abs() < APART * reach {
                        return None;
                    }
                    let strands_of = own.map(|own| own.strand);
                    crossing([&a0, &a1], [&b0, &b1])
                        .filter(|_| (strands.over_bodies)(strands_of, arcs) >= APART * reach)
                        .map(|_| strands_of)
                })
            })
        })
    }

    /// Collects the boxes of all elements that can touch others.
    fn collect(&mut self, strands: &Strands<'_, '_>) {
        self.boxes.clear();
        for c in 0..strands.count {
            let strand = (strands.get)(c);
            let Some(contact) = strand.model.effects.contact.filter(|_| strands.may_touch(c)) else { continue };
            let mut from = 0.0;
            for (e, element) in strand.model.elements.iter().enumerate() {
                if strand.model.is_at_eye(e) {
                    from += element.length;
                    continue;
                }
                let radius = contact.radius_of(&element.section);
                let third = element.length / 3.0;
                let corners = |start: bool| {
                    let d: [Vector3<f64>; 4] = core::array::from_fn(|k| {
                        let at = 6 * e + 3 * k;
                        let change = if start {
                            Vector3::zeros()
                        } else {
                            Vector3::from_column_slice(&strand.change[at..at + 3])
                        };
                        Vector3::from_column_slice(&strand.q[at..at + 3]) + change
                    });
                    [d[0], d[0] + d[1] * third, d[2] - d[3] * third, d[2]]
                };
                let all = [corners(true), corners(false)];
                let (mut low, mut high) = (all[0][0], all[0][0]);
                for x in all.iter().flatten() {
                    (low, high) = (low.inf(x), high.sup(x));
                }
                let margin = Vector3::repeat(radius * (1.0 + NEAR_PAIR));
                let (low, high) = (low - margin, high + margin);
                self.boxes.push(Boxed { low, high, strand: c, element: e, from, radius });
                from += element.length;
            }
        }
    }

    /// Finds the boxes that meet, by sweeping along the longest axis.
    fn sweep(&mut self, strands: &Strands<'_, '_>) {
        self.near.clear();
        let Some(first) = self.boxes.first() else { return };
        let spread =
            self.boxes.iter().fold([first.low, first.low], |[low, high], b| [low.inf(&b.low), high.sup(&b.low)]);
        let axis = (spread[1] - spread[0]).imax();
        self.boxes.sort_unstable_by(|a, b| {
            let order = a.low[axis].partial_cmp(&b.low[axis]).unwrap_or(Ordering::Equal);
            order.then((a.strand, a.element).cmp(&(b.strand, b.element)))
        });
        self.active.clear();
        for i in 0..self.boxes.len() {
            let own = self.boxes[i];
            self.active.retain(|&k| self.boxes[k].high[axis] >= own.low[axis]);
            for &k in &self.active {
                let other = self.boxes[k];
                let apart = (0..3).any(|x| other.high[x] < own.low[x] || own.high[x] < other.low[x]);
                if !apart && may_touch(strands, &own, &other) {
                    self.near.push(if is_first(strands, &own, &other) { [i, k] } else { [k, i] });
                }
            }
            self.active.push(i);
        }
        let boxes = &self.boxes;
        let name = |i: usize| (boxes[i].strand, boxes[i].element);
        self.near.sort_unstable_by_key(|[a, b]| (name(*a), name(*b)));
    }

    /// Finds the chords of two elements that can touch.
    fn compare(&mut self, strands: &Strands<'_, '_>, first: Boxed, second: Boxed, near: f64) {
        let (a, b) = (
            Piece::new((strands.get)(first.strand), first.element),
            Piece::new((strands.get)(second.strand), second.element),
        );
        let reach = first.radius + second.radius;
        for (nodes, piece) in self.nodes.iter_mut().zip([&a, &b]) {
            nodes.clear();
            nodes.extend((0..=piece.chords).map(|i| piece.place(i as f64 / piece.chords as f64)));
        }
        // where the chord before the first one of b begins
        let before = (!b.strand.model.begins_contact(second.element)).then(|| {
            let piece = Piece::new(b.strand, b.element - 1);
            piece.place((piece.chords - 1) as f64 / piece.chords as f64)
        });
        let [ones, others] = &self.nodes;
        let at = |[x, change]: [Vector3<f64>; 2], share: f64| x + change * share;
        for i in 0..a.chords {
            for j in 0..b.chords {
                let [a0, a1, b0, b1] = [ones[i], ones[i + 1], others[j], others[j + 1]];
                let relative = |p: [Vector3<f64>; 2], q: [Vector3<f64>; 2]| (p[1] - q[1]).norm();
                let way = relative(a0, b0).max(relative(a0, b1)).max(relative(a1, b0)).max(relative(a1, b1));
                let size = 0.5 * ((a1[0] - a0[0]).norm() + (b1[0] - b0[0]).norm());
                let middles = 0.5 * (a0[0] + a1[0] - b0[0] - b1[0]);
                if middles.norm() > size + way + reach * (1.0 + NEAR_PAIR) {
                    continue;
                }
                if first.strand == second.strand {
                    let arc = |own: &Boxed, piece: &Piece<'_>, k: usize| {
                        own.from + (k as f64 + 0.5) * piece.length / piece.chords as f64
                    };
                    if (arc(&first, &a, i) - arc(&second, &b, j)).abs() + 2.0 * size < APART * reach {
                        continue;
                    }
                }
                let segments = |share: f64| ([at(a0, share), at(a1, share)], [at(b0, share), at(b1, share)]);
                let between = |share: f64| {
                    let (one, other) = segments(share);
                    let (s, t) = closest(one, other);
                    (s, t, one[0] + (one[1] - one[0]) * s - other[0] - (other[1] - other[0]) * t)
                };
                let share = if way < FAST * reach { 1.0 } else { touch(|share| between(share).2.norm(), reach, way) };
                let (s, t, y) = between(share);
                if y.norm() > reach * (1.0 + near) {
                    continue;
                }
                // of two chords that share the closest point on b, one has it
                let last = b.strand.model.ends_contact(second.element) && j + 1 == b.chords;
                if t >= 1.0 && !last {
                    continue;
                }
                let previous = if j > 0 { Some(others[j - 1]) } else { before };
                if t <= 0.0
                    && let Some(previous) = previous
                    && y.dot(&(at(b0, share) - at(previous, share))) < 0.0
                {
                    continue;
                }
                let from = [(i as f64 + s) / a.chords as f64, (j as f64 + t) / b.chords as f64];
                let xi = refine(&a, i, &b, from, share);
                let arcs = [first.from + xi[0] * a.length, second.from + xi[1] * b.length];
                let along = if first.strand == second.strand { (arcs[0] - arcs[1]).abs() } else { f64::INFINITY };
                let over_bodies = (strands.over_bodies)([first.strand, second.strand], arcs);
                if along.min(over_bodies) < APART * reach {
                    continue;
                }
                let strands = [first.strand, second.strand];
                // chords that meet in the closest point are one contact: that of the nearest points
                let same = |other: &Candidate| {
                    other.strands == strands
                        && (other.arcs[0] - arcs[0]).abs() + (other.arcs[1] - arcs[1]).abs() < ONE * reach
                };
                let known = self.found.iter().position(same);
                let y = a.at(xi[0], share) - b.at(xi[1], share);
                if known.is_some_and(|k| self.found[k].distance <= y.norm()) {
                    continue;
                }
                // beside a crossing the end of a chord is no place of contact
                let slope = a.slope(xi[0], share);
                let model = a.strand.model;
                let is_tip = xi[0] <= 0.0 && model.begins_contact(first.element)
                    || xi[0] >= 1.0 && model.ends_contact(first.element);
                if !is_tip && y.dot(&slope).abs() > TILT * y.norm() * slope.norm() {
                    continue;
                }
                let normal = y.try_normalize(1e-9 * reach);
                let candidate = Candidate {
                    strands,
                    elements: [first.element, second.element],
                    chords: [i, j],
                    xi,
                    arcs,
                    reach,
                    normal: normal.unwrap_or_else(|| y.try_normalize(0.0).unwrap_or(Vector3::y())),
                    distance: y.norm(),
                };
                match known {
                    Some(k) => self.found[k] = candidate,
                    None => self.found.push(candidate),
                }
            }
        }
    }
}

/// Returns the share of a step at which chords that move by at most `way` come within `reach`; 1 if they do not.
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

/// Returns whether two elements may touch.
fn may_touch(strands: &Strands<'_, '_>, a: &Boxed, b: &Boxed) -> bool {
    (a.strand, a.element) != (b.strand, b.element) && strands.friction(a.strand, b.strand).is_some()
}

/// Returns whether the first of two elements is the one that keeps their contacts.
fn is_first(strands: &Strands<'_, '_>, a: &Boxed, b: &Boxed) -> bool {
    let key = |own: &Boxed| ((strands.get)(own.strand).key, own.strand, own.element);
    key(a) < key(b)
}
