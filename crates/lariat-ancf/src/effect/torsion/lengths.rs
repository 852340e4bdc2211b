//! The lengths of the elements of a cable over a step: they change where material runs through an
//! end.

use crate::section::Element;

/// Lengths of elements at both ends of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lengths<'a> {
    elements: &'a [Element],
    /// Those in m of the first and of the last element of the cable, where material runs through
    /// them.
    at_eyes: [Option<[f64; 2]>; 2],
}

impl<'a> Lengths<'a> {
    /// Returns those of elements that stay as they are.
    pub fn fixed(elements: &'a [Element]) -> Self {
        Lengths { elements, at_eyes: [None; 2] }
    }

    /// Returns those with the elements at eyes, of the start and of the end of the cable.
    pub fn with_eyes(elements: &'a [Element], at_eyes: [Option<[f64; 2]>; 2]) -> Self {
        Lengths { elements, at_eyes }
    }

    /// Returns the end of the cable through which material runs into an element.
    pub fn side(&self, e: usize) -> Option<usize> {
        let at = [e == 0, e + 1 == self.elements.len()];
        (0..2).find(|&side| at[side] && self.at_eyes[side].is_some())
    }

    /// Returns an element as it is between steps.
    pub fn element(&self, e: usize) -> &'a Element {
        &self.elements[e]
    }

    /// Returns those of an element in m.
    pub fn of(&self, e: usize) -> [f64; 2] {
        self.side(e).and_then(|side| self.at_eyes[side]).unwrap_or([self.elements[e].length; 2])
    }

    /// Returns the length in m of an element in the mean of 1/l.
    pub fn mean(&self, e: usize) -> f64 {
        let [first, last] = self.of(e);
        if first == last { first } else { 2.0 * first * last / (first + last) }
    }
}
