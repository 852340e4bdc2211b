//! The curve of an element as a tube, by halves: whether any part of it is near something.
//!
//! # Equation
//!
//! The part from s0 to s1 is in the ball about the middle of its ends with the radius
//! `|r(s1) - r(s0)|/2 + (s1 - s0)^2/8 max |r''|`; r'' is linear in s. A part whose ball is not near
//! is left, one that is not longer than what counts as near is near, others are halved.

use crate::element::shape::{combine, position, second_derivative};
use crate::obstacle::Pose;
use crate::scales::contact::TUBE_HALVINGS;
use nalgebra::Vector3;

/// An element at the beginning of a step in the axes of an obstacle.
pub(super) struct Tube<'a> {
    pub q: &'a [f64],
    pub element: usize,
    pub length: f64,
    pub pose: &'a Pose,
    /// Distance in m from the curve that counts as near.
    pub margin: f64,
}

impl Tube<'_> {
    /// Returns whether any part of the curve is near what `is_near` knows, which is asked for
    /// balls.
    pub fn any(&self, is_near: &mut dyn FnMut(&Vector3<f64>, f64) -> bool) -> bool {
        let bend = |xi: f64| combine(self.q, self.element, &second_derivative(xi, self.length)).norm();
        let sagitta = 0.125 * bend(0.0).max(bend(1.0)) * self.length * self.length;
        self.part([0.0, 1.0], [0.0, 1.0].map(|xi| self.at(xi)), (sagitta, TUBE_HALVINGS), is_near)
    }

    fn at(&self, xi: f64) -> Vector3<f64> {
        self.pose.own(&combine(self.q, self.element, &position(xi, self.length)))
    }

    fn part(
        &self,
        [low, high]: [f64; 2],
        ends: [Vector3<f64>; 2],
        (sagitta, halvings): (f64, u32),
        is_near: &mut dyn FnMut(&Vector3<f64>, f64) -> bool,
    ) -> bool {
        let size = 0.5 * (ends[1] - ends[0]).norm() + sagitta;
        if !is_near(&(0.5 * (ends[0] + ends[1])), size + self.margin) {
            return false;
        }
        if size <= self.margin || halvings == 0 {
            return true;
        }
        let middle = 0.5 * (low + high);
        let (at, rest) = (self.at(middle), (0.25 * sagitta, halvings - 1));
        self.part([low, middle], [ends[0], at], rest, is_near)
            || self.part([middle, high], [at, ends[1]], rest, is_near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    /// A tube is near a point whenever one of its points is within the margin, and not if all are
    /// further than twice that away.
    ///
    /// *Source.* Distances of 4000 points of the curve.
    #[test]
    fn a_tube_is_near_what_its_curve_is_near() {
        let mut x = 0.731;
        let mut next = || {
            x = (x * 997.0 + 0.123_f64).fract();
            2.0 * x - 1.0
        };
        let pose = Pose { position: Vector3::zeros(), rotation: Matrix3::identity() };
        let (mut near, mut far) = (0, 0);
        for _ in 0..300 {
            let q: [f64; 12] = core::array::from_fn(|_| next());
            let point = Vector3::new(next(), next(), next());
            let tube = Tube { q: &q, element: 0, length: 1.3, pose: &pose, margin: 0.3 };
            let least = (0..=4000).map(|i| (tube.at(f64::from(i) / 4000.0) - point).norm()).fold(9.0, f64::min);
            let found = tube.any(&mut |centre, radius| (centre - point).norm() <= radius);
            assert!(found || least > 0.3, "{least}");
            assert!(!found || least < 1.2, "{least}");
            (near, far) = (near + usize::from(found), far + usize::from(!found));
        }
        assert!(near > 30 && far > 30, "{near} {far}");
    }
}
