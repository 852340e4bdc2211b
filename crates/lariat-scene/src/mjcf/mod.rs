//! Cables of MuJoCo models (MJCF): `<composite type="cable">` and `<flexcomp dim="1">`, as a scene.
//!
//! | MuJoCo | scene |
//! |---|---|
//! | vertices of a composite (`vertex`, or `curve`, `count`, `size`, `offset`, `quat`) | `points`; one element per segment |
//! | `bend` of its plugin, or `young`, and the geom | `youngs_modulus` and section, or EA and EI |
//! | `density` or `mass` of the geom | `density`, or mass per length |
//! | `initial` ball or none; `connect` and `weld` of its last body to the world | attachments to the world |
//! | `damping` of its joint | `damping.bending`, as the time that the same torque per turn gives |
//! | vertices of a flexcomp (`count`, `spacing`, or `point`), `pin` | `points`, attachments of ends to the world |
//! | `stiffness` of its edge | EA = stiffness x edge length; no bending |
//!
//! # Validity
//!
//! A composite of MuJoCo does not stretch; here it has the axial stiffness of its material. Twist is left out: Lariat has none. Geometry that
//! stands still around a cable is applied to its points; a cable on a body with joints, and everything else that would change the
//! motion of the cable, is an error. Bodies, sensors and drawing are left out, with a note for bodies with joints.
//!
//! # References
//!
//! MuJoCo documentation, XML reference, body/composite and body/flexcomp; vertices are checked against MuJoCo 3.17
//! (`crates/lariat-python/tests/test_mjcf.py`).

mod composite;
mod flexcomp;
mod limits;
mod read;

use crate::error::Error;
use nalgebra::{Isometry3, Vector3};
use read::Reader;
use roxmltree::{Document, Node};
use std::fmt::Write as _;

/// A cable of a model.
struct Imported {
    name: String,
    points: Vec<Vector3<f64>>,
    material: String,
    /// Points held by the world: arc length names, and whether the tangent is held.
    holds: Vec<(&'static str, bool)>,
    damping: Option<f64>,
    /// Name prefix of the bodies of a composite, for equality constraints.
    prefix: Option<String>,
}

/// Reads the cables of a model, and returns a scene in TOML; `file` is its name in errors.
///
/// # Errors
/// [`Error::Import`] for a file that is not XML, that nests elements deeper than 256 or gives one more than 256 attributes,
/// without cables, or with what cannot be imported right.
pub fn import(file: &str, text: &str) -> Result<String, Error> {
    let reader = Reader { file };
    limits::check(text).map_err(|(line, problem)| reader.error(line, problem))?;
    let document = Document::parse(text).map_err(|error| reader.error(0, format!("not XML: {error}")))?;
    let root = document.root_element();
    if root.tag_name().name() != "mujoco" {
        return Err(reader.error(1, "not a model of MuJoCo: its root is not <mujoco>".to_string()));
    }
    reader.check_whole(root)?;
    let mut cables = Vec::new();
    for world in children(root, "worldbody") {
        reader.body(world, Isometry3::identity(), false, &mut cables)?;
    }
    for equality in children(root, "equality") {
        reader.equality(equality, &mut cables)?;
    }
    if cables.is_empty() {
        return Err(reader.error(1, "no <composite type=\"cable\"> and no <flexcomp dim=\"1\">".to_string()));
    }
    let option = children(root, "option").next();
    let gravity = match option.and_then(|option| option.attribute("gravity").map(|text| (option, text))) {
        Some((option, text)) => reader.vector(option, "gravity", text)?,
        None => Vector3::new(0.0, 0.0, -9.81),
    };
    Ok(scene(file, &gravity, &cables))
}

/// Returns the elements of a name.
fn children<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.tag_name().name() == name)
}

impl Reader<'_> {
    /// Refuses what changes the meaning of all numbers.
    fn check_whole(&self, root: Node<'_, '_>) -> Result<(), Error> {
        for node in root.descendants().filter(Node::is_element) {
            let name = node.tag_name().name();
            if name == "include" {
                return Err(self.wrong(node, "is not read: save the model in one file (mj_saveLastXML)"));
            }
            let defaults =
                name == "default" && node.children().any(|c| ["geom", "joint"].contains(&c.tag_name().name()));
            if defaults && root.descendants().any(|n| n.tag_name().name() == "composite") {
                return Err(self.wrong(node, "defaults are not read: write the values at the cable"));
            }
        }
        Ok(())
    }

    fn body(
        &self,
        body: Node<'_, '_>,
        place: Isometry3<f64>,
        moves: bool,
        cables: &mut Vec<Imported>,
    ) -> Result<(), Error> {
        for child in body.children().filter(Node::is_element) {
            let name = child.tag_name().name();
            let is_cable = name == "composite" && child.attribute("type") == Some("cable")
                || name == "flexcomp" && child.attribute("dim") == Some("1");
            if is_cable && moves {
                return Err(
                    self.wrong(child, "is on a body with joints: build the body in the scene, and attach the cable")
                );
            }
            match name {
                "body" => {
                    let free = ["joint", "freejoint"]
                        .iter()
                        .any(|joint| child.children().any(|c| c.tag_name().name() == *joint));
                    self.body(child, place * self.place(child, "pos")?, moves || free, cables)?;
                }
                "frame" => self.body(child, place * self.place(child, "pos")?, moves, cables)?,
                "composite" if is_cable => cables.push(self.composite(child, &place)?),
                "flexcomp" if is_cable => cables.push(self.flexcomp(child, &place)?),
                "composite" | "flexcomp" | "replicate" => {
                    return Err(
                        self.wrong(child, "is not read: only composites of type cable and flexcomps of dim 1 are")
                    );
                }
                _ => {}
            }
        }
        Ok(())
    }
}

fn scene(file: &str, gravity: &Vector3<f64>, cables: &[Imported]) -> String {
    let list = |v: &Vector3<f64>| format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z);
    let mut text = format!(
        "# Cables of the MuJoCo model {}\n\nduration = 1.0    # s\ngravity = {}\n",
        file.replace('\n', " "),
        list(gravity)
    );
    let mut names: Vec<String> = Vec::new();
    for cable in cables {
        let mut name = if cable.name.is_empty() { "cable".to_string() } else { cable.name.clone() };
        while names.contains(&name) {
            name.push('\'');
        }
        let quoted = toml::Value::from(name.as_str()).to_string();
        let points: Vec<String> = cable.points.iter().map(list).collect();
        let _ = write!(
            text,
            "\n[[cable]]\nname = {quoted}\nelements = {}\npoints = [{}]\n{}\n",
            cable.points.len() - 1,
            points.join(", "),
            cable.material
        );
        if let Some(tau) = cable.damping {
            let _ = writeln!(text, "damping = {{ bending = {tau:?} }}");
        }
        for (at, clamp) in &cable.holds {
            let kind = if *clamp { "kind = \"clamp\"\n" } else { "" };
            let _ = write!(text, "\n[[attachment]]\ncable = {quoted}\nat = \"{at}\"\nbody = \"world\"\n{kind}");
        }
        names.push(name);
    }
    text
}
