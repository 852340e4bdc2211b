//! `[[sheave]]`: a wheel or an eye over which a cable runs, or one cable into another.

use super::passing::Passed;
use super::references::{Position, cable, unique};
use super::{Scene, integrator};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Choose, Kind, NOT_NEGATIVE, POSITION, VECTOR, table};
use lariat_ancf::{At, Cable, Reel, Vector3};

/// Largest distance of the two ends at a sheave as drawn, in m.
const GAP: f64 = 1e-3;

table! {
    /// A wheel or an eye that a cable runs over: along one cable (`cable`, `at`, `body`, `anchor`), or from the last point of one cable to the first
    /// point of another (`from`, `to`), which attachments hold at one point and which have one mass per length, EA and EI. Several may be along a
    /// cable. It stays one cable: attachments, loads, probes, cuts and breaks count arc lengths along all of it, at t = 0, and stay with
    /// their material, as probes do where it runs over the wheel. Between sheaves it is computed in parts; an attachment, a junction or a load
    /// stops it before it comes to the wheel, which a warning tells. Needs the integrator `discrete-gradient` and `engine = "rapier"`.
    struct SheaveTable("[[sheave]]") {
        /// No other sheave has it.
        name: Option<String> = ("`sheave-N`, counted from 0"), Kind::Name(&[]);
        /// Name of a cable that runs over it.
        cable: Option<String> = (), Kind::Text;
        /// Arc length of the unstretched cable at the sheave at t = 0, or a share of its length; with a `radius`, of any point on the wheel as drawn.
        at: Option<Position> = ("required with `cable`"), POSITION, "m";
        /// Name of the body that holds it, or `"world"`.
        body: Option<String> = ("required with `cable`"), Kind::Text;
        /// The eye, or the centre of the wheel, in the axes of the body or the world. The cable is drawn through it, or around the wheel; with
        /// `initial = "equilibrium"` anywhere.
        anchor: Option<Vector3<f64>> = ("required with `cable`"), VECTOR, "m";
        /// Radius of the wheel: the cable leaves it where its drawn parts touch it, and what is on it counts to the length, by default too. These two
        /// points stay on the body, so that a part which turns by an angle there is off by that times the radius, which a warning tells. 0 is an eye.
        radius: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "m";
        /// Name of the cable whose last point is at the sheave, instead of `cable`.
        from: Option<String> = (), Kind::Text;
        /// Name of the cable whose first point is at the sheave.
        to: Option<String> = ("required with `from`"), Kind::Text;
        /// Coefficient of friction of the rope on the wheel: tensions differ by up to exp(friction angle), with the angle between the
        /// directions of both sides.
        friction: f64 = 0.0, Kind::Number(NOT_NEGATIVE);
        /// Angle beyond that by which the rope is wound around the wheel.
        turns: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "rad";
        /// Inertia of the wheel over the square of its radius.
        inertia: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "kg";
        /// Constant friction.
        brake: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "N";
    }
    choose Choose::ExactlyOne(&["cable", "from"]);
}

/// A checked sheave.
#[derive(Clone, Debug, PartialEq)]
pub struct SheaveScene {
    /// Name.
    pub name: String,
    /// Positions in [`Scene::cables`] of the cables whose last and whose first point is there.
    pub cables: [usize; 2],
    /// Whether both are parts of one cable.
    pub along: bool,
    /// Radius of the wheel in m.
    pub radius: f64,
    /// Length on the wheel in m.
    pub on_wheel: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Further angle in rad.
    pub turns: f64,
    /// Inertia in kg.
    pub inertia: f64,
    /// Constant friction in N.
    pub brake: f64,
}

/// Reads the sheave in row `i`, along a cable as [divided](super::passing) there.
pub(super) fn read(
    doc: &Document<'_>,
    scene: &mut Scene,
    i: usize,
    row: SheaveTable,
    along: Option<Passed>,
) -> Result<SheaveScene, Error> {
    let at = KeyPath::root("sheave").item(i);
    let cables = match along {
        Some(passed) => passed.parts,
        None => between(doc, scene, &at, &row)?,
    };
    for c in cables {
        let key = KeyPath::root("cable").item(scene.whole(c)).key("integrator");
        let written = scene.cables[c].integrator;
        scene.cables[c].integrator = integrator::by_discrete_gradient(doc, &key, written, "a cable over a sheave")?;
    }
    let name = row.name.unwrap_or_else(|| format!("sheave-{i}"));
    unique(doc, &at, &name, scene.sheaves.iter().map(|s| s.name.as_str()))?;
    let SheaveTable { friction, turns, inertia, brake, radius, .. } = row;
    let on_wheel = along.map_or(0.0, |passed| passed.on_wheel);
    let turns = turns + along.map_or(0.0, |passed| passed.turns);
    Ok(SheaveScene { name, cables, along: along.is_some(), radius, on_wheel, friction, turns, inertia, brake })
}

/// Returns the two cables that a sheave joins.
fn between(doc: &Document<'_>, scene: &Scene, at: &KeyPath, row: &SheaveTable) -> Result<[usize; 2], Error> {
    let keys = ["from", "to"];
    let named = |key: &str, name: &Option<String>| {
        let name = name.as_ref().ok_or_else(|| doc.missing(&at.key(key)))?;
        cable(doc, &at.key(key), scene, name)
    };
    let cables = [named("from", &row.from)?, named("to", &row.to)?];
    // the last part of one, and the first of the other
    let cables = [scene.parts[cables[0]].last().copied().unwrap_or(cables[0]), cables[1]];
    let mut bodies = [None; 2];
    for (k, c) in cables.into_iter().enumerate() {
        let (key, place, own) = (at.key(keys[k]), ["last", "first"][k], &scene.cables[c]);
        let taken = scene.sheaves.iter().any(|sheave| sheave.cables[k] == c);
        let wound = own.reel.is_some() && own.reel_at_start == (k == 1);
        if taken || wound {
            let problem = format!("the {place} point of cable {:?} is at a sheave or a reel already", own.name);
            return Err(doc.conflict(&key, problem));
        }
        let s = if k == 0 { own.length } else { 0.0 };
        let here = |a: &&super::AttachmentScene| a.cable == c && (a.arc_length - s).abs() <= 1e-9 * own.length;
        let Some(attachment) = scene.attachments.iter().find(here) else {
            let problem = Problem::Conflict(format!("no attachment holds the {place} point of cable {:?}", own.name));
            return Err(doc.error_accepting(&key, problem, "two cables that attachments hold at one point"));
        };
        bodies[k] = Some(attachment.body);
    }
    if bodies[0] != bodies[1] {
        return Err(doc.conflict(at, "its two ends are attached to different bodies"));
    }
    Ok(cables)
}

/// Compares the two ends at each sheave on the cables as drawn, and checks that what they have goes with a sheave and with a drum. Returns the cables with the reels of these.
pub(super) fn check_start(doc: &Document<'_>, scene: &Scene, mut cables: Vec<Cable>) -> Result<Vec<Cable>, Error> {
    for (i, sheave) in scene.sheaves.iter().enumerate() {
        let at = KeyPath::root("sheave").item(i);
        let [from, to] = sheave.cables.map(|c| &cables[c]);
        let gap = (from.node_position(from.nodes() - 1) - to.node_position(0)).norm();
        if gap > GAP && !sheave.along {
            return Err(doc.conflict(&at, format!("the ends of its cables start {gap:.3e} m apart")));
        }
        for (c, end) in sheave.cables.into_iter().zip([At::End, At::Start]) {
            let added = cables[c].add_reel(end, Reel::over_sheave());
            added.map_err(|error| doc.conflict(&at, error.to_string()))?;
        }
    }
    for (c, own) in scene.cables.iter().enumerate() {
        if let (Some(reel), Some(_)) = (&own.reel, own.drum) {
            let at = KeyPath::root("cable").item(scene.whole(c)).key("reel");
            let end = if own.reel_at_start { At::Start } else { At::End };
            cables[c].add_reel(end, reel.clone()).map_err(|error| doc.conflict(&at, error.to_string()))?;
        }
    }
    Ok(cables)
}
