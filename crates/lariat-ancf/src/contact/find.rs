//! Where contacts are: samples on faces, closest points on features, found when a step begins and completed while it is iterated.
//!
//! # Validity
//!
//! An element is looked at if the ball about the Bezier polygon of its curve, grown by 1.5 times its way relative to the obstacle, comes near. What a
//! point cannot reach in the way that it moves (distances grow no faster than the way) is not looked at again; the rest is traced along its
//! way to the surface, at every iterate.
//!
//! # References
//!
//! Hart, The Visual Computer 12 (1996) 527 (tracing by distances).

use super::memory::{ContactMemory, Key};
use super::obstacle::{Obstacle, ObstacleStep};
use super::patch::Patch;
use super::point::{About, ContactPoint, Evaluation, Linear, combine};
use super::step::{ContactStep, find};
use super::surface::{Feature, Nearest, Surface};
use crate::effect::Contact;
use crate::element::shape;
use crate::model::Model;
use crate::section::Element;
use nalgebra::Vector3;

/// Gauss points of an element (three, exact to degree five) with their weights.
const SAMPLES: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
/// Gap in radii of the cable below which a sample is a contact.
const NEAR: f64 = 2.0;
/// Gap in radii of the cable from which on a feature has one: a contact that begins deep has an offset.
const NEAR_FEATURE: f64 = 4.0;
/// Factor on the way that is expected in a step.
const SWEEP: f64 = 1.5;
/// A round surface is smooth for samples if its radius, with the cable's, is so many of their spacings.
const WIDE: f64 = 2.0;
/// Intervals in which the closest point of an element is looked for.
const INTERVALS: usize = 8;
/// Steps of the golden section.
const SECTIONS: usize = 32;
/// Steps along the way to a surface.
const TRACES: usize = 64;
/// Least step of these, as a share of the distance at which the surface is met.
const PAST: f64 = 0.02;

/// A step of a cable, as the search sees it.
pub(crate) struct Motion<'a> {
    pub model: &'a Model,
    pub time: f64,
    pub h: f64,
    pub q: &'a [f64],
    /// Change of the coordinates in the first iterate.
    pub change: &'a [f64],
    pub memory: &'a [ContactMemory],
}

/// An element and an obstacle.
struct Pair<'a> {
    motion: &'a Motion<'a>,
    contact: &'a Contact,
    element: usize,
    section: &'a Element,
    number: usize,
    obstacle: &'a Obstacle,
    step: ObstacleStep,
    /// Radius of the cable in m.
    radius: f64,
}

impl ContactStep {
    /// Begins a step.
    pub fn begin(&mut self, motion: &Motion<'_>) {
        self.points.clear();
        self.watched.clear();
        self.before = 0.0;
        let Some(contact) = &motion.model.effects.contact else { return };
        let obstacles = &motion.model.obstacles.0;
        if obstacles.is_empty() {
            return;
        }
        self.h = motion.h;
        self.obstacles.clear();
        self.obstacles.extend(obstacles.iter().map(|o| ObstacleStep::new(&o.motion, motion.time, motion.h)));
        self.recalled.clear();
        self.recalled.resize(motion.memory.len(), false);
        for (element, section) in motion.model.elements.iter().enumerate() {
            let (centre, size, way) = bounding_ball(motion, element, section.length);
            let radius = contact.radius_of(&section.section);
            for (number, obstacle) in obstacles.iter().enumerate() {
                let step = self.obstacles[number];
                let way = SWEEP * (way + motion.h * step.speed(&centre, size));
                let near = size + radius * (1.0 + NEAR_FEATURE) + obstacle.skin + way;
                let own = step.start.own(&centre);
                if !comes_near(&*obstacle.surface, &own, near) {
                    continue;
                }
                let pair = Pair { motion, contact, element, section, number, obstacle, step, radius };
                self.add_samples(&pair);
                obstacle.surface.features(&own, near, &mut |feature| {
                    let limit = near + feature.radius;
                    if feature.distance_squared(&own) <= limit * limit {
                        self.add_feature(&pair, &feature);
                    }
                });
            }
        }
        self.hand_over(motion.memory);
        for point in &self.points {
            let y = self.obstacles[point.obstacle].start.own(&point.start);
            self.before += point.energy_before(&y);
        }
    }

    /// Adds the samples of an element that are near an obstacle.
    fn add_samples(&mut self, pair: &Pair<'_>) {
        for (place, (xi, weight)) in SAMPLES.into_iter().enumerate() {
            let mut point = pair.point(place as u32, xi, weight * pair.section.length);
            let y = pair.step.start.own(&point.start);
            let nearest = pair.obstacle.surface.nearest(&y);
            point.distance = nearest.distance;
            let index = find(pair.motion.memory, point.key);
            let memory = index.map(|i| &pair.motion.memory[i]);
            if let Some(kept) = memory.filter(|memory| is_behind(&memory.patch, &y, &nearest)) {
                point.patch = kept.patch;
            } else {
                point.patch = nearest.patch;
                if pair.is_thin(&nearest) || nearest.distance - point.reach > NEAR * pair.radius {
                    let end = pair.step.end.own(&(point.start + point.change(pair.motion.change)));
                    match trace(&*pair.obstacle.surface, [&y, &end], point.reach, |found| !pair.is_thin(found)) {
                        Some(met) => point.patch = met.patch,
                        None => {
                            self.watched.push(point);
                            continue;
                        }
                    }
                }
            }
            point.recall(&y, memory);
            index.into_iter().for_each(|i| self.recalled[i] = true);
            self.points.push(point);
        }
    }

    /// Adds the closest point of an element on a feature, if it has one that is near.
    fn add_feature(&mut self, pair: &Pair<'_>, feature: &Feature) {
        if pair.is_wide(feature.radius) {
            return;
        }
        let Some(xi) = pair.closest(feature) else { return };
        let length = pair.section.length;
        let weight = (length / SAMPLES.len() as f64).min(4.0 * pair.radius);
        let mut point = pair.point(SAMPLES.len() as u32 + feature.id, xi, weight);
        let y = pair.step.start.own(&point.start);
        let Some((patch, z)) = feature.patch(&y) else { return };
        let end = pair.step.end.own(&(point.start + point.change(pair.motion.change)));
        point.distance = z.norm() - feature.radius;
        if point.distance - point.reach > NEAR_FEATURE * pair.radius + SWEEP * (end - y).norm() {
            return;
        }
        let index = find(pair.motion.memory, point.key);
        let memory = index.map(|i| &pair.motion.memory[i]);
        point.patch = match memory.filter(|memory| memory.normal.dot(&z) < 0.0) {
            Some(memory) => Patch::Plane { point: y - z, normal: memory.normal },
            None => patch,
        };
        point.recall(&y, memory);
        index.into_iter().for_each(|i| self.recalled[i] = true);
        self.points.push(point);
    }

    /// Hands what a feature remembers of one element to its neighbour, where the closest point has moved over their node.
    fn hand_over(&mut self, memory: &[ContactMemory]) {
        for point in self.points.iter_mut().filter(|point| point.key.2 >= SAMPLES.len() as u32) {
            let (element, obstacle, place) = point.key;
            if find(memory, point.key).is_some() {
                continue;
            }
            let neighbours = [element.checked_sub(1), element.checked_add(1)];
            let left = neighbours.into_iter().flatten().filter_map(|e| find(memory, (e, obstacle, place)));
            for i in left {
                if !self.recalled[i] && memory[i].weight == point.weight {
                    self.recalled[i] = true;
                    let y = self.obstacles[point.obstacle].start.own(&point.start);
                    point.recall(&y, Some(&memory[i]));
                    break;
                }
            }
        }
    }

    /// Adds samples that an iterate carries into an obstacle although they were not near, or on another way than expected.
    pub fn complete(&mut self, model: &Model, change: &[f64]) {
        let Some(contact) = &model.effects.contact else { return };
        let surface = |point: &ContactPoint| &*model.obstacles.0[point.obstacle].surface;
        let thin = |point: &ContactPoint, found: &Nearest| {
            let element = &model.elements[point.key.0 as usize];
            is_thin(found, contact.radius_of(&element.section), element.length)
        };
        let meets = |point: &ContactPoint, obstacle: &ObstacleStep| {
            let (y0, y1) = point.way(obstacle, change);
            if (y1 - y0).norm() <= point.distance - point.reach {
                return None;
            }
            let met = trace(surface(point), [&y0, &y1], point.reach, |found| !thin(point, found))?;
            (met.patch.gap(&y1).0 < point.reach).then_some((met.patch, y0))
        };
        for point in self.points.iter_mut().filter(|point| point.key.2 < SAMPLES.len() as u32) {
            let obstacle = &self.obstacles[point.obstacle];
            let deep = |patch: &Patch, y: &Vector3<f64>| patch.gap(y).0 < point.reach;
            let (y0, y1) = point.way(obstacle, change);
            if !deep(&point.patch, &y0)
                && !deep(&point.patch, &y1)
                && let Some((patch, _)) = meets(point, obstacle)
            {
                point.patch = patch;
            }
        }
        let mut i = 0;
        while i < self.watched.len() {
            let mut point = self.watched[i];
            match meets(&point, &self.obstacles[point.obstacle]) {
                None => i += 1,
                Some((patch, y0)) => {
                    self.watched.swap_remove(i);
                    point.patch = patch;
                    point.recall(&y0, None);
                    self.points.push(point);
                }
            }
        }
    }
}

impl ContactPoint {
    /// Returns its place in the obstacle's axes at the beginning and at the end of an iterate.
    fn way(&self, obstacle: &ObstacleStep, change: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
        (obstacle.start.own(&self.start), obstacle.end.own(&(self.start + self.change(change))))
    }
}

impl Pair<'_> {
    fn point(&self, place: u32, xi: f64, weight: f64) -> ContactPoint {
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
            distance: 0.0,
            start: combine(self.motion.q, self.element, &shape),
            spring: Vector3::zeros(),
            bound: 0.0,
            linear: Linear::default(),
            about: About::default(),
            now: Evaluation::default(),
        }
    }

    fn is_wide(&self, radius: f64) -> bool {
        is_wide(radius, self.radius, self.section.length)
    }

    fn is_thin(&self, found: &Nearest) -> bool {
        is_thin(found, self.radius, self.section.length)
    }

    /// Returns the local coordinate of the point of the element that will be closest to a feature at the end of the step, as far as that is
    /// known: the closest point at the beginning would slide off, and the cable sink in behind it. A node belongs to the element behind
    /// it, so that each minimum of the distance along the cable is found once.
    fn closest(&self, feature: &Feature) -> Option<f64> {
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
fn is_wide(surface: f64, cable: f64, length: f64) -> bool {
    surface + cable >= WIDE * length / SAMPLES.len() as f64
}

/// Returns whether the closest points of elements act on a place of a surface, not samples.
fn is_thin(found: &Nearest, radius: f64, length: f64) -> bool {
    found.feature && found.patch.radius().is_some_and(|own| !is_wide(own, radius, length))
}

/// Returns whether a point that touched a patch is behind it, so that it keeps it.
fn is_behind(patch: &Patch, y: &Vector3<f64>, nearest: &Nearest) -> bool {
    let (gap, normal) = patch.gap(y);
    gap < 0.0 && (nearest.distance < 0.0 || nearest.patch.gap(y).1.dot(&normal) < 0.0)
}

/// Returns whether a ball comes near a surface.
fn comes_near(surface: &dyn Surface, centre: &Vector3<f64>, radius: f64) -> bool {
    match surface.bounds() {
        Some([low, high]) => {
            let outside = (low - centre).sup(&(centre - high)).sup(&Vector3::zeros());
            outside.norm_squared() <= radius * radius
        }
        None => surface.nearest(centre).distance <= radius,
    }
}

/// Returns the surface where the way from `start` to `end` comes within `reach` of a part that `counts`; past others it goes on.
fn trace(
    surface: &dyn Surface,
    [start, end]: [&Vector3<f64>; 2],
    reach: f64,
    counts: impl Fn(&Nearest) -> bool,
) -> Option<Nearest> {
    let way = end - start;
    let length = way.norm();
    let (mut done, close) = (0.0, 0.02 * reach);
    for _ in 0..TRACES {
        if done >= length {
            return None;
        }
        let nearest = surface.nearest(&(start + way * (done / length)));
        let gap = nearest.distance - reach;
        if gap <= close && counts(&nearest) {
            return Some(nearest);
        }
        done += gap.max(PAST * reach);
    }
    let nearest = surface.nearest(end);
    (nearest.distance <= reach && counts(&nearest)).then_some(nearest)
}

/// Returns the centre and the radius of a ball about an element, and its largest way in the first iterate.
fn bounding_ball(motion: &Motion<'_>, element: usize, length: f64) -> (Vector3<f64>, f64, f64) {
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
