//! Objects as bytes: MessagePack under a [seal](lariat_ancf::seal), so that damaged ones and those
//! of another version are refused.

use crate::error::{Raise, raise};
use lariat_ancf::seal::{seal, unseal};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// An object that was written, or why it was not.
pub type Written = Result<Vec<u8>, rmp_serde::encode::Error>;

/// Writes an object, without its seal: where the interpreter is released.
pub fn write(object: &impl Serialize) -> Written {
    rmp_serde::to_vec_named(object)
}

/// Returns the bytes of an object of a kind that was written.
pub fn to_bytes<'py>(py: Python<'py>, kind: &str, written: Written) -> PyResult<Bound<'py, PyBytes>> {
    let body = written.map_err(|error| raise(Raise::new("FormatError", error.to_string())))?;
    Ok(PyBytes::new(py, &seal(kind, &body)))
}

/// Returns the object of a kind from bytes of the same version, if they are whole.
pub fn from_bytes<T: DeserializeOwned>(kind: &str, bytes: &[u8]) -> PyResult<T> {
    let wrong = |problem: String| raise(Raise::new("FormatError", problem));
    let body = unseal(kind, bytes).map_err(|error| wrong(error.to_string()))?;
    rmp_serde::from_slice(body).map_err(|error| wrong(format!("not a saved {kind}: {error}")))
}
