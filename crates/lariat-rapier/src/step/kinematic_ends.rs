//! Cable ends on fixed, kinematic and disabled bodies: prescribed motion.
//!
//! A ball attachment to a body that does not rotate prescribes the motion of its node over the
//! step: the cubic through positions and velocities of its anchor at both ends of the step. A body
//! that rotates, or that clamps a cable, is a driven body of the island, which moves the node along
//! the arc and rotates the tangent. The pose of the body after the step is computed as Rapier does,
//! so that the end is where Rapier puts the body.

use crate::body::pose::OriginPose;
use crate::body::prescribed_motion::PrescribedMotions;
use crate::contact::pull::pull;
use crate::contents::Contents;
use crate::contents::attachment::Attachment;
use crate::error::Error;
use crate::islands::{Island, Member};
use crate::step::prediction::StepParameters;
use ::nalgebra::{Matrix3, Vector3};
use lariat_ancf::Motion;
use lariat_ancf::island::{RigidBody, closing_share};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Returns a body with prescribed motion as a driven body of an island: its origin and attitude,
/// and the motion of the coming step.
pub(crate) fn driven_body(
    world: &PhysicsWorld,
    motions: &PrescribedMotions,
    handle: RigidBodyHandle,
    step: &StepParameters,
) -> Result<RigidBody, lariat_ancf::Error> {
    let [((from, attitude), first), ((to, turned), last)] = motions.ends(world, handle, step.share, step.h);
    let mut body = RigidBody::new(1.0, Matrix3::identity(), from)?;
    body.rotation = attitude;
    body.velocity = (to - from) / step.h;
    body.angular_velocity = (turned * attitude.inverse()).scaled_axis() / step.h;
    let uniform = [body.velocity, body.angular_velocity];
    body.unsteadiness = [first, last].map(|end| [end[0] - uniform[0], end[1] - uniform[1]]);
    body.free = [false; 6];
    Ok(body)
}

/// Returns whether an end of an island with prescribed motion moves in the coming step, or was
/// moved since the last.
pub(crate) fn have_moved(
    contents: &Contents,
    world: &PhysicsWorld,
    motions: &PrescribedMotions,
    island: &Island,
    h: f64,
) -> bool {
    let has_moved =
        |a: &Attachment, (origin, attitude): OriginPose| a.last_anchor != Some(origin + attitude * a.anchor);
    let mut supports = island.supports.iter().filter_map(|&i| contents.attachments.get(i));
    let mut clamps = island.pins.iter().zip(&island.attachments).filter_map(|(pin, index)| {
        let Member::Driven(body) = island.members[pin.body] else { return None };
        Some((body, contents.attachments.get((*index)?)?))
    });
    let rotates = |member: &Member| match member {
        Member::Driven(b) => {
            let [start, end] = motions.poses(world, *b, h);
            start != end
        }
        _ => false,
    };
    supports.any(|a| has_moved(a, motions.poses(world, a.body, h)[1]))
        || clamps.any(|(body, a)| has_moved(a, motions.poses(world, body, h)[0]))
        || island.members.iter().any(rotates)
}

/// Prescribes the motion of the supported nodes of an island over the coming step.
pub(crate) fn prescribe(
    contents: &mut Contents,
    world: &PhysicsWorld,
    motions: &PrescribedMotions,
    island: &Island,
    step: &StepParameters,
) -> Result<(), Error> {
    for &index in &island.supports {
        let Some(a) = contents.attachments.get_mut(index) else { continue };
        let Some(slot) = contents.cables.get_mut(a.cable.0 as usize) else { continue };
        let cable = &mut slot.cable;
        let [(start, start_velocity), (end, end_velocity)] =
            motions.ends(world, a.body, step.share, step.h).map(|((origin, attitude), [v, w])| {
                let arm = attitude * a.anchor;
                (origin + arm, v + w.cross(&arm))
            });
        let from = cable.node_position(a.node);
        // after a teleport the node follows at a limited speed
        let behind = from - start;
        let target = end + behind * (1.0 - closing_share(behind.norm(), step.h));
        let motion = Motion::hermite(cable.time(), step.h, (from, start_velocity), (target, end_velocity));
        cable.set_motion(a.node, motion)?;
        a.last_anchor.get_or_insert(start);
    }
    Ok(())
}

/// Reads force, gap and work at the supported nodes of an island after a step.
pub(crate) fn read(contents: &mut Contents, world: &PhysicsWorld, island: &Island) {
    for &index in &island.supports {
        let Some(a) = contents.attachments.get(index).filter(|a| world.bodies.contains(a.body)) else { continue };
        let (cable, node) = (a.cable.0 as usize, a.node);
        let (force, _) = pull(contents, island.cables.iter().copied(), (cable, node));
        let Some(a) = contents.attachments.get_mut(index) else { continue };
        let Some(slot) = contents.cables.get(cable) else { continue };
        let (origin, attitude) = contents.records.place(world, a.body);
        let anchor = origin + attitude * a.anchor;
        let mean = 0.5 * (a.reading.force + force);
        let gap = slot.cable.node_position(a.node) - anchor;
        let before = a.last_anchor.replace(anchor).unwrap_or(anchor);
        a.reading.work += mean.dot(&(anchor - before));
        a.reading.residual += mean.dot(&(a.reading.gap - gap));
        a.reading.force = force;
        a.reading.moment = Vector3::zeros();
        a.reading.gap = gap;
    }
}
