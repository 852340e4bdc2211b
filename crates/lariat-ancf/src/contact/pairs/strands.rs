//! The cables of a step, and which of them may touch.

use super::CablePair;
use super::chords::Strand;
use crate::obstacle::LARGEST_RESTITUTION;

/// The cables of a step.
pub(crate) struct Strands<'s, 'a> {
    pub count: usize,
    pub get: &'s dyn Fn(usize) -> Strand<'a>,
    /// Returns the distance in m between points of two cables, by arc length, over a body that
    /// holds both.
    pub over_bodies: &'s dyn Fn([usize; 2], [f64; 2]) -> f64,
    /// Those that may touch each other, in ascending order; `None` for all.
    pub pairs: Option<&'s [CablePair]>,
}

impl Strands<'_, '_> {
    /// Returns the coefficients of friction and of restitution between two strands that may touch,
    /// or of one with itself.
    pub fn coefficients(&self, a: usize, b: usize) -> Option<[f64; 2]> {
        let contact = |c: usize| (self.get)(c).model.effects.contact;
        let (one, other) = (contact(a)?, contact(b)?);
        if a == b {
            return one.itself.then_some([one.friction, one.restitution.min(LARGEST_RESTITUTION)]);
        }
        if !(one.cables && other.cables) {
            return None;
        }
        let Some(pairs) = self.pairs else {
            let mean = 0.5 * (one.restitution + other.restitution);
            return Some([0.5 * (one.friction + other.friction), mean.min(LARGEST_RESTITUTION)]);
        };
        let found = pairs.binary_search_by_key(&[a.min(b), a.max(b)], |pair| pair.cables).ok()?;
        Some([pairs[found].friction, pairs[found].restitution])
    }

    /// Returns whether a strand may touch any.
    pub fn may_touch(&self, c: usize) -> bool {
        let Some(contact) = (self.get)(c).model.effects.contact else { return false };
        contact.itself
            || contact.cables
                && match self.pairs {
                    None => (0..self.count).any(|other| {
                        other != c && (self.get)(other).model.effects.contact.is_some_and(|own| own.cables)
                    }),
                    Some(pairs) => pairs.iter().any(|pair| pair.cables.contains(&c)),
                }
    }
}
