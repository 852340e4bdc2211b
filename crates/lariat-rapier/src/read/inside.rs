//! Where a cable runs through a collider.
//!
//! # Validity
//!
//! Tested are the line through five points of each element, which is inside where it is deeper than
//! half the thickness of the cable and a millimetre (in the body of an attachment, outside
//! which contact should hold it, than a millimetre: a crate whose rope was 0.8 of its radius inside
//! read 53 N for 3), and lines from one point outside to the next:
//! such a line runs through a collider, however thin, that it enters by one face and leaves by an
//! opposite one. An edge sharper than 60 degrees that only touches the cable is taken for such a
//! collider.

use crate::contact::broad::held_pieces;
use crate::contents::Contents;
use crate::convert::{to_vector, vector};
use crate::handle::CableHandle;
use crate::scales::read::{DEEPER, OPPOSITE, POINTS, TOUCHING};
use lariat_ancf::Cable;
use lariat_ancf::coupling::Coupling;
use nalgebra::Vector3;
use rapier::geometry::{Aabb, BoundingVolume, Collider, Ray};
use rapier::math::Real;

/// Returns arc length and depth in m of the place where a cable is deepest in a collider, if it
/// runs through it.
pub fn deepest_inside(cable: &Cable, collider: &Collider) -> Option<(f64, f64)> {
    deepest_beside(cable, collider, &[])
}

/// Returns what [`deepest_inside`] does, of a cable without some of its pieces (arc lengths in m).
pub(crate) fn deepest_beside(cable: &Cable, collider: &Collider, except: &[[f64; 2]]) -> Option<(f64, f64)> {
    let nodes = (0..cable.nodes()).map(|node| cable.node_position(node));
    let mut around = Aabb::new_invalid();
    nodes.for_each(|x| around.take_point(to_vector(&x)));
    let slack = cable.elements().iter().fold(0.0, |longest: f64, element| longest.max(element.length));
    if !collider.compute_aabb().intersects(&around.loosened(0.5 * slack as Real)) {
        return None;
    }
    let diameter = |element: &lariat_ancf::Element| element.section.diameter.unwrap_or(0.0);
    let touching = if except.is_empty() {
        cable.elements().iter().map(diameter).fold(2.0 * TOUCHING, f64::max) * 0.5
    } else {
        TOUCHING
    };
    let mut deepest: Option<(f64, f64)> = None;
    let mut note = |s: f64, depth: f64| {
        if deepest.is_none_or(|(_, known)| depth > known * (1.0 + DEEPER)) {
            deepest = Some((s, depth));
        }
    };
    let mut outside: Option<(f64, Vector3<f64>)> = None;
    let arc_lengths = cable.node_arc_lengths();
    let starts = arc_lengths
        .windows(2)
        .flat_map(|ends| (0..POINTS).map(move |k| ends[0] + (ends[1] - ends[0]) * k as f64 / POINTS as f64));
    for s in starts.chain([cable.length()]) {
        if except.iter().any(|[from, to]| (from..=to).contains(&&s)) {
            outside = None;
            continue;
        }
        let Ok(sample) = cable.sample(s) else { continue };
        let point = sample.position;
        let (depth, is_inside) = depth(collider, &point);
        if is_inside && depth > touching {
            note(s, depth);
        }
        if is_inside {
            continue;
        }
        if let Some((from, start)) = outside
            && let Some((share, depth)) = pierced(collider, &start, &point, touching)
        {
            note(from + share * (s - from), depth);
        }
        outside = Some((s, point));
    }
    deepest
}

/// Returns where on a line between two points outside a collider, from 0 to 1, it is in the
/// collider, and how deep in m, if that is deeper than `touching`; or half of the length inside, if
/// the line enters by one face and leaves by an opposite one.
fn pierced(collider: &Collider, from: &Vector3<f64>, to: &Vector3<f64>, touching: f64) -> Option<(f64, f64)> {
    let ([start, end], through) = faces(collider, from, to)?;
    let length = (end - start).max(0.0) * (to - from).norm();
    let places = (1..2 * POINTS).map(|k| start + (end - start) * k as f64 / (2 * POINTS) as f64);
    let depths = places.map(|share| (share, depth(collider, &(from + (to - from) * share)).0));
    let deepest =
        depths.reduce(|a, b| if b.1 > a.1 { b } else { a }).filter(|(_, depth)| *depth > touching && length > 0.0);
    deepest.or_else(|| through.then_some((0.5 * (start + end), 0.5 * length)))
}

/// Returns where on a line between two points outside a collider, from 0 to 1, it enters and leaves
/// this, and whether by opposite faces.
fn faces(collider: &Collider, from: &Vector3<f64>, to: &Vector3<f64>) -> Option<([f64; 2], bool)> {
    let cast = |origin: &Vector3<f64>, end: &Vector3<f64>| {
        let ray = Ray::new(to_vector(origin), to_vector(&(end - origin)));
        collider.shape().cast_ray_and_get_normal(collider.position(), &ray, 1.0, false)
    };
    let (entry, exit) = (cast(from, to)?, cast(to, from)?);
    let ends = [f64::from(entry.time_of_impact), 1.0 - f64::from(exit.time_of_impact)];
    Some((ends, entry.normal.dot(exit.normal) < OPPOSITE))
}

/// Returns whether a straight way between two points enters a collider by one face and leaves it by
/// an opposite one.
pub(crate) fn passes(collider: &Collider, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
    faces(collider, from, to).is_some_and(|([start, end], through)| through && start < end)
}

/// Returns the [pieces](held_pieces) of a cable that do not touch a collider, by its shape; none of
/// a cable that is not attached to the body of the collider.
pub(crate) fn held_beside(
    contents: &Contents,
    handle: CableHandle,
    cable: &Cable,
    collider: &Collider,
) -> Vec<[f64; 2]> {
    let inside = |x: &Vector3<f64>| -f64::from(collider.shape().distance_to_local_point(to_vector(x), false));
    held_pieces(contents, handle, collider, cable.contact_radius(), inside)
}

/// Returns the distance in m of a point from the surface of a collider, and whether it is inside.
pub(crate) fn depth(collider: &Collider, point: &Vector3<f64>) -> (f64, bool) {
    let surface = collider.shape().project_point(collider.position(), to_vector(point), false);
    ((vector(surface.point) - point).norm(), surface.is_inside)
}
