//! Bodies of a model with their geoms and joints, as bodies and joints of a scene.
//!
//! A body without joints on the world is fixed, one with `mocap` kinematic, and all others are dynamic: their mass, centre of
//! mass and inertia are those of `inertial`, or of all their geoms. One that has neither is in MuJoCo what the first segment of a composite
//! with `initial="none"` makes it; that segment is the cable's here, and the body has a hundredth of it. A body of a scene has one shape.

use super::composite::first_segment;
use super::geom::{Geom, Shape};
use super::surface::Surface;
use super::tree::Element;
use super::{Importer, Note};
use crate::error::Error;
use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, SymmetricEigen, Translation3, UnitQuaternion, Vector3};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    World,
    Fixed,
    Mocap,
    Moving,
}

/// A body of MuJoCo.
pub(super) struct Frame {
    pub name: String,
    pub place: Isometry3<f64>,
    pub kind: Kind,
    pub parent: usize,
    /// Name of the body of the scene; "world" if it has none.
    pub body: String,
}

/// A body of the scene.
pub(super) struct Body {
    pub name: String,
    pub kind: &'static str,
    pub shape: Option<String>,
    pub place: Isometry3<f64>,
    /// Mass in kg and moments of inertia in kg m^2 of a dynamic body.
    pub mass: Option<(f64, Vector3<f64>)>,
    pub surface: Option<Surface>,
}

/// A joint of the scene.
pub(super) struct Joint {
    pub kind: &'static str,
    pub body: String,
    pub to: String,
    pub at: Vector3<f64>,
    pub axis: Option<Vector3<f64>>,
}

/// A surface of the model: on which body, `None` for a cable, and whether it moves.
pub(super) struct Listed {
    frame: Option<usize>,
    moves: bool,
    surface: Surface,
}

/// Mass, centre and tensor of inertia about it, in the axes of a body.
struct Inertia {
    mass: f64,
    centre: Vector3<f64>,
    tensor: Matrix3<f64>,
}

/// Mass of a body that is one with the first segment of a cable, in masses of that segment. Setting: none in MuJoCo, and a body of a scene has
/// one.
const SHARE: f64 = 0.01;

/// Returns what is in a body, that in its frames too, each with the place of its frame.
fn contents<'e>(
    importer: &Importer,
    element: &'e Element,
    place: Isometry3<f64>,
    out: &mut Vec<(Isometry3<f64>, &'e Element)>,
) -> Result<(), Error> {
    for child in &element.children {
        if child.name == "frame" {
            contents(importer, child, place * importer.local(child, "pos")?, out)?;
        } else {
            out.push((place, child));
        }
    }
    Ok(())
}

impl Importer {
    /// Reads the world or a body, and what is on it.
    pub(super) fn body(
        &mut self,
        element: &Element,
        place: Isometry3<f64>,
        parent: Option<usize>,
    ) -> Result<(), Error> {
        let mut inside = Vec::new();
        contents(self, element, Isometry3::identity(), &mut inside)?;
        let joints: Vec<&(Isometry3<f64>, &Element)> =
            inside.iter().filter(|(_, child)| ["joint", "freejoint"].contains(&child.name.as_str())).collect();
        let kind = match parent.map(|parent| self.frames[parent].kind) {
            None => Kind::World,
            _ if element.word("mocap", &["false", "true"])? == "true" => Kind::Mocap,
            _ if !joints.is_empty() => Kind::Moving,
            Some(Kind::World | Kind::Fixed) => Kind::Fixed,
            Some(Kind::Mocap) => {
                self.notes.push(Note::at(element, "is a kinematic body of its own: give it the path of its parent"));
                Kind::Mocap
            }
            Some(Kind::Moving) => Kind::Moving,
        };
        let frame = self.frames.len();
        let name = element.attribute("name").unwrap_or_default().to_string();
        self.frames.push(Frame { name, place, kind, parent: parent.unwrap_or(0), body: "world".to_string() });
        let mut geoms = Vec::new();
        for (on, child) in &inside {
            match child.name.as_str() {
                "geom" => {
                    let mut geom = Geom::read(child, &self.options.angles, self.options.no_contact)?;
                    geom.place = on * geom.place;
                    geoms.push((*child, geom));
                }
                "site" => {
                    let local = match child.list("fromto")?.as_deref() {
                        Some(&[a, b, c, d, e, f]) => 0.5 * Vector3::new(a + d, b + e, c + f),
                        Some(_) => return Err(child.wrong("fromto needs 6 numbers")),
                        None => child.vector("pos")?.unwrap_or_default(),
                    };
                    if let Some(name) = child.attribute("name") {
                        let point = (place * on * Point3::from(local)).coords;
                        self.sites.insert(name.to_string(), (frame, point));
                    }
                }
                _ => {}
            }
        }
        match kind {
            Kind::World | Kind::Fixed => self.shapes(frame, geoms, "fixed")?,
            Kind::Mocap => {
                if geoms.iter().filter(|(_, geom)| self.collides(frame, geom)).count() > 1 {
                    return Err(element.wrong("has several geoms that touch: a body of a scene has one shape"));
                }
                self.shapes(frame, geoms, "kinematic")?;
            }
            Kind::Moving => self.dynamic(element, frame, &inside, geoms, &joints)?,
        }
        for (on, child) in &inside {
            match child.name.as_str() {
                "body" => self.body(child, place * on * self.local(child, "pos")?, Some(frame))?,
                "composite" if child.attribute("type") == Some("cable") => {
                    self.composite(child, frame, &(place * on))?
                }
                "flexcomp" if child.attribute("dim") == Some("1") => self.flexcomp(child, frame, &(place * on))?,
                "composite" | "flexcomp" => {
                    return Err(child.wrong("is not read: only composites of type cable and flexcomps of dim 1 are"));
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn collides(&self, frame: usize, geom: &Geom) -> bool {
        let moves = self.frames[frame].kind == Kind::Moving;
        let mut others = self.surfaces.iter().filter(|other| other.frame != Some(frame) && (moves || other.moves));
        others.any(|other| geom.surface.touches(&other.surface))
    }

    /// Lists all surfaces, before bodies are read: a shape that touches nothing is left out.
    pub(super) fn list_surfaces(&mut self, element: &Element, moves: bool, frames: &mut usize) -> Result<(), Error> {
        let frame = *frames;
        *frames += 1;
        let mut inside = Vec::new();
        contents(self, element, Isometry3::identity(), &mut inside)?;
        let has_joint = inside.iter().any(|(_, child)| ["joint", "freejoint"].contains(&child.name.as_str()));
        let moves = moves || has_joint;
        for (_, child) in &inside {
            let (part, frame, moves) = match child.name.as_str() {
                "geom" => (Some(*child), Some(frame), moves),
                "composite" => (child.named("geom").next(), None, true),
                "flexcomp" => (child.named("contact").next(), None, true),
                "body" => {
                    self.list_surfaces(child, moves, frames)?;
                    continue;
                }
                _ => continue,
            };
            let surface = Surface::read(part, self.options.no_contact)?;
            self.surfaces.push(Listed { frame, moves, surface });
        }
        Ok(())
    }

    /// Adds a fixed or kinematic body for each geom that can touch something; a kinematic one at least.
    fn shapes(&mut self, frame: usize, geoms: Vec<(&Element, Geom)>, kind: &'static str) -> Result<(), Error> {
        let mut first = true;
        for (element, geom) in geoms {
            if !self.collides(frame, &geom) {
                continue;
            }
            let Some((shape, turn)) = geom.shape.of_scene() else {
                return Err(element.wrong("touches, and its shape is none of a scene: write it as a body with a mesh"));
            };
            let own = element.attribute("name").unwrap_or_default().to_string();
            let of_frame = self.frames[frame].name.clone();
            let name = self.free_name(if first && !of_frame.is_empty() { &of_frame } else { &own }, "body");
            if first && self.frames[frame].kind != Kind::World {
                self.frames[frame].body.clone_from(&name);
            }
            first = false;
            let mut place = self.frames[frame].place * geom.place;
            place.rotation *= turn;
            self.bodies.push(Body { name, kind, shape: Some(shape), place, mass: None, surface: Some(geom.surface) });
        }
        if first && kind == "kinematic" {
            let name = self.free_name(&self.frames[frame].name.clone(), "body");
            self.frames[frame].body.clone_from(&name);
            let place = self.frames[frame].place;
            self.bodies.push(Body { name, kind, shape: None, place, mass: None, surface: None });
        }
        Ok(())
    }

    fn dynamic(
        &mut self,
        element: &Element,
        frame: usize,
        inside: &[(Isometry3<f64>, &Element)],
        geoms: Vec<(&Element, Geom)>,
        joints: &[&(Isometry3<f64>, &Element)],
    ) -> Result<(), Error> {
        let given =
            inside.iter().find(|(_, child)| child.name == "inertial").filter(|_| !self.options.inertia_from_geoms);
        let inertia = match given {
            Some((on, inertial)) => self.inertial(inertial, on)?,
            None if geoms.iter().all(|(_, geom)| geom.mass == Some(0.0)) => self.of_segment(element, inside)?,
            None => of_geoms(element, &geoms)?,
        };
        let mut numbers = inertia.tensor.iter().chain(&inertia.centre).chain([&inertia.mass]);
        if !numbers.all(|x| x.is_finite()) {
            return Err(element.wrong("its mass or its inertia is no finite number"));
        }
        if self.options.density > 0.0 {
            if self.options.wind != Vector3::zeros() {
                return Err(element.wrong("moves, in the wind of <option>: bodies of a scene have no drag in air"));
            }
            self.notes.push(Note::at(element, "drag of the fluid of <option> on this body is left out"));
        }
        let mut touching = geoms.into_iter().filter(|(_, geom)| self.collides(frame, geom));
        let (place, shape, surface) = match (touching.next(), touching.next()) {
            (None, _) => {
                let axes = SymmetricEigen::new(inertia.tensor).eigenvectors;
                let axes = if axes.determinant() < 0.0 { -axes } else { axes };
                let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
                (Isometry3::from_parts(Translation3::from(inertia.centre), turn), None, None)
            }
            (Some((child, geom)), None) => {
                let Some((shape, turn)) = geom.shape.of_scene().filter(|_| geom.shape != Shape::Plane) else {
                    return Err(child.wrong("a shape that a body of a scene cannot move"));
                };
                let mut place = geom.place;
                place.rotation *= turn;
                (place, Some(shape), Some(geom.surface))
            }
            (Some(_), Some((child, _))) => {
                return Err(child.wrong(
                    "is the second geom of a moving body that touches: a body of a scene has one shape; contype=\"0\" \
                     conaffinity=\"0\" of the others keeps their mass",
                ));
            }
        };
        drop(touching);
        let axes = place.rotation.to_rotation_matrix();
        let tensor = axes.inverse() * inertia.tensor * axes;
        let moments = tensor.diagonal();
        let largest = moments.amax();
        let mixed = (tensor - Matrix3::from_diagonal(&moments)).amax();
        let beside = (inertia.centre - place.translation.vector).norm();
        if mixed > 1e-6 * largest || beside > 1e-9 + 1e-6 * (largest / inertia.mass).sqrt() {
            return Err(element.wrong(
                "its centre of mass or its principal axes are not those of the shape that touches: a body of a scene has both \
                 in one place",
            ));
        }
        let name = self.free_name(&self.frames[frame].name.clone(), "body");
        self.frames[frame].body.clone_from(&name);
        let world = self.frames[frame].place * place;
        let mass = Some((inertia.mass, moments));
        self.bodies.push(Body { name: name.clone(), kind: "dynamic", shape, place: world, mass, surface });
        self.joints_of(element, frame, name, joints)
    }

    fn joints_of(
        &mut self,
        element: &Element,
        frame: usize,
        body: String,
        joints: &[&(Isometry3<f64>, &Element)],
    ) -> Result<(), Error> {
        let Frame { place, parent, .. } = self.frames[frame];
        let to = self.frames[parent].body.clone();
        let (kind, at, axis) = match joints {
            [] => ("fixed", place.translation.vector, None),
            [(on, joint)] => {
                let kind = if joint.name == "freejoint" {
                    "free"
                } else {
                    joint.word("type", &["hinge", "slide", "ball", "free"])?
                };
                let local = on * Point3::from(joint.vector("pos")?.unwrap_or_default());
                let axis = place.rotation * on.rotation * joint.vector("axis")?.unwrap_or_else(Vector3::z);
                if axis.norm() <= 1e-9 {
                    return Err(joint.wrong("axis is zero"));
                }
                match kind {
                    "free" => return Ok(()),
                    "hinge" => ("hinge", (place * local).coords, Some(axis)),
                    "slide" => ("slider", (place * local).coords, Some(axis)),
                    _ => ("ball", (place * local).coords, None),
                }
            }
            [_, (_, second), ..] => {
                return Err(second
                    .wrong("is the second joint of its body: a joint of a scene has one kind; put a body between"));
            }
        };
        if to == body {
            return Err(element.wrong("is joined to itself"));
        }
        self.joints.push(Joint { kind, body, to, at, axis });
        Ok(())
    }

    /// Returns what a body without a mass of its own has beside a composite that is clamped to it.
    fn of_segment(&mut self, element: &Element, inside: &[(Isometry3<f64>, &Element)]) -> Result<Inertia, Error> {
        for (on, composite) in inside.iter().filter(|(_, child)| child.name == "composite") {
            let Some([mass, length]) = first_segment(composite)? else { continue };
            let centre = (on * self.local(composite, "offset")?).translation.vector;
            let (mass, moment) = (SHARE * mass, SHARE * mass * length * length / 3.0);
            self.notes.push(Note::at(
                element,
                format!(
                    "moves with no mass but that of a segment of its composite, which the cable has here: the body has {mass:.2e} kg beside it"
                ),
            ));
            return Ok(Inertia { mass, centre, tensor: moment * Matrix3::identity() });
        }
        Err(element.wrong("moves without a mass: it has no geom, no inertial, and no composite with initial=\"none\""))
    }

    fn inertial(&self, element: &Element, on: &Isometry3<f64>) -> Result<Inertia, Error> {
        let place = on * self.local(element, "pos")?;
        let Some(mass) = element.number("mass")?.filter(|mass| *mass > 0.0) else {
            return Err(element.wrong("needs a mass > 0"));
        };
        let tensor = match (element.vector("diaginertia")?, element.list("fullinertia")?.as_deref()) {
            (Some(moments), None) => Matrix3::from_diagonal(&moments),
            (None, Some(&[a, b, c, d, e, f])) => Matrix3::new(a, d, e, d, b, f, e, f, c),
            _ => return Err(element.wrong("needs diaginertia, or the 6 numbers of fullinertia")),
        };
        let turn = place.rotation.to_rotation_matrix();
        Ok(Inertia { mass, centre: place.translation.vector, tensor: turn * tensor * turn.inverse() })
    }
}

fn of_geoms(element: &Element, geoms: &[(&Element, Geom)]) -> Result<Inertia, Error> {
    let mut sum = Inertia { mass: 0.0, centre: Vector3::zeros(), tensor: Matrix3::zeros() };
    let mut parts = Vec::new();
    for (child, geom) in geoms {
        let (Some(mass), Some(inertia)) = (geom.mass, geom.inertia()) else {
            return Err(child.wrong("its mass is not computed: write an inertial"));
        };
        sum.mass += mass;
        sum.centre += mass * geom.place.translation.vector;
        parts.push((mass, geom.place.translation.vector, inertia));
    }
    if sum.mass.is_nan() || sum.mass <= 0.0 {
        return Err(element.wrong("moves without a mass"));
    }
    sum.centre /= sum.mass;
    for (mass, centre, inertia) in parts {
        let r = centre - sum.centre;
        sum.tensor += inertia + mass * (Matrix3::identity() * r.norm_squared() - r * r.transpose());
    }
    Ok(sum)
}
