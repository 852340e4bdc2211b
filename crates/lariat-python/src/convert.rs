//! Arguments from Python, and results to it.

use crate::error::{Raise, raise};
use lariat_ancf::{At, Vector3};
use numpy::{AllowTypeChange, PyArray1, PyArray2, PyArrayLikeDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::{PyRecursionError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};
use serde_json::{Map, Number, Value};

/// Largest depth of nested data.
const DEEPEST: usize = 64;

/// A vector of three numbers, from any sequence or array.
#[derive(Clone, Copy, Debug)]
pub struct Vector(pub Vector3<f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Vector {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let numbers = Array::extract(object)?;
        match numbers.values[..] {
            [x, y, z] if numbers.shape.len() == 1 => Ok(Vector(Vector3::new(x, y, z))),
            _ => Err(numbers.wrong_shape("(3,)")),
        }
    }
}

/// Numbers of any shape, in row-major order.
#[derive(Clone, Debug)]
pub struct Array {
    pub values: Vec<f64>,
    pub shape: Vec<usize>,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Array {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let array = object.py().import("numpy")?.call_method1("asarray", (object,))?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        // NumPy makes NaN of None, and drops imaginary parts
        let empty = array.len().is_ok_and(|length| length == 0);
        if !["b", "i", "u", "f"].contains(&kind.as_str()) && !empty {
            return Err(PyTypeError::new_err(format!("expected numbers, got {}", object.get_type().name()?)));
        }
        let array: PyArrayLikeDyn<'py, f64, AllowTypeChange> = array.extract()?;
        Ok(Array { values: array.as_array().iter().copied().collect(), shape: array.shape().to_vec() })
    }
}

/// A whole number of at least 0.
#[derive(Clone, Copy, Debug)]
pub struct Count<T = usize>(pub T);

impl<'a, 'py, T: FromPyObject<'a, 'py>> FromPyObject<'a, 'py> for Count<T> {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let wanted = "a whole number of at least 0";
        if object.is_instance_of::<PyBool>() || !object.hasattr("__index__")? {
            let kind = object.get_type().name()?.to_string();
            return Err(PyTypeError::new_err(format!("expected {wanted}, got {} ({kind})", object.repr()?)));
        }
        object.extract().map(Count).map_err(|_| {
            let message = format!("expected {wanted}, got {}", &*object);
            raise(
                Raise::new("InvalidValueError", message)
                    .with("value", object.extract::<f64>().ok())
                    .with("expected", wanted),
            )
        })
    }
}

/// Numbers in a row, from any sequence or array.
#[derive(Clone, Debug)]
pub struct Numbers(pub Vec<f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let numbers = Array::extract(object)?;
        if numbers.shape.len() == 1 { Ok(Numbers(numbers.values)) } else { Err(numbers.wrong_shape("(n,)")) }
    }
}

impl Array {
    /// Returns the exception that the shape is another than `expected`.
    pub fn wrong_shape(&self, expected: &str) -> PyErr {
        let shape = format!("({})", self.shape.iter().map(|n| format!("{n},")).collect::<String>());
        raise(
            Raise::new("ShapeError", format!("expected an array of shape {expected}, got {shape}"))
                .with("shape", shape),
        )
    }

    /// Returns the rows of an array of shape (n, 3).
    pub fn vectors(&self) -> PyResult<Vec<Vector3<f64>>> {
        match self.shape[..] {
            [_, 3] => Ok(self.values.chunks_exact(3).map(Vector3::from_column_slice).collect()),
            _ => Err(self.wrong_shape("(n, 3)")),
        }
    }
}

/// A point of a cable: "start", "end", a `lariat.Node`, or an arc length in m (float).
///
/// An integer says neither whether it counts nodes nor whether it counts metres, and is refused; 0 is
/// the start in both.
#[derive(Clone, Copy, Debug)]
pub struct Place(pub At);

const EXPECTED: &str = "expected \"start\", \"end\", an arc length in m (float) or a lariat.Node";

/// What a number is, as a place.
enum Counts {
    Node,
    Integer,
    Metres,
    Nothing,
}

/// Returns what an object counts: NumPy's numbers by their dtype, others by their type.
fn counts(object: Borrowed<'_, '_, PyAny>) -> PyResult<Counts> {
    if object.is_instance_of::<PyBool>() || object.len().is_ok() {
        return Ok(Counts::Nothing);
    }
    if let Ok(dtype) = object.getattr("dtype") {
        let kind: String = dtype.getattr("kind")?.extract()?;
        return Ok(match kind.as_str() {
            "f" => Counts::Metres,
            "i" | "u" => Counts::Integer,
            _ => Counts::Nothing,
        });
    }
    if !object.hasattr("__index__")? {
        return Ok(if object.hasattr("__float__")? { Counts::Metres } else { Counts::Nothing });
    }
    let node = object.is_instance(&object.py().import("lariat_cables.node")?.getattr("Node")?)?;
    Ok(if node { Counts::Node } else { Counts::Integer })
}

impl<'a, 'py> FromPyObject<'a, 'py> for Place {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(text) = object.extract::<String>() {
            return match text.as_str() {
                "start" => Ok(Place(At::Start)),
                "end" => Ok(Place(At::End)),
                _ => Err(raise(Raise::new("UnknownPlaceError", format!("{EXPECTED}, got {text:?}")))),
            };
        }
        match counts(object)? {
            Counts::Node => Ok(Place(At::Node(object.extract()?))),
            Counts::Metres => Ok(Place(At::ArcLength(object.extract()?))),
            Counts::Integer if object.eq(0)? => Ok(Place(At::Start)),
            Counts::Integer => {
                let k = object.str()?;
                let problem = format!("{k} as a point of a cable is a node or m: write lariat.Node({k}) or {k}.0");
                Err(raise(Raise::new("AmbiguousPlaceError", problem)))
            }
            Counts::Nothing => Err(PyTypeError::new_err(format!("{EXPECTED}, got {}", object.get_type().name()?))),
        }
    }
}

/// Returns the `lariat.Node` of a number.
pub fn node(py: Python<'_>, node: usize) -> PyResult<Bound<'_, PyAny>> {
    py.import("lariat_cables.node")?.getattr("Node")?.call1((node,))
}

/// One place, or several.
#[derive(Clone, Debug, Default)]
pub struct Places(pub Vec<At>);

impl<'a, 'py> FromPyObject<'a, 'py> for Places {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if object.is_instance_of::<PyString>() || object.try_iter().is_err() {
            return Ok(Places(vec![Place::extract(object)?.0]));
        }
        let places = object.try_iter()?.map(|item| Ok(item?.extract::<Place>()?.0));
        places.collect::<PyResult<_>>().map(Places)
    }
}

/// Returns an array of three numbers.
pub fn vector<'py>(py: Python<'py>, v: &Vector3<f64>) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, v.as_slice())
}

/// Hands numbers to NumPy as an array of this many columns, without a copy.
pub fn table<'py>(py: Python<'py>, values: Vec<f64>, columns: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows = values.len() / columns.max(1);
    PyArray1::from_vec(py, values).reshape([rows, columns])
}

/// Returns vectors as an array of shape (n, 3).
pub fn vectors<'py>(py: Python<'py>, rows: &[Vector3<f64>]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    table(py, rows.iter().flat_map(|v| [v.x, v.y, v.z]).collect(), 3)
}

/// Makes a named tuple of `lariat.results`.
pub fn result<'py>(
    py: Python<'py>,
    class: &str,
    values: impl pyo3::call::PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    py.import("lariat_cables.results")?.getattr(class)?.call1(values)
}

/// Returns dicts, sequences, arrays, paths, numbers and texts as plain data.
///
/// # Errors
/// `InvalidValueError` for a number that is not finite, `RecursionError` for data that contain themselves, `TypeError` for anything else.
pub fn data(object: &Bound<'_, PyAny>) -> PyResult<Value> {
    data_within(object, DEEPEST)
}

fn data_within(object: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    let Some(depth) = depth.checked_sub(1) else {
        return Err(PyRecursionError::new_err(format!("data nested deeper than {DEEPEST} levels, or in itself")));
    };
    if object.is_none() {
        return Ok(Value::Null);
    }
    if let Ok(x) = object.cast::<PyBool>() {
        return Ok(Value::Bool(x.is_true()));
    }
    if let Ok(text) = object.extract::<String>() {
        return Ok(Value::String(text));
    }
    if let Ok(dict) = object.cast::<PyDict>() {
        let mut map = Map::new();
        for (key, value) in dict {
            map.insert(key.extract()?, data_within(&value, depth)?);
        }
        return Ok(Value::Object(map));
    }
    if object.hasattr("tolist")? {
        return data_within(&object.call_method0("tolist")?, depth);
    }
    if object.hasattr("__fspath__")? {
        return data_within(&object.call_method0("__fspath__")?, depth);
    }
    if object.hasattr("__iter__")? {
        return object
            .try_iter()?
            .map(|item| data_within(&item?, depth))
            .collect::<PyResult<Vec<_>>>()
            .map(Value::Array);
    }
    if object.hasattr("__index__")? {
        return Ok(Value::Number(object.extract::<i64>()?.into()));
    }
    let x: f64 = object.extract()?;
    let number = Number::from_f64(x);
    number.map(Value::Number).ok_or_else(|| {
        raise(Raise::new("InvalidValueError", format!("a value is {x}: must be finite")).with("value", x))
    })
}

/// Returns plain data as Python's objects.
pub fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (value.to_string(),))
}
