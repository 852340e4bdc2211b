//! Reconciliation: bodies and cables are updated to what Rapier's step made of the prediction.
//!
//! # Equation
//! ```text
//! landed:    x, v = the predicted state, in f64
//! deviated:  x = Rapier's, without its rounding      v = v1 + (v_after - v0)
//! ```
//! v0 is the velocity that Rapier was given, x1 and v1 are the predicted state. The whole of the
//! predicted change of velocity stays, so that bodies and cables keep their momentum. What contacts
//! and joints did is expected again ([`reaction`](super::reaction)); what the motors did acts on
//! the cables ([`impedance`](super::impedance)), and through them on the next bodies
//! ([`next_pins`](super::next_pins)).
//!
//! # Validity
//! With N substeps Rapier rounds each coordinate N times, by half a unit in the last place, and
//! twice more between origin and centre of mass; the body is put back to its exact place, rounded
//! once. Taken for motion, this rounding made a box of 4 kg at x = 8 m, which a rope of 3.75e6 N/m
//! and T = 10 ms drags against 15.7 N of friction, pull by 46 N.
//!
//! # Alternatives considered
//! Keeping only a share of the predicted change of velocity of a body that
//! deviated, `v_after + s (v1 - v0)`, s = 1 where it landed and 0 where it was stopped: a random
//! scene in free flight gained 8e-3 m/s per mass.

use crate::body::pose::rounding;
use crate::body::record::{BodyRecord, ExactState};
use crate::body::spatial::{split_spatial, stack_spatial};
use crate::contents::Contents;
use crate::convert::{rotation, to_pose, to_vector, vector};
use crate::islands::{Island, Member};
use crate::scales::step::{MAX_LINK_GAP_SHARE, POSITION_ROUNDING, VELOCITY_ROUNDING};
use crate::step::apply::restore_cables;
use crate::step::energy;
use crate::step::groups;
use crate::step::impedance::{apply_motor_impulses, follow_body, motor_impulse, take_impulses};
use crate::step::kinematic_ends;
use crate::step::next_pins;
use crate::step::prediction::{AppliedMotion, BodyStep, Prediction};
use crate::step::reaction::update_reaction;
use crate::step::sleep;
use crate::step::waking;
use ::nalgebra::{UnitQuaternion, Vector3, Vector6};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::RigidBody;
use rapier::dynamics::{RigidBody as RapierBody, RigidBodyHandle};
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Updates cables, bodies and attachments of an island after a Rapier step of `h` (s).
pub(crate) fn reconcile(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    (h, sleep_speed): (f64, f64),
) {
    if prediction.sleep.asleep {
        waking::wake_within_step(contents, world, island, prediction, h);
        return;
    }
    if contents.changed {
        // cables or attachments changed since the prediction: only the bodies are updated
        read_members(contents, world, island, prediction, (h, true));
        return;
    }
    if island.bodies().next().is_some() && island.bodies().all(|handle| is_sleeping(world, handle)) {
        undo_for_sleep(contents, world, island, prediction, h);
        return;
    }
    if !island.members.is_empty() {
        energy::note(contents, world, island, prediction, h);
        let rests = !prediction.sleep.disturbed && sleep::is_resting(contents, island, (h, sleep_speed));
        read_members(contents, world, island, prediction, (h, rests));
        next_pins::pass_on(contents, world, island, prediction, h);
        apply_motor_impulses(contents, island, prediction);
        read_attachments(contents, world, island, prediction, h);
        waking::wake_within_step(contents, world, island, prediction, h);
    }
    kinematic_ends::read(contents, world, island);
    sleep::keep_awake(contents, world, island, prediction.sleep.disturbed, (h, sleep_speed));
}

fn is_sleeping(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    world.bodies.get(handle).is_some_and(RapierBody::is_sleeping)
}

/// Undoes the prediction of an island whose bodies Rapier put to sleep instead of stepping them.
fn undo_for_sleep(contents: &mut Contents, world: &mut PhysicsWorld, island: &Island, prediction: &Prediction, h: f64) {
    restore_cables(contents, island, prediction);
    contents.for_cables(&island.cables, |_, cable| cable.rest(h));
    for (m, member) in island.members.iter().enumerate() {
        if let (Member::Body(handle), Some(applied)) = (member, &prediction.applied[m]) {
            let record = contents.records.record_mut(*handle);
            put_to_rest(world, &prediction.body_step(m, *handle, h), applied, record);
        }
    }
}

/// Reads the bodies of an island after Rapier's step, and the impulses of their motors.
fn read_members(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    (h, rests): (f64, bool),
) {
    take_impulses(contents, world, island, prediction, h);
    for (m, member) in island.members.iter().enumerate() {
        let (Member::Body(handle), Some(applied)) = (member, &prediction.applied[m]) else { continue };
        let step = prediction.body_step(m, *handle, h);
        let is_jointed = step.mechanism.is_some();
        if !world.bodies.contains(*handle) {
            if let Some(mechanism) = step.mechanism {
                mechanism.loads.restore(world);
            }
            continue;
        }
        let record = contents.records.record_mut(*handle);
        if is_sleeping(world, *handle) {
            put_to_rest(world, &step, applied, record);
            continue;
        }
        if is_jointed {
            continue;
        }
        let motors = motor_impulse(island, prediction, m);
        record.stepped = true;
        let landed = read_back(world, &step, applied, record, (&motors, rests));
        if let Some(applied) = prediction.applied[m].as_mut() {
            applied.landed = landed;
        }
        if landed {
            island.pins_on(m).for_each(|pin| prediction.impulses[pin] = Vector3::zeros());
        } else if world.bodies[*handle].is_ccd_active()
            && let Some(exact) = &record.exact
        {
            follow_body(island, prediction, (m, exact), h);
        }
    }
    for group in &prediction.groups {
        groups::read_back(contents, world, island, prediction, group, h);
    }
}

/// Updates the record of a body that Rapier put to sleep instead of stepping it: it is where it
/// was, at rest.
fn put_to_rest(world: &mut PhysicsWorld, step: &BodyStep, applied: &AppliedMotion, record: &mut BodyRecord) {
    if let Some(mechanism) = step.mechanism {
        mechanism.loads.restore(world);
    }
    let body = &mut world.bodies[step.handle];
    applied.saved.restore_settings(body);
    if let Some(exact) = &mut record.exact {
        exact.stop(body);
    }
}

/// Restores the forces and settings of a body, and sets its state: the predicted one if it landed
/// there, else Rapier's position with the velocity that contacts and joints left of the predicted
/// one. `motors` is the impulse of its motors; a body that touched nothing, or that `rests`, is
/// left where Rapier holds it, which would find its contacts anew, and wake all that it touches.
/// Returns whether it landed.
fn read_back(
    world: &mut PhysicsWorld,
    step: &BodyStep,
    applied: &AppliedMotion,
    record: &mut BodyRecord,
    (motors, rests): (&Vector6<f64>, bool),
) -> bool {
    let &BodyStep { handle, end, h, .. } = step;
    let iterations = world.integration_parameters.num_solver_iterations;
    let body = &mut world.bodies[handle];
    applied.saved.restore_settings(body);
    let after = stack_spatial(&vector(body.linvel()), &vector(body.angvel()));
    let deviation = after - stack_spatial(&vector(applied.linvel), &vector(applied.angvel));
    let landed = has_landed(body, end, applied, &deviation);
    let velocity = stack_spatial(&end.velocity, &end.angular_velocity);
    let velocity = if landed { velocity } else { velocity + deviation };
    let mut settled = end.clone();
    if !landed {
        settled.position = unrounded(body, &end.position, &(split_spatial(&deviation).0 * h), iterations);
        settled.rotation = rotation(*body.rotation());
        settled.memory = None;
    }
    update_reaction(step, &settled, record, (&deviation, &velocity), motors);
    let (linear_damping, angular_damping) = applied.saved.damping_factors(h);
    let (linear, angular) = split_spatial(&velocity);
    let (linear, angular) = (linear * linear_damping, angular * angular_damping);
    body.set_linvel(to_vector(&linear), false);
    body.set_angvel(to_vector(&angular), false);
    if !applied.isolated && !rests {
        let origin = settled.position - settled.rotation * vector(body.local_center_of_mass());
        body.set_position(to_pose(&origin, &settled.rotation), false);
    }
    record.exact = Some(ExactState::new(&settled, (linear, angular), body));
    landed
}

/// Returns whether a body is where it was predicted, and moves as it was told to, within rounding.
/// Continuous collision detection stops a body at a wall without a change of its velocity.
fn has_landed(body: &RapierBody, end: &RigidBody, applied: &AppliedMotion, deviation: &Vector6<f64>) -> bool {
    let epsilon = f64::from(Real::EPSILON);
    let centre = vector(body.center_of_mass());
    let distance = (centre - end.position).norm();
    let tolerance = VELOCITY_ROUNDING * epsilon;
    let (linear, angular) = split_spatial(deviation);
    let speed = vector(applied.linvel).norm() + applied.balanced_velocity;
    distance <= POSITION_ROUNDING * epsilon * centre.norm().max(1.0)
        && linear.norm() <= tolerance * speed
        && angular.norm() <= tolerance * vector(applied.angvel).norm()
}

/// Returns the position of a body that deviated from the predicted one in a step of `iterations`
/// substeps. By how much depends on when it was pushed: between nothing and `largest`, the
/// deviation of its velocity times the step. Where Rapier's place is beyond that by no more than it
/// is rounded, the nearer of the two is true.
fn unrounded(body: &RapierBody, predicted: &Vector3<f64>, largest: &Vector3<f64>, iterations: usize) -> Vector3<f64> {
    let position = vector(body.center_of_mass());
    Vector3::from_fn(|i, _| {
        let moved = position[i] - predicted[i];
        let nearest = moved.clamp(largest[i].min(0.0), largest[i].max(0.0));
        let rounded = (moved - nearest).abs() <= rounding(iterations) * position[i].abs();
        if rounded { predicted[i] + nearest } else { position[i] }
    })
}

/// Reads force, moment, gap and work at the pins of an island.
fn read_attachments(contents: &mut Contents, world: &PhysicsWorld, island: &Island, prediction: &Prediction, h: f64) {
    for (i, pin) in island.pins.iter().enumerate() {
        let Some(index) = island.attachments[i] else { continue };
        let exact = match island.members[pin.body] {
            Member::Body(handle) => contents.records.get(handle).and_then(|record| record.exact.as_ref()),
            _ => None,
        };
        let Some(a) = contents.attachments.get_mut(index) else { continue };
        if !world.bodies.contains(a.body) {
            continue;
        }
        let Some(slot) = contents.cables.get(a.cable.0 as usize) else { continue };
        let (anchor, attitude) = match exact {
            Some(exact) => (exact.point(&pin.anchor), exact.rotation),
            None => {
                let (origin, attitude) = contents.records.place(world, a.body);
                (origin + attitude * a.anchor, attitude)
            }
        };
        let start = &prediction.start[pin.body];
        let mean = (a.predicted.impulse + prediction.impulses[i]) / h;
        let gap = slot.cable.node_position(a.node) - anchor;
        let reading = &mut a.reading;
        let deviated = prediction.applied[pin.body].as_ref().is_some_and(|applied| !applied.landed);
        reading.work += a.predicted.work;
        if deviated || prediction.impulses[i] != Vector3::zeros() {
            let work = |impulse: &Vector3<f64>, place: &Vector3<f64>, attitude: UnitQuaternion<f64>| {
                let turned = (attitude * start.rotation.inverse()).scaled_axis();
                impulse.dot(&(place - start.point(&pin.anchor))) + a.predicted.angular_impulse.dot(&turned)
            };
            let end = &prediction.end[pin.body];
            let predicted = work(&a.predicted.impulse, &end.point(&pin.anchor), end.rotation);
            reading.work += (work(&(mean * h), &anchor, attitude) - predicted) / h;
        }
        // a gap that closes becomes smaller
        let opens = gap.norm() > (MAX_LINK_GAP_SHARE * slot.cable.length()).max(reading.gap.norm());
        reading.residual += mean.dot(&(reading.gap - gap));
        reading.force = a.predicted.force + prediction.impulses[i] / h;
        reading.moment = a.predicted.moment;
        reading.gap = gap;
        a.lost_link |= opens && world.multibody_joints.rigid_body_link(a.body).is_some();
        if let Member::Driven(_) = island.members[pin.body] {
            a.last_anchor = Some(anchor);
        }
    }
}
