//! Motion of rigid bodies that carry obstacles.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// Place and axes at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub position: Vector3<f64>,
    pub rotation: Matrix3<f64>,
}

impl Pose {
    /// Returns a point of the world in the body's axes.
    #[inline]
    pub fn own(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(x - self.position))
    }
}

/// A motion of a rigid body: one of its points moves uniformly, about which it turns uniformly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RigidMotion {
    /// Time in s at which it has the pose below.
    pub start: f64,
    /// The point that moves uniformly, in the body's axes, in m. Default: their origin.
    pub centre: Vector3<f64>,
    /// Its position in m.
    pub position: Vector3<f64>,
    /// Rotation from the body's axes to the world's.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of that point in m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity in rad/s, world axes.
    pub angular_velocity: Vector3<f64>,
}

impl Default for RigidMotion {
    /// At rest at the origin.
    fn default() -> Self {
        RigidMotion {
            start: 0.0,
            centre: Vector3::zeros(),
            position: Vector3::zeros(),
            rotation: UnitQuaternion::identity(),
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
        }
    }
}

impl RigidMotion {
    /// Returns rest at a position (m), with the world's axes.
    pub fn at(position: impl Into<Vector3<f64>>) -> Self {
        RigidMotion { position: position.into(), ..Self::default() }
    }

    #[inline]
    pub(crate) fn pose(&self, time: f64) -> Pose {
        let t = time - self.start;
        let turned = if self.angular_velocity == Vector3::zeros() {
            self.rotation
        } else {
            UnitQuaternion::new(self.angular_velocity * t) * self.rotation
        };
        let rotation = *turned.to_rotation_matrix().matrix();
        Pose { position: self.position + self.velocity * t - rotation * self.centre, rotation }
    }
}

/// Where an obstacle is on a body of the island.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mount {
    /// Index of the body among those of [`Island::step`](crate::island::Island::step).
    pub body: usize,
    /// The obstacle's origin from the centre of mass, in the body's axes, in m.
    pub position: Vector3<f64>,
    /// Rotation from the obstacle's axes to the body's.
    pub rotation: UnitQuaternion<f64>,
}
