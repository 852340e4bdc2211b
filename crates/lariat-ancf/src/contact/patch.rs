//! Patches: what the surface of an obstacle looks like from a point of the cable, for the time of a
//! step.
//!
//! # Equation
//!
//! ```text
//! plane         g = n . y                  gbar = n_m
//! point         g = |y| - R                gbar = 2 y_m/(|y0| + |y1|)
//! line          g = |z| - R                gbar = 2 (y_m - s_m a_m)/(|z0| + |z1|)       z = y - s a, s = a . y
//! ```
//!
//! with y from a point of the patch, its axis a, and means over both ends; so `gbar . s = g1 - g0`
//! exactly, s the motion beside the obstacle ([`path`](super::path)), which may turn. If z turns by
//! more than 20 degrees in a step, on a way that goes deeper than half the reach, the patch is for
//! this step the plane that touches it where the way of the point meets it: the distance from a
//! line alone would let a point pass through it. A point that slides would be braked there: the
//! step of one that touched before is divided.

use super::path::ObstacleStep;
use crate::obstacle::Patch;
use crate::scales::contact::{MAX_DEPTH, MAX_TURN};
use nalgebra::Vector3;

/// The gap between a point of the centre line and a patch over a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct GapStep {
    /// At the beginning, in m.
    pub start: f64,
    /// At the end, in m.
    pub end: f64,
    /// Mean gradient gbar.
    pub mean: Vector3<f64>,
    /// Gradient at the end.
    pub normal: Vector3<f64>,
    /// Whether a plane took the place of a line or a point.
    pub replaced: bool,
}

impl Patch {
    /// Returns the gap over a step in which the point at `x` moves by `change`; the surface is met
    /// at the gap `reach`; without one the way is not asked whether it goes through.
    #[inline]
    pub(in crate::contact) fn over_step(
        &self,
        obstacle: &ObstacleStep,
        x: &Vector3<f64>,
        change: &Vector3<f64>,
        reach: Option<f64>,
    ) -> GapStep {
        match *self {
            Patch::Plane { point, normal } => {
                let [y0, y1] = obstacle.beside(&point, x, change);
                let [n0, n1] = obstacle.ends(&normal);
                GapStep { start: n0.dot(&y0), end: n1.dot(&y1), mean: 0.5 * (n0 + n1), normal: n1, replaced: false }
            }
            Patch::Line { point, direction, radius } => {
                let [y0, y1] = obstacle.beside(&point, x, change);
                let [a0, a1] = obstacle.ends(&direction);
                let (s0, s1) = (a0.dot(&y0), a1.dot(&y1));
                // half the gradient of |z|^2
                let half = 0.5 * (y0 + y1) - 0.25 * (s0 + s1) * (a0 + a1);
                radial([y0 - a0 * s0, y1 - a1 * s1], half, obstacle, radius, reach)
            }
            Patch::Point { point, radius } => {
                let [z0, z1] = obstacle.beside(&point, x, change);
                radial([z0, z1], 0.5 * (z0 + z1), obstacle, radius, reach)
            }
        }
    }
}

/// Returns the gap |z| - R over a step; `half` times the relative motion is half the change of
/// |z|^2.
fn radial(
    [z0, z1]: [Vector3<f64>; 2],
    half: Vector3<f64>,
    obstacle: &ObstacleStep,
    radius: f64,
    reach: Option<f64>,
) -> GapStep {
    let (l0, l1) = (z0.norm(), z1.norm());
    if let Some(reach) = reach
        && z0.dot(&z1) < MAX_TURN * l0 * l1
        && radius + (1.0 - MAX_DEPTH) * reach > least(&z0, &z1)
        && let Some(n) = meets(&z0, &z1, l0, radius + reach)
    {
        let end = obstacle.carry(&n);
        return GapStep {
            start: n.dot(&z0) - radius,
            end: end.dot(&z1) - radius,
            mean: 0.5 * (n + end),
            normal: end,
            replaced: true,
        };
    }
    let sum = l0 + l1;
    if sum <= 0.0 {
        return GapStep { start: -radius, end: -radius, mean: Vector3::x(), normal: Vector3::x(), replaced: false };
    }
    let normal = if l1 > 0.0 { z1 / l1 } else { z0 / l0 };
    GapStep { start: l0 - radius, end: l1 - radius, mean: half * (2.0 / sum), normal, replaced: false }
}

/// Returns the least length of z on a straight way.
fn least(z0: &Vector3<f64>, z1: &Vector3<f64>) -> f64 {
    let way = z1 - z0;
    let share = (-z0.dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (z0 + way * share).norm()
}

/// Returns the normal where the way from z0 to z1 meets the distance `reach`, that at z0 if it
/// begins within; `None` if it passes by.
fn meets(z0: &Vector3<f64>, z1: &Vector3<f64>, l0: f64, reach: f64) -> Option<Vector3<f64>> {
    if l0 <= reach {
        return (l0 > 0.0).then(|| z0 / l0);
    }
    let way = z1 - z0;
    let (a, b) = (way.norm_squared(), z0.dot(&way));
    let root = b * b - a * (l0 * l0 - reach * reach);
    if root < 0.0 || b >= 0.0 || -b - root.sqrt() > a {
        return None;
    }
    (z0 + way * ((-b - root.sqrt()) / a)).try_normalize(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obstacle::RigidMotion;
    use nalgebra::UnitQuaternion;

    fn patches() -> [Patch; 3] {
        let (point, direction) = (Vector3::new(0.1, -0.2, 0.05), Vector3::new(0.6, 0.0, 0.8));
        [
            Patch::Plane { point, normal: direction },
            Patch::Line { point, direction, radius: 0.3 },
            Patch::Point { point, radius: 0.3 },
        ]
    }

    /// The mean normal times the relative motion is the change of the gap, exactly, and the end is
    /// that of the patch's own distance.
    ///
    /// *Source.* The distances |z| - R and n . z by their formulas.
    #[test]
    fn the_mean_normal_is_a_discrete_gradient_of_the_gap() {
        let (x, change) = (Vector3::new(0.5, 0.4, -0.3), Vector3::new(-0.03, 0.05, 0.02));
        let motion = RigidMotion {
            velocity: Vector3::new(1.0, -2.0, 0.5),
            rotation: UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9),
            ..RigidMotion::default()
        };
        let step = ObstacleStep::new(&motion, 0.0, 0.01);
        for patch in patches() {
            let gap = patch.over_step(&step, &x, &change, Some(0.005));
            let relative = change - 0.01 * motion.velocity;
            assert!((gap.mean.dot(&relative) - (gap.end - gap.start)).abs() < 1e-15, "{patch:?}");
            let own = motion.rotation.inverse() * (x + relative);
            let (end, normal) = patch.gap(&own);
            assert!((end - gap.end).abs() < 1e-15, "{patch:?}");
            assert!((motion.rotation * normal - gap.normal).norm() < 1e-14, "{patch:?}");
            // the normal is the gradient of the gap
            for k in 0..3 {
                let d = 1e-6 * Vector3::ith(k, 1.0);
                let slope = (patch.gap(&(own + d)).0 - patch.gap(&(own - d)).0) / 2e-6;
                assert!((slope - normal[k]).abs() < 1e-9, "{patch:?}");
            }
        }
    }

    /// A drum that turns about its axis does not move the gap; a ball that turns about its centre
    /// neither.
    ///
    /// *Source.* Symmetry.
    #[test]
    fn a_turn_about_its_own_axis_changes_no_gap() {
        let direction = Vector3::new(0.6, 0.0, 0.8);
        let motion = RigidMotion { angular_velocity: 90.0 * direction, ..RigidMotion::default() };
        let step = ObstacleStep::new(&motion, 0.0, 1.0 / 240.0);
        let point = Vector3::zeros();
        for patch in [Patch::Line { point, direction, radius: 0.3 }, Patch::Point { point, radius: 0.3 }] {
            let gap = patch.over_step(&step, &Vector3::new(0.0, 0.305, 0.0), &Vector3::zeros(), Some(0.005));
            assert_eq!(gap.start, gap.end);
            assert!((gap.mean - Vector3::y()).norm() < 1e-15);
        }
    }

    /// A point that is carried through a thin rod in one step is behind it, not beside it; one that
    /// passes by is not.
    ///
    /// *Source.* Geometry.
    #[test]
    fn a_way_through_a_rod_ends_behind_its_face() {
        let patch = Patch::Line { point: Vector3::zeros(), direction: Vector3::z(), radius: 0.003 };
        let step = ObstacleStep::new(&RigidMotion::default(), 0.0, 0.01);
        let fall = Vector3::new(0.0, -0.1, 0.0);
        let through = patch.over_step(&step, &Vector3::new(0.001, 0.05, 0.0), &fall, Some(0.005));
        assert!(through.end < -0.05 && through.start > 0.04, "{through:?}");
        let beside = patch.over_step(&step, &Vector3::new(0.02, 0.05, 0.0), &fall, Some(0.005));
        assert!(beside.end > 0.04, "{beside:?}");
    }
}
