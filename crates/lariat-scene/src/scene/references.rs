//! Names and places that tables of a scene refer to.

use super::Scene;
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{ANY, choice};
use lariat_ancf::Vector3;
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
}

/// Returns the arc length (m) of a point of a cable of this length (m).
pub(super) fn arc_length(doc: &Document<'_>, at: &KeyPath, point: Position, length: f64) -> Result<f64, Error> {
    let s = match point {
        Position::ArcLength(s) => s,
        Position::End(CableEnd::Start) => 0.0,
        Position::End(CableEnd::End) => length,
    };
    if (0.0..=length).contains(&s) {
        return Ok(s);
    }
    Err(doc.conflict(at, format!("{s} m is not on the cable, which is {length} m long")))
}

/// Returns the position of a cable in the scene's list.
pub(super) fn cable(doc: &Document<'_>, at: &KeyPath, scene: &Scene, name: &str) -> Result<usize, Error> {
    let known = || scene.cables.iter().map(|cable| cable.name.as_str());
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

/// Checks that a vector stays finite in the single precision of Rapier.
pub(super) fn single(doc: &Document<'_>, at: &KeyPath, vector: &Vector3<f64>) -> Result<(), Error> {
    match vector.iter().find(|x| !ANY.single().contains(**x)) {
        Some(x) => Err(doc.error(at, Problem::BeyondSingle(*x))),
        None => Ok(()),
    }
}
