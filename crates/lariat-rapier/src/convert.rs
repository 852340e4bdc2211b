//! The one place where Rapier's numbers (glam, `Real`) become ours (nalgebra, `f64`) and back.

use ::nalgebra as na;
use rapier::math::{Matrix, Pose, Real, Rotation, Vector};

/// To an `f64` vector.
pub(crate) fn vector(v: Vector) -> na::Vector3<f64> {
    na::Vector3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}

/// To Rapier's vector.
pub(crate) fn to_vector(v: &na::Vector3<f64>) -> Vector {
    Vector::new(v.x as Real, v.y as Real, v.z as Real)
}

/// To a unit quaternion, normalised in `f64`.
pub(crate) fn rotation(r: Rotation) -> na::UnitQuaternion<f64> {
    let q = na::Quaternion::new(f64::from(r.w), f64::from(r.x), f64::from(r.y), f64::from(r.z));
    na::UnitQuaternion::from_quaternion(q)
}

/// To Rapier's rotation.
pub(crate) fn to_rotation(r: &na::UnitQuaternion<f64>) -> Rotation {
    Rotation::from_xyzw(r.i as Real, r.j as Real, r.k as Real, r.w as Real)
}

/// To an `f64` matrix.
pub(crate) fn matrix(m: &Matrix) -> na::Matrix3<f64> {
    na::Matrix3::from_fn(|r, c| f64::from(m.col(c)[r]))
}

/// A pose from its parts.
pub(crate) fn to_pose(translation: &na::Vector3<f64>, rotation: &na::UnitQuaternion<f64>) -> Pose {
    Pose::from_parts(to_vector(translation), to_rotation(rotation))
}
