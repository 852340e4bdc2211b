//! Whether centre lines went through each other in a step, whatever the search for contacts found.
//!
//! # Equation
//!
//! Chords that move evenly from the beginning to the end of a step can meet only when their four
//! ends are in a plane:
//!
//! ```text
//! f(t) = (a1 - a0) x (b1 - b0) . (b0 - a0) = 0        a cubic of the share t of the step
//! ```
//!
//! They meet if at such a share the lines intersect within both chords.
//!
//! # Validity
//!
//! Exact for the chords, whose distance from the curves is of the order of a hundredth of their
//! length. Chords that stay in one plane have f = 0 at all times, and are not found.
//!
//! # References
//!
//! Provot, Graphics Interface 1997, 177 (collision of edges that move).

use super::chords::closest;
use crate::scales::contact::{CROSSING_ROUNDING, HALVINGS};
use nalgebra::Vector3;

/// A point at the beginning of a step, and its change.
pub(in crate::contact) type Moved = [Vector3<f64>; 2];

/// Where two chords go through each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::contact) struct Crossing {
    /// Share of the step at which they do.
    pub share: f64,
    /// 1 or -1, the opposite of that of the way back.
    pub sense: i32,
    /// Where they meet, as shares of the chords.
    pub at: [f64; 2],
}

/// Returns where two chords first go through each other in the step, if they do.
pub(in crate::contact) fn crossing([a0, a1]: [&Moved; 2], [b0, b1]: [&Moved; 2]) -> Option<Crossing> {
    let [u, v, w] = [[a1, a0], [b1, b0], [b0, a0]].map(|[p, q]| [p[0] - q[0], p[1] - q[1]]);
    let triple = |i: usize, j: usize, k: usize| u[i].cross(&v[j]).dot(&w[k]);
    let cubic = [
        triple(0, 0, 0),
        triple(1, 0, 0) + triple(0, 1, 0) + triple(0, 0, 1),
        triple(1, 1, 0) + triple(1, 0, 1) + triple(0, 1, 1),
        triple(1, 1, 1),
    ];
    let f = |t: f64| ((cubic[3] * t + cubic[2]) * t + cubic[1]) * t + cubic[0];
    let mut low = 0.0;
    for high in turning_points(&cubic).into_iter().chain([1.0]) {
        if high <= low {
            continue;
        }
        if let Some(share) = root(f, low, high)
            && let Some(at) = meeting([a0, a1].map(|x| x[0] + x[1] * share), [b0, b1].map(|x| x[0] + x[1] * share))
        {
            return Some(Crossing { share, sense: if f(high) > 0.0 { 1 } else { -1 }, at });
        }
        low = high;
    }
    None
}

/// Returns the shares at which a cubic turns round, in ascending order, within the step.
fn turning_points([_, c1, c2, c3]: &[f64; 4]) -> [f64; 2] {
    let (half, product) = (-c2, 3.0 * c3 * c1);
    let root = (half * half - product).max(0.0).sqrt();
    // without cancellation
    let q = half + root.copysign(half);
    let [x, y] = [q / (3.0 * c3), c1 / q].map(|t| if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 });
    [x.min(y), x.max(y)]
}

/// Returns where a monotone function changes its sign.
fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> Option<f64> {
    let positive = f(low) > 0.0;
    if (f(high) > 0.0) == positive {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if (f(middle) > 0.0) == positive {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(high)
}

/// Returns where two segments in a plane meet, as shares of them, if they do.
fn meeting(a: [Vector3<f64>; 2], b: [Vector3<f64>; 2]) -> Option<[f64; 2]> {
    let (u, v) = (a[1] - a[0], b[1] - b[0]);
    let (uu, vv, uv) = (u.norm_squared(), v.norm_squared(), u.dot(&v));
    let w = b[0] - a[0];
    let determinant = uu * vv - uv * uv;
    let (s, t) = if determinant > 1e-12 * uu * vv {
        ((w.dot(&u) * vv - w.dot(&v) * uv) / determinant, (w.dot(&u) * uv - w.dot(&v) * uu) / determinant)
    } else {
        closest(a, b)
    };
    let within = -CROSSING_ROUNDING..=1.0 + CROSSING_ROUNDING;
    let apart = (w + v * t - u * s).norm_squared();
    let meets = within.contains(&s) && within.contains(&t) && apart < CROSSING_ROUNDING * (uu + vv);
    meets.then_some([s, t])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Segments that move at random cross where a fine sampling of their motion finds that the line
    /// through one changes the side of the other within both.
    ///
    /// *Source.* The volume of the tetrahedron of the ends at 4000 times, whose sign changes while
    /// the segments overlap seen along its normal.
    #[test]
    fn crossings_are_those_of_a_fine_sampling() {
        let mut x = 0.137;
        let mut next = || {
            x = (x * 997.0 + 0.123_f64).fract();
            2.0 * x - 1.0
        };
        let mut crossed = 0;
        for _ in 0..400 {
            let mut moved = || {
                let mut point = || Vector3::new(next(), next(), next());
                [point(), point() * 2.0]
            };
            let p = [moved(), moved(), moved(), moved()];
            let at = |t: f64| p.map(|x| x[0] + x[1] * t);
            let volume = |t: f64| {
                let [a, b, c, d] = at(t);
                (b - a).cross(&(d - c)).dot(&(c - a))
            };
            let overlap = |t: f64| {
                let [a, b, c, d] = at(t);
                let n = (b - a).cross(&(d - c));
                let side = |p: Vector3<f64>, q: Vector3<f64>, x: Vector3<f64>| (q - p).cross(&(x - p)).dot(&n);
                side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
            };
            let times = (0..4000).map(|i| f64::from(i) / 4000.0);
            let expected = times.filter(|t| volume(*t) * volume(t + 1.0 / 4000.0) < 0.0 && overlap(*t)).count() > 0;
            let found = crossing([&p[0], &p[1]], [&p[2], &p[3]]);
            assert_eq!(found.is_some(), expected, "{p:?}");
            crossed += usize::from(expected);
        }
        assert!((50..350).contains(&crossed), "{crossed}");
    }
}
