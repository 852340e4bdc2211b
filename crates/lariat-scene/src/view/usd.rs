//! The motion as OpenUSD (`.usda`, text), for usdview, Blender, Isaac Sim and others.
//!
//! A cable is a `BasisCurves` prim of cubic Bezier pieces, one per element: those are the cubics of the elements. After it broke it has
//! a curve for each of its parts. A body is an `Xform` with its
//! shape. Positions have a time sample per frame of the page; a second has [`RATE`] time codes.
//!
//! The prims of cables carry their stiffness as custom attributes `lariat:*`: EA in N, EI in N m^2, mass per length in kg/m, unstretched
//! length in m.

use super::frame::Frame;
use crate::scene::body::BodyShape;
use crate::scene::{CableScene, Scene};
use std::fmt::Write as _;

/// Time codes per second.
const RATE: f64 = 1000.0;
/// Width of a cable without a diameter, in m.
const WIDTH: f64 = 0.01;

/// Returns the file.
pub fn write(scene: &Scene, frames: &[Frame]) -> String {
    let up = if scene.gravity.z.abs() > scene.gravity.y.abs() { "Z" } else { "Y" };
    let end = frames.last().map_or(0.0, |frame| frame.time * RATE);
    let mut text = format!(
        "#usda 1.0\n(\n    defaultPrim = \"World\"\n    metersPerUnit = 1\n    kilogramsPerUnit = 1\n    upAxis = \"{up}\"\n    \
         startTimeCode = 0\n    endTimeCode = {end}\n    timeCodesPerSecond = {RATE}\n)\n\ndef Xform \"World\"\n{{\n"
    );
    let mut names = Vec::new();
    let (pieces, mut at): (Vec<_>, Vec<_>) = frames.iter().map(|frame| frame.places(scene.parts.len())).unzip();
    for (i, cable) in scene.cables[..scene.parts.len()].iter().enumerate() {
        let name = unique(&cable.name, &mut names);
        curve(&mut text, &name, (cable, scene.whole_length(i)), frames.iter().zip(pieces.iter().map(|of| &of[i][..])));
    }
    for body in &scene.bodies {
        let name = unique(&body.name, &mut names);
        xform(&mut text, &name, &body.shape, frames, &mut at);
    }
    text.push_str("}\n");
    text
}

/// Returns a name as USD takes it, and not given before.
fn unique(name: &str, names: &mut Vec<String>) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let mut plain: String = name.chars().map(allowed).collect();
    if !plain.starts_with(|c: char| c.is_ascii_alphabetic()) {
        plain.insert(0, '_');
    }
    while names.contains(&plain) {
        plain.push('_');
    }
    names.push(plain.clone());
    plain
}

/// Writes the vertices of the Bezier pieces of a cable, or of a piece of it, in a frame; returns their number.
fn vertices(text: &mut String, frame: &Frame, at: usize) -> usize {
    let points = frame.vertices(at);
    for p in &points {
        let _ = write!(text, "{}({}, {}, {})", if text.ends_with('[') { "" } else { ", " }, p[0], p[1], p[2]);
    }
    points.len()
}

/// Writes a cable of this length (m) from its frames, each with the places of its pieces.
fn curve<'a>(
    text: &mut String,
    name: &str,
    (cable, length): (&CableScene, f64),
    frames: impl Iterator<Item = (&'a Frame, &'a [usize])>,
) {
    let mut samples = String::new();
    let mut counts: Vec<(f64, String)> = Vec::new();
    for (frame, pieces) in frames {
        let time = frame.time * RATE;
        let _ = write!(samples, "            {time}: [");
        let of_pieces = pieces.iter().map(|&at| vertices(&mut samples, frame, at).to_string());
        counts.push((time, of_pieces.collect::<Vec<_>>().join(", ")));
        samples.push_str("],\n");
    }
    counts.dedup_by(|(_, later), (_, earlier)| later == earlier);
    let counts = match &counts[..] {
        [(_, count)] => format!(" = [{count}]"),
        several => {
            let lines = several.iter().map(|(time, count)| format!("            {time}: [{count}],\n"));
            format!(".timeSamples = {{\n{}        }}", lines.collect::<String>())
        }
    };
    let width = cable.sections.first().diameter.unwrap_or(WIDTH);
    let [axial, bending, mass] = [
        cable.mean_of(|section| section.axial_stiffness),
        cable.mean_of(|section| section.bending_stiffness),
        cable.mean_of(|section| section.mass_per_length),
    ];
    let _ = write!(
        text,
        "    def BasisCurves \"{name}\"\n    {{\n        uniform token type = \"cubic\"\n        uniform token basis = \"bezier\"\n        \
         uniform token wrap = \"nonperiodic\"\n        int[] curveVertexCounts{counts}\n        float[] widths = [{width}] (\n            \
         interpolation = \"constant\"\n        )\n        point3f[] points.timeSamples = {{\n{samples}        }}\n        \
         custom double lariat:axialStiffness = {}\n        custom double lariat:bendingStiffness = {}\n        \
         custom double lariat:massPerLength = {}\n        custom double lariat:length = {}\n    }}\n",
        axial, bending, mass, length
    );
}

fn xform(text: &mut String, name: &str, shape: &BodyShape, frames: &[Frame], at: &mut [usize]) {
    let (mut places, mut turns) = (String::new(), String::new());
    for (frame, at) in frames.iter().zip(at) {
        let x = &frame.numbers[*at..*at + 7];
        let time = frame.time * RATE;
        let _ = writeln!(places, "            {time}: ({}, {}, {}),", x[0], x[1], x[2]);
        let _ = writeln!(turns, "            {time}: ({}, {}, {}, {}),", x[6], x[3], x[4], x[5]);
        *at += 7;
    }
    let _ = write!(
        text,
        "    def Xform \"{name}\"\n    {{\n        double3 xformOp:translate.timeSamples = {{\n{places}        }}\n        \
         quatf xformOp:orient.timeSamples = {{\n{turns}        }}\n        \
         uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]\n{}    }}\n",
        geometry(shape)
    );
}

fn geometry(shape: &BodyShape) -> String {
    let prim = |kind: &str, lines: &str| format!("        def {kind} \"shape\"\n        {{\n{lines}        }}\n");
    match shape {
        BodyShape::None | BodyShape::Plane(_) => String::new(),
        BodyShape::Cuboid(half) => prim(
            "Cube",
            &format!(
                "            double size = 2\n            double3 xformOp:scale = ({}, {}, {})\n            \
                 uniform token[] xformOpOrder = [\"xformOp:scale\"]\n",
                half.x, half.y, half.z
            ),
        ),
        BodyShape::Ball(radius) => prim("Sphere", &format!("            double radius = {radius}\n")),
        BodyShape::Cylinder([half, radius]) => prim("Cylinder", &round(*half, *radius)),
        BodyShape::Capsule([half, radius]) => prim("Capsule", &round(*half, *radius)),
        BodyShape::Mesh(mesh) => {
            let join = |items: Vec<String>| items.join(", ");
            let points = join(mesh.vertices.iter().map(|p| format!("({}, {}, {})", p[0], p[1], p[2])).collect());
            let counts = join(mesh.triangles.iter().map(|_| "3".to_string()).collect());
            let corners = join(mesh.triangles.iter().flatten().map(u32::to_string).collect());
            prim(
                "Mesh",
                &format!(
                    "            uniform token subdivisionScheme = \"none\"\n            point3f[] points = [{points}]\n            \
                     int[] faceVertexCounts = [{counts}]\n            int[] faceVertexIndices = [{corners}]\n"
                ),
            )
        }
    }
}

fn round(half: f64, radius: f64) -> String {
    format!(
        "            uniform token axis = \"Y\"\n            double height = {}\n            double radius = {radius}\n",
        2.0 * half
    )
}
