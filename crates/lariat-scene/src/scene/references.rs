//! Names and places that tables of a scene refer to.

use super::Scene;
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{choice, share};
use serde::Deserialize;

choice! {
    /// An end of a cable.
    enum CableEnd {
        /// The first point.
        Start = "start",
        /// The last point.
        End = "end",
    }
}

/// A point of a cable as a scene writes it.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
pub enum Position {
    /// Arc length of the unstretched cable in m.
    ArcLength(f64),
    /// One of its ends.
    End(CableEnd),
    /// A share of its length.
    Share(Share),
}

/// A share of a length, written in percent.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "String")]
pub struct Share(f64);

impl TryFrom<String> for Share {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        share(&text).map(Share)
    }
}

/// Length, as a share of that of the cable, by which a point may lie beyond an end: it is at the end then.
const BEYOND: f64 = 1e-9;

/// Returns the arc length (m) of a point of a cable of this length (m).
pub(super) fn arc_length(doc: &Document<'_>, at: &KeyPath, point: Position, length: f64) -> Result<f64, Error> {
    let s = match point {
        Position::ArcLength(s) => s,
        Position::End(CableEnd::Start) => 0.0,
        Position::End(CableEnd::End) => length,
        Position::Share(Share(share)) => share * length,
    };
    if (-BEYOND * length..=(1.0 + BEYOND) * length).contains(&s) {
        return Ok(s.clamp(0.0, length));
    }
    Err(doc.conflict(at, format!("{s} m is not on the cable, which is {length} m long")))
}

/// Returns the part of a cable that has a point, and the arc length (m) on it. A point at a sheave is refused.
pub(super) fn point(
    doc: &Document<'_>,
    at: &KeyPath,
    point: Position,
    scene: &Scene,
    cable: usize,
) -> Result<(usize, f64), Error> {
    let s = arc_length(doc, at, point, scene.whole_length(cable))?;
    let (part, on_part) = match point {
        Position::End(CableEnd::End) => {
            let last = scene.parts[cable].last().copied().unwrap_or(cable);
            (last, scene.cables[last].length)
        }
        _ => scene.part_at(cable, s),
    };
    let parts = &scene.parts[cable];
    let slack = 1e-9 * scene.whole_length(cable);
    if let Some([before, _]) = scene.kinks.iter().find(|[_, behind]| *behind == part).filter(|_| on_part <= slack) {
        return Ok((*before, scene.cables[*before].length));
    }
    if scene.kinks.iter().any(|[before, _]| *before == part) {
        return Ok((part, on_part));
    }
    let at_first = parts[0] != part && on_part <= slack;
    let at_last = parts.last() != Some(&part) && on_part >= scene.cables[part].length - slack;
    if at_first || at_last {
        let problem = Problem::Conflict(format!("{s} m is at a sheave, which holds the cable there"));
        return Err(doc.error_accepting(at, problem, "a point between sheaves"));
    }
    Ok((part, on_part))
}

/// Returns the position of a cable in the scene's list.
pub(super) fn cable(doc: &Document<'_>, at: &KeyPath, scene: &Scene, name: &str) -> Result<usize, Error> {
    let known = || scene.cables[..scene.parts.len()].iter().map(|cable| cable.name.as_str());
    known().position(|n| n == name).ok_or_else(|| doc.unknown_name(at, "cable", name, known()))
}

/// Returns the position of a body in the scene's list.
pub(super) fn body(doc: &Document<'_>, at: &KeyPath, scene: &Scene, name: &str) -> Result<usize, Error> {
    let known = || scene.bodies.iter().map(|body| body.name.as_str());
    known().position(|n| n == name).ok_or_else(|| doc.unknown_name(at, "body", name, known()))
}

/// Returns the position of a body in the scene's list; `None` for the world.
pub(super) fn body_or_world(
    doc: &Document<'_>,
    at: &KeyPath,
    scene: &Scene,
    name: &str,
) -> Result<Option<usize>, Error> {
    if name == "world" {
        return Ok(None);
    }
    let known = || scene.bodies.iter().map(|body| body.name.as_str());
    let unknown = || doc.unknown_name(at, "body", name, ["world"].into_iter().chain(known()));
    known().position(|n| n == name).map(Some).ok_or_else(unknown)
}

/// Checks that no other has a name.
pub(super) fn unique<'n>(
    doc: &Document<'_>,
    at: &KeyPath,
    name: &str,
    mut others: impl Iterator<Item = &'n str>,
) -> Result<(), Error> {
    if others.any(|other| other == name) {
        return Err(doc.error(&at.key("name"), Problem::NameTaken(name.to_string())));
    }
    Ok(())
}
