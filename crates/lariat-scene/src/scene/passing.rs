//! Sheaves along a cable: the parts between them, and the wheel in the drawn shape.
//!
//! # Equation
//!
//! The drawn polyline is cut where it is nearest to the anchor of each sheave; a part ends at the anchor, or, at a wheel of radius R, where
//! the straight line to its next point touches the wheel. With the centre C, the point P before the wheel and the normal n about which the cable turns,
//!
//! ```text
//! A = C + R (cos f u + sin f n x u)     u = (P - C)/|P - C|,   cos f = R/|P - C|
//! ```
//!
//! and the mirror image of it for the point behind. Between two wheels both points are found by iteration. What is on the wheel is the
//! angle from A to B times R, in the proportion of the unstretched to the drawn length. `at` is the arc length of any point that is on
//! the wheel as drawn; what lies before or beyond is moved over the wheel.
//!
//! # Validity
//!
//! A and B are points of the body from then on: exact as long as the cable keeps its directions there, else off by R times the angle that
//! it turned, which a run [warns of](crate::Warning::WheelTurned).
//!
//! # Alternatives considered
//!
//! Points that move along the wheel: the element at the eye would have an eye that moves over its material, and a second flow.

use super::attachment::AttachmentScene;
use super::references::{body_or_world, cable, unique};
use super::sheave::SheaveTable;
use super::{CableScene, Scene};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use lariat_ancf::{RestPiece, Vector3};
use lariat_rapier::Gap;

/// Largest distance of a sheave from the cable as drawn, in m.
const GAP: f64 = 1e-3;
/// Drawn points within this many radii of the centre are on the wheel.
const ON_WHEEL: f64 = 1.5;
/// Iterations for the lines between two wheels.
const ROUNDS: usize = 100;
/// Least sine of the angle between two directions that have a plane.
const PLANE: f64 = 1e-6;
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
    let body = table.body.as_ref().ok_or_else(|| doc.missing(&at.key("body")))?;
    let body = body_or_world(doc, &at.key("body"), scene, body)?;
    let anchor = table.anchor.ok_or_else(|| doc.missing(&at.key("anchor")))?;
    let centre = body.map_or(anchor, |body| scene.bodies[body].to_world(&anchor));
    let (drawn, touches) = ((0.0, centre), [centre; 2]);
    Ok(Some((c, Passage { row, at: position, body, radius: table.radius, centre, drawn, touches, angle: 0.0 })))
}

/// The drawn points of a part.
struct Drawn(Vec<Vector3<f64>>);

impl Drawn {
    fn length(&self) -> f64 {
        self.0.windows(2).map(|p| (p[1] - p[0]).norm()).sum()
    }
}

/// Returns the place in m of each point of a polyline.
fn places(points: &[Vector3<f64>]) -> Vec<f64> {
    let mut sum = 0.0;
    let rest = points.windows(2).map(|p| {
        sum += (p[1] - p[0]).norm();
        sum
    });
    std::iter::once(0.0).chain(rest).collect()
}

/// Finds where a cable passes its sheaves, in their order.
fn place(doc: &Document<'_>, own: &CableScene, passages: &mut [Passage]) -> Result<(), Error> {
    let places = places(&own.points);
    let drawn = places.last().copied().unwrap_or(0.0);
    let mut before = 0.0;
    for k in 0..passages.len() {
        let at = KeyPath::root("sheave").item(passages[k].row);
        let passage = &mut passages[k];
        let (s, centre, radius) = (passage.at, passage.centre, passage.radius);
        let near = |i: usize| {
            let (a, b) = (own.points[i], own.points[i + 1]);
            let span = places[i + 1] - places[i];
            let share = ((centre - a).dot(&(b - a)) / (span * span)).clamp(0.0, 1.0);
            let place = (places[i] + share * span).max(before);
            let point = a + (b - a) * ((place - places[i]) / span).clamp(0.0, 1.0);
            (place, point, (point - centre).norm())
        };
        let all: Vec<_> = (0..own.points.len() - 1).filter(|&i| places[i + 1] > before).map(near).collect();
        let least = all.iter().map(|(_, _, far)| *far).fold(f64::INFINITY, f64::min);
        let wanted = s * drawn / own.length;
        let alike = all.iter().filter(|(_, _, far)| *far <= least.max(radius) + GAP);
        let nearest = alike.min_by(|a, b| (a.0 - wanted).abs().total_cmp(&(b.0 - wanted).abs()));
        let Some(&(place, point, far)) = nearest else {
            return Err(doc.conflict(&at.key("at"), "the cable as drawn ends before it"));
        };
        if far > radius * (1.0 + 1e-3) + GAP && !own.equilibrium {
            let problem = Problem::Conflict(format!("it is {far:.3e} m from the cable as drawn"));
            let accepted = "a point that the cable is drawn through, or initial = \"equilibrium\"";
            return Err(doc.error_accepting(&at.key("anchor"), problem, accepted));
        }
        passage.drawn = (place, point);
        before = place;
    }
    if passages.iter().all(|passage| passage.radius == 0.0) {
        return Ok(());
    }
    for _ in 0..ROUNDS {
        let mut moved = 0.0f64;
        for k in 0..passages.len() {
            let parts = shape(own, passages);
            let around = [parts[k].0.iter().rev().nth(1), parts[k + 1].0.get(1)].map(|p| p.copied());
            if let (passage, [Some(p), Some(q)]) = (&mut passages[k], around)
                && passage.radius > 0.0
            {
                let before = passage.touches;
                touch(doc, passage, p, q)?;
                moved += (0..2).map(|i| (passage.touches[i] - before[i]).norm()).sum::<f64>();
            }
        }
        if moved <= 1e-14 * drawn {
            break;
        }
    }
    Ok(())
}

/// Lays a cable that comes from one point and goes to another around a wheel.
fn touch(doc: &Document<'_>, passage: &mut Passage, p: Vector3<f64>, q: Vector3<f64>) -> Result<(), Error> {
    let at = KeyPath::root("sheave").item(passage.row).key("radius");
    let Passage { centre, radius, drawn: (_, drawn), .. } = *passage;
    let arms = [p - centre, q - centre];
    if let Some(near) = arms.iter().map(|arm| arm.norm()).find(|near| *near <= radius) {
        let problem = format!("a point of the cable beside it is {near:.3e} m from its centre: within the wheel");
        return Err(doc.conflict(&at, problem));
    }
    let turning = (drawn - p).cross(&(q - drawn));
    let (plane, across) = (arms[0].cross(&arms[1]), arms[0].norm() * arms[1].norm());
    let normal = if plane.norm() > PLANE * across {
        plane * plane.dot(&turning).signum()
    } else {
        turning - arms[0] * (turning.dot(&arms[0]) / arms[0].norm_squared())
    };
    if turning.norm() <= PLANE * (drawn - p).norm() * (q - drawn).norm() || normal.norm() == 0.0 {
        let problem = Problem::Conflict("the cable as drawn does not turn at the wheel: its side is not known".into());
        return Err(doc.error_accepting(&at, problem, "points that are drawn around the wheel, or radius = 0"));
    }
    let normal = normal.normalize();
    let touching = |arm: Vector3<f64>, sign: f64| {
        let (far, along) = (arm.norm(), arm.normalize());
        let cosine = radius / far;
        (along * cosine + normal.cross(&along) * (sign * (1.0 - cosine * cosine).max(0.0).sqrt())) * radius
    };
    let [a, b] = [touching(arms[0], 1.0), touching(arms[1], -1.0)];
    let angle = normal.dot(&a.cross(&b)).atan2(a.dot(&b)).rem_euclid(std::f64::consts::TAU);
    passage.angle = if angle > std::f64::consts::TAU - 1e-6 { 0.0 } else { angle };
    passage.touches = [centre + a, centre + b];
    Ok(())
}

/// Returns the drawn points of the parts of a cable: those between its sheaves that are on no wheel, and the points where it touches them.
fn shape(own: &CableScene, passages: &[Passage]) -> Vec<Drawn> {
    let (places, last) = (places(&own.points), own.points.len() - 1);
    let on_wheel = |i: usize, passage: &Passage| (own.points[i] - passage.centre).norm() <= ON_WHEEL * passage.radius;
    let mut parts = Vec::new();
    for k in 0..=passages.len() {
        let sides = [k.checked_sub(1).map(|k| &passages[k]), passages.get(k)];
        let reach = |side: Option<&Passage>, end: f64| side.map_or(end, |passage| passage.drawn.0);
        let (from, to) = (reach(sides[0], -1.0), reach(sides[1], f64::INFINITY));
        let between = (0..=last).filter(|&i| places[i] > from && places[i] < to);
        let kept = between.filter(|&i| i == 0 || i == last || !sides.iter().flatten().any(|side| on_wheel(i, side)));
        let mut points: Vec<_> = sides[0].map(|side| side.touches[1]).into_iter().collect();
        points.extend(kept.map(|i| own.points[i]));
        points.extend(sides[1].map(|side| side.touches[0]));
        points.dedup_by(|b, a| (*b - *a).norm() <= 1e-9 * own.length);
        parts.push(Drawn(points));
    }
    parts
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
    let free: f64 = bounds.iter().map(|[from, to]| to - from).sum();
    let mut positions = Vec::new();
    for (k, (Drawn(points), [from, to])) in drawn.into_iter().zip(&bounds).enumerate() {
        let share = own.elements as f64 * (to - from) / free;
        let arm = points[0] - own.points[0];
        let last = k + 1 == bounds.len();
        let reel = own.reel.clone().filter(|_| if own.reel_at_start { k == 0 } else { last });
        let part = CableScene {
            length: to - from,
            elements: (share.round() as usize).max(LEAST_ELEMENTS),
            velocity: own.velocity + own.angular_velocity.cross(&arm),
            effects: of_part(&own, *from, *to),
            reel,
            lead: if k == 0 { 0.0 } else { from - bounds[k - 1][1] },
            points,
            ..own.clone()
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

/// Returns the effects of a part of a cable, from an arc length to another.
fn of_part(own: &CableScene, from: f64, to: f64) -> lariat_ancf::Effects {
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
        gap: Gap::Refuse(GAP),
    })
}

impl Scene {
    /// Returns the cable of the file of which an entry of [`cables`](Self::cables) is a part: its position there.
    pub fn whole(&self, part: usize) -> usize {
        if part < self.parts.len() {
            return part;
        }
        self.parts.iter().position(|parts| parts.contains(&part)).unwrap_or(part)
    }

    /// Returns the unstretched length of a cable of the file in m, with what is on wheels.
    pub fn whole_length(&self, cable: usize) -> f64 {
        self.parts[cable].iter().map(|&part| self.cables[part].lead + self.cables[part].length).sum()
    }

    /// Returns the part of a cable of the file that has an arc length (m) at t = 0, and the arc length on it. What is on a wheel is at the
    /// end of the part before.
    pub fn part_at(&self, cable: usize, arc_length: f64) -> (usize, f64) {
        let mut from = 0.0;
        let mut found = (cable, arc_length);
        for (k, &part) in self.parts[cable].iter().enumerate() {
            let own = &self.cables[part];
            if k > 0 && arc_length <= from + own.lead {
                return (found.0, found.1.min(self.cables[found.0].length));
            }
            from += own.lead;
            found = (part, arc_length - from);
            if found.1 <= own.length {
                return found;
            }
            from += own.length;
        }
        (found.0, found.1.min(self.cables[found.0].length))
    }

    /// Returns the arc length in m on its cable of the file, at t = 0, of a point of a part.
    pub fn along(&self, part: usize, arc_length: f64) -> f64 {
        let parts = &self.parts[self.whole(part)];
        let before = parts.iter().take_while(|&&other| other != part).map(|&i| &self.cables[i]);
        before.map(|own| own.lead + own.length).sum::<f64>() + self.cables[part].lead + arc_length
    }

    /// Returns the part of a cable of the file that its reel is at.
    pub fn reel_part(&self, cable: usize) -> Option<usize> {
        self.parts[cable].iter().copied().find(|&part| self.cables[part].reel.is_some())
    }
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
