//! Bodies of a world. The builders and views of `lariat.bodies`, which have the names of the `rapier3d` wheel, call these.

use super::colliders::ColliderParameters;
use super::{Contents, World};
use crate::convert::{Vector, data, vector};
use crate::error::{Raise, raise};
use crate::quaternion;
use lariat_ancf::{Error as CableError, Vector3};
use lariat_rapier::convert::{ToRapier, to_vector};
use lariat_rapier::rapier::dynamics::{RigidBodyBuilder, RigidBodyHandle, RigidBodyType};
use lariat_rapier::rapier::geometry::ColliderHandle;
use lariat_rapier::rapier::math::{Pose, Vector as Single};
use lariat_rapier::{Error, convert};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize;

/// Largest magnitude that bodies take: its square is within single precision.
const LARGEST: f64 = 1e15;

/// A handle, as (index, generation).
#[derive(Clone, Copy)]
pub struct Handle(pub RigidBodyHandle);

impl<'a, 'py> FromPyObject<'a, 'py> for Handle {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let (index, generation): (u32, u32) = object.extract()?;
        Ok(Handle(RigidBodyHandle::from_raw_parts(index, generation)))
    }
}

/// Returns the handle of a collider from (index, generation).
pub fn collider_handle((index, generation): (u32, u32)) -> ColliderHandle {
    ColliderHandle::from_raw_parts(index, generation)
}

/// Returns the exception of a number that is out of range.
pub fn invalid(what: &str, value: f64, expected: &'static str) -> PyErr {
    raise(CableError::InvalidValue { cable: None, what: what.to_string(), value, expected })
}

/// Returns a positive number in single precision.
pub fn positive(what: &str, value: f64) -> PyResult<f32> {
    let single = value as f32;
    if value <= LARGEST && single > 0.0 && single.is_normal() { Ok(single) } else { Err(invalid(what, value, "> 0")) }
}

/// Returns a number that is not negative, in single precision.
pub fn not_negative(what: &str, value: f64) -> PyResult<f32> {
    if (0.0..=LARGEST).contains(&value) { Ok(value as f32) } else { Err(invalid(what, value, ">= 0")) }
}

/// Returns a vector in single precision.
pub fn single(what: &str, v: Vector3<f64>) -> PyResult<Single> {
    match v.iter().find(|x| x.is_nan() || x.abs() > LARGEST) {
        None => Ok(to_vector(&v)),
        Some(&value) => Err(invalid(what, value, "within 1e15")),
    }
}

/// What a builder of a body collects.
#[derive(Deserialize, Default)]
#[serde(default, deny_unknown_fields)]
struct BodyParameters {
    body_type: String,
    translation: [f64; 3],
    rotation: [f64; 3],
    linvel: [f64; 3],
    angvel: [f64; 3],
    linear_damping: f64,
    angular_damping: f64,
    gravity_scale: Option<f64>,
    additional_mass: Option<f64>,
    can_sleep: Option<bool>,
    ccd_enabled: bool,
}

/// Returns what a builder collected.
pub fn parameters<T: for<'de> Deserialize<'de>>(dict: &Bound<'_, PyDict>) -> PyResult<T> {
    serde_json::from_value(data(dict)?).map_err(|error| raise(Raise::new("BuilderError", error.to_string())))
}

impl BodyParameters {
    fn builder(&self) -> PyResult<RigidBodyBuilder> {
        let body_type = match self.body_type.as_str() {
            "dynamic" => RigidBodyType::Dynamic,
            "fixed" => RigidBodyType::Fixed,
            "kinematic_position_based" => RigidBodyType::KinematicPositionBased,
            "kinematic_velocity_based" => RigidBodyType::KinematicVelocityBased,
            other => return Err(raise(Raise::new("BuilderError", format!("unknown body type {other:?}")))),
        };
        let mut builder = RigidBodyBuilder::new(body_type)
            .translation(single("translation (m)", self.translation.into())?)
            .rotation(single("rotation (rad)", self.rotation.into())?)
            .linvel(single("linvel (m/s)", self.linvel.into())?)
            .angvel(single("angvel (rad/s)", self.angvel.into())?)
            .linear_damping(not_negative("linear_damping (1/s)", self.linear_damping)?)
            .angular_damping(not_negative("angular_damping (1/s)", self.angular_damping)?)
            .can_sleep(self.can_sleep.unwrap_or(true))
            .ccd_enabled(self.ccd_enabled);
        if let Some(scale) = self.gravity_scale {
            builder = builder.gravity_scale(single("gravity_scale", Vector3::new(scale, 0.0, 0.0))?.x);
        }
        if let Some(mass) = self.additional_mass {
            builder = builder.additional_mass(positive("additional_mass (kg)", mass)?);
        }
        Ok(builder)
    }
}

/// The numbers of a body: pose, velocities, mass.
type BodyState<'py> = (
    Bound<'py, numpy::PyArray1<f64>>,
    [f64; 4],
    Bound<'py, numpy::PyArray1<f64>>,
    Bound<'py, numpy::PyArray1<f64>>,
    f64,
    bool,
);

impl Contents {
    fn body(&mut self, handle: Handle) -> Result<&mut lariat_rapier::rapier::dynamics::RigidBody, Error> {
        self.world.bodies.get_mut(handle.0).ok_or(Error::NoBody(handle.0))
    }
}

#[pymethods]
impl World {
    /// Inserts a body with its colliders.
    fn _add_body(
        &self,
        py: Python<'_>,
        body: &Bound<'_, PyDict>,
        colliders: Vec<Bound<'_, PyDict>>,
    ) -> PyResult<(u32, u32)> {
        let body = parameters::<BodyParameters>(body)?.builder()?;
        let colliders = colliders
            .iter()
            .map(|collider| parameters::<ColliderParameters>(collider)?.builder())
            .collect::<PyResult<Vec<_>>>()?;
        let handle = self.0.compute(py, |Contents { world, bodies, .. }| {
            let handle = world.insert_body(body);
            bodies.push(handle);
            for collider in colliders {
                world.insert_collider(collider, Some(handle));
            }
            world.bodies[handle].recompute_mass_properties_from_colliders(&world.colliders);
            handle
        });
        Ok(handle.into_raw_parts())
    }

    /// Adds a body with its colliders. Raises InvalidValueError, BuilderError.
    #[pyo3(signature = (builder, colliders=None))]
    fn add_body<'py>(
        slf: &Bound<'py, Self>,
        builder: &Bound<'py, PyAny>,
        colliders: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let colliders = colliders.unwrap_or_else(|| pyo3::types::PyList::empty(py).into_any());
        py.import("lariat_cables.bodies")?.getattr("add")?.call1((slf, builder, colliders))
    }

    /// The bodies, by handle.
    #[getter]
    fn rigid_bodies<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("lariat_cables.bodies")?.getattr("RigidBodySet")?.call1((slf,))
    }

    /// Removes a body with its colliders; attachments to it end at the next step. Raises
    /// NoBodyError.
    fn remove_body(&self, py: Python<'_>, handle: Handle) -> PyResult<()> {
        let removed = self.0.compute(py, |Contents { world, bodies, .. }| {
            bodies.retain(|body| *body != handle.0);
            world.remove_body(handle.0).map(|_| ())
        });
        removed.ok_or_else(|| raise(Error::NoBody(handle.0)))
    }

    /// Moves bodies by ``translation`` (m) after a turn by the rotation vector ``rotation`` (rad)
    /// about the origin, in world axes, with the cables that are attached to them and those tied to
    /// these: a teleport without a jolt. Velocities turn with them, strains and tensions stay;
    /// contacts begin anew. Raises HeldInMoveError, JointInMoveError, NoBodyError, OtherWorldError,
    /// InvalidValueError; nothing has moved then.
    #[pyo3(signature = (bodies, translation=None, rotation=None))]
    fn move_bodies(
        &self,
        py: Python<'_>,
        bodies: Vec<Handle>,
        translation: Option<Vector>,
        rotation: Option<Vector>,
    ) -> PyResult<()> {
        let read = |what: &str, v: Option<Vector>| single(what, v.map_or_else(Vector3::zeros, |v| v.0));
        let (way, turn) = (read("translation (m)", translation)?, read("rotation (rad)", rotation)?);
        let bodies: Vec<RigidBodyHandle> = bodies.into_iter().map(|body| body.0).collect();
        let moved =
            self.0.compute(py, |Contents { world, set, .. }| set.move_bodies(world, &bodies, &Pose::new(way, turn)));
        moved.map_err(raise)
    }

    /// Handles of all bodies that the user added.
    fn _handles(&self, py: Python<'_>) -> Vec<(u32, u32)> {
        self.0.with(py, |contents| contents.bodies.iter().map(|handle| handle.into_raw_parts()).collect())
    }

    /// Translation, rotation (x, y, z, w), velocities, mass and sleep of a body.
    fn _body<'py>(&self, py: Python<'py>, handle: Handle) -> PyResult<BodyState<'py>> {
        let state = self.0.with(py, |contents| {
            let body = contents.body(handle)?;
            let rotation = convert::rotation(*body.rotation());
            let [position, velocity, spin] = [body.translation(), body.linvel(), body.angvel()].map(convert::vector);
            Ok((position, rotation, velocity, spin, f64::from(body.mass()), body.is_sleeping()))
        });
        let (position, q, velocity, spin, mass, asleep) = state.map_err(raise::<Error>)?;
        let [position, velocity, spin] = [position, velocity, spin].map(|v| vector(py, &v));
        Ok((position, [q.i, q.j, q.k, q.w], velocity, spin, mass, asleep))
    }

    /// Sets a vector of a body, or applies one, by its name in the `rapier3d` wheel.
    fn _set_body(&self, py: Python<'_>, handle: Handle, what: &str, value: Vector) -> PyResult<()> {
        let value = single(what, value.0)?;
        let known = self.0.compute(py, |contents| {
            let body = contents.body(handle)?;
            match what {
                "translation" => body.set_translation(value, true),
                "linvel" => body.set_linvel(value, true),
                "angvel" => body.set_angvel(value, true),
                "next_kinematic_translation" => body.set_next_kinematic_translation(value),
                "add_force" => body.add_force(value, true),
                "add_torque" => body.add_torque(value, true),
                "apply_impulse" => body.apply_impulse(value, true),
                "apply_torque_impulse" => body.apply_torque_impulse(value, true),
                _ => return Ok(false),
            }
            Ok(true)
        });
        if known.map_err(raise::<Error>)? { Ok(()) } else { Err(raise(Raise::new("BuilderError", what))) }
    }

    /// Sets the rotation (x, y, z, w) of a body, at once or at the end of the next step of a kinematic one.
    fn _set_rotation(&self, py: Python<'_>, handle: Handle, q: [f64; 4], next: bool) -> PyResult<()> {
        let rotation = quaternion::rotation(py, q)?.to_rapier();
        let set = self.0.compute(py, |contents| {
            let body = contents.body(handle)?;
            if next {
                body.set_next_kinematic_rotation(rotation);
            } else {
                body.set_rotation(rotation, true);
            }
            Ok(())
        });
        set.map_err(raise::<Error>)
    }

    /// Removes the forces and torques of the user.
    fn _reset_forces(&self, py: Python<'_>, handle: Handle) -> PyResult<()> {
        let reset = self.0.compute(py, |contents| {
            let body = contents.body(handle)?;
            body.reset_forces(true);
            body.reset_torques(true);
            Ok(())
        });
        reset.map_err(raise::<Error>)
    }
}
