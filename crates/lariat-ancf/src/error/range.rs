//! Checks of numbers that a program gives.

use super::Error;
use nalgebra::Vector3;

/// Checks a range: `Err` unless `value` is finite and `ok`.
pub(crate) fn require(what: &str, value: f64, ok: bool, expected: &'static str) -> Result<(), Error> {
    if value.is_finite() && ok {
        Ok(())
    } else {
        Err(Error::InvalidValue { cable: None, what: what.to_string(), value, expected })
    }
}

/// Applies [`require`] to every component of a vector.
pub(crate) fn require_finite(what: &str, value: &Vector3<f64>) -> Result<(), Error> {
    value.iter().try_for_each(|&x| require(what, x, true, "a number"))
}
