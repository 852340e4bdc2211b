//! An element and an obstacle: the points of the one that can touch the other.

use super::find::Motion;
use super::memory::Key;
use super::obstacle::Obstacle;
use super::patch::Patch;
use super::path::ObstacleStep;
use super::point::{About, ContactPoint, Evaluation, Linear, combine};
use super::surface::{Feature, Nearest};
use crate::effect::Contact;
use crate::element::shape;
use crate::section::Element;
use nalgebra::Vector3;

/// Gauss points of an element (three, exact to degree five) with their weights.
pub(super) const SAMPLES: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
/// A round surface is smooth for samples if its radius, with the cable's, is so many of their spacings.
const WIDE: f64 = 2.0;
/// Intervals in which the closest point of an element is looked for.
const INTERVALS: usize = 8;
/// Steps of the golden section.
const SECTIONS: usize = 32;

/// An element and an obstacle.
pub(super) struct Pair<'a> {
    pub motion: &'a Motion<'a>,
    pub contact: &'a Contact,
    pub element: usize,
    pub section: &'a Element,
    /// Arc length in m at which the element begins.
    pub from: f64,
    pub number: usize,
    pub obstacle: &'a Obstacle,
    pub step: ObstacleStep,
    /// Radius of the cable in m.
    pub radius: f64,
}

impl Pair<'_> {
    pub fn point(&self, place: u32, xi: f64, weight: f64) -> ContactPoint {
        let key: Key = (self.element as u32, self.obstacle.key, place);
        let shape = shape::position(xi, self.section.length);
        ContactPoint {
            key,
            obstacle: self.number,
            xi,
            shape,
            weight,
            law: self.contact.law_of(&self.section.section),
            friction: self.obstacle.friction,
            reach: self.radius + self.obstacle.skin,
            patch: Patch::Point { point: Vector3::zeros(), radius: 0.0 },
            offset: 0.0,
            closing: 0.0,
            distance: 0.0,
            start: combine(self.motion.q, self.element, &shape),
            spring: Vector3::zeros(),
            bound: 0.0,
            linear: Linear::default(),
            about: About::default(),
            now: Evaluation::default(),
        }
    }

    /// Returns whether a point of the element does not touch the obstacle.
    pub fn is_apart(&self, xi: f64) -> bool {
        self.obstacle.excepts(self.from + xi * self.section.length)
    }

    pub fn is_wide(&self, radius: f64) -> bool {
        is_wide(radius, self.radius, self.section.length)
    }

    pub fn is_thin(&self, found: &Nearest) -> bool {
        is_thin(found, self.radius, self.section.length)
    }

    /// Returns the local coordinate of the point of the element that will be closest to a feature at the end of the step, as far as that is
    /// known: the closest point at the beginning would slide off, and the cable sink in behind it. A node belongs to the element behind
    /// it, so that each minimum of the distance along the cable is found once.
    pub fn closest(&self, feature: &Feature) -> Option<f64> {
        let (Motion { q, change, .. }, e, length) = (self.motion, self.element, self.section.length);
        let end = &self.step.end;
        let at = |xi: f64| {
            let shape = shape::position(xi, length);
            end.own(&(combine(q, e, &shape) + combine(change, e, &shape)))
        };
        let distance = |xi: f64| feature.distance_squared(&at(xi));
        // growth of the distance along the cable at a node, from the node alone: the same number for both of its elements
        let growth = |node: usize| {
            let moved = |x: usize| Vector3::from_fn(|k, _| q[6 * node + x + k] + change[6 * node + x + k]);
            let y = end.own(&moved(0));
            (y - feature.core(&y)).dot(&end.rotation.tr_mul(&moved(3)))
        };
        let last = self.motion.model.elements.len() - 1;
        let mut best: Option<(f64, f64)> = None;
        let mut d = [0.0; INTERVALS + 1];
        for (i, d) in d.iter_mut().enumerate() {
            *d = distance(i as f64 / INTERVALS as f64);
        }
        for i in 0..=INTERVALS {
            let (low, high) = (i.saturating_sub(1), (i + 1).min(INTERVALS));
            if d[i] > d[low] || d[i] > d[high] {
                continue;
            }
            let falls = |node: usize| growth(node) <= 0.0;
            let xi = match i {
                0 if !falls(e) && e > 0 => continue,
                0 if !falls(e) => 0.0,
                INTERVALS if falls(e + 1) && e < last => continue,
                INTERVALS if falls(e + 1) => 1.0,
                _ => golden_section(&distance, low as f64 / INTERVALS as f64, high as f64 / INTERVALS as f64),
            };
            let least = distance(xi);
            if best.is_none_or(|(_, d)| least < d) {
                best = Some((xi, least));
            }
        }
        best.map(|(xi, _)| xi)
    }
}

/// Returns whether samples see a round surface as smooth.
pub(super) fn is_wide(surface: f64, cable: f64, length: f64) -> bool {
    surface + cable >= WIDE * length / SAMPLES.len() as f64
}

/// Returns whether the closest points of elements act on a place of a surface, not samples.
pub(super) fn is_thin(found: &Nearest, radius: f64, length: f64) -> bool {
    found.feature && found.patch.radius().is_some_and(|own| !is_wide(own, radius, length))
}

/// Returns the centre and the radius of a ball about an element, and its largest way in the first iterate.
pub(super) fn bounding_ball(motion: &Motion<'_>, element: usize, length: f64) -> (Vector3<f64>, f64, f64) {
    let corners = |x: &[f64]| {
        let d: [Vector3<f64>; 4] =
            core::array::from_fn(|k| Vector3::from_column_slice(&x[6 * element + 3 * k..6 * element + 3 * k + 3]));
        let third = length / 3.0;
        [d[0], d[0] + d[1] * third, d[2] - d[3] * third, d[2]]
    };
    let (places, ways) = (corners(motion.q), corners(motion.change));
    let centre = (places[0] + places[1] + places[2] + places[3]) * 0.25;
    let size = places.iter().fold(0.0, |most: f64, p| most.max((p - centre).norm()));
    (centre, size, ways.iter().fold(0.0, |most: f64, w| most.max(w.norm())))
}

/// Returns where a function has its least value in an interval.
fn golden_section(f: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (high - SHARE * (high - low), low + SHARE * (high - low));
    let (mut fa, mut fb) = (f(a), f(b));
    for _ in 0..SECTIONS {
        if fa <= fb {
            (high, b, fb) = (b, a, fa);
            a = high - SHARE * (high - low);
            fa = f(a);
        } else {
            (low, a, fa) = (a, b, fb);
            b = low + SHARE * (high - low);
            fb = f(b);
        }
    }
    0.5 * (low + high)
}
