//! Attaching cables to bodies and detaching them.

use super::reel;
use super::world_mark;
use crate::contents::Contents;
use crate::contents::attachment::{Attachment, AttachmentKind, AttachmentOptions, AttachmentReading, Gap};
use crate::contents::gaps::GapWatch;
use crate::convert::{rotation, vector};
use crate::error::Error;
use crate::events::Event;
use crate::handle::{AttachmentHandle, CableHandle};
use ::nalgebra::{Vector3, Vector6};
use lariat_ancf::At;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::PinAccount;
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::pipeline::PhysicsWorld;

/// Attaches a point of a cable to a point of a body.
pub(crate) fn attach(
    contents: &mut Contents,
    world: &PhysicsWorld,
    (cable, at): (CableHandle, At),
    (body, anchor): (RigidBodyHandle, Vector3<f64>),
    AttachmentOptions { kind, gap, direction: along }: AttachmentOptions,
) -> Result<AttachmentHandle, Error> {
    if kind == AttachmentKind::Ball && along.is_some() {
        return Err(Error::DirectionOfBall);
    }
    let rigid = check(contents, world, (cable, at), (body, anchor), gap)?;
    lay_as_drawn(contents, (cable, at), &(vector(rigid.translation()) + rotation(*rigid.rotation()) * anchor))?;
    let node = free_node(contents, cable, at)?;
    let attached = contents.cable_mut(cable)?;
    let arc_length = attached.node_arc_lengths()[node];
    let direction = match kind {
        AttachmentKind::Ball => {
            attached.attach(At::Node(node))?;
            None
        }
        AttachmentKind::Clamp => {
            let turn = rotation(*rigid.rotation());
            attached.attach_clamped(At::Node(node), along.map(|along| turn * along))?;
            let slope = Vector3::from_column_slice(&attached.positions()[6 * node + 3..6 * node + 6]);
            Some(turn.inverse() * slope.normalize())
        }
    };
    if rigid.is_dynamic() {
        attached.ride(node);
    }
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
        watch: GapWatch::new(gap.allowed()),
        lost_link: false,
        at_eye: false,
        from_start: 0,
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
    let held = contents.cable(cable)?;
    if node == 0 || node + 1 == held.nodes() {
        reel::sheaves::remove_at(contents, cable, Some(node == 0))?;
    }
    // the reaction estimate is invalid without this cable
    contents.records.record_mut(body).reaction = Vector6::zeros();
    if world_mark::is_own(contents, world) {
        if let Some(ledger) = ledger {
            world.remove_body(ledger.body);
        }
        if world.bodies.contains(body) {
            world.islands.wake_up(&mut world.bodies, body, true);
        }
    }
    if contents.attachments.values().next().is_none() {
        world_mark::remove(contents, world);
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
    reel::end_lost(contents, world)
}

/// Checks that a point of a cable can be attached to a point of a body, and returns the body.
pub(crate) fn check<'a>(
    contents: &Contents,
    world: &'a PhysicsWorld,
    (cable, at): (CableHandle, At),
    (body, anchor): (RigidBodyHandle, Vector3<f64>),
    gap: Gap,
) -> Result<&'a RigidBody, Error> {
    if !world_mark::is_own(contents, world) {
        return Err(Error::OtherWorld);
    }
    let rigid = world.bodies.get(body).ok_or(Error::NoBody(body))?;
    if !anchor.iter().all(|x| x.is_finite()) {
        return Err(Error::AnchorNotFinite { body, anchor });
    }
    check_free(contents, cable, at)?;
    let existing = contents.cable(cable)?;
    let target = vector(rigid.translation()) + rotation(*rigid.rotation()) * anchor;
    let point = existing.sample(existing.arc_length(at)?)?.position;
    let now = gap.check(existing, &point, &target);
    match existing.drawn_position(at) {
        Some(drawn) if is_nearer(&drawn, &point, &target) => gap.check(existing, &drawn, &target)?,
        _ => now?,
    }
    Ok(rigid)
}

/// Lays an end that turned with a clamp back where it was drawn, if that is nearer to a point of a
/// body.
fn lay_as_drawn(contents: &mut Contents, (cable, at): (CableHandle, At), target: &Vector3<f64>) -> Result<(), Error> {
    let existing = contents.cable(cable)?;
    let Some(drawn) = existing.drawn_position(at) else { return Ok(()) };
    let point = existing.sample(existing.arc_length(at)?)?.position;
    if is_nearer(&drawn, &point, target) {
        contents.cable_mut(cable)?.lay_as_drawn(at)?;
    }
    Ok(())
}

fn is_nearer(one: &Vector3<f64>, other: &Vector3<f64>, target: &Vector3<f64>) -> bool {
    (one - target).norm() < (other - target).norm()
}

/// Checks that no attachment and no junction has the node at a point of a cable.
pub(crate) fn check_free(contents: &Contents, cable: CableHandle, at: At) -> Result<(), Error> {
    let existing = contents.cable(cable)?;
    let Ok(node) = existing.node(at) else { return Ok(()) };
    let attached = contents.attachments.values().map(|a| (a.cable, a.node));
    let mut nodes = attached.chain(contents.junctions.values().flat_map(|j| j.nodes.iter().copied()));
    let taken = nodes.any(|taken| taken == (cable, node));
    if taken { Err(Error::AlreadyAttached { cable: existing.name().to_string(), node }) } else { Ok(()) }
}

/// Returns the node at a point of a cable, inserting one if there is none. It must be neither
/// attached nor part of a junction.
pub(crate) fn free_node(contents: &mut Contents, cable: CableHandle, at: At) -> Result<usize, Error> {
    check_free(contents, cable, at)?;
    let edited = contents.cable_mut(cable)?;
    let before = edited.nodes();
    let node = edited.insert_node(at)?;
    if edited.nodes() > before {
        let attached = contents.attachments.values_mut().map(|a| (a.cable, &mut a.node));
        let tied = contents.junctions.values_mut().flat_map(|j| &mut j.nodes).map(|(c, n)| (*c, n));
        attached.chain(tied).filter(|(c, n)| *c == cable && **n >= node).for_each(|(_, n)| *n += 1);
        contents.changed = true;
    }
    Ok(node)
}
