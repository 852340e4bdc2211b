//! What holds cables and what pulls at them: ranges and references of `[[attachment]]` and `[[load]]`, and whether anchors are
//! where the cables start.

use super::check::{find_body, find_cable, missing, number, place, unique, vector};
use super::check_body::reals;
use super::document::{Document, KeyPath};
use super::table::{AttachmentTable, LoadTable};
use super::{AttachmentScene, BodyLoadScene, LoadScene, Purpose, Scene, check_junction};
use crate::error::Error;
use crate::scene::body::BodyKind;

/// How far from its cable point an anchor may be, in m.
const ANCHOR_GAP: f64 = 1e-6;

pub(super) fn attachment(
    doc: &Document<'_>,
    scene: &Scene,
    i: usize,
    row: AttachmentTable,
) -> Result<AttachmentScene, Error> {
    let at = KeyPath::root("attachment").item(i);
    let cable = find_cable(doc, scene, &at.key("cable"), &row.cable)?;
    let place = place(doc, &at.key("at"), row.at, scene.cables[cable].length)?;
    let body = match row.body.as_str() {
        "world" => None,
        name => match scene.bodies.iter().position(|b| b.name == name) {
            None => {
                let names: Vec<&str> =
                    ["world"].into_iter().chain(scene.bodies.iter().map(|b| b.name.as_str())).collect();
                let problem = format!("no body is named {name:?}");
                return Err(doc.error_accepting(&at.key("body"), problem, names.join(" | ")));
            }
            found => found,
        },
    };
    let clamp = match row.kind.as_deref() {
        None | Some("ball") => false,
        Some("clamp") => true,
        Some(kind) => return Err(doc.error(&at.key("kind"), format!("unknown kind {kind:?}"))),
    };
    let anchor = row.anchor.map(|anchor| vector(doc, &at.key("anchor"), anchor)).transpose()?;
    let name = row.name.unwrap_or_else(|| format!("attachment-{i}"));
    unique(doc, &at.key("name"), &name, scene.attachments.iter().map(|a| a.name.as_str()))?;
    let near = 1e-9 * scene.cables[cable].length;
    if let Some(other) = scene.attachments.iter().find(|a| a.cable == cable && (a.arc_length - place).abs() <= near) {
        let problem = format!("attachment {:?} holds the cable there already", other.name);
        return Err(doc.error_accepting(&at.key("at"), problem, "one attachment at a point of a cable"));
    }
    Ok(AttachmentScene { name, cable, arc_length: place, body, anchor, clamp })
}

/// Checks a load and adds it to the scene.
pub(super) fn load(doc: &Document<'_>, scene: &mut Scene, i: usize, row: LoadTable) -> Result<(), Error> {
    let at = KeyPath::root("load").item(i);
    if row.force.is_none() && row.moment.is_none() {
        return Err(doc.error(&at, "neither force nor moment"));
    }
    let force = vector(doc, &at.key("force"), row.force.unwrap_or_default())?;
    let moment = vector(doc, &at.key("moment"), row.moment.unwrap_or_default())?;
    let ramp = number(doc, &at.key("ramp"), row.ramp.unwrap_or(0.0), |x| x >= 0.0)?;
    if let Some(name) = &row.body {
        let given = [("cable", row.cable.is_some()), ("at", row.at.is_some())];
        if let Some((key, _)) = given.iter().find(|(_, given)| *given) {
            return Err(doc.error_accepting(&at.key(key), format!("{key} is for a load on a cable"), "body and point"));
        }
        let body = find_body(doc, scene, &at.key("body"), name)?;
        if scene.bodies[body].kind != BodyKind::Dynamic {
            return Err(doc.error(&at.key("body"), format!("no force moves {name:?}, which is not dynamic")));
        }
        let point = reals(doc, &at.key("point"), row.point.unwrap_or_default())?;
        reals(doc, &at.key("force"), force.into())?;
        reals(doc, &at.key("moment"), moment.into())?;
        scene.body_loads.push(BodyLoadScene { body, point, force, moment, ramp });
        return Ok(());
    }
    if row.point.is_some() {
        return Err(doc.error_accepting(&at.key("point"), "point is for a load on a body", "cable and at"));
    }
    let Some(name) = row.cable else { return Err(missing(doc, &at.key("cable"))) };
    let cable = find_cable(doc, scene, &at.key("cable"), &name)?;
    let Some(point) = row.at else { return Err(missing(doc, &at.key("at"))) };
    let arc_length = place(doc, &at.key("at"), point, scene.cables[cable].length)?;
    scene.loads.push(LoadScene { cable, arc_length, force, moment, ramp });
    Ok(())
}

/// Builds every cable once, and compares anchors with the points they hold.
pub(super) fn start(doc: &Document<'_>, scene: &Scene, purpose: Purpose) -> Result<(), Error> {
    let mut cables = Vec::new();
    for (i, cable) in scene.cables.iter().enumerate() {
        let built = match scene.build_cable(i) {
            Ok(built) => built,
            Err(error) => {
                return Err(doc.error_accepting(
                    &KeyPath::root("cable").item(i),
                    error.to_string(),
                    "see docs/scene.md",
                ));
            }
        };
        let anywhere = cable.equilibrium || purpose == Purpose::Static;
        let checked = |a: &AttachmentScene| a.cable == i && !anywhere;
        for (k, attachment) in scene.attachments.iter().enumerate().filter(|(_, a)| checked(a)) {
            let Some(anchor) = scene.anchor(attachment) else { continue };
            let at = KeyPath::root("attachment").item(k).key("anchor");
            let point = match built.sample(attachment.arc_length) {
                Ok(sample) => sample.position,
                Err(error) => return Err(doc.error(&at, error.to_string())),
            };
            let gap = (point - anchor).norm();
            if gap > ANCHOR_GAP {
                let (anchor, point) = (anchor.as_slice(), point.as_slice());
                return Err(doc
                    .error(&at, format!("{anchor:?} is {gap:.3e} m from the cable point, which starts at {point:?}")));
            }
        }
        cables.push(built);
    }
    check_junction::start(doc, scene, &cables)
}
