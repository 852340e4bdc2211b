//! By how far the joints of a mechanism fail to hold its bodies together.
//!
//! # Equation
//! ```text
//! g = |P (x_b - x_a)|
//! ```
//! x_a and x_b are the anchors of a joint on its two bodies, and P projects on the axes that it
//! locks. Whatever moves the bodies, g = 0 is what the joint means: a gap is an error of position,
//! of one of the bodies at least, that no reference solution is needed for.
//!
//! # Validity
//! Joints as stiff as Rapier makes them by default, between bodies that no multibody holds. Rapier
//! solves joints one after the other, and keeps their impulses from step to step. Of two joints on
//! a link of mass m that carries a body of mass M each pass leaves the share M/(M + m) of the
//! error, so that a link with m << M needs some M/m passes, during which the body sinks.
//!
//! # References
//! Saad 2003, *Iterative methods for sparse linear systems*, section 4.2 (Gauss-Seidel).

use super::of_body::{Mechanism, Velocities};
use crate::body::unsettled::JointGap;
use crate::convert::{rotation, vector};
use crate::scales::HOST_ROUNDING;
use ::nalgebra::Vector3;
use rapier::dynamics::{ImpulseJoint, RigidBody};
use rapier::math::Real;
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

/// Returns the gap of a joint between two bodies.
fn gap(a: &RigidBody, b: &RigidBody, joint: &ImpulseJoint) -> JointGap {
    // one that is softer is meant to yield
    if joint.data.softness != SpringCoefficients::joint_defaults() {
        return JointGap::default();
    }
    let [first, second] = [(a, &joint.data.local_frame1), (b, &joint.data.local_frame2)].map(|(body, frame)| {
        let turn = rotation(*body.rotation());
        let arm = vector(frame.translation - body.local_center_of_mass());
        (vector(body.translation()) + turn * vector(frame.translation), turn * rotation(frame.rotation), arm.norm())
    });
    let apart = first.1.inverse() * (second.0 - first.0);
    let locked = |axis: usize| if joint.data.locked_axes.bits() & (1 << axis) != 0 { apart[axis] } else { 0.0 };
    let held = Vector3::new(locked(0), locked(1), locked(2));
    let rounding = HOST_ROUNDING * f64::from(Real::EPSILON) * first.0.amax().max(second.0.amax());
    let moving = |body: &RigidBody, arm: f64| if body.is_dynamic() { arm } else { 0.0 };
    JointGap { gap: (held.norm() - rounding).max(0.0), arm: moving(a, first.2).max(moving(b, second.2)) }
}
