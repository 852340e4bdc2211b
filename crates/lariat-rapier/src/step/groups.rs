//! Members that joints hold: all those of one mechanism are given to Rapier and read back together.
//!
//! # Equation
//! ```text
//! before   v += a h/2 + R p          p = L (v0 - v - a0 h/2)
//! after    v += a h/2 + R p          p = L (v1 - v0 - a0 h/2)
//! ```
//! v0 is the uniform velocity of the step and v1 the predicted one at its end; L, R, a and a0 are
//! those of the [mechanism](crate::mechanism). What Rapier made of the uniform velocity stays.

use crate::body::spatial::stack_spatial;
use crate::body::unsettled::SettleStep;
use crate::contents::Contents;
use crate::convert::{rotation, to_vector, vector};
use crate::islands::{Island, Member};
use crate::mechanism::{self, Group, Mechanism, velocity_of};
use crate::step::impedance::motor_impulse;
use crate::step::prediction::{AppliedMotion, Prediction};
use crate::step::reaction::{gain, persisting_share, weight_of_places};
use ::nalgebra::{DVector, Vector6};
use lariat_ancf::island::RigidBody;
use rapier::pipeline::PhysicsWorld;

/// A member of a group in a step that Rapier has made.
struct Part<'a> {
    m: usize,
    applied: &'a AppliedMotion,
    mechanism: &'a Mechanism,
}

/// Returns the members of a group; `None` if the prediction was not applied to all of them.
fn parts<'a>(prediction: &'a Prediction, group: &Group) -> Option<Vec<Part<'a>>> {
    let part = |&m: &usize| {
        let applied = prediction.applied[m].as_ref()?;
        Some(Part { m, applied, mechanism: prediction.mechanisms[m].as_ref()? })
    };
    group.members.iter().map(part).collect()
}

/// Returns the velocities of the members among those of the island.
fn velocities(group: &Group, members: &[RigidBody]) -> DVector<f64> {
    group.stack_of(group.members.iter().map(|&m| velocity_of(&members[m])))
}

/// Returns the uniform velocities that the members are given.
fn given(group: &Group, parts: &[Part]) -> DVector<f64> {
    group.stack_of(parts.iter().map(|part| stack_spatial(&vector(part.applied.linvel), &vector(part.applied.angvel))))
}

/// Changes the velocities of a mechanism so that those of the members change by `changes` in `time`
/// (s) of the loads on the others.
fn change(world: &mut PhysicsWorld, group: &Group, parts: &[Part], changes: DVector<f64>, time: f64) {
    let impulses = group.impulses(&(changes - &group.acceleration * time));
    parts[0].mechanism.apply_loads(world, time);
    for (part, impulse) in parts.iter().zip(impulses.as_slice().chunks_exact(6)) {
        part.mechanism.apply_impulse(world, &Vector6::from_column_slice(impulse));
    }
}

/// Gives Rapier the uniform motion of a group over a step of `h` (s).
pub(crate) fn apply(world: &mut PhysicsWorld, prediction: &Prediction, group: &Group, h: f64) {
    let Some(parts) = parts(prediction, group) else { return };
    parts[0].mechanism.loads.balance(world);
    change(world, group, &parts, given(group, &parts) - velocities(group, &prediction.start), 0.5 * h);
}

/// Restores the forces and settings of a group's bodies, and completes their velocities; updates
/// their reaction estimates.
pub(crate) fn read_back(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &Prediction,
    group: &Group,
    h: f64,
) {
    let Some(parts) = parts(prediction, group) else { return };
    parts[0].mechanism.loads.restore(world);
    let mut intact = true;
    for part in &parts {
        let moves = |body: &&mut rapier::dynamics::RigidBody| !body.is_sleeping();
        let Some(body) = world.bodies.get_mut(part.mechanism.handle).filter(moves) else {
            intact = false;
            continue;
        };
        part.applied.saved.restore_settings(body);
        let record = contents.records.record_mut(part.mechanism.handle);
        (record.stepped, record.exact) = (true, None);
    }
    if !intact {
        return;
    }
    mechanism::refresh(world, parts[0].mechanism.handle);
    let velocity = |part: &Part| {
        let body = &world.bodies[part.mechanism.handle];
        stack_spatial(&vector(body.linvel()), &vector(body.angvel()))
    };
    let given = given(group, &parts);
    let deviation = group.stack_of(parts.iter().map(velocity)) - &given;
    let end = velocities(group, &prediction.end);
    let predicted = &end - velocities(group, &prediction.start);
    watch(contents, world, (island, prediction, group, &parts), (&deviation, &predicted), h);
    update_reactions(contents, world, (island, prediction, group, &parts), (&deviation, &predicted), h);
    change(world, group, &parts, end - given, 0.5 * h);
    // Rapier does not damp links of a multibody
    if !parts[0].mechanism.is_multibody() {
        parts[0].mechanism.loads.damp(world, h);
        for part in &parts {
            let (linear, angular) = part.applied.saved.damping_factors(h);
            let body = &mut world.bodies[part.mechanism.handle];
            body.set_linvel(to_vector(&(vector(body.linvel()) * linear)), false);
            body.set_angvel(to_vector(&(vector(body.angvel()) * angular)), false);
        }
    }
}

/// Reads of a group how far Rapier's step of `h` (s) was the predicted one: the predicted change of
/// velocity, and the deviation from it.
fn watch(
    contents: &mut Contents,
    world: &PhysicsWorld,
    (island, prediction, group, parts): (&Island, &Prediction, &Group, &[Part]),
    (deviation, predicted): (&DVector<f64>, &DVector<f64>),
    h: f64,
) {
    let impulses = group.impulses(predicted);
    let time = contents.cables.get(island.cables[0]).map_or(0.0, |slot| slot.cable.time());
    let joints = parts[0].mechanism.joint_gap(world);
    let of = |v: &DVector<f64>, k: usize| v.fixed_rows::<6>(6 * k).into_owned();
    for (k, part) in parts.iter().enumerate() {
        let body = &prediction.end[part.m];
        let motors = motor_impulse(island, prediction, part.m);
        let mut read = motors;
        for pin in island.pins_on(part.m) {
            if let Some(a) = island.attachments[pin].and_then(|a| contents.attachments.get(a)) {
                let arm = body.rotation * island.pins[pin].anchor;
                read += stack_spatial(&a.predicted.force, &(arm.cross(&a.predicted.force) + a.predicted.moment)) * h;
            }
        }
        // all loads but those of cables
        let given = stack_spatial(&prediction.start[part.m].force, &prediction.start[part.m].torque) * h;
        let step = SettleStep {
            body,
            inertia: &mechanism::own_inertia(body),
            gained: of(predicted, k) + of(deviation, k),
            deviation: of(deviation, k),
            pull: of(&impulses, k) - given + motors,
            read,
            joints,
            opening: parts[0].mechanism.opening,
            gravity: vector(world.gravity).norm() * h,
            h,
            time,
        };
        let record = contents.records.record_mut(part.mechanism.handle);
        record.pull += gain(h) * (step.pull / h - record.pull);
        record.settling.note(&step);
    }
}

/// Returns by how much (rad) the attitude of a member of an island halfway of a step of `h` (s) is
/// at most another than that at which its mechanism was predicted.
pub(crate) fn largest_turn_error(prediction: &Prediction, h: f64) -> f64 {
    let members = prediction.groups.iter().flat_map(|group| &group.members);
    let change = |&m: &usize| (prediction.end[m].angular_velocity - prediction.start[m].angular_velocity).norm();
    0.25 * h * members.map(change).fold(0.0, f64::max)
}

/// Updates the reaction estimates of a group from the deviations of velocity and position.
fn update_reactions(
    contents: &mut Contents,
    world: &PhysicsWorld,
    (island, prediction, group, parts): (&Island, &Prediction, &Group, &[Part]),
    (deviation, predicted): (&DVector<f64>, &DVector<f64>),
    h: f64,
) {
    let moved = group.stack_of(parts.iter().map(|part| {
        let (body, end) = (&world.bodies[part.mechanism.handle], &prediction.end[part.m]);
        let turned = (rotation(*body.rotation()) * end.rotation.inverse()).scaled_axis();
        stack_spatial(&((vector(body.center_of_mass()) - end.position) / h), &(turned / h))
    }));
    let change = deviation + moved * weight_of_places(h);
    let known =
        group.stack_of(parts.iter().map(|part| {
            contents.records.reaction(part.mechanism.handle) * h - motor_impulse(island, prediction, part.m)
        }));
    let whole = &known + group.impulses(deviation);
    let share = persisting_share(whole.dot(&(predicted + deviation)), group.square(&whole));
    let impulses = (known + group.implied_impulses(&change, parts[0].mechanism.loads.isolated)) * (share / h);
    for (part, impulse) in parts.iter().zip(impulses.as_slice().chunks_exact(6)) {
        let record = contents.records.record_mut(part.mechanism.handle);
        record.reaction += gain(h) * (Vector6::from_column_slice(impulse) - record.reaction);
    }
}

/// Returns the part of a member's reaction estimate that moves it, if it is one of a group: force
/// and torque.
pub(crate) fn unconstrained_reaction(
    contents: &Contents,
    island: &Island,
    groups: &[Group],
    m: usize,
) -> Option<Vector6<f64>> {
    let (group, place) = groups.iter().find_map(|group| Some((group, group.place(m)?)))?;
    let reactions = group.stack_of(group.members.iter().map(|&m| match island.members[m] {
        Member::Body(handle) => contents.records.reaction(handle),
        _ => Vector6::zeros(),
    }));
    Some(group.unconstrained_part(&reactions).fixed_rows::<6>(6 * place).into_owned())
}
