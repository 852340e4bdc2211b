//! Ranges and references of a scene: from the tables as written to a [`Scene`].

use super::document::{Document, KeyPath};
use super::table::{AttachmentTable, LoadTable, ProbeTable, SceneTable};
use super::value::At;
use super::{AttachmentScene, CableScene, LoadScene, ProbeScene, Purpose, Scene, Target, arc_length, check_cable};
use crate::error::Error;
use lariat_ancf::Vector3;

/// Steps and samples of a run beyond which a scene is taken for a slip of the pen.
const MOST: f64 = 1e8;
/// How far from its cable point an anchor may be, in m.
const ANCHOR_GAP: f64 = 1e-6;

/// Checks a scene; `fallback` names one that has no name.
pub(super) fn scene(doc: &Document<'_>, table: SceneTable, fallback: &str, purpose: Purpose) -> Result<Scene, Error> {
    if let Some(engine) = table.engine.as_deref() {
        match engine {
            "none" => {}
            "rapier" => return Err(doc.not_built(&KeyPath::root("engine"), "engine = \"rapier\"")),
            _ => return Err(doc.error(&KeyPath::root("engine"), format!("unknown engine {engine:?}"))),
        }
    }
    if !table.body.is_empty() {
        return Err(doc.not_built(&KeyPath::root("body").item(0), "a rigid body (engine = \"rapier\")"));
    }
    if table.solver_iterations.is_some() {
        return Err(doc.not_built(&KeyPath::root("solver_iterations"), "a setting of engine = \"rapier\""));
    }
    let duration = match (table.duration, purpose) {
        (Some(duration), _) => number(doc, &KeyPath::root("duration"), duration, |x| x > 0.0)?,
        (None, Purpose::Static) => 0.0,
        (None, Purpose::Run) => return Err(missing(doc, &KeyPath::root("duration"))),
    };
    let at_dt = KeyPath::root("dt");
    let dt = number(doc, &at_dt, table.dt.unwrap_or(1.0 / 60.0), |x| x > 0.0)?;
    if duration / dt > MOST {
        return Err(doc.error(&at_dt, format!("{dt} s makes {:.3e} steps", duration / dt)));
    }
    let gravity = match table.gravity {
        Some(gravity) => vector(doc, &KeyPath::root("gravity"), gravity)?,
        None => Vector3::new(0.0, -9.81, 0.0),
    };
    if table.cable.is_empty() {
        return Err(doc.error(&KeyPath::root("cable"), "no cable"));
    }
    let mut cables = Vec::new();
    for (i, cable) in table.cable.into_iter().enumerate() {
        let at = KeyPath::root("cable").item(i);
        let cable = check_cable::cable(doc, &at, cable)?;
        unique(doc, &at.key("name"), &cable.name, cables.iter().map(|c: &CableScene| c.name.as_str()))?;
        cables.push(cable);
    }
    let mut scene = Scene {
        name: table.name.unwrap_or_else(|| fallback.to_string()),
        duration,
        dt,
        gravity,
        cables,
        attachments: Vec::new(),
        loads: Vec::new(),
        probes: Vec::new(),
    };
    for (i, row) in table.attachment.into_iter().enumerate() {
        let row = attachment(doc, &scene, i, row)?;
        scene.attachments.push(row);
    }
    for (i, row) in table.load.into_iter().enumerate() {
        let row = load(doc, &scene, i, row)?;
        scene.loads.push(row);
    }
    for (i, row) in table.probe.into_iter().enumerate() {
        let row = probe(doc, &scene, i, row)?;
        scene.probes.push(row);
    }
    start(doc, &scene, purpose)?;
    Ok(scene)
}

fn attachment(doc: &Document<'_>, scene: &Scene, i: usize, row: AttachmentTable) -> Result<AttachmentScene, Error> {
    let at = KeyPath::root("attachment").item(i);
    let cable = find_cable(doc, scene, &at.key("cable"), &row.cable)?;
    let place = place(doc, &at.key("at"), row.at, scene.cables[cable].length)?;
    if row.body != "world" {
        return Err(doc.error(&at.key("body"), format!("no body is named {:?}", row.body)));
    }
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
    Ok(AttachmentScene { name, cable, arc_length: place, anchor, clamp })
}

fn load(doc: &Document<'_>, scene: &Scene, i: usize, row: LoadTable) -> Result<LoadScene, Error> {
    let at = KeyPath::root("load").item(i);
    if row.body.is_some() {
        return Err(doc.not_built(&at.key("body"), "a load on a body (engine = \"rapier\")"));
    }
    if row.point.is_some() {
        return Err(doc.error_accepting(&at.key("point"), "point is for a load on a body", "cable and at"));
    }
    let Some(name) = row.cable else { return Err(missing(doc, &at.key("cable"))) };
    let cable = find_cable(doc, scene, &at.key("cable"), &name)?;
    let Some(point) = row.at else { return Err(missing(doc, &at.key("at"))) };
    let arc_length = place(doc, &at.key("at"), point, scene.cables[cable].length)?;
    if row.force.is_none() && row.moment.is_none() {
        return Err(doc.error(&at, "neither force nor moment"));
    }
    let force = vector(doc, &at.key("force"), row.force.unwrap_or_default())?;
    let moment = vector(doc, &at.key("moment"), row.moment.unwrap_or_default())?;
    let ramp = number(doc, &at.key("ramp"), row.ramp.unwrap_or(0.0), |x| x >= 0.0)?;
    Ok(LoadScene { cable, arc_length, force, moment, ramp })
}

fn probe(doc: &Document<'_>, scene: &Scene, i: usize, row: ProbeTable) -> Result<ProbeScene, Error> {
    let at = KeyPath::root("probe").item(i);
    let forbidden = |c: char| c.is_control() || r#"/\:*?"<>|"#.contains(c);
    if row.name.is_empty() || row.name.starts_with('.') || row.name.contains(forbidden) {
        return Err(doc.error(&at.key("name"), format!("{:?} cannot name a file", row.name)));
    }
    // file systems that ignore case would write two probes into one file
    let lower = |name: &str| name.to_lowercase();
    if scene.probes.iter().any(|p| lower(&p.name) == lower(&row.name)) {
        return Err(doc.error(&at.key("name"), format!("{:?} is taken", row.name)));
    }
    if let Some(every) = row.every {
        number(doc, &at.key("every"), every, |x| x > 0.0)?;
        if scene.duration / every > MOST {
            let problem = format!("{every} s makes {:.3e} samples", scene.duration / every);
            return Err(doc.error(&at.key("every"), problem));
        }
    }
    let given = [&row.cable, &row.body, &row.attachment, &row.energy, &row.momentum];
    let count = given.iter().filter(|key| key.is_some()).count();
    if count != 1 {
        return Err(doc.error(&at, format!("{count} things to read")));
    }
    if row.at.is_some() && row.cable.is_none() {
        return Err(doc.error_accepting(&at.key("at"), "at is for a probe of a cable", "at beside cable"));
    }
    if row.body.is_some() {
        return Err(doc.not_built(&at.key("body"), "a probe of a body (engine = \"rapier\")"));
    }
    let some_or_all = |key: &str, name: &str| match name {
        "all" => Ok(None),
        _ => find_cable(doc, scene, &at.key(key), name).map(Some),
    };
    let target = if let Some(name) = &row.cable {
        let cable = find_cable(doc, scene, &at.key("cable"), name)?;
        let Some(point) = row.at else { return Err(missing(doc, &at.key("at"))) };
        Target::Point { cable, arc_length: place(doc, &at.key("at"), point, scene.cables[cable].length)? }
    } else if let Some(name) = &row.attachment {
        let names: Vec<&str> = scene.attachments.iter().map(|a| a.name.as_str()).collect();
        let Some(k) = names.iter().position(|n| n == name) else {
            let problem = format!("no attachment is named {name:?}");
            return Err(doc.error_accepting(&at.key("attachment"), problem, list(&names)));
        };
        Target::Attachment(k)
    } else if let Some(name) = &row.energy {
        Target::Energy(some_or_all("energy", name)?)
    } else {
        Target::Momentum(some_or_all("momentum", row.momentum.as_deref().unwrap_or("all"))?)
    };
    Ok(ProbeScene { name: row.name, every: row.every, target })
}

/// Builds every cable once, and compares anchors with the points they hold.
fn start(doc: &Document<'_>, scene: &Scene, purpose: Purpose) -> Result<(), Error> {
    for (i, cable) in scene.cables.iter().enumerate() {
        let built = match scene.build_cable(i) {
            Ok(built) => built,
            Err(error) => {
                return Err(doc.error_accepting(&KeyPath::root("cable").item(i), error.to_string(), "see SCENE.md"));
            }
        };
        if cable.equilibrium || purpose == Purpose::Static {
            continue;
        }
        for (k, attachment) in scene.attachments.iter().enumerate().filter(|(_, a)| a.cable == i) {
            let Some(anchor) = attachment.anchor else { continue };
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
    }
    Ok(())
}

fn find_cable(doc: &Document<'_>, scene: &Scene, at: &KeyPath, name: &str) -> Result<usize, Error> {
    let names: Vec<&str> = scene.cables.iter().map(|c| c.name.as_str()).collect();
    let missing = || doc.error_accepting(at, format!("no cable is named {name:?}"), list(&names));
    names.iter().position(|n| *n == name).ok_or_else(missing)
}

fn list(names: &[&str]) -> String {
    if names.is_empty() { "none is in this scene".to_string() } else { names.join(" | ") }
}

fn place(doc: &Document<'_>, at: &KeyPath, point: At, length: f64) -> Result<f64, Error> {
    let s = arc_length(point, length);
    if s >= 0.0 && s <= length {
        Ok(s)
    } else {
        Err(doc.error(at, format!("{s} m is not on the cable, which is {length} m long")))
    }
}

pub(super) fn unique<'n>(
    doc: &Document<'_>,
    at: &KeyPath,
    name: &str,
    mut others: impl Iterator<Item = &'n str>,
) -> Result<(), Error> {
    match (name.is_empty(), others.any(|other| other == name)) {
        (true, _) => Err(doc.error(at, "the name is empty")),
        (_, true) => Err(doc.error(at, format!("{name:?} is taken"))),
        _ => Ok(()),
    }
}

pub(super) fn missing(doc: &Document<'_>, at: &KeyPath) -> Error {
    doc.error(at, "missing key")
}

pub(super) fn number(doc: &Document<'_>, at: &KeyPath, x: f64, ok: impl Fn(f64) -> bool) -> Result<f64, Error> {
    if x.is_finite() && ok(x) { Ok(x) } else { Err(doc.error(at, format!("{x} is out of range"))) }
}

pub(super) fn vector(doc: &Document<'_>, at: &KeyPath, x: [f64; 3]) -> Result<Vector3<f64>, Error> {
    if x.iter().all(|x| x.is_finite()) {
        Ok(Vector3::from(x))
    } else {
        Err(doc.error(at, format!("{x:?} is not finite")))
    }
}
