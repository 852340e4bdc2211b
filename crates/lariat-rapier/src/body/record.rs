//! What the coupling keeps of each body between steps.

use crate::body::lost_spin::SpinWatch;
use crate::body::motion_memory::MotionMemory;
use crate::body::pose::{self, OriginPose};
use crate::body::unsettled::SettleWatch;
use crate::convert::{to_pose, vector};
use ::nalgebra::{UnitQuaternion, Vector3, Vector6};
use lariat_ancf::island::{BodyMemory, RigidBody};
use rapier::dynamics::{RigidBody as RapierBody, RigidBodyHandle, RigidBodyType};
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
    /// Whether Rapier has stepped it since it was attached: before, no pairs of colliders are
    /// listed.
    #[serde(default)]
    pub stepped: bool,
    /// Of a kinematic body, its motion in the last host step.
    #[serde(default)]
    pub motion: Option<MotionMemory>,
    /// Of a kinematic body, its place in `f64` beside the pose in Rapier that stands for it.
    #[serde(default)]
    pub place: Option<(Pose, OriginPose)>,
    /// Of a kinematic body, its place after the Rapier step in progress.
    #[serde(skip)]
    pub next_place: Option<OriginPose>,
    /// Of a body on joints, force in N and torque in N m of its cables, smoothed over the last
    /// steps.
    #[serde(default = "Vector6::zeros")]
    pub pull: Vector6<f64>,
    /// Of a body on joints, what Rapier made of its predictions.
    #[serde(default)]
    pub settling: SettleWatch,
    /// Of a body that Rapier moves by its velocity, what it does not carry out of its spin.
    #[serde(default)]
    pub spin: SpinWatch,
    /// Whether it is kinematic and has rotated: it then drives the cables on it.
    #[serde(default)]
    pub rotates: bool,
}

impl BodyRecord {
    /// A record of an unknown body.
    pub fn new(handle: RigidBodyHandle) -> Self {
        BodyRecord {
            handle,
            reaction: Vector6::zeros(),
            exact: None,
            stepped: false,
            motion: None,
            place: None,
            next_place: None,
            pull: Vector6::zeros(),
            settling: SettleWatch::default(),
            spin: SpinWatch::default(),
            rotates: false,
        }
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
    pose: Pose,
    linvel: Vector,
    angvel: AngVector,
}

impl ExactState {
    /// The state `end`, with the velocities that damping left of it, beside `body`, which holds it
    /// rounded.
    pub fn new(end: &RigidBody, (velocity, angular_velocity): (Vector3<f64>, Vector3<f64>), body: &RapierBody) -> Self {
        ExactState {
            position: end.position,
            rotation: end.rotation,
            velocity,
            angular_velocity,
            accelerations: end.memory,
            centre: body.local_center_of_mass(),
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
        if self.pose != *body.position() || self.centre != body.local_center_of_mass() {
            return;
        }
        out.position = self.position;
        out.rotation = self.rotation;
        out.memory = self.accelerations;
        if self.linvel == body.linvel() {
            out.velocity = self.velocity;
        }
        if self.angvel == body.angvel() {
            out.angular_velocity = self.angular_velocity;
        }
    }

    /// Sets the state to rest, as `body` is.
    pub fn stop(&mut self, body: &RapierBody) {
        (self.velocity, self.angular_velocity) = (Vector3::zeros(), Vector3::zeros());
        (self.linvel, self.angvel) = (body.linvel(), body.angvel());
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

    /// Returns the bodies that have a record: those that moved with cables in an earlier step.
    pub fn handles(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.0.iter().map(|record| record.handle)
    }

    /// Returns the record of a body.
    pub fn get(&self, body: RigidBodyHandle) -> Option<&BodyRecord> {
        self.find(body).ok().map(|i| &self.0[i])
    }

    /// Returns the estimate of the force and torque of contacts and joints on a body.
    pub fn reaction(&self, body: RigidBodyHandle) -> Vector6<f64> {
        self.get(body).map_or_else(Vector6::zeros, |record| record.reaction)
    }

    /// Returns the record of a body, to change it; a new one if there is none.
    pub fn record_mut(&mut self, body: RigidBodyHandle) -> &mut BodyRecord {
        let i = self.find(body).unwrap_or_else(|i| {
            self.0.insert(i, BodyRecord::new(body));
            i
        });
        &mut self.0[i]
    }

    /// Returns the place of the origin of a body, in `f64` where it is known and the user has not
    /// moved the body since.
    pub fn place(&self, world: &PhysicsWorld, handle: RigidBodyHandle) -> OriginPose {
        let pose = world.bodies[handle].position();
        let known = self.get(handle).and_then(|record| record.place);
        known.filter(|(rounded, _)| rounded == pose).map_or_else(|| pose::pose(world, handle), |(_, place)| place)
    }

    /// Returns by how much (m) an anchor on a body was rounded in a host step: of a body that the
    /// user moves to poses.
    pub fn rounding(&self, world: &PhysicsWorld, handle: RigidBodyHandle, anchor: &Vector3<f64>) -> f64 {
        let Some(body) = world.bodies.get(handle) else { return 0.0 };
        if body.body_type() != RigidBodyType::KinematicPositionBased {
            return 0.0;
        }
        let motion = self.get(handle).and_then(|record| record.motion);
        let (position, attitude) = motion.map_or((false, false), |motion| motion.is_rounded());
        let (distance, lever) = (vector(body.translation()).amax(), 2.0 * anchor.norm());
        let unit = 0.5 * f64::from(Real::EPSILON);
        unit * (if position { distance } else { 0.0 } + if attitude { lever } else { 0.0 })
    }

    /// Takes over where kinematic bodies went in a Rapier step: as prescribed, but for rounding.
    /// Rapier adds up the rounding of a body that it moves by its velocity; here it ends.
    pub fn follow_kinematic(&mut self, world: &mut PhysicsWorld) {
        for record in &mut self.0 {
            record.place = None;
            let Some(place) = record.next_place.take() else { continue };
            let Some(body) = world.bodies.get_mut(record.handle).filter(|body| body.is_kinematic()) else { continue };
            let rounded = to_pose(&place.0, &place.1);
            if body.body_type() == RigidBodyType::KinematicVelocityBased && *body.position() != rounded {
                body.set_position(rounded, false);
            }
            record.place = Some((*body.position(), place));
        }
    }

    /// What was due to be told of bodies has been.
    pub fn set_told(&mut self) {
        for record in &mut self.0 {
            record.settling.set_told();
            record.spin.set_told();
        }
    }

    /// Drops the records of bodies that are no longer in the world.
    pub fn retain_existing(&mut self, world: &PhysicsWorld) {
        self.0.retain(|record| world.bodies.contains(record.handle));
    }
}
