//! `[[attachment]]`: a point of a cable that a body or the world holds.

use super::references::{Position, body_or_world, cable, point, unique};
use super::{Purpose, Scene};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Kind, NOT_NEGATIVE, POSITION, VECTOR, choice, table};
use lariat_ancf::{Cable, Vector3};
use lariat_rapier::Gap;
use serde::Deserialize;

choice! {
    /// What an attachment holds.
    enum AttachmentKind {
        /// The position.
        Ball = "ball",
        /// The position and the direction of the tangent.
        Clamp = "clamp",
    }
}

choice! {
    /// A gap that is not refused.
    enum ClosingGap {
        /// Closes.
        Close = "close",
    }
}

/// What a gap at the start means.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
pub enum GapRule {
    /// Largest distance allowed, in m.
    Limit(f64),
    /// Any gap closes.
    Closing(ClosingGap),
}

table! {
    /// Holds a point of a cable to a body or to the world.
    struct AttachmentTable("[[attachment]]") {
        /// No other attachment has it.
        name: Option<String> = ("`attachment-N`, counted from 0"), Kind::Name(&[]);
        /// Name of a cable.
        cable: String = required, Kind::Text;
        /// Arc length of the unstretched cable, from 0 to its length.
        at: Position = required, POSITION, "m";
        /// Name of a body, or `"world"`.
        body: String = required, Kind::Text;
        /// Where the body holds the cable, in the axes of the body or the world: no further than `gap` from where the cable point
        /// starts, or anywhere with `initial = "equilibrium"`. Anywhere in `lariat static`, too.
        anchor: Option<Vector3<f64>> = ("the cable point at t = 0"), VECTOR, "m";
        /// Largest distance of the anchor from where the cable point starts; or `"close"`, and the cable is drawn to the anchor from any
        /// distance, at 10 m/s at most. `"close"` needs a body.
        gap: GapRule = 1e-6, Kind::Either(&[Kind::Choice(ClosingGap::names), Kind::Number(NOT_NEGATIVE)]), "m";
        /// `"ball"` holds the position, `"clamp"` the direction of the tangent, too.
        kind: AttachmentKind = "ball", Kind::Choice(AttachmentKind::names);
        /// Direction of the tangent at a clamp, towards growing arc length, of any size, in the axes of the body or the world. A slack
        /// cable, or one that is turned, starts in static equilibrium between what holds it; a part with a free end turns with its clamp.
        direction: Option<Vector3<f64>> = ("of the drawn polyline there"), VECTOR;
    }
}

/// A checked attachment of a cable to a body or the world.
#[derive(Clone, Debug, PartialEq)]
pub struct AttachmentScene {
    /// Name.
    pub name: String,
    /// Position of the cable in [`Scene::cables`].
    pub cable: usize,
    /// Arc length in m.
    pub arc_length: f64,
    /// Position of the body in [`Scene::bodies`]; `None` = the world.
    pub body: Option<usize>,
    /// Anchor in m, in the axes of the body or the world; `None` = where the cable point is.
    pub anchor: Option<Vector3<f64>>,
    /// True to hold the direction of the tangent, too.
    pub clamp: bool,
    /// Direction of the tangent of a clamp, in the axes of the body or the world; `None` = that of the drawing.
    pub direction: Option<Vector3<f64>>,
    /// What to do if the cable point does not start at the anchor.
    pub gap: Gap,
    /// Position in [`Scene::attachments`] of the one before a [kink](super::kinks), if this holds the part behind it.
    pub other_side_of: Option<usize>,
}

/// Reads the attachment in row `i`.
pub(super) fn read(
    doc: &Document<'_>,
    scene: &Scene,
    i: usize,
    row: AttachmentTable,
) -> Result<AttachmentScene, Error> {
    let at = KeyPath::root("attachment").item(i);
    let cable = cable(doc, &at.key("cable"), scene, &row.cable)?;
    let (cable, arc_length) = point(doc, &at.key("at"), row.at, scene, cable)?;
    let length = scene.cables[cable].length;
    let body = body_or_world(doc, &at.key("body"), scene, &row.body)?;
    let name = row.name.unwrap_or_else(|| format!("attachment-{i}"));
    unique(doc, &at, &name, scene.attachments.iter().map(|a| a.name.as_str()))?;
    let same = |a: &&AttachmentScene| a.cable == cable && (a.arc_length - arc_length).abs() <= 1e-9 * length;
    if let Some(other) = scene.attachments.iter().find(same) {
        let problem = Problem::Conflict(format!("attachment {:?} already holds the cable there", other.name));
        return Err(doc.error_accepting(&at.key("at"), problem, "one attachment at a point of a cable"));
    }
    let gap = match row.gap {
        GapRule::Limit(limit) => Gap::Refuse(limit),
        GapRule::Closing(_) if body.is_none() => {
            return Err(
                doc.conflict(&at.key("gap"), "the world does not draw a cable to an anchor; a body does".to_string())
            );
        }
        GapRule::Closing(_) => Gap::Close,
    };
    let clamp = row.kind == AttachmentKind::Clamp;
    if let Some(direction) = row.direction {
        let problem = match clamp {
            false => Some("a ball holds no direction"),
            true if direction == Vector3::zeros() => Some("the direction has no length"),
            true => None,
        };
        if let Some(problem) = problem {
            let accepted = "a vector with kind = \"clamp\"";
            return Err(doc.error_accepting(&at.key("direction"), Problem::Conflict(problem.to_string()), accepted));
        }
    }
    let (anchor, direction) = (row.anchor, row.direction);
    Ok(AttachmentScene { name, cable, arc_length, body, anchor, clamp, direction, gap, other_side_of: None })
}

/// Says why an anchor may be so far from the point of its cable, if the scene shows it.
fn why_apart(scene: &Scene, attachment: &AttachmentScene, point: &Vector3<f64>, limit: f64) -> String {
    let (Some(body), Some(anchor)) = (attachment.body, attachment.anchor) else { return String::new() };
    let body = &scene.bodies[body];
    if (anchor - point).norm() <= limit {
        let name = &body.name;
        return format!(
            ": `anchor` is a point in the axes of body {name:?}, from its origin; was one of the world meant?"
        );
    }
    let many = body.angle > core::f64::consts::TAU * (1.0 + 1e-6);
    if many {
        format!(": body {:?} is rotated by {} rad; were degrees meant?", body.name, body.angle)
    } else {
        String::new()
    }
}

/// Compares the anchors with the points of the cables as drawn.
pub(super) fn check_start(doc: &Document<'_>, scene: &Scene, cables: &[Cable], purpose: Purpose) -> Result<(), Error> {
    if purpose != Purpose::Run || scene.equilibrium {
        return Ok(());
    }
    for (k, attachment) in scene.attachments.iter().enumerate() {
        let Some(anchor) = scene.anchor(attachment).filter(|_| !scene.cables[attachment.cable].equilibrium) else {
            continue;
        };
        let Gap::Refuse(limit) = attachment.gap else { continue };
        let at = KeyPath::root("attachment").item(k).key("anchor");
        let sample = cables[attachment.cable].sample(attachment.arc_length);
        let point = sample.map_err(|error| doc.conflict(&at, error.to_string()))?.position;
        let gap = (point - anchor).norm();
        if gap > limit {
            let why = why_apart(scene, attachment, &point, limit);
            let (anchor, point) = (anchor.as_slice(), point.as_slice());
            let problem = format!("{anchor:?} is {gap:.3e} m from the cable point, which starts at {point:?}{why}");
            return Err(doc.conflict(&at, problem));
        }
    }
    Ok(())
}
