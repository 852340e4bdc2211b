//! How an obstacle moves in a step, and what a point of the cable does beside it.
//!
//! # Equation
//!
//! The obstacle turns from R0 to R1 by the Cayley map of a vector 2 a: `R1 b - R0 b = 2 a x (R0 b +
//! R1 b)/2`. Beside it, with the place `y = x - c` from a material point c of it, the point x moves
//! by
//!
//! ```text
//! s = D y - 2 a x y_m,    y_m = (y0 + y1)/2
//! ```
//!
//! for any choice of c. This is what a force f on the cable and -f on the obstacle work on if -f
//! acts on the line through x, with the moment `-y_m x f` about c; so momentum and angular momentum
//! are kept. Invariants of the relative place change by products with s, exactly:
//!
//! ```text
//! D (n . y) = n_m . s        D |y|^2 = 2 y_m . s        n carried by the obstacle, n_m = (n0 + n1)/2
//! ```
//!
//! # References
//!
//! Gonzalez, J. Nonlinear Sci. 6 (1996) 449 (discrete gradients of invariants); Simo & Wong, IJNME
//! 31 (1991) 19.

use crate::obstacle::{Mount, Pose, RigidMotion};
use crate::scales::contact::MAX_HALF_TURN;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

/// The motion of a body of the island over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyPath {
    /// Centre of mass at the beginning, in m.
    pub centre: Vector3<f64>,
    /// Its displacement in m.
    pub displacement: Vector3<f64>,
    /// Attitude at the beginning.
    pub rotation: UnitQuaternion<f64>,
    /// The vector a of the Cayley map: half the step times the mean angular velocity.
    pub half: Vector3<f64>,
    /// Whether its present state is not that of the last step: others moved it.
    pub moved: bool,
}

/// The motion of an obstacle over a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct ObstacleStep {
    pub start: Pose,
    pub end: Pose,
    /// Axes half way.
    pub middle: Matrix3<f64>,
    /// The material point c: in the obstacle's axes, and at the beginning.
    centre: [Vector3<f64>; 2],
    /// Its displacement over the step.
    shift: Vector3<f64>,
    /// The vector a.
    half: Vector3<f64>,
    /// R1 - R0.
    turn: Matrix3<f64>,
    /// Whether the axes turn.
    turns: bool,
    /// Prescribed velocity of that point and angular velocity, at the end; zero if a body carries
    /// it.
    velocity: [Vector3<f64>; 2],
    /// Whether its motion is prescribed, and not rest.
    pub driven: bool,
    /// The body of the island that carries it.
    pub body: Option<usize>,
    /// Whether others moved that body since the last step.
    pub moved: bool,
    /// Length of the step in s.
    pub h: f64,
}

impl ObstacleStep {
    /// Of a prescribed motion, over a step of length `h` (s) from a time (s) on.
    pub fn new(motion: &RigidMotion, time: f64, h: f64) -> Self {
        let spin = motion.angular_velocity;
        let turns = spin != Vector3::zeros();
        let start = motion.pose(time);
        let (end, middle) = if turns {
            (motion.pose(time + h), motion.pose(time + 0.5 * h).rotation)
        } else {
            (Pose { position: start.position + motion.velocity * h, ..start }, start.rotation)
        };
        let angle = (0.5 * h * spin.norm()).min(MAX_HALF_TURN);
        ObstacleStep {
            start,
            end,
            middle,
            centre: [motion.centre, start.position + start.rotation * motion.centre],
            shift: motion.velocity * h,
            half: spin.try_normalize(0.0).unwrap_or_default() * angle.tan(),
            turn: end.rotation - start.rotation,
            turns,
            velocity: [motion.velocity, spin],
            driven: turns || motion.velocity != Vector3::zeros(),
            body: None,
            moved: false,
            h,
        }
    }

    /// Of an obstacle that a body of the island carries.
    pub fn carried(mount: &Mount, path: &BodyPath, h: f64) -> Self {
        let BodyPath { centre, displacement, rotation, half, moved } = *path;
        let turned = UnitQuaternion::new_normalize(Quaternion::from_parts(1.0, half));
        let half_way = UnitQuaternion::new_normalize(Quaternion::from_parts(turned.w + 1.0, turned.imag()));
        let at = |centre: Vector3<f64>, attitude: UnitQuaternion<f64>| Pose {
            position: centre + attitude * mount.position,
            rotation: *(attitude * mount.rotation).to_rotation_matrix().matrix(),
        };
        let (start, end) = (at(centre, rotation), at(centre + displacement, turned * rotation));
        ObstacleStep {
            start,
            end,
            middle: *(half_way * rotation * mount.rotation).to_rotation_matrix().matrix(),
            centre: [mount.rotation.inverse() * -mount.position, centre],
            shift: displacement,
            half,
            turn: end.rotation - start.rotation,
            turns: half != Vector3::zeros(),
            velocity: [Vector3::zeros(); 2],
            driven: false,
            body: Some(mount.body),
            moved,
            h,
        }
    }

    /// Returns the way of its fastest point within `distance` (m) of a point.
    pub fn way(&self, x: &Vector3<f64>, distance: f64) -> f64 {
        self.shift.norm() + 2.0 * self.half.norm() * ((x - self.centre[1]).norm() + distance)
    }

    /// Returns vectors in the world's axes from one of its points to a point of the cable, at both
    /// ends.
    #[inline]
    pub fn beside(&self, own: &Vector3<f64>, x: &Vector3<f64>, change: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let y0 = x - self.start.position - self.start.rotation * own;
        let moved = if self.turns { self.shift + self.turn * (own - self.centre[0]) } else { self.shift };
        [y0, y0 + (change - moved)]
    }

    /// Returns a vector of the obstacle in the world's axes, at both ends.
    pub fn ends(&self, own: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let start = self.start.rotation * own;
        [start, if self.turns { self.end.rotation * own } else { start }]
    }

    /// Returns what a vector in the world's axes at the beginning becomes if the obstacle carries
    /// it.
    pub fn carry(&self, start: &Vector3<f64>) -> Vector3<f64> {
        if self.turns { self.end.rotation * self.start.rotation.tr_mul(start) } else { *start }
    }

    /// Returns the mean place y_m of a point of the cable beside the material point c: of a body,
    /// its centre of mass.
    pub fn arm(&self, x: &Vector3<f64>, change: &Vector3<f64>) -> Vector3<f64> {
        x - self.centre[1] + 0.5 * (change - self.shift)
    }

    /// Returns the same place at three quarters of the step.
    pub fn lever(&self, x: &Vector3<f64>, change: &Vector3<f64>) -> Vector3<f64> {
        x - self.centre[1] + 0.75 * (change - self.shift)
    }

    /// Returns its prescribed velocity in m/s at the end of the step, at an arm from the material
    /// point c.
    pub fn velocity_at(&self, arm: &Vector3<f64>) -> Vector3<f64> {
        self.velocity[0] + self.velocity[1].cross(arm)
    }

    /// Returns the motion s of a point of the cable beside its material.
    #[inline]
    pub fn slip(&self, x: &Vector3<f64>, change: &Vector3<f64>) -> Vector3<f64> {
        let moved = change - self.shift;
        if self.turns { moved - 2.0 * self.half.cross(&self.arm(x, change)) } else { moved }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The products of the relative motion with mean vectors are the changes of the invariants, for
    /// a body and for a prescribed motion.
    ///
    /// *Source.* The invariants at both ends, by the poses.
    #[test]
    fn invariants_change_by_products_with_the_relative_motion() {
        let rotation = UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9);
        let path = BodyPath {
            centre: Vector3::new(0.3, -0.1, 0.2),
            displacement: Vector3::new(0.02, 0.03, -0.01),
            rotation,
            half: Vector3::new(0.2, -0.4, 0.3),
            moved: false,
        };
        let mount = Mount { body: 0, position: Vector3::new(0.1, 0.2, -0.1), rotation: rotation.inverse() };
        let motion = RigidMotion {
            centre: Vector3::new(0.1, 0.0, -0.2),
            position: Vector3::new(0.5, 0.1, 0.3),
            rotation,
            velocity: Vector3::new(1.0, -2.0, 0.5),
            angular_velocity: Vector3::new(20.0, 30.0, -10.0),
            ..RigidMotion::default()
        };
        let (x, change) = (Vector3::new(0.5, 0.4, -0.3), Vector3::new(-0.03, 0.05, 0.02));
        let (own, n) = (Vector3::new(0.05, -0.2, 0.1), Vector3::new(0.6, 0.0, 0.8));
        for step in [ObstacleStep::carried(&mount, &path, 0.01), ObstacleStep::new(&motion, 0.0, 0.01)] {
            let s = step.slip(&x, &change);
            let [y0, y1] = step.beside(&own, &x, &change);
            let at = |pose: &Pose, x: &Vector3<f64>| x - pose.position - pose.rotation * own;
            assert!((y0 - at(&step.start, &x)).norm() + (y1 - at(&step.end, &(x + change))).norm() < 1e-15);
            let [n0, n1] = step.ends(&n);
            assert!((0.5 * (n0 + n1).dot(&s) - (n1.dot(&y1) - n0.dot(&y0))).abs() < 1e-15);
            assert!(((y0 + y1).dot(&s) - (y1.norm_squared() - y0.norm_squared())).abs() < 1e-15);
            assert!((step.middle * step.middle.transpose() - Matrix3::identity()).norm() < 1e-14);
            // half way is half way
            let (a, b) = (step.start.rotation.transpose() * step.middle, step.middle.transpose() * step.end.rotation);
            assert!((a - b).norm() < 1e-14);
        }
    }
}
