//! What integrators carry from step to step, for a system that is put together anew at every step.
//!
//! Accelerations (generalised-alpha: two kinds) are kept with each cable and each body, and taken up again if nothing has changed:
//! without them every step would begin with an acceleration solve, and methods with memory would be of order 1. They are
//! dropped when a cable, its supports or its pins were changed, when forces on a body or its motion were, or a gap is open.

use super::rotation::angular_acceleration;
use super::workspace::{Workspace, vector};
use super::{PinConstraint, RigidBody};
use crate::cable::Cable;
use crate::integrate::State;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// Accelerations of a body at the end of a step, in m/s^2 and rad/s^2, world axes; plain data, part of a snapshot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyMemory {
    acceleration: [Vector3<f64>; 2],
    algorithmic: Option<[Vector3<f64>; 2]>,
    force: Vector3<f64>,
    torque: Vector3<f64>,
    mass: f64,
    inertia: Matrix3<f64>,
    free: [bool; 6],
    pins: usize,
}

fn pins_of(pins: &[PinConstraint], body: usize) -> usize {
    pins.iter().filter(|p| p.body == body).count()
}

/// Accelerations from cables and bodies into `phase`, if all of them are still those of its state.
pub(super) fn recall(
    cables: &mut [&mut Cable],
    bodies: &[RigidBody],
    pins: &[PinConstraint],
    phase: &mut State,
    workspace: &Workspace,
) {
    let memory = &mut phase.memory;
    memory.acceleration.clear();
    memory.algorithmic.clear();
    cables.iter_mut().for_each(|c| c.refresh_memory());
    let driven = |b: &RigidBody| b.free == [false; 6];
    let same = |(i, b): (usize, &RigidBody)| {
        let kept = |m: &BodyMemory| {
            let loads = m.force == b.force && m.torque == b.torque && m.pins == pins_of(pins, i);
            loads && m.mass == b.mass && m.inertia == b.inertia && m.free == b.free
        };
        driven(b) || b.memory.as_ref().is_some_and(kept)
    };
    memory.valid = workspace.closed()
        && cables.iter().all(|c| c.snapshot.state.memory.valid)
        && bodies.iter().enumerate().all(same);
    if !memory.valid {
        return;
    }
    let algorithmic = |b: &RigidBody| driven(b) || b.memory.is_some_and(|m| m.algorithmic.is_some());
    let both = bodies.iter().all(algorithmic)
        && cables.iter().all(|c| c.snapshot.state.memory.algorithmic.len() == c.positions().len());
    for cable in cables.iter() {
        let own = &cable.snapshot.state.memory;
        memory.acceleration.extend_from_slice(&own.acceleration);
        if both {
            memory.algorithmic.extend_from_slice(&own.algorithmic);
        }
    }
    let flat = |a: [Vector3<f64>; 2]| [a[0].x, a[0].y, a[0].z, a[1].x, a[1].y, a[1].z];
    for body in bodies {
        // the chart is at its origin: its accelerations are angular accelerations
        memory.acceleration.extend(body.memory.map_or([0.0; 6], |m| flat(m.acceleration)));
        if both {
            memory.algorithmic.extend(body.memory.and_then(|m| m.algorithmic).map_or([0.0; 6], flat));
        }
    }
}

/// Keeps the accelerations of `phase` with the cables and bodies they belong to.
pub(super) fn keep(cables: &mut [&mut Cable], bodies: &mut [RigidBody], pins: &[PinConstraint], phase: &State) {
    let memory = &phase.memory;
    let both = memory.algorithmic.len() == memory.acceleration.len();
    let mut at = 0;
    for cable in cables.iter_mut() {
        let n = cable.positions().len();
        let own = &mut cable.snapshot.state.memory;
        own.acceleration.clear();
        own.acceleration.extend_from_slice(&memory.acceleration[at..at + n]);
        own.algorithmic.clear();
        if both {
            own.algorithmic.extend_from_slice(&memory.algorithmic[at..at + n]);
        }
        own.valid = memory.valid;
        own.step = memory.step;
        at += n;
    }
    for (i, body) in bodies.iter_mut().enumerate() {
        let (theta, rate) = (vector(&phase.q[at + 6 * i + 3..]), vector(&phase.v[at + 6 * i + 3..]));
        let own = at + 6 * i..at + 6 * i + 6;
        let of = |a: &[f64]| {
            let a = &a[own.clone()];
            [vector(a), angular_acceleration(1.0, &theta, &rate, &vector(&a[3..]))]
        };
        body.memory = memory.valid.then(|| BodyMemory {
            acceleration: of(&memory.acceleration),
            algorithmic: both.then(|| of(&memory.algorithmic)),
            force: body.force,
            torque: body.torque,
            mass: body.mass,
            inertia: body.inertia,
            free: body.free,
            pins: pins_of(pins, i),
        });
    }
}
