//! The cables of a step, and which of them may touch.

use super::CablePair;
use super::chords::Strand;

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
    /// Returns the coefficient of friction between two strands that may touch, or of one with
    /// itself.
    pub fn friction(&self, a: usize, b: usize) -> Option<f64> {
        let contact = |c: usize| (self.get)(c).model.effects.contact;
        let (one, other) = (contact(a)?, contact(b)?);
        if a == b {
            return one.itself.then_some(one.friction);
        }
        if !(one.cables && other.cables) {
            return None;
        }
        let Some(pairs) = self.pairs else { return Some(0.5 * (one.friction + other.friction)) };
        let found = pairs.binary_search_by_key(&[a.min(b), a.max(b)], |pair| pair.cables).ok()?;
        Some(pairs[found].friction)
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
