//! `[[load]]`: forces and moments at points of cables and bodies.

use super::Scene;
use super::body::BodyKind;
use super::references::{Position, body, cable, point};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Choose, Kind, NOT_NEGATIVE, POSITION, VECTOR, table};
use lariat_ancf::{Cable, PointLoad, Vector3};
use serde::{Deserialize, Serialize};

table! {
    /// A point force or moment with a constant direction in the world, on a cable or on a dynamic body.
    struct LoadTable("[[load]]") {
        /// Name of a cable, with `at`; or `body`.
        cable: Option<String> = (), Kind::Text;
        /// Arc length of the unstretched cable, from 0 to its length, beside `cable`.
        at: Option<Position> = (), POSITION, "m";
        /// Name of a dynamic body, instead of `cable`.
        body: Option<String> = (), Kind::Text;
        /// Point of the body, in its axes from its origin, beside `body`.
        point: Option<Vector3<f64>> = ("the origin"), VECTOR, "m";
        /// Force.
        force: Option<Vector3<f64>> = ("zero"), VECTOR, "N";
        /// Moment.
        moment: Option<Vector3<f64>> = ("zero"), VECTOR, "N m";
        /// Time from zero to the full load. A load with a ramp is zero at t = 0 and takes no part in `initial = "equilibrium"`.
        /// `lariat static` applies all loads in full.
        ramp: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "s";
        /// Factor of time, beside the ramp: linear between rows, constant outside; put corners on multiples of `dt`. Statics and
        /// `initial = "equilibrium"` are with its value at t = 0.
        history: Option<Vec<[f64; 2]>> = ("1"), Kind::Ascending(&["t", "factor"]), "s, 1";
    }
    choose Choose::AtLeastOne(&["force", "moment"]);
}

/// A checked point load on a cable.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadScene {
    /// Position of the cable in [`Scene::cables`].
    pub cable: usize,
    /// The load.
    pub load: PointLoad,
    /// Row of the table.
    pub(super) row: usize,
}

/// A checked load on a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyLoadScene {
    /// Position of the body in [`Scene::bodies`].
    pub body: usize,
    /// Where the force acts, in axes of the body from its origin, in m.
    pub point: Vector3<f64>,
    /// Force, moment, and how they change with time; its arc length is 0.
    pub load: PointLoad,
}

impl BodyLoadScene {
    /// Returns force (N) and moment (N m) at a time in s; `in_full` whatever its ramp.
    pub fn at(&self, time: f64, in_full: bool) -> (Vector3<f64>, Vector3<f64>) {
        let factor = if in_full { self.load.history_at(time) } else { self.load.factor(time) };
        (self.load.force * factor, self.load.moment * factor)
    }
}

/// Reads the load in row `i` and adds it to the scene.
pub(super) fn read(doc: &Document<'_>, scene: &mut Scene, i: usize, row: LoadTable) -> Result<(), Error> {
    let at = KeyPath::root("load").item(i);
    let (force, moment) = (row.force.unwrap_or_default(), row.moment.unwrap_or_default());
    let history = row.history.unwrap_or_default();
    let mut load = PointLoad { force, moment, ramp: row.ramp, history, ..PointLoad::default() };
    if let Some(name) = &row.body {
        for (key, given) in [("cable", row.cable.is_some()), ("at", row.at.is_some())] {
            if given {
                let problem = Problem::Conflict(format!("{key} is for a load on a cable"));
                return Err(doc.error_accepting(&at.key(key), problem, "body and point"));
            }
        }
        let body = body(doc, &at.key("body"), scene, name)?;
        if scene.bodies[body].kind != BodyKind::Dynamic {
            return Err(doc.conflict(&at.key("body"), format!("{name:?} is not dynamic, no force moves it")));
        }
        let point = row.point.unwrap_or_default();
        for (key, vector) in [("point", &point), ("force", &force), ("moment", &moment)] {
            doc.check_single(&at.key(key), vector)?;
        }
        scene.body_loads.push(BodyLoadScene { body, point, load });
        return Ok(());
    }
    if row.point.is_some() {
        let problem = Problem::Conflict("point is for a load on a body".to_string());
        return Err(doc.error_accepting(&at.key("point"), problem, "cable and at"));
    }
    let name = row.cable.ok_or_else(|| doc.missing(&at.key("cable")))?;
    let cable = cable(doc, &at.key("cable"), scene, &name)?;
    let position = row.at.ok_or_else(|| doc.missing(&at.key("at")))?;
    let (cable, arc_length) = point(doc, &at.key("at"), position, scene, cable)?;
    load.arc_length = arc_length;
    scene.loads.push(LoadScene { cable, load, row: i });
    Ok(())
}

/// Checks that the cables, with their reels and as the run has them, carry their loads.
pub(super) fn check_start(doc: &Document<'_>, scene: &Scene, mut cables: Vec<Cable>) -> Result<(), Error> {
    for own in &scene.loads {
        let at = KeyPath::root("load").item(own.row);
        cables[own.cable].add_load(own.load.clone()).map_err(|error| {
            doc.error_accepting(
                &at.key("at"),
                Problem::Conflict(error.to_string()),
                "a point that the cable carries a load at",
            )
        })?;
    }
    Ok(())
}
