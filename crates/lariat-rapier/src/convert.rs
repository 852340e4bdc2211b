//! Conversion between Rapier's numbers (glam, [`Real`]) and those of the mechanics (nalgebra,
//! `f64`).
//!
//! Functions that take a point or vector take either ([`Point`](lariat_ancf::Point)), or an array;
//! a reading becomes Rapier's vector by [`ToRapier`]:
//!
//! ```
//! use lariat_rapier::convert::ToRapier;
//! use lariat_rapier::lariat_ancf::Vector3;
//! use rapier::prelude::*;
//!
//! let force = Vector3::new(0.0, -9.81, 0.0); // as of `Attachment::force`
//! assert_eq!(force.to_rapier(), Vector::new(0.0, -9.81, 0.0));
//! ```
//!
//! A function named after a type returns that of the mechanics; one with `to_` returns Rapier's.

use ::nalgebra as na;
use rapier::math::{AngularInertia, Matrix, Pose, Real, Rotation, Vector};

/// Conversion to Rapier's type, rounded to its precision.
pub trait ToRapier {
    /// Rapier's type.
    type Output;

    /// Converts.
    fn to_rapier(&self) -> Self::Output;
}

impl ToRapier for na::Vector3<f64> {
    type Output = Vector;

    fn to_rapier(&self) -> Vector {
        to_vector(self)
    }
}

impl ToRapier for na::UnitQuaternion<f64> {
    type Output = Rotation;

    fn to_rapier(&self) -> Rotation {
        to_rotation(self)
    }
}

/// Converts Rapier's vector to `f64`.
pub fn vector(v: Vector) -> na::Vector3<f64> {
    na::Vector3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}

/// Converts a vector to Rapier's, rounded to its precision.
pub fn to_vector(v: &na::Vector3<f64>) -> Vector {
    Vector::new(v.x as Real, v.y as Real, v.z as Real)
}

/// Converts Rapier's rotation to a unit quaternion, normalised in `f64`.
pub fn rotation(r: Rotation) -> na::UnitQuaternion<f64> {
    let q = na::Quaternion::new(f64::from(r.w), f64::from(r.x), f64::from(r.y), f64::from(r.z));
    na::UnitQuaternion::from_quaternion(q)
}

/// Converts a unit quaternion to Rapier's rotation, rounded to its precision.
pub fn to_rotation(r: &na::UnitQuaternion<f64>) -> Rotation {
    Rotation::from_xyzw(r.i as Real, r.j as Real, r.k as Real, r.w as Real)
}

/// Converts Rapier's matrix to `f64`.
pub fn matrix(m: &Matrix) -> na::Matrix3<f64> {
    na::Matrix3::from_fn(|r, c| f64::from(m.col(c)[r]))
}

/// Converts Rapier's symmetric matrix to `f64`.
pub(crate) fn symmetric(s: &AngularInertia) -> na::Matrix3<f64> {
    na::Matrix3::new(s.m11, s.m12, s.m13, s.m12, s.m22, s.m23, s.m13, s.m23, s.m33).map(f64::from)
}

/// Returns the inertia of a body about its centre of mass in kg m^2, in its axes; zero if it does
/// not rotate.
pub(crate) fn symmetric_inertia(body: &rapier::dynamics::RigidBody) -> na::Matrix3<f64> {
    let local = &body.mass_properties().local_mprops;
    let inverse = local.inv_principal_inertia;
    let turns = inverse.x > 0.0 && inverse.y > 0.0 && inverse.z > 0.0;
    if turns { matrix(&local.reconstruct_inertia_matrix()) } else { na::Matrix3::zeros() }
}

/// Makes a pose of Rapier's from a translation in m and a rotation.
pub fn to_pose(translation: &na::Vector3<f64>, rotation: &na::UnitQuaternion<f64>) -> Pose {
    Pose::from_parts(to_vector(translation), to_rotation(rotation))
}
