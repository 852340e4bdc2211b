//! The impedance of the cables within Rapier's step: motors on bodies that may deviate from their
//! prediction.
//!
//! # Equation
//! ```text
//! D = (C + e B)^-1      B = 1/m - [r]x I^-1 [r]x      e = 0.1
//! ```
//! C is the compliance of the cable at a pin over the step ([`Impedance`]), its other pins free, B the mobility of the body alone. A
//! [`Ledger`] acts on the body with D about the predicted velocity of the
//! anchor: if the prediction was right it does nothing; if a contact or a joint makes the body
//! deviate, the body feels the cable within the same step. A sleeping body is predicted to rest under the force of its
//! cables, which stands in the motors for as long as it sleeps: should Rapier wake it within a step, it feels them.
//!
//! # Alternatives considered
//! The block of the pin in (C + B)^-1 over all pins of the body and the next ones on its cables, with the mobilities of their bodies
//! and of their mechanisms: no case was found in which it does better.
//!
//! [`Impedance`]: lariat_ancf::island::Impedance

use crate::attachment::Attachment;
use crate::contents::Contents;
use crate::error::Error;
use crate::islands::{Island, Member};
use crate::ledger::{Drive, Ledger};
use crate::mechanism::Mechanism;
use crate::proximity;
use crate::step::prediction::Prediction;
use ::nalgebra::{Matrix3, Vector3};
use lariat_ancf::Cable;
use lariat_ancf::island::{Impedance, PinConstraint};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// e: share of the body's mobility that its motors yield by.
const MOBILITY_SHARE: f64 = 0.1;

/// Linearises a cable at some nodes for a step: [`Impedance::update`] or [`Impedance::update_held`].
pub(super) type Update = fn(&mut Impedance, &mut Cable, &[usize], f64) -> Result<(), lariat_ancf::Error>;

/// Sets the motors of all bodies of an island that may deviate from their prediction in a step of `h` (s), and disables
/// all others.
pub(crate) fn set_motors(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
) -> Result<(), Error> {
    prediction.motors.clear();
    prediction.motors.resize(island.pins.len(), false);
    let sleeps = |handle: RigidBodyHandle| world.bodies[handle].is_sleeping();
    if island.bodies().any(sleeps) {
        hold(contents, world, island, prediction, h, |a| {
            [a.predicted.impulse, a.predicted.angular_impulse].map(|p| p / h)
        })?;
    }
    let mut deviating = core::mem::take(&mut prediction.deviating);
    deviating.clear();
    deviating.extend((0..island.members.len()).filter(|&m| deviates(contents, world, island, prediction, m)));
    linearise(contents, island, prediction, &deviating, (Impedance::update, h))?;
    for (pin, constraint) in island.pins.iter().enumerate().filter(|(_, pin)| deviating.contains(&pin.body)) {
        let Some(a) = island.attachments[pin].and_then(|a| contents.attachments.get_mut(a)) else { continue };
        let (start, end) = (&prediction.start[constraint.body], &prediction.end[constraint.body]);
        let target = (end.point(&constraint.anchor) - start.point(&constraint.anchor)) / h;
        let lever = (start.rotation * constraint.anchor).cross_matrix();
        let inverse = start.world_inertia(&start.rotation).try_inverse().unwrap_or_else(Matrix3::zeros);
        let mobility = Matrix3::identity() / start.mass - lever * inverse * lever;
        let cable = &prediction.impedances[constraint.cable];
        if let Some(impedance) = driving_point(cable, constraint.node, &(mobility * MOBILITY_SHARE)) {
            let ledger = a.ledger.get_or_insert_with(|| Ledger::insert(world, a.body));
            ledger.set_motors(world, &a.anchor, &Drive { impedance, target, load: None }, h);
            prediction.motors[pin] = true;
        }
    }
    prediction.deviating = deviating;
    let off = island.attachments.iter().zip(&prediction.motors).filter(|(_, on)| !**on).filter_map(|(a, _)| *a);
    disable_motors(contents, world, off);
    Ok(())
}

/// Lets the motors on the sleeping bodies of an island exert what its cables do in a step of `h` (s) in which the bodies
/// do not move: `load` (N and N m), and the impedance of the cables with all other pins held.
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
    linearise(contents, island, prediction, &asleep, (Impedance::update_held, h))?;
    for (pin, constraint) in island.pins.iter().enumerate().filter(|(_, pin)| asleep.contains(&pin.body)) {
        let Some(a) = island.attachments[pin].and_then(|a| contents.attachments.get_mut(a)) else { continue };
        let impedance = driving_point(&prediction.impedances[constraint.cable], constraint.node, &Matrix3::zeros());
        let impedance = impedance.unwrap_or_else(Matrix3::zeros);
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
fn deviates(contents: &Contents, world: &PhysicsWorld, island: &Island, prediction: &Prediction, m: usize) -> bool {
    let (Member::Body(handle), Some(_)) = (island.members[m], &prediction.applied[m]) else { return false };
    let displacement = prediction.end[m].position - prediction.start[m].position;
    if !bears_motors(prediction, m) {
        return false;
    }
    proximity::may_deviate(world, handle)
        || !contents.records.get(handle).is_some_and(|record| record.stepped)
            && proximity::overlaps(world, handle, &displacement)
}

/// Returns whether Rapier's step can bear motors on a member, and may need them. Its sweeps over impulse joints do not converge with motors
/// on several bodies of a chain: two ropes on an arm of three welded links of 1 kg then blow up. In a mechanism that touches nothing they
/// would only work against joints that have not converged, or, of a multibody that turns, against the arc of its anchor: a lever of 1 m
/// with two loads opened gaps of 2 mm at 3 rad/s. The limits of a multibody, however, Rapier does not keep without error: the force on a
/// chain of twelve links with limits at 0 ripples by 3 % without motors.
fn bears_motors(prediction: &Prediction, m: usize) -> bool {
    let alone = prediction.groups.iter().all(|group| group.members.len() == 1 || group.place(m).is_none());
    let bears = |mechanism: &Mechanism| {
        let free = mechanism.loads.isolated && !mechanism.loads.limited;
        (mechanism.is_multibody() || alone) && !free
    };
    prediction.mechanisms[m].as_ref().is_none_or(bears)
}

/// Linearises the cables of an island at their pins on `members` for a step of `h` (s), with the other pins as `update` says.
pub(super) fn linearise(
    contents: &mut Contents,
    island: &Island,
    prediction: &mut Prediction,
    members: &[usize],
    (update, h): (Update, f64),
) -> Result<(), Error> {
    let Prediction { impedances, nodes, .. } = prediction;
    impedances.resize_with(island.cables.len(), Default::default);
    let mut outcome = Ok(());
    contents.for_cables(&island.cables, |c, cable| {
        let of_cable = island.pins.iter().filter(|pin| pin.cable == c && members.contains(&pin.body));
        nodes.clear();
        nodes.extend(of_cable.map(|pin| pin.node));
        if outcome.is_ok() && !nodes.is_empty() {
            outcome = update(&mut impedances[c], cable, nodes, h);
        }
    });
    Ok(outcome?)
}

/// Returns the impedance in kg of a cable at a node, and of what has a `mobility` (1/kg) in series with it.
fn driving_point(cable: &Impedance, node: usize, mobility: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let own = cable.nodes().iter().position(|&n| n == node)?;
    (cable.compliance(own, own) + mobility).try_inverse()
}
