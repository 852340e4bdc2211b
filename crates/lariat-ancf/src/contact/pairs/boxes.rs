//! Which elements of cables come near each other in a step: boxes of elements in a binary tree.
//!
//! # Equation
//!
//! The box of an element holds the Bezier polygon of its curve at the beginning and at the end of
//! the step, grown by what counts as near. Elements that follow each other are always near. They
//! cannot touch, however, and are left out, where each is straight, and all are in line: with a
//! direction d of each, and one D for all,
//!
//! ```text
//! h . d >= 0.95 max(|h|, 1),  d . D >= 0.95      for all h of the Bezier polygons of r', at both
//! ends of the step
//! ```
//!
//! so h . D >= 0.76. Points at the distance s along the cable are then at least 0.76 s apart at any
//! time of the step, and those that count are eight radii apart along it.
//!
//! # Validity
//!
//! The tree is over elements in their order along the cables, which are near in space where they
//! are near in order. A test of two of its boxes costs the same whether they are of one element or
//! of many, so a cable that is near nothing costs some four tests per element.
//!
//! # References
//!
//! Volino & Magnenat-Thalmann, Computer Graphics Forum 13 (1994) C155 (a surface whose normals are
//! in a cone does not meet itself).

use super::chords::Strand;
use super::strands::Strands;
use crate::scales::contact::{NEAR_PAIR, STRAIGHT};
use nalgebra::Vector3;

/// An element with the box that it is in over the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boxed {
    extent: Extent,
    /// Its direction, if it is straight over the whole step.
    direction: Option<Vector3<f64>>,
    pub strand: usize,
    pub element: usize,
    /// Arc length in m at which it begins.
    pub from: f64,
    pub radius: f64,
}

#[derive(Clone, Copy, Debug)]
struct Extent {
    low: Vector3<f64>,
    high: Vector3<f64>,
}

impl Extent {
    const NONE: Extent = Extent {
        low: Vector3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vector3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    fn with(&self, other: &Extent) -> Extent {
        Extent { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    fn meets(&self, other: &Extent) -> bool {
        (0..3).all(|x| other.high[x] >= self.low[x] && self.high[x] >= other.low[x])
    }
}

/// Buffers of the search for elements.
#[derive(Clone, Debug, Default)]
pub(super) struct Boxes {
    pub boxes: Vec<Boxed>,
    /// Those of the tree: the children of number k are 2 k and 2 k + 1, the leaves its last half.
    tree: Vec<Extent>,
    open: Vec<[usize; 2]>,
    /// Elements that can touch: the first of two is the one that keeps their contacts.
    pub near: Vec<[usize; 2]>,
}

impl Boxes {
    /// Finds the elements that are near each other at some time of the step, and returns the number
    /// of tests.
    pub fn find(&mut self, strands: &Strands<'_, '_>) -> u64 {
        self.collect(strands);
        self.near.clear();
        if self.boxes.is_empty() {
            return 0;
        }
        let leaves = self.boxes.len().next_power_of_two();
        self.tree.clear();
        self.tree.resize(2 * leaves, Extent::NONE);
        for (leaf, own) in self.tree[leaves..].iter_mut().zip(&self.boxes) {
            *leaf = own.extent;
        }
        for k in (1..leaves).rev() {
            self.tree[k] = self.tree[2 * k].with(&self.tree[2 * k + 1]);
        }
        let tests = self.descend(strands, leaves);
        let boxes = &self.boxes;
        let name = |i: usize| (boxes[i].strand, boxes[i].element);
        self.near.sort_unstable_by_key(|[a, b]| (name(*a), name(*b)));
        tests
    }

    /// Collects the boxes of all elements that can touch others.
    fn collect(&mut self, strands: &Strands<'_, '_>) {
        self.boxes.clear();
        for c in 0..strands.count {
            let strand = (strands.get)(c);
            let Some(contact) = strand.model.effects.contact.filter(|_| strands.may_touch(c)) else { continue };
            let mut from = 0.0;
            for (e, element) in strand.model.elements.iter().enumerate() {
                if !strand.model.is_at_eye(e) {
                    let radius = contact.radius_of(&element.section);
                    let third = element.length / 3.0;
                    let polygons = [true, false].map(|start| polygon(&strand, e, third, start));
                    self.boxes.push(Boxed {
                        extent: extent(&polygons, radius * (1.0 + NEAR_PAIR)),
                        direction: direction(&polygons, third),
                        strand: c,
                        element: e,
                        from,
                        radius,
                    });
                }
                from += element.length;
            }
        }
    }

    /// Finds the leaves whose boxes meet, and returns the number of tests.
    fn descend(&mut self, strands: &Strands<'_, '_>, leaves: usize) -> u64 {
        let mut tests = 0;
        self.open.clear();
        self.open.push([1, 1]);
        while let Some([k, l]) = self.open.pop() {
            if k == l {
                if k < leaves {
                    self.open.extend([[2 * k, 2 * k], [2 * k + 1, 2 * k + 1], [2 * k, 2 * k + 1]]);
                }
                continue;
            }
            tests += 1;
            if !self.tree[k].meets(&self.tree[l]) {
                continue;
            }
            if k < leaves {
                let children = [[2 * k, 2 * l], [2 * k, 2 * l + 1], [2 * k + 1, 2 * l], [2 * k + 1, 2 * l + 1]];
                self.open.extend(children);
                continue;
            }
            let (i, j) = (k - leaves, l - leaves);
            let [own, other] = [&self.boxes[i], &self.boxes[j]];
            let straight = own.strand == other.strand && is_straight(&self.boxes[i.min(j)..=i.max(j)]);
            if !straight && strands.coefficients(own.strand, other.strand).is_some() {
                self.near.push(if is_first(strands, own, other) { [i, j] } else { [j, i] });
            }
        }
        tests
    }
}

/// Returns whether the first of two elements is the one that keeps their contacts.
fn is_first(strands: &Strands<'_, '_>, a: &Boxed, b: &Boxed) -> bool {
    let key = |own: &Boxed| ((strands.get)(own.strand).key, own.strand, own.element);
    key(a) < key(b)
}

/// Returns the Bezier points of an element, a third of whose length is given.
fn polygon(strand: &Strand<'_>, element: usize, third: f64, start: bool) -> [Vector3<f64>; 4] {
    let d: [Vector3<f64>; 4] = core::array::from_fn(|k| {
        let at = 6 * element + 3 * k;
        let change = if start { Vector3::zeros() } else { Vector3::from_column_slice(&strand.change[at..at + 3]) };
        Vector3::from_column_slice(&strand.q[at..at + 3]) + change
    });
    [d[0], d[0] + d[1] * third, d[2] - d[3] * third, d[2]]
}

/// Returns the box about two polygons, grown by a margin in m.
fn extent(polygons: &[[Vector3<f64>; 4]; 2], margin: f64) -> Extent {
    let (mut low, mut high) = (polygons[0][0], polygons[0][0]);
    for x in polygons.iter().flatten() {
        (low, high) = (low.inf(x), high.sup(x));
    }
    let margin = Vector3::repeat(margin);
    Extent { low: low - margin, high: high + margin }
}

/// Returns the direction of an element that is straight at both ends of the step.
fn direction(polygons: &[[Vector3<f64>; 4]; 2], third: f64) -> Option<Vector3<f64>> {
    let [start, ..] = polygons;
    let direction = (start[3] - start[0]).try_normalize(0.0)?;
    let is_along = |p: &[Vector3<f64>]| {
        let h = p[1] - p[0];
        let along = h.dot(&direction);
        along > 0.0 && along * along >= STRAIGHT * STRAIGHT * h.norm_squared().max(third * third)
    };
    polygons.iter().all(|polygon| polygon.windows(2).all(is_along)).then_some(direction)
}

/// Returns whether elements of a cable follow each other and are straight, so that they cannot
/// touch.
fn is_straight(elements: &[Boxed]) -> bool {
    let ([first, .., last] | [first @ last]) = elements else { return false };
    let follow = last.element - first.element + 1 == elements.len();
    let Some(all) = first.direction.zip(last.direction).and_then(|(a, b)| (a + b).try_normalize(0.0)) else {
        return false;
    };
    follow && elements.iter().all(|own| own.direction.is_some_and(|own| own.dot(&all) >= STRAIGHT))
}
