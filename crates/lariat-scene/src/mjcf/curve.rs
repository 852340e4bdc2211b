//! The smooth curve of a composite that is drawn with bends, which is its stress-free shape unless it is `flat`.
//!
//! # Equation
//!
//! A segment that lies on a circle has its tangents at both ends: at a vertex the mean direction of the two segments, at an
//! end the direction that mirrors that of its other end. Between them runs a cubic with the slopes `c/cos^2(a/4)`, for
//! segments of length c and an angle a between the tangents, which is a circle to the sixth order in a. The curvature of
//! the segment is a over its arc length. MuJoCo's joints have the same angle between their segments, at once.
//!
//! # Validity
//!
//! Bends of a few ten degrees a vertex. A cable without twist has no direction of its natural curvature.

use nalgebra::Vector3;

/// Layout: points that are drawn on a segment.
const POINTS: usize = 8;

/// A smooth curve through vertices.
pub(super) struct Curve {
    pub points: Vec<Vector3<f64>>,
    pub arcs: Vec<f64>,
    pub curvature: Vec<f64>,
    /// Largest angle between two segments, in rad.
    pub largest: f64,
    /// Whether all of it is in one plane.
    pub plane: bool,
}

/// Returns the curve through vertices that differ from their neighbours; `None` if they are in one line.
pub(super) fn through(vertices: &[Vector3<f64>]) -> Option<Curve> {
    let sides: Vec<Vector3<f64>> = vertices.windows(2).map(|pair| (pair[1] - pair[0]).normalize()).collect();
    let turns: Vec<Vector3<f64>> = sides.windows(2).map(|pair| pair[0].cross(&pair[1])).collect();
    let largest = sides.windows(2).map(|pair| angle(&pair[0], &pair[1])).fold(0.0, f64::max);
    // rounding of a line that is written in decimals
    if largest < 1e-6 {
        return None;
    }
    let normal = turns.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm()))?.normalize();
    let plane = sides.iter().all(|side| side.dot(&normal).abs() < 1e-3);
    let last = sides.len();
    let mut tangents: Vec<Vector3<f64>> = (0..=last)
        .map(|k| match k {
            0 => sides[0],
            k if k == last => sides[last - 1],
            k => (sides[k - 1] + sides[k]).try_normalize(1e-9).unwrap_or(sides[k]),
        })
        .collect();
    let mirrored = |side: &Vector3<f64>, tangent: &Vector3<f64>| 2.0 * side.dot(tangent) * side - tangent;
    tangents[0] = mirrored(&sides[0], &tangents[1]);
    tangents[last] = mirrored(&sides[last - 1], &tangents[last - 1]);
    let mut curve = Curve { points: vec![vertices[0]], arcs: vec![0.0], curvature: Vec::new(), largest, plane };
    for k in 0..last {
        let (from, to) = (vertices[k], vertices[k + 1]);
        let bend = angle(&tangents[k], &tangents[k + 1]);
        let slope = (to - from).norm() / (0.25 * bend).cos().powi(2);
        let before = curve.points.len();
        for i in 1..=POINTS {
            let t = i as f64 / POINTS as f64;
            let (u, v) = (1.0 - t, t * t * (3.0 - 2.0 * t));
            let across = slope * (t * u * u * tangents[k] - t * t * u * tangents[k + 1]);
            curve.points.push(if i == POINTS { to } else { from + v * (to - from) + across });
        }
        let arc: f64 = curve.points[before - 1..].windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        curve.curvature.push(bend / arc);
        curve.arcs.push(curve.arcs[k] + arc);
    }
    Some(curve)
}

fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vertices of a circle of radius 0.3 m: every point lies on it, and the curvature is 1/0.3.
    #[test]
    fn a_polygon_on_a_circle_is_that_circle() {
        let radius = 0.3;
        let vertices: Vec<Vector3<f64>> =
            (0..9).map(|k| radius * Vector3::new((0.3 * k as f64).cos(), (0.3 * k as f64).sin(), 0.0)).collect();
        let curve = through(&vertices).unwrap();
        assert!(curve.plane);
        for point in &curve.points {
            assert!((point.norm() - radius).abs() < 1e-6 * radius, "{point}");
        }
        for curvature in &curve.curvature {
            assert!((curvature * radius - 1.0).abs() < 1e-3, "{curvature}");
        }
        assert!((curve.arcs[8] - 8.0 * 0.3 * radius).abs() < 1e-3 * radius);
    }

    #[test]
    fn a_line_has_no_curve_and_a_helix_no_plane() {
        assert!(through(&[Vector3::zeros(), Vector3::x(), 3.0 * Vector3::x()]).is_none());
        let helix: Vec<Vector3<f64>> = (0..9).map(f64::from).map(|t| Vector3::new(t.cos(), t.sin(), 0.5 * t)).collect();
        assert!(!through(&helix).unwrap().plane);
    }
}
