//! The next pins of a cable beside one at which a body deviates from its prediction.
//!
//! # Equation
//! ```text
//! D = the block of the pin in (C + B)^-1
//! B_i = 1/m - [r]x I^-1 [r]x,     of the body of the pin itself times MOBILITY_SHARE
//! q = -(C_nn + B_n)^-1 C_np p
//! body:     dv = M^-1 q
//! ```
//! n are the next pins on other bodies to both sides, and the next ones on bodies with prescribed
//! motion, whose mobility is zero, as is that of sleeping bodies. The impedance D of the cable,
//! with which its motors act on the body, presumes that these pins move as far as their bodies let
//! them. So they do: when the motors exerted p, the cable gets the opposite of q there beside that
//! of p, and the bodies get q. A driven body does not move, nor does the cable there; what is free
//! and touches nothing moves by its change of velocity times the step, as the cable there does; of
//! others the velocity changes, and what they touch answers in the next step.
//!
//! # Validity
//! Of each pin by itself: the impulses of several add up. Pins beyond the next ones, up to the next
//! driven one, move with the cable as if free; those beyond that are held.
//!
//! # Alternatives considered
//! The opposite of p alone on the cable: D is that of the cable between its bodies, but the cable
//! then answers as one that nothing else holds. Below a jib that had turned, a crate of 500 kg that
//! a steel rope of 19 m (11 kg) sets down at 0.4 m/s lifted the whole rope by 66 mm off the jib,
//! with 300 J; below a body of 2 t by 43 mm.

use crate::body::record::{BodyRecord, ExactState};
use crate::body::spatial::{split_spatial, stack_spatial};
use crate::contents::Contents;
use crate::convert::{to_pose, to_vector, vector};
use crate::islands::{Island, Member};
use crate::scales::step::{JUNCTION_MASS, MOBILITY_SHARE};
use crate::step::prediction::Prediction;
use ::nalgebra::{Matrix3, SMatrix, SVector, UnitQuaternion, Vector3, Vector6};
use lariat_ancf::island::RigidBody;
use rapier::pipeline::PhysicsWorld;

/// A pin and the next ones of which it takes notice.
type Pins = [Option<usize>; 5];

/// Three rows and columns of each of them.
type OfPins = SMatrix<f64, 15, 15>;

/// Returns a pin, the next ones on other bodies before and after it on its cable, and the next ones
/// on driven bodies, where these are others.
pub(super) fn with_next(island: &Island, pin: usize) -> Pins {
    let pins = &island.pins;
    let own = &pins[pin];
    let others = || (0..pins.len()).filter(|&p| pins[p].cable == own.cable && pins[p].body != own.body);
    let is_driven = |p: &usize| matches!(island.members[pins[*p].body], Member::Driven(_));
    let (node, place) = (|p: &usize| pins[*p].node, own.node);
    let before = others().filter(|p| node(p) < place).max_by_key(node);
    let after = others().filter(|p| node(p) > place).min_by_key(node);
    let driven_before = others().filter(is_driven).filter(|p| node(p) < place).max_by_key(node);
    let driven_after = others().filter(is_driven).filter(|p| node(p) > place).min_by_key(node);
    let unless = |pin: Option<usize>, known| pin.filter(|_| pin != known);
    [Some(pin), before, after, unless(driven_before, before), unless(driven_after, after)]
}

/// Returns C + B of some pins of a cable, of the first with a `share` of its B; where there is no
/// pin, the rows are those of a unit matrix.
fn compliance(island: &Island, prediction: &Prediction, pins: &Pins, share: f64) -> OfPins {
    let mut matrix = OfPins::identity();
    let places = pins.map(|pin| {
        let pin = &island.pins[pin?];
        let cable = &prediction.impedances[pin.cable];
        Some((cable, pin, cable.nodes().iter().position(|&node| node == pin.node)?))
    });
    for (a, (cable, one, i)) in places.iter().enumerate().filter_map(|(a, place)| Some((a, place.as_ref()?))) {
        for (b, (.., j)) in places.iter().enumerate().filter_map(|(b, place)| Some((b, place.as_ref()?))) {
            matrix.fixed_view_mut::<3, 3>(3 * a, 3 * b).copy_from(&cable.compliance(*i, *j));
        }
        // a body that sleeps stays where it is
        if island.members[one.body].body().is_some() && prediction.applied[one.body].is_none() {
            continue;
        }
        let mut own = matrix.fixed_view_mut::<3, 3>(3 * a, 3 * a);
        own += mobility(&prediction.start[one.body], &one.anchor) * if a == 0 { share } else { 1.0 };
    }
    matrix
}

/// Returns D of a pin; `None` if there is no inverse.
pub(super) fn driving_point(island: &Island, prediction: &Prediction, pin: usize) -> Option<Matrix3<f64>> {
    let matrix = compliance(island, prediction, &with_next(island, pin), MOBILITY_SHARE);
    let inverse = matrix.lu().solve(&SMatrix::<f64, 15, 3>::identity())?;
    Some(inverse.fixed_view::<3, 3>(0, 0).into_owned())
}

/// Returns the velocity of a point of a body per impulse on it, in 1/kg, as far as its axes are
/// free.
fn mobility(body: &RigidBody, anchor: &Vector3<f64>) -> Matrix3<f64> {
    let lever = (body.rotation * anchor).cross_matrix();
    let (linear, angular) = mobilities(body);
    linear - lever * angular * lever
}

/// Returns the velocity of a body per impulse, and its angular velocity per angular impulse.
fn mobilities(body: &RigidBody) -> (Matrix3<f64>, Matrix3<f64>) {
    let free = |from: usize| Matrix3::from_diagonal(&Vector3::from_fn(|x, _| f64::from(u8::from(body.free[from + x]))));
    let inverse = body.world_inertia(&body.rotation).try_inverse().unwrap_or_else(Matrix3::zeros);
    (free(0) / body.mass.max(JUNCTION_MASS), free(3) * inverse * free(3))
}

/// Passes on the impulses of the motors of an island in a step of `h` (s) to the next pins, and to
/// the bodies there.
pub(super) fn pass_on(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
) {
    let mut passed = core::mem::take(&mut prediction.passed);
    passed.clear();
    passed.resize(island.pins.len(), Vector3::zeros());
    for pin in 0..prediction.impulses.len() {
        if prediction.impulses[pin] != Vector3::zeros() {
            add_passed(island, prediction, pin, &mut passed);
        }
    }
    for (sum, passed) in prediction.impulses.iter_mut().zip(&passed) {
        *sum += passed;
    }
    for (m, member) in island.members.iter().enumerate() {
        let (Member::Body(handle), Some(applied)) = (member, &prediction.applied[m]) else { continue };
        let awake = world.bodies.get(*handle).is_some_and(|body| !body.is_sleeping());
        let body = &prediction.end[m];
        let on_body = |pin: usize| {
            let arm = body.rotation * island.pins[pin].anchor;
            stack_spatial(&passed[pin], &arm.cross(&passed[pin]))
        };
        let impulse: Vector6<f64> = island.pins_on(m).map(on_body).sum();
        if !awake || impulse == Vector6::zeros() {
            continue;
        }
        match &prediction.mechanisms[m] {
            Some(mechanism) => mechanism.apply_impulse(world, &impulse),
            None => {
                let moves = if applied.landed && applied.isolated { h } else { 0.0 };
                push(world, contents.records.record_mut(*handle), (body, &impulse), moves);
            }
        }
    }
    prediction.passed = passed;
}

/// Adds the impulses at the next pins of one at which motors exerted an impulse.
fn add_passed(island: &Island, prediction: &Prediction, pin: usize, passed: &mut [Vector3<f64>]) {
    let pins = with_next(island, pin);
    let mut matrix = compliance(island, prediction, &pins, 0.0);
    let of_own = matrix.fixed_view::<15, 3>(0, 0) * prediction.impulses[pin];
    // the impulse of the motors is known
    matrix.fixed_view_mut::<3, 15>(0, 0).fill(0.0);
    matrix.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
    let mut sides: SVector<f64, 15> = -of_own;
    sides.fixed_rows_mut::<3>(0).fill(0.0);
    let Some(found) = matrix.lu().solve(&sides) else { return };
    for (i, pin) in pins.iter().enumerate().skip(1) {
        if let Some(pin) = pin {
            passed[*pin] += found.fixed_rows::<3>(3 * i);
        }
    }
}

/// Pushes a body that no joint holds by an impulse and its moment about the centre of mass; it
/// moves by what its velocity changes times `moves` (s).
fn push(world: &mut PhysicsWorld, record: &mut BodyRecord, (end, impulse): (&RigidBody, &Vector6<f64>), moves: f64) {
    let (Some(exact), Some(body)) = (&record.exact, world.bodies.get_mut(record.handle)) else { return };
    let ((linear, angular), (force, torque)) = (mobilities(end), split_spatial(impulse));
    let (change, turn) = (linear * force, angular * torque);
    let mut after = end.clone();
    after.position = exact.position + change * moves;
    after.rotation = UnitQuaternion::from_scaled_axis(turn * moves) * exact.rotation;
    after.memory = None;
    let (velocity, spin) = (exact.velocity + change, exact.angular_velocity + turn);
    body.set_linvel(to_vector(&velocity), false);
    body.set_angvel(to_vector(&spin), false);
    if moves > 0.0 {
        let origin = after.position - after.rotation * vector(body.local_center_of_mass());
        body.set_position(to_pose(&origin, &after.rotation), false);
    }
    record.exact = Some(ExactState::new(&after, (velocity, spin), body));
}
