//! Where a cable lies straight across a round surface, closest points act in place of samples.
//!
//! # Equation
//!
//! Between two samples at a distance s a straight cable sinks by `s^2/8(R + r)` into a surface of
//! radius R: a body that slides along it goes over bumps, and pays an impact at each. The distance
//! |z| from the core has there a sharp minimum along the cable,
//!
//! ```text
//! |z(s)| = |z| + s^2/2|z|        and |z(s)| = |z| where the cable lies on the surface
//! ```
//!
//! Where it grows by more than half as much on both sides, a third of the element away, the closest
//! point acts, with the weight of a sample: at the depth d the cable touches within `sqrt(2 |z| d)`
//! beside it, some mm. Samples that are nearer to it than this third do not.
//!
//! # Validity
//!
//! Chosen when a step begins; a contact that was there in the last step stays down to a quarter, so
//! that it does not come and go. What changes from one to the other is born deep, and has an offset
//! ([`contact`](super)). A cable that crosses a cylinder at less than 45 degrees has samples.

use super::motion::Motion;
use super::pair::{PLACES, Pair, feature_place};
use super::point::ContactPoint;
use super::step::{ContactStep, find};
use crate::obstacle::Feature;
use crate::scales::contact::{RAMP, SPACINGS, STAYS_STRAIGHT, STRAIGHT_ACROSS, STRAIGHT_ALONE};

impl Pair<'_> {
    /// Returns how straight the cable is where a point of the element is nearest to a feature, if
    /// that is enough for a contact: the growth of the distance beside it, as a share of that of a
    /// straight cable across it.
    pub fn straightness(&self, feature: &Feature) -> Option<f64> {
        let (share, away) = (self.meeting(feature), self.section.length / SPACINGS);
        let distance = |pair: &Pair<'_>, xi: f64| feature.distance_squared(&pair.at(xi, share)).sqrt();
        let straight = |least: f64| 0.5 * away * away / least;
        // one that lies on the surface is known by three places: of a straight one they differ more
        let [from, middle, to] = [0.0, 0.5, 1.0].map(|xi| distance(self, xi));
        let (nearest, farthest) = (from.min(middle).min(to), from.max(middle).max(to));
        if farthest - nearest < STAYS_STRAIGHT * straight(nearest) {
            return None;
        }
        let xi = self.closest(feature, share)?;
        let least = distance(self, xi);
        let grows = |way: f64| self.beside(xi, way).map_or(f64::INFINITY, |(pair, xi)| distance(&pair, xi) - least);
        let share_of_straight = grows(-away).min(grows(away)) / straight(least);
        let known = find(self.motion.memory, self.key(feature_place(feature))).is_some();
        let limit = if known { STAYS_STRAIGHT } else { STRAIGHT_ACROSS };
        (share_of_straight > limit).then_some(share_of_straight)
    }

    /// Returns the element and the local coordinate at a way (m) along the cable from a point of
    /// this element, no farther than in the next one; `None` beyond an end.
    fn beside(&self, xi: f64, way: f64) -> Option<(Pair<'_>, f64)> {
        let (length, elements) = (self.section.length, &self.motion.model.elements);
        let arc = xi * length + way;
        let (element, from) = if arc < 0.0 {
            let element = self.element.checked_sub(1)?;
            (element, self.from - elements[element].length)
        } else if arc > length {
            (self.element + 1, self.from + length)
        } else {
            (self.element, self.from)
        };
        let section = elements.get(element).filter(|_| !self.motion.model.is_at_eye(element))?;
        let xi = (arc + self.from - from) / section.length;
        Some((Pair { element, section, from, ..*self }, xi.clamp(0.0, 1.0)))
    }

    /// Returns whether a feature is what a sample is nearest to, within a way (m) along the cable
    /// from an arc length.
    fn is_beside(&self, feature: &Feature, point: &ContactPoint, arc: f64, away: f64) -> bool {
        let near = (self.from + point.xi * self.section.length - arc).abs() < away;
        let distance = || feature.distance_squared(&self.at(point.xi, 0.0)).sqrt() - feature.radius;
        near && (distance() - point.distance).abs() < RAMP * self.radius
    }
}

impl ContactStep {
    /// Takes away the samples whose place closest points of round surfaces take.
    pub(super) fn leave_to_closest(&mut self, motion: &Motion<'_>) {
        for i in 0..self.points.len() {
            let closest = &self.points[i];
            let Some(nearby) = closest.nearby.map(|n| self.nearby[n]) else { continue };
            let alone = nearby.round.is_some_and(|straight| straight > STRAIGHT_ALONE);
            if !alone || closest.offset > RAMP * closest.reach {
                continue;
            }
            let length = motion.model.elements[nearby.element].length;
            let arc = nearby.from + closest.xi * length;
            for at in
                [Some(nearby), nearby.neighbour(motion, false), nearby.neighbour(motion, true)].into_iter().flatten()
            {
                let Some(pair) = self.pair(motion, &at) else { continue };
                let leaves = |point: &ContactPoint| {
                    let (element, _, place) = point.key;
                    let same = element as usize == at.element && point.obstacle == at.obstacle && place < PLACES;
                    same && !point.touched && pair.is_beside(&at.feature, point, arc, length / SPACINGS)
                };
                self.points.iter_mut().filter(|point| leaves(point)).for_each(|point| point.weight = 0.0);
                self.watched.retain(|point| !leaves(point));
            }
        }
        self.points.retain(|point| point.weight > 0.0);
    }
}
