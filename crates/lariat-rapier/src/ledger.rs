//! The ledger of an attachment: a heavy body and motors through which a body feels its cable within
//! Rapier's step.
//!
//! # Equation
//! ```text
//! motor over a step h:  p = D (v_target - mean velocity of the anchor)      D = damping h
//! ledger of mass M:     p = -M v_ledger
//! ```
//! A `ForceBased` motor of stiffness 0 and damping d acts over Rapier's substeps as the impulse `d
//! h (target - mean velocity)`. The ledger takes the opposite impulse, so that its velocity after
//! the step tells the total impulse p; the impulse that Rapier reports is that of its last substep.
//!
//! # Validity
//! The ledger must be the first body of the joint: with free linear axes Rapier takes the anchor of
//! the second frame as lever of both bodies.

use crate::convert::{to_pose, to_vector, vector};
use ::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use rapier::dynamics::{
    GenericJointBuilder, ImpulseJointHandle, JointAxesMask, JointAxis, MotorModel, RigidBody, RigidBodyBuilder,
    RigidBodyHandle,
};
use rapier::math::{Real, Vector};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// Mass of a ledger in kg.
const LEDGER_MASS: f64 = 1e9;
const AXES: [JointAxis; 3] = [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ];

/// The heavy body of an attachment and the joint whose motors act on the attached body.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Ledger {
    pub body: RigidBodyHandle,
    joint: ImpulseJointHandle,
}

/// Returns whether a body is the ledger of an attachment, and so none of the user's.
pub(crate) fn is_ledger(body: &RigidBody) -> bool {
    f64::from(body.mass()) >= 0.5 * LEDGER_MASS
}

impl Ledger {
    /// Adds a ledger for a body to the world.
    pub fn insert(world: &mut PhysicsWorld, attached: RigidBodyHandle) -> Ledger {
        let body = world.insert_body(
            RigidBodyBuilder::dynamic().gravity_scale(0.0).additional_mass(LEDGER_MASS as Real).lock_rotations(),
        );
        let mut joint = GenericJointBuilder::new(JointAxesMask::empty());
        for axis in AXES {
            joint = joint.motor_model(axis, MotorModel::ForceBased);
        }
        Ledger { body, joint: world.insert_impulse_joint(body, attached, joint) }
    }

    /// Sets the motors for a step of `h` (s): impedance `d` (kg) about the velocity `target` (m/s)
    /// of the point `anchor` (m) of the body.
    pub fn set_motors(
        &self,
        world: &mut PhysicsWorld,
        anchor: &Vector3<f64>,
        d: &Matrix3<f64>,
        target: &Vector3<f64>,
        h: f64,
    ) {
        if let Some(body) = world.bodies.get_mut(self.body) {
            body.set_linvel(Vector::ZERO, false);
            body.reset_forces(false);
        }
        let eigen = ((d + d.transpose()) * 0.5).symmetric_eigen();
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        let frame = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let target = frame.inverse() * target;
        if let Some(joint) = world.impulse_joints.get_mut(self.joint, false) {
            joint.data.set_enabled(true);
            joint.data.set_local_frame1(to_pose(&Vector3::zeros(), &frame));
            joint.data.set_local_anchor2(to_vector(anchor));
            for (i, axis) in AXES.into_iter().enumerate() {
                let damping = eigen.eigenvalues[i].max(0.0) / h;
                joint.data.set_motor(axis, 0.0, target[i] as Real, 0.0, damping as Real);
            }
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

    /// Returns the impulse of the motors on the attached body over the last step, in N s, and stops
    /// the ledger.
    pub fn take_impulse(&self, world: &mut PhysicsWorld) -> Vector3<f64> {
        let Some(body) = world.bodies.get_mut(self.body) else { return Vector3::zeros() };
        let impulse = -vector(body.linvel()) * LEDGER_MASS;
        body.set_linvel(Vector::ZERO, false);
        impulse
    }
}
