//! Ranges of a `[[body]]`.

use super::body::{BodyKind, BodyMass, BodyScene, BodyShape};
use super::check::{missing, number, vector};
use super::document::{Document, KeyPath};
use super::table::BodyTable;
use super::value::ShapeValue;
use super::{mesh, physics_of};
use crate::error::Error;
use lariat_ancf::Vector3;
use nalgebra::UnitQuaternion;
use std::path::Path;

/// How far from the first place of its path a body may be drawn, in m.
const PATH_GAP: f64 = 1e-6;

/// Checks a body; files are named from `folder`.
pub(super) fn body(doc: &Document<'_>, at: &KeyPath, row: BodyTable, folder: &Path) -> Result<BodyScene, Error> {
    if ["", "world", "all"].contains(&row.name.as_str()) {
        return Err(doc.error(&at.key("name"), format!("{:?} is no name for a body", row.name)));
    }
    let kind = match row.kind.as_deref() {
        None | Some("dynamic") => BodyKind::Dynamic,
        Some("fixed") => BodyKind::Fixed,
        Some("kinematic") => BodyKind::Kinematic,
        Some(other) => return Err(doc.error(&at.key("kind"), format!("unknown kind {other:?}"))),
    };
    refuse_what_it_cannot_have(doc, at, &row, kind)?;
    let Some(shape) = &row.shape else { return Err(missing(doc, &at.key("shape"))) };
    let shape = shape_of(doc, &at.key("shape"), shape, folder)?;
    let friction = row.friction.map(|x| real(doc, &at.key("friction"), x, |x| x >= 0.0)).transpose()?;
    if friction.is_some() && shape == BodyShape::None {
        return Err(doc.error(&at.key("friction"), "a body without shape meets nothing"));
    }
    let path = path(doc, at, &row)?;
    let position = match path.first() {
        Some(_) if row.position.is_none() => Vector3::zeros(),
        _ => reals(doc, &at.key("position"), row.position.unwrap_or_default())?,
    };
    let motion = |key: &str, value: Option<[f64; 3]>| reals(doc, &at.key(key), value.unwrap_or_default());
    let mut body = BodyScene {
        name: row.name.clone(),
        kind,
        mass: mass(doc, at, &row, kind, &shape)?,
        inertia: inertia(doc, &at.key("inertia"), row.inertia)?,
        shape,
        position,
        rotation: UnitQuaternion::from_scaled_axis(motion("rotation", row.rotation)?),
        velocity: motion("velocity", row.velocity)?,
        angular_velocity: motion("angular_velocity", row.angular_velocity)?,
        friction,
        path,
    };
    if !body.path.is_empty() {
        let start = body.pose(0.0).0;
        if row.position.is_some() && (start - position).norm() > PATH_GAP {
            let problem = format!("{:?} is not where the path is at t = 0", position.as_slice());
            return Err(doc.error_accepting(
                &at.key("position"),
                problem,
                format!("{:?}, or no position", start.as_slice()),
            ));
        }
        body.position = start;
    }
    physics_of(&body).map_err(|problem| doc.error(&at.key("shape"), problem))?;
    Ok(body)
}

fn refuse_what_it_cannot_have(doc: &Document<'_>, at: &KeyPath, row: &BodyTable, kind: BodyKind) -> Result<(), Error> {
    let given = [
        ("mass", row.mass.is_some(), kind == BodyKind::Dynamic),
        ("density", row.density.is_some(), kind == BodyKind::Dynamic),
        ("inertia", row.inertia.is_some(), kind == BodyKind::Dynamic),
        ("velocity", row.velocity.is_some(), kind != BodyKind::Fixed),
        ("angular_velocity", row.angular_velocity.is_some(), kind != BodyKind::Fixed),
        ("path", row.path.is_some(), kind == BodyKind::Kinematic),
    ];
    let name = match kind {
        BodyKind::Dynamic => "dynamic",
        BodyKind::Fixed => "fixed",
        BodyKind::Kinematic => "kinematic",
    };
    if let Some((key, ..)) = given.iter().find(|(_, given, allowed)| *given && !allowed) {
        return Err(doc.error(&at.key(key), format!("a {name} body has no {key}")));
    }
    if row.path.is_some() && row.velocity.is_some() {
        return Err(doc.error(&at.key("velocity"), "the path says how fast the body is"));
    }
    Ok(())
}

fn shape_of(doc: &Document<'_>, at: &KeyPath, shape: &ShapeValue, folder: &Path) -> Result<BodyShape, Error> {
    let sizes = |key: &str, x: &[f64]| x.iter().try_for_each(|&x| real(doc, &at.key(key), x, |x| x > 0.0).map(|_| ()));
    Ok(match shape {
        ShapeValue::None => BodyShape::None,
        ShapeValue::Cuboid(half) => {
            sizes("cuboid", half)?;
            BodyShape::Cuboid(Vector3::from(*half))
        }
        ShapeValue::Ball(radius) => {
            sizes("ball", &[*radius])?;
            BodyShape::Ball(*radius)
        }
        ShapeValue::Cylinder(size) => {
            sizes("cylinder", size)?;
            BodyShape::Cylinder(*size)
        }
        ShapeValue::Capsule(size) => {
            sizes("capsule", size)?;
            BodyShape::Capsule(*size)
        }
        ShapeValue::Plane(normal) => {
            let at = at.key("plane");
            match reals(doc, &at, *normal)?.try_normalize(f64::MIN_POSITIVE) {
                Some(normal) => BodyShape::Plane(normal),
                None => return Err(doc.error(&at, format!("{normal:?} has no direction"))),
            }
        }
        ShapeValue::Mesh(file) => {
            mesh::read(&folder.join(file)).map_err(|problem| doc.error(&at.key("mesh"), problem))?
        }
    })
}

fn mass(
    doc: &Document<'_>,
    at: &KeyPath,
    row: &BodyTable,
    kind: BodyKind,
    shape: &BodyShape,
) -> Result<Option<BodyMass>, Error> {
    if kind != BodyKind::Dynamic {
        return Ok(None);
    }
    if matches!(shape, BodyShape::Plane(_)) {
        return Err(doc.error(&at.key("shape").key("plane"), "a half space has no mass"));
    }
    match (row.mass, row.density) {
        (Some(_), Some(_)) => Err(doc.error(&at.key("density"), "both mass and density are given")),
        (Some(mass), None) => real(doc, &at.key("mass"), mass, |x| x > 0.0).map(|mass| Some(BodyMass::Mass(mass))),
        (None, Some(_)) if *shape == BodyShape::None => {
            Err(doc.error(&at.key("density"), "a body without shape has no volume"))
        }
        (None, Some(density)) => {
            real(doc, &at.key("density"), density, |x| x > 0.0).map(|density| Some(BodyMass::Density(density)))
        }
        (None, None) => Err(missing(doc, &at.key("mass"))),
    }
}

fn inertia(doc: &Document<'_>, at: &KeyPath, value: Option<[f64; 3]>) -> Result<Option<Vector3<f64>>, Error> {
    let Some(moments) = value else { return Ok(None) };
    moments.iter().try_for_each(|&x| real(doc, at, x, |x| x > 0.0).map(|_| ()))?;
    let (sum, largest) = (moments.iter().sum::<f64>(), moments.iter().copied().fold(0.0, f64::max));
    if largest > (sum - largest) * (1.0 + 1e-6) {
        return Err(doc.error(at, format!("{moments:?}: no distribution of mass has such moments")));
    }
    Ok(Some(Vector3::from(moments)))
}

fn path(doc: &Document<'_>, at: &KeyPath, row: &BodyTable) -> Result<Vec<(f64, Vector3<f64>)>, Error> {
    let at = at.key("path");
    let Some(rows) = &row.path else { return Ok(Vec::new()) };
    if rows.is_empty() {
        return Err(doc.error(&at, "no row"));
    }
    let mut path: Vec<(f64, Vector3<f64>)> = Vec::new();
    for &[t, x, y, z] in rows {
        number(doc, &at, t, |_| true)?;
        if let Some((last, _)) = path.last()
            && t <= *last
        {
            return Err(doc.error(&at, format!("t = {t} comes after t = {last}")));
        }
        path.push((t, reals(doc, &at, [x, y, z])?));
    }
    Ok(path)
}

/// A number that stays what it is in Rapier's single precision: finite, and not zero if it was not.
fn real(doc: &Document<'_>, at: &KeyPath, x: f64, ok: impl Fn(f64) -> bool) -> Result<f64, Error> {
    number(doc, at, x, |x| ok(x) && f64::from(x as f32).is_finite() && ok(f64::from(x as f32)))
}

/// Three numbers that stay finite in Rapier's single precision.
pub(super) fn reals(doc: &Document<'_>, at: &KeyPath, x: [f64; 3]) -> Result<Vector3<f64>, Error> {
    vector(doc, at, x)?;
    x.iter().try_for_each(|&x| real(doc, at, x, |_| true).map(|_| ()))?;
    Ok(Vector3::from(x))
}
