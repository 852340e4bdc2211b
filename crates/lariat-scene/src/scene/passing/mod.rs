//! Sheaves along a cable: the cable is divided into the parts between them.
//!
//! A part ends at the anchor of a sheave, or where it touches the wheel ([`wheel`]). The parts are cables of their own in
//! [`Scene::cables`], one after the other in `Scene::parts`; arc lengths of the file count along all of them (whole.rs).

mod wheel;
mod whole;

use super::attachment::AttachmentScene;
use super::elements::Fine;
use super::references::{arc_length, body_or_world, cable, unique};
use super::sheave::SheaveTable;
use super::{CableScene, Scene};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use lariat_ancf::{RestPiece, Vector3};
use lariat_rapier::Gap;
use wheel::{Drawn, place, shape};

/// Largest distance of a sheave from the cable as drawn, in m.
const GAP: f64 = 1e-3;
/// Least number of elements of a part.
const LEAST_ELEMENTS: usize = 2;

/// Where a cable passes a sheave.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// Row of the sheave.
    row: usize,
    /// Arc length as written, in m.
    at: f64,
    body: Option<usize>,
    radius: f64,
    centre: Vector3<f64>,
    /// Place on the drawn polyline in m, and the point.
    drawn: (f64, Vector3<f64>),
    /// Points where the cable reaches and leaves the wheel, in the world.
    touches: [Vector3<f64>; 2],
    /// Angle on the wheel in rad.
    angle: f64,
}

/// The sheaves along cables: by row of `[[sheave]]` the parts before and behind it, and its angle beyond that between them.
pub(super) type Along = Vec<Option<Passed>>;

/// What a cable along a sheave became.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Passed {
    /// Positions in [`Scene::cables`] of the parts before and behind it.
    pub parts: [usize; 2],
    /// Length on the wheel in m.
    pub on_wheel: f64,
    /// Angle in rad by which it is wound beyond that between its directions.
    pub turns: f64,
}

/// Divides the cables of the scene that run over sheaves along them. Their attachments at these are returned, to be added after those
/// that are written.
pub(super) fn divide(
    doc: &Document<'_>,
    scene: &mut Scene,
    rows: &[SheaveTable],
) -> Result<(Along, Vec<AttachmentScene>), Error> {
    let mut along = vec![None; rows.len()];
    let mut attachments = Vec::new();
    let mut by_cable: Vec<Vec<Passage>> = vec![Vec::new(); scene.cables.len()];
    for (row, table) in rows.iter().enumerate() {
        if let Some((c, passage)) = read(doc, scene, row, table)? {
            by_cable[c].push(passage);
        }
    }
    for (c, mut passages) in by_cable.into_iter().enumerate().filter(|(_, passages)| !passages.is_empty()) {
        if scene.cables[c].fine != Fine::Nowhere {
            let at = KeyPath::root("cable").item(c).key("elements");
            return Err(doc.conflict(&at, "a cable over sheaves along it has even elements"));
        }
        passages.sort_by(|a, b| a.at.total_cmp(&b.at));
        place(doc, &scene.cables[c], &mut passages)?;
        let wrapped = passages.iter().any(|passage| passage.radius > 0.0);
        if wrapped && !doc.contains(&KeyPath::root("cable").item(c).key("length")) {
            let own = &mut scene.cables[c];
            let (before, drawn) = (own.length, shape(own, &passages).iter().map(Drawn::length).sum::<f64>());
            own.length = drawn + passages.iter().map(|p| p.radius * p.angle).sum::<f64>();
            for load in own.effects.line_loads.iter_mut().flat_map(|loads| &mut loads.0) {
                load.to = if load.to >= before * (1.0 - 1e-12) { own.length } else { load.to };
            }
        }
        split(doc, scene, c, &passages, &mut along)?;
        for passage in &passages {
            attachments.extend(held(scene, passage, along[passage.row].map(|passed| passed.parts), &rows[passage.row]));
        }
    }
    Ok((along, attachments))
}

/// Reads the sheave in a row, if it is along a cable: the cable and where it passes.
fn read(doc: &Document<'_>, scene: &Scene, row: usize, table: &SheaveTable) -> Result<Option<(usize, Passage)>, Error> {
    let at = KeyPath::root("sheave").item(row);
    let Some(name) = &table.cable else {
        for (key, given) in [
            ("at", table.at.is_some()),
            ("body", table.body.is_some()),
            ("anchor", table.anchor.is_some()),
            ("radius", table.radius != 0.0),
        ] {
            if given {
                let problem = Problem::Conflict(format!("{key} is for a sheave along one cable"));
                return Err(doc.error_accepting(&at.key(key), problem, "cable, at, body and anchor; or from and to"));
            }
        }
        return Ok(None);
    };
    if table.to.is_some() {
        let problem = Problem::Conflict("to is for a sheave between two cables".to_string());
        return Err(doc.error_accepting(&at.key("to"), problem, "from and to; or cable, at, body and anchor"));
    }
    let c = cable(doc, &at.key("cable"), scene, name)?;
    let position = table.at.ok_or_else(|| doc.missing(&at.key("at")))?;
    let position = arc_length(doc, &at.key("at"), position, scene.cables[c].length)?;
    let body = table.body.as_ref().ok_or_else(|| doc.missing(&at.key("body")))?;
    let body = body_or_world(doc, &at.key("body"), scene, body)?;
    let anchor = table.anchor.ok_or_else(|| doc.missing(&at.key("anchor")))?;
    let centre = body.map_or(anchor, |body| scene.bodies[body].to_world(&anchor));
    let (drawn, touches) = ((0.0, centre), [centre; 2]);
    Ok(Some((c, Passage { row, at: position, body, radius: table.radius, centre, drawn, touches, angle: 0.0 })))
}

/// Divides a cable at its sheaves: the first part takes its place, the others follow all cables.
fn split(
    doc: &Document<'_>,
    scene: &mut Scene,
    c: usize,
    passages: &[Passage],
    along: &mut Along,
) -> Result<(), Error> {
    let own = scene.cables[c].clone();
    if own.reel.as_ref().and_then(|reel| reel.stock).is_some_and(|stock| stock < own.length * (1.0 - 1e-9)) {
        let at = KeyPath::root("cable").item(c).key("reel").key("stock");
        return Err(doc.conflict(&at, format!("the stock is at least the length that is out, {} m", own.length)));
    }
    let drawn = shape(&own, passages);
    let on_wheels = passages.iter().map(|p| p.radius * p.angle);
    let scale = own.length / (drawn.iter().map(Drawn::length).sum::<f64>() + on_wheels.sum::<f64>());
    // arc lengths where each part begins and ends
    let mut bounds = vec![[0.0, own.length]; drawn.len()];
    let mut reached = 0.0;
    for (k, passage) in passages.iter().enumerate() {
        reached += scale * drawn[k].length();
        let left = reached + scale * passage.radius * passage.angle;
        // an eye is at `at`, whatever rounding says
        let shift = (passage.at - left).max(0.0) + (passage.at - reached).min(0.0);
        let [on, off] = if passage.radius == 0.0 { [passage.at; 2] } else { [reached + shift, left + shift] };
        (bounds[k][1], bounds[k + 1][0]) = (on, off);
        reached = left;
    }
    for (k, [from, to]) in bounds.iter().enumerate() {
        if *to - *from <= 1e-6 * own.length {
            let passage = &passages[k.min(passages.len() - 1)];
            let problem = format!("the part of the cable beside it would be from {from:.6} to {to:.6} m");
            return Err(doc.conflict(&KeyPath::root("sheave").item(passage.row).key("at"), problem));
        }
    }
    for (passage, ends) in passages.iter().zip(bounds.windows(2)) {
        let [on, off] = [ends[0], ends[1]].map(|part| own.sections.between(part));
        if on.last() != off.first() {
            let problem = "a piece with another section begins on its wheel, and would run over it".to_string();
            return Err(doc.conflict(&KeyPath::root("sheave").item(passage.row).key("at"), problem));
        }
    }
    let free: f64 = bounds.iter().map(|[from, to]| to - from).sum();
    let mut positions = Vec::new();
    for (k, (Drawn(points), [from, to])) in drawn.into_iter().zip(&bounds).enumerate() {
        let share = own.elements as f64 * (to - from) / free;
        let part = CableScene {
            elements: (share.round() as usize).max(LEAST_ELEMENTS),
            lead: if k == 0 { 0.0 } else { from - bounds[k - 1][1] },
            ..part(&own, [*from, *to], points, [k == 0, k + 1 == bounds.len()])
        };
        if k == 0 {
            scene.cables[c] = part;
            positions.push(c);
        } else {
            positions.push(scene.cables.len());
            scene.cables.push(part);
        }
    }
    for (k, passage) in passages.iter().enumerate() {
        let parts = [positions[k], positions[k + 1]];
        let on_wheel = scene.cables[parts[1]].lead;
        let between =
            if passage.angle > std::f64::consts::PI { std::f64::consts::TAU - passage.angle } else { passage.angle };
        let turns = if passage.radius > 0.0 { passage.angle - between } else { 0.0 };
        along[passage.row] = Some(Passed { parts, on_wheel, turns });
    }
    scene.parts[c] = positions;
    Ok(())
}

/// Returns the part of a cable from an arc length to another that is drawn through some points, and is its first or last one.
pub(super) fn part(
    own: &CableScene,
    [from, to]: [f64; 2],
    points: Vec<Vector3<f64>>,
    [first, last]: [bool; 2],
) -> CableScene {
    let arm = points[0] - own.points[0];
    CableScene {
        length: to - from,
        velocity: own.velocity + own.angular_velocity.cross(&arm),
        effects: effects_of_part(own, from, to),
        sections: own.sections.between([from, to]),
        reel: own.reel.clone().filter(|_| if own.reel_at_start { first } else { last }),
        points,
        ..own.clone()
    }
}

/// Returns the effects of a part of a cable, from an arc length to another.
fn effects_of_part(own: &CableScene, from: f64, to: f64) -> lariat_ancf::Effects {
    let mut effects = own.effects.clone();
    if let Some(loads) = &mut effects.line_loads {
        loads.0.retain(|load| load.from < to && load.to > from);
        for load in &mut loads.0 {
            (load.from, load.to) = ((load.from - from).max(0.0), load.to.min(to) - from);
        }
        if loads.0.is_empty() {
            effects.line_loads = None;
        }
    }
    if let Some(shape) = &mut effects.rest_shape {
        let (stretch, curvature) = shape.at(from);
        let later = shape.pieces.iter().filter(|piece| piece.from > from && piece.from < to);
        let later = later.map(|piece| RestPiece { from: piece.from - from, ..*piece });
        shape.pieces = std::iter::once(RestPiece { from: 0.0, stretch, curvature }).chain(later).collect();
    }
    effects
}

/// Returns the attachments of both parts beside a sheave to its body.
fn held(
    scene: &Scene,
    passage: &Passage,
    parts: Option<[usize; 2]>,
    row: &SheaveTable,
) -> impl Iterator<Item = AttachmentScene> {
    let name = row.name.clone().unwrap_or_else(|| format!("sheave-{}", passage.row));
    let (body, touches) = (passage.body, passage.touches);
    let local = touches.map(|point| body.map_or(point, |body| scene.bodies[body].to_body(&point)));
    let ends = parts.map_or(Vec::new(), |[a, b]| vec![(a, scene.cables[a].length, "from"), (b, 0.0, "to")]);
    ends.into_iter().zip(local).map(move |((cable, arc_length, side), anchor)| AttachmentScene {
        name: format!("{name}, {side}"),
        cable,
        arc_length,
        body,
        anchor: Some(anchor),
        clamp: false,
        direction: None,
        gap: Gap::Refuse(GAP),
        other_side_of: None,
    })
}

/// Checks that a name is not that of an attachment of a sheave.
pub(super) fn add(doc: &Document<'_>, scene: &mut Scene, attachments: Vec<AttachmentScene>) -> Result<(), Error> {
    for attachment in attachments {
        let root = KeyPath::root("sheave");
        unique(doc, &root, &attachment.name, scene.attachments.iter().map(|a| a.name.as_str()))?;
        scene.attachments.push(attachment);
    }
    Ok(())
}
