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
//! two cables do (pairs/crossing.rs), and the step is divided.
//!
//! # Validity
//!
//! A contact is added up to three times per step; what is inside then is inside in the next step,
//! too, and its depth an offset. Balls and circles are not asked whether an element went through
//! them.

use super::motion::Motion;
use super::nearby::Nearby;
use super::pair::{PLACES, Pair, feature_place};
use super::pairs::crossing;
use super::path::ObstacleStep;
use super::point::ContactPoint;
use super::step::ContactStep;
use crate::obstacle::FeatureShape;
use crate::scales::contact::{CHORDS, RAMP};
use nalgebra::Vector3;

impl ContactStep {
    /// Adds the points that are inside a feature at the end of an iterate, deeper than the contacts
    /// of their elements; returns whether there are any.
    pub fn add_missed(&mut self, motion: &Motion<'_>) -> bool {
        let known = self.points.len();
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
                self.points.push(point);
            }
        }
        self.missed = self.points.len() > known;
        self.missed
    }

    /// Returns whether an element went through the core of a feature, or slid so fast over a round
    /// surface that the plane of a contact braked it.
    pub fn passes(&mut self, motion: &Motion<'_>) -> bool {
        let brakes = |point: &ContactPoint| point.remembered > 0.0 && point.now.replaced;
        self.passed = self.points.iter().any(brakes)
            || (0..self.nearby.len()).any(|i| {
                let nearby = self.nearby[i];
                let FeatureShape::Segment(a, b) = nearby.feature.shape else { return false };
                self.pair(motion, &nearby).is_some_and(|pair| goes_through(&pair, [a, b]))
            });
        self.passed
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

/// Returns whether chords of an element go through a segment of an obstacle, in the obstacle's
/// axes.
fn goes_through(pair: &Pair<'_>, segment: [Vector3<f64>; 2]) -> bool {
    let step: &ObstacleStep = &pair.step;
    let at = |i: usize| {
        let point = pair.point(PLACES, i as f64 / CHORDS as f64, 0.0);
        let (start, end) = point.way(step, pair.motion.change);
        [start, end - start]
    };
    let still = segment.map(|end| [end, Vector3::zeros()]);
    let mut last = at(0);
    (1..=CHORDS).any(|i| {
        let next = at(i);
        let crosses = crossing([&last, &next], [&still[0], &still[1]]).is_some();
        last = next;
        crosses
    })
}
