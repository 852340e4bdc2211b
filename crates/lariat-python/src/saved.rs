//! Objects as bytes: a line with their kind and the version of this package, then MessagePack.

use crate::error::{Raise, raise};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use serde::de::DeserializeOwned;

fn first_line(kind: &str) -> String {
    format!("lariat {kind} {}\n", env!("CARGO_PKG_VERSION"))
}

/// An object that was written, or why it was not.
pub type Written = Result<Vec<u8>, rmp_serde::encode::Error>;

/// Writes an object, without its first line: where the interpreter is released.
pub fn write(object: &impl Serialize) -> Written {
    rmp_serde::to_vec_named(object)
}

/// Returns the bytes of an object of a kind that was written.
pub fn to_bytes<'py>(py: Python<'py>, kind: &str, written: Written) -> PyResult<Bound<'py, PyBytes>> {
    let body = written.map_err(|error| raise(Raise::new("FormatError", error.to_string())))?;
    Ok(PyBytes::new(py, &[first_line(kind).as_bytes(), &body].concat()))
}

/// Returns the object of a kind from bytes of the same version.
pub fn from_bytes<T: DeserializeOwned>(kind: &str, bytes: &[u8]) -> PyResult<T> {
    let wrong = |problem: String| raise(Raise::new("FormatError", format!("not a saved {kind}: {problem}")));
    let first = first_line(kind);
    let body = bytes.strip_prefix(first.as_bytes());
    let body = body.ok_or_else(|| wrong(format!("it does not begin with {first:?}")))?;
    rmp_serde::from_slice(body).map_err(|error| wrong(error.to_string()))
}
