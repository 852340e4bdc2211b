//! A line that is painted along a cable with torsion: what the eye sees of its twist.
//!
//! # Equation
//!
//! Directors of the cross-sections, from that of the first hold of a segment on: carried by the
//! smallest rotations between the slopes x, m, y of the elements, and turned about the tangent by
//! an even share of the twist and by what the curve adds to its polyline,
//!
//! ```text
//! Phi l_e/L + det(x, m, y)/6
//! ```
//!
//! so that the line comes to the director of the last hold, modulo full turns; within an element
//! it is carried from the nearer node.
//!
//! # Validity
//!
//! That of [torsion](crate::Torsion). Beside a segment the spin of a section is not known, and
//! there is no line. On supports the director of the first hold is a fixed function of the tangent,
//! turned by the motor; on a body it turns with that.

use super::Cable;
use crate::effect::torsion::curve::{rotated, slopes_along};
use crate::effect::torsion::segment::Segment;
use crate::effect::{EndSpin, RestShape};
use crate::error::Error;
use crate::section::Element;
use crate::state::SegmentTwist;
use nalgebra::{Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

impl Cable {
    /// Returns at arc lengths in m the direction across the cable, of length 1, in which a line
    /// that is painted along it in its untwisted state is seen; `None` where no clamp on both sides
    /// holds the spin.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] beyond the cable.
    pub fn stripe(&self, places: &[f64]) -> Result<Vec<Option<Vector3<f64>>>, Error> {
        let segments = self.segments();
        let lines: Vec<_> = segments.iter().map(|(segment, twist)| self.directors(segment, twist)).collect();
        let direction = |&place: &f64| {
            let here = self.sample(place)?;
            let (e, xi) = self.model.locate(self.on_cable(place)?);
            let Some(k) = segments.iter().position(|(segment, _)| segment.contains(e)) else { return Ok(None) };
            let (segment, twist) = &segments[k];
            let rate = segment.rate_in(self.unstressed(), self.positions(), twist.twist, e);
            // from the nearer node
            let (node, share) = if xi < 0.5 { (e, xi) } else { (e + 1, xi - 1.0) };
            let turn = rate * share * self.elements()[e].length;
            let (from, director) = lines[k][node - segment.nodes[0]];
            let to = here.slope.try_normalize(0.0).unwrap_or(from);
            Ok(Some(about(&to, turn) * rotated(director, &from, &to)))
        };
        places.iter().map(direction).collect()
    }

    /// Returns the elements, and their shape without stress.
    fn unstressed(&self) -> (&[Element], Option<&RestShape>) {
        (self.elements(), self.model.effects.rest_shape.as_ref())
    }

    /// Returns tangents and directors at the nodes of a segment.
    fn directors(&self, segment: &Segment, twist: &SegmentTwist) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let [first, last] = segment.nodes;
        let (elements, q) = (&self.elements()[first..last], &self.positions()[segment.range()]);
        let slopes = slopes_along(q, elements.iter().map(|element| element.length));
        let tangent = slopes.first().map_or_else(Vector3::x, |[x, ..]| *x);
        let mut list = vec![(tangent, self.first_director(first, &tangent, twist))];
        for (k, ([x, m, y], element)) in slopes.into_iter().zip(elements).enumerate() {
            let carried = rotated(rotated(list[list.len() - 1].1, &x, &m), &m, &y);
            let rate = segment.rate_in(self.unstressed(), self.positions(), twist.twist, first + k);
            let turn = rate * element.length + x.dot(&m.cross(&y)) / 6.0;
            list.push((y, about(&y, turn) * carried));
        }
        list
    }

    /// Returns the director of the first hold of a segment.
    fn first_director(&self, node: usize, tangent: &Vector3<f64>, twist: &SegmentTwist) -> Vector3<f64> {
        let across = |d: &Vector3<f64>| Vector3::ith(d.iamin(), 1.0).cross(d).normalize();
        let spin =
            self.model.effects.torsion.as_ref().map_or(&EndSpin::Held, |torsion| self.model.end_spin(torsion, node));
        let Some([w, x, y, z]) = twist.attitudes[0] else {
            return about(tangent, spin.angle(self.time())) * across(tangent);
        };
        let attitude = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        about(tangent, spin.angle(self.time())) * (attitude * across(&(attitude.inverse() * tangent)))
    }
}

/// Returns the rotation about a direction by an angle in rad.
fn about(axis: &Vector3<f64>, angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_unchecked(*axis), angle)
}
