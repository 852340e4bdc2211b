//! Contact of a cable by itself: its obstacles, and what it touches. The colliders of a world are its obstacles there.

use super::Cable;
use crate::convert::{data, result, vector};
use crate::error::{Raise, raise};
use crate::quaternion;
use lariat_ancf::contact::{Ball, Capsule, Cuboid, Cylinder, HalfSpace, Obstacle, RigidMotion, Surface, Touch};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Contact, Error, Vector3};
use lariat_scene::scene::body::BodyShape;
use lariat_scene::view::capsule;
use nalgebra::{Isometry3, Quaternion, UnitQuaternion};
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// An obstacle, and the time in s at which it was set.
#[derive(Clone, Serialize, Deserialize)]
pub struct Laid {
    time: f64,
    parameters: Parameters,
}

/// Returns the obstacles, each with its index as key.
pub fn made(laid: &[Laid]) -> Result<Vec<Obstacle>, Raise> {
    laid.iter().enumerate().map(|(key, laid)| laid.parameters.clone().obstacle(key as u64, laid.time)).collect()
}

/// What `lariat.contact.Obstacle` holds.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    shape: String,
    size: Vec<f64>,
    position: [f64; 3],
    rotation: [f64; 4],
    velocity: [f64; 3],
    angular_velocity: [f64; 3],
    friction: f64,
    restitution: f64,
    skin: f64,
    except_at: Vec<[f64; 2]>,
}

fn invalid(what: &str, value: f64, expected: &'static str) -> Error {
    Error::InvalidValue { cable: None, what: what.to_string(), value, expected }
}

impl Laid {
    /// Returns where it is at a time in s, and what it looks like.
    pub fn look(&self, time: f64) -> (Isometry3<f64>, BodyShape) {
        let Parameters { shape, size, position, rotation, velocity, angular_velocity, .. } = &self.parameters;
        let passed = time - self.time;
        let place = Vector3::from(*position) + passed * Vector3::from(*velocity);
        let [x, y, z, w] = *rotation;
        let turned = UnitQuaternion::from_scaled_axis(passed * Vector3::from(*angular_velocity))
            * UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let at = Isometry3::from_parts(place.into(), turned);
        match (shape.as_str(), &size[..]) {
            ("half_space", &[x, y, z]) => (at, BodyShape::Plane(Vector3::new(x, y, z).normalize())),
            ("ball", &[radius]) => (at, BodyShape::Ball(radius)),
            ("cylinder", &[half_height, radius]) => (at, BodyShape::Cylinder([half_height, radius])),
            ("cuboid", &[x, y, z]) => (at, BodyShape::Cuboid(Vector3::new(x, y, z))),
            ("capsule", &[ax, ay, az, bx, by, bz, radius]) => {
                let (own, shape) = capsule([Vector3::new(ax, ay, az), Vector3::new(bx, by, bz)], radius);
                (at * own, shape)
            }
            _ => (at, BodyShape::None),
        }
    }
}

impl Parameters {
    fn surface(&self) -> Result<Arc<dyn Surface>, Raise> {
        let positive = |sizes: &[f64]| match sizes.iter().find(|x| !(x.is_finite() && **x > 0.0)) {
            Some(&x) => Err(Raise::from(invalid("size of an obstacle (m)", x, "> 0"))),
            None => Ok(()),
        };
        Ok(match (self.shape.as_str(), &self.size[..]) {
            ("half_space", &[x, y, z]) => {
                let normal = Vector3::new(x, y, z);
                let normal = normal.try_normalize(1e-9).filter(|n| n.iter().all(|x| x.is_finite()));
                let length = || Raise::from(invalid("length of the normal", self.size[0].hypot(y).hypot(z), "> 0"));
                Arc::new(HalfSpace { normal: normal.ok_or_else(length)? })
            }
            ("ball", &[radius]) => positive(&self.size).map(|()| Arc::new(Ball { radius }))?,
            ("cylinder", &[half_height, radius]) => {
                positive(&self.size).map(|()| Arc::new(Cylinder { half_height, radius }))?
            }
            ("cuboid", &[x, y, z]) => {
                positive(&self.size).map(|()| Arc::new(Cuboid { half_extents: Vector3::new(x, y, z) }))?
            }
            ("capsule", &[ax, ay, az, bx, by, bz, radius]) => {
                positive(&[radius])?;
                Arc::new(Capsule { ends: [Vector3::new(ax, ay, az), Vector3::new(bx, by, bz)], radius })
            }
            (shape, _) => return Err(Raise::new("BuilderError", format!("unknown shape of an obstacle: {shape:?}"))),
        })
    }

    fn obstacle(self, key: u64, time: f64) -> Result<Obstacle, Raise> {
        let [x, y, z, w] = self.rotation;
        let motion = RigidMotion {
            start: time,
            centre: Vector3::zeros(),
            position: self.position.into(),
            rotation: UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
            velocity: self.velocity.into(),
            angular_velocity: self.angular_velocity.into(),
        };
        let surface = self.surface()?;
        let Parameters { friction, restitution, skin, except_at: except, .. } = self;
        Ok(Obstacle { key, surface, motion, mount: None, friction, restitution, skin, except })
    }
}

/// Returns the effect of an object of `lariat.Contact`.
pub fn effect(object: &Bound<'_, PyAny>) -> PyResult<Option<Contact>> {
    if object.is_none() { Ok(None) } else { super::effects(object).map(|effects| effects.contact) }
}

/// Makes the Python object of a contact, with what is touched.
pub fn touch<'py>(py: Python<'py>, touch: &Touch, obstacle: Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let Touch { arc_length, normal, normal_force, friction, depth, slips, .. } = *touch;
    let values = (obstacle, arc_length, vector(py, &normal), normal_force, vector(py, &friction), depth, slips);
    result(py, "Touch", values)
}

#[pymethods]
impl Cable {
    /// Sets what the cable can touch from the next step on, in place of the obstacles it had; their
    /// velocities count from now. It touches them if it has the effect Contact. ``to_bytes``,
    /// ``copy`` and ``cut`` keep them. Raises InWorldError, InvalidValueError, BuilderError.
    fn set_obstacles(&self, py: Python<'_>, obstacles: &Bound<'_, PyAny>) -> PyResult<()> {
        let own = self.own("take obstacles of its own: the colliders of the world are its obstacles")?.clone();
        let wrong = |error: serde_json::Error| raise(Raise::new("BuilderError", error.to_string()));
        let parameters = obstacles.try_iter()?.map(|item| {
            let plain = py.import("lariat_cables.contact")?.getattr("plain")?.call1((item?,))?;
            serde_json::from_value::<Parameters>(data(&plain)?).map_err(wrong)
        });
        let parameters = parameters.collect::<PyResult<Vec<_>>>()?;
        parameters.iter().try_for_each(|own| quaternion::rotation(py, own.rotation).map(|_| ()))?;
        let time = own.with(py, |cable| cable.time());
        let laid: Vec<_> = parameters.into_iter().map(|parameters| Laid { time, parameters }).collect();
        let made = made(&laid).map_err(raise)?;
        self.change(py, |cable| cable.set_obstacles(made))?;
        self.obstacles.with(py, |own| *own = laid);
        Ok(())
    }

    /// Returns what the cable touched at the end of the last step, by the index of the obstacle.
    /// Raises InWorldError.
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        self.own("read its contacts by itself: see World.contacts")?;
        let touches = self.read(py, |cable| Ok(cable.contacts().collect::<Vec<_>>()))?;
        touches.iter().map(|t| touch(py, t, t.obstacle.into_pyobject(py)?.into_any())).collect()
    }

    /// Returns the energy in J that contacts store.
    fn contact_energy(&self, py: Python<'_>) -> PyResult<f64> {
        self.read(py, |cable| Ok(cable.contact_energy()))
    }
}
