//! Applying a prediction: Rapier is given the predicted motion as a uniform one.
//!
//! # Equation
//! ```text
//! linvel = dx/h      angvel = log(R1 R0^-1)/h      force = -(m g + reaction estimate)
//! ```
//! The force balances gravity and the reaction, so that a body in contact with nothing lands where
//! it was predicted, for any number of substeps. Gyroscopic forces and damping are disabled
//! meanwhile. A body that joints hold gets an impulse, with all that it moves with, in place of a
//! velocity.
//!
//! # Validity
//! In each substep of h Rapier multiplies the attitude by the normalised quaternion (1, w h/2), a
//! rotation by 2 atan(|w| h/2); `angvel` is corrected for it up to [`MAX_HALF_ROTATION`].

use crate::body::proximity;
use crate::body::spatial::split_spatial;
use crate::body::{SavedBody, replace_loads};
use crate::contents::Contents;
use crate::convert::{rotation, to_vector, vector};
use crate::islands::{Island, Member};
use crate::scales::body::{LEADING_SPEED, MAX_HALF_ROTATION};
use crate::step::groups;
use crate::step::prediction::{AppliedMotion, BodyStep, Prediction};
use ::nalgebra::{Vector3, Vector6};
use rapier::dynamics::RigidBody;
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Gives Rapier the predicted motion of all bodies of an island for a step of `h` (s).
pub(crate) fn apply(
    contents: &Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
) {
    for (m, member) in island.members.iter().enumerate() {
        let applied = match member {
            Member::Body(handle) if !world.bodies[*handle].is_sleeping() => {
                // the part of the reaction that joints bear needs no balance
                let moving = groups::unconstrained_reaction(contents, island, &prediction.groups, m);
                let reaction = moving.unwrap_or_else(|| contents.records.reaction(*handle));
                Some(apply_prediction(world, &prediction.body_step(m, *handle, h), &reaction))
            }
            _ => None,
        };
        prediction.applied.push(applied);
    }
    prediction.groups.iter().for_each(|group| groups::apply(world, prediction, group, h));
}

/// Makes Rapier move a body uniformly to its predicted position and attitude. `reaction` is the
/// part of its reaction estimate that moves it. A body that joints hold gets its velocity with its
/// [group](groups).
fn apply_prediction(world: &mut PhysicsWorld, step: &BodyStep, reaction: &Vector6<f64>) -> AppliedMotion {
    let &BodyStep { handle, start, end, mechanism, h } = step;
    let gravity = world.gravity;
    let isolated = proximity::is_isolated(world, handle);
    let substeps = world.integration_parameters.num_solver_iterations.max(1) as f64;
    let body = &mut world.bodies[handle];
    // a body that meets nothing is led back from its rounded place; contacts and motors would feel
    // that as a velocity, as would it in a step that is too short to undo the rounding
    let rounded = (vector(body.center_of_mass()), rotation(*body.rotation()));
    let [way, turn] = [(start.position - rounded.0).norm(), start.rotation.angle_to(&rounded.1)];
    let is_led_back = isolated && way.max(turn) <= LEADING_SPEED * h;
    let (from, attitude) = if is_led_back { rounded } else { (start.position, start.rotation) };
    let linvel = to_vector(&((end.position - from) / h));
    let turn = (end.rotation * attitude.inverse()).scaled_axis() / h;
    let angvel = match mechanism {
        // Rapier rotates links of a multibody exactly
        Some(mechanism) if mechanism.is_multibody() => to_vector(&turn),
        _ => to_vector(&linearised(&turn, h / substeps)),
    };
    let weight = vector(gravity).norm() * f64::from(body.gravity_scale()).abs();
    let (force, torque) = split_spatial(reaction);
    let applied = AppliedMotion {
        linvel,
        angvel,
        isolated,
        balanced_velocity: (weight + force.norm() / end.mass) * h,
        landed: false,
        saved: SavedBody::of(body),
    };
    let own_weight = gravity * (end.mass as Real * body.gravity_scale());
    replace_loads(body, -to_vector(&force) - own_weight, -to_vector(&torque));
    body.enable_gyroscopic_forces(false);
    body.set_allow_fast_rotation(true);
    if mechanism.is_none() {
        body.set_linvel(linvel, false);
        body.set_angvel(angvel, false);
    }
    stay_awake(body, h as Real);
    applied
}

/// Keeps Rapier from putting a body to sleep within a step of `h` (s) that is longer than the time
/// for which a body must be slow: it compares the poses before and after the step alone, and a load
/// that swings may come back to its place. Whether it rests is decided after the step.
fn stay_awake(body: &mut RigidBody, h: Real) {
    let until = body.activation().time_until_sleep;
    if h >= until {
        body.activation_mut().time_since_can_sleep = 0.5 * until - h;
    }
}

/// Returns the angular velocity with which Rapier rotates a body as `spin` (rad/s) would, in
/// substeps of `h` (s).
fn linearised(spin: &Vector3<f64>, h: f64) -> Vector3<f64> {
    let half = (0.5 * spin.norm() * h).min(MAX_HALF_ROTATION);
    if half > 0.0 { spin * (half.tan() / half) } else { *spin }
}

/// Reverts a prediction: cables and bodies are as they were before it.
pub(crate) fn revert(contents: &mut Contents, world: &mut PhysicsWorld, island: &Island, prediction: &Prediction) {
    restore_cables(contents, island, prediction);
    revert_bodies(world, island, prediction);
}

/// Restores the cables of an island to their states before the step.
pub(crate) fn restore_cables(contents: &mut Contents, island: &Island, prediction: &Prediction) {
    // a snapshot of the cable itself always fits
    contents.for_cables(&island.cables, |c, cable| drop(cable.restore(prediction.snapshots[c].clone())));
}

/// Restores the bodies of an island to their states before the prediction.
pub(crate) fn revert_bodies(world: &mut PhysicsWorld, island: &Island, prediction: &Prediction) {
    let applied = island.members.iter().zip(&prediction.applied).zip(&prediction.mechanisms);
    // in reverse order: of a mechanism, the body that was changed first knows the original state
    for ((member, applied), mechanism) in applied.rev() {
        let (Member::Body(handle), Some(applied)) = (member, applied) else { continue };
        if let Some(mechanism) = mechanism {
            mechanism.loads.restore(world);
        }
        if !world.bodies.contains(*handle) {
            continue;
        }
        if let Some(mechanism) = mechanism {
            mechanism.revert(world);
        }
        let body = &mut world.bodies[*handle];
        applied.saved.restore_settings(body);
        applied.saved.restore_velocities(body);
    }
}
