//! What bending adds to the force of an attachment that holds a cable nearer a body than it lies.
//!
//! Equation and validity: `contact.rs`.

use super::balance::weight_and_stiffness;
use crate::cable::Cable;
use crate::obstacle::Obstacle;
use crate::scales::watch::{DEPTH, PRIED, PRIED_BESIDE};

/// An attachment that pries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Prying {
    /// Its arc length in m.
    pub arc_length: f64,
    /// The force in N that bending adds.
    pub force: f64,
    /// The largest tension or the weight in N, with which that is to be compared.
    pub scale: f64,
}

impl Cable {
    /// Returns the attachment that pries most, of those beside which the cable touches the body, if
    /// that is more than a share of the weight that is told.
    pub(crate) fn prying(&self) -> Option<Prying> {
        let holds = self.obstacles().iter().filter(|obstacle| !obstacle.except.is_empty());
        let pieces = holds.flat_map(|obstacle| obstacle.except.iter().map(move |piece| (obstacle, *piece)));
        let found = pieces.filter_map(|(obstacle, piece)| self.prying_at(obstacle, piece));
        let [arc_length, force] = found.reduce(|most, one| if one[1] > most[1] { one } else { most })?;
        let (weight, _) = weight_and_stiffness(self);
        (force > PRIED * weight).then(|| Prying { arc_length, force, scale: self.peak_tension().1.max(weight) })
    }

    /// Returns arc length (m) and force (N) of what an obstacle pries that holds a piece from one
    /// arc length (m) to another.
    fn prying_at(&self, obstacle: &Obstacle, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
        let (arc_length, reach) = (0.5 * (from + to), 0.5 * (to - from));
        let radius = self.contact_radius();
        let touches = |low: f64, high: f64| {
            self.contacts().any(|touch| {
                touch.obstacle == obstacle.key && touch.normal_force > 0.0 && (low..=high).contains(&touch.arc_length)
            })
        };
        let beside = PRIED_BESIDE * radius;
        let sides = [(from, [from - beside, from]), (to, [to, to + beside])];
        let moment = |(at, [low, high]): (f64, [f64; 2])| {
            let inside = at > 0.0 && at < self.length() && touches(low, high);
            inside.then(|| self.sample(at).ok()).flatten().map(|sample| sample.moment.norm())
        };
        let moment = sides.into_iter().filter_map(moment).reduce(f64::max)?;
        let held = self.sample(arc_length.clamp(0.0, self.length())).ok()?.position;
        let place = obstacle.motion.pose(self.time()).own(&held);
        let nearer = radius + obstacle.skin - obstacle.surface.nearest(&place).distance;
        (nearer > DEPTH * radius).then(|| [arc_length, moment / reach])
    }
}
