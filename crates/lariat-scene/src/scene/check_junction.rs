//! Ranges and references of `[[junction]]`: points of cables that are tied to each other.

use super::check::{find_cable, number, place, unique};
use super::document::{Document, KeyPath};
use super::table::JunctionTable;
use super::{JunctionScene, Scene};
use crate::error::Error;
use lariat_ancf::Cable;

/// How far apart the two points of a junction may start, in m.
const JUNCTION_GAP: f64 = 1e-6;

pub(super) fn junction(
    doc: &Document<'_>,
    scene: &Scene,
    i: usize,
    row: JunctionTable,
) -> Result<JunctionScene, Error> {
    let at = KeyPath::root("junction").item(i);
    let end = |cable: &str, point: &str, name: &str, there| {
        let cable = find_cable(doc, scene, &at.key(cable), name)?;
        place(doc, &at.key(point), there, scene.cables[cable].length).map(|arc_length| (cable, arc_length))
    };
    let points = [end("cable", "at", &row.cable, row.at)?, end("other", "other_at", &row.other, row.other_at)?];
    let same = |a: (usize, f64), b: (usize, f64)| a.0 == b.0 && (a.1 - b.1).abs() <= 1e-9 * scene.cables[a.0].length;
    for (key, (cable, arc_length)) in ["at", "other_at"].into_iter().zip(points) {
        if let Some(other) = scene.attachments.iter().find(|a| same((a.cable, a.arc_length), (cable, arc_length))) {
            let problem = format!("attachment {:?} holds the cable there already", other.name);
            return Err(doc.error_accepting(&at.key(key), problem, "a point that no attachment holds"));
        }
    }
    if same(points[0], points[1]) {
        return Err(doc.error_accepting(&at.key("other_at"), "a point tied to itself", "another point"));
    }
    let tied = points.map(|point| scene.junctions.iter().find(|j| j.points.iter().any(|&p| same(p, point))));
    if let [Some(first), Some(second)] = tied {
        let problem = format!(
            "both points are tied to each other already, or to others, by junction {:?} and junction {:?}",
            first.name, second.name
        );
        return Err(doc.error_accepting(&at, problem, "a knot tied point by point: one of the two must be new to it"));
    }
    let name = row.name.unwrap_or_else(|| format!("junction-{i}"));
    unique(doc, &at.key("name"), &name, scene.junctions.iter().map(|j| j.name.as_str()))?;
    Ok(JunctionScene { name, points })
}

/// Compares where the two points of each junction start; `cables` are built as drawn.
pub(super) fn start(doc: &Document<'_>, scene: &Scene, cables: &[Cable]) -> Result<(), Error> {
    for (i, junction) in scene.junctions.iter().enumerate() {
        let at = KeyPath::root("junction").item(i);
        let place = |(cable, s): (usize, f64)| {
            cables[cable].sample(s).map(|x| x.position).map_err(|error| doc.error(&at, error.to_string()))
        };
        let [a, b] = [place(junction.points[0])?, place(junction.points[1])?];
        let gap = (b - a).norm();
        number(doc, &at, gap, |gap| gap <= JUNCTION_GAP).map_err(|_| {
            let (a, b) = (a.as_slice(), b.as_slice());
            doc.error(&at.key("other_at"), format!("the points start {gap:.3e} m apart, at {a:?} and {b:?}"))
        })?;
    }
    Ok(())
}
