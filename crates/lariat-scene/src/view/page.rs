//! The page as text: the template of `assets/view` with its data.
//!
//! Numbers of [frames](super::frame) are little-endian `f32` in base64, one frame after the other. Times and rows of probes are `f64`.

use super::cast::Cast;
use super::decimator::Decimator;
use super::frame::Frame;
use crate::run::{Summary, columns};
use crate::scene::body::BodyShape;
use crate::scene::{AttachmentScene, BodyLoadScene, Scene, Target};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use serde_json::{Value, json};

const PAGE: &str = include_str!("../../assets/view/page.html");
const STYLE: &str =
    concat!(include_str!("../../assets/uplot/uPlot.min.css"), include_str!("../../assets/view/style.css"));
/// With its licence, which must be kept.
const UPLOT: &str = concat!(
    "/*\n",
    include_str!("../../assets/uplot/LICENSE"),
    "*/\n",
    include_str!("../../assets/uplot/uPlot.iife.min.js")
);
const SCRIPT: &str = concat!(
    include_str!("../../assets/view/data.js"),
    include_str!("../../assets/view/shapes.js"),
    include_str!("../../assets/view/camera.js"),
    include_str!("../../assets/view/arrows.js"),
    include_str!("../../assets/view/stripe.js"),
    include_str!("../../assets/view/draw.js"),
    include_str!("../../assets/view/plots.js"),
    include_str!("../../assets/view/page.js"),
);

/// Returns the page of a run.
pub fn write(scene: &Scene, summary: &Summary, frames: &[Frame], probes: &[Decimator<Vec<f64>>]) -> String {
    let cast = Cast::of(scene);
    let marks = json!({
        "attachments": scene.attachments.iter().filter(|a| !at_sheave(scene, a)).map(|a| json!({
            "cable": scene.whole(a.cable), "at": on_page(scene, a.cable, a.arc_length), "world": a.body.is_none(), "clamp": a.clamp,
        })).collect::<Vec<_>>(),
        // the first node of the part behind it
        "sheaves": scene.sheaves.iter().map(|s| s.cables[1]).collect::<Vec<_>>(),
        "junctions": scene.junctions.iter().map(|j| j.points[0]).map(|(part, s)| json!({
            "cable": scene.whole(part), "at": on_page(scene, part, s),
        })).collect::<Vec<_>>(),
        "loads": loads(scene, summary.statics.is_some()),
    });
    let probes = scene.probes.iter().zip(probes).map(|(probe, recorded)| Plot {
        name: &probe.name,
        about: about(scene, probe.target),
        columns: columns(probe.target),
        rows: recorded.rows().flatten().copied().collect(),
    });
    filled(&cast, &json!(summary), &marks, frames, &probes.collect::<Vec<_>>())
}

/// A probe on a page.
pub struct Plot<'a, C = &'static [&'static str]> {
    pub name: &'a str,
    /// What it reads, in words.
    pub about: String,
    /// What a row holds; the first is the time in s.
    pub columns: C,
    /// All rows, one after the other.
    pub rows: Vec<f64>,
}

/// Returns the template with this content; `marks` are what is drawn beside cables and bodies.
pub fn filled<C: Serialize>(
    cast: &Cast,
    summary: &Value,
    marks: &Value,
    frames: &[Frame],
    probes: &[Plot<'_, C>],
) -> String {
    let mut data = json!({
        "name": cast.name,
        "summary": summary,
        "gravity": cast.gravity.as_slice(),
        "cables": cast.cables.iter().map(|c| json!({ "name": c.name, "diameter": c.diameter })).collect::<Vec<_>>(),
        "bodies": cast.bodies.iter().map(|b| json!({
            "name": b.name,
            "kind": b.kind.name(),
            "shape": shape(&b.shape),
        })).collect::<Vec<_>>(),
        "contacts": cast.touches,
        "stripes": cast.is_twisted,
        "times": base64(frames.iter().flat_map(|f| f.time.to_le_bytes())),
        "frames": base64(frames.iter().flat_map(|f| &f.numbers).flat_map(|x| x.to_le_bytes())),
        "probes": probes.iter().map(|p| json!({
            "name": p.name, "about": p.about, "columns": p.columns, "rows": base64(p.rows.iter().flat_map(|x| x.to_le_bytes())),
        })).collect::<Vec<_>>(),
    });
    for (name, mark) in marks.as_object().into_iter().flatten() {
        data[name] = mark.clone();
    }
    // no text of the scene may end the script element
    let data = data.to_string().replace('<', "\\u003c");
    // text and marks of the template alternate
    let part = |(i, text): (usize, &str)| match text {
        "TITLE" if i % 2 == 1 => escaped(&cast.name),
        "STYLE" if i % 2 == 1 => STYLE.to_string(),
        "DATA" if i % 2 == 1 => data.clone(),
        "UPLOT" if i % 2 == 1 => UPLOT.to_string(),
        "SCRIPT" if i % 2 == 1 => SCRIPT.to_string(),
        text => text.to_string(),
    };
    PAGE.split('@').enumerate().map(part).collect()
}

fn base64(bytes: impl Iterator<Item = u8>) -> String {
    STANDARD.encode(bytes.collect::<Vec<_>>())
}

pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

fn shape(shape: &BodyShape) -> Value {
    match shape {
        BodyShape::None => json!({}),
        BodyShape::Cuboid(half) => json!({ "cuboid": half.as_slice() }),
        BodyShape::Ball(radius) => json!({ "ball": radius }),
        BodyShape::Cylinder(size) => json!({ "cylinder": size }),
        BodyShape::Capsule(size) => json!({ "capsule": size }),
        BodyShape::Plane(normal) => json!({ "plane": normal.as_slice() }),
        BodyShape::Mesh(mesh) => {
            let corners = mesh.vertices.iter().flatten().flat_map(|&x| (x as f32).to_le_bytes());
            let faces = mesh.triangles.iter().flatten().flat_map(|i| i.to_le_bytes());
            json!({ "mesh": [base64(corners), base64(faces)] })
        }
    }
}

/// Returns the loads that a picture shows as arrows; in statics those on cables, in full.
fn loads(scene: &Scene, statics: bool) -> Value {
    let ramp = |ramp: f64| if statics { 0.0 } else { ramp };
    let mut loads = Vec::new();
    for load in &scene.loads {
        let (cable, l) = (scene.whole(load.cable), &load.load);
        loads.push(json!({
            "cable": cable, "at": on_page(scene, load.cable, l.arc_length), "force": l.force.as_slice(), "moment": l.moment.as_slice(),
            "ramp": ramp(l.ramp), "history": l.history,
        }));
    }
    for BodyLoadScene { body, point, load } in scene.body_loads.iter().filter(|_| !statics) {
        loads.push(json!({
            "body": body, "point": point.as_slice(), "force": load.force.as_slice(),
            "moment": load.moment.as_slice(), "ramp": load.ramp, "history": load.history,
        }));
    }
    for (c, cable) in scene.cables.iter().enumerate() {
        for load in cable.effects.line_loads.iter().flat_map(|loads| &loads.0) {
            loads.push(json!({
                "cable": scene.whole(c), "from": scene.along(c, load.from), "to": scene.along(c, load.to.min(cable.length)), "perLength": load.force.as_slice(),
            }));
        }
    }
    Value::Array(loads)
}

/// Returns the arc length of a point of a part on the page: the eye of a reel is at the end, whatever is out.
fn on_page(scene: &Scene, part: usize, arc_length: f64) -> f64 {
    let ([at_start, at_end], length) = (scene.eyes(part), scene.cables[part].length);
    match arc_length {
        s if at_end && s >= length * (1.0 - 1e-9) => 1e9,
        s if at_start && s <= length * 1e-9 => -1e9,
        s => scene.along(part, s),
    }
}

/// Returns whether an attachment holds a cable to a sheave along it.
fn at_sheave(scene: &Scene, attachment: &AttachmentScene) -> bool {
    let first = attachment.arc_length == 0.0;
    scene.sheaves.iter().any(|sheave| sheave.along && sheave.cables[usize::from(first)] == attachment.cable)
        && (first || attachment.arc_length >= scene.cables[attachment.cable].length)
}

/// Returns what a probe reads, in words.
fn about(scene: &Scene, target: Target) -> String {
    let whose = |cable: Option<usize>| cable.map_or("all".to_string(), |c| format!("cable {}", scene.cables[c].name));
    match target {
        Target::Point { cable, arc_length } => format!("cable {} at {arc_length} m", scene.cables[cable].name),
        Target::Body(i) => format!("body {}", scene.bodies[i].name),
        Target::Attachment(k) => format!("attachment {}", scene.attachments[k].name),
        Target::Torsion { cable, .. } => format!("torsion of cable {}", scene.cables[cable].name),
        Target::Reel(cable) => format!("reel of cable {}", scene.cables[cable].name),
        Target::Sheave(i) => format!("sheave {}", scene.sheaves[i].name),
        Target::Energy { cable, .. } => format!("energy of {}", whose(cable)),
        Target::Momentum(cable) => format!("momentum of {}", whose(cable)),
    }
}
