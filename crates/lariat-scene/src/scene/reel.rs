//! `[cable.reel]`: a winch at the end of a cable.

use super::effects::typed;
use crate::document::{Document, KeyPath};
use crate::error::Error;
use crate::schema::{Default, Key, Kind, POSITIVE, choice, table};
use lariat_ancf::Reel;

choice! {
    /// Where a reel is.
    enum ReelEnd {
        /// At the last point.
        End = "end",
    }
}

table! {
    /// A reel through which cable is paid out and taken in. Only the element at the eye, the point of the reel, changes its length; arc
    /// lengths count from the other end, so attachments, loads and probes stay with their material. Hold the eye by an
    /// attachment at `"end"`, to the world or to a fixed or kinematic body.
    struct ReelTable("[cable.reel]") {
        /// The end that it is at: draw the cable towards it.
        end: ReelEnd = "end", Kind::Choice(ReelEnd::names);
        /// Rate from a time on: positive pays out.
        rate: Vec<[f64; 2]> = required, Kind::Ascending(&["t", "rate"]), "s, m/s";
        /// Largest acceleration of the rate.
        acceleration: f64 = 2.0, Kind::Number(POSITIVE), "m/s^2";
        /// Largest length of cable that can be out: the reel stops there.
        stock: Option<f64> = ("no limit"), Kind::Number(POSITIVE), "m";
    }
    plus &[Key {
        name: "max_force",
        kind: Kind::NotBuilt,
        unit: "N",
        default: Default::Absent("as strong as it must be"),
        meaning: "A clutch that slips.",
    }];
}

/// The key of the table.
pub(super) const REEL: Key = Key {
    name: "reel",
    kind: Kind::Table(&ReelTable::TABLE),
    unit: "",
    default: Default::Absent("none"),
    meaning: "Change of the unstretched length at the last point.",
};

/// Reads the table at a path from the keys of its cable.
pub(super) fn read(doc: &Document<'_>, at: &KeyPath, rows: &mut toml::Table) -> Result<Option<Reel>, Error> {
    let Some(value) = rows.remove(REEL.name) else { return Ok(None) };
    let ReelTable { end: ReelEnd::End, rate, acceleration, stock } = typed(doc, &at.key(REEL.name), value)?;
    Ok(Some(Reel { rate, acceleration, stock }))
}
