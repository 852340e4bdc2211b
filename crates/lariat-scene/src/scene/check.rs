//! Ranges and references of a scene: from the tables as written to a [`Scene`].

use super::body::BodyScene;
use super::document::{Document, KeyPath};
use super::table::{ProbeTable, SceneTable};
use super::value::At;
use super::{
    CableScene, Engine, ProbeScene, Purpose, Scene, Target, arc_length, check_body, check_cable, check_hold,
    check_joint, check_junction,
};
use crate::error::Error;
use lariat_ancf::{STANDARD_GRAVITY, Vector3};
use std::path::Path;

/// Steps and samples of a run beyond which a scene is taken for a slip of the pen.
const MOST: f64 = 1e8;

/// Checks a scene; `fallback` names one that has no name, and files are named from `folder`.
pub(super) fn scene(
    doc: &Document<'_>,
    table: SceneTable,
    fallback: &str,
    folder: &Path,
    purpose: Purpose,
) -> Result<Scene, Error> {
    let engine = engine(doc, &table)?;
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
    // Rapier's steps are in single precision
    if engine == Engine::Rapier && f64::from(dt as f32) < f64::from(f32::MIN_POSITIVE) * 1e3 {
        return Err(doc.error(&at_dt, format!("{dt} s is too short for Rapier")));
    }
    let gravity = match table.gravity {
        Some(gravity) if engine == Engine::Rapier => check_body::reals(doc, &KeyPath::root("gravity"), gravity)?,
        Some(gravity) => vector(doc, &KeyPath::root("gravity"), gravity)?,
        None => STANDARD_GRAVITY,
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
    let mut bodies = Vec::new();
    for (i, body) in table.body.into_iter().enumerate() {
        let at = KeyPath::root("body").item(i);
        let body = check_body::body(doc, &at, body, folder)?;
        unique(doc, &at.key("name"), &body.name, bodies.iter().map(|b: &BodyScene| b.name.as_str()))?;
        bodies.push(body);
    }
    let mut scene = Scene {
        engine,
        solver_iterations: table.solver_iterations.map(|n| n as usize),
        bodies,
        body_loads: Vec::new(),
        name: table.name.unwrap_or_else(|| fallback.to_string()),
        duration,
        dt,
        gravity,
        cables,
        attachments: Vec::new(),
        joints: Vec::new(),
        junctions: Vec::new(),
        loads: Vec::new(),
        probes: Vec::new(),
    };
    for (i, row) in table.joint.into_iter().enumerate() {
        let row = check_joint::joint(doc, &scene, i, row)?;
        scene.joints.push(row);
    }
    for (i, row) in table.attachment.into_iter().enumerate() {
        let row = check_hold::attachment(doc, &scene, i, row)?;
        scene.attachments.push(row);
    }
    for (i, row) in table.junction.into_iter().enumerate() {
        let row = check_junction::junction(doc, &scene, i, row)?;
        scene.junctions.push(row);
    }
    for (i, row) in table.load.into_iter().enumerate() {
        check_hold::load(doc, &mut scene, i, row)?;
    }
    for (i, row) in table.probe.into_iter().enumerate() {
        let row = probe(doc, &scene, i, row)?;
        scene.probes.push(row);
    }
    check_hold::start(doc, &scene, purpose)?;
    Ok(scene)
}

/// Without `engine`, bodies call for Rapier.
fn engine(doc: &Document<'_>, table: &SceneTable) -> Result<Engine, Error> {
    let at = KeyPath::root("engine");
    let engine = match table.engine.as_deref() {
        None if table.body.is_empty() && table.junction.is_empty() => Engine::None,
        None | Some("rapier") => Engine::Rapier,
        Some("none") => Engine::None,
        Some(other) => return Err(doc.error(&at, format!("unknown engine {other:?}"))),
    };
    if engine == Engine::None {
        if !table.body.is_empty() {
            return Err(doc.error(&KeyPath::root("body").item(0), "engine = \"none\" has no bodies"));
        }
        if !table.junction.is_empty() {
            return Err(doc.error(&KeyPath::root("junction").item(0), "engine = \"none\" has no junctions"));
        }
        if table.solver_iterations.is_some() {
            return Err(doc.error(&KeyPath::root("solver_iterations"), "a setting of engine = \"rapier\""));
        }
    }
    if table.solver_iterations == Some(0) {
        return Err(doc.error(&KeyPath::root("solver_iterations"), "0 iterations"));
    }
    Ok(engine)
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
    let some_or_all = |key: &str, name: &str| match name {
        "all" => Ok(None),
        _ => find_cable(doc, scene, &at.key(key), name).map(Some),
    };
    let target = if let Some(name) = &row.cable {
        let cable = find_cable(doc, scene, &at.key("cable"), name)?;
        let Some(point) = row.at else { return Err(missing(doc, &at.key("at"))) };
        Target::Point { cable, arc_length: place(doc, &at.key("at"), point, scene.cables[cable].length)? }
    } else if let Some(name) = &row.body {
        Target::Body(find_body(doc, scene, &at.key("body"), name)?)
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

pub(super) fn find_cable(doc: &Document<'_>, scene: &Scene, at: &KeyPath, name: &str) -> Result<usize, Error> {
    let names: Vec<&str> = scene.cables.iter().map(|c| c.name.as_str()).collect();
    let missing = || doc.error_accepting(at, format!("no cable is named {name:?}"), list(&names));
    names.iter().position(|n| *n == name).ok_or_else(missing)
}

pub(super) fn find_body(doc: &Document<'_>, scene: &Scene, at: &KeyPath, name: &str) -> Result<usize, Error> {
    let names: Vec<&str> = scene.bodies.iter().map(|b| b.name.as_str()).collect();
    let missing = || doc.error_accepting(at, format!("no body is named {name:?}"), list(&names));
    names.iter().position(|n| *n == name).ok_or_else(missing)
}

fn list(names: &[&str]) -> String {
    if names.is_empty() { "none is in this scene".to_string() } else { names.join(" | ") }
}

pub(super) fn place(doc: &Document<'_>, at: &KeyPath, point: At, length: f64) -> Result<f64, Error> {
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
