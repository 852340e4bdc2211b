//! `[cable.break]`: when a cable becomes two.

use super::references::{Position, arc_length};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Choose, Default, Key, Kind, NOT_NEGATIVE, POSITION, POSITIVE, table};
use lariat_ancf::Strength;

table! {
    /// When a cable becomes two: above a tension or strain, compared after each integration step, at the inner node nearest to the
    /// largest load; or by a cut. Attachments, loads, effects and probes stay with their part; both parts keep the limits.
    struct BreakTable("[cable.break]") {
        /// Largest tension, without that of damping.
        tension: Option<f64> = ("no limit"), Kind::Number(POSITIVE), "N";
        /// Largest strain: stretch over rest stretch less 1.
        strain: Option<f64> = ("no limit"), Kind::Number(POSITIVE);
        /// Time of a cut: the first host time from then on.
        time: Option<f64> = ("no cut"), Kind::Number(NOT_NEGATIVE), "s";
        /// Arc length of the cut, between the ends, with `time`.
        at: Option<Position> = ("required with `time`"), POSITION, "m";
    }
    choose Choose::AtLeastOne(&["tension", "strain", "time"]);
}

/// The key of the table.
pub(super) const BREAK: Key = Key {
    name: "break",
    kind: Kind::Table(&BreakTable::TABLE),
    unit: "",
    default: Default::Absent("it does not break"),
    meaning: "Limits of the load, and a cut.",
};

/// When a cable becomes two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BreakScene {
    /// What the cable withstands.
    pub strength: Strength,
    /// Time in s and arc length in m of a cut.
    pub cut: Option<(f64, f64)>,
}

/// Reads the table at a path from the keys of its cable of this length (m) and number of elements.
pub(super) fn read(
    doc: &Document<'_>,
    at: &KeyPath,
    rows: &mut toml::Table,
    (length, elements): (f64, u64),
) -> Result<BreakScene, Error> {
    let at = at.key(BREAK.name);
    let Some(value) = rows.remove(BREAK.name) else { return Ok(BreakScene::default()) };
    let table: BreakTable = doc.typed(&at, value)?;
    let strength = Strength { tension: table.tension, strain: table.strain };
    if strength.is_limited() && elements < 2 {
        let problem = Problem::Conflict("a cable of one element has no inner node to break at".to_string());
        return Err(doc.error_accepting(&at, problem, "elements >= 2"));
    }
    let cut = match (table.time, table.at) {
        (None, None) => None,
        (Some(_), None) => return Err(doc.missing(&at.key("at"))),
        (None, Some(_)) => return Err(doc.missing(&at.key("time"))),
        (Some(time), Some(position)) => {
            let s = arc_length(doc, &at.key("at"), position, length)?;
            if s <= 1e-9 * length || s >= length * (1.0 - 1e-9) {
                return Err(doc.conflict(&at.key("at"), format!("{s} m is an end of the cable")));
            }
            Some((time, s))
        }
    };
    Ok(BreakScene { strength, cut })
}
