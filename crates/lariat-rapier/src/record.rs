//! What the coupling keeps of each body between steps.

use crate::step::prescribed_motion::MotionMemory;
use ::nalgebra::{UnitQuaternion, Vector3, Vector6};
use lariat_ancf::island::{BodyMemory, RigidBody};
use rapier::dynamics::{RigidBody as RapierBody, RigidBodyHandle};
use rapier::math::{AngVector, Pose, Real, Vector};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// What the coupling keeps of a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct BodyRecord {
    pub handle: RigidBodyHandle,
    /// Estimate of the force and torque of contacts and joints, in N and N m.
    pub reaction: Vector6<f64>,
    /// The state in `f64`, valid as long as Rapier's copy is the one that was written last.
    pub exact: Option<ExactState>,
    /// Whether Rapier has stepped it since it was attached: before, no pairs of colliders are listed.
    #[serde(default)]
    pub stepped: bool,
    /// Of a kinematic body, its motion in the last host step.
    #[serde(default)]
    pub motion: Option<MotionMemory>,
    /// Whether it is kinematic and has rotated: it then drives the cables on it.
    #[serde(default)]
    pub rotates: bool,
}

impl BodyRecord {
    /// A record of an unknown body.
    pub fn new(handle: RigidBodyHandle) -> Self {
        BodyRecord { handle, reaction: Vector6::zeros(), exact: None, stepped: false, motion: None, rotates: false }
    }
}

/// A body's state in `f64` beside the rounded state in Rapier that stands for it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct ExactState {
    pub position: Vector3<f64>,
    pub rotation: UnitQuaternion<f64>,
    pub velocity: Vector3<f64>,
    pub angular_velocity: Vector3<f64>,
    /// Accelerations at the end of the step that produced this state.
    pub accelerations: Option<BodyMemory>,
    centre: Vector,
    inverse_mass: Real,
    pose: Pose,
    linvel: Vector,
    angvel: AngVector,
}

impl ExactState {
    /// The state `end`, with the velocities that damping left of it, beside `body`, which holds it
    /// rounded.
    pub fn new(
        end: &RigidBody,
        (velocity, angular_velocity): (Vector3<f64>, Vector3<f64>),
        centre: Vector,
        body: &RapierBody,
    ) -> Self {
        ExactState {
            position: end.position,
            rotation: end.rotation,
            velocity,
            angular_velocity,
            accelerations: end.memory,
            centre,
            inverse_mass: body.mass_properties().local_mprops.inv_mass,
            pose: *body.position(),
            linvel: body.linvel(),
            angvel: body.angvel(),
        }
    }

    /// Returns the rounded position and attitude.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Replaces what `out` reads of `body` by this state, as far as `body` is still as it was
    /// written.
    pub fn apply_to(&self, body: &RapierBody, out: &mut RigidBody) {
        if self.pose != *body.position()
            || self.centre != body.local_center_of_mass()
            || self.inverse_mass != body.mass_properties().local_mprops.inv_mass
        {
            return;
        }
        out.position = self.position;
        out.rotation = self.rotation;
        let (linear, angular) = (self.linvel == body.linvel(), self.angvel == body.angvel());
        if linear {
            out.velocity = self.velocity;
        }
        if angular {
            out.angular_velocity = self.angular_velocity;
        }
        out.memory = self.accelerations.filter(|_| linear && angular);
    }

    /// Sets the state to rest, as `body` is.
    pub fn stop(&mut self, body: &RapierBody) {
        (self.velocity, self.angular_velocity) = (Vector3::zeros(), Vector3::zeros());
        (self.linvel, self.angvel) = (body.linvel(), body.angvel());
        self.accelerations = None;
    }

    /// Returns the position of a point given in body axes from the centre of mass.
    pub fn point(&self, local: &Vector3<f64>) -> Vector3<f64> {
        self.position + self.rotation * local
    }
}

/// Records of bodies, in ascending order of their handles.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Records(Vec<BodyRecord>);

impl Records {
    fn find(&self, body: RigidBodyHandle) -> Result<usize, usize> {
        self.0.binary_search_by_key(&body.into_raw_parts(), |record| record.handle.into_raw_parts())
    }

    /// Returns the record of a body.
    pub fn get(&self, body: RigidBodyHandle) -> Option<&BodyRecord> {
        self.find(body).ok().map(|i| &self.0[i])
    }

    /// Returns the record of a body, to change it; a new one if there is none.
    pub fn record_mut(&mut self, body: RigidBodyHandle) -> &mut BodyRecord {
        let i = self.find(body).unwrap_or_else(|i| {
            self.0.insert(i, BodyRecord::new(body));
            i
        });
        &mut self.0[i]
    }

    /// Drops the records of bodies that are no longer in the world.
    pub fn retain_existing(&mut self, world: &PhysicsWorld) {
        self.0.retain(|record| world.bodies.contains(record.handle));
    }
}
