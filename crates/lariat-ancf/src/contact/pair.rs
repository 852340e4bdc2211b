//! An element and an obstacle: the points of the one that can touch the other.

use super::evaluation::Row;
use super::glide::Glide;
use super::law::NormalLaw;
use super::motion::Motion;
use super::path::ObstacleStep;
use super::point::ContactPoint;
use crate::effect::Contact;
use crate::element::shape;
use crate::element::shape::combine;
use crate::model::Model;
use crate::obstacle::Obstacle;
use crate::obstacle::{Feature, Nearest};
use crate::scales::contact::{INTERVALS, LEAST_SHARE, MEETINGS, SECTIONS, SPACINGS, WIDE};
use crate::section::Element;
use crate::state::Key;
use nalgebra::Vector3;

/// Coefficient: the points of Lobatto's rule (five, exact to degree seven) with their shares of the
/// length of an element. The last is the first of the next element: only the last element of a
/// cable has its own.
const SAMPLES: [(f64, f64); 5] = [
    (0.0, 1.0 / 20.0),
    (0.172_673_164_646_011_43, 49.0 / 180.0),
    (0.5, 16.0 / 45.0),
    (0.827_326_835_353_988_6, 49.0 / 180.0),
    (1.0, 1.0 / 20.0),
];
/// Layout: number of samples of an element: features are numbered behind them.
pub(super) const PLACES: u32 = SAMPLES.len() as u32;

/// Returns the samples of an element: number, local coordinate, and the length that it stands for.
/// A node stands for parts of both of its elements, that of the one before by its stiffness.
pub(super) fn samples(contact: &Contact, model: &Model, element: usize) -> impl Iterator<Item = (u32, f64, f64)> {
    let elements = &model.elements;
    let own = elements[element];
    let stiffness = |element: &Element| contact.stiffness_of(&element.section);
    let neighbour = element.checked_sub(1).filter(|_| !model.begins_contact(element));
    let before = neighbour.map_or(0.0, |e| elements[e].length * stiffness(&elements[e]) / stiffness(&own));
    let last = model.ends_contact(element);
    let own_samples = SAMPLES.into_iter().enumerate().take(if last { SAMPLES.len() } else { SAMPLES.len() - 1 });
    own_samples.map(move |(place, (xi, share))| {
        let length = if place == 0 { own.length + before } else { own.length };
        (place as u32, xi, share * length)
    })
}

/// Returns the local coordinates a quarter, half and three quarters of the way between the samples
/// of an element: half way alone may be where a line turns that is deep on one side of it.
pub(crate) fn between_samples() -> impl Iterator<Item = f64> {
    let shares = [0.25, 0.5, 0.75];
    SAMPLES.windows(2).flat_map(move |pair| shares.map(|share| pair[0].0 + share * (pair[1].0 - pair[0].0)))
}

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
    pub fn key(&self, place: u32) -> Key {
        (self.element as u32, self.obstacle.key, place)
    }

    pub fn point(&self, place: u32, xi: f64, weight: f64) -> ContactPoint {
        let mut point = ContactPoint::default();
        self.place(&mut point, (place, xi, weight));
        point
    }

    /// Puts a new point to a place of the element, with the length that it stands for.
    pub fn place(&self, point: &mut ContactPoint, (place, xi, weight): (u32, f64, f64)) {
        (point.key, point.obstacle) = (self.key(place), self.number);
        (point.xi, point.weight) = (xi, weight);
        point.shape = shape::position(xi, self.section.length);
        point.law = NormalLaw::of(self.contact, &self.section.section);
        point.mass = self.section.section.mass_per_length;
        (point.friction, point.restitution) = (self.obstacle.friction, self.obstacle.restitution);
        point.reach = self.radius + self.obstacle.skin;
        point.start = combine(self.motion.q, self.element, &point.shape);
    }

    /// Returns a place of the element as a row of the matrix.
    pub fn row(&self, xi: f64) -> Row {
        let shape = shape::position(xi, self.section.length);
        Row { shape, start: combine(self.motion.q, self.element, &shape) }
    }

    /// Returns the tangent of the cable at a place of the element.
    pub fn glide(&self, xi: f64) -> Glide {
        Glide::new(xi, self.section.length, |shape| combine(self.motion.q, self.element, shape))
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

    /// Returns a point of the element that touches a feature.
    pub fn feature_point(&self, feature: &Feature, xi: f64) -> ContactPoint {
        let spacing = self.section.length / SPACINGS;
        let weight = if self.is_wide(feature.radius) { spacing } else { spacing.min(4.0 * self.radius) };
        self.point(feature_place(feature), xi, weight)
    }

    /// Returns where a point of the element is in the obstacle's axes, at a share of the step.
    pub fn at(&self, xi: f64, share: f64) -> Vector3<f64> {
        let (Motion { q, change, .. }, e) = (self.motion, self.element);
        let shape = shape::position(xi, self.section.length);
        let start = combine(q, e, &shape);
        let [y0, y1] = [self.step.start.own(&start), self.step.end.own(&(start + combine(change, e, &shape)))];
        y0 + (y1 - y0) * share
    }

    /// Returns the share of the step at which the element comes to a feature that it meets on its
    /// way: found by distances, which change no faster than the element moves. The end of the step
    /// if it moves less than it reaches, begins within reach, or does not meet it.
    pub fn meeting(&self, feature: &Feature) -> f64 {
        let reach = self.radius + self.obstacle.skin + feature.radius;
        let places: [f64; INTERVALS + 1] = core::array::from_fn(|i| i as f64 / INTERVALS as f64);
        let way = places.map(|xi| (self.at(xi, 1.0) - self.at(xi, 0.0)).norm()).into_iter().fold(0.0, f64::max);
        if way <= reach {
            return 1.0;
        }
        // how far a point can be nearer than the places on both sides of it
        let between = 0.6 * self.section.length / INTERVALS as f64;
        let mut share = 0.0;
        for _ in 0..MEETINGS {
            let nearest = places
                .map(|xi| feature.distance_squared(&self.at(xi, share)))
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            let gap = nearest.sqrt() - between - reach;
            if gap <= 0.0 {
                return if share > 0.0 { share } else { 1.0 };
            }
            share += (gap / way).max(LEAST_SHARE);
            if share >= 1.0 {
                break;
            }
        }
        1.0
    }

    /// Returns the local coordinate of the point of the element that is closest to a feature at a
    /// share of the step: at the end, as far as that is known, where the element moves slowly; the
    /// closest point at the beginning would slide off, and the cable sink in behind it. A node
    /// belongs to the element behind it, so that each minimum of the distance along the cable is
    /// found once.
    pub fn closest(&self, feature: &Feature, share: f64) -> Option<f64> {
        let (Motion { q, change, .. }, e) = (self.motion, self.element);
        let [start, end] = [&self.step.start, &self.step.end];
        let distance = |xi: f64| feature.distance_squared(&self.at(xi, share));
        // growth of the distance along the cable at a node, from the node alone: the same number
        // for both of its elements
        let growth = |node: usize| {
            let first = |x: usize| Vector3::from_column_slice(&q[6 * node + x..6 * node + x + 3]);
            let last = |x: usize| first(x) + Vector3::from_column_slice(&change[6 * node + x..6 * node + x + 3]);
            let y = start.own(&first(0)).lerp(&end.own(&last(0)), share);
            let slope = start.rotation.tr_mul(&first(3)).lerp(&end.rotation.tr_mul(&last(3)), share);
            (y - feature.core(&y)).dot(&slope)
        };
        let model = self.motion.model;
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
                0 if !falls(e) && !model.begins_contact(e) => continue,
                0 if !falls(e) => 0.0,
                INTERVALS if falls(e + 1) && !model.ends_contact(e) => continue,
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

/// Returns the number of a point of an element on a feature among those on an obstacle.
pub(super) fn feature_place(feature: &Feature) -> u32 {
    PLACES + feature.id
}

/// Returns whether samples see a round surface as smooth.
pub(super) fn is_wide(surface: f64, cable: f64, length: f64) -> bool {
    surface + cable >= WIDE * length / SPACINGS
}

/// Returns whether the closest points of elements alone act on a place of a surface. On a sharp one
/// act samples, too: one that slides off a face would else lose there what it carries.
pub(super) fn is_thin(found: &Nearest, radius: f64, length: f64) -> bool {
    found.feature && found.patch.radius().is_some_and(|own| own > 0.0 && !is_wide(own, radius, length))
}

/// Returns the Bezier points of an element of nodal vectors.
fn corners(x: &[f64], element: usize, length: f64) -> [Vector3<f64>; 4] {
    let d: [Vector3<f64>; 4] =
        core::array::from_fn(|k| Vector3::from_column_slice(&x[6 * element + 3 * k..6 * element + 3 * k + 3]));
    let third = length / 3.0;
    [d[0], d[0] + d[1] * third, d[2] - d[3] * third, d[2]]
}

/// Returns the centre and the radius of a ball about an element at coordinates.
pub(super) fn ball(q: &[f64], element: usize, length: f64) -> (Vector3<f64>, f64) {
    let places = corners(q, element, length);
    let centre = (places[0] + places[1] + places[2] + places[3]) * 0.25;
    (centre, places.iter().fold(0.0, |most: f64, p| most.max((p - centre).norm())))
}

/// Returns that ball when the step begins, and the largest way of the element in the first iterate.
pub(super) fn bounding_ball(motion: &Motion<'_>, element: usize, length: f64) -> (Vector3<f64>, f64, f64) {
    let (centre, size) = ball(motion.q, element, length);
    let ways = corners(motion.change, element, length);
    (centre, size, ways.iter().fold(0.0, |most: f64, w| most.max(w.norm())))
}

/// Returns where a function has its least value in an interval.
fn golden_section(f: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    /// Coefficient: of the golden section.
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
