//! Writes what was solved to the set and the world.

use super::multibody;
use super::solve::{Solved, poses};
use crate::body::record::ExactState;
use crate::contact::pull::pull;
use crate::contents::Contents;
use crate::convert::{rotation, vector};
use crate::islands::Member;
use ::nalgebra::{Vector3, Vector6};
use rapier::math::Vector;
use rapier::pipeline::PhysicsWorld;

/// Writes an island in equilibrium to the set and the world.
pub(super) fn write(contents: &mut Contents, world: &mut PhysicsWorld, solved: Solved) {
    let poses = poses(world, &solved);
    let Solved { island, cables, members } = solved;
    for (&index, cable) in island.cables.iter().zip(cables) {
        if let Some(slot) = contents.cables.get_mut(index) {
            (slot.cable, slot.modified, slot.asleep) = (cable, true, false);
        }
    }
    for (handle, pose) in &poses {
        let body = &mut world.bodies[*handle];
        body.set_position(*pose, true);
        body.set_linvel(Vector::ZERO, true);
        body.set_angvel(Vector::ZERO, true);
    }
    multibody::follow(world, poses.iter().map(|(handle, _)| *handle));
    // Rapier moves colliders in its next step only, and what is near is asked for before
    world.bodies.propagate_modified_body_positions_to_colliders(&mut world.colliders);
    for (handle, _) in poses {
        let body = &world.bodies[handle];
        let end = island.members.iter().position(|m| *m == Member::Body(handle)).map(|m| &members[m]);
        let record = contents.records.record_mut(handle);
        record.reaction = Vector6::zeros();
        let still = (Vector3::zeros(), Vector3::zeros());
        record.exact = end.map(|end| ExactState::new(end, still, body));
    }
}

/// Updates the readings of all attachments.
pub(super) fn read_forces(contents: &mut Contents, world: &PhysicsWorld) {
    let held: Vec<_> = contents.attachments.iter().map(|(index, a)| (index, a.cable.0 as usize, a.node)).collect();
    for (index, cable, node) in held {
        let all = 0..contents.cables.len();
        let (force, moment) = pull(contents, all, (cable, node));
        let Contents { cables, attachments, records, .. } = &mut *contents;
        let Some(a) = attachments.get_mut(index) else { continue };
        let (Some(slot), Some(body)) = (cables.get(cable), world.bodies.get(a.body)) else { continue };
        let anchor = match records.get(a.body).and_then(|record| record.exact.as_ref()) {
            Some(exact) => exact.point(&(a.anchor - vector(body.local_center_of_mass()))),
            None => vector(body.translation()) + rotation(*body.rotation()) * a.anchor,
        };
        a.reading.force = force;
        a.reading.moment = if a.direction.is_some() { moment } else { Vector3::zeros() };
        a.reading.gap = slot.cable.node_position(a.node) - anchor;
        a.steady_force = force;
    }
}
