//! `[[sheave]]`: a wheel over which one cable runs into another.

use super::references::{cable, unique};
use super::{Scene, integrator};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Kind, NOT_NEGATIVE, table};
use lariat_ancf::Cable;

/// Largest distance of the two ends at a sheave as drawn, in m.
const GAP: f64 = 1e-3;

table! {
    /// Lets a cable run into another over a wheel without extent: from the last point of one to the first point of the other, which
    /// attachments hold at one point, of a body or of the world. Both cables need one mass per length and the integrator `discrete-gradient`.
    /// Sheaves need `engine = "rapier"`. Arc lengths of the second cable grow with what runs into it, so attachments, loads and
    /// probes stay with their material.
    struct SheaveTable("[[sheave]]") {
        /// No other sheave has it.
        name: Option<String> = ("`sheave-N`, counted from 0"), Kind::Name(&[]);
        /// Name of the cable whose last point is at the sheave.
        from: String = required, Kind::Text;
        /// Name of the cable whose first point is at the sheave.
        to: String = required, Kind::Text;
        /// Coefficient of friction of the rope on the wheel: tensions differ by up to exp(friction angle), with the angle between the
        /// directions of both cables.
        friction: f64 = 0.0, Kind::Number(NOT_NEGATIVE);
        /// Angle beyond that by which the rope is wound around the wheel.
        turns: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "rad";
        /// Inertia of the wheel over the square of its radius.
        inertia: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "kg";
        /// Constant friction.
        brake: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "N";
    }
}

/// A checked sheave.
#[derive(Clone, Debug, PartialEq)]
pub struct SheaveScene {
    /// Name.
    pub name: String,
    /// Positions in [`Scene::cables`] of the cables whose last and whose first point is there.
    pub cables: [usize; 2],
    /// Coefficient of friction.
    pub friction: f64,
    /// Further angle in rad.
    pub turns: f64,
    /// Inertia in kg.
    pub inertia: f64,
    /// Constant friction in N.
    pub brake: f64,
}

/// Reads the sheave in row `i`.
pub(super) fn read(doc: &Document<'_>, scene: &mut Scene, i: usize, row: SheaveTable) -> Result<SheaveScene, Error> {
    let at = KeyPath::root("sheave").item(i);
    let keys = ["from", "to"];
    let cables = [cable(doc, &at.key("from"), scene, &row.from)?, cable(doc, &at.key("to"), scene, &row.to)?];
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
        return Err(doc.conflict(&at, "its two ends are attached to different bodies"));
    }
    for c in cables {
        if scene.cables[c].breaking != Default::default() && c == cables[1] {
            return Err(doc.conflict(&at.key("to"), "a cable that breaks cannot have its first point at a sheave"));
        }
        let key = KeyPath::root("cable").item(c).key("integrator");
        let written = scene.cables[c].integrator;
        scene.cables[c].integrator = integrator::by_discrete_gradient(doc, &key, written, "a cable over a sheave")?;
    }
    let name = row.name.unwrap_or_else(|| format!("sheave-{i}"));
    unique(doc, &at, &name, scene.sheaves.iter().map(|s| s.name.as_str()))?;
    let SheaveTable { friction, turns, inertia, brake, .. } = row;
    Ok(SheaveScene { name, cables, friction, turns, inertia, brake })
}

/// Compares the two ends at each sheave on the cables as drawn.
pub(super) fn check_start(doc: &Document<'_>, scene: &Scene, cables: &[Cable]) -> Result<(), Error> {
    for (i, sheave) in scene.sheaves.iter().enumerate() {
        let [from, to] = sheave.cables.map(|c| &cables[c]);
        let gap = (from.node_position(from.nodes() - 1) - to.node_position(0)).norm();
        if gap > GAP {
            let problem = format!("the ends of its cables start {gap:.3e} m apart");
            return Err(doc.conflict(&KeyPath::root("sheave").item(i), problem));
        }
    }
    Ok(())
}
