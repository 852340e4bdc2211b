//! Limits of joints at which a mechanism stands: they hold as long as the load pushes against them.
//!
//! A limit counts as reached within [`NEAR`] of it, unless the joint leaves it faster than [`OPENING`]. Rapier holds a limit only in
//! substeps that begin beyond it, or at it, so where it stands is told by its place; what it pushes with is not asked: a mechanism whose
//! loads the prediction bears presses on nothing. *Measured* (an arm of three links of 1 kg on a soft rope, struck with 0.5 N s, host steps of
//! 1/30 s with one iteration to 1/240 s with four): a joint that comes to rest 1e-4 before or behind its limit is taken for free in one step and for
//! held in the next, and the rope carries 12.5 to 14.4 N for 14.7 with `NEAR` 1e-4 and `OPENING` 1e-2; 14.6 to 14.8 N with 1e-3 and 0.1; with 1
//! it chatters (5 to 24 N).

use crate::convert::{rotation, vector};
use rapier::dynamics::{ImpulseJoint, JointLimits};
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// In m or rad.
const NEAR: f64 = 1e-3;
/// In m/s or rad/s.
const OPENING: f64 = 0.1;

/// Place of a joint along or about an axis, as Rapier's limits see it.
fn coordinate(world: &PhysicsWorld, joint: &ImpulseJoint, axis: usize) -> Option<f64> {
    let (a, b) = (world.bodies.get(joint.body1())?, world.bodies.get(joint.body2())?);
    let (one, two) = (*a.position() * joint.data.local_frame1, *b.position() * joint.data.local_frame2);
    let basis = rotation(one.rotation);
    Some(if axis < 3 {
        (basis.inverse() * (vector(two.translation) - vector(one.translation)))[axis]
    } else {
        let turn = basis.inverse() * rotation(two.rotation);
        let angle = 2.0 * turn.coords[axis - 3].atan2(turn.w);
        angle - core::f64::consts::TAU * (angle / core::f64::consts::TAU).round()
    })
}

/// Rate of a joint's coordinate.
fn rate(world: &PhysicsWorld, joint: &ImpulseJoint, axis: usize) -> Option<f64> {
    let (a, b) = (world.bodies.get(joint.body1())?, world.bodies.get(joint.body2())?);
    let (one, two) = (*a.position() * joint.data.local_frame1, *b.position() * joint.data.local_frame2);
    let along = rotation(one.rotation).to_rotation_matrix().matrix().column(axis % 3).into_owned();
    let point = vector(two.translation);
    let at = |body: &rapier::dynamics::RigidBody| {
        vector(body.linvel()) + vector(body.angvel()).cross(&(point - vector(body.center_of_mass())))
    };
    Some(if axis < 3 { along.dot(&(at(b) - at(a))) } else { along.dot(&(vector(b.angvel()) - vector(a.angvel()))) })
}

/// Which of its limits a joint is nearer to: -1 the greatest, 1 the least.
pub(crate) fn nearest(world: &PhysicsWorld, joint: &ImpulseJoint, axis: usize) -> f64 {
    coordinate(world, joint, axis).map_or(1.0, |at| nearer(at, &joint.data.limits[axis]))
}

/// -1 at the greatest, 1 at the least.
fn nearer(at: f64, limits: &JointLimits<Real>) -> f64 {
    if at - f64::from(limits.min) < f64::from(limits.max) - at { 1.0 } else { -1.0 }
}

/// The side of the limits at which a coordinate stands, if it does and does not leave.
pub(crate) fn side(at: f64, limits: &JointLimits<Real>, rate: f64) -> Option<f64> {
    let side = nearer(at, limits);
    let beyond = if side > 0.0 { f64::from(limits.min) - at } else { at - f64::from(limits.max) };
    (beyond > -NEAR && side * rate < OPENING).then_some(side)
}

/// Axes at whose limits a joint stands.
pub(crate) fn near(world: &PhysicsWorld, joint: &ImpulseJoint) -> u8 {
    let bits = joint.data.limit_axes.bits() & !joint.data.locked_axes.bits() & !joint.data.coupled_axes.bits();
    (0..6)
        .filter(|axis| bits & (1 << axis) != 0)
        .filter(|axis| {
            let (at, rate) = (coordinate(world, joint, *axis), rate(world, joint, *axis));
            at.zip(rate).is_some_and(|(at, rate)| side(at, &joint.data.limits[*axis], rate).is_some())
        })
        .fold(0, |b, axis| b | 1 << axis)
}

/// Axes whose limits pushed in the last substep.
pub(crate) fn pushing(joint: &ImpulseJoint) -> u8 {
    let bits = joint.data.limit_axes.bits() & !joint.data.locked_axes.bits() & !joint.data.coupled_axes.bits();
    (0..6)
        .filter(|axis| bits & (1 << axis) != 0 && joint.data.limits[*axis].impulse != 0.0)
        .fold(0, |b, axis| b | 1 << axis)
}
