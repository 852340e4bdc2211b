//! By how far the joints of a mechanism fail to hold its bodies together.
//!
//! # Equation
//! ```text
//! g = max(|P (x_b - x_a)|, a |Q t|)
//! ```
//! x_a and x_b are the anchors of a joint on its two bodies, t the rotation of one against the
//! other, P and Q project on the axes that it locks, and a is the arm of the joint: so far is the
//! centre of a body off by it. Whatever moves the bodies, g = 0 is what the joint means: a gap is
//! an error of position, of one of the bodies at least, that no reference solution is needed for.
//!
//! # Validity
//! Joints as stiff as Rapier makes them by default, between bodies that no multibody holds. To what
//! gap they come where Rapier does not converge, is known before: [`super::joint_opening`].

use super::of_body::{Mechanism, Velocities};
use crate::body::unsettled::JointGap;
use crate::convert::{rotation, vector};
use crate::scales::HOST_ROUNDING;
use ::nalgebra::{UnitQuaternion, Vector3};
use rapier::dynamics::{ImpulseJoint, RigidBody};
use rapier::math::{Pose, Real};
use rapier::pipeline::PhysicsWorld;
use rapier::prelude::SpringCoefficients;

impl Mechanism {
    /// Returns the largest gap of its joints where its bodies are now.
    pub fn joint_gap(&self, world: &PhysicsWorld) -> JointGap {
        let mut largest = JointGap::default();
        let Velocities::OfBodies(bodies) = &self.before else { return largest };
        for (handle, ..) in bodies {
            for (a, b, _, joint) in world.impulse_joints.attached_enabled_joints(*handle) {
                let (Some(a), Some(b)) = (world.bodies.get(a), world.bodies.get(b)) else { continue };
                let found = gap(a, b, joint);
                if found.gap > largest.gap {
                    largest = found;
                }
            }
        }
        largest
    }
}

/// Returns whether a joint is not meant to yield.
pub(super) fn is_stiff(joint: &ImpulseJoint) -> bool {
    joint.data.softness == SpringCoefficients::joint_defaults()
}

/// Returns the largest distance in m of the anchors of a joint from the centres of those of its
/// bodies that move.
pub(super) fn arm(a: &RigidBody, b: &RigidBody, joint: &ImpulseJoint) -> f64 {
    let ends = [(a, joint.data.local_frame1), (b, joint.data.local_frame2)];
    let of = |(body, frame): (&RigidBody, Pose)| match body.is_dynamic() {
        true => vector(frame.translation - body.local_center_of_mass()).norm(),
        false => 0.0,
    };
    ends.map(of).into_iter().fold(0.0, f64::max)
}

/// Returns the gap of a joint between two bodies.
fn gap(a: &RigidBody, b: &RigidBody, joint: &ImpulseJoint) -> JointGap {
    if !is_stiff(joint) {
        return JointGap::default();
    }
    let [first, second] = [(a, &joint.data.local_frame1), (b, &joint.data.local_frame2)].map(|(body, frame)| {
        let turn = rotation(*body.rotation());
        (vector(body.translation()) + turn * vector(frame.translation), turn * rotation(frame.rotation))
    });
    let apart = first.1.inverse() * (second.0 - first.0);
    let locked = |axis: usize| if joint.data.locked_axes.bits() & (1 << axis) != 0 { apart[axis] } else { 0.0 };
    let held = Vector3::new(locked(0), locked(1), locked(2));
    let rounding = HOST_ROUNDING * f64::from(Real::EPSILON) * first.0.amax().max(second.0.amax());
    let arm = arm(a, b, joint);
    JointGap { gap: (held.norm() - rounding).max(arm * turn(first.1.inverse() * second.1, joint)).max(0.0), arm }
}

/// Returns by what angle in rad a joint is turned about the axes that it locks; 0 if it leaves more
/// than one free, since turns about two make one about the third.
fn turn(between: UnitQuaternion<f64>, joint: &ImpulseJoint) -> f64 {
    let locked = |axis: usize| joint.data.locked_axes.bits() & (1 << (3 + axis)) != 0;
    if (0..3).filter(|axis| locked(*axis)).count() < 2 {
        return 0.0;
    }
    let imaginary = Vector3::from_fn(|axis, _| if locked(axis) { between.coords[axis] } else { 0.0 });
    let rounding = HOST_ROUNDING * f64::from(Real::EPSILON);
    (2.0 * imaginary.norm() - rounding).max(0.0)
}
