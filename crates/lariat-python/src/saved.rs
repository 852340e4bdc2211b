//! Objects as bytes: a line with their kind, the version of this package and a checksum (CRC-32),
//! then MessagePack. A single number of a damaged object would read back as another number, without
//! an error; the checksum finds every damage of up to 32 bits in a row, and of any other kind all
//! but one of 4e9.

use crate::error::{Raise, raise};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use serde::de::DeserializeOwned;

fn first_words(kind: &str) -> String {
    format!("lariat {kind} {} ", env!("CARGO_PKG_VERSION"))
}

fn checksum(body: &[u8]) -> String {
    format!("{:08x}\n", crc32fast::hash(body))
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
    Ok(PyBytes::new(py, &[first_words(kind).as_bytes(), checksum(&body).as_bytes(), &body].concat()))
}

/// Returns the object of a kind from bytes of the same version, if they are whole.
pub fn from_bytes<T: DeserializeOwned>(kind: &str, bytes: &[u8]) -> PyResult<T> {
    let wrong = |problem: String| raise(Raise::new("FormatError", format!("not a saved {kind}: {problem}")));
    let first = first_words(kind);
    let rest = bytes.strip_prefix(first.as_bytes());
    let rest = rest.ok_or_else(|| wrong(format!("it does not begin with {first:?}")))?;
    let (told, body) = rest.split_at_checked(checksum(&[]).len()).ok_or_else(|| wrong("it is cut short".into()))?;
    if told != checksum(body).as_bytes() {
        return Err(wrong("it is damaged: its checksum is not that of its contents".into()));
    }
    rmp_serde::from_slice(body).map_err(|error| wrong(error.to_string()))
}
