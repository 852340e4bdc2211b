//! What a step did to thin and sharp features beside the contacts that were found when it began.
//!
//! # Equation
//!
//! Whether an element touches a feature is found from the predicted motion (pair.rs). Where the
//! motion turns out otherwise, one that has no contact may be inside the feature when the iteration
//! ends, deeper than the contacts of its neighbours are:
//!
//! ```text
//! r - g(S(xi) (q + D q)) > max over contacts of d + 0.02 r        at the xi nearest to the feature at the end of the step
//! ```
//!
//! Then this point becomes a contact too, and the iteration goes on. An element that went through
//! the core of a feature, a segment, is beyond that: its chords and the segment meet as those of
//! two cables do (pairs/crossing.rs), and the step is divided. Where a cable does not touch an
//! obstacle, because it is tied to it there, it is not asked: at the face of a cylinder, on its
//! axis, it goes through the end of that in every step.
//!
//! # Validity
//!
//! A contact is added up to three times per step; what is inside then is inside in the next step,
//! too, and its depth an offset. Balls and circles are not asked whether an element went through
//! them. A step that the plane of a contact braked is divided, too; nothing passed anything there.

use super::motion::Motion;
use super::nearby::Nearby;
use super::pair::{PLACES, Pair, feature_place};
use super::pairs::crossing;
use super::path::ObstacleStep;
use super::place::Place;
use super::point::ContactPoint;
use super::step::ContactStep;
use crate::obstacle::FeatureShape;
use crate::scales::contact::{CHORDS, RAMP};
use nalgebra::Vector3;

impl ContactStep {
    /// Adds the points that are inside a feature at the end of an iterate, deeper than the contacts
    /// of their elements; returns whether there are any.
    pub fn add_missed(&mut self, motion: &Motion<'_>) -> bool {
        self.missed = None;
        for i in 0..self.nearby.len() {
            let nearby = self.nearby[i];
            let Some(pair) = self.pair(motion, &nearby) else { continue };
            let key = pair.key(feature_place(&nearby.feature));
            if self.points.iter().any(|point| point.key == key) {
                continue;
            }
            let Some(xi) = pair.closest(&nearby.feature, 1.0).filter(|xi| !pair.is_apart(*xi)) else { continue };
            let mut point = pair.feature_point(&nearby.feature, xi);
            let (start, end) = point.way(&pair.step, motion.change);
            let Some((at_end, z)) = nearby.feature.patch(&end) else { continue };
            let depth = point.reach + nearby.feature.radius - z.norm();
            let same = self.points.iter().filter(|other| other.touches(nearby.obstacle, nearby.element));
            let deepest = same.fold(0.0, |most: f64, other| most.max(other.now.depth + other.offset));
            let patch = nearby.feature.patch(&start).map_or(at_end, |(patch, _)| patch);
            if depth > deepest + RAMP * pair.radius {
                point.patch = patch;
                point.recall(&start, &pair.step, None);
                point.find_rebound_of(&self.obstacles, motion);
                point.nearby = Some(i);
                self.missed.get_or_insert(pair.place_at(xi));
                self.points.push(point);
            }
        }
        self.missed.is_some()
    }

    /// Returns whether an element went through the core of a feature, or slid so fast over a round
    /// surface that the plane of a contact braked it.
    pub fn passes(&mut self, motion: &Motion<'_>) -> bool {
        self.passed = self.nearby.iter().find_map(|nearby| {
            let FeatureShape::Segment(a, b) = nearby.feature.shape else { return None };
            goes_through(&self.pair(motion, nearby)?, [a, b])
        });
        let brakes = |point: &ContactPoint| point.remembered > 0.0 && point.now.replaced;
        self.passed.is_some() || self.points.iter().any(brakes)
    }

    pub(super) fn pair<'a>(&self, motion: &'a Motion<'a>, nearby: &Nearby) -> Option<Pair<'a>> {
        let contact = motion.model.effects.contact.as_ref()?;
        let (element, obstacle) = (nearby.element, &motion.model.obstacles.0[nearby.obstacle]);
        let section = &motion.model.elements[element];
        let (number, from, step) = (nearby.obstacle, nearby.from, self.obstacles[nearby.obstacle]);
        Some(Pair {
            motion,
            contact,
            element,
            section,
            from,
            number,
            obstacle,
            step,
            radius: contact.radius_of(&section.section),
        })
    }
}

impl Pair<'_> {
    fn place_at(&self, xi: f64) -> Place {
        Place { arc_length: self.from + xi * self.section.length, obstacle: self.obstacle.key }
    }
}

/// Returns where chords of an element that can touch an obstacle go through a segment of it, in the
/// obstacle's axes.
fn goes_through(pair: &Pair<'_>, segment: [Vector3<f64>; 2]) -> Option<Place> {
    let step: &ObstacleStep = &pair.step;
    let at = |i: usize| {
        let point = pair.point(PLACES, i as f64 / CHORDS as f64, 0.0);
        let (start, end) = point.way(step, pair.motion.change);
        [start, end - start]
    };
    let still = segment.map(|end| [end, Vector3::zeros()]);
    let mut last = at(0);
    (1..=CHORDS).find_map(|i| {
        let next = at(i);
        let found = crossing([&last, &next], [&still[0], &still[1]]);
        last = next;
        // rounding may put what begins at a chord before it
        let xi = ((i - 1) as f64 + found?.at[0].clamp(0.0, 1.0)) / CHORDS as f64;
        (!pair.is_apart(xi)).then(|| pair.place_at(xi))
    })
}
