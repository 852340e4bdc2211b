//! Attaching cables to bodies and detaching them.

use crate::attachment::{Attachment, AttachmentKind, AttachmentReading};
use crate::contents::Contents;
use crate::convert::{rotation, vector};
use crate::error::Error;
use crate::events::Event;
use crate::handle::{AttachmentHandle, CableHandle};
use ::nalgebra::{Vector3, Vector6};
use lariat_ancf::At;
use lariat_ancf::island::PinAccount;
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Attaches a point of a cable to a point of a body.
pub(crate) fn attach(
    contents: &mut Contents,
    world: &PhysicsWorld,
    (cable, at): (CableHandle, At),
    (body, anchor): (RigidBodyHandle, Vector3<f64>),
    kind: AttachmentKind,
) -> Result<AttachmentHandle, Error> {
    let rigid = world.bodies.get(body).ok_or(Error::NoBody(body))?;
    if !anchor.iter().all(|x| x.is_finite()) {
        return Err(Error::AnchorNotFinite { body, anchor });
    }
    let node = free_node(contents, cable, at)?;
    let attached = contents.cable_mut(cable)?;
    let arc_length = attached.node_arc_lengths()[node];
    let direction = match kind {
        AttachmentKind::Ball => {
            attached.attach(At::Node(node))?;
            None
        }
        AttachmentKind::Clamp => {
            attached.attach_clamped(At::Node(node))?;
            let slope = Vector3::from_column_slice(&attached.positions()[6 * node + 3..6 * node + 6]);
            Some(rotation(*rigid.rotation()).inverse() * slope.normalize())
        }
    };
    let index = contents.attachments.push(Attachment {
        cable,
        node,
        arc_length,
        body,
        anchor,
        direction,
        ledger: None,
        last_anchor: None,
        reading: AttachmentReading::default(),
        steady_force: Vector3::zeros(),
        predicted: PinAccount::default(),
    });
    contents.changed = true;
    Ok(AttachmentHandle(index as u32))
}

/// Returns the point of a body, in body axes from its origin, where a point of a cable is now.
pub(crate) fn anchor_here(
    contents: &Contents,
    world: &PhysicsWorld,
    (cable, at): (CableHandle, At),
    body: RigidBodyHandle,
) -> Result<Vector3<f64>, Error> {
    let rigid = world.bodies.get(body).ok_or(Error::NoBody(body))?;
    let cable = contents.cable(cable)?;
    let position = cable.sample(cable.arc_length(at)?)?.position;
    Ok(rotation(*rigid.rotation()).inverse() * (position - vector(rigid.translation())))
}

/// Ends an attachment and frees its node.
pub(crate) fn detach(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    attachment: AttachmentHandle,
) -> Result<(), Error> {
    let removed = contents.attachments.remove(attachment.0 as usize);
    let Attachment { cable, node, body, ledger, .. } = removed.ok_or(Error::NoAttachment(attachment))?;
    contents.changed = true;
    if let Some(ledger) = ledger {
        world.remove_body(ledger.body);
    }
    // the reaction estimate is invalid without this cable
    contents.records.record_mut(body).reaction = Vector6::zeros();
    if world.bodies.contains(body) {
        world.islands.wake_up(&mut world.bodies, body, true);
    }
    contents.cable_mut(cable)?.detach(At::Node(node))?;
    Ok(())
}

/// Ends the attachments whose bodies were removed from the world, and drops the records of such
/// bodies.
pub(crate) fn end_lost(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    events: &mut Vec<Event>,
) -> Result<(), Error> {
    for i in 0..contents.attachments.len() {
        let Some(body) = contents.attachments.get(i).map(|a| a.body) else { continue };
        if !world.bodies.contains(body) {
            let attachment = AttachmentHandle(i as u32);
            detach(contents, world, attachment)?;
            events.push(Event::AttachmentEnded { attachment, body });
        }
    }
    contents.records.retain_existing(world);
    Ok(())
}

/// Returns the node at a point of a cable, inserting one if there is none. It must be neither
/// attached nor part of a junction.
pub(crate) fn free_node(contents: &mut Contents, cable: CableHandle, at: At) -> Result<usize, Error> {
    let edited = contents.cable_mut(cable)?;
    let before = edited.nodes();
    let node = edited.insert_node(at)?;
    let inserted = edited.nodes() > before;
    let name = edited.name().to_string();
    let nodes = contents.junctions.values_mut().flat_map(|j| &mut j.nodes).map(|(c, n)| (*c, n));
    let nodes = contents.attachments.values_mut().map(|a| (a.cable, &mut a.node)).chain(nodes);
    let mut taken = false;
    for (_, n) in nodes.filter(|(c, _)| *c == cable) {
        if inserted && *n >= node {
            *n += 1;
        }
        taken |= *n == node;
    }
    contents.changed |= inserted;
    if taken { Err(Error::AlreadyAttached { cable: name, node }) } else { Ok(node) }
}
