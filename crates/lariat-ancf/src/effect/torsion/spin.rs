//! By how much a body spins about a direction that is fixed to it.
//!
//! # Equation
//!
//! ```text
//! D theta = 2 atan(c.d),   c = tan(angle/2) axis of the rotation,   d = (R0 u + R1 u)/2
//! ```
//!
//! u is the direction in the axes of the body: the part of the rotation that is none of R0 u to R1
//! u along a great circle, which the curve of a cable knows of.
//!
//! # Validity
//!
//! Rotations of less than pi.

use nalgebra::{UnitQuaternion, Vector3};

/// Returns the angle in rad by which a body has spun about `direction`, in its axes, between two
/// attitudes.
pub(crate) fn spun(then: &UnitQuaternion<f64>, now: &UnitQuaternion<f64>, direction: &Vector3<f64>) -> f64 {
    if then == now {
        return 0.0;
    }
    let turn = now * then.inverse();
    let mean = (then * direction + now * direction) * 0.5;
    // the Cayley vector of the rotation is its vector part over its scalar part
    let along = turn.imag().dot(&mean) * turn.scalar().signum();
    2.0 * along.atan2(turn.scalar().abs())
}
