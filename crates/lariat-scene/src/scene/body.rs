//! `[[body]]`: a rigid body, and where a fixed or kinematic one is at any time.

use super::course::{Course, Path as CoursePath};
use super::mesh::Mesh;
use super::path::{self, PathOrRows, PathTable};
use super::water::{self, BodyWater, BodyWaterTable};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{ANY, Choose, Kind, NOT_NEGATIVE, POSITIVE, UNIT, choice, table};
use lariat_ancf::{Vector3, Water};
use nalgebra::UnitQuaternion;
use serde::Deserialize;
use std::path::Path;

/// Largest distance of `position` from the start of a path, in m.
const PATH_GAP: f64 = 1e-6;

/// Three numbers that stay finite in the single precision of Rapier.
const SINGLE: Kind = Kind::Numbers(&["x", "y", "z"], ANY.single());

choice! {
    /// What moves a body.
    enum BodyKind {
        /// Forces.
        Dynamic = "dynamic",
        /// Nothing.
        Fixed = "fixed",
        /// Its path, or its constant velocity.
        Kinematic = "kinematic",
    }
}

table! {
    /// A rigid body, computed by Rapier in single precision. Bodies never sleep, and Rapier's limits of velocity are lifted.
    struct BodyTable("[[body]]") {
        /// No other body has it.
        name: String = required, Kind::Name(&["world", "all"]);
        /// `"dynamic"` bodies move by forces, `"fixed"` ones do not move, `"kinematic"` ones follow `path` or a constant velocity.
        kind: BodyKind = "dynamic", Kind::Choice(BodyKind::names);
        /// Shape about the origin of the body.
        shape: BodyShape = required, Kind::Either(&[Kind::Choice(|| vec!["none"]), Kind::Table(&SHAPE)]), "m";
        /// Mass of a dynamic body, or `density`; other bodies have neither.
        mass: Option<f64> = ("a dynamic body needs `mass` or `density`"), Kind::Number(POSITIVE.single()), "kg";
        /// Density of a dynamic body with a shape, instead of `mass`.
        density: Option<f64> = (), Kind::Number(POSITIVE.single()), "kg/m^3";
        /// Principal moments of inertia of a dynamic body, none larger than the sum of the others. They are about the axes of the body
        /// through its centre of mass, which for a mesh is that of the convex hull.
        inertia: Option<[f64; 3]> = ("that of the shape; without shape the body does not rotate"), Kind::Numbers(&["x", "y", "z"], POSITIVE.single()), "kg m^2";
        /// Position of the origin.
        position: Option<Vector3<f64>> = ("`[0.0, 0.0, 0.0]`, or the start of `path`"), SINGLE, "m";
        /// Axis times angle.
        rotation: Vector3<f64> = [0.0, 0.0, 0.0], SINGLE, "rad";
        /// Velocity of the origin of a dynamic body, or of a kinematic one without `path`.
        velocity: Option<Vector3<f64>> = ("`[0.0, 0.0, 0.0]`"), SINGLE, "m/s";
        /// Angular velocity of a dynamic or kinematic body, in world axes. A kinematic body keeps it.
        angular_velocity: Option<Vector3<f64>> = ("`[0.0, 0.0, 0.0]`"), SINGLE, "rad/s";
        /// Coefficient of friction of a body with a shape.
        friction: Option<f64> = ("Rapier's"), Kind::Number(NOT_NEGATIVE.single());
        /// Coefficient of restitution of a body with a shape.
        restitution: f64 = 0.0, Kind::Number(UNIT.single());
        /// Path of the origin of a kinematic body, linear between rows, at rest outside, with corners that belong on multiples of `dt`; or a
        /// table with rotations, a file, cubics.
        path: Option<PathOrRows> = ("none"), Kind::Either(&[Kind::Ascending(&["t", "x", "y", "z"]), Kind::Table(&PathTable::TABLE)]), "s, m";
        /// What the water of `[water]` does to it.
        water: Option<BodyWaterTable> = ("it is in air"), Kind::Table(&BodyWaterTable::TABLE);
    }
}

table! {
    /// Or `"none"`: a body that touches nothing.
    keys SHAPE("[body.shape]") {
        /// Half extents.
        cuboid = (), Kind::Numbers(&["x", "y", "z"], POSITIVE.single()), "m";
        /// Radius.
        ball = (), Kind::Number(POSITIVE.single()), "m";
        /// Half height along y, and radius.
        cylinder = (), Kind::Numbers(&["half height", "radius"], POSITIVE.single()), "m";
        /// Half height of the cylindrical part along y, and radius.
        capsule = (), Kind::Numbers(&["half height", "radius"], POSITIVE.single()), "m";
        /// Normal of a half space whose surface goes through the origin, for a fixed or kinematic body.
        plane = (), SINGLE;
        /// OBJ file with triangles, named from the folder of the scene. A dynamic body takes their convex hull, which must enclose a volume.
        mesh = (), Kind::Text;
    }
    choose Choose::ExactlyOne(&["cuboid", "ball", "cylinder", "capsule", "plane", "mesh"]);
}

/// The shape of a body, about its origin, in m.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BodyShape {
    /// No shape: it touches nothing.
    None,
    /// Half extents.
    Cuboid(Vector3<f64>),
    /// Radius.
    Ball(f64),
    /// Half height along y, and radius.
    Cylinder([f64; 2]),
    /// Half height of the cylindrical part along y, and radius.
    Capsule([f64; 2]),
    /// A half space: the unit normal of its surface, which goes through the origin.
    Plane(Vector3<f64>),
    /// Triangles; a dynamic body takes their convex hull.
    Mesh(Mesh),
}

/// Mass or density of a dynamic body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyMass {
    /// Mass in kg.
    Mass(f64),
    /// Density of the shape in kg/m^3.
    Density(f64),
}

/// A checked body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyScene {
    /// Name.
    pub name: String,
    /// What moves it.
    pub kind: BodyKind,
    /// Shape.
    pub shape: BodyShape,
    /// Mass; `None` if it is not dynamic.
    pub mass: Option<BodyMass>,
    /// Moments of inertia in kg m^2 about the axes of the body through its centre of mass; `None` = those of the shape.
    pub inertia: Option<Vector3<f64>>,
    /// Where it is at t = 0, and where it goes by itself.
    pub course: Course,
    /// Angle of the rotation in rad, as written.
    pub angle: f64,
    /// Coefficient of friction; `None` = Rapier's.
    pub friction: Option<f64>,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// What water does to it; `None` = it is in air.
    pub water: Option<BodyWater>,
}

/// Reads the body at a path of keys; files are named from `folder`.
pub(super) fn read(
    doc: &Document<'_>,
    at: &KeyPath,
    row: BodyTable,
    (folder, water): (&Path, Option<&Water>),
) -> Result<BodyScene, Error> {
    check_kind(doc, at, &row)?;
    let mut shape = row.shape.clone();
    match &mut shape {
        BodyShape::Plane(normal) => {
            let at = at.key("shape").key("plane");
            let zero = || doc.conflict(&at, format!("{:?} has no direction", normal.as_slice()));
            *normal = normal.try_normalize(f64::MIN_POSITIVE).ok_or_else(zero)?;
        }
        BodyShape::Mesh(mesh) => {
            mesh.read(folder).map_err(|problem| doc.conflict(&at.key("shape").key("mesh"), problem))?;
        }
        BodyShape::None if row.restitution > 0.0 => {
            return Err(doc.conflict(&at.key("restitution"), "a body without shape touches nothing"));
        }
        BodyShape::None if row.friction.is_some() => {
            return Err(doc.conflict(&at.key("friction"), "a body without shape touches nothing"));
        }
        _ => {}
    }
    let path = match row.path.clone() {
        Some(path) => path::read(doc, &at.key("path"), path, folder)?,
        None => CoursePath::default(),
    };
    check_path(doc, at, &row, &path)?;
    let mut body = BodyScene {
        mass: mass(doc, at, &row, &shape)?,
        water: water::of_body(doc, &at.key("water"), row.water, (row.kind, &shape, water))?,
        inertia: inertia(doc, &at.key("inertia"), row.inertia)?,
        name: row.name,
        kind: row.kind,
        shape,
        course: Course {
            position: row.position.unwrap_or_default(),
            rotation: UnitQuaternion::from_scaled_axis(row.rotation),
            velocity: row.velocity.unwrap_or_default(),
            angular_velocity: row.angular_velocity.unwrap_or_default(),
            path,
        },
        angle: row.rotation.norm(),
        friction: row.friction,
        restitution: row.restitution,
    };
    body.course.rotation = body.pose(0.0).1;
    if !body.course.path.positions.is_empty() {
        let start = body.pose(0.0).0;
        if let Some(position) = row.position.filter(|position| (start - position).norm() > PATH_GAP) {
            let problem = format!("{:?} is not where the path is at t = 0", position.as_slice());
            let accepted = format!("{:?}, or no position", start.as_slice());
            return Err(doc.error_accepting(&at.key("position"), Problem::Conflict(problem), accepted));
        }
        body.course.position = start;
    }
    Ok(body)
}

/// Checks that a body has no key that its kind excludes.
fn check_kind(doc: &Document<'_>, at: &KeyPath, row: &BodyTable) -> Result<(), Error> {
    let (dynamic, kinematic) = (row.kind == BodyKind::Dynamic, row.kind == BodyKind::Kinematic);
    for (key, given, allowed) in [
        ("mass", row.mass.is_some(), dynamic),
        ("density", row.density.is_some(), dynamic),
        ("inertia", row.inertia.is_some(), dynamic),
        ("velocity", row.velocity.is_some(), dynamic || kinematic),
        ("angular_velocity", row.angular_velocity.is_some(), dynamic || kinematic),
        ("path", row.path.is_some(), kinematic),
    ] {
        if given && !allowed {
            return Err(doc.conflict(&at.key(key), format!("a {} body has no {key}", row.kind.name())));
        }
    }
    Ok(())
}

/// Checks that a body has nothing beside its path that the path says.
fn check_path(doc: &Document<'_>, at: &KeyPath, row: &BodyTable, path: &CoursePath) -> Result<(), Error> {
    for (key, given) in [
        ("velocity", row.velocity.is_some() && !path.positions.is_empty()),
        ("angular_velocity", row.angular_velocity.is_some() && !path.rotations.is_empty()),
        ("rotation", row.rotation != Vector3::zeros() && !path.rotations.is_empty()),
    ] {
        if given {
            return Err(doc.conflict(&at.key(key), format!("the path determines the {}", key.replace('_', " "))));
        }
    }
    Ok(())
}

fn mass(doc: &Document<'_>, at: &KeyPath, row: &BodyTable, shape: &BodyShape) -> Result<Option<BodyMass>, Error> {
    match (row.kind, shape, row.mass, row.density) {
        (BodyKind::Fixed | BodyKind::Kinematic, ..) => Ok(None),
        (_, BodyShape::Plane(_), ..) => Err(doc.conflict(&at.key("shape").key("plane"), "a half space has no mass")),
        (_, _, Some(_), Some(_)) => Err(doc.conflict(&at.key("density"), "both mass and density are given")),
        (_, BodyShape::None, None, Some(_)) => {
            Err(doc.conflict(&at.key("density"), "a body without shape has no volume"))
        }
        (_, _, Some(mass), None) => Ok(Some(BodyMass::Mass(mass))),
        (_, _, None, Some(density)) => Ok(Some(BodyMass::Density(density))),
        (_, _, None, None) => Err(doc.missing(&at.key("mass"))),
    }
}

fn inertia(doc: &Document<'_>, at: &KeyPath, moments: Option<[f64; 3]>) -> Result<Option<Vector3<f64>>, Error> {
    let Some(moments) = moments else { return Ok(None) };
    let (sum, largest) = (moments.iter().sum::<f64>(), moments.iter().copied().fold(0.0, f64::max));
    if largest > (sum - largest) * (1.0 + 1e-6) {
        return Err(doc.conflict(at, format!("{moments:?}: no distribution of mass has such moments")));
    }
    Ok(Some(Vector3::from(moments)))
}

impl BodyScene {
    /// Returns origin (m) and rotation at a time (s): for a dynamic body those at t = 0.
    pub fn pose(&self, time: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        if self.kind == BodyKind::Kinematic { self.course.pose(time) } else { self.course.pose(0.0) }
    }

    /// Returns a point of the body, in its axes, as a point of the world at t = 0.
    pub fn to_world(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let (position, rotation) = self.pose(0.0);
        position + rotation * point
    }

    /// Returns a direction in the axes of the body in those of the world at t = 0.
    pub fn turned(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.pose(0.0).1 * direction
    }

    /// Returns a point of the world at t = 0 in the axes of the body.
    pub fn to_body(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let (position, rotation) = self.pose(0.0);
        rotation.inverse() * (point - position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_of_a_rotated_body_is_converted_to_world_axes() {
        let body = BodyScene {
            name: "hook".to_string(),
            kind: BodyKind::Kinematic,
            shape: BodyShape::None,
            mass: None,
            inertia: None,
            course: Course {
                position: Vector3::new(1.0, 2.0, 3.0),
                rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2)),
                velocity: Vector3::zeros(),
                angular_velocity: Vector3::zeros(),
                path: CoursePath::default(),
            },
            angle: std::f64::consts::FRAC_PI_2,
            friction: None,
            restitution: 0.0,
            water: None,
        };
        let point = Vector3::new(1.0, 0.0, 0.0);
        let world = body.to_world(&point);
        assert!((world - Vector3::new(1.0, 3.0, 3.0)).norm() < 1e-15);
    }
}
