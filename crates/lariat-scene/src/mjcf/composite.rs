//! Composites of type cable.

use super::cable::{Cable, Drag, Hold, Names};
use super::curve;
use super::surface::Surface;
use super::tree::Element;
use super::{Importer, Note};
use crate::error::Error;
use nalgebra::{Isometry3, Point3, Vector3};
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// Vertices of a cable that are read: one takes some 1.5 kB.
pub(super) const VERTICES: RangeInclusive<f64> = 2.0..=1e5;

/// A section of MuJoCo: area, second moment of area, the key of the scene, and volume that a segment has beyond its length.
struct Section {
    area: f64,
    second_moment: f64,
    key: String,
    ends: f64,
    radius: f64,
    /// Side of the square that MuJoCo's drag takes for it, in m.
    side: f64,
}

impl Importer {
    pub(super) fn composite(&mut self, node: &Element, root: usize, place: &Isometry3<f64>) -> Result<(), Error> {
        let here = place * self.local(node, "offset")?;
        let vertices = in_world(&here, &vertices_of(node)?);
        if vertices.windows(2).any(|pair| (pair[1] - pair[0]).norm() <= 1e-9) {
            return Err(node.wrong("two neighbouring vertices are one point"));
        }
        let Some(geom) = node.named("geom").next() else { return Err(node.wrong("has no geom")) };
        let config = Config::of(node)?;
        let chords: Vec<f64> = vertices.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        let segments = chords.len() as f64;
        let equal = chords.iter().all(|chord| (chord / chords[0] - 1.0).abs() < 1e-3);
        let smooth = curve::through(&vertices);
        let straight = smooth.is_none();
        let smooth = smooth.filter(|_| !config.flat);
        if smooth.as_ref().is_some_and(|curve| !curve.plane) {
            return Err(node.wrong(
                "is stress-free as drawn, and no curve in a plane: what holds a coil is its twist, and a natural curvature \
                 with a direction, which a cable of a scene has not; flat = \"true\" of its plugin imports it straight at rest",
            ));
        }
        let section = section(geom)?;
        let (points, arcs, curvature) = match smooth {
            Some(curve) => {
                self.notes.push(Note::at(
                    node,
                    "is stress-free as drawn, and a cable of a scene knows no direction of its natural curvature: right while no \
                     load bends it straight or out of its plane",
                ));
                if curve.largest > 0.25 * PI {
                    let degrees = curve.largest.to_degrees();
                    self.notes.push(Note::at(
                        node,
                        format!("bends by {degrees:.0} degrees at a vertex: the scene rounds it over two segments"),
                    ));
                }
                (curve.points, curve.arcs, curve.curvature)
            }
            None => {
                let mut arcs = vec![0.0];
                for chord in &chords {
                    arcs.push(arcs[arcs.len() - 1] + chord);
                }
                (vertices.clone(), arcs, Vec::new())
            }
        };
        let length = arcs[arcs.len() - 1];

        let joint = node.named("joint").next();
        if let Some(joint) = joint {
            joint.word("kind", &["main"])?;
        }
        let of_joint = |key: &str| joint.map_or(Ok(None), |joint| joint.number(key));
        let initial = node.word("initial", &["ball", "free", "none"])?;
        let spring = of_joint("stiffness")?.unwrap_or(0.0);
        if let Some(joint) = joint.filter(|_| spring != 0.0) {
            if spring < 0.0 || !equal {
                return Err(
                    joint.wrong("stiffness: of joints at different distances, or below 0, is no bending stiffness")
                );
            }
            if config.flat && !straight {
                return Err(joint.wrong(
                    "stiffness: joints are at rest as drawn, and the plugin, which is flat, is straight at rest: a cable of a \
                     scene has one shape at rest",
                ));
            }
            if initial == "ball" {
                return Err(joint.wrong(
                    "stiffness: the joint of the first vertex is a spring against its body, which no attachment is: \
                     initial=\"none\" clamps it, initial=\"free\" leaves it",
                ));
            }
        }
        // a joint that turns by an angle a on the length l between two joints is a curvature a/l
        let bending = config.young * section.second_moment + spring * length / segments;

        let mass = match (geom.number("mass")?, geom.number("density")?.unwrap_or(1000.0)) {
            (Some(mass), _) if mass > 0.0 => {
                if !equal {
                    self.notes.push(Note::at(
                        geom,
                        "mass: the same for segments of different length, here even along the cable",
                    ));
                }
                mass * segments
            }
            (None, density) if density > 0.0 => {
                density * chords.iter().map(|length| section.volume(*length)).sum::<f64>()
            }
            _ => return Err(geom.wrong("needs a mass or a density > 0")),
        };
        let mut density = mass / (section.area * length);
        if let (None, Some(given)) = (geom.number("mass")?, geom.number("density")?.or(Some(1000.0)))
            && (density / given - 1.0).abs() < 1e-9
        {
            density = given;
        }
        let young = config.young;
        let solid = spring == 0.0 && geom.number("mass")?.is_none();
        let solid = solid.then(|| format!("{}\ndensity = {density:?}\nyoungs_modulus = {young:?}", section.key));
        // a torque c w at a joint is that of the bending moment EI tau kappa', kappa' = w/(length of a segment)
        let damping = of_joint("damping")?.filter(|c| *c > 0.0);
        let bending_damping = damping.map(|c| c * length / segments / bending);
        if let Some(joint) = joint.filter(|_| damping.is_some() && initial == "ball") {
            self.notes.push(Note::at(
                joint,
                "damping: of the joint of the first vertex is left out: a ball attachment has none",
            ));
        }
        let surface = Surface::read(Some(geom), self.options.no_contact)?;
        let drag = self.drag(node, &section, length / segments)?;
        let prefix = node.attribute("prefix").unwrap_or_default().to_string();
        let name = self.free_name(prefix.trim_end_matches('_'), "cable");
        let index = self.cables.len();
        match initial {
            "free" if root != 0 => return Err(node.wrong("initial = \"free\" is for cables in the world")),
            "free" => {}
            kind => self.holds.push(Hold { cable: index, arc: 0.0, frame: root, clamp: kind == "none" }),
        }
        let itself = surface.touches(&surface);
        self.cables.push(Cable {
            name,
            names: Names::Composite(prefix),
            vertices,
            arcs,
            points,
            curvature,
            solid,
            stretches: false,
            axial: young * section.area,
            bending,
            mass,
            bending_damping,
            axial_damping: None,
            surface,
            radius: section.radius,
            itself,
            drag,
        });
        Ok(())
    }

    /// Returns the drag of MuJoCo's box of inertia, on which it has a coefficient of 1 for each axis.
    ///
    /// A box of the sides a (along the cable) and b has f = 1/2 rho a b v^2 across and 1/2 rho b^2 v^2 along. That of a capsule has its half
    /// balls, which overlap the next segments and drag in MuJoCo as they weigh.
    fn drag(&mut self, node: &Element, section: &Section, segment: f64) -> Result<Option<Drag>, Error> {
        let fluid = &self.options;
        if fluid.viscosity > 0.0 && fluid.density == 0.0 {
            return Err(node.wrong(format!(
                "viscosity = {:?} of <option> without a density: drag of a scene grows by the square of the velocity",
                fluid.viscosity
            )));
        }
        if fluid.density == 0.0 {
            return Ok(None);
        }
        let ([along, side], diameter) = (section.inertia_box(segment), 2.0 * section.radius);
        if fluid.viscosity > 0.0 {
            let linear = PI * (along + 2.0 * side) * fluid.viscosity;
            let below = linear / (0.5 * fluid.density * along * side);
            self.notes.push(Note::at(
                node,
                format!(
                    "viscosity = {:?} of <option>: its linear drag is left out, which is less than that by density above {below:.2e} m/s",
                    fluid.viscosity
                ),
            ));
        }
        self.notes.push(Note::at(
            node,
            "drag: MuJoCo takes each axis of a segment by itself, up to 29 % less across a diagonal of its section",
        ));
        let per_length = side / (segment * diameter);
        Ok(Some(Drag { normal: along * per_length, tangential: side * per_length, diameter }))
    }
}

impl Section {
    /// Returns the volume in m^3 of a segment of a length in m.
    fn volume(&self, length: f64) -> f64 {
        self.area * length + self.ends
    }

    /// Returns the sides in m of the box that has the mass and the moments of inertia of a segment of a length in m, along and across it:
    /// `6 (I_y + I_z - I_x)/m` and so on are their squares.
    fn inertia_box(&self, segment: f64) -> [f64; 2] {
        if self.ends == 0.0 {
            return [segment, self.side];
        }
        let (shaft, ends, r) = (self.area * segment, self.ends, self.radius);
        let along = r * r * (shaft / 2.0 + ends * 2.0 / 5.0);
        let across = shaft * (segment * segment / 12.0 + r * r / 4.0)
            + ends * (r * r * 2.0 / 5.0 + segment * segment / 4.0 + segment * r * 3.0 / 8.0);
        [2.0 * across - along, along].map(|moment| (6.0 * moment / (shaft + ends)).sqrt())
    }
}

/// What the plugin of a cable is configured by.
struct Config {
    young: f64,
    flat: bool,
}

impl Config {
    fn of(node: &Element) -> Result<Self, Error> {
        let none = "no bend > 0 in its plugin mujoco.elasticity.cable: without a modulus there is no cable";
        let Some(plugin) = node.named("plugin").next() else { return Err(node.wrong(none)) };
        if plugin.attribute("plugin").is_some_and(|name| name != "mujoco.elasticity.cable") {
            return Err(plugin.wrong("plugin: mujoco.elasticity.cable is read"));
        }
        let mut config = Config { young: 0.0, flat: false };
        for entry in plugin.named("config") {
            match entry.attribute("key") {
                Some("bend") => config.young = entry.number("value")?.unwrap_or(0.0),
                Some("flat") => config.flat = entry.attribute("value") == Some("true"),
                // MuJoCo has one modulus for twist, here it is left out; vmax colours
                Some("twist") => drop(entry.number("value")?),
                Some("vmax") => {}
                other => {
                    return Err(
                        entry.wrong(format!("key = {:?}: twist, bend, flat and vmax are read", other.unwrap_or("")))
                    );
                }
            }
        }
        if config.young <= 0.0 {
            return Err(node.wrong(none));
        }
        Ok(config)
    }
}

fn section(geom: &Element) -> Result<Section, Error> {
    let size = geom.list("size")?.unwrap_or_default();
    let kind = geom.attribute("type").unwrap_or("sphere");
    match (kind, &size[..]) {
        ("capsule" | "cylinder", &[r, ..]) if r > 0.0 => Ok(Section {
            area: PI * r * r,
            second_moment: PI * r.powi(4) / 4.0,
            key: format!("section = {{ round = {:?} }}", 2.0 * r),
            // the half balls of a capsule overlap the next segments, and weigh in MuJoCo
            ends: if kind == "capsule" { 4.0 / 3.0 * PI * r.powi(3) } else { 0.0 },
            radius: r,
            side: 3.0_f64.sqrt() * r,
        }),
        ("box", &[_, a, b]) if a > 0.0 && a == b => Ok(Section {
            area: 4.0 * a * a,
            second_moment: 4.0 * a.powi(4) / 3.0,
            key: format!("section = {{ square = {:?} }}", 2.0 * a),
            ends: 0.0,
            radius: a,
            side: 2.0 * a,
        }),
        ("box", &[_, a, b]) if a > 0.0 && b > 0.0 => Err(geom.wrong(format!(
            "a box of {:?} m by {:?} m: cables of a scene bend alike in all directions. If it bends about its weak axis alone, \
             write a cylinder of the radius (4 I/pi)^(1/4) = {:?} m, I = w t^3/12, with the density that keeps its mass",
            2.0 * a.max(b),
            2.0 * a.min(b),
            (16.0 / 3.0 * a.max(b) * a.min(b).powi(3) / PI).powf(0.25)
        ))),
        (kind, _) => Err(geom.wrong(format!("a {kind} of size {size:?}: capsules, cylinders and square boxes are read"))),
    }
}

/// Returns mass in kg and length in m of the first segment of a composite that is one with its body.
pub(super) fn first_segment(node: &Element) -> Result<Option<[f64; 2]>, Error> {
    let (Some(geom), Some("none")) = (node.named("geom").next(), node.attribute("initial")) else { return Ok(None) };
    let vertices = vertices_of(node)?;
    let (length, section) = ((vertices[1] - vertices[0]).norm(), section(geom)?);
    let by_density = geom.number("density")?.unwrap_or(1000.0) * section.volume(length);
    let mass = geom.number("mass")?.unwrap_or(by_density);
    Ok((mass > 0.0).then_some([mass, length]))
}

fn vertices_of(node: &Element) -> Result<Vec<Vector3<f64>>, Error> {
    match node.list("vertex")? {
        Some(numbers) if numbers.len() >= 6 && numbers.len() % 3 == 0 => {
            Ok(numbers.chunks_exact(3).map(Vector3::from_column_slice).collect())
        }
        Some(numbers) => Err(node.wrong(format!("vertex has {} numbers: needs 6, 9, ...", numbers.len()))),
        None => curve_of(node),
    }
}

pub(super) fn in_world(here: &Isometry3<f64>, local: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    local.iter().map(|p| (here * Point3::from(*p)).coords).collect()
}

fn curve_of(node: &Element) -> Result<Vec<Vector3<f64>>, Error> {
    let count = node.number("count")?.unwrap_or(0.0);
    if !VERTICES.contains(&count) || count.fract() != 0.0 {
        return Err(node.wrong(format!("count = {count}: needs a whole number of vertices, 2 to {}", VERTICES.end())));
    }
    if node.list("count")?.unwrap_or_default().iter().skip(1).any(|count| *count != 1.0) {
        return Err(node.wrong("count: a cable has one row, as 21 1 1"));
    }
    let size = node.list("size")?.unwrap_or_default();
    let [l, r, turns] = [0, 1, 2].map(|k| size.get(k).copied().unwrap_or(if k == 0 { 1.0 } else { 0.0 }));
    let Some(curve) = node.attribute("curve") else { return Err(node.wrong("needs vertex or curve")) };
    let words: Vec<&str> = curve.split_whitespace().collect();
    if words.is_empty() || words.len() > 3 {
        return Err(node.wrong(format!("curve = {curve:?}: needs 1 to 3 functions")));
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
                other => return Err(node.wrong(format!("curve: {other:?} is not s, cos(s), sin(s) or 0"))),
            };
        }
        points.push(point);
    }
    Ok(points)
}
