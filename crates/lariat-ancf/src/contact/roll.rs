//! Contacts with thin and sharp features follow the closest point of their element while a step is
//! iterated.
//!
//! # Equation
//!
//! A feature has one contact per element, with the energy `W(max over xi of d(xi; q))`, d the
//! depth. Its force acts at the maximum, whose own motion does no work. It turns the force,
//! however: the full tangent of `W(max d)` has, besides that of a fixed point,
//!
//! ```text
//! N (S' n)(S' n)^T / D,    D = n . r'' + |r'_t|^2 / |z| > 0
//! ```
//!
//! S' the slope's shape functions, n the normal, r'_t the part of the slope that moves the nearest
//! point around the core, z the vector from there. It is what resists an element that rolls over
//! the feature; without it the iteration swings from one point to another, the steps do too, and
//! the cable sinks in.
//!
//! # Energy
//!
//! Wherever the point is at the end of a step, no energy is made: W grows with d and is convex, so
//! with the point xi of the end `W(d0(xi0)) - W(d1(xi)) + W'(d1)(d1 - d0(xi)) >= W(d0(xi0)) -
//! W(d0(xi)) >= 0`, since xi0 was the maximum. The difference is lost. The point where the contact
//! acts is therefore one between both, at which the difference is zero ([`slide`](super::slide));
//! it moves half as far as the maximum does, and so the force turns half as much.
//!
//! # Validity
//!
//! One maximum per element and feature. Where another one takes its place in a step the iteration
//! may swing between both, and the step is divided; an element that winds around a rod, longer than
//! its circumference, may carry it in two places at once, for which no division helps: such a host
//! step takes up to 2e5 iterations. While the point passes to the other side of the core in a step,
//! it stays.

use super::evaluation::Between;
use super::linear::Roll;
use super::motion::Motion;
use super::nearby::Nearby;
use super::pair::{Pair, feature_place};
use super::point::ContactPoint;
use super::slide::{Place, between, mean_point};
use super::step::ContactStep;
use crate::element::shape::{self, combine};
use crate::obstacle::Patch;
use crate::scales::contact::LEAST_DETERMINANT;

impl ContactStep {
    /// Moves contacts with features to where they act at an iterate: between the points that are
    /// closest at the beginning and at the end.
    pub(super) fn follow_closest(&mut self, motion: &Motion<'_>) {
        for i in 0..self.points.len() {
            let Some(n) = self.points[i].nearby else { continue };
            let nearby = self.nearby[n];
            let beside = [Some(nearby), nearby.neighbour(motion, false), nearby.neighbour(motion, true)];
            let weight = self.points[i].weight;
            let end = beside.into_iter().flatten().find_map(|at| {
                let pair = self.pair(motion, &at)?;
                let xi = pair.closest(&at.feature, 1.0).filter(|xi| !pair.is_apart(*xi))?;
                (pair.feature_point(&at.feature, xi).weight == weight).then_some((at, xi))
            });
            if let Some((at, xi)) = end {
                self.act_between(motion, i, (&at, xi));
            }
        }
    }

    /// Lets a contact act between the closest point at the beginning and the one at the end, `xi`
    /// of an element.
    fn act_between(&mut self, motion: &Motion<'_>, i: usize, (end, xi): (&Nearby, f64)) {
        let Some(pair) = self.pair(motion, end) else { return };
        let x1 = Place { pair: &pair, xi };
        let start = self.start(motion, self.points[i].nearby, end);
        let other =
            start.and_then(|(element, from, xi)| Some((self.pair(motion, &Nearby { element, from, ..*end })?, xi)));
        if let Some((pair, xi)) = &other {
            let places = [Place { pair, xi: *xi }, x1];
            if let Some((share, excess)) = mean_point(&places, &end.feature) {
                let place = between([&places[0], &places[1]], share);
                // half way to where the depth is, in the same element
                let along = place.xi + 0.5 * (places[1].arc() - place.arc()) / place.pair.section.length;
                let row = place.pair.row(along.clamp(0.0, 1.0));
                let normal = places[1].beside_core(&end.feature, 1.0).normalize();
                return self.move_point(i, (&place, end), Some(Between { excess, normal, row }));
            }
            if places[0].beside_core(&end.feature, 0.0).dot(&places[1].beside_core(&end.feature, 1.0)) <= 0.0 {
                return;
            }
            return self.move_point(i, (&places[1], end), None);
        }
        if x1.beside_core(&end.feature, 0.0).dot(&x1.beside_core(&end.feature, 1.0)) > 0.0 {
            self.move_point(i, (&x1, end), None);
        }
    }

    /// Returns the closest point when the step begins: element, where it begins, and local
    /// coordinate.
    fn start(&mut self, motion: &Motion<'_>, nearby: Option<usize>, end: &Nearby) -> Option<(usize, f64, f64)> {
        let known = nearby.map(|n| self.nearby[n]).filter(|known| known.is_same(end)).and_then(|known| known.start);
        if let Some(start) = known {
            return start;
        }
        let beside = [Some(*end), end.neighbour(motion, false), end.neighbour(motion, true)];
        let start = beside.into_iter().flatten().find_map(|at| {
            let xi = self.pair(motion, &at)?.closest(&at.feature, 0.0)?;
            Some((at.element, at.from, xi))
        });
        if let Some(n) = nearby.filter(|n| self.nearby[*n].is_same(end)) {
            self.nearby[n].start = Some(start);
        }
        start
    }

    /// Returns whether another contact than the i-th is one of an element with a feature.
    fn is_taken(&self, i: usize, element: usize, nearby: &Nearby) -> bool {
        let place = feature_place(&nearby.feature);
        let same = |point: &ContactPoint| {
            point.obstacle == nearby.obstacle && point.key.0 as usize == element && point.key.2 == place
        };
        self.points.iter().enumerate().any(|(k, point)| k != i && same(point))
    }

    /// Moves a contact to a place, where it acts between closest points, or at one.
    fn move_point(&mut self, i: usize, (place, nearby): (&Place<'_, '_>, &Nearby), between: Option<Between>) {
        let pair = place.pair;
        if self.is_taken(i, pair.element, nearby) {
            return;
        }
        let old = &self.points[i];
        let ContactPoint { nearby: n, recalls, linear, about, now, bound, renewed, rebound, .. } = *old;
        let before = old.energy_before();
        let mut point =
            ContactPoint { nearby: n, recalls, linear, about, now, ..pair.feature_point(&nearby.feature, place.xi) };
        let y = pair.step.start.own(&point.start);
        let Some((patch, z)) = nearby.feature.patch(&y) else { return };
        let memory = recalls.map(|i| &pair.motion.memory[i]);
        point.patch = pair.one_sided(&nearby.feature, (patch, y, z), memory);
        if point.patch == patch {
            point.between = between;
        }
        point.distance = z.norm() - nearby.feature.radius;
        point.recall(&y, &pair.step, memory);
        point.rebound = rebound;
        point.close(self.closes);
        if renewed {
            (point.bound, point.renewed) = (bound, true);
        }
        point.roll = roll(&point, pair, nearby);
        self.before += point.energy_before() - before;
        self.points[i] = point;
    }
}

/// Returns how the closest point of an element moves with it at the end of an iterate; `None` at
/// its ends.
fn roll(point: &ContactPoint, pair: &Pair<'_>, nearby: &Nearby) -> Option<Roll> {
    let (e, length) = (pair.element, pair.section.length);
    if point.xi <= 0.0 || point.xi >= 1.0 {
        return None;
    }
    let slope = shape::slope(point.xi, length);
    let own = |shape: &[f64; 4]| {
        let world = combine(pair.motion.q, e, shape) + combine(pair.motion.change, e, shape);
        pair.step.end.rotation.tr_mul(&world)
    };
    let (first, second) = (own(&slope), own(&shape::second_derivative(point.xi, length)));
    let (_, end) = point.way(&pair.step, pair.motion.change);
    let (patch, z) = nearby.feature.patch(&end)?;
    let normal = z.try_normalize(0.0)?;
    let around = match patch {
        Patch::Line { direction, .. } => first - normal * normal.dot(&first) - direction * direction.dot(&first),
        _ => first - normal * normal.dot(&first),
    };
    let curvature = around.norm_squared() / z.norm();
    let d = (normal.dot(&second) + curvature).max(LEAST_DETERMINANT * curvature);
    let share = if point.between.is_some() { 0.5 } else { 1.0 };
    (d > 0.0).then(|| Roll { slope, length: 1.0 / d, share })
}
