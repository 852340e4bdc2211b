//! Geoms: their shape, place and mass.

use super::read::{Angles, to_axis};
use super::surface::Surface;
use super::tree::Element;
use crate::error::Error;
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Shapes about the origin, in m, the long axis along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    Sphere(f64),
    Capsule {
        radius: f64,
        half: f64,
    },
    Cylinder {
        radius: f64,
        half: f64,
    },
    Ellipsoid(Vector3<f64>),
    Box(Vector3<f64>),
    Plane,
    /// A mesh, a height field or a function of distance.
    Other,
}

/// A geom on its body.
pub(super) struct Geom {
    pub place: Isometry3<f64>,
    pub shape: Shape,
    /// Mass in kg, without a value if its volume is not known.
    pub mass: Option<f64>,
    pub surface: Surface,
}

impl Geom {
    /// Reads a geom; nothing touches if `off`.
    pub fn read(element: &Element, angles: &Angles, off: bool) -> Result<Self, Error> {
        let mut place = element.place("pos", angles)?;
        let mut size = element.list("size")?.unwrap_or_default();
        let kinds = ["sphere", "capsule", "cylinder", "ellipsoid", "box", "plane", "mesh", "hfield", "sdf"];
        let kind = element.word("type", &kinds)?;
        if let Some(ends) = element.list("fromto")? {
            let [a, b, c, d, e, f] = ends[..] else { return Err(element.wrong("fromto needs 6 numbers")) };
            let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
            let half = 0.5 * (to - from).norm();
            if half.is_nan() || half <= 0.0 {
                return Err(element.wrong("fromto has no length"));
            }
            place =
                Isometry3::from_parts(Translation3::from(0.5 * (from + to)), to_axis(&((to - from) / (2.0 * half))));
            let radius = size.first().copied().unwrap_or(0.0);
            size = if matches!(kind, "box" | "ellipsoid") { vec![radius, radius, half] } else { vec![radius, half] };
        }
        let shape = match (kind, &size[..]) {
            ("mesh" | "hfield" | "sdf", _) => Shape::Other,
            _ if element.has("mesh") || element.has("hfield") => Shape::Other,
            ("plane", _) => Shape::Plane,
            ("sphere", &[r, ..]) => Shape::Sphere(r),
            ("capsule", &[radius, half, ..]) => Shape::Capsule { radius, half },
            ("cylinder", &[radius, half, ..]) => Shape::Cylinder { radius, half },
            ("ellipsoid", &[a, b, c]) => Shape::Ellipsoid(Vector3::new(a, b, c)),
            ("box", &[a, b, c]) => Shape::Box(Vector3::new(a, b, c)),
            _ => return Err(element.wrong(format!("a {kind} of size {size:?}"))),
        };
        let needed = match shape {
            Shape::Sphere(_) => 1,
            Shape::Capsule { .. } | Shape::Cylinder { .. } => 2,
            Shape::Ellipsoid(_) | Shape::Box(_) => 3,
            Shape::Plane | Shape::Other => 0,
        };
        if let Some(bad) = size.iter().take(needed).find(|x| **x <= 0.0) {
            return Err(element.wrong(format!("size {bad} is not above 0")));
        }
        let density = element.number("density")?.unwrap_or(1000.0);
        let mass = element.number("mass")?.or(shape.volume().map(|volume| density * volume));
        if mass.is_some_and(|mass| mass < 0.0) {
            return Err(element.wrong("its mass is negative"));
        }
        Ok(Geom { place, shape, mass, surface: Surface::read(Some(element), off)? })
    }

    /// Returns the inertia about its centre in the axes of its body, in kg m^2.
    pub fn inertia(&self) -> Option<Matrix3<f64>> {
        let inertia = Matrix3::from_diagonal(&(self.shape.inertia()? * self.mass?));
        let turn = self.place.rotation.to_rotation_matrix();
        Some(turn * inertia * turn.inverse())
    }
}

impl Shape {
    fn volume(&self) -> Option<f64> {
        match *self {
            Shape::Sphere(r) => Some(4.0 / 3.0 * PI * r.powi(3)),
            Shape::Capsule { radius: r, half } => Some(PI * r * r * (2.0 * half + 4.0 / 3.0 * r)),
            Shape::Cylinder { radius: r, half } => Some(2.0 * PI * r * r * half),
            Shape::Ellipsoid(s) => Some(4.0 / 3.0 * PI * s.x * s.y * s.z),
            Shape::Box(s) => Some(8.0 * s.x * s.y * s.z),
            Shape::Plane => Some(0.0),
            Shape::Other => None,
        }
    }

    /// Returns the moments of inertia of a unit of mass, in m^2.
    fn inertia(&self) -> Option<Vector3<f64>> {
        let about = |x: f64, y: f64, z: f64| Vector3::new(y + z, x + z, x + y);
        match *self {
            Shape::Sphere(r) => Some(Vector3::repeat(0.4 * r * r)),
            Shape::Cylinder { radius: r, half } => Some(about(0.25 * r * r, 0.25 * r * r, half * half / 3.0)),
            Shape::Capsule { radius: r, half } => {
                // a cylinder, and two half balls whose centres of mass are 3/8 r beyond its ends
                let (cylinder, ball) = (2.0 * half, 4.0 / 3.0 * r);
                let across = cylinder * 0.25 * r * r + ball * 0.2 * r * r;
                let along = cylinder * half * half / 3.0 + ball * (half * half + 0.75 * half * r + 0.2 * r * r);
                Some(about(across, across, along) / (cylinder + ball))
            }
            Shape::Ellipsoid(s) => Some(about(s.x * s.x / 5.0, s.y * s.y / 5.0, s.z * s.z / 5.0)),
            Shape::Box(s) => Some(about(s.x * s.x / 3.0, s.y * s.y / 3.0, s.z * s.z / 3.0)),
            Shape::Plane => Some(Vector3::zeros()),
            Shape::Other => None,
        }
    }

    /// Returns the shape of a scene, and how it is turned: its capsules and cylinders lie along y.
    pub fn of_scene(&self) -> Option<(String, UnitQuaternion<f64>)> {
        let upright = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
        match *self {
            Shape::Sphere(r) => Some((format!("{{ ball = {r:?} }}"), UnitQuaternion::identity())),
            Shape::Capsule { radius, half } => Some((format!("{{ capsule = [{half:?}, {radius:?}] }}"), upright)),
            Shape::Cylinder { radius, half } => Some((format!("{{ cylinder = [{half:?}, {radius:?}] }}"), upright)),
            Shape::Box(s) => {
                Some((format!("{{ cuboid = [{:?}, {:?}, {:?}] }}", s.x, s.y, s.z), UnitQuaternion::identity()))
            }
            Shape::Plane => Some(("{ plane = [0.0, 0.0, 1.0] }".to_string(), UnitQuaternion::identity())),
            Shape::Ellipsoid(_) | Shape::Other => None,
        }
    }
}
