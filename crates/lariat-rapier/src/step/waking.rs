//! Bodies that Rapier wakes within its step.
//!
//! # Equation
//! ```text
//! given to Rapier, while a body sleeps:   F + D (0 - v)      D = C^-1
//! cable:     dv = -A^-1 J^T (p - F h)      dx = h dv
//! ```
//! F is the force of the cable at rest, C its compliance over the step with all other pins held, p
//! the impulse that the motors of the [ledger](crate::body::ledger) exerted. The body is as Rapier
//! leaves it.
//!
//! # Validity
//! The first step is that of an implicit Euler method, as that of every body that deviates. In it a
//! body has no contacts with what it lay on: Rapier has forgotten them.
//!
//! # Alternatives considered
//! What was tried, and what it gave: docs/decisions/rapier.md.

use crate::contents::Contents;
use crate::contents::attachment::Attachment;
use crate::islands::Island;
use crate::step::impedance;
use crate::step::impedance::{Others, apply_motor_impulses};
use crate::step::prediction::Prediction;
use ::nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Takes over what Rapier's step of `h` (s) made of sleeping bodies that it woke: they felt the
/// force of the cables at rest and the impedance; what the motors exerted beyond that force acts on
/// the cables.
pub(super) fn wake_within_step(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
) {
    let is_woken = |m: usize, handle: RigidBodyHandle| {
        let held = |pin: usize| contents.attachments.get(island.attachments[pin]?)?.ledger?.rest;
        world.bodies.get(handle).is_some_and(|body| !body.is_sleeping()) && island.pins_on(m).any(|p| held(p).is_some())
    };
    let bodies = island.members.iter().enumerate().filter_map(|(m, member)| Some((m, member.body()?)));
    let woken: Vec<usize> = bodies.filter(|(m, handle)| is_woken(*m, *handle)).map(|(m, _)| m).collect();
    // what was linearised when the motors were set can be linearised again: it has not moved since
    let held = (Others::Held, h);
    let on_woken = |pin: usize| woken.contains(&island.pins[pin].body);
    if woken.is_empty()
        || contents.changed
        || impedance::linearise(contents, island, prediction, on_woken, held).is_err()
    {
        return;
    }
    prediction.impulses.clear();
    prediction.impulses.resize(island.pins.len(), Vector3::zeros());
    for (pin, index) in woken.iter().flat_map(|&m| island.pins_on(m)).filter_map(|p| Some((p, island.attachments[p]?)))
    {
        if let Some(ledger) = contents.attachments.get(index).and_then(|a| a.ledger) {
            prediction.impulses[pin] = ledger.take_impulse(world, h);
        }
    }
    let node = |contents: &Contents, a: &Attachment| {
        contents.cables.get(a.cable.0 as usize).map_or_else(Vector3::zeros, |slot| slot.cable.node_position(a.node))
    };
    let attached = |pin: usize| contents.attachments.get(island.attachments[pin]?);
    let before: Vec<_> = (0..island.pins.len()).map(|pin| attached(pin).map(|a| node(contents, a))).collect();
    apply_motor_impulses(contents, island, prediction);
    for pin in woken.iter().flat_map(|&m| island.pins_on(m)) {
        let (Some(index), Some(before)) = (island.attachments[pin], before[pin]) else { continue };
        let Some(a) = contents.attachments.get(index) else { continue };
        let (origin, attitude) = contents.records.place(world, a.body);
        let (anchor, rest) = (origin + attitude * a.anchor, a.ledger.and_then(|ledger| ledger.rest));
        let (node, force) = (node(contents, a), rest.unwrap_or_default().0 + prediction.impulses[pin] / h);
        let Some(a) = contents.attachments.get_mut(index) else { continue };
        a.reading.work += force.dot(&(anchor - before));
        a.reading.residual += force.dot(&(a.reading.gap - (node - anchor)));
        (a.reading.force, a.reading.gap) = (force, node - anchor);
    }
}
