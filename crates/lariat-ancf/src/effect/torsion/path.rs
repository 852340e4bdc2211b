//! The twist that a change of the shape adds which no step makes: along great circles.
//!
//! # Equation
//!
//! Each direction (node, middle, node) goes along its great circle. The change of a pair is the
//! area of the geodesic quadrilateral between both paths ([`pair`](super::pair)), and areas add:
//!
//! ```text
//! D Psi(0 -> 1) = sum_k D Psi(s_k -> s_k+1)        D Phi = D Psi(x, mu) + D Psi(mu, y) - D det(x, mu, y)/6
//! ```
//!
//! so that one change is the sum of any parts of it. It is divided until none of its parts slips.
//!
//! # Validity
//!
//! Directions that turn by less than half a turn, and pairs within 120 degrees all the way: what is
//! beyond is a slip, and counted. A change that is to go another way, as of a body that turns about
//! an axis that is not across, is to be given in parts.

use super::pair::change;
use crate::scales::effect::{FINEST_PART, LONGEST_PART};
use nalgebra::Vector3;

/// The way of a direction.
#[derive(Clone, Copy, Debug)]
struct Arc {
    ends: [Vector3<f64>; 2],
    /// Unit vector across the first, towards the last; `None` where there is no great circle.
    across: Option<Vector3<f64>>,
    /// Angle in rad.
    angle: f64,
}

impl Arc {
    fn between(from: Vector3<f64>, to: Vector3<f64>) -> Self {
        let angle = from.cross(&to).norm().atan2(from.dot(&to));
        let across = (to * from.norm_squared() - from * from.dot(&to)).try_normalize(f64::MIN_POSITIVE);
        Arc { ends: [from, to], across: across.filter(|_| from.norm_squared() > 0.0), angle }
    }

    /// Returns the direction after a part k of n; its length changes evenly.
    fn at(&self, k: u32, n: u32) -> Vector3<f64> {
        let [from, to] = &self.ends;
        if k == 0 || k == n {
            return self.ends[usize::from(k == n)];
        }
        let share = f64::from(k) / f64::from(n);
        let Some(across) = self.across else { return from.lerp(to, share) };
        let (length, (sin, cos)) = (from.norm(), (share * self.angle).sin_cos());
        (from * (cos / length) + across * sin) * (length + share * (to.norm() - length))
    }
}

/// Returns the twist in rad that an element adds between two [sets of
/// directions](super::element::directions), and the number of its pairs that slip.
pub(super) fn twist_along(from: [Vector3<f64>; 3], to: [Vector3<f64>; 3]) -> (f64, u64) {
    let arcs: [Arc; 3] = core::array::from_fn(|k| Arc::between(from[k], to[k]));
    let longest = arcs.iter().map(|arc| arc.angle).fold(0.0, f64::max);
    let mut parts = (longest / LONGEST_PART).ceil().max(1.0) as u32;
    let (mut angle, mut slips) = march(&arcs, parts);
    while slips > 0 && longest > FINEST_PART * f64::from(parts) {
        parts *= 2;
        (angle, slips) = march(&arcs, parts);
    }
    let det = |[x, m, y]: [Vector3<f64>; 3]| x.dot(&m.cross(&y));
    (angle - (det(to) - det(from)) / 6.0, slips)
}

/// Returns the change of both pairs in so many parts, and how many of them slip.
fn march(arcs: &[Arc; 3], parts: u32) -> (f64, u64) {
    let (mut sum, mut slips) = (0.0, [false; 2]);
    let mut before = arcs.map(|arc| arc.at(0, parts));
    for part in 1..=parts {
        let now = arcs.map(|arc| arc.at(part, parts));
        for (pair, slips) in slips.iter_mut().enumerate() {
            let own = change([&before[pair], &now[pair]], [&before[pair + 1], &now[pair + 1]]);
            sum += own.angle;
            *slips |= own.slips;
        }
        before = now;
    }
    (sum, slips.iter().map(|slips| u64::from(*slips)).sum())
}
