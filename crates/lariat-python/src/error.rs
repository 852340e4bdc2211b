//! Rust's errors as Python's exceptions: one class per kind, with the fields of the error as attributes.
//!
//! The classes are those of `lariat.errors`, named after the variant: `Error::NoNode` raises `NoNodeError`. A kind that has no class of
//! its own there raises the base class `Error`.

use lariat_ancf::warning::Interface;
use nalgebra::Vector3;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The value of an attribute of an exception.
pub enum Field {
    /// Nothing is known.
    None,
    /// A number.
    Number(f64),
    /// A count or an index.
    Count(usize),
    /// A text.
    Text(String),
    /// Several texts.
    Texts(Vec<String>),
    /// A vector.
    Vector([f64; 3]),
    /// Yes or no.
    Flag(bool),
}

macro_rules! field_from {
    ($($type:ty => $make:expr;)*) => {$(
        impl From<$type> for Field {
            fn from(value: $type) -> Self {
                #[allow(clippy::redundant_closure_call)]
                ($make)(value)
            }
        }
    )*};
}
field_from! {
    f64 => Field::Number;
    usize => Field::Count;
    bool => Field::Flag;
    u32 => |x| Field::Count(x as usize);
    String => Field::Text;
    &str => |x: &str| Field::Text(x.to_string());
    Vec<String> => Field::Texts;
    Vector3<f64> => |x: Vector3<f64>| Field::Vector(x.into());
}

impl<T: Into<Field>> From<Option<T>> for Field {
    fn from(value: Option<T>) -> Self {
        value.map_or(Field::None, Into::into)
    }
}

/// An exception that is not raised yet.
pub struct Raise {
    /// Name of the class in `lariat.errors`.
    class: String,
    message: String,
    fields: Vec<(&'static str, Field)>,
}

impl Raise {
    /// Returns an exception of a class of `lariat.errors`.
    pub fn new(class: &str, message: impl Into<String>) -> Self {
        Raise { class: class.to_string(), message: message.into(), fields: Vec::new() }
    }

    /// Adds an attribute.
    pub fn with(mut self, name: &'static str, value: impl Into<Field>) -> Self {
        self.fields.push((name, value.into()));
        self
    }

    /// Returns the exception of an error, named after its variant as `Debug` writes it.
    fn of(error: &(impl std::fmt::Debug + std::fmt::Display), fields: Vec<(&'static str, Field)>) -> Self {
        let debug = format!("{error:?}");
        let variant = debug.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
        Raise { class: format!("{variant}Error"), message: Interface::Python.text(error), fields }
    }

    fn instance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let errors = py.import("lariat_cables.errors")?;
        let class = match errors.getattr(self.class.as_str()) {
            Ok(class) => class,
            Err(_) => errors.getattr("Error")?,
        };
        let fields = PyDict::new(py);
        for (name, value) in &self.fields {
            match value {
                Field::None => fields.set_item(name, py.None())?,
                Field::Number(x) => fields.set_item(name, x)?,
                Field::Count(x) => fields.set_item(name, x)?,
                Field::Text(x) => fields.set_item(name, x)?,
                Field::Texts(x) => fields.set_item(name, x)?,
                Field::Vector(x) => fields.set_item(name, x)?,
                Field::Flag(x) => fields.set_item(name, x)?,
            }
        }
        class.call((self.message.as_str(),), Some(&fields))
    }
}

impl From<Raise> for PyErr {
    fn from(raise: Raise) -> PyErr {
        if raise.class == "InterruptedError" {
            return PyKeyboardInterrupt::new_err(raise.message);
        }
        Python::attach(|py| match raise.instance(py) {
            Ok(instance) => PyErr::from_value(instance),
            Err(_) => PyRuntimeError::new_err(raise.message.clone()),
        })
    }
}

/// Turns an error into an exception.
pub fn raise<E: Into<Raise>>(error: E) -> PyErr {
    error.into().into()
}

fn text(x: &impl std::fmt::Display) -> String {
    x.to_string()
}

fn debug(x: &impl std::fmt::Debug) -> String {
    format!("{x:?}")
}

/// Lists the fields of the variants of an error; those that need a conversion have one.
macro_rules! fields {
    ($error:expr, $type:path; $($variant:ident { $($field:ident $(: $convert:expr)?),* })*) => {{
        use $type as E;
        match $error {
            $(E::$variant { $($field,)* .. } => vec![$((stringify!($field), fields!(@ $field $($convert)?))),*],)*
            _ => Vec::new(),
        }
    }};
    (@ $field:ident) => { Field::from($field.clone()) };
    (@ $field:ident $convert:expr) => { Field::from(($convert)($field)) };
}

impl From<lariat_ancf::Error> for Raise {
    fn from(error: lariat_ancf::Error) -> Self {
        let fields = fields!(&error, lariat_ancf::Error;
            InvalidValue { cable, what, value, expected: |x: &&'static str| *x }
            WrongCount { cable, what: |x: &&'static str| *x, count, expected }
            TooFewPoints { cable, count }
            CoincidentPoints { cable, index, point }
            ElementCount { cable, count, most }
            NoSection { cable }
            NodeBeforeMesh { cable, node }
            SupportOrder { cable, node, nodes }
            MissingForEffect { cable, effect: |x: &&'static str| *x, requirement: text }
            MissingForceDensities { cable, count }
            EmptyRestPiece { cable, from }
            ObstacleKey { cable, key: |x: &u64| *x as usize }
            ObstacleBody { cable, key: |x: &u64| *x as usize, body, bodies }
            ContactMethod { cable, method }
            TorsionPlace { cable, by }
            OneElement { cable }
            ExplicitReel { cable, method }
            ReelMethod { cable, method, reason: |x: &&'static str| *x }
            ReelPlace { cable, reason: |x: &&'static str| *x }
            FastReel { cable, share, most }
            NotWithReel { cable, what: |x: &&'static str| *x }
            UnknownRule { rule, expected: |x: &&'static str| *x, suggestion }
            UnknownIntegrator { name, expected, suggestion }
            UnknownRopeKind { name, expected, suggestion }
            UnknownFidelity { name, suggestion }
            UnknownNorm { name, suggestion }
            NoErrorEstimate { method }
            NoErrorNorm { method, norm: |x: &&'static str| *x }
            NoStabilityLimit { method }
            ExplicitDamping { cable, method }
            RankDeficient { rule, reason: |x: &&'static str| *x }
            OutOfRange { cable, what: |x: &&'static str| *x, value, limit }
            NoNode { cable, arc_length, nearest }
            Attached { cable, node }
            NoTangent { cable, node }
            Pin { cable, node, problem: text }
            NotInIsland { pin, what: |x: &&'static str| *x, index, count }
            TimeMismatch { cable, time, expected }
            StepFailed { cable, time, at, step, failure: text }
            NoEquilibrium { cable, time, failure: text, residual, iterations }
        );
        Raise::of(&error, fields)
    }
}

impl From<lariat_rapier::Error> for Raise {
    fn from(error: lariat_rapier::Error) -> Self {
        if let lariat_rapier::Error::Cable(error) = error {
            return error.into();
        }
        let fields = fields!(&error, lariat_rapier::Error;
            StepRefused { cables, time, cause: |x: &lariat_rapier::Error| x.to_string() }
            GapTooLong { cable, gap, limit }
            TimeStep { dt }
            AnchorNotFinite { body: debug, anchor }
            AlreadyAttached { cable, node }
            LinkLost { cable, body: debug, gap }
            HeldInMove { cable }
            JointInMove { body: debug }
            JointInStatics { body: debug }
            ContactInStatics { body: debug }
            NotHeldInStatics { bodies: debug, cables }
            MovesInStatics { way }
            CablesPassInStatics { cable, other, arc_length, by_motion }
            CablePassesBodyInStatics { cable, body: debug, arc_length, by_motion }
            CableTouchesInStatics { cable, collider: debug, arc_length, depth }
            BodyNotFinite { body: debug, time }
        );
        Raise::of(&error, fields)
    }
}

impl From<lariat_scene::Error> for Raise {
    fn from(error: lariat_scene::Error) -> Self {
        use lariat_scene::Error as E;
        match error {
            E::Scene(error) => Raise::new("SceneError", error.to_string())
                .with("place", text(&error.place))
                .with("key", error.key.as_str())
                .with("problem", text(&error.problem))
                .with("accepted", error.accepted.as_str())
                .with("suggestion", error.suggestion.clone()),
            E::Mechanics { time, ref source } => {
                let message = error.to_string();
                let mut raise = Raise::from(source.clone());
                raise.message = message;
                if !raise.fields.iter().any(|(name, _)| *name == "time") {
                    raise = raise.with("time", time);
                }
                raise
            }
            E::Coupling { time, ref source } => {
                let message = error.to_string();
                let raise = Raise::from(source.clone());
                Raise { message, ..raise.with("time", time) }
            }
            E::Import { line, .. } => Raise::of(&error, vec![("line", line.into())]),
            E::NoSuchKey { ref key, .. } => {
                let key = key.clone();
                Raise::of(&error, vec![("key", key.into())])
            }
            E::Body { time, ref body, .. } => {
                let body = body.clone();
                Raise::of(&error, vec![("time", time.into()), ("body", body.into())])
            }
            E::TimedCut { ref cable } | E::NoChosenMesh { ref cable, .. } => {
                let cable = cable.clone();
                Raise::of(&error, vec![("cable", cable.into())])
            }
            E::Write { time, .. } | E::Interrupted { time } => Raise::of(&error, vec![("time", time.into())]),
            _ => Raise::of(&error, Vec::new()),
        }
    }
}
