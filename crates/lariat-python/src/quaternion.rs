//! Quaternions x, y, z, w from Python.

use crate::error::raise;
use crate::told::warn;
use lariat_ancf::Error;
use nalgebra::{Quaternion, UnitQuaternion};
use pyo3::prelude::*;

/// Largest difference of the length of a quaternion from 1.
const LENGTH: f64 = 1e-3;

/// Returns the rotation of a quaternion x, y, z, w. Warns of a half turn about x, which is what the identity is where w is first, as in MuJoCo.
pub fn rotation(py: Python<'_>, [x, y, z, w]: [f64; 4]) -> PyResult<UnitQuaternion<f64>> {
    let quaternion = Quaternion::new(w, x, y, z);
    let value = quaternion.norm();
    if value.is_nan() || (value - 1.0).abs() >= LENGTH {
        let (cable, what) = (None, "length of the quaternion".to_string());
        return Err(raise(Error::InvalidValue { cable, what, value, expected: "1" }));
    }
    let w_first = ([y, z, w] == [0.0; 3]).then(|| {
        format!(
            "the quaternion ({x}, {y}, {z}, {w}) is a half turn about x: quaternions are x, y, z, w; where w is first, as in MuJoCo, it is no \
             rotation (`numpy.roll(q, -1)` puts w last)"
        )
    });
    warn(py, w_first)?;
    Ok(UnitQuaternion::from_quaternion(quaternion))
}
