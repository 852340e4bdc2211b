//! Joints of a world, by the names of the `rapier3d` wheel; the builders are in `lariat.joints`.

use super::World;
use super::bodies::{Handle, invalid, not_negative, parameters, positive, single};
use crate::error::{Raise, raise};
use lariat_ancf::Vector3;
use lariat_rapier::Error;
use lariat_rapier::rapier::dynamics::{
    FixedJointBuilder, GenericJoint, ImpulseJointHandle, JointAxis, MultibodyJointHandle, PrismaticJointBuilder,
    RevoluteJointBuilder, RopeJointBuilder, SphericalJointBuilder, SpringJointBuilder,
};
use lariat_rapier::rapier::math::Vector as Single;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize;

/// What a builder of a joint collects.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    joint: String,
    #[serde(default)]
    size: Vec<f64>,
    #[serde(default)]
    local_anchor1: [f64; 3],
    #[serde(default)]
    local_anchor2: [f64; 3],
    limits: Option<[f64; 2]>,
    motor: Option<[f64; 4]>,
    motor_max_force: Option<f64>,
    contacts_enabled: Option<bool>,
}

impl Parameters {
    fn axis(&self) -> PyResult<Single> {
        let [x, y, z] = self.size[..] else { return Err(raise(Raise::new("BuilderError", "an axis is a vector"))) };
        let axis = Vector3::new(x, y, z);
        let unit = axis.try_normalize(1e-9).filter(|unit| unit.iter().all(|x| x.is_finite()));
        single("axis", unit.ok_or_else(|| invalid("length of the axis", axis.norm(), "> 0"))?)
    }

    /// Returns the joint, and the axis that limits and motors act on.
    fn build(&self) -> PyResult<GenericJoint> {
        let mut of = None;
        let mut joint: GenericJoint = match (self.joint.as_str(), &self.size[..]) {
            ("fixed", []) => FixedJointBuilder::new().into(),
            ("spherical", []) => SphericalJointBuilder::new().into(),
            ("revolute", _) => {
                of = Some(JointAxis::AngX);
                RevoluteJointBuilder::new(self.axis()?).into()
            }
            ("prismatic", _) => {
                of = Some(JointAxis::LinX);
                PrismaticJointBuilder::new(self.axis()?).into()
            }
            ("rope", &[longest]) => RopeJointBuilder::new(positive("max_distance (m)", longest)?).into(),
            ("spring", &[rest, stiffness, damping]) => SpringJointBuilder::new(
                not_negative("rest_length (m)", rest)?,
                not_negative("stiffness (N/m)", stiffness)?,
                not_negative("damping (N s/m)", damping)?,
            )
            .into(),
            (joint, _) => return Err(raise(Raise::new("BuilderError", format!("unknown joint {joint:?}")))),
        };
        joint.set_local_anchor1(single("local_anchor1 (m)", self.local_anchor1.into())?);
        joint.set_local_anchor2(single("local_anchor2 (m)", self.local_anchor2.into())?);
        if let Some(enabled) = self.contacts_enabled {
            joint.set_contacts_enabled(enabled);
        }
        let needs_axis = self.limits.is_some() || self.motor.is_some() || self.motor_max_force.is_some();
        let axis = match of {
            Some(axis) => axis,
            None if needs_axis => {
                let message = format!("a {} joint has no axis for limits or a motor", self.joint);
                return Err(raise(Raise::new("BuilderError", message)));
            }
            None => return Ok(joint),
        };
        if let Some([least, most]) = self.limits {
            let limits = single("limits (m, rad)", Vector3::new(least, most, 0.0))?;
            if limits.x > limits.y {
                return Err(invalid("upper limit (m, rad)", most, "at least the lower limit"));
            }
            joint.set_limits(axis, [limits.x, limits.y]);
        }
        if let Some([position, velocity, stiffness, damping]) = self.motor {
            let target = single("target of the motor (m, rad; m/s, rad/s)", Vector3::new(position, velocity, 0.0))?;
            let stiffness = not_negative("stiffness of the motor", stiffness)?;
            let damping = not_negative("damping of the motor", damping)?;
            joint.set_motor(axis, target.x, target.y, stiffness, damping);
        }
        if let Some(most) = self.motor_max_force {
            joint.set_motor_max_force(axis, not_negative("motor_max_force (N, N m)", most)?);
        }
        Ok(joint)
    }
}

fn no_joint() -> PyErr {
    raise(Raise::new("NoJointError", "no such joint in this world"))
}

#[pymethods]
impl World {
    /// The impulse joints, by handle.
    #[getter]
    fn impulse_joints<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("lariat_cables.joints")?.getattr("ImpulseJointSet")?.call1((slf,))
    }

    /// The multibody joints, by handle.
    #[getter]
    fn multibody_joints<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("lariat_cables.joints")?.getattr("MultibodyJointSet")?.call1((slf,))
    }

    /// Inserts a joint between two bodies.
    fn _insert_joint(
        &self,
        py: Python<'_>,
        first: Handle,
        second: Handle,
        joint: &Bound<'_, PyDict>,
        multibody: bool,
    ) -> PyResult<(u32, u32)> {
        let joint = parameters::<Parameters>(joint)?.build()?;
        if first.0 == second.0 {
            return Err(raise(Raise::new("BuilderError", "a joint connects two bodies, got the same twice")));
        }
        let made = self.0.compute(py, |contents| {
            for body in [first, second] {
                contents.world.bodies.get(body.0).ok_or(Error::NoBody(body.0))?;
            }
            let world = &mut contents.world;
            Ok(if multibody {
                let links = world.bodies.get(second.0).is_some_and(|body| body.is_dynamic());
                let made = links.then(|| world.multibody_joints.insert(first.0, second.0, joint, true)).flatten();
                made.map(|handle| handle.0.into_raw_parts())
            } else {
                Some(world.insert_impulse_joint(first.0, second.0, joint).0.into_raw_parts())
            })
        });
        made.map_err(raise::<Error>)?.ok_or_else(|| {
            let message =
                "a multibody joint needs a dynamic second body that no other multibody joint holds, and no loop";
            raise(Raise::new("BuilderError", message))
        })
    }

    /// Removes a joint.
    fn _remove_joint(&self, py: Python<'_>, handle: (u32, u32), multibody: bool) -> PyResult<()> {
        let index = lariat_rapier::rapier::data::Index::from_raw_parts(handle.0, handle.1);
        let removed = self.0.compute(py, |contents| {
            let world = &mut contents.world;
            if multibody {
                let handle = MultibodyJointHandle(index);
                let known = world.multibody_joints.get(handle).is_some();
                if known {
                    world.remove_multibody_joint(handle);
                }
                known
            } else {
                world.remove_impulse_joint(ImpulseJointHandle(index)).is_some()
            }
        });
        if removed { Ok(()) } else { Err(no_joint()) }
    }

    /// Handles of all joints of a kind, each with its bodies.
    fn _joints(&self, py: Python<'_>, multibody: bool) -> Vec<[(u32, u32); 3]> {
        self.0.with(py, |contents| {
            let world = &contents.world;
            if multibody {
                let all = world.multibody_joints.iter().filter_map(|(handle, _, bodies, link)| {
                    let parent = bodies.link(link.parent_id()?)?.rigid_body_handle();
                    Some([
                        handle.0.into_raw_parts(),
                        parent.into_raw_parts(),
                        link.rigid_body_handle().into_raw_parts(),
                    ])
                });
                all.collect()
            } else {
                let all = world.impulse_joints.iter();
                all.map(|(handle, joint)| {
                    [handle.0.into_raw_parts(), joint.body1().into_raw_parts(), joint.body2().into_raw_parts()]
                })
                .collect()
            }
        })
    }
}
