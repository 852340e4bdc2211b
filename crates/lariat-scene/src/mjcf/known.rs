//! What of the schema of MuJoCo is known: each element and attribute is read, harmless, told or refused, and what is in none
//! of these lists is an error.
//!
//! `known.txt` is the list, over the schema that MuJoCo 3.17 prints (`mj_printSchema`). *Read* is used; *harmless* is what
//! changes no motion: drawing, names, sensors, the numerics of MuJoCo's solver; *told* is left out with a warning: it acts
//! neither at rest nor on the shape of an equilibrium, as damping, friction, limits and controls at zero; *refused* would
//! change the equilibrium. The values after told and refused are those that do nothing.

use super::Note;
use super::tree::Element;
use crate::error::Error;
use crate::suggest::nearest;
use std::collections::HashMap;
use std::sync::LazyLock;

#[derive(Clone, Copy)]
enum Treatment {
    Read,
    Harmless,
    Told,
    Refused,
}

struct Entry {
    treatment: Treatment,
    idle: Vec<&'static str>,
    reason: &'static str,
}

type Known = HashMap<&'static str, HashMap<&'static str, Entry>>;

static KNOWN: LazyLock<Known> = LazyLock::new(|| {
    let mut known = Known::new();
    for line in include_str!("known.txt").lines().filter(|line| !line.starts_with('#')) {
        let mut parts = line.split(" | ");
        let [path, treatment, names, reason] = [(); 4].map(|()| parts.next().unwrap_or_default());
        let mut words = treatment.split_whitespace();
        let treatment = match words.next() {
            Some("told") => Treatment::Told,
            Some("refused") => Treatment::Refused,
            Some("harmless") => Treatment::Harmless,
            _ => Treatment::Read,
        };
        let idle: Vec<&str> = words.collect();
        for name in names.split_whitespace() {
            let entry = Entry { treatment, idle: idle.clone(), reason };
            known.entry(path).or_default().insert(name, entry);
        }
    }
    known
});

/// Checks all elements of a model, after its defaults were written into them; returns what is left out.
///
/// # Errors
/// The file, the line, the element and the attribute of what is unknown or refused.
pub(super) fn check(root: &Element, notes: &mut Vec<Note>) -> Result<(), Error> {
    attributes(root, "mujoco", notes)?;
    children(root, "mujoco", notes)
}

fn children(element: &Element, path: &str, notes: &mut Vec<Note>) -> Result<(), Error> {
    for child in &element.children {
        let path = path_of(path, &child.name);
        attributes(child, &path, notes)?;
        children(child, &path, notes)?;
    }
    Ok(())
}

/// Returns the name of an element in the list: its own, after that of its parent if that is not the root; bodies, the
/// world and frames in each other are `body`.
fn path_of(parent: &str, name: &str) -> String {
    let is_body = matches!((parent, name), ("mujoco", "worldbody") | ("body" | "frame", "body"));
    match (parent.rsplit('/').next().unwrap_or_default(), name) {
        _ if is_body => "body".to_string(),
        ("body" | "frame", "frame") => "frame".to_string(),
        ("mujoco", name) | ("default", name @ "default") => name.to_string(),
        ("frame", name) => format!("body/{name}"),
        (parent, name) => format!("{parent}/{name}"),
    }
}

fn attributes(element: &Element, path: &str, notes: &mut Vec<Note>) -> Result<(), Error> {
    let Some(known) = KNOWN.get(path) else {
        let parent = path.split('/').next().filter(|_| path.contains('/')).unwrap_or("mujoco");
        return Err(
            element.wrong(format!("is not known in <{parent}>; known are elements of MuJoCo 3.17 without replicate"))
        );
    };
    judge(element, None, known.get("."), notes)?;
    for (key, value) in &element.attributes {
        let Some(entry) = known.get(key.as_str()) else {
            let near = nearest(key, known.keys().copied().filter(|name| *name != "."));
            let near = near.map(|near| format!("; do you mean {near}?")).unwrap_or_default();
            return Err(element.wrong(format!("{key}: is not known{near}")));
        };
        judge(element, Some((key, value)), Some(entry), notes)?;
    }
    Ok(())
}

fn judge(
    element: &Element,
    attribute: Option<(&str, &str)>,
    entry: Option<&Entry>,
    notes: &mut Vec<Note>,
) -> Result<(), Error> {
    let Some(Entry { treatment, idle, reason }) = entry else { return Ok(()) };
    let what = attribute.map_or(String::new(), |(key, value)| format!("{key} = {value:?}: "));
    let zero = |word: &str, idle: &str| match (word.parse::<f64>(), idle.parse::<f64>()) {
        (Ok(a), Ok(b)) => a == b,
        _ => word == idle,
    };
    let acts = attribute.is_none_or(|(_, value)| {
        idle.is_empty() || !value.split_whitespace().all(|word| idle.iter().any(|idle| zero(word, idle)))
    });
    match treatment {
        Treatment::Told if acts => notes.push(Note::at(element, format!("{what}{reason}"))),
        Treatment::Refused if acts => return Err(element.wrong(format!("{what}is not read: {reason}"))),
        _ => {}
    }
    Ok(())
}
