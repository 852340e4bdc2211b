//! The impedance of the cables within Rapier's step: motors on bodies that may deviate from their
//! prediction.
//!
//! # Equation
//! ```text
//! D = the block of a pin in (C + B)^-1
//! B_i = 1/m - [r]x I^-1 [r]x,     of the body of the pin itself times MOBILITY_SHARE
//! ```
//! C is the compliance of the cable over the step ([`Impedance`]) at the pin and at the [next
//! ones](super::next_pins), B_i the mobility of the body of each, alone. A [`Ledger`] acts on the
//! body with D about the predicted velocity of the anchor: if the prediction was right it does
//! nothing; if a contact or a joint makes the body deviate, the body feels the cable within the
//! same step. A sleeping body is predicted to rest under the force of its cables, which stands in
//! the motors for as long as it sleeps: should Rapier wake it within a step, it feels them.
//!
//! What the motors did acts on the cables as well, p by the motors of a body that deviated, with
//! what the [next pins](super::next_pins) do about it:
//! ```text
//! cable:     dv = -A^-1 J^T p      dx = h dv
//! ```
//!
//! # Validity
//! Rapier solves joints before contacts, so that the motors on a jammed body carry a small share of
//! its load in every step. In fidelity game the tension next to it therefore differs by 0.1 % on a
//! wire with twice the critical damping of its first mode, and by 1 % with 20 times (test
//! contact.rs); what is read at the body does not.
//!
//! # Alternatives considered
//! What was tried, and what it gave: docs/decisions/rapier.md.
//!
//! [`Impedance`]: lariat_ancf::island::Impedance

use crate::body::ledger::{Drive, Ledger};
use crate::body::proximity;
use crate::body::record::ExactState;
use crate::body::spatial::stack_spatial;
use crate::contents::Contents;
use crate::contents::attachment::Attachment;
use crate::error::Error;
use crate::islands::{Island, Member};
use crate::mechanism::Mechanism;
use crate::step::next_pins::{driving_point, with_next};
use crate::step::prediction::{Prediction, StepParameters};
use ::nalgebra::{Matrix3, Vector3, Vector6};
use lariat_ancf::island::PinConstraint;
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// What the pins of a cable do at which it is not linearised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Others {
    /// They move with the cable, but those on driven bodies.
    Free,
    /// They stay where they are.
    Held,
}

/// Sets the motors of all bodies of an island that may deviate from their prediction, and disables
/// all others.
pub(crate) fn set_motors(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) -> Result<(), Error> {
    let h = step.h;
    prediction.motors.clear();
    prediction.motors.resize(island.pins.len(), false);
    let sleeps = |handle: RigidBodyHandle| world.bodies[handle].is_sleeping();
    if island.bodies().any(sleeps) {
        hold(contents, world, island, prediction, h, |a| {
            [a.predicted.impulse, a.predicted.angular_impulse].map(|p| p / h)
        })?;
    }
    let (mut deviating, mut near) = (core::mem::take(&mut prediction.deviating), core::mem::take(&mut prediction.near));
    deviating.clear();
    deviating.extend((0..island.members.len()).filter(|&m| deviates(contents, world, island, prediction, m, step)));
    near.clear();
    let own = |pin: &usize| deviating.contains(&island.pins[*pin].body);
    near.extend((0..island.pins.len()).filter(own).flat_map(|pin| with_next(island, pin)).flatten());
    linearise(contents, island, prediction, |pin| near.contains(&pin), (Others::Free, h))?;
    for (pin, constraint) in island.pins.iter().enumerate().filter(|(pin, _)| own(pin)) {
        let Some(a) = island.attachments[pin].and_then(|a| contents.attachments.get_mut(a)) else { continue };
        let (start, end) = (&prediction.start[constraint.body], &prediction.end[constraint.body]);
        let target = (end.point(&constraint.anchor) - start.point(&constraint.anchor)) / h;
        if let Some(impedance) = driving_point(island, prediction, pin) {
            let ledger = a.ledger.get_or_insert_with(|| Ledger::insert(world, a.body));
            ledger.set_motors(world, &a.anchor, &Drive { impedance, target, load: None }, h);
            prediction.motors[pin] = true;
        }
    }
    (prediction.deviating, prediction.near) = (deviating, near);
    let off = island.attachments.iter().zip(&prediction.motors).filter(|(_, on)| !**on).filter_map(|(a, _)| *a);
    disable_motors(contents, world, off);
    Ok(())
}

/// Lets the motors on the sleeping bodies of an island exert what its cables do in a step of `h`
/// (s) in which the bodies do not move: `load` (N and N m), and the impedance of the cables with
/// all other pins held.
pub(crate) fn hold(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
    load: impl Fn(&Attachment) -> [Vector3<f64>; 2],
) -> Result<(), Error> {
    let asleep = |member: &Member| member.body().is_some_and(|handle| world.bodies[handle].is_sleeping());
    let asleep: Vec<usize> = (0..island.members.len()).filter(|&m| asleep(&island.members[m])).collect();
    let on_asleep = |pin: usize| asleep.contains(&island.pins[pin].body);
    linearise(contents, island, prediction, on_asleep, (Others::Held, h))?;
    for (pin, constraint) in island.pins.iter().enumerate().filter(|(_, pin)| asleep.contains(&pin.body)) {
        let Some(a) = island.attachments[pin].and_then(|a| contents.attachments.get_mut(a)) else { continue };
        let cable = &prediction.impedances[constraint.cable];
        let own = cable.nodes().iter().position(|&node| node == constraint.node);
        let impedance = own.and_then(|own| cable.compliance(own, own).try_inverse()).unwrap_or_else(Matrix3::zeros);
        let drive = Drive { impedance, target: Vector3::zeros(), load: Some(load(a)) };
        let ledger = a.ledger.unwrap_or_else(|| Ledger::insert(world, a.body));
        a.ledger.insert(ledger.asleep(world, a.body)).set_motors(world, &a.anchor, &drive, h);
    }
    Ok(())
}

/// Returns whether the motors of all bodies of an island hold them in steps of `h` (s).
pub(crate) fn are_held(contents: &Contents, island: &Island, h: f64) -> bool {
    let on_body = |pin: &PinConstraint| island.members[pin.body].body().is_some();
    let mut attached = island.pins.iter().zip(&island.attachments).filter(|(pin, _)| on_body(pin));
    attached.all(|(_, index)| {
        let ledger = index.and_then(|index| contents.attachments.get(index)).and_then(|a| a.ledger);
        ledger.and_then(|ledger| ledger.rest).is_some_and(|(_, step)| step == h)
    })
}

/// Disables the motors of attachments, but those that hold a sleeping body.
pub(crate) fn disable_motors(contents: &Contents, world: &mut PhysicsWorld, attachments: impl Iterator<Item = usize>) {
    for ledger in attachments.filter_map(|a| contents.attachments.get(a)?.ledger).filter(|l| l.rest.is_none()) {
        ledger.disable(world);
    }
}

/// Returns whether member `m` of an island is a body that may deviate from its prediction.
fn deviates(
    contents: &Contents,
    world: &PhysicsWorld,
    island: &Island,
    prediction: &Prediction,
    m: usize,
    step: &StepParameters,
) -> bool {
    let (Member::Body(handle), Some(_)) = (island.members[m], &prediction.applied[m]) else { return false };
    let displacement = prediction.end[m].position - prediction.start[m].position;
    if !bears_motors(prediction, m) {
        return false;
    }
    proximity::may_deviate(world, handle)
        || proximity::may_collide(world, handle, (step.h, step.fastest))
        || !contents.records.get(handle).is_some_and(|record| record.stepped)
            && proximity::overlaps(world, handle, &displacement)
}

/// Returns whether Rapier's step can bear motors on a member, and may need them. Its sweeps over
/// impulse joints do not converge with motors on several bodies of a chain: two ropes on an arm of
/// three welded links of 1 kg then blow up. In a mechanism that touches nothing they would only
/// work against joints that have not converged, or, of a multibody that turns, against the arc of
/// its anchor: a lever of 1 m with two loads opened gaps of 2 mm at 3 rad/s. The limits of a
/// multibody, however, Rapier does not keep without error: the force on a chain of twelve links
/// with limits at 0 ripples by 3 % without motors.
fn bears_motors(prediction: &Prediction, m: usize) -> bool {
    let alone = prediction.groups.iter().all(|group| group.members.len() == 1 || group.place(m).is_none());
    let bears = |mechanism: &Mechanism| {
        let free = mechanism.loads.isolated && !mechanism.loads.limited;
        (mechanism.is_multibody() || alone) && !free
    };
    prediction.mechanisms[m].as_ref().is_none_or(bears)
}

/// Linearises the cables of an island for a step of `h` (s) at the pins that `moves` names by their
/// indices; the others do as `others` says.
pub(super) fn linearise(
    contents: &mut Contents,
    island: &Island,
    prediction: &mut Prediction,
    moves: impl Fn(usize) -> bool,
    (others, h): (Others, f64),
) -> Result<(), Error> {
    let Prediction { impedances, nodes, driven, .. } = prediction;
    impedances.resize_with(island.cables.len(), Default::default);
    let mut outcome = Ok(());
    contents.for_cables(&island.cables, |c, cable| {
        let of_cable = || island.pins.iter().enumerate().filter(|(_, pin)| pin.cable == c);
        nodes.clear();
        nodes.extend(of_cable().filter(|(index, _)| moves(*index)).map(|(_, pin)| pin.node));
        if outcome.is_ok() && !nodes.is_empty() {
            let is_driven = |pin: &PinConstraint| matches!(island.members[pin.body], Member::Driven(_));
            driven.clear();
            driven.extend(of_cable().filter(|(i, pin)| is_driven(pin) && !moves(*i)).map(|(_, pin)| pin.node));
            outcome = match others {
                Others::Free => impedances[c].update_beside(cable, nodes, driven, h),
                Others::Held => impedances[c].update_held(cable, nodes, h),
            };
        }
    });
    Ok(outcome?)
}

/// Reads the impulses of the motors of an island in a step of `h` (s).
pub(super) fn take_impulses(
    contents: &Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
) {
    prediction.impulses.clear();
    for (pin, on) in prediction.motors.iter().enumerate() {
        let attachment = island.attachments[pin].and_then(|a| contents.attachments.get(a));
        let ledger = attachment.filter(|_| *on).and_then(|a| a.ledger);
        prediction.impulses.push(ledger.map_or_else(Vector3::zeros, |ledger| ledger.take_impulse(world, h)));
    }
}

/// Returns impulse and angular impulse of the motors on a member.
pub(super) fn motor_impulse(island: &Island, prediction: &Prediction, m: usize) -> Vector6<f64> {
    let of_pin = |pin: usize| {
        let p = &prediction.impulses[pin];
        stack_spatial(p, &(prediction.end[m].rotation * island.pins[pin].anchor).cross(p))
    };
    island.pins_on(m).map(of_pin).sum()
}

/// Replaces the impulses of the motors on a member by those that let its cables follow it where it
/// is `exact`ly, after a step of `h` (s).
pub(super) fn follow_body(island: &Island, prediction: &mut Prediction, (m, exact): (usize, &ExactState), h: f64) {
    for pin in island.pins_on(m).filter(|pin| prediction.motors[*pin]) {
        let anchor = &island.pins[pin].anchor;
        if let Some(impedance) = driving_point(island, prediction, pin) {
            prediction.impulses[pin] = impedance * (prediction.end[m].point(anchor) - exact.point(anchor)) / h;
        }
    }
}

/// Gives the cables the opposite of their motors' impulses on bodies that deviated.
pub(super) fn apply_motor_impulses(contents: &mut Contents, island: &Island, prediction: &mut Prediction) {
    let Prediction { impulses, impulses_at: at, impedances, .. } = prediction;
    contents.for_cables(&island.cables, |c, cable| {
        let on_cable = || island.pins.iter().zip(&*impulses).filter(|(pin, _)| pin.cable == c);
        if on_cable().any(|(_, p)| *p != Vector3::zeros()) {
            let of_node = |&node: &usize| on_cable().find(|(pin, _)| pin.node == node);
            at.clear();
            at.extend(impedances[c].nodes().iter().map(|node| of_node(node).map_or_else(Vector3::zeros, |(_, p)| *p)));
            impedances[c].apply_impulses(cable, at);
        }
    });
}
