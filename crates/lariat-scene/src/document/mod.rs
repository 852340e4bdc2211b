//! A scene file as a tree of keys and values, each of which knows where it was written.
//!
//! | file | what it holds |
//! |---|---|
//! | `overrides` | `--set KEY=VALUE`, put into the tree before anything is checked |
//! | `resolve` | the tree checked against the schema, with defaults filled in |
//! | `path` | paths of keys into the tree |
//!
//! Errors are made here from a path, so that each names file (or override), line, key and what is accepted.

mod overrides;
mod path;
mod quantity;
mod resolve;

pub use path::KeyPath;

use crate::error::{Error, Place, Problem, SceneError};
use crate::schema::{ANY, Table};
use crate::suggest::nearest;
use lariat_ancf::Vector3;
use path::Step;
use serde::de::DeserializeOwned;
use std::fmt::Write as _;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// A parsed scene file with its overrides in place.
#[derive(Debug)]
pub struct Document<'t> {
    file: String,
    text: &'t str,
    schema: &'static Table,
    root: Spanned<DeTable<'t>>,
    overrides: Vec<&'t str>,
}

impl<'t> Document<'t> {
    /// Parses the text of a scene file; `file` is its name in errors, `schema` its root table.
    ///
    /// # Errors
    /// [`Error::Syntax`] if the text is not TOML.
    pub fn parse(file: &str, text: &'t str, schema: &'static Table) -> Result<Self, Error> {
        let root = DeTable::parse(text).map_err(|error| Error::Syntax {
            place: Place::Line { file: file.to_string(), line: line_of(text, error.span().map_or(0, |s| s.start)) },
            problem: error.message().replace('\n', ", "),
        })?;
        Ok(Document { file: file.to_string(), text, schema, root, overrides: Vec::new() })
    }

    /// Returns the span that stands for an override, past the end of the file.
    fn override_span(&self, index: usize) -> Range<usize> {
        let start = self.text.len() + 2 + 2 * index;
        start..start + 1
    }

    fn place(&self, span: &Range<usize>) -> Place {
        if span.start > self.text.len() + 1 {
            let index = (span.start - self.text.len() - 2) / 2;
            return Place::Override(self.overrides.get(index).copied().unwrap_or_default().to_string());
        }
        Place::Line { file: self.file.clone(), line: line_of(self.text, span.start) }
    }

    /// Returns the values along a path, from the root on, as far as they are written.
    fn follow<'d>(&'d self, path: &'d KeyPath) -> impl Iterator<Item = &'d Spanned<DeValue<'t>>> {
        let mut here: Option<&Spanned<DeValue<'_>>> = None;
        path.0.iter().map_while(move |step| {
            let value = here.map(Spanned::get_ref);
            here = match (step, value) {
                (Step::Key(key), None) => self.root.get_ref().get(key.as_str()),
                (Step::Key(key), Some(value)) => value.as_table().and_then(|table| table.get(key.as_str())),
                (Step::Item(i), value) => value.and_then(DeValue::as_array).and_then(|array| array.get(*i)),
            };
            here
        })
    }

    /// Returns whether a path is written in the scene.
    pub fn contains(&self, path: &KeyPath) -> bool {
        self.follow(path).count() == path.0.len()
    }

    /// Returns where the value at a path was written, or the nearest table around it.
    fn place_of(&self, path: &KeyPath) -> Place {
        self.place(&self.follow(path).last().map_or(self.root.span(), Spanned::span))
    }

    /// Returns the path as a user writes it: tables of an array by their name, or their position from 0.
    pub fn display(&self, path: &KeyPath) -> String {
        let mut text = String::new();
        let mut values = self.follow(path);
        for step in &path.0 {
            let name = values.next().and_then(|value| name_of(value.get_ref()));
            if !text.is_empty() {
                text.push('.');
            }
            match (step, name) {
                (Step::Key(key), _) => text.push_str(key),
                (Step::Item(_), Some(name)) => text.push_str(name),
                // writing to a String cannot fail
                (Step::Item(i), None) => _ = write!(text, "{i}"),
            }
        }
        if text.is_empty() { "scene".to_string() } else { text }
    }

    /// Returns the error that the value at a path is not accepted; what is accepted is in the schema.
    pub fn error(&self, path: &KeyPath, problem: Problem) -> Error {
        let accepted = self.schema.find(path.keys()).map_or_else(|| self.schema.names(), |key| key.accepted());
        self.error_accepting(path, problem, accepted)
    }

    /// Returns the error that the value at a path does not agree with the rest of the scene, in words.
    pub fn conflict(&self, path: &KeyPath, problem: impl Into<String>) -> Error {
        self.error(path, Problem::Conflict(problem.into()))
    }

    /// Reads the value at a path into a type.
    pub fn typed<T: DeserializeOwned>(&self, path: &KeyPath, value: toml::Value) -> Result<T, Error> {
        value.try_into().map_err(|error: toml::de::Error| self.conflict(path, error.message()))
    }

    /// Checks that the vector at a path stays finite in the single precision of Rapier.
    pub fn check_single(&self, path: &KeyPath, vector: &Vector3<f64>) -> Result<(), Error> {
        match vector.iter().find(|x| !ANY.single().contains(**x)) {
            Some(x) => Err(self.error(path, Problem::BeyondSingle(*x))),
            None => Ok(()),
        }
    }

    /// Returns the error that a required key is missing.
    pub fn missing(&self, path: &KeyPath) -> Error {
        self.error(path, Problem::MissingKey(path.last_key().to_string()))
    }

    /// Returns the error that a name is not one of the known ones.
    pub fn unknown_name<'n>(
        &self,
        path: &KeyPath,
        what: &'static str,
        name: &str,
        known: impl IntoIterator<Item = &'n str>,
    ) -> Error {
        let known: Vec<&str> = known.into_iter().collect();
        let accepted = if known.is_empty() { format!("no name, the scene has no {what}") } else { known.join(" | ") };
        self.suggesting(path, Problem::UnknownName { what, name: name.to_string() }, accepted, nearest(name, known))
    }

    /// Returns the error that the value at a path is not accepted, with its own text of what is.
    pub fn error_accepting(&self, path: &KeyPath, problem: Problem, accepted: impl Into<String>) -> Error {
        self.suggesting(path, problem, accepted.into(), None)
    }

    fn suggesting(&self, path: &KeyPath, problem: Problem, accepted: String, suggestion: Option<String>) -> Error {
        let (place, key) = (self.place_of(path), self.display(path));
        Error::Scene(Box::new(SceneError { place, key, problem, accepted, suggestion }))
    }
}

/// Returns the name of a table.
fn name_of<'v>(value: &'v DeValue<'_>) -> Option<&'v str> {
    value.as_table()?.get("name")?.get_ref().as_str()
}

fn line_of(text: &str, offset: usize) -> usize {
    1 + text.as_bytes()[..offset.min(text.len())].iter().filter(|&&b| b == b'\n').count()
}

/// Returns a value with all its spans replaced.
fn respanned<'t>(value: DeValue<'t>, span: &Range<usize>) -> Spanned<DeValue<'t>> {
    let value = match value {
        DeValue::Table(table) => DeValue::Table(
            table
                .into_iter()
                .map(|(key, value)| (Spanned::new(span.clone(), key.into_inner()), respanned(value.into_inner(), span)))
                .collect(),
        ),
        DeValue::Array(array) => {
            let mut out = DeArray::new();
            for item in array {
                out.push(respanned(item.into_inner(), span));
            }
            DeValue::Array(out)
        }
        leaf => leaf,
    };
    Spanned::new(span.clone(), value)
}
