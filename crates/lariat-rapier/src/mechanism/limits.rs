//! Limits of joints that are active: the joint is at them, and the loads push against them.
//!
//! A limit counts as reached within [`LIMIT_DISTANCE`], unless the joint leaves it faster than
//! [`OPENING_RATE`]. Rapier enforces a limit only in substeps that begin at it or beyond, so the
//! coordinate of the joint decides; the limit force is not needed, since the predicted loads
//! already balance it. An axis that is at both of its limits is held like a locked one.
//!
//! # Validity
//! Measured with an arm of three links of 1 kg on a soft rope, struck with 0.5 N s, host steps of
//! 1/30 s with one iteration to 1/240 s with four: a joint that comes to rest 1e-4 before or behind
//! its limit changes between free and held from step to step, and the rope carries 12.5 to 14.4 N
//! of 14.7 with a distance of 1e-4 and a rate of 1e-2; 14.6 to 14.8 N with 1e-3 and 0.1; with a
//! rate of 1 it chatters (5 to 24 N).

use crate::convert::{rotation, vector};
use crate::scales::mechanism::{LIMIT_DISTANCE, OPENING_RATE};
use rapier::dynamics::{ImpulseJoint, JointLimits, RigidBody};
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Returns the coordinate of a joint along or about an axis, as Rapier's limits see it.
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

/// Returns the rate of a joint's coordinate.
fn rate(world: &PhysicsWorld, joint: &ImpulseJoint, axis: usize) -> Option<f64> {
    let (a, b) = (world.bodies.get(joint.body1())?, world.bodies.get(joint.body2())?);
    let (one, two) = (*a.position() * joint.data.local_frame1, *b.position() * joint.data.local_frame2);
    let along = rotation(one.rotation).to_rotation_matrix().matrix().column(axis % 3).into_owned();
    let point = vector(two.translation);
    let velocity = |body: &RigidBody| {
        vector(body.linvel()) + vector(body.angvel()).cross(&(point - vector(body.center_of_mass())))
    };
    Some(if axis < 3 {
        along.dot(&(velocity(b) - velocity(a)))
    } else {
        along.dot(&(vector(b.angvel()) - vector(a.angvel())))
    })
}

/// Returns the side to which the nearer limit of a joint pushes: -1 for the upper, 1 for the lower.
pub(super) fn nearest_side(world: &PhysicsWorld, joint: &ImpulseJoint, axis: usize) -> f64 {
    coordinate(world, joint, axis).map_or(1.0, |at| nearer(at, &joint.data.limits[axis]))
}

/// Returns whether a coordinate that is at one of its limits is at the other too.
pub(super) fn hold_both_sides(limits: &JointLimits<Real>) -> bool {
    f64::from(limits.max) - f64::from(limits.min) < LIMIT_DISTANCE
}

/// Returns -1 nearer to the upper limit, 1 nearer to the lower.
fn nearer(at: f64, limits: &JointLimits<Real>) -> f64 {
    if at - f64::from(limits.min) < f64::from(limits.max) - at { 1.0 } else { -1.0 }
}

/// Returns the side to which a limit pushes, if the coordinate is at it and does not leave it.
pub(super) fn active_side(at: f64, limits: &JointLimits<Real>, rate: f64) -> Option<f64> {
    let side = nearer(at, limits);
    let beyond = if side > 0.0 { f64::from(limits.min) - at } else { at - f64::from(limits.max) };
    (beyond > -LIMIT_DISTANCE && (side * rate < OPENING_RATE || hold_both_sides(limits))).then_some(side)
}

/// Returns the axes at whose limits a joint is, as bits.
pub(super) fn reached(world: &PhysicsWorld, joint: &ImpulseJoint) -> u8 {
    limited_axes(joint, |axis| {
        let (at, rate) = (coordinate(world, joint, axis), rate(world, joint, axis));
        at.zip(rate).is_some_and(|(at, rate)| active_side(at, &joint.data.limits[axis], rate).is_some())
    })
}

/// Returns the axes whose limits pushed in Rapier's last substep, as bits.
pub(super) fn pushing(joint: &ImpulseJoint) -> u8 {
    let both = |axis: usize| hold_both_sides(&joint.data.limits[axis]);
    limited_axes(joint, |axis| joint.data.limits[axis].impulse != 0.0 || both(axis))
}

/// Returns the axes with limits, neither locked nor coupled, that fulfil a condition, as bits.
fn limited_axes(joint: &ImpulseJoint, condition: impl Fn(usize) -> bool) -> u8 {
    let bits = joint.data.limit_axes.bits() & !joint.data.locked_axes.bits() & !joint.data.coupled_axes.bits();
    (0..6).filter(|axis| bits & (1 << axis) != 0 && condition(*axis)).fold(0, |b, axis| b | 1 << axis)
}
