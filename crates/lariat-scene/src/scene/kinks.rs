//! `kinks` of a cable: points at which its slope is free on both sides.
//!
//! # Equation
//!
//! A cable bends within `sqrt(EI/T)` of a point load, a junction or a ball attachment, and without stiffness it has a corner there. The
//! slope of an element is continuous at its nodes, and rounds a corner over an element on each side: positions converge with the first
//! order. At a kink the cable is divided into two parts that share one position, as two cables at a junction do, and nothing else: the
//! order is that of a smooth cable. It stays one cable by name, with arc lengths along all of it.
//!
//! # Validity
//!
//! A kink is a hinge: no moment goes through it. Of a stiff cable it is off by that moment, until the mesh resolves `sqrt(EI/T)`; there
//! leave it out. Refused are kinks with torsion, whose torque would not go on; at sheaves, over which material runs; at clamps, which hold
//! both directions; of cables that touch themselves, whose parts are others to contact; and where the cable is to be cut.
//!
//! # Alternatives considered
//!
//! A node with one position and two slopes: docs/decisions/elements.md, carried.rs.

use super::Scene;
use super::attachment::{AttachmentKind, AttachmentScene, AttachmentTable};
use super::cable::CableScene;
use super::elements::{Fine, Grading};
use super::junction::{JunctionScene, JunctionTable};
use super::load::LoadTable;
use super::passing::part;
use super::references::{arc_length, unique};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use lariat_ancf::Vector3;

/// A kink: the parts of a cable before and behind it, positions in [`Scene::cables`].
pub type Kink = [usize; 2];

/// What can turn a cable at a point, as a scene writes it.
pub(super) struct Turning<'a> {
    pub loads: &'a [LoadTable],
    pub junctions: &'a [JunctionTable],
    pub attachments: &'a [AttachmentTable],
}

/// Finds the kinks of the cables without bending stiffness: all points between the ends where a load, a junction or a ball attachment can turn
/// them. None where a kink is refused, or a reel moves material through such points.
pub(super) fn find(doc: &Document<'_>, scene: &mut Scene, turning: &Turning<'_>) -> Result<(), Error> {
    for c in 0..scene.parts.len() {
        let cable = &mut scene.cables[c];
        let limp = cable.reel.is_none() && cable.sections.iter().all(|(_, own)| own.bending_stiffness == 0.0);
        let touches_itself = cable.effects.contact.is_some_and(|contact| contact.itself);
        if !limp || scene.parts[c].len() > 1 || cable.effects.torsion.is_some() || touches_itself || cable.equilibrium {
            continue;
        }
        let (name, length) = (&cable.name, cable.length);
        let at = |key: &str, row: usize, at: &str| KeyPath::root(key).item(row).key(at);
        let mut points = Vec::new();
        for (row, load) in turning.loads.iter().enumerate() {
            let is_own = load.cable.as_ref() == Some(name) && load.force.is_some_and(|force| force != Vector3::zeros());
            points.extend(load.at.filter(|_| is_own).map(|point| (at("load", row, "at"), point)));
        }
        for (row, junction) in turning.junctions.iter().enumerate() {
            let ends = [(&junction.cable, "at", junction.at), (&junction.other, "other_at", junction.other_at)];
            let own = ends.into_iter().filter(|(cable, ..)| *cable == name);
            points.extend(own.map(|(_, key, point)| (at("junction", row, key), point)));
        }
        for (row, attachment) in turning.attachments.iter().enumerate() {
            let is_own = attachment.cable == *name && attachment.kind == AttachmentKind::Ball;
            points.extend(is_own.then(|| (at("attachment", row, "at"), attachment.at)));
        }
        let near = 1e-6 * length;
        let given = core::mem::take(&mut cable.kinks);
        let found = points.iter().map(|(key, point)| arc_length(doc, key, *point, length));
        let mut kinks = given.into_iter().map(Ok).chain(found).collect::<Result<Vec<_>, _>>()?;
        let cut = cable.breaking.cut.map(|(_, s)| s);
        kinks.retain(|s| *s > near && *s < length - near && cut.is_none_or(|cut| (s - cut).abs() > near));
        kinks.sort_by(f64::total_cmp);
        kinks.dedup_by(|a, b| *a - *b <= near);
        cable.kinks = kinks;
    }
    Ok(())
}

/// Divides the cables of the scene at their kinks.
pub(super) fn divide(doc: &Document<'_>, scene: &mut Scene) -> Result<(), Error> {
    for c in 0..scene.parts.len() {
        let mut kinks = std::mem::take(&mut scene.cables[c].kinks);
        if kinks.is_empty() {
            continue;
        }
        kinks.sort_by(f64::total_cmp);
        check(doc, scene, c, &kinks)?;
        split(scene, c, &kinks);
    }
    Ok(())
}

/// Refuses what has no meaning at a kink.
fn check(doc: &Document<'_>, scene: &Scene, c: usize, kinks: &[f64]) -> Result<(), Error> {
    let (own, row) = (&scene.cables[c], KeyPath::root("cable").item(c));
    let slack = 1e-6 * own.length;
    let refused = |key: &str, problem: String, accepted: &str| {
        Err(doc.error_accepting(&row.key(key), Problem::Conflict(problem), accepted))
    };
    if let Some(s) = kinks.iter().find(|s| **s <= slack || **s >= own.length - slack) {
        return refused(
            "kinks",
            format!("{s} m is an end of the cable, where its slope is free"),
            "points between the ends",
        );
    }
    if let Some(near) = kinks.windows(2).find(|ends| ends[1] - ends[0] <= slack) {
        return refused("kinks", format!("two kinks at {} m", near[0]), "one kink at a point");
    }
    if scene.parts[c].len() > 1 {
        let problem = "a sheave divides this cable already, and material runs over it".to_string();
        return refused("kinks", problem, "kinks of a cable without sheaves along it");
    }
    if own.effects.torsion.is_some() {
        return refused("torsion", "no torque goes through a kink".to_string(), "torsion without kinks");
    }
    if own.effects.contact.is_some_and(|contact| contact.itself) {
        let problem = "the parts of a cable with kinks are other cables to contact".to_string();
        return refused("contact", problem, "contact of a cable with itself without kinks");
    }
    if own.equilibrium {
        let problem = "the parts between kinks find one equilibrium together".to_string();
        return refused("initial", problem, "initial = \"equilibrium\" of the scene, above all tables");
    }
    let cut = own.breaking.cut.map(|(_, s)| s);
    if let Some(s) = cut.filter(|cut| kinks.iter().any(|s| (s - cut).abs() <= slack)) {
        return refused("break", format!("{s} m is a kink, where the cable is two parts already"), "a cut elsewhere");
    }
    Ok(())
}

/// Divides a cable: the first part takes its place, the others follow all cables.
fn split(scene: &mut Scene, c: usize, kinks: &[f64]) {
    let own = scene.cables[c].clone();
    let ends: Vec<f64> = std::iter::once(0.0).chain(kinks.iter().copied()).chain([own.length]).collect();
    let last = ends.len() - 2;
    let mut before = c;
    for (k, between) in ends.windows(2).enumerate() {
        let [from, to] = [between[0], between[1]];
        let part = CableScene {
            elements: ((own.elements as f64 * (to - from) / own.length).round() as usize).max(1),
            fine: fine(&own, [from, to]),
            ..part(&own, [from, to], drawn(&own, [from, to]), [k == 0, k == last])
        };
        if k == 0 {
            scene.cables[c] = part;
            continue;
        }
        let behind = scene.cables.len();
        scene.cables.push(part);
        scene.parts[c].push(behind);
        scene.kinks.push([before, behind]);
        before = behind;
    }
}

/// Returns the drawn points from an arc length to another, in m.
fn drawn(own: &CableScene, [from, to]: [f64; 2]) -> Vec<Vector3<f64>> {
    let all: f64 = own.points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    let [from, to] = [from, to].map(|s| s / own.length * all);
    let near = 1e-9 * all;
    let (mut points, mut place) = (Vec::new(), 0.0);
    for ends in own.points.windows(2) {
        let span = (ends[1] - ends[0]).norm();
        let point = |s: f64| ends[0] + (ends[1] - ends[0]) * ((s - place) / span).clamp(0.0, 1.0);
        if points.is_empty() && from < place + span - near {
            points.push(point(from));
        }
        if !points.is_empty() {
            let inner = place + span < to - near;
            points.push(if inner { ends[1] } else { point(to) });
            if !inner {
                break;
            }
        }
        place += span;
    }
    points
}

/// Returns the mesh of a part: graded if some of the points are on it and its elements are not as short already.
fn fine(own: &CableScene, [from, to]: [f64; 2]) -> Fine {
    let Fine::At(grading) = &own.fine else { return own.fine.clone() };
    let on_part = grading.points.iter().filter(|s| (from..=to).contains(*s)).map(|s| s - from);
    let points: Vec<f64> = on_part.collect();
    let graded = !points.is_empty() && grading.finest * (own.elements as f64) < own.length;
    if graded { Fine::At(Grading { finest: grading.finest, points }) } else { Fine::Nowhere }
}

/// Joins the parts at each kink: by an attachment of both where one holds the cable, by a junction elsewhere.
pub(super) fn join(doc: &Document<'_>, scene: &mut Scene) -> Result<(), Error> {
    let mut counts = vec![0; scene.parts.len()];
    for [before, behind] in scene.kinks.clone() {
        let (c, length) = (scene.whole(before), scene.cables[before].length);
        let k = counts[c];
        counts[c] += 1;
        let row = KeyPath::root("cable").item(c).key("kinks").item(k);
        let at_kink = |a: &AttachmentScene| a.cable == before && a.arc_length >= length * (1.0 - 1e-9);
        let holds = scene.attachments.iter().position(at_kink);
        let name = format!("{}, kink {k}", scene.cables[c].name);
        let Some(holds) = holds else {
            unique(doc, &row, &name, scene.junctions.iter().map(|j| j.name.as_str()))?;
            scene.junctions.push(JunctionScene { name, points: [(before, length), (behind, 0.0)] });
            continue;
        };
        let held = scene.attachments[holds].clone();
        if held.clamp {
            let problem = Problem::Conflict(format!("the clamp {:?} holds both directions there", held.name));
            return Err(doc.error_accepting(&row, problem, "a kink where no clamp is"));
        }
        let name = format!("{}, behind", held.name);
        unique(doc, &row, &name, scene.attachments.iter().map(|a| a.name.as_str()))?;
        scene.attachments.push(AttachmentScene {
            name,
            cable: behind,
            arc_length: 0.0,
            other_side_of: Some(holds),
            ..held
        });
    }
    Ok(())
}
