//! Moving bodies with the cables on them: a teleport without a jolt.
//!
//! # Scheme
//! Poses, velocities and what the step remembers of bodies, cables and junctions are turned and
//! displaced together, so that the run goes on as the moved one would: strains and tensions stay.
//! What was in contact is not any more: contacts of cables and the reaction estimates of bodies
//! begin anew.
//!
//! # Validity
//! What holds a cable must move with it. A joint to a body that stays, a link of a multibody, a
//! support of a cable's own, and a body that stays are refused.

use crate::body;
use crate::body::record::{BodyRecord, ExactState};
use crate::body::spatial::{split_spatial, stack_spatial};
use crate::contents::Contents;
use crate::convert::{rotation, to_pose, to_vector, vector};
use crate::error::Error;
use crate::handle::CableHandle;
use crate::mechanism;
use ::nalgebra::{UnitQuaternion, Vector3, Vector6};
use lariat_ancf::At;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::RigidBody;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Pose;
use rapier::pipeline::PhysicsWorld;

/// Moves bodies by `by`, in world axes, with all cables that are attached to them.
pub(crate) fn move_bodies(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    bodies: &[RigidBodyHandle],
    by: &Pose,
) -> Result<(), Error> {
    let (turn, way) = (rotation(by.rotation), vector(by.translation));
    if !(way.iter().chain(turn.coords.iter()).all(|x| x.is_finite()) && turn.norm() > 0.5) {
        return Err(Error::MoveNotFinite);
    }
    // a body that holds two ropes is easily listed twice
    let mut once: Vec<RigidBodyHandle> = Vec::with_capacity(bodies.len());
    bodies.iter().for_each(|body| {
        if !once.contains(body) {
            once.push(*body)
        }
    });
    let bodies = once.as_slice();
    for &handle in bodies {
        world.bodies.get(handle).ok_or(Error::NoBody(handle))?;
        let joined = mechanism::bodies(world, handle);
        let is_link = world.multibody_joints.rigid_body_link(handle).is_some();
        let stays = |(a, b): (RigidBodyHandle, RigidBodyHandle)| !(bodies.contains(&a) && bodies.contains(&b));
        let mut joints = world.impulse_joints.attached_enabled_joints(handle);
        let to_ledger = |h: RigidBodyHandle| world.bodies.get(h).is_some_and(body::ledger::is_ledger);
        let held = joints.any(|(a, b, ..)| stays((a, b)) && !to_ledger(a) && !to_ledger(b));
        if is_link || held || joined.iter().any(|other| !bodies.contains(other)) {
            return Err(Error::JointInMove { body: handle });
        }
    }
    let cables = with_them(contents, bodies);
    check(contents, bodies, &cables)?;
    let time = contents.cables.values().next().map_or(0.0, |slot| slot.cable.time());
    let mut moved = Vec::with_capacity(bodies.len());
    for &handle in bodies {
        // the mass of one that is fixed or kinematic is not finite
        moved.push(if world.bodies[handle].is_dynamic() {
            body::read(world, handle, contents.records.record_mut(handle), time)?
        } else {
            body::rigid_body(world, handle).ok_or(Error::NoBody(handle))?
        });
    }
    for (&handle, mut body) in bodies.iter().zip(moved) {
        body.move_by(&turn, &way);
        put(world, contents.records.record_mut(handle), &body, &turn);
    }
    for &cable in &cables {
        contents.cable_mut(cable)?.move_by(&turn, &way);
    }
    let moved = |cable: &CableHandle| cables.contains(cable);
    for junction in contents.junctions.values_mut().filter(|j| j.nodes.iter().any(|(cable, _)| moved(cable))) {
        // a junction is a point, which keeps no place of its own: its memory turns as that of any
        // body does
        let mut point = RigidBody::junction(Vector3::zeros())?;
        point.memory = junction.memory;
        point.move_by(&turn, &way);
        junction.memory = point.memory;
    }
    for a in contents.attachments.values_mut().filter(|a| bodies.contains(&a.body)) {
        a.last_anchor = None;
        let reading = &mut a.reading;
        (reading.force, reading.moment, reading.gap) =
            (turn * reading.force, turn * reading.moment, turn * reading.gap);
        a.steady_force = turn * a.steady_force;
    }
    Ok(())
}

/// Returns the cables that are attached to bodies, and those that are tied to them.
fn with_them(contents: &Contents, bodies: &[RigidBodyHandle]) -> Vec<CableHandle> {
    let attached = contents.attachments.values().filter(|a| bodies.contains(&a.body)).map(|a| a.cable);
    let wound = contents.wheels.bodies().filter(|(_, body)| bodies.contains(body)).map(|(cable, _)| cable);
    let mut cables: Vec<CableHandle> = Vec::new();
    for cable in attached.chain(wound) {
        if !cables.contains(&cable) {
            cables.push(cable);
        }
    }
    let mut next = 0;
    while let Some(&cable) = cables.get(next) {
        for junction in contents.junctions.values().filter(|j| j.nodes.iter().any(|(tied, _)| *tied == cable)) {
            for (tied, _) in &junction.nodes {
                if !cables.contains(tied) {
                    cables.push(*tied);
                }
            }
        }
        next += 1;
    }
    cables
}

/// Refuses cables that something holds which does not move.
fn check(contents: &Contents, bodies: &[RigidBodyHandle], cables: &[CableHandle]) -> Result<(), Error> {
    for &handle in cables {
        let cable = contents.cable(handle)?;
        let of_others = contents.attachments.values().any(|a| a.cable == handle && !bodies.contains(&a.body));
        let on_others = contents.wheels.bodies().any(|(cable, body)| cable == handle && !bodies.contains(&body));
        let is_known = |node: usize| {
            contents.attachments.values().any(|a| (a.cable, a.node) == (handle, node))
                || contents.junctions.values().any(|j| j.nodes.contains(&(handle, node)))
        };
        let is_held = |node: usize| cable.support(At::Node(node)).is_ok_and(|s| s.attached || s.position.is_some());
        if of_others || on_others || (0..cable.nodes()).any(|node| is_held(node) && !is_known(node)) {
            return Err(Error::HeldInMove { cable: cable.name().to_string() });
        }
    }
    Ok(())
}

/// Puts a body that was moved into the world, and turns what is remembered of it.
fn put(world: &mut PhysicsWorld, record: &mut BodyRecord, moved: &RigidBody, turn: &UnitQuaternion<f64>) {
    record.reaction = Vector6::zeros();
    let body = &mut world.bodies[record.handle];
    let origin = moved.position - moved.rotation * vector(body.local_center_of_mass());
    body.set_position(to_pose(&origin, &moved.rotation), true);
    body.set_linvel(to_vector(&moved.velocity), true);
    body.set_angvel(to_vector(&moved.angular_velocity), true);
    record.exact = body.is_dynamic().then(|| ExactState::new(moved, (moved.velocity, moved.angular_velocity), body));
    let (force, torque) = split_spatial(&record.pull);
    record.pull = stack_spatial(&(turn * force), &(turn * torque));
    (record.motion, record.place, record.next_place) = (None, None, None);
}
