//! Chords of elements, and where two of them are closest.
//!
//! # Equation
//!
//! ```text
//! min |a(s) - b(t)|^2 + e |a'|^2 (s - 1/2)^2        0 <= s, t <= 1
//! ```
//!
//! The small second term makes the closest points of parallel chords unique, and lets them move
//! steadily as the chords tilt. What is found on chords is completed on the curves, by the same
//! problem on their tangents.
//!
//! # References
//!
//! Ericson, Real-Time Collision Detection, 2005, section 5.1.9.

use crate::element::shape;
use crate::element::shape::combine;
use crate::model::Model;
use crate::scales::contact::{CENTRING, CHORD, MOST_CHORDS, REFINEMENTS};
use crate::state::PairMemory;
use nalgebra::Vector3;

/// A cable in a step.
#[derive(Clone, Copy)]
pub(crate) struct Strand<'a> {
    pub key: u64,
    pub model: &'a Model,
    pub q: &'a [f64],
    /// Change of the coordinates in the present iterate.
    pub change: &'a [f64],
    /// Velocities of the coordinates when the step begins.
    pub velocity: &'a [f64],
    pub memory: &'a [PairMemory],
    /// Power in W that damping took in the last step.
    pub damped: f64,
    /// Length in m that came through the eye of a reel at the start: arc lengths of all material
    /// have grown by it.
    pub passed: f64,
}

/// An element of a strand, at a share of the step.
#[derive(Clone, Copy)]
pub(super) struct Piece<'a> {
    pub strand: Strand<'a>,
    pub element: usize,
    pub length: f64,
    /// Number of its chords.
    pub chords: usize,
}

impl<'a> Piece<'a> {
    pub fn new(strand: Strand<'a>, element: usize) -> Self {
        let section = &strand.model.elements[element];
        let radius = strand.model.effects.contact.map_or(0.0, |contact| contact.radius_of(&section.section));
        let chords = (section.length / (CHORD * radius)).ceil().clamp(1.0, MOST_CHORDS) as usize;
        Piece { strand, element, length: section.length, chords }
    }

    /// Returns the local coordinates of the ends of a chord.
    pub fn ends_of(&self, chord: usize) -> [f64; 2] {
        [chord, chord + 1].map(|end| end as f64 / self.chords as f64)
    }

    /// Returns whether a local coordinate is that of a tip of the cable.
    pub fn is_tip(&self, xi: f64) -> bool {
        let model = self.strand.model;
        xi <= 0.0 && model.begins_contact(self.element) || xi >= 1.0 && model.ends_contact(self.element)
    }

    /// Returns the place and its change over the step.
    pub fn place(&self, xi: f64) -> [Vector3<f64>; 2] {
        let shape = shape::position(xi, self.length);
        let Strand { q, change, .. } = self.strand;
        [combine(q, self.element, &shape), combine(change, self.element, &shape)]
    }

    /// Returns the place at which the chord before one begins, and its change over the step; `None`
    /// at the beginning of the cable.
    pub fn before(&self, chord: usize) -> Option<[Vector3<f64>; 2]> {
        if chord > 0 {
            return Some(self.place((chord - 1) as f64 / self.chords as f64));
        }
        (!self.strand.model.begins_contact(self.element)).then(|| {
            let piece = Piece::new(self.strand, self.element - 1);
            piece.place((piece.chords - 1) as f64 / piece.chords as f64)
        })
    }

    /// Returns the place at a share of the step.
    pub fn at(&self, xi: f64, share: f64) -> Vector3<f64> {
        let [x, change] = self.place(xi);
        x + change * share
    }

    /// Returns the derivative of the place by the local coordinate at a share of the step.
    pub fn slope(&self, xi: f64, share: f64) -> Vector3<f64> {
        let shape = shape::slope(xi, self.length);
        let Strand { q, change, .. } = self.strand;
        (combine(q, self.element, &shape) + combine(change, self.element, &shape) * share) * self.length
    }
}

/// Returns the closest points of two segments, as shares of them.
pub(super) fn closest([a0, a1]: [Vector3<f64>; 2], [b0, b1]: [Vector3<f64>; 2]) -> (f64, f64) {
    let (u, v, w) = (a1 - a0, b1 - b0, a0 - b0);
    let (uu, uv, vv) = (u.norm_squared(), u.dot(&v), v.norm_squared());
    let (uw, vw) = (u.dot(&w), v.dot(&w));
    let weight = CENTRING * uu;
    // the best s for a t, and the best t for an s
    let s_of = |t: f64| ((uv * t - uw + 0.5 * weight) / (uu + weight).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let t_of = |s: f64| ((uv * s + vw) / vv.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let determinant = (uu + weight) * vv - uv * uv;
    let s = if determinant > 0.0 { ((uv * vw - vv * (uw - 0.5 * weight)) / determinant).clamp(0.0, 1.0) } else { 0.5 };
    let t = t_of(s);
    let s = s_of(t);
    (s, t_of(s))
}

/// Returns the closest points of two curves as local coordinates, from those of chords; the first
/// stays within its chord, the second within its element.
pub(super) fn refine(a: &Piece<'_>, chord: usize, b: &Piece<'_>, from: [f64; 2], share: f64) -> [f64; 2] {
    refine_within(a, (chord, a.ends_of(chord)), b, from, share)
}

/// Returns the closest points of two curves as local coordinates, from others; the first stays
/// within limits, the second within its element.
pub(super) fn refine_within(
    a: &Piece<'_>,
    (chord, [low, high]): (usize, [f64; 2]),
    b: &Piece<'_>,
    from: [f64; 2],
    share: f64,
) -> [f64; 2] {
    let [mut x, mut y] = from;
    let middle = 0.5 * a.ends_of(chord).iter().sum::<f64>();
    let is_last = b.strand.model.ends_contact(b.element);
    let (first, last) =
        (if b.strand.model.begins_contact(b.element) { 0.0 } else { -1.0 }, if is_last { 1.0 } else { 2.0 });
    for _ in 0..REFINEMENTS {
        let (u, v) = (a.slope(x, share), b.slope(y, share));
        let w = a.at(x, share) - b.at(y, share);
        let (uu, uv, vv) = (u.norm_squared(), u.dot(&v), v.norm_squared());
        let weight = CENTRING * uu;
        let (gx, gy) = (u.dot(&w) + weight * (x - middle), -v.dot(&w));
        let determinant = (uu + weight) * vv - uv * uv;
        if determinant <= 0.0 || vv <= 0.0 {
            break;
        }
        // beyond the end of the second cable there is nothing: the first one's best point is that
        // for its end
        let free = y - ((uu + weight) * gy + uv * gx) / determinant;
        let bounded = free.clamp(first, last);
        let next = (x - (gx - uv * (bounded - y)) / (uu + weight)).clamp(low, high);
        // the best y for the new x
        y = (y + (v.dot(&w) + uv * (next - x)) / vv).clamp(0.0, 1.0);
        x = next;
    }
    [x, y]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No points of the segments are nearer to each other than those that are found, but for the
    /// weight of the middle.
    ///
    /// *Source.* All pairs of a grid.
    #[test]
    fn the_closest_points_of_segments_are_the_closest() {
        let mut x = 0.37;
        let mut next = || {
            x = (x * 997.0 + 0.123_f64).fract();
            2.0 * x - 1.0
        };
        for _ in 0..300 {
            let mut point = || Vector3::new(next(), next(), next());
            let (a, b) = ([point(), point()], [point(), point()]);
            let cost = |s: f64, t: f64| {
                let y = a[0] + (a[1] - a[0]) * s - b[0] - (b[1] - b[0]) * t;
                y.norm_squared() + CENTRING * (a[1] - a[0]).norm_squared() * (s - 0.5).powi(2)
            };
            let (s, t) = closest(a, b);
            let least = cost(s, t);
            for i in 0..=40 {
                for j in 0..=40 {
                    assert!(least <= cost(f64::from(i) / 40.0, f64::from(j) / 40.0) + 1e-12);
                }
            }
        }
    }
}
