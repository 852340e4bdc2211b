//! The impedance of the cables within Rapier's step: motors on bodies that may deviate from their
//! prediction.
//!
//! # Equation
//! ```text
//! D = the block of its pin in (C + B')^-1
//! B'_ij = 1/m - [r_i]x I^-1 [r_j]x,   of the body itself times OWN_MOBILITY_SHARE
//! ```
//! C is the compliance of the body's cables over the step ([`Impedance`]) at its pins and at the next
//! ones on these cables, B' the mobility of the bodies at these pins. A [`Ledger`] acts on the body with D about the predicted velocity of the
//! anchor: if the prediction was right it does nothing; if a contact or a joint makes the body
//! deviate, the body feels the cable within the same step. A sleeping body is predicted to rest under the force of its
//! cables, which stands in the motors for as long as it sleeps: should Rapier wake it within a step, it feels them.
//!
//! [`Impedance`]: lariat_ancf::island::Impedance

use crate::attachment::Attachment;
use crate::contents::Contents;
use crate::error::Error;
use crate::islands::{Island, Member};
use crate::ledger::{Drive, Ledger};
use crate::mechanism::{Group, Mechanism};
use crate::proximity;
use crate::step::prediction::{Prediction, StepParameters};
use crate::step::substepping;
use ::nalgebra::{Cholesky, DMatrix, Matrix3, Matrix6, Vector3};
use lariat_ancf::Cable;
use lariat_ancf::island::{Impedance, PinConstraint, RigidBody};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Mass in kg given to a junction, which has none, so that the matrix has an inverse.
const JUNCTION_MASS: f64 = 1e-6;
/// Share of the body's own mobility in B'.
pub(crate) const OWN_MOBILITY_SHARE: f64 = 0.1;

/// Sets the motors of all bodies of an island that may deviate from their prediction, and disables
/// all others.
pub(crate) fn set_motors(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) -> Result<(), Error> {
    prediction.motors.clear();
    prediction.motors.resize(island.pins.len(), false);
    let sleeps = |handle: RigidBodyHandle| world.bodies[handle].is_sleeping();
    if island.bodies().any(sleeps) {
        hold(contents, world, island, prediction, step.h, |a| {
            [a.predicted.impulse, a.predicted.angular_impulse].map(|p| p / step.h)
        })?;
    }
    let mut deviating = core::mem::take(&mut prediction.deviating);
    let mut point = core::mem::take(&mut prediction.driving_point);
    deviating.clear();
    deviating.extend((0..island.members.len()).filter(|&m| deviates(contents, world, island, prediction, m, step)));
    if !deviating.is_empty() {
        point.find_pins(island, &prediction.groups, &deviating);
        let update =
            |cable: &mut Cable, nodes: &[usize], impedance: &mut Impedance| impedance.update(cable, nodes, step.h);
        linearise(contents, island, prediction, &point.pins, update)?;
    }
    for &m in &deviating {
        point.find_pins(island, &prediction.groups, &[m]);
        if !point.solve(island, prediction, m) {
            continue;
        }
        for (pin, impedance) in point.own(island, m) {
            let anchor = island.pins[pin].anchor;
            let target = (prediction.end[m].point(&anchor) - prediction.start[m].point(&anchor)) / step.h;
            if let Some(a) = island.attachments[pin].and_then(|a| contents.attachments.get_mut(a)) {
                let ledger = a.ledger.get_or_insert_with(|| Ledger::insert(world, a.body));
                ledger.set_motors(world, &a.anchor, &Drive { impedance, target, load: None }, step.h);
                let cable = contents.cables.get(a.cable.0 as usize).map(|slot| &slot.cable);
                let response = &prediction.impedances[island.pins[pin].cable];
                a.shown = cable.and_then(|cable| substepping::shown_stiffness(cable, a.node, response, step.h));
                prediction.motors[pin] = true;
            }
        }
    }
    (prediction.deviating, prediction.driving_point) = (deviating, point);
    let off = || island.attachments.iter().zip(&prediction.motors).filter(|(_, on)| !**on).filter_map(|(a, _)| *a);
    off().for_each(|index| contents.attachments.get_mut(index).into_iter().for_each(|a| a.shown = None));
    disable_motors(contents, world, off());
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
    linearise_at(contents, island, prediction, &asleep, h)?;
    for (pin, constraint) in island.pins.iter().enumerate().filter(|(_, pin)| asleep.contains(&pin.body)) {
        let Some(a) = island.attachments[pin].and_then(|a| contents.attachments.get_mut(a)) else { continue };
        let impedance = &prediction.impedances[constraint.cable];
        let own = impedance.nodes().iter().position(|&node| node == constraint.node);
        let compliance = own.map_or_else(Matrix3::zeros, |own| impedance.compliance(own, own));
        let drive = Drive {
            impedance: compliance.try_inverse().unwrap_or_else(Matrix3::zeros),
            target: Vector3::zeros(),
            load: Some(load(a)),
        };
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
        || proximity::unlisted_collision(world, handle, &displacement, (step.h, step.fastest)).is_some()
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

/// Linearises the cables of an island at their pins on `members` for a step of `h` (s); all others are held.
pub(super) fn linearise_at(
    contents: &mut Contents,
    island: &Island,
    prediction: &mut Prediction,
    members: &[usize],
    h: f64,
) -> Result<(), Error> {
    let mut pins: Vec<usize> = members.iter().flat_map(|&m| island.pins_on(m)).collect();
    pins.sort_unstable();
    linearise(contents, island, prediction, &pins, |cable, nodes, impedance| impedance.update_held(cable, nodes, h))
}

/// Linearises the cables of an island that some of `pins` are on.
fn linearise(
    contents: &mut Contents,
    island: &Island,
    prediction: &mut Prediction,
    pins: &[usize],
    update: impl Fn(&mut Cable, &[usize], &mut Impedance) -> Result<(), lariat_ancf::Error>,
) -> Result<(), Error> {
    let Prediction { impedances, nodes, .. } = prediction;
    impedances.resize_with(island.cables.len(), Default::default);
    let mut outcome = Ok(());
    contents.for_cables(&island.cables, |c, cable| {
        nodes.clear();
        nodes.extend(pins.iter().map(|&p| &island.pins[p]).filter(|pin| pin.cable == c).map(|pin| pin.node));
        if outcome.is_ok() && !nodes.is_empty() {
            outcome = update(cable, nodes, &mut impedances[c]);
        }
    });
    Ok(outcome?)
}

/// Finds D for the pins of a member. Buffers only.
#[derive(Clone, Debug, Default)]
pub(crate) struct DrivingPoint {
    /// The pins that move, in ascending order.
    pins: Vec<usize>,
    /// C + B', and its inverse.
    matrix: DMatrix<f64>,
    inverse: DMatrix<f64>,
}

impl DrivingPoint {
    /// Finds the pins on members and on those of their mechanisms, and those next to them on the same cables.
    fn find_pins(&mut self, island: &Island, groups: &[Group], members: &[usize]) {
        let pins = &island.pins;
        let group = |m: &usize| groups.iter().find(|group| group.place(*m).is_some());
        let together = |m| group(m).map_or_else(|| core::slice::from_ref(m), |group| &group.members);
        let on_members = || members.iter().flat_map(together).flat_map(|&m| island.pins_on(m));
        self.pins.clear();
        self.pins.extend(on_members());
        for own in on_members() {
            let apart = |&p: &usize| pins[p].cable == pins[own].cable && pins[p].body != pins[own].body;
            let others = (0..pins.len()).filter(apart);
            let before = others.clone().filter(|&p| pins[p].node < pins[own].node).max_by_key(|&p| pins[p].node);
            let after = others.filter(|&p| pins[p].node > pins[own].node).min_by_key(|&p| pins[p].node);
            self.pins.extend(before.into_iter().chain(after));
        }
        self.pins.sort_unstable();
        self.pins.dedup();
    }

    /// Inverts C + B' for a member. Returns whether it is positive definite.
    fn solve(&mut self, island: &Island, prediction: &Prediction, member: usize) -> bool {
        let start = &prediction.start;
        let n = 3 * self.pins.len();
        // a matrix of nalgebra is allocated anew when it is resized, even to the size that it has
        for matrix in [&mut self.matrix, &mut self.inverse].into_iter().filter(|matrix| matrix.nrows() != n) {
            matrix.resize_mut(n, n, 0.0);
        }
        let mut m = core::mem::take(&mut self.matrix);
        for (a, &i) in self.pins.iter().enumerate() {
            for (b, &j) in self.pins.iter().enumerate().take(a + 1) {
                let (p, q) = (&island.pins[i], &island.pins[j]);
                let mut block = Matrix3::zeros();
                let impedance = &prediction.impedances[p.cable];
                let index = |node: usize| impedance.nodes().iter().position(|&n| n == node);
                if p.cable == q.cable
                    && let (Some(one), Some(two)) = (index(p.node), index(q.node))
                {
                    block += impedance.compliance(one, two);
                }
                let share = |body: usize| if body == member { OWN_MOBILITY_SHARE.sqrt() } else { 1.0 };
                let levers = [start[p.body].rotation * p.anchor, start[q.body].rotation * q.anchor];
                let in_group = |group: &Group| Some(group.mobility(group.place(p.body)?, group.place(q.body)?));
                if let Some(mobility) = prediction.groups.iter().find_map(in_group) {
                    block += point_mobility(&mobility, &levers) * (share(p.body) * share(q.body));
                } else if p.body == q.body {
                    block += mobility(&start[p.body], &levers) * (share(p.body) * share(q.body));
                }
                m.fixed_view_mut::<3, 3>(3 * a, 3 * b).copy_from(&block);
            }
        }
        // the upper triangle is not read
        let Some(factors) = Cholesky::new(m) else { return false };
        self.inverse.fill_with_identity();
        factors.solve_mut(&mut self.inverse);
        self.matrix = factors.unpack_dirty();
        true
    }

    /// Returns D for every pin on a member, by the index of the pin.
    fn own(&self, island: &Island, member: usize) -> impl Iterator<Item = (usize, Matrix3<f64>)> {
        let own = self.pins.iter().enumerate().filter(move |(_, pin)| island.pins[**pin].body == member);
        own.map(|(a, pin)| (*pin, self.inverse.fixed_view::<3, 3>(3 * a, 3 * a).into_owned()))
    }
}

/// Returns the velocity at one point per impulse at another, in 1/kg, by the mobility of their bodies and the levers from
/// the centres of mass.
fn point_mobility(mobility: &Matrix6<f64>, [ra, rb]: &[Vector3<f64>; 2]) -> Matrix3<f64> {
    let at = |r: usize, c: usize| mobility.fixed_view::<3, 3>(r, c).into_owned();
    let linear = at(0, 0) + at(0, 3) * rb.cross_matrix();
    linear - ra.cross_matrix() * (at(3, 0) + at(3, 3) * rb.cross_matrix())
}

/// Returns the velocity at one point of a free body per impulse at another, in 1/kg.
fn mobility(body: &RigidBody, [ra, rb]: &[Vector3<f64>; 2]) -> Matrix3<f64> {
    let mass = if body.mass > 0.0 { body.mass } else { JUNCTION_MASS };
    let masked = Matrix3::from_diagonal(&Vector3::from_fn(|i, _| f64::from(u8::from(body.free[i])) / mass));
    let mut inverse = body.world_inertia(&body.rotation).try_inverse().unwrap_or_else(Matrix3::zeros);
    for x in (0..3).filter(|&x| !body.free[3 + x]) {
        inverse.row_mut(x).fill(0.0);
        inverse.column_mut(x).fill(0.0);
    }
    masked - ra.cross_matrix() * inverse * rb.cross_matrix()
}
