//! Whether two lines went through each other between two shapes, wherever no motion joins these.
//!
//! # Equation
//!
//! Every point goes straight from the first shape to the second, and each passage of a chord
//! through one of the other line has a sense (crossing.rs). The senses of all passages add up to
//! the change of the sum of the signed crossings of both lines, seen from anywhere, but for what
//! goes round their ends:
//!
//! ```text
//! sum of senses = 0
//! ```
//!
//! of lines that moved as they could.
//!
//! # Validity
//!
//! Lines that stay in one plane have no sense, and pass each other unseen. A line with a free end
//! may have come to the other side round it: it has a sum, too.
//!
//! # References
//!
//! Calugareanu 1959 (the linking number as a sum of signed crossings).

use super::crossing::{Crossing, crossing};
use crate::scales::SAME;
use crate::scales::contact::CHUNK;
use nalgebra::Vector3;

/// Points of a line in a first and in a second shape, in m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Way {
    /// Points in the first shape, along the line.
    pub from: Vec<Vector3<f64>>,
    /// The same points in the second one.
    pub to: Vec<Vector3<f64>>,
}

impl Way {
    fn chords(&self) -> usize {
        self.from.len().min(self.to.len()).saturating_sub(1)
    }

    fn moved(&self, i: usize) -> [Vector3<f64>; 2] {
        [self.from[i], self.to[i] - self.from[i]]
    }

    /// Returns the box of the ways of some chords.
    fn bounds(&self, first: usize) -> [Vector3<f64>; 2] {
        let last = (first + CHUNK).min(self.chords());
        let points = self.from[first..=last].iter().chain(&self.to[first..=last]);
        points.fold([Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)], |[low, high], x| {
            [low.inf(x), high.sup(x)]
        })
    }
}

/// Returns the numbers of the chords with which two lines first pass through each other between
/// their shapes, if their passages do not cancel; `None` for `other` is the line itself.
pub fn crossed_on(one: &Way, other: Option<&Way>) -> Option<[usize; 2]> {
    let (same, other) = (other.is_none(), other.unwrap_or(one));
    let mut found: Vec<([usize; 2], f64, i32)> = Vec::new();
    for a in (0..one.chords()).step_by(CHUNK) {
        let [low, high] = one.bounds(a);
        for b in (if same { a } else { 0 }..other.chords()).step_by(CHUNK) {
            let [from, to] = other.bounds(b);
            if (0..3).any(|x| high[x] < from[x] || to[x] < low[x]) {
                continue;
            }
            for i in a..(a + CHUNK).min(one.chords()) {
                // neighbours have a point in common
                let begin = if same { b.max(i + 2) } else { b };
                for k in begin..(b + CHUNK).min(other.chords()) {
                    let (own, met) = ([one.moved(i), one.moved(i + 1)], [other.moved(k), other.moved(k + 1)]);
                    if let Some(Crossing { share, sense, .. }) = crossing([&own[0], &own[1]], [&met[0], &met[1]]) {
                        // through a common point of two chords it is found on both
                        let same = |(at, known, of): &([usize; 2], f64, i32)| {
                            let near = at[0].abs_diff(i) <= 1 && at[1].abs_diff(k) <= 1;
                            near && *of == sense && (known - share).abs() < SAME
                        };
                        if !found.iter().any(same) {
                            found.push(([i, k], share, sense));
                        }
                    }
                }
            }
        }
    }
    let sum: i32 = found.iter().map(|(_, _, sense)| sense).sum();
    found.first().map(|(chords, ..)| *chords).filter(|_| sum != 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(from: impl Fn(f64) -> Vector3<f64>, to: impl Fn(f64) -> Vector3<f64>) -> Way {
        let at = |f: &dyn Fn(f64) -> Vector3<f64>| (0..=40).map(|i| f(f64::from(i) / 40.0)).collect();
        Way { from: at(&from), to: at(&to) }
    }

    /// A line that is let down through another one has a passage; one that is let down beside it
    /// and shifted under it has none, and neither has a bight that goes through and comes out
    /// again.
    ///
    /// *Source.* A taut string and one above it: the second can be under the first only where it
    /// passed through it or round an end. A bight whose two legs pass the string in opposite senses
    /// can be pulled back.
    #[test]
    fn passages_are_told_by_their_sense() {
        let x = |s: f64| 2.0 * s - 1.0;
        let low = line(|s| Vector3::new(x(s), 0.0, 0.0), |s| Vector3::new(x(s), 0.0, 0.0));
        let sags = |sag: f64, shift: f64| move |s: f64| Vector3::new(0.013 + shift, 0.1 - sag * s * (1.0 - s), x(s));
        let through = line(sags(0.0, 0.0), sags(2.0, 0.0));
        assert!(matches!(crossed_on(&low, Some(&through)), Some([19 | 20, 19 | 20])));
        assert!(crossed_on(&through, Some(&low)).is_some());
        let above = line(sags(0.0, 0.0), sags(0.3, 0.0));
        assert_eq!(crossed_on(&low, Some(&above)), None);
        let beside = line(sags(0.0, 1.5), sags(2.0, 1.5));
        assert_eq!(crossed_on(&low, Some(&beside)), None);
        let bight = |depth: f64| {
            move |s: f64| {
                let y = 0.1 - depth * (-(6.0 * x(s)).powi(2)).exp();
                Vector3::new(0.013 + 0.3 * x(s), y, 0.05 * x(s) + 0.3)
            }
        };
        assert_eq!(crossed_on(&low, Some(&line(bight(0.0), bight(0.4)))), None);
    }

    /// A line that is drawn as an open loop and pulled to a knot passes through itself.
    ///
    /// *Source.* A loop whose ends lie above each other by turns: the writhe of its one crossing
    /// changes from 1 to -1.
    #[test]
    fn a_line_passes_through_itself() {
        let turn = |height: f64| {
            move |s: f64| {
                let angle = core::f64::consts::TAU * 1.2 * (s - 0.5);
                Vector3::new(angle.sin(), -angle.cos(), height * (s - 0.5) + 0.003 * s)
            }
        };
        assert!(crossed_on(&line(turn(0.2), turn(-0.2)), None).is_some());
        assert_eq!(crossed_on(&line(turn(0.2), turn(0.4)), None), None);
    }
}
