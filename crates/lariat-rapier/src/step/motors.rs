//! The impulses of motors in a Rapier step: on bodies, and on their cables.
//!
//! # Equation
//! ```text
//! cable:     dv = -A^-1 J^T p      dx = h dv
//! ```
//! p is the impulse of the motors on a body that deviated from its prediction.
//!
//! # Validity
//! Rapier solves joints before contacts, so that the motors on a jammed body carry a small share of its load in every step. In fidelity game
//! the tension next to it therefore differs by 0.1 % on a wire with twice the critical damping of its first mode, and by 1 % with 20 times (test
//! contact.rs); what is read at the body does not.
//!
//! # Alternatives considered
//! An offset learnt from p, loaded against it and taken from what the cable gets: exact where it settles, and a body of 1 kg that 1 kN press
//! against a stop is thrown, with a discrete gradient on a wire with that damping, whatever share of p the offset takes in a step.

use crate::contents::Contents;
use crate::islands::Island;
use crate::spatial::stack_spatial;
use crate::step::prediction::Prediction;
use ::nalgebra::{Vector3, Vector6};
use rapier::pipeline::PhysicsWorld;

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
