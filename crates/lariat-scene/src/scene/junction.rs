//! `[[junction]]`: two points of cables that are tied to each other.

use super::Scene;
use super::references::{Position, cable, point, unique};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Kind, POSITION, table};
use lariat_ancf::Cable;

/// Largest distance of the two points of a junction at the start, in m.
const JUNCTION_GAP: f64 = 1e-6;

table! {
    /// Ties two points of cables to each other, as a shackle without mass does: they share one position, their slopes are free.
    /// Several junctions at one point make one knot. Junctions need `engine = "rapier"`. With `initial = "equilibrium"` they
    /// stay where they are drawn while each cable finds its equilibrium; `lariat static` moves them.
    struct JunctionTable("[[junction]]") {
        /// No other junction has it.
        name: Option<String> = ("`junction-N`, counted from 0"), Kind::Name(&[]);
        /// Name of a cable.
        cable: String = required, Kind::Text;
        /// Arc length of the unstretched cable, from 0 to its length, where no attachment holds it.
        at: Position = required, POSITION, "m";
        /// Name of the cable that it is tied to, which may be the same.
        other: String = required, Kind::Text;
        /// Arc length of the other cable, where the first point starts, too, within 1e-6 m.
        other_at: Position = required, POSITION, "m";
    }
}

/// A checked junction.
#[derive(Clone, Debug, PartialEq)]
pub struct JunctionScene {
    /// Name.
    pub name: String,
    /// Positions of the cables in [`Scene::cables`], and arc lengths in m.
    pub points: [(usize, f64); 2],
}

/// Reads the junction in row `i`.
pub(super) fn read(doc: &Document<'_>, scene: &Scene, i: usize, row: JunctionTable) -> Result<JunctionScene, Error> {
    let at = KeyPath::root("junction").item(i);
    let tied = |key: &str, name: &str, at_key: &str, position| {
        let cable = cable(doc, &at.key(key), scene, name)?;
        point(doc, &at.key(at_key), position, scene, cable)
    };
    let points = [tied("cable", &row.cable, "at", row.at)?, tied("other", &row.other, "other_at", row.other_at)?];
    let same = |a: (usize, f64), b: (usize, f64)| a.0 == b.0 && (a.1 - b.1).abs() <= 1e-9 * scene.cables[a.0].length;
    for (key, point) in ["at", "other_at"].into_iter().zip(points) {
        if let Some(other) = scene.attachments.iter().find(|a| same((a.cable, a.arc_length), point)) {
            let problem = Problem::Conflict(format!("attachment {:?} already holds the cable there", other.name));
            return Err(doc.error_accepting(&at.key(key), problem, "a point that no attachment holds"));
        }
    }
    if same(points[0], points[1]) {
        let problem = Problem::Conflict("the point would be tied to itself".to_string());
        return Err(doc.error_accepting(&at.key("other_at"), problem, "another point"));
    }
    let tied = points.map(|point| scene.junctions.iter().find(|j| j.points.iter().any(|&p| same(p, point))));
    if let [Some(first), Some(second)] = tied {
        let problem = Problem::Conflict(format!(
            "junction {:?} and junction {:?} already tie both points, to each other or to others",
            first.name, second.name
        ));
        return Err(doc.error_accepting(&at, problem, "a pair of points of which one is not tied yet"));
    }
    let name = row.name.unwrap_or_else(|| format!("junction-{i}"));
    unique(doc, &at, &name, scene.junctions.iter().map(|j| j.name.as_str()))?;
    Ok(JunctionScene { name, points })
}

/// Compares the two points of each junction on the cables as drawn.
pub(super) fn check_start(doc: &Document<'_>, scene: &Scene, cables: &[Cable]) -> Result<(), Error> {
    for (i, junction) in scene.junctions.iter().enumerate() {
        let at = KeyPath::root("junction").item(i);
        let position = |(cable, s): (usize, f64)| {
            cables[cable].sample(s).map(|x| x.position).map_err(|error| doc.conflict(&at, error.to_string()))
        };
        let [a, b] = [position(junction.points[0])?, position(junction.points[1])?];
        let gap = (b - a).norm();
        if gap > JUNCTION_GAP {
            let (a, b) = (a.as_slice(), b.as_slice());
            let problem = format!("the points start {gap:.3e} m apart, at {a:?} and {b:?}");
            return Err(doc.conflict(&at.key("other_at"), problem));
        }
    }
    Ok(())
}
