//! `--set cable.sling.elements=20`: overrides of a scene from the command line, put in before anything is checked.
//!
//! The path is dotted, as TOML writes it (a name with a dot or a space in quotes). Tables of an array are addressed by their
//! name or by their position from 0. The value is read as TOML; a value that is not TOML is taken as a text.

use super::{Document, name_of, respanned};
use crate::error::{Error, did_you_mean};
use crate::suggest::nearest;
use std::borrow::Cow;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

impl<'t> Document<'t> {
    /// Puts an override `KEY=VALUE` into the tree.
    ///
    /// # Errors
    /// [`Error::Override`] if the key is not a path into the scene.
    pub fn set(&mut self, argument: &'t str) -> Result<(), Error> {
        let fail = |problem: String| Err(Error::Override { argument: argument.to_string(), problem });
        let Some((path, text)) = argument.split_once('=') else {
            return fail("no value; accepted: KEY=VALUE, such as cable.sling.elements=20".to_string());
        };
        let Some(steps) = steps_of(path.trim()) else {
            return fail(format!("{:?} is not a dotted key; accepted: KEY=VALUE, such as dt=0.01", path.trim()));
        };
        let text = text.trim();
        let value = DeValue::parse(text).map_or(DeValue::String(Cow::Borrowed(text)), Spanned::into_inner);
        let span = self.override_span(self.overrides.len());
        self.overrides.push(argument);
        let value = respanned(value, &span);
        let empty = || Spanned::new(span.clone(), DeValue::Table(DeTable::new()));
        let key_of = |step: &str| Spanned::new(span.clone(), Cow::Owned(step.to_string()));

        let (last, first) = match steps.split_last() {
            Some(split) => split,
            None => return fail("no key".to_string()),
        };
        let mut table = self.root.get_mut();
        let mut walk = first.iter();
        while let Some(step) = walk.next() {
            if !table.contains_key(step.as_str()) {
                table.insert(key_of(step), empty());
            }
            let Some(next) = table.get_mut(step.as_str()) else { return fail(format!("no key {step:?}")) };
            let mut here = next.get_mut();
            if let DeValue::Array(items) = here {
                let names: Vec<String> = items
                    .iter()
                    .enumerate()
                    .map(|(i, item)| name_of(item.get_ref()).map_or(i.to_string(), str::to_string))
                    .collect();
                let Some(wanted) = walk.next() else {
                    return fail(format!(
                        "{step} is an array; accepted: {step}.NAME.KEY with NAME = {}",
                        names.join(", ")
                    ));
                };
                let by_position = || wanted.parse::<usize>().ok().filter(|i| *i < names.len());
                let Some(i) = names.iter().position(|name| name == wanted).or_else(by_position) else {
                    let near = nearest(wanted, names.iter().map(String::as_str));
                    let near = did_you_mean(near.as_deref());
                    return fail(format!("no {step} is named {wanted:?}; accepted: {}{near}", names.join(", ")));
                };
                let Some(item) = items.get_mut(i) else { return fail(format!("no {step} {i}")) };
                here = item.get_mut();
            }
            match here {
                DeValue::Table(inner) => table = inner,
                _ => return fail(format!("{step} is a single value, not a table; accepted: {step}=VALUE")),
            }
        }
        table.insert(key_of(last), value);
        Ok(())
    }
}

/// Returns the steps of a dotted path.
fn steps_of(path: &str) -> Option<Vec<String>> {
    let text = format!("{path} = 0");
    let mut table = DeTable::parse(&text).ok()?.into_inner();
    let mut steps = Vec::new();
    loop {
        if table.len() != 1 {
            return None;
        }
        let (key, value) = table.into_iter().next()?;
        steps.push(key.into_inner().into_owned());
        match value.into_inner() {
            DeValue::Table(inner) => table = inner,
            _ => return Some(steps),
        }
    }
}
