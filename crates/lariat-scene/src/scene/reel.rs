//! `[cable.reel]`: a winch at the end of a cable.

use super::effects::typed;
use crate::document::{Document, KeyPath};
use crate::error::Error;
use crate::schema::{Default, Key, Kind, NOT_NEGATIVE, POSITIVE, choice, table};
use lariat_ancf::{Feed, Reel};

choice! {
    /// Where a reel is.
    enum ReelEnd {
        /// At the first point.
        Start = "start",
        /// At the last point.
        End = "end",
    }
}

choice! {
    /// How cable comes to the eye.
    enum Feeding {
        /// From a drum that turns with the rate.
        Drum = "drum",
        /// From a coil at rest, picked up inelastically: `m g = d(m v)/dt`.
        Coil = "coil",
        /// From a bag at rest, without loss.
        Bag = "bag",
    }
}

table! {
    /// A reel through which cable is paid out and taken in. Only the element at the eye, the point of the reel, changes its length; attachments,
    /// loads and probes stay with their material, wherever its arc length is then. Hold the eye by an
    /// attachment at that end. On a dynamic body what is not out of the `stock` rides along, beside the body's own mass; that needs the
    /// integrator `discrete-gradient`.
    struct ReelTable("[cable.reel]") {
        /// The end that it is at.
        end: ReelEnd = "end", Kind::Choice(ReelEnd::names);
        /// Rate from a time on: positive pays out.
        rate: Vec<[f64; 2]> = required, Kind::Ascending(&["t", "rate"]), "s, m/s";
        /// Largest acceleration of the rate.
        acceleration: f64 = 2.0, Kind::Number(POSITIVE), "m/s^2";
        /// Largest length of cable that can be out: the reel stops there. Needed on a dynamic body.
        stock: Option<f64> = ("no limit"), Kind::Number(POSITIVE), "m";
        /// Largest force of the motor: the reel slips where the cable pulls more. A clutch; with a rate of 0 a brake; 0 is a free
        /// spool. Needs the integrator `discrete-gradient`.
        max_force: Option<f64> = ("as strong as it must be"), Kind::Number(NOT_NEGATIVE), "N";
        /// Inertia of the wheel over the square of its radius, where the reel slips; the stock on a drum is added, if `stock` is given.
        inertia: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "kg";
        /// How cable comes to the eye while it is paid out.
        feed: Feeding = "drum", Kind::Choice(Feeding::names);
    }
}

/// The key of the table.
pub(super) const REEL: Key = Key {
    name: "reel",
    kind: Kind::Table(&ReelTable::TABLE),
    unit: "",
    default: Default::Absent("none"),
    meaning: "Change of the unstretched length at an end.",
};

/// Reads the table at a path from the keys of its cable; with the reel, whether it is at the first point.
pub(super) fn read(doc: &Document<'_>, at: &KeyPath, rows: &mut toml::Table) -> Result<Option<(Reel, bool)>, Error> {
    let Some(value) = rows.remove(REEL.name) else { return Ok(None) };
    let ReelTable { end, rate, acceleration, stock, max_force, inertia, feed } = typed(doc, &at.key(REEL.name), value)?;
    let feed = match feed {
        Feeding::Drum => Feed::Drum,
        Feeding::Coil => Feed::Coil,
        Feeding::Bag => Feed::Bag,
    };
    Ok(Some((Reel { rate, acceleration, stock, max_force, inertia, feed }, end == ReelEnd::Start)))
}
