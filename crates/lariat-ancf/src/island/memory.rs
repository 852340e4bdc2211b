//! The accelerations that integrators carry from step to step, of a system that is assembled anew
//! at every step.
//!
//! Accelerations (true ones, and algorithmic ones if the method has them) are stored with each
//! cable and each body, and used again if nothing has changed. Without them every step would begin
//! with an acceleration solve, and methods with memory would be of order 1. They are dropped if a
//! cable, its supports or its pins have changed, if the forces on a body or its motion have, or if
//! a gap is open.

use super::body::{BodyMemory, RigidBody};
use super::hold::vector;
use super::layout::Layout;
use super::pin::PinConstraint;
use super::rotation::angular_acceleration;
use crate::cable::Cable;
use crate::state::State;
use nalgebra::Vector3;

/// Returns the number of pins of a body.
fn pins_of(pins: &[PinConstraint], body: usize) -> usize {
    pins.iter().filter(|p| p.body == body).count()
}

/// Collects the accelerations of cables and bodies in `state`, if all of them still belong to it.
pub(super) fn recall(cables: &mut [&mut Cable], bodies: &[RigidBody], layout: &Layout, state: &mut State) {
    let memory = &mut state.memory;
    memory.acceleration.clear();
    memory.algorithmic.clear();
    cables.iter_mut().for_each(|c| c.refresh_memory());
    let same = |(i, b): (usize, &RigidBody)| {
        let kept = |m: &BodyMemory| {
            let loads = m.force == b.force && m.torque == b.torque && m.pins == pins_of(&layout.pins, i);
            loads && m.mass == b.mass && m.inertia == b.inertia && m.free == b.free
        };
        b.is_driven() || b.memory.as_ref().is_some_and(kept)
    };
    memory.valid = layout.is_closed()
        && cables.iter().all(|c| c.snapshot.state.memory.valid)
        && bodies.iter().enumerate().all(same);
    if !memory.valid {
        return;
    }
    let algorithmic = |b: &RigidBody| b.is_driven() || b.memory.is_some_and(|m| m.algorithmic.is_some());
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

/// Stores the accelerations of `state` with the cables and bodies they belong to.
pub(super) fn keep(cables: &mut [&mut Cable], bodies: &mut [RigidBody], pins: &[PinConstraint], state: &State) {
    let memory = &state.memory;
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
        own.energy_made = memory.energy_made;
        own.largest_energy = memory.largest_energy;
        at += n;
    }
    for (i, body) in bodies.iter_mut().enumerate() {
        let (theta, rate) = (vector(&state.q[at + 6 * i + 3..]), vector(&state.v[at + 6 * i + 3..]));
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
            differences: None,
        });
    }
}
