//! The estimate of the forces of contacts and joints on a body.
//!
//! # Equation
//! ```text
//! r += 0.3 (s (L (v_after - v0) - p + r h)/h + s' L (x_after - x1)/h^2 - r)
//! ```
//! v0 is the velocity that Rapier was given, x1 the predicted place, p the impulse of the motors,
//! and L the inertia of the body with its mechanism. Of the impulse of contacts and joints in the
//! step, the share s is expected again: what bears a load leaves the motion of the body as it is (s
//! = 1), a blow is gone with the momentum that it gave (s = 0). So it is with places, s' <= s: what
//! keeps a body where it is bears a load; Rapier also pushes a body out of what it has passed into,
//! and continuous collision detection stops it at what it would pass, both without a force.
//!
//! # Validity
//! In a Rapier step of h < T = 1/1920 s the factor 0.3 becomes `0.3 h/T`, and places count
//! `(h/T)^2`: the estimate then has the time constant, and an error of a place the force, of a step
//! of T. What single precision rounds would else be a force of 1/h and 1/h^2: 1.8e8 N of 1 kg on a
//! hinge at 1e-9 s (test host_steps.rs).
//!
//! # Alternatives considered
//! The share s for places too: a ball with a thread rebounds with 0.09 to 0.14 of its speed where
//! continuous collision detection stops it. Leaving p out: bodies of 1 to 5 kg on a steel wire
//! leave a jam when the host step is not split.

use crate::body::record::BodyRecord;
use crate::body::spatial::stack_spatial;
use crate::mechanism::{own_inertia, velocity_of};
use crate::scales::step::{REACTION_GAIN, SHORTEST_REACTION};
use crate::step::prediction::BodyStep;
use ::nalgebra::Vector6;
use lariat_ancf::island::RigidBody;

/// Updates the estimate of the force and torque of contacts and joints from the deviations of
/// velocity and position of a body that is `settled`.
pub(super) fn update_reaction(
    step: &BodyStep,
    settled: &RigidBody,
    record: &mut BodyRecord,
    (deviation, velocity): (&Vector6<f64>, &Vector6<f64>),
    motors: &Vector6<f64>,
) {
    let &BodyStep { start, end, h, .. } = step;
    let way = |from: &RigidBody| {
        let turned = (settled.rotation * from.rotation.inverse()).scaled_axis();
        stack_spatial(&((settled.position - from.position) / h), &(turned / h))
    };
    let (inertia, known) = (own_inertia(end), record.reaction * h - motors);
    let whole = known + inertia * deviation;
    let square = inertia.cholesky().map_or(0.0, |inertia| whole.dot(&inertia.solve(&whole)));
    let share = persisting_share(whole.dot(&(velocity - velocity_of(start))), square);
    let moved = way(end);
    let pushed = inertia * moved * weight_of_places(h);
    let share_pushed = persisting_share(pushed.dot(&(way(start) - velocity_of(start))), pushed.dot(&moved));
    let lasting = whole * share + pushed * share.min(share_pushed);
    record.reaction += gain(h) * (lasting / h - record.reaction);
}

/// Returns the share of an observed force that an estimate takes in a step of `h` (s).
pub(super) fn gain(h: f64) -> f64 {
    REACTION_GAIN * (h / SHORTEST_REACTION).min(1.0)
}

/// Returns what a deviation of a place in a step of `h` (s), divided by it, counts.
pub(super) fn weight_of_places(h: f64) -> f64 {
    (h / SHORTEST_REACTION).min(1.0).powi(2)
}

/// Returns the share of an impulse that did not change the motion of what it acted on: `work` is
/// its product with the velocities gained, `square` that with the velocities that it would give.
pub(super) fn persisting_share(work: f64, square: f64) -> f64 {
    if square > 0.0 { (1.0 - work / square).clamp(0.0, 1.0) } else { 1.0 }
}
