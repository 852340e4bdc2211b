//! The number of Rapier steps of a host step.
//!
//! # Equation
//! ```text
//! h w <= 0.6                      w^2 = k/m,   k = sum of EA/l over the pins of a body
//! h |w|/(2 N) <= 1.2              in N solver iterations
//! h |w|/(2 N) <= 0.005            of a body on impulse joints
//! h |w1 - w0|/4 <= 0.01           of a body on joints, from one end of a Rapier step to the other
//! ```
//! *Vibration.* Between two Rapier steps the reaction estimate of a body in contact is constant. If
//! h is long compared with the period of the body on its taut cables, the estimate comes too late:
//! two jammed bodies of 1 kg under 1 kN oscillate by half of it, and a body that is released
//! suddenly is thrown by the old estimate (a gap of F h^2/2m). Therefore the host step is split
//! finer where a body that is near others, or has a reaction estimate, hangs on a taut cable. l is
//! the length of the cable to its end, which gives an upper bound of its stiffness. A cable that is
//! pulled but not straight gives way by its sag: where the bound asks for a split, its own response
//! over the host step decides ([`Impedance`]), if it stays what it is. The force of a shallow
//! catenary of length L and chord c varies as (L - c)^-1/2, its stiffness as (L - c)^-3/2: this does not
//! double while the chord grows by less than 1 - 2^(-2/3) = 0.37 of L - c. The growth is bounded by
//! the present motion, a collision's change of velocity (2 v h), and a reaction estimate that is
//! wrong altogether (F h^2/2m).
//!
//! *Turns.* A mechanism is predicted as it is halfway of a Rapier step, at the velocities with which that begins. If they change in it, by a line that snaps
//! taut, bodies on joints have turned otherwise by the left side of the last line, by which share the directions in which they can move are wrong. Then the
//! step is predicted anew, divided. Impulse joints turn a velocity by removing what they do not allow of it, in each substep the share (w h/N)^2/2, which is the left
//! side of the line before per radian.
//!
//! The collisions and the taut cables of the whole coming host step count ([`crate::proximity`]). All is evaluated again before each Rapier
//! step, and the rest of the host step is split finer.
//!
//! # Validity
//! Measured with 1 kg, jams of 1 and 5 kN, host steps of 1/30 to 1/240 s: h w = 2.6 fails, 1.8
//! holds, 0.9 fails where two bodies hang on each other and the cable hardly damps, 0.6 holds. A
//! cube of 1 kg drawn into its stop at 0.05 m/s by a steel wire, 1/30 s: a gap of 7e-6 m; 2.0 mm
//! where only cables that are taut when the host step begins count. A light ball that hits another
//! at 11 m/s: a gap of 113 mm without a look at the collisions to come.
//!
//! # Alternatives considered
//! A fine split always: a pile of 500 boxes costs 0.5 ms in each Rapier step. A bound of the gap that a collision at v opens before the
//! cable follows, h v g/(1 + g) <= 1 mm with g = 0.1 h^2 k/m: with 32 steps at most, h w <= 0.6 asks for more of them below 50 m/s.

use crate::attachment::{Attachment, ShownStiffness};
use crate::body::is_integrated;
use crate::contact;
use crate::contents::{Contents, Slot};
use crate::islands::Island;
use crate::pose::MAX_HALF_ROTATION;
use crate::proximity;
use crate::settings::Settings;
use crate::spatial::split_spatial;
use ::nalgebra::{Vector3, Vector6};
use lariat_ancf::island::Impedance;
use lariat_ancf::{At, Cable};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Strain from which a cable counts as taut.
const TAUT_STRAIN: f64 = 1e-5;
/// Largest h w.
pub(super) const MAX_PHASE: f64 = 0.6;
/// Steps of a host step of a body that joints hold: the reactions of joints are estimated from step
/// to step. With one step, arms that close at a limit or are near a body blow up.
const JOINTED_STEPS: f64 = 4.0;
/// Largest share of its velocity that a body on impulse joints loses per radian.
const MAX_LOSS: f64 = 5e-3;
/// Largest error in rad of the attitude at which a mechanism is predicted.
pub(super) const MAX_TURN_ERROR: f64 = 0.01;
/// Share of a cable's slack by which its chord may grow, so that its stiffness does not double.
const SLACK_SHARE: f64 = 0.37;
/// Largest change of velocity of a body that collides, per speed of the collision.
const MAX_REBOUND: f64 = 2.0;
/// Share of the force at an attachment from which a reaction estimate counts.
const MIN_REACTION: f64 = 0.1;

/// Returns the number of Rapier steps for a host step of `dt` (s); `impedance` is a buffer.
pub(crate) fn count(
    contents: &mut Contents,
    world: &PhysicsWorld,
    settings: &Settings,
    dt: f64,
    impedance: &mut Impedance,
) -> u32 {
    let min = settings.rapier_steps.max(1);
    let max = settings.max_rapier_steps;
    if max <= min {
        return min;
    }
    let mut fastest = None;
    let mut needed = f64::from(min);
    for i in 0..contents.attachments.len() {
        let Some(a) = contents.attachments.get(i) else { continue };
        let mut fastest = || *fastest.get_or_insert_with(|| proximity::fastest(world));
        let Some(speed) = deviation_speed(contents, world, a, dt, &mut fastest) else { continue };
        let inverse_mass = f64::from(world.bodies[a.body].mass_properties().local_mprops.inv_mass);
        let count = |stiffness: f64| dt * (stiffness * inverse_mass).sqrt() / MAX_PHASE;
        let on_body = contents.attachments.values().filter(|b| b.body == a.body);
        let largest: f64 = on_body.map(|b| stiffness(contents, b)).sum();
        let mut own = count(largest);
        if own > needed {
            let reaction = contents.records.get(a.body).map_or(0.0, |r| split_spatial(&r.reaction).0.norm());
            let change = MAX_REBOUND * speed * dt + 0.5 * reaction * inverse_mass * dt * dt;
            if stays_slack(contents, a, dt, change) {
                own = own.min(count(stiffness_over(contents, a.body, (dt, change), impedance)));
            }
        }
        needed = needed.max(own);
    }
    let jointed = |a: &Attachment| is_integrated(world, a.body) && !proximity::is_unjointed(world, a.body);
    let joints = contents.attachments.values().filter(|a| jointed(a)).map(|a| {
        let substeps = world.integration_parameters.num_solver_iterations.max(1) as f64;
        let is_link = world.multibody_joints.rigid_body_link(a.body).is_some();
        let spin = if is_link { 0.0 } else { f64::from(world.bodies[a.body].angvel().length()) };
        let least = JOINTED_STEPS.max(0.5 * spin * dt / substeps / MAX_LOSS);
        let turn = contents.records.get(a.body).map_or(0.0, |record| record.turn_error * dt * dt);
        least.max((turn / MAX_TURN_ERROR).sqrt())
    });
    let joints = joints.fold(1.0, f64::max);
    let needed = needed.max(rotation(contents, world, dt)).max(joints).max(pressed(contents, world, dt));
    // a value that is not a number, or too large, gives the maximum
    (needed.ceil().min(f64::from(max)) as u32).max(min)
}

/// Returns the number of steps of `dt` (s) that bodies need which cables press on others,
/// so that none vibrates between them. A cable that touches a body is as stiff as one that is
/// attached to it in the middle.
fn pressed(contents: &Contents, world: &PhysicsWorld, dt: f64) -> f64 {
    let mut stiffnesses: Vec<(RigidBodyHandle, f64)> = Vec::new();
    for slot in contents.cables.values() {
        let compliance: f64 = slot.cable.elements().iter().map(|e| e.length / e.section.axial_stiffness).sum();
        let mut last = None;
        for touch in slot.cable.contacts() {
            let body = world.colliders.get(contact::collider(touch.obstacle)).and_then(|c| c.parent());
            let Some(body) = body.filter(|body| is_integrated(world, *body) && last != Some(*body)) else { continue };
            last = Some(body);
            match stiffnesses.iter_mut().find(|(known, _)| *known == body) {
                Some((_, sum)) => *sum += 4.0 / compliance,
                None => stiffnesses.push((body, 4.0 / compliance)),
            }
        }
    }
    let count = |(body, stiffness): &(RigidBodyHandle, f64)| {
        let reacts = contents.records.get(*body).is_some_and(|record| record.reaction != Vector6::zeros());
        if !reacts && !proximity::may_deviate(world, *body) {
            return 0.0;
        }
        dt * (stiffness * f64::from(world.bodies[*body].mass_properties().local_mprops.inv_mass)).sqrt() / MAX_PHASE
    };
    stiffnesses.iter().map(count).fold(0.0, f64::max)
}

/// Returns the number of steps of `dt` (s) that attached bodies need so that none rotates by more
/// than Rapier's linearised rotation can in a substep.
fn rotation(contents: &Contents, world: &PhysicsWorld, dt: f64) -> f64 {
    let substeps = world.integration_parameters.num_solver_iterations.max(1) as f64;
    let spins = contents.attachments.values().filter_map(|a| world.bodies.get(a.body));
    let fastest = spins.filter(|b| b.is_dynamic()).map(|b| f64::from(b.angvel().length())).fold(0.0, f64::max);
    0.5 * fastest * dt / substeps / MAX_HALF_ROTATION
}

/// Returns the speed in m/s at which the body of an attachment may collide within `dt` (s), or 0 if
/// it has a reaction estimate. `None` if it does not deviate, or hangs on no cable that is taut or
/// becomes so.
fn deviation_speed(
    contents: &Contents,
    world: &PhysicsWorld,
    a: &Attachment,
    dt: f64,
    fastest: &mut impl FnMut() -> f64,
) -> Option<f64> {
    let cable = &contents.slot(a.cable)?.cable;
    if !is_integrated(world, a.body) {
        return None;
    }
    if !is_taut(cable, a) && !may_tighten(contents, world, a, dt, fastest) {
        return None;
    }
    let held = is_taut(cable, a) && is_held(contents, a);
    proximity::collision(world, a.body, (dt, fastest())).or(held.then_some(0.0))
}

/// Returns whether a cable pulls at an attachment.
fn is_taut(cable: &Cable, a: &Attachment) -> bool {
    let section = &cable.elements()[a.node.min(cable.elements().len() - 1)].section;
    a.reading.force.norm() > TAUT_STRAIN * section.axial_stiffness
}

/// Returns whether the body of an attachment has a reaction estimate against the force there.
pub(super) fn is_held(contents: &Contents, a: &Attachment) -> bool {
    let reaction = contents.records.get(a.body).map_or(0.0, |record| split_spatial(&record.reaction).0.norm());
    reaction > MIN_REACTION * a.reading.force.norm()
}

/// Returns h w of the bodies of an island, but those on joints, that contacts hold against taut cables in steps of `h` (s), with less kinetic energy than
/// the strain of the cables has, once for each cable.
pub(super) fn held_phases<'a>(
    contents: &'a Contents,
    world: &'a PhysicsWorld,
    island: &'a Island,
    h: f64,
) -> impl Iterator<Item = f64> + 'a {
    let attached = move || island.attachments.iter().flatten().filter_map(|&index| contents.attachments.get(index));
    let is_held = move |a: &&Attachment| {
        is_integrated(world, a.body)
            && proximity::is_unjointed(world, a.body)
            && contents.slot(a.cable).is_some_and(|slot| is_taut(&slot.cable, a))
            && is_held(contents, a)
            && !stays_slack(contents, a, h, 0.0)
    };
    attached().filter(is_held).filter_map(move |own| {
        let stiffness: f64 = attached().filter(|a| a.body == own.body).map(|a| stiffness(contents, a)).sum();
        let body = &world.bodies[own.body];
        let (mass, speed) = (f64::from(body.mass()), f64::from(body.linvel().length()));
        let rests = mass * speed * speed * stiffness < own.reading.force.norm_squared();
        rests.then(|| h * (stiffness / mass).sqrt())
    })
}

/// Returns an upper bound in N/m of the stiffness of the two parts of a cable at an attachment.
fn stiffness(contents: &Contents, a: &Attachment) -> f64 {
    let Some(slot) = contents.slot(a.cable) else { return 0.0 };
    let elements = slot.cable.elements();
    let side = |range: core::ops::Range<usize>| {
        let compliance: f64 = elements[range].iter().map(|e| e.length / e.section.axial_stiffness).sum();
        if compliance > 0.0 { 1.0 / compliance } else { 0.0 }
    };
    let node = a.node.min(elements.len());
    side(0..node) + side(node..elements.len())
}

/// Returns the stiffness in N/m that the cables of a body show over a step of `dt` (s), if it moves by `change` (m) beside its present motion.
fn stiffness_over(
    contents: &mut Contents,
    body: RigidBodyHandle,
    (dt, change): (f64, f64),
    impedance: &mut Impedance,
) -> f64 {
    let of_body = contents.attachments.values().filter(|a| a.body == body);
    let own = of_body.map(|a| {
        let Some(slot) = contents.cables.get_mut(a.cable.0 as usize) else { return 0.0 };
        if let Some(known) = last_stiffness(slot, a, dt, change) {
            return known;
        }
        // the number may be that of before a change of the cable
        let node = a.node.min(slot.cable.elements().len());
        impedance.update_held(&mut slot.cable, &[node], dt).map_or(f64::INFINITY, |()| impedance.stiffness())
    });
    own.sum()
}

/// Returns the stiffness of a cable at a node over a step of `h` (s) by its response there, which motors need anyway, for
/// [`last_stiffness`]: of a cable with one other end.
pub(super) fn shown_stiffness(cable: &Cable, node: usize, response: &Impedance, h: f64) -> Option<ShownStiffness> {
    let mut parts = parts(cable, node);
    let slack = parts.next()?.slack;
    let alone = parts.next().is_none() && response.nodes() == [node] && !cable.has_reel();
    alone.then(|| ShownStiffness { step: h, stiffness: response.stiffness(), slack })
}

/// Returns the stiffness that a cable showed in the last Rapier step, if that was as long as the coming one of `dt` (s) and the slack cannot
/// have shrunk since by so much that the stiffness doubles.
fn last_stiffness(slot: &Slot, a: &Attachment, dt: f64, change: f64) -> Option<f64> {
    let shown = a.shown.filter(|shown| shown.step == dt && !slot.modified)?;
    let part = parts(&slot.cable, a.node).next()?;
    let lost = (shown.slack - part.slack).max(0.0) + part.speed * dt + change;
    (lost <= SLACK_SHARE * shown.slack).then_some(shown.stiffness)
}

/// Returns whether the cable of an attachment is straight, or may become so within `dt` (s).
fn may_tighten(
    contents: &Contents,
    world: &PhysicsWorld,
    a: &Attachment,
    dt: f64,
    fastest: &mut impl FnMut() -> f64,
) -> bool {
    let Some(slot) = contents.slot(a.cable) else { return false };
    let own = f64::from(world.bodies[a.body].linvel().length());
    parts(&slot.cable, a.node).any(|part| part.speed * dt + (own + fastest()) * dt >= part.slack)
}

/// Returns whether all cables of the body of an attachment keep so much slack over `dt` (s) that
/// their stiffness cannot double, if the body moves by `change` (m) beside its present motion.
fn stays_slack(contents: &Contents, a: &Attachment, dt: f64, change: f64) -> bool {
    let mut on_body = contents.attachments.values().filter(|b| b.body == a.body);
    on_body.all(|b| {
        let keeps = |part: Part| part.speed * dt + change <= SLACK_SHARE * part.slack;
        contents.slot(b.cable).is_none_or(|slot| parts(&slot.cable, b.node).all(keeps))
    })
}

/// The part of a cable between a node and a held end.
struct Part {
    /// Its length without strain less its chord, in m.
    slack: f64,
    /// Relative speed of its ends in m/s.
    speed: f64,
}

/// Returns the parts of a cable between a node and its held ends.
fn parts(cable: &Cable, node: usize) -> impl Iterator<Item = Part> + '_ {
    let velocity = |n: usize| Vector3::from_column_slice(&cable.velocities()[6 * n..6 * n + 3]);
    let last = cable.elements().len();
    // the number may be that of before a change of the cable
    let node = node.min(last);
    let held = |end: usize| cable.support(At::Node(end)).is_ok_and(|s| s.attached || s.position.is_some());
    [0, last].into_iter().filter(move |end| *end != node && held(*end)).map(move |end| {
        let length: f64 = cable.elements()[node.min(end)..node.max(end)].iter().map(|e| e.length).sum();
        let chord = (cable.node_position(node) - cable.node_position(end)).norm();
        Part { slack: length - chord, speed: (velocity(node) - velocity(end)).norm() }
    })
}
