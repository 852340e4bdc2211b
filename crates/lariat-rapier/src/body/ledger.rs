//! The ledger of an attachment: a heavy body and motors through which a body feels its cable within
//! Rapier's step.
//!
//! # Equation
//! ```text
//! motor over a step h:  p = D (v_target - mean velocity of the anchor) + F h     D = damping h
//! ledger of mass M:     p = -M v_ledger
//! ```
//! A `ForceBased` motor of stiffness 0 and damping d acts over Rapier's substeps as the impulse `d
//! h (target - mean velocity)`. The ledger takes the opposite impulse, so that its velocity after
//! the step tells the total impulse p; the impulse that Rapier reports is that of its last substep.
//!
//! *Sleep.* Rapier may wake a body within its step: a contact begins, what it stands on is removed,
//! a joint changes. The motors of a sleeping body therefore exert the force F and the moment of its
//! cable: Rapier does not solve them while the body sleeps, and gives them to it in the very step
//! in which it wakes. A force is a motor too: target F/damping beside v_target.
//!
//! # Validity
//! The ledger must be the first body of the joint: with free linear axes Rapier takes the anchor of
//! the second frame as lever of both bodies.

use crate::convert::{to_pose, to_vector, vector};
use crate::scales::body::{FORCE_TARGET, LEDGER_MASS, LEDGER_SHARE, MIN_MOTOR_DAMPING};
use ::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use rapier::dynamics::{
    GenericJointBuilder, ImpulseJointHandle, JointAxesMask, JointAxis, MotorModel, RigidBody, RigidBodyBuilder,
    RigidBodyHandle,
};
use rapier::math::{Real, Vector};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

const AXES: [JointAxis; 3] = [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ];
const ANGULAR_AXES: [JointAxis; 3] = [JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ];

/// The heavy body of an attachment and the joint whose motors act on the attached body.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Ledger {
    pub body: RigidBodyHandle,
    joint: ImpulseJointHandle,
    /// Force in N that the motors exert on a sleeping body should it wake up, and the step in s
    /// that their impedance is for; `None` while it is awake.
    #[serde(default)]
    pub rest: Option<(Vector3<f64>, f64)>,
}

/// What the motors of a ledger do in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive {
    /// Impedance in kg about the velocity `target`.
    pub impedance: Matrix3<f64>,
    /// Velocity of the anchor in m/s.
    pub target: Vector3<f64>,
    /// Force in N and moment in N m on a sleeping body.
    pub load: Option<[Vector3<f64>; 2]>,
}

/// Returns whether a body is the ledger of an attachment, and so none of the user's.
pub(crate) fn is_ledger(body: &RigidBody) -> bool {
    f64::from(body.mass()) >= LEDGER_SHARE * LEDGER_MASS
}

impl Ledger {
    /// Adds a ledger for a body to the world; it sleeps if that does.
    pub fn insert(world: &mut PhysicsWorld, attached: RigidBodyHandle) -> Ledger {
        let asleep = world.bodies.get(attached).is_some_and(RigidBody::is_sleeping);
        let body = RigidBodyBuilder::dynamic().gravity_scale(0.0).additional_mass(LEDGER_MASS as Real);
        let body = world.insert_body(body.lock_rotations().sleeping(asleep));
        let joint = GenericJointBuilder::new(JointAxesMask::empty());
        let joint = world.impulse_joints.insert(body, attached, joint, !asleep);
        Ledger { body, joint, rest: None }
    }

    /// Returns a ledger of a sleeping body that sleeps with it: this one if it fell asleep with the
    /// body, else a new one, since an awake one would wake it.
    pub fn asleep(self, world: &mut PhysicsWorld, attached: RigidBodyHandle) -> Ledger {
        let linked = world.impulse_joints.get(self.joint).is_some_and(|joint| joint.data.is_enabled());
        if linked && world.bodies.get(self.body).is_some_and(RigidBody::is_sleeping) {
            return self;
        }
        world.impulse_joints.remove(self.joint, false);
        world.remove_body(self.body);
        Ledger::insert(world, attached)
    }

    /// Sets the motors at the point `anchor` (m) of the body for a step of `h` (s).
    pub fn set_motors(&mut self, world: &mut PhysicsWorld, anchor: &Vector3<f64>, drive: &Drive, h: f64) {
        if let Some(body) = world.bodies.get_mut(self.body) {
            body.set_linvel(Vector::ZERO, false);
            body.reset_forces(false);
        }
        let d = &drive.impedance;
        let eigen = ((d + d.transpose()) * 0.5).symmetric_eigen();
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        let frame = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let target = frame.inverse() * drive.target;
        self.rest = drive.load.map(|[force, _]| (force, h));
        let Some(joint) = world.impulse_joints.get_mut(self.joint, false) else { return };
        let data = &mut joint.data;
        data.set_enabled(true);
        data.set_local_frame1(to_pose(&Vector3::zeros(), &frame));
        data.set_local_anchor2(to_vector(anchor));
        let [force, moment] = drive.load.unwrap_or_default().map(|v| frame.inverse() * v);
        data.motor_axes = JointAxesMask::empty();
        let mut set = |axis, target: f64, damping: f64| {
            if damping > MIN_MOTOR_DAMPING {
                data.set_motor_model(axis, MotorModel::ForceBased);
                data.set_motor(axis, 0.0, target as Real, 0.0, damping as Real);
            }
        };
        for i in 0..3 {
            let damping = (eigen.eigenvalues[i] / h).max(force[i].abs() / FORCE_TARGET);
            set(AXES[i], target[i] + force[i] / damping.max(MIN_MOTOR_DAMPING), damping);
            set(ANGULAR_AXES[i], FORCE_TARGET.copysign(moment[i]), moment[i].abs() / FORCE_TARGET);
        }
    }

    /// Disables the motors.
    pub fn disable(&self, world: &mut PhysicsWorld) {
        if world.impulse_joints.get(self.joint).is_some_and(|j| j.data.is_enabled())
            && let Some(joint) = world.impulse_joints.get_mut(self.joint, false)
        {
            joint.data.set_enabled(false);
        }
    }

    /// Returns the impulse in N s of the motors on the attached body over the last step of `h` (s),
    /// without that of the rest force, and stops the ledger. A body that slept felt none.
    pub fn take_impulse(&self, world: &mut PhysicsWorld, h: f64) -> Vector3<f64> {
        let Some(body) = world.bodies.get(self.body) else { return Vector3::zeros() };
        if body.is_sleeping() {
            return Vector3::zeros();
        }
        let impulse = -vector(body.linvel()) * LEDGER_MASS;
        world.bodies[self.body].set_linvel(Vector::ZERO, false);
        impulse - self.rest.map_or_else(Vector3::zeros, |(force, _)| force * h)
    }
}
