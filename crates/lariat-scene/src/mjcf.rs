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

use crate::error::Error;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use roxmltree::{Document, Node};
use std::f64::consts::PI;
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
/// [`Error::Import`] for a file that is not XML, without cables, or with what cannot be imported right.
pub fn import(file: &str, text: &str) -> Result<String, Error> {
    let reader = Reader { file };
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

struct Reader<'a> {
    file: &'a str,
}

impl Reader<'_> {
    fn error(&self, line: u32, problem: String) -> Error {
        Error::Import { file: self.file.to_string(), line, problem }
    }

    fn wrong(&self, node: Node<'_, '_>, problem: impl Into<String>) -> Error {
        self.error(
            node.document().text_pos_at(node.range().start).row,
            format!("<{}>: {}", node.tag_name().name(), problem.into()),
        )
    }

    fn numbers(&self, node: Node<'_, '_>, key: &str, text: &str) -> Result<Vec<f64>, Error> {
        let number = |word: &str| match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(self.wrong(node, format!("{key}: {word:?} is not a finite number"))),
        };
        text.split_whitespace().map(number).collect()
    }

    fn list(&self, node: Node<'_, '_>, key: &str) -> Result<Option<Vec<f64>>, Error> {
        node.attribute(key).map(|text| self.numbers(node, key, text)).transpose()
    }

    fn number(&self, node: Node<'_, '_>, key: &str) -> Result<Option<f64>, Error> {
        match self.list(node, key)?.as_deref() {
            None => Ok(None),
            Some([x, ..]) => Ok(Some(*x)),
            Some([]) => Err(self.wrong(node, format!("{key} is empty"))),
        }
    }

    fn vector(&self, node: Node<'_, '_>, key: &str, text: &str) -> Result<Vector3<f64>, Error> {
        match self.numbers(node, key, text)?[..] {
            [x, y, z] => Ok(Vector3::new(x, y, z)),
            _ => Err(self.wrong(node, format!("{key} needs 3 numbers"))),
        }
    }

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

    /// Returns the place of a body, composite or flexcomp on its parent.
    fn place(&self, node: Node<'_, '_>, position: &str) -> Result<Isometry3<f64>, Error> {
        for key in ["euler", "axisangle", "xyaxes", "zaxis"] {
            if node.has_attribute(key) {
                return Err(self.wrong(node, format!("{key} is not read: give quat")));
            }
        }
        let shift = node.attribute(position).map_or(Ok(Vector3::zeros()), |text| self.vector(node, position, text))?;
        let turn = match self.list(node, "quat")?.as_deref() {
            None => UnitQuaternion::identity(),
            Some(&[w, x, y, z]) if w * w + x * x + y * y + z * z > 0.0 => {
                UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
            }
            Some(_) => return Err(self.wrong(node, "quat needs 4 numbers, not all zero")),
        };
        Ok(Isometry3::from_parts(Translation3::from(shift), turn))
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

    fn composite(&self, node: Node<'_, '_>, place: &Isometry3<f64>) -> Result<Imported, Error> {
        let here = place * self.place(node, "offset")?;
        let local = match self.list(node, "vertex")? {
            Some(numbers) if numbers.len() >= 6 && numbers.len() % 3 == 0 => {
                numbers.chunks_exact(3).map(Vector3::from_column_slice).collect()
            }
            Some(numbers) => {
                return Err(self.wrong(node, format!("vertex has {} numbers: needs 6, 9, ...", numbers.len())));
            }
            None => self.curve(node)?,
        };
        let points: Vec<Vector3<f64>> = local.iter().map(|p| (here * nalgebra::Point3::from(*p)).coords).collect();
        let length: f64 = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
        let Some(geom) = children(node, "geom").next() else { return Err(self.wrong(node, "has no geom")) };
        let configured = |key: &str| -> Result<Option<f64>, Error> {
            let mut configs = children(node, "plugin").flat_map(|plugin| children(plugin, "config"));
            let config = configs.find(|config| config.attribute("key") == Some(key));
            config.map_or(Ok(None), |config| self.number(config, "value"))
        };
        let young = configured("bend")?.or(configured("young")?);
        let Some(young) = young.filter(|young| *young > 0.0) else {
            return Err(self.wrong(
                node,
                "no bend > 0 in its plugin mujoco.elasticity.cable: without a modulus there is no cable",
            ));
        };
        let size = self.list(geom, "size")?.unwrap_or_default();
        let (area, bending, section) = match (geom.attribute("type").unwrap_or("sphere"), &size[..]) {
            ("capsule" | "cylinder", &[r, ..]) if r > 0.0 => {
                (PI * r * r, PI * r.powi(4) / 4.0, format!("section = {{ round = {:?} }}", 2.0 * r))
            }
            ("box", &[_, a, b]) if a > 0.0 && a == b => {
                (4.0 * a * a, 4.0 * a.powi(4) / 3.0, format!("section = {{ square = {:?} }}", 2.0 * a))
            }
            (kind, _) => {
                return Err(self
                    .wrong(geom, format!("a {kind} of size {size:?}: capsules, cylinders and square boxes are read")));
            }
        };
        let segments = (points.len() - 1) as f64;
        let material = match (self.number(geom, "mass")?, self.number(geom, "density")?) {
            (Some(mass), _) if mass > 0.0 => format!(
                "axial_stiffness = {:?}\nbending_stiffness = {:?}\nmass_per_length = {:?}",
                young * area,
                young * bending,
                mass * segments / length
            ),
            (None, density) if density.unwrap_or(1000.0) > 0.0 => {
                format!("{section}\ndensity = {:?}\nyoungs_modulus = {young:?}", density.unwrap_or(1000.0))
            }
            _ => return Err(self.wrong(geom, "needs a mass or a density > 0")),
        };
        let holds = match node.attribute("initial").unwrap_or("ball") {
            "free" => Vec::new(),
            "ball" => vec![("start", false)],
            "none" => vec![("start", true)],
            other => return Err(self.wrong(node, format!("initial = {other:?}: free, ball and none are read"))),
        };
        // a torque c w at a joint is that of the bending moment EI tau kappa', kappa' = w/(length of a segment)
        let joint = children(node, "joint").next();
        let damping = joint.map_or(Ok(None), |joint| self.number(joint, "damping"))?;
        let damping = damping.filter(|c| *c > 0.0).map(|c| c * length / segments / (young * bending));
        let prefix = node.attribute("prefix").unwrap_or_default().to_string();
        let name = prefix.trim_end_matches('_').to_string();
        Ok(Imported { name, points, material, holds, damping, prefix: Some(prefix) })
    }

    fn curve(&self, node: Node<'_, '_>) -> Result<Vec<Vector3<f64>>, Error> {
        let count = self.number(node, "count")?.unwrap_or(0.0);
        if !(2.0..=1e6).contains(&count) || count.fract() != 0.0 {
            return Err(self.wrong(node, format!("count = {count}: needs a whole number of vertices, 2 or more")));
        }
        let size = self.list(node, "size")?.unwrap_or_default();
        let [l, r, turns] = [0, 1, 2].map(|k| size.get(k).copied().unwrap_or(if k == 0 { 1.0 } else { 0.0 }));
        let Some(curve) = node.attribute("curve") else { return Err(self.wrong(node, "needs vertex or curve")) };
        let words: Vec<&str> = curve.split_whitespace().collect();
        if words.is_empty() || words.len() > 3 {
            return Err(self.wrong(node, format!("curve = {curve:?}: needs 1 to 3 functions")));
        }
        let mut points = Vec::new();
        for i in 0..count as usize {
            let s = i as f64 / (count - 1.0);
            let mut point = Vector3::zeros();
            for (k, word) in words.iter().enumerate() {
                point[k] = match *word {
                    "s" => l * s,
                    "cos(s)" => r * (PI * turns * s).cos(),
                    "sin(s)" => r * (PI * turns * s).sin(),
                    "0" => 0.0,
                    other => return Err(self.wrong(node, format!("curve: {other:?} is not s, cos(s), sin(s) or 0"))),
                };
            }
            points.push(point);
        }
        Ok(points)
    }

    fn flexcomp(&self, node: Node<'_, '_>, place: &Isometry3<f64>) -> Result<Imported, Error> {
        let here = place * self.place(node, "pos")?;
        if node.attribute("rigid") == Some("true") {
            return Err(self.wrong(node, "is rigid"));
        }
        let local: Vec<Vector3<f64>> = match node.attribute("type").unwrap_or("grid") {
            "grid" => {
                let count = self.number(node, "count")?.unwrap_or(10.0);
                let spacing = self.number(node, "spacing")?.unwrap_or(0.02);
                if !(2.0..=1e6).contains(&count) || count.fract() != 0.0 || spacing <= 0.0 {
                    return Err(self.wrong(
                        node,
                        format!("count = {count}, spacing = {spacing}: needs 2 vertices or more, and a spacing > 0"),
                    ));
                }
                // the grid is centred
                (0..count as usize).map(|i| Vector3::x() * spacing * (i as f64 - 0.5 * (count - 1.0))).collect()
            }
            "direct" => {
                let points = self.list(node, "point")?.unwrap_or_default();
                let order = self.list(node, "element")?.unwrap_or_default();
                let vertices = points.len() / 3;
                let in_a_row = order.len() == 2 * vertices.saturating_sub(1)
                    && order.chunks_exact(2).enumerate().all(|(i, pair)| pair == [i as f64, i as f64 + 1.0]);
                if vertices < 2 || points.len() % 3 != 0 || !in_a_row {
                    return Err(self.wrong(node, "needs points whose elements are 0 1 1 2 2 3 ..."));
                }
                points.chunks_exact(3).map(Vector3::from_column_slice).collect()
            }
            other => return Err(self.wrong(node, format!("type = {other:?}: grid and direct are read"))),
        };
        let scale = self.list(node, "scale")?.unwrap_or_else(|| vec![1.0; 3]);
        if scale != [1.0; 3] {
            return Err(self.wrong(node, "scale is not read: scale the points"));
        }
        let points: Vec<Vector3<f64>> = local.iter().map(|p| (here * nalgebra::Point3::from(*p)).coords).collect();
        let chords: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
        let length: f64 = chords.iter().sum();
        let edge = children(node, "edge").next();
        let stiffness = edge.map_or(Ok(None), |edge| self.number(edge, "stiffness"))?.filter(|k| *k > 0.0);
        let Some(stiffness) = stiffness else {
            return Err(
                self.wrong(node, "no edge stiffness > 0: without it there is no material (an equality is no material)")
            );
        };
        if chords.iter().any(|chord| (chord - chords[0]).abs() > 1e-6 * chords[0]) {
            return Err(self.wrong(node, "edges of different length: one stiffness for all is no material"));
        }
        let mass = self.number(node, "mass")?.unwrap_or(1.0);
        let damping = edge.map_or(Ok(None), |edge| self.number(edge, "damping"))?.filter(|c| *c > 0.0);
        if damping.is_some() {
            return Err(self.wrong(node, "edge damping is not read: give the cable damping.axial in the scene"));
        }
        // half of the mass of an end vertex is not on the cable: all vertices have the same
        let material = format!(
            "axial_stiffness = {:?}\nbending_stiffness = 0.0\nmass_per_length = {:?}\nrule = \"projected-none\"",
            stiffness * chords[0],
            mass / length
        );
        let mut holds = Vec::new();
        for pin in children(node, "pin") {
            for id in self.list(pin, "id")?.unwrap_or_default() {
                match id as usize {
                    0 => holds.push(("start", false)),
                    last if last + 1 == points.len() => holds.push(("end", false)),
                    inner => {
                        return Err(self.wrong(pin, format!("vertex {inner} is inside the cable: only ends are read")));
                    }
                }
            }
            if ["range", "grid", "gridrange"].iter().any(|key| pin.has_attribute(*key)) {
                return Err(self.wrong(pin, "only id is read"));
            }
        }
        let name = node.attribute("name").unwrap_or_default().to_string();
        Ok(Imported { name, points, material, holds, damping: None, prefix: None })
    }

    /// Reads what holds the last body of a composite.
    fn equality(&self, equality: Node<'_, '_>, cables: &mut [Imported]) -> Result<(), Error> {
        for constraint in equality.children().filter(Node::is_element) {
            let bodies = ["body1", "body2"].map(|key| constraint.attribute(key).unwrap_or("world"));
            for cable in cables.iter_mut() {
                let Some(prefix) = &cable.prefix else { continue };
                let is_own = |body: &str| body.strip_prefix(prefix.as_str()).is_some_and(|rest| rest.starts_with("B_"));
                let Some(own) = bodies.into_iter().find(|body| is_own(body)) else { continue };
                let other = bodies.into_iter().find(|body| !is_own(body));
                let clamp = match constraint.tag_name().name() {
                    "connect" => false,
                    "weld" => true,
                    _ => return Err(self.wrong(constraint, "of a body of a cable is not read: connect and weld are")),
                };
                if other != Some("world") || own != format!("{prefix}B_last") {
                    return Err(self.wrong(
                        constraint,
                        format!("holds {own} to {}: only the last body to the world is read", other.unwrap_or(own)),
                    ));
                }
                cable.holds.push(("end", clamp));
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
