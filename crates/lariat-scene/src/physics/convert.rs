//! Conversion between the vectors of Rapier (glam, single precision) and nalgebra (`f64`).

use lariat_ancf::Vector3;
use lariat_rapier::rapier::math::{Matrix, Pose, Real, Rotation, Vector};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

pub fn vector(v: Vector) -> Vector3<f64> {
    Vector3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}

pub fn to_vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x as Real, v.y as Real, v.z as Real)
}

pub fn rotation(r: Rotation) -> UnitQuaternion<f64> {
    let q = Quaternion::new(f64::from(r.w), f64::from(r.x), f64::from(r.y), f64::from(r.z));
    UnitQuaternion::from_quaternion(q)
}

pub fn to_pose((position, q): &(Vector3<f64>, UnitQuaternion<f64>)) -> Pose {
    Pose::from_parts(to_vector(position), Rotation::from_xyzw(q.i as Real, q.j as Real, q.k as Real, q.w as Real))
}

pub fn matrix(m: &Matrix) -> Matrix3<f64> {
    Matrix3::from_fn(|r, c| f64::from(m.col(c)[r]))
}
