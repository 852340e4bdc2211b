//! The scene, as TOML.

use super::bodies::Body;
use super::cable::Cable;
use super::{Importer, Note};
use nalgebra::Vector3;
use std::fmt::Write as _;

fn list(v: &Vector3<f64>) -> String {
    // -0.0 and 0.0 are one number
    let [x, y, z] = [v.x, v.y, v.z].map(|x| x + 0.0);
    format!("[{x:?}, {y:?}, {z:?}]")
}

fn quoted(name: &str) -> String {
    toml::Value::from(name).to_string()
}

impl Importer {
    /// Returns the text of the scene.
    pub(super) fn scene(&mut self, file: &str) -> String {
        let frictions = self.frictions();
        let mut text = format!("# Cables of the MuJoCo model {}\n", file.replace(['\n', '\r'], " "));
        let materials = self.materials();
        let contacts: Vec<String> = (0..self.cables.len()).map(|index| self.contact(index, frictions)).collect();
        if !self.notes.is_empty() {
            text += "#\n# What of the model is not as there:\n";
        }
        for note in &self.notes {
            let _ = writeln!(text, "# - {}", note.to_string().replace(['\n', '\r'], " "));
        }
        let _ = write!(text, "\nduration = 1.0    # s\ngravity = {}\n", list(&self.options.gravity));
        for body in &self.bodies {
            text += &body_text(body, frictions);
        }
        for joint in &self.joints {
            let _ = write!(
                text,
                "\n[[joint]]\nkind = {}\nbody = {}\nto = {}\nat = {}\n",
                quoted(joint.kind),
                quoted(&joint.body),
                quoted(&joint.to),
                list(&joint.at)
            );
            if let Some(axis) = &joint.axis {
                let _ = writeln!(text, "axis = {}", list(axis));
            }
        }
        for ((cable, material), contact) in self.cables.iter().zip(&materials).zip(&contacts) {
            text += &self.cable_text(cable, material, contact);
        }
        for hold in &self.holds {
            let cable = &self.cables[hold.cable];
            let kind = if hold.clamp { "kind = \"clamp\"\n" } else { "" };
            let _ = write!(
                text,
                "\n[[attachment]]\ncable = {}\nat = {}\nbody = {}\n{kind}",
                quoted(&cable.name),
                at(cable, hold.arc),
                quoted(&self.frames[hold.frame].body)
            );
        }
        for tie in &self.ties {
            let [a, b] = tie.cables.map(|index| &self.cables[index]);
            let _ = write!(
                text,
                "\n[[junction]]\ncable = {}\nat = {}\nother = {}\nother_at = {}\n",
                quoted(&a.name),
                at(a, tie.arcs[0]),
                quoted(&b.name),
                at(b, tie.arcs[1])
            );
        }
        text
    }

    fn cable_text(&self, cable: &Cable, material: &str, contact: &str) -> String {
        let points: Vec<String> = cable.points.iter().map(list).collect();
        let mut text = format!(
            "\n[[cable]]\nname = {}\nelements = {}\npoints = [{}]\n{}\n",
            quoted(&cable.name),
            cable.vertices.len() - 1,
            points.join(", "),
            material
        );
        let times = [("axial", cable.axial_damping), ("bending", cable.bending_damping)];
        let times: Vec<String> =
            times.iter().filter_map(|(key, time)| Some(format!("{key} = {:?}", (*time)?))).collect();
        if !times.is_empty() {
            let _ = writeln!(text, "damping = {{ {} }}", times.join(", "));
        }
        if let Some(drag) = &cable.drag {
            let wind = self.options.wind;
            let flow = if wind == Vector3::zeros() { String::new() } else { format!(", flow = {}", list(&wind)) };
            let _ = writeln!(
                text,
                "drag = {{ fluid_density = {:?}, normal = {:?}, tangential = {:?}, diameter = {:?}{flow} }}",
                self.options.density, drag.normal, drag.tangential, drag.diameter
            );
        }
        text += contact;
        let first = cable.curvature.first().copied().unwrap_or(0.0);
        if first > 0.0 && cable.curvature.iter().all(|k| (k / first - 1.0).abs() < 1e-3) {
            let _ = writeln!(text, "rest_shape = {{ curvature = {first:?} }}");
        } else {
            for (arc, curvature) in cable.arcs.iter().zip(&cable.curvature) {
                let _ = write!(text, "\n[[cable.rest_shape.piece]]\nfrom = {arc:?}\ncurvature = {curvature:?}\n");
            }
        }
        text
    }

    /// Returns the materials of the cables, under the weight of all that moves.
    fn materials(&mut self) -> Vec<String> {
        let bodies = self.bodies.iter().filter_map(|body| body.mass).map(|(mass, _)| mass);
        let mass: f64 = self.cables.iter().map(|cable| cable.mass).chain(bodies).sum();
        let load = mass * self.options.gravity.norm();
        let mut materials = Vec::new();
        for cable in &self.cables {
            let (keys, stiffened) = cable.material(load);
            if stiffened {
                self.notes.push(Note::whole(format!(
                    "cable {} does not stretch in the model: its EA is 1e5 times the weight of all that moves, not {:.3e} N \
                     by its modulus of bending",
                    cable.name, cable.axial
                )));
            }
            materials.push(keys);
        }
        materials
    }

    /// Returns the one coefficient of friction of all surfaces that touch; `None` if there are several.
    fn frictions(&mut self) -> Option<f64> {
        let mut all: Vec<f64> = Vec::new();
        let cables = self.cables.iter().enumerate();
        for (index, cable) in cables {
            let others = self.cables[index + 1..].iter().map(|other| &other.surface);
            let bodies = self.bodies.iter().filter_map(|body| body.surface.as_ref());
            let own = Some(&cable.surface).filter(|_| cable.itself);
            for other in others.chain(bodies).chain(own).filter(|other| cable.surface.touches(other)) {
                all.push(cable.surface.friction_with(other));
            }
        }
        let first = all.first().copied()?;
        if all.iter().all(|friction| *friction == first) {
            return Some(first);
        }
        self.notes.push(Note::whole(
            "friction: contacts have the larger coefficient of both surfaces in MuJoCo, and the mean here: they differ",
        ));
        None
    }

    /// Returns the contact of a cable, and notes what touches otherwise than in the model.
    fn contact(&mut self, index: usize, frictions: Option<f64>) -> String {
        let cable = &self.cables[index];
        let touches: Vec<(&str, bool)> = self
            .bodies
            .iter()
            .filter_map(|body| Some((body.name.as_str(), cable.surface.touches(body.surface.as_ref()?))))
            .collect();
        let mut others = self.cables.iter().enumerate().filter(|(other, _)| *other != index);
        let cables = others.any(|(_, other)| cable.surface.touches(&other.surface));
        if !cable.itself && !cables && !touches.iter().any(|(_, touches)| *touches) {
            return String::new();
        }
        let apart: Vec<&str> = touches.iter().filter(|(_, touches)| !touches).map(|(name, _)| *name).collect();
        if !apart.is_empty() {
            self.notes.push(Note::whole(format!(
                "cable {} touches {} here, by contype and conaffinity not in the model",
                cable.name,
                apart.join(", ")
            )));
        }
        let cable = &self.cables[index];
        let friction = frictions.unwrap_or(cable.surface.friction());
        format!(
            "contact = {{ radius = {:?}, friction = {friction:?}, itself = {}, cables = {cables} }}\n",
            cable.radius, cable.itself
        )
    }
}

fn at(cable: &Cable, arc: f64) -> String {
    match arc {
        0.0 => "\"start\"".to_string(),
        arc if arc >= cable.length() => "\"end\"".to_string(),
        arc => format!("{arc:?}"),
    }
}

fn body_text(body: &Body, frictions: Option<f64>) -> String {
    let mut text = format!(
        "\n[[body]]\nname = {}\nkind = {}\nshape = {}\n",
        quoted(&body.name),
        quoted(body.kind),
        body.shape.as_deref().unwrap_or("\"none\"")
    );
    if let Some((mass, moments)) = &body.mass {
        let _ = writeln!(text, "mass = {mass:?}\ninertia = {}", list(moments));
    }
    let _ = writeln!(text, "position = {}", list(&body.place.translation.vector));
    let rotation = body.place.rotation.scaled_axis();
    if rotation.norm() > 1e-12 {
        let _ = writeln!(text, "rotation = {}", list(&rotation));
    }
    if let (Some(surface), Some(_)) = (&body.surface, &body.shape) {
        let _ = writeln!(text, "friction = {:?}", frictions.unwrap_or(surface.friction()));
    }
    text
}
