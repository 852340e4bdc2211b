//! Where the nodes of a new cable lie.
//!
//! Nodes are at given arc lengths of the unstretched cable. Drawn between points that are as far
//! apart as the cable is long, or farther, the cable follows the polyline, stretched evenly. If it
//! is longer than the polyline, each segment becomes an [arc](Sag) of a circle of the right length,
//! sagging along gravity, so that a slack cable starts unstrained. Corners between segments are
//! rounded by [`unstrained`](super::unstrained).

use crate::scales::cable::SLACK;
use nalgebra::Vector3;

/// Where a node of a new cable lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Laid {
    pub position: Vector3<f64>,
    pub slope: Vector3<f64>,
    /// At a corner the slopes of the cable before and behind it, of which `slope` is the mean.
    pub corner: Option<[Vector3<f64>; 2]>,
}

/// How the segments of a slack cable sag, without strain: their slope turns from the chord by
/// `angle`, with `sin(angle)/angle = chord/arc`, along arcs of circles.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sag {
    /// Towards where, of any length; zero where they do not.
    pub towards: Vector3<f64>,
    /// Share of the segment at each end within which the slope turns from the chord to that angle,
    /// below 1/2; 0 for one arc, which begins with it. The angle does not depend on it.
    pub lead: f64,
}

impl Sag {
    /// One arc per segment, along gravity.
    pub fn along(gravity: Vector3<f64>) -> Self {
        Sag { towards: gravity, lead: 0.0 }
    }
}

/// Positions and slopes at the arc lengths `s` (ascending, from 0 to the unstretched length) of a
/// cable through `points`.
pub(crate) fn along_polyline(points: &[Vector3<f64>], s: &[f64], sag: Sag) -> Vec<Laid> {
    let length = s[s.len() - 1];
    let chords: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
    let drawn: f64 = chords.iter().sum();
    let slack = length > drawn * (1.0 + SLACK);
    // arc length of the cable at each point, in proportion to the chords
    let mut at = vec![0.0];
    for chord in &chords {
        at.push(at[at.len() - 1] + chord * length / drawn);
    }
    let segments = chords.len();
    let evaluate = |k: usize, s: f64| {
        let arc = at[k + 1] - at[k];
        let x = ((s - at[k]) / arc).clamp(0.0, 1.0);
        segment(points[k], points[k + 1], arc, x, if slack { sag } else { Sag::default() })
    };
    s.iter()
        .map(|&s| {
            let k = at[1..segments].partition_point(|&end| end <= s + 1e-9 * length);
            let (position, slope) = evaluate(k, s);
            // a corner that falls on a node takes the mean direction
            if k > 0 && (s - at[k]).abs() <= 1e-9 * length {
                let (_, before) = evaluate(k - 1, s);
                let mean = before + slope;
                let size = 0.5 * (before.norm() + slope.norm());
                let corner = ((before - slope).norm() > 1e-9 * size).then_some([before, slope]);
                let slope = if mean.norm() > 1e-6 * size { mean.normalize() * size } else { slope };
                return Laid { position, slope, corner };
            }
            Laid { position, slope, corner: None }
        })
        .collect()
}

/// The directions of the drawing itself at the arc lengths `s`, as unit vectors; at a corner the
/// mean of both sides.
pub(super) fn directions(points: &[Vector3<f64>], s: &[f64]) -> Vec<Vector3<f64>> {
    let drawn: f64 = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    let share = drawn / s[s.len() - 1];
    let s: Vec<f64> = s.iter().map(|s| s * share).collect();
    along_polyline(points, &s, Sag::default()).iter().map(|laid| laid.slope.normalize()).collect()
}

/// Position and slope at the share `x` of a segment from `a` to `b` that holds `arc` of cable;
/// [arcs](Sag) of circles towards `sag` if that is not zero, else straight.
fn segment(
    a: Vector3<f64>,
    b: Vector3<f64>,
    arc: f64,
    x: f64,
    Sag { towards, lead }: Sag,
) -> (Vector3<f64>, Vector3<f64>) {
    let chord = b - a;
    let straight = (a + x * chord, chord / arc);
    let ratio = chord.norm() / arc;
    if ratio >= 1.0 || towards == Vector3::zeros() && ratio > 0.999_999_999 {
        return straight;
    }
    let along = chord.normalize();
    let down = normal_of(&along, &towards);
    let most = half_angle(ratio);
    // the second half is the mirror image of the first
    let near = x.min(1.0 - x);
    let (angle, [out, below]) = if near < lead {
        let (angle, radius) = (most * near / lead, lead * arc / most);
        (angle, [radius * angle.sin(), radius * (1.0 - angle.cos())])
    } else {
        let angle = most * (1.0 - 2.0 * near) / (1.0 - 2.0 * lead);
        let [first, radius] = [lead * arc / most, (0.5 - lead) * arc / most];
        let out = first * most.sin() + radius * (most.sin() - angle.sin());
        (angle, [out, first * (1.0 - most.cos()) + radius * (angle.cos() - most.cos())])
    };
    let (end, side) = if x <= 0.5 { (a, 1.0) } else { (b, -1.0) };
    (end + along * (side * out) + down * below, along * angle.cos() + down * (side * angle.sin()))
}

/// The unit normal of a direction that is nearest to another, or a fixed one of a parallel.
pub(super) fn normal_of(along: &Vector3<f64>, sag: &Vector3<f64>) -> Vector3<f64> {
    let mut down = sag - along * sag.dot(along);
    if down.norm() <= 1e-6 * sag.norm() || down.norm() == 0.0 {
        // a vertical segment sags towards any fixed normal
        let axis = if along.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        down = axis - along * axis.dot(along);
    }
    down.normalize()
}

/// The half angle of an arc whose chord is `ratio` of its length: sin(y)/y = ratio, 0 < y < pi.
fn half_angle(ratio: f64) -> f64 {
    let (mut low, mut high) = (0.0f64, std::f64::consts::PI);
    for _ in 0..200 {
        let y = 0.5 * (low + high);
        if y.sin() > ratio * y {
            low = y;
        } else {
            high = y;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn unzip(laid: &[Laid]) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
        laid.iter().map(|node| (node.position, node.slope)).unzip()
    }

    #[test]
    fn a_slack_cable_is_laid_in_an_arc_of_its_own_length_below_the_chord() {
        let points = [Vector3::zeros(), Vector3::new(3.0, 0.0, 0.0)];
        let s: Vec<f64> = (0..=1000).map(|i| 4.0 * f64::from(i) / 1000.0).collect();
        let (r, t) = unzip(&along_polyline(&points, &s, Sag::along(Vector3::new(0.0, -9.81, 0.0))));
        let length: f64 = r.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
        assert_relative_eq!(length, 4.0, max_relative = 1e-5);
        assert_relative_eq!(r[0], points[0], epsilon = 1e-12);
        assert_relative_eq!(r[1000], points[1], epsilon = 1e-12);
        assert!(r[500].y < -1.0 && t.iter().all(|t| (t.norm() - 1.0).abs() < 1e-12));
    }

    /// With leads a segment has its length too, leaves along its chord at both ends, and stays
    /// between them.
    #[test]
    fn a_lead_leaves_along_the_chord() {
        for (arc, lead) in [(3.4, 0.25), (6.0, 0.25), (9.0, 0.25), (2.1, 0.1)] {
            let points = [Vector3::new(1.0, 2.0, 0.0), Vector3::new(3.0, 2.0, 0.0)];
            let s: Vec<f64> = (0..=4000).map(|i| arc * f64::from(i) / 4000.0).collect();
            let (r, t) = unzip(&along_polyline(&points, &s, Sag { towards: -Vector3::y(), lead }));
            let length: f64 = r.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
            assert_relative_eq!(length, arc, max_relative = 1e-5);
            assert!((0..=4000).step_by(4000).all(|k| (r[k] - points[k / 4000]).norm() < 1e-12));
            assert!(t.iter().all(|t| (t.norm() - 1.0).abs() < 1e-12));
            assert!([0, 4000].iter().all(|&k| (t[k] - Vector3::x()).norm() < 1e-12));
            for k in 1..4000 {
                let slope = (r[k + 1] - r[k - 1]) / (s[k + 1] - s[k - 1]);
                assert!((slope - t[k]).norm() < 1e-2, "{k}");
                assert!((1.0..=3.0).contains(&r[k].x), "{k}: {}", r[k].x);
            }
        }
    }

    #[test]
    fn a_taut_cable_follows_the_polyline_evenly_stretched() {
        let points = [Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0), Vector3::new(1.0, 2.0, 0.0)];
        let laid = along_polyline(&points, &[0.0, 0.5, 1.0, 1.5], Sag::default());
        let (r, t) = unzip(&laid);
        assert_relative_eq!(r[1], Vector3::new(1.0, 0.0, 0.0), epsilon = 1e-12);
        assert_relative_eq!(r[2], Vector3::new(1.0, 1.0, 0.0), epsilon = 1e-12);
        assert_relative_eq!(t[0].norm(), 2.0, epsilon = 1e-12);
        assert_relative_eq!(t[1].x, t[1].y, epsilon = 1e-12);
        assert_eq!(laid[1].corner, Some([2.0 * Vector3::x(), 2.0 * Vector3::y()]));
        assert!([0, 2, 3].iter().all(|&k| laid[k].corner.is_none()));
    }
}
