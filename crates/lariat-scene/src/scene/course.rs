//! Where a body is at any time if nothing pulls at it: a constant velocity, or a path through rows.
//!
//! # Equation
//!
//! Between rows linear, or by [`smooth`] cubics, whose rates are continuous: between equal rows the
//! body stays.
//!
//! Rotations are interpolated so by the rotation vector phi from row i on, q = q_i exp(phi), where d is
//! log(q_i^-1 q_{i+1})/h and angular velocities in axes of the body are rates of phi by the right
//! Jacobian: w = J(phi) phi'.
//!
//! # Validity
//!
//! That of [`smooth`]. Outside the rows the body rests, so that a path that begins or ends
//! in motion has a jump of the velocity there. A rotation from row to row is below half a turn.
//!
//! # References
//!
//! Sola et al. 2018, "A micro Lie theory", equations 143 and 144 (right Jacobian of SO(3)).

use lariat_ancf::{Motion, Vector3, smooth};
use nalgebra::{Matrix3, UnitQuaternion};
use serde::{Deserialize, Serialize};

/// Where a body starts, and where it goes if nothing pulls at it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// Origin at t = 0 in m.
    pub position: Vector3<f64>,
    /// Rotation at t = 0.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of the origin in m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity in rad/s, world axes.
    pub angular_velocity: Vector3<f64>,
    /// Where it goes instead.
    pub path: Path,
}

/// Positions and rotations at times.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Positions of the origin, in s and m, by ascending time. Empty for none.
    pub positions: Vec<(f64, Vector3<f64>)>,
    /// Rotations, in s, by ascending time. Empty for none.
    pub rotations: Vec<(f64, UnitQuaternion<f64>)>,
    /// Whether the velocity is continuous from row to row.
    pub smooth: bool,
}

impl Course {
    /// Returns origin (m) and rotation at a time (s).
    pub fn pose(&self, time: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let position = self.path.position(time).map_or(self.position + self.velocity * time, |(x, _)| x);
        let turned = || UnitQuaternion::from_scaled_axis(self.angular_velocity * time) * self.rotation;
        (position, self.path.rotation(time).map_or_else(turned, |(q, _)| q))
    }

    /// Returns whether it stays where it starts.
    pub fn is_at_rest(&self) -> bool {
        self.path == Path::default() && (self.velocity, self.angular_velocity) == Default::default()
    }

    /// Returns velocity of the origin (m/s) and angular velocity (rad/s, world axes) at a time (s); at a row of the path those of
    /// the part which begins there.
    pub fn velocities(&self, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        (
            self.path.position(time).map_or(self.velocity, |(_, v)| v),
            self.path.rotation(time).map_or(self.angular_velocity, |(_, w)| w),
        )
    }
}

impl Path {
    /// Returns the times in s at which the velocity may jump.
    pub fn corners(&self) -> impl Iterator<Item = f64> {
        let places = self.positions.iter().map(|(t, _)| *t).enumerate().map(|(i, t)| (i, self.positions.len(), t));
        let turns = self.rotations.iter().map(|(t, _)| *t).enumerate().map(|(i, t)| (i, self.rotations.len(), t));
        places.chain(turns).filter(|&(i, rows, _)| !self.smooth || i == 0 || i + 1 == rows).map(|(_, _, t)| t)
    }

    /// Returns position (m) and velocity (m/s) at a time (s); `None` without rows.
    fn position(&self, time: f64) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let rows = &self.positions;
        let (i, since) = match interval(rows, time)? {
            Interval::Outside(row) => return Some((rows[row].1, Vector3::zeros())),
            Interval::Within(i, since) => (i, since),
        };
        let h = rows[i + 1].0 - rows[i].0;
        let mean = |i: usize| (rows[i + 1].1 - rows[i].1) / (rows[i + 1].0 - rows[i].0);
        if !self.smooth {
            return Some((rows[i].1 + mean(i) * since, mean(i)));
        }
        let (way, velocity) =
            cubic(h, since, &(rows[i + 1].1 - rows[i].1), [rate(rows, i, mean), rate(rows, i + 1, mean)]);
        Some((rows[i].1 + way, velocity))
    }

    /// Returns rotation and angular velocity (rad/s, world axes) at a time (s); `None` without rows.
    fn rotation(&self, time: f64) -> Option<(UnitQuaternion<f64>, Vector3<f64>)> {
        let rows = &self.rotations;
        let (i, since) = match interval(rows, time)? {
            Interval::Outside(row) => return Some((rows[row].1, Vector3::zeros())),
            Interval::Within(i, since) => (i, since),
        };
        let h = rows[i + 1].0 - rows[i].0;
        let turn = |i: usize| (rows[i].1.inverse() * rows[i + 1].1).scaled_axis();
        let mean = |i: usize| turn(i) / (rows[i + 1].0 - rows[i].0);
        let (phi, spin) = if self.smooth {
            let end = turn(i);
            let (phi, change) =
                cubic(h, since, &end, [rate(rows, i, mean), right_jacobian_inverse(&end) * rate(rows, i + 1, mean)]);
            (phi, right_jacobian(&phi) * change)
        } else {
            (mean(i) * since, mean(i))
        };
        let rotation = rows[i].1 * UnitQuaternion::from_scaled_axis(phi);
        Some((rotation, rotation * spin))
    }
}

/// Where a time is among rows.
enum Interval {
    /// Before the first row, or after the last one: at that.
    Outside(usize),
    /// Behind a row, by so much in s, and before the next.
    Within(usize, f64),
}

fn interval<T>(rows: &[(f64, T)], time: f64) -> Option<Interval> {
    let next = rows.partition_point(|(t, _)| *t <= time);
    let last = rows.len().checked_sub(1)?;
    Some(match next.checked_sub(1) {
        None => Interval::Outside(0),
        Some(i) if i == last => Interval::Outside(last),
        Some(i) => Interval::Within(i, time - rows[i].0),
    })
}

/// Returns the rate at a row, by the mean rates of the intervals.
fn rate<T>(rows: &[(f64, T)], row: usize, mean: impl Fn(usize) -> Vector3<f64>) -> Vector3<f64> {
    smooth::rate(rows.len(), row, |i| rows[i + 1].0 - rows[i].0, mean)
}

/// Returns the cubic from 0 to `way` in a time h with the rates at its ends, and its rate, at a time.
fn cubic(h: f64, time: f64, way: &Vector3<f64>, [from, to]: [Vector3<f64>; 2]) -> (Vector3<f64>, Vector3<f64>) {
    let [value, rate, _] = Motion::hermite(0.0, h, (Vector3::zeros(), from), (*way, to)).at(time);
    (value, rate)
}

fn right_jacobian(phi: &Vector3<f64>) -> Matrix3<f64> {
    let (cross, square) = (phi.cross_matrix(), phi.norm_squared());
    let angle = square.sqrt();
    // by their series below a hundredth, where the next terms are rounding
    let [a, b] = if angle < 1e-2 {
        [0.5 - square / 24.0 + square * square / 720.0, 1.0 / 6.0 - square / 120.0 + square * square / 5040.0]
    } else {
        [(1.0 - angle.cos()) / square, (angle - angle.sin()) / (square * angle)]
    };
    Matrix3::identity() - cross * a + cross * cross * b
}

fn right_jacobian_inverse(phi: &Vector3<f64>) -> Matrix3<f64> {
    let (cross, square) = (phi.cross_matrix(), phi.norm_squared());
    let angle = square.sqrt();
    let b = if angle < 1e-2 {
        1.0 / 12.0 + square / 720.0 + square * square / 30240.0
    } else {
        1.0 / square - 0.5 / (angle * (0.5 * angle).tan())
    };
    Matrix3::identity() + cross * 0.5 + cross * cross * b
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(rows: Vec<(f64, Vector3<f64>)>) -> Path {
        Path { positions: rows, ..Path::default() }
    }

    #[test]
    fn a_path_is_linear_between_its_rows_and_constant_outside() {
        let path =
            line(vec![(1.0, Vector3::zeros()), (2.0, Vector3::new(0.0, 4.0, 0.0)), (4.0, Vector3::new(0.0, 2.0, 0.0))]);
        for (time, y, v) in [
            (0.0, 0.0, 0.0),
            (1.0, 0.0, 4.0),
            (1.5, 2.0, 4.0),
            (2.0, 4.0, -1.0),
            (3.0, 3.0, -1.0),
            (4.0, 2.0, 0.0),
            (9.0, 2.0, 0.0),
        ] {
            let (position, velocity) = path.position(time).unwrap();
            assert_eq!((position.y, velocity.y), (y, v), "t = {time}");
        }
        assert_eq!(path.corners().collect::<Vec<_>>(), [1.0, 2.0, 4.0]);
        assert!(path.rotation(1.0).is_none());
    }

    #[test]
    fn a_smooth_path_stays_between_equal_rows() {
        let x = Vector3::x();
        let rows = vec![(0.0, x), (1.0, x), (2.0, 2.0 * x), (3.0, 2.0 * x), (3.5, 2.0 * x), (5.0, x)];
        let path = Path { smooth: true, ..line(rows) };
        for (time, at) in [(0.0, 1.0), (0.5, 1.0), (1.0, 1.0), (2.0, 2.0), (2.7, 2.0), (3.2, 2.0), (3.5, 2.0)] {
            assert_eq!(path.position(time), Some((at * x, Vector3::zeros())), "t = {time}");
        }
        let (halfway, speed) = path.position(1.5).unwrap();
        assert!((halfway.x - 1.5).abs() < 1e-15 && (speed.x - 1.5).abs() < 1e-15, "{halfway} {speed}");
    }

    #[test]
    fn a_smooth_path_is_a_parabola_through_rows_of_one_and_converges_to_a_wave() {
        let parabola = |t: f64| Vector3::new(3.0 * t * t - t, 0.5 - t, 2.0);
        let times = [0.0, 0.3, 0.5, 1.4, 2.0];
        let path = Path { smooth: true, ..line(times.map(|t| (t, parabola(t))).to_vec()) };
        for t in [0.0, 0.1, 0.4, 0.77, 1.4, 1.9] {
            let (x, v) = path.position(t).unwrap();
            assert!((x - parabola(t)).norm() < 1e-14, "t = {t}: {x}");
            assert!((v - Vector3::new(6.0 * t - 1.0, -1.0, 0.0)).norm() < 1e-13, "t = {t}: {v}");
        }
        let wave = |rows: usize| {
            let row = |i: usize| 2.0 * i as f64 / rows as f64;
            let rows = (0..=rows).map(|i| (row(i), Vector3::x() * (3.0 * row(i)).sin())).collect();
            let path = Path { smooth: true, ..line(rows) };
            (0..200)
                .map(|i| (path.position(0.01 * f64::from(i)).unwrap().0.x - (0.03 * f64::from(i)).sin()).abs())
                .fold(0.0, f64::max)
        };
        // order 3 at the least
        assert!(wave(40) < wave(20) / 7.0 && wave(80) < wave(40) / 7.0 && wave(80) < 1e-4, "{} {}", wave(20), wave(80));
    }

    #[test]
    fn a_smooth_rotation_turns_about_a_fixed_axis_and_has_the_angular_velocity_of_its_differences() {
        let axis = Vector3::new(1.0, -2.0, 0.5).normalize();
        let angle = |t: f64| 2.5 * t * t + 0.3 * t;
        let turned = |t: f64| UnitQuaternion::from_scaled_axis(axis * angle(t));
        let times = [0.0, 0.4, 0.7, 1.0, 1.3];
        let path = Path { smooth: true, rotations: times.map(|t| (t, turned(t))).to_vec(), ..Path::default() };
        for t in [0.0, 0.2, 0.5, 0.99, 1.2] {
            let (q, w) = path.rotation(t).unwrap();
            assert!(q.angle_to(&turned(t)) < 1e-7, "t = {t}");
            assert!((w - axis * (5.0 * t + 0.3)).norm() < 1e-12, "t = {t}: {w}");
        }
        // any rotations: the angular velocity is that of central differences, and does not jump at a row
        let row = |t: f64, x: f64, y: f64, z: f64| (t, UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z)));
        let rotations =
            vec![row(0.0, 0.0, 0.3, 0.0), row(0.5, 1.0, 0.4, -1.4), row(0.8, 2.0, 1.0, 0.3), row(2.0, 0.0, 1.0, 0.0)];
        for smooth in [false, true] {
            let path = Path { smooth, rotations: rotations.clone(), ..Path::default() };
            for t in [0.1, 0.31, 0.6, 1.1, 1.9] {
                let (d, (_, w)) = (1e-5, path.rotation(t).unwrap());
                let [before, behind] = [t - d, t + d].map(|t| path.rotation(t).unwrap().0);
                let difference = (behind * before.inverse()).scaled_axis() / (2.0 * d);
                assert!((difference - w).norm() < 1e-8 * (1.0 + w.norm()), "t = {t}: {w} {difference}");
            }
            let jump = [0.5, 0.8].map(|t| (path.rotation(t - 1e-9).unwrap().1 - path.rotation(t).unwrap().1).norm());
            assert_eq!(jump.iter().all(|jump| *jump < 1e-6), smooth, "{jump:?}");
        }
        let path = Path { smooth: true, rotations, ..Path::default() };
        assert_eq!(path.corners().collect::<Vec<_>>(), [0.0, 2.0]);
    }
}
