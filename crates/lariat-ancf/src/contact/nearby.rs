//! Thin and sharp parts of obstacles that are near an element.

use super::motion::Motion;
use crate::obstacle::Feature;

/// A feature that an element may touch in the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearby {
    pub element: usize,
    /// Arc length in m at which the element begins.
    pub from: f64,
    /// Number of the obstacle.
    pub obstacle: usize,
    pub feature: Feature,
    /// How straight the cable is across it, of one that samples see as smooth
    /// ([`straight`](super::straight)).
    pub round: Option<f64>,
    /// Element, where it begins, and local coordinate of the point that is closest when the step
    /// begins; `None` until it is asked for.
    pub start: Option<Option<(usize, f64, f64)>>,
}

impl Nearby {
    /// Returns the same feature beside the element behind this one, or before it.
    pub fn neighbour(&self, motion: &Motion<'_>, behind: bool) -> Option<Nearby> {
        let elements = &motion.model.elements;
        let (element, from) = if behind {
            (self.element + 1, self.from + elements[self.element].length)
        } else {
            let element = self.element.checked_sub(1)?;
            (element, self.from - elements[element].length)
        };
        (element < elements.len() && !motion.model.is_at_eye(element)).then_some(Nearby {
            element,
            from,
            start: None,
            ..*self
        })
    }

    /// Returns whether it is the same element and feature.
    pub fn is_same(&self, other: &Nearby) -> bool {
        let key = |nearby: &Nearby| (nearby.element, nearby.obstacle, nearby.feature.id);
        key(self) == key(other)
    }
}
