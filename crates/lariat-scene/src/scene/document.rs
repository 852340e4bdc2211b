//! A scene file as a tree of keys and values, each of which knows where it was written.
//!
//! Overrides are put into the tree before anything is checked; a value that came from one points back at the command line.
//! Errors are made here from a path of keys, so that they name file, line, key and what is accepted.

use super::keys;
use crate::error::{Error, Place};
use serde::de::DeserializeOwned;
use std::fmt::Write as _;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// One step of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Step {
    Key(String),
    Item(usize),
}

/// A path of keys and array positions from the root of a scene.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KeyPath(Vec<Step>);

impl KeyPath {
    /// The path of a key at the root.
    pub fn root(key: &str) -> Self {
        KeyPath::default().key(key)
    }

    /// The path of a key of the table at this path.
    pub fn key(&self, key: &str) -> Self {
        self.with(Step::Key(key.to_string()))
    }

    /// The path of an item of the array at this path.
    pub fn item(&self, index: usize) -> Self {
        self.with(Step::Item(index))
    }

    fn with(&self, step: Step) -> Self {
        KeyPath(self.0.iter().cloned().chain([step]).collect())
    }

    /// The path without array positions, as the table of accepted values has it.
    fn generic(&self) -> String {
        let keys = self.0.iter().filter_map(|step| match step {
            Step::Key(key) => Some(key.as_str()),
            Step::Item(_) => None,
        });
        keys.collect::<Vec<_>>().join(".")
    }
}

/// A parsed scene file with its overrides in place.
#[derive(Debug)]
pub struct Document<'t> {
    file: String,
    text: &'t str,
    pub(super) root: Spanned<DeTable<'t>>,
    pub(super) overrides: Vec<&'t str>,
}

impl<'t> Document<'t> {
    /// Parses the text of a scene file; `file` is its name in errors.
    ///
    /// # Errors
    /// [`Error::Syntax`].
    pub fn parse(file: &str, text: &'t str) -> Result<Self, Error> {
        let root = DeTable::parse(text).map_err(|error| Error::Syntax {
            place: Place::Line { file: file.to_string(), line: line_of(text, error.span().map_or(0, |s| s.start)) },
            problem: error.message().replace('\n', ", "),
        })?;
        Ok(Document { file: file.to_string(), text, root, overrides: Vec::new() })
    }

    /// The span that stands for an override, past the end of the file.
    pub(super) fn override_span(&self, index: usize) -> Range<usize> {
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

    /// Where a path was written: its value, or the nearest table around it.
    pub fn place_of(&self, path: &KeyPath) -> Place {
        let mut span = self.root.span();
        let mut here: Option<&DeValue<'_>> = None;
        for step in &path.0 {
            let next = match (step, here) {
                (Step::Key(key), None) => self.root.get_ref().get(key.as_str()),
                (Step::Key(key), Some(value)) => value.as_table().and_then(|t| t.get(key.as_str())),
                (Step::Item(i), Some(value)) => value.as_array().and_then(|a| a.get(*i)),
                (Step::Item(_), None) => None,
            };
            let Some(value) = next else { break };
            span = value.span();
            here = Some(value.get_ref());
        }
        self.place(&span)
    }

    /// The path as a user writes it: tables of an array by their name, or their position from 0.
    pub fn display(&self, path: &KeyPath) -> String {
        let mut text = String::new();
        let mut here: Option<&DeValue<'_>> = None;
        for step in &path.0 {
            if !text.is_empty() {
                text.push('.');
            }
            match step {
                Step::Key(key) => {
                    text.push_str(key);
                    here = match here {
                        None => self.root.get_ref().get(key.as_str()),
                        Some(value) => value.as_table().and_then(|t| t.get(key.as_str())),
                    }
                    .map(Spanned::get_ref);
                }
                Step::Item(i) => {
                    here = here.and_then(DeValue::as_array).and_then(|a| a.get(*i)).map(Spanned::get_ref);
                    match here.and_then(name_of) {
                        Some(name) => text.push_str(name),
                        None => _ = write!(text, "{i}"),
                    }
                }
            }
        }
        if text.is_empty() { "scene".to_string() } else { text }
    }

    /// An error about the value at a path.
    pub fn error(&self, path: &KeyPath, problem: impl Into<String>) -> Error {
        let accepted = keys::accepted(&path.generic()).unwrap_or("see docs/scene.md").to_string();
        self.error_accepting(path, problem, accepted)
    }

    /// An error about the value at a path, with its own list of what is accepted.
    pub fn error_accepting(&self, path: &KeyPath, problem: impl Into<String>, accepted: impl Into<String>) -> Error {
        Error::Scene {
            place: self.place_of(path),
            key: self.display(path),
            problem: problem.into(),
            accepted: accepted.into(),
        }
    }

    /// A refusal of something that the format has and this version has not.
    pub fn not_built(&self, path: &KeyPath, what: impl Into<String>) -> Error {
        Error::NotBuilt { place: self.place_of(path), key: self.display(path), what: what.into() }
    }

    /// Reads the tree into a type.
    ///
    /// # Errors
    /// [`Error::Scene`] for an unknown key, a missing key or a value of the wrong type.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, Error> {
        T::deserialize(toml::Deserializer::from(self.root.clone())).map_err(|error| self.explain(&error))
    }

    /// Turns a deserialisation error into one that names the key and what is accepted there.
    fn explain(&self, error: &toml::de::Error) -> Error {
        let span = error.span().unwrap_or(0..0);
        let mut path = self.path_at(&span);
        let message = error.message().trim();
        let listed = |m: &str| m.split_once(", expected ").map(|(_, list)| list.replace('`', ""));
        let (problem, accepted) = if message.starts_with("missing field") {
            let key = message.split('`').nth(1).unwrap_or_default();
            path = path.key(key);
            (format!("missing key `{key}`"), None)
        } else if message.starts_with("unknown field") {
            let problem = message.split(", expected").next().unwrap_or(message).replace("field", "key");
            (problem, listed(message).map(|list| list.replace("one of ", "")))
        } else {
            (message.split(", expected").next().unwrap_or(message).to_string(), None)
        };
        let accepted = accepted
            .or_else(|| keys::accepted(&path.generic()).map(str::to_string))
            .or_else(|| listed(message))
            .unwrap_or_else(|| "see docs/scene.md".to_string());
        Error::Scene { place: self.place(&span), key: self.display(&path), problem, accepted }
    }

    /// The path of the key or value whose span fits most closely around `span`.
    fn path_at(&self, span: &Range<usize>) -> KeyPath {
        let mut best = (usize::MAX, KeyPath::default());
        search_table(self.root.get_ref(), span, &KeyPath::default(), &mut best);
        best.1
    }
}

fn search_table(table: &DeTable<'_>, span: &Range<usize>, path: &KeyPath, best: &mut (usize, KeyPath)) {
    for (key, value) in table.iter() {
        let path = path.key(key.get_ref());
        consider(&key.span(), span, &path, best);
        search_value(value, span, &path, best);
    }
}

fn search_value(value: &Spanned<DeValue<'_>>, span: &Range<usize>, path: &KeyPath, best: &mut (usize, KeyPath)) {
    consider(&value.span(), span, path, best);
    match value.get_ref() {
        DeValue::Table(table) => search_table(table, span, path, best),
        DeValue::Array(array) => {
            for (i, item) in array.iter().enumerate() {
                search_value(item, span, &path.item(i), best);
            }
        }
        _ => {}
    }
}

fn consider(candidate: &Range<usize>, span: &Range<usize>, path: &KeyPath, best: &mut (usize, KeyPath)) {
    let inside = candidate.start <= span.start && span.end <= candidate.end;
    let deeper = candidate.len() < best.0 || (candidate.len() == best.0 && path.0.len() < best.1.0.len());
    if inside && deeper {
        *best = (candidate.len(), path.clone());
    }
}

/// The name of a table.
pub(super) fn name_of<'v>(value: &'v DeValue<'_>) -> Option<&'v str> {
    value.as_table()?.get("name")?.get_ref().as_str()
}

fn line_of(text: &str, offset: usize) -> usize {
    1 + text.as_bytes()[..offset.min(text.len())].iter().filter(|&&b| b == b'\n').count()
}

/// A value with all its spans replaced.
pub(super) fn respanned<'t>(value: DeValue<'t>, span: &Range<usize>) -> Spanned<DeValue<'t>> {
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
