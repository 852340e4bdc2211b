//! At which point of the cable a contact acts that slides over a thin or sharp feature in a step.
//!
//! # Equation
//!
//! With d the distance of a point x of the cable from the core, the closest points x0 at the
//! beginning and x1 at the end of the step,
//!
//! ```text
//! d1(x) - d0(x) = d1(x1) - d0(x0)        x between x0 and x1
//! ```
//!
//! has a solution by the mean value theorem, for the left side is at most the right one at x1, and
//! at least at x0. The force acts there, along its mean normal, and its depth is that of the
//! closest points: with the excess `e = d0(x) - d0(x0)` of its distances over theirs, at both ends.
//! So the force does exactly the work by which the energy of the contact changes; a cable that
//! slides along itself without friction is not braked. At the closest point of the end it would be,
//! by `slide/4(r + R)` of the normal force, r and R the radii of cable and feature: a third at 1
//! m/s, 1/240 s and 7 mm.
//!
//! # Validity
//!
//! One minimum of the distance per element and its neighbours. Where the closest points of
//! beginning and end are on opposite sides of the core, or the point at the end is not the closest
//! one, the contact acts at the closest point of the end. Slides of several `r + R` in a step
//! weaken the mean normal, and so the force at the same depth.

use super::pair::Pair;
use crate::obstacle::Feature;
use crate::scales::contact::{SLIDE_ENOUGH, SLIDE_STEPS};
use nalgebra::Vector3;

/// A place of an element.
pub(super) struct Place<'a, 'b> {
    pub pair: &'a Pair<'b>,
    pub xi: f64,
}

impl Place<'_, '_> {
    pub fn arc(&self) -> f64 {
        self.pair.from + self.xi * self.pair.section.length
    }

    /// Returns the vector from the core at a share of the step.
    pub fn beside_core(&self, feature: &Feature, share: f64) -> Vector3<f64> {
        let y = self.pair.at(self.xi, share);
        y - feature.core(&y)
    }
}

/// Returns the share of the way from x0 to x1, of one element or of neighbours, at which a contact
/// acts, and its excess in m.
pub(super) fn mean_point([x0, x1]: &[Place<'_, '_>; 2], feature: &Feature) -> Option<(f64, f64)> {
    let (z0, z1) = (x0.beside_core(feature, 0.0), x1.beside_core(feature, 1.0));
    if z0.dot(&z1) <= 0.0 {
        return None;
    }
    let (start, change) = (z0.norm(), z1.norm() - z0.norm());
    let distances = |share: f64| {
        let place = between([x0, x1], share);
        [0.0, 1.0].map(|time| place.beside_core(feature, time).norm())
    };
    let off = |[d0, d1]: [f64; 2]| d1 - d0 - change;
    let (mut low, mut high) = (0.0, 1.0);
    let (mut above, mut below) = (off(distances(low)), off(distances(high)));
    if above < 0.0 || below > 0.0 {
        return None;
    }
    // regula falsi; of an end that stays twice half counts (the method of Illinois)
    let (mut share, mut excess, mut was_above) = (0.5, 0.0, None);
    for _ in 0..SLIDE_STEPS {
        share = if above > below { low + (high - low) * above / (above - below) } else { 0.5 * (low + high) };
        let found = distances(share);
        let off = off(found);
        excess = found[0] - start;
        if off.abs() <= SLIDE_ENOUGH * start {
            break;
        }
        let is_above = off > 0.0;
        let stays = if was_above == Some(is_above) { 0.5 } else { 1.0 };
        if is_above {
            (low, above, below) = (share, off, stays * below);
        } else {
            (high, below, above) = (share, off, stays * above);
        }
        was_above = Some(is_above);
    }
    Some((share, excess))
}

/// Returns the place at a share of the way between two, of one element or of neighbours.
pub(super) fn between<'a, 'b>([x0, x1]: [&Place<'a, 'b>; 2], share: f64) -> Place<'a, 'b> {
    let arc = x0.arc() + (x1.arc() - x0.arc()) * share;
    let behind = if x0.pair.from > x1.pair.from { x0 } else { x1 };
    let before = if x0.pair.from > x1.pair.from { x1 } else { x0 };
    let pair = if arc >= behind.pair.from { behind.pair } else { before.pair };
    Place { pair, xi: ((arc - pair.from) / pair.section.length).clamp(0.0, 1.0) }
}
