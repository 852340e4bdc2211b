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
//! The tree is of boxes that are wider, by what the element moves in eight steps, and by the
//! directions d of that time: as long as each polygon is in its own, and along its own d, no others
//! can be near than those that were found then.
//!
//! # Validity
//!
//! The tree is over elements in their order along the cables, which are near in space where they
//! are near in order. A test of two of its boxes costs the same whether they are of one element or
//! of many, so a cable that is near nothing costs some four tests per element where the tree is
//! made, and none while it is kept. What is found near does not depend on when it was made.
//!
//! # References
//!
//! Volino & Magnenat-Thalmann, Computer Graphics Forum 13 (1994) C155 (a surface whose normals are
//! in a cone does not meet itself).

use super::chords::Strand;
use super::strands::Strands;
use crate::scales::contact::{KEPT_STEPS, NEAR_PAIR, STAYS_ALONG, STRAIGHT};
use core::ops::ControlFlow;
use nalgebra::Vector3;

/// An element of a strand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub strand: usize,
    pub element: usize,
    /// Arc length in m at which it begins.
    pub from: f64,
    pub radius: f64,
    /// A third of its length in m.
    third: f64,
}

/// An element with the box that it stays in.
#[derive(Clone, Copy, Debug)]
struct Kept {
    place: Place,
    /// About its polygons, with a margin.
    extent: Extent,
    /// The direction along which it stays, if it was straight.
    direction: Option<Vector3<f64>>,
}

/// Box and direction of an element over a step.
#[derive(Clone, Copy, Debug)]
struct Boxed {
    extent: Extent,
    direction: Option<Vector3<f64>>,
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

    /// Returns the box about two polygons, grown by a margin in m.
    fn about(polygons: &[Polygon; 2], margin: f64) -> Extent {
        let (mut low, mut high) = (polygons[0][0], polygons[0][0]);
        for x in polygons.iter().flatten() {
            (low, high) = (low.inf(x), high.sup(x));
        }
        Extent { low, high }.grown(margin)
    }

    fn grown(&self, margin: f64) -> Extent {
        let margin = Vector3::repeat(margin);
        Extent { low: self.low - margin, high: self.high + margin }
    }

    fn with(&self, other: &Extent) -> Extent {
        Extent { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    fn holds(&self, x: &Vector3<f64>) -> bool {
        (0..3).all(|k| self.low[k] <= x[k] && x[k] <= self.high[k])
    }

    fn meets(&self, other: &Extent) -> bool {
        (0..3).all(|x| other.high[x] >= self.low[x] && self.high[x] >= other.low[x])
    }
}

/// Buffers of the search for elements.
#[derive(Clone, Debug, Default)]
pub(super) struct Boxes {
    kept: Vec<Kept>,
    /// Those of the tree: the children of number k are 2 k and 2 k + 1, the leaves its last half.
    tree: Vec<Extent>,
    open: Vec<[usize; 2]>,
    /// Elements that can come near each other while all stay in their boxes.
    close: Vec<[usize; 2]>,
    /// What was asked for of this step.
    now: Vec<Option<Boxed>>,
    /// Elements that can touch: the first of two is the one that keeps their contacts.
    pub near: Vec<[Place; 2]>,
}

impl Boxes {
    /// Finds the elements that are near each other at some time of the step, and returns the number
    /// of tests.
    pub fn find(&mut self, strands: &Strands<'_, '_>) -> u64 {
        let made = if self.stay(strands) { 0 } else { self.make(strands) };
        self.near.clear();
        self.now.clear();
        self.now.resize(self.kept.len(), None);
        for k in 0..self.close.len() {
            let [i, j] = self.close[k];
            let own = [i, j].map(|i| self.kept[i].place);
            let meet = self.boxed(strands, i).extent.meets(&self.boxed(strands, j).extent);
            let may = || strands.coefficients(own[0].strand, own[1].strand).is_some();
            if meet && may() && !self.is_straight(strands, [i, j]) {
                let [one, other] = own;
                self.near.push(if is_first(strands, &one, &other) { own } else { [other, one] });
            }
        }
        let name = |own: &Place| (own.strand, own.element);
        self.near.sort_unstable_by_key(|[a, b]| (name(a), name(b)));
        made + self.close.len() as u64
    }

    /// Returns whether the elements are those of the tree, and each stays in its box and along its
    /// direction over the step.
    fn stay(&self, strands: &Strands<'_, '_>) -> bool {
        let mut known = self.kept.iter();
        let stays = visit(strands, |strand, place| {
            let stays = known.next().is_some_and(|own| own.place == place && own.stays(strand));
            if stays { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        stays.is_continue() && known.next().is_none()
    }

    /// Makes the tree and finds what may come near; returns the number of tests.
    fn make(&mut self, strands: &Strands<'_, '_>) -> u64 {
        self.kept.clear();
        let kept = &mut self.kept;
        let _ = visit(strands, |strand, place| {
            kept.push(Kept::new(strand, place));
            ControlFlow::Continue(())
        });
        self.close.clear();
        if self.kept.is_empty() {
            return 0;
        }
        let leaves = self.kept.len().next_power_of_two();
        self.tree.clear();
        self.tree.resize(2 * leaves, Extent::NONE);
        for (leaf, own) in self.tree[leaves..].iter_mut().zip(&self.kept) {
            *leaf = own.extent.grown(own.place.near());
        }
        for k in (1..leaves).rev() {
            self.tree[k] = self.tree[2 * k].with(&self.tree[2 * k + 1]);
        }
        self.descend(leaves)
    }

    /// Finds the leaves whose boxes meet, and returns the number of tests.
    fn descend(&mut self, leaves: usize) -> u64 {
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
            let (i, j) = ((k - leaves).min(l - leaves), (k - leaves).max(l - leaves));
            let run = self.kept[i..=j].iter().map(|own| own.direction);
            if !(self.follow([i, j]) && are_straight(run)) {
                self.close.push([i, j]);
            }
        }
        tests
    }

    /// Returns whether two elements are of one cable, and those between them follow each other.
    fn follow(&self, [i, j]: [usize; 2]) -> bool {
        let [first, last] = [i, j].map(|i| self.kept[i].place);
        first.strand == last.strand && last.element - first.element == j - i
    }

    /// Returns whether two elements of a cable follow each other and are straight over the step, so
    /// that they cannot touch.
    fn is_straight(&mut self, strands: &Strands<'_, '_>, [i, j]: [usize; 2]) -> bool {
        self.follow([i, j]) && {
            (i..=j).for_each(|k| _ = self.boxed(strands, k));
            are_straight(self.now[i..=j].iter().map(|own| own.and_then(|own| own.direction)))
        }
    }

    /// Returns the box of an element over the step.
    fn boxed(&mut self, strands: &Strands<'_, '_>, i: usize) -> Boxed {
        let place = &self.kept[i].place;
        *self.now[i].get_or_insert_with(|| {
            let polygons = place.polygons(&(strands.get)(place.strand));
            let direction = direction(&polygons, place.third, STRAIGHT);
            Boxed { extent: Extent::about(&polygons, place.near()), direction }
        })
    }
}

impl Kept {
    /// Makes the box of an element, wider than it needs now by its way in some steps, and at least
    /// by its radius.
    fn new(strand: &Strand<'_>, place: Place) -> Kept {
        let polygons = place.polygons(strand);
        let way = polygons[0].iter().zip(&polygons[1]).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max);
        let margin = (KEPT_STEPS * way).min(1.5 * place.third).max(place.radius);
        Kept {
            place,
            extent: Extent::about(&polygons, margin),
            direction: direction(&polygons, place.third, STAYS_ALONG),
        }
    }

    /// Returns whether the element stays in its box and along its direction.
    fn stays(&self, strand: &Strand<'_>) -> bool {
        let third = self.place.third;
        self.place.polygons(strand).iter().all(|polygon| {
            polygon.iter().all(|x| self.extent.holds(x))
                && self.direction.is_none_or(|along| is_along(polygon, &along, third, STRAIGHT))
        })
    }
}

impl Place {
    /// Returns from which distance in m on it counts as near.
    fn near(&self) -> f64 {
        self.radius * (1.0 + NEAR_PAIR)
    }

    /// Returns its Bezier points at the beginning and at the end of the step.
    fn polygons(&self, strand: &Strand<'_>) -> [Polygon; 2] {
        let (third, at) = (self.third, 6 * self.element);
        let read = |x: &[f64], k: usize| Vector3::from_column_slice(&x[at + 3 * k..at + 3 * k + 3]);
        let points = |d: [Vector3<f64>; 4]| [d[0], d[0] + d[1] * third, d[2] - d[3] * third, d[2]];
        let start: [Vector3<f64>; 4] = core::array::from_fn(|k| read(strand.q, k));
        let end = core::array::from_fn(|k| start[k] + read(strand.change, k));
        [points(start), points(end)]
    }
}

/// The Bezier points of an element.
type Polygon = [Vector3<f64>; 4];

/// Visits all elements that can touch others.
fn visit(strands: &Strands<'_, '_>, mut f: impl FnMut(&Strand<'_>, Place) -> ControlFlow<()>) -> ControlFlow<()> {
    for c in 0..strands.count {
        let strand = (strands.get)(c);
        let Some(contact) = strand.model.effects.contact.filter(|_| strands.may_touch(c)) else { continue };
        let mut from = 0.0;
        for (e, element) in strand.model.elements.iter().enumerate() {
            if !strand.model.is_at_eye(e) {
                let (radius, third) = (contact.radius_of(&element.section), element.length / 3.0);
                f(&strand, Place { strand: c, element: e, from, radius, third })?;
            }
            from += element.length;
        }
    }
    ControlFlow::Continue(())
}

/// Returns whether the first of two elements is the one that keeps their contacts.
fn is_first(strands: &Strands<'_, '_>, a: &Place, b: &Place) -> bool {
    let key = |own: &Place| ((strands.get)(own.strand).key, own.strand, own.element);
    key(a) < key(b)
}

/// Returns the direction of an element that is straight at both ends of the step, with this least
/// cosine.
fn direction(polygons: &[Polygon; 2], third: f64, least: f64) -> Option<Vector3<f64>> {
    let [start, ..] = polygons;
    let direction = (start[3] - start[0]).try_normalize(0.0)?;
    polygons.iter().all(|polygon| is_along(polygon, &direction, third, least)).then_some(direction)
}

/// Returns whether an element is straight along a direction, with this least cosine.
fn is_along(polygon: &Polygon, direction: &Vector3<f64>, third: f64, least: f64) -> bool {
    polygon.windows(2).all(|p| {
        let h = p[1] - p[0];
        let along = h.dot(direction);
        along > 0.0 && along * along >= least * least * h.norm_squared().max(third * third)
    })
}

/// Returns whether elements that follow each other are straight and in line, by their directions.
fn are_straight(directions: impl DoubleEndedIterator<Item = Option<Vector3<f64>>> + Clone) -> bool {
    let ends = directions.clone().next().flatten().zip(directions.clone().next_back().flatten());
    let Some(all) = ends.and_then(|(a, b)| (a + b).try_normalize(0.0)) else { return false };
    directions.into_iter().all(|own| own.is_some_and(|own| own.dot(&all) >= STRAIGHT))
}
