//! Contacts with thin and sharp features stay at the closest point of their element while a step is iterated.
//!
//! # Equation
//!
//! A feature has one contact per element, with the energy `W(max over xi of d(xi; q))`, d the depth. Its force acts at the maximum, whose
//! own motion does no work. It turns the force, however: the full tangent of `W(max d)` has, besides that of a fixed point,
//!
//! ```text
//! N (S' n)(S' n)^T / D,    D = n . r'' + |r'_t|^2 / |z| > 0
//! ```
//!
//! S' the slope's shape functions, n the normal, r'_t the part of the slope that moves the nearest point around the core, z the vector from there. It is what resists an element
//! that rolls over the feature; without it the iteration swings from one point to another, the steps do too, and the cable sinks in.
//!
//! # Energy
//!
//! Wherever the point is at the end of a step, no energy is made: W grows with d and is convex, so with the point xi of the end
//! `W(d0(xi0)) - W(d1(xi)) + W'(d1)(d1 - d0(xi)) >= W(d0(xi0)) - W(d0(xi)) >= 0`, since xi0 was the maximum. The difference is lost.
//!
//! # Validity
//!
//! One maximum per element and feature. Where another one takes its place in a step the iteration may swing between both, and the step is
//! divided. While the point passes to the other side of the core in a step, it stays.

use super::find::{Motion, one_sided};
use super::missed::Nearby;
use super::pair::{Pair, feature_place};
use super::patch::Patch;
use super::point::{ContactPoint, combine};
use super::step::ContactStep;
use crate::element::shape;
use nalgebra::Vector3;

/// Least D beside the curvature of the feature: beyond it the element follows the feature's curvature, and every point is the closest.
const LEAST: f64 = 0.05;

/// How the closest point of an element moves with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Roll {
    /// Shape functions of the slope.
    pub slope: [f64; 4],
    /// 1/D in m.
    pub length: f64,
}

impl ContactStep {
    /// Moves contacts with features to the points that are closest at an iterate.
    pub(super) fn follow_closest(&mut self, motion: &Motion<'_>) {
        for i in 0..self.points.len() {
            let Some(nearby) = self.points[i].nearby.map(|n| self.nearby[n]) else { continue };
            let Some(pair) = self.pair(motion, &nearby) else { continue };
            if !stays_on_its_side(&self.points[i], &pair, &nearby) {
                continue;
            }
            match pair.closest(&nearby.feature, 1.0).filter(|xi| !pair.is_apart(*xi)) {
                Some(xi) => self.move_point(i, &pair, &nearby, xi),
                None => self.move_to_neighbour(motion, i, &nearby),
            }
        }
    }

    /// Moves a contact whose closest point has gone over a node.
    fn move_to_neighbour(&mut self, motion: &Motion<'_>, i: usize, nearby: &Nearby) {
        let lengths = &motion.model.elements;
        let before = nearby.element.checked_sub(1).map(|e| (e, nearby.from - lengths[e].length));
        let behind = (nearby.element + 1 < lengths.len())
            .then(|| (nearby.element + 1, nearby.from + lengths[nearby.element].length));
        for (element, from) in before.into_iter().chain(behind) {
            let other = Nearby { element, from, ..*nearby };
            let Some(pair) = self.pair(motion, &other) else { continue };
            let key = pair.key(feature_place(&nearby.feature));
            if self.points.iter().any(|point| point.key == key) {
                continue;
            }
            let Some(xi) = pair.closest(&nearby.feature, 1.0).filter(|xi| !pair.is_apart(*xi)) else { continue };
            if pair.feature_point(&nearby.feature, xi).weight == self.points[i].weight {
                let known = self.nearby.iter().position(|known| known.is_same(&other));
                self.points[i].nearby = Some(known.unwrap_or(self.nearby.len()));
                if known.is_none() {
                    self.nearby.push(other);
                }
                return self.move_point(i, &pair, &other, xi);
            }
        }
    }

    fn move_point(&mut self, i: usize, pair: &Pair<'_>, nearby: &Nearby, xi: f64) {
        let ContactPoint { nearby: n, recalls, linear, about, now, .. } = self.points[i];
        let mut point =
            ContactPoint { nearby: n, recalls, linear, about, now, ..pair.feature_point(&nearby.feature, xi) };
        let y = pair.step.start.own(&point.start);
        let Some((patch, z)) = nearby.feature.patch(&y) else { return };
        let memory = recalls.map(|i| &pair.motion.memory[i]);
        point.patch = one_sided(patch, (&y, &z), memory);
        point.distance = z.norm() - nearby.feature.radius;
        point.recall(&y, &pair.step, memory);
        point.close(self.closes);
        point.roll = roll(&point, pair, nearby);
        let old = &self.points[i];
        self.before += point.energy_before(&y) - old.energy_before(&pair.step.start.own(&old.start));
        self.points[i] = point;
    }
}

fn stays_on_its_side(point: &ContactPoint, pair: &Pair<'_>, nearby: &Nearby) -> bool {
    let (start, end) = point.way(&pair.step, pair.motion.change);
    let from_core = |y: &Vector3<f64>| y - nearby.feature.core(y);
    from_core(&start).dot(&from_core(&end)) > 0.0
}

/// Returns how the closest point of an element moves with it at the end of an iterate; `None` at its ends.
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
    let d = (normal.dot(&second) + curvature).max(LEAST * curvature);
    (d > 0.0).then(|| Roll { slope, length: 1.0 / d })
}
