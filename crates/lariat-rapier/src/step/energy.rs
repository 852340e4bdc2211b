//! The energy balance of islands: what integration made of cables and the dynamic bodies on them.
//!
//! # Equation
//!
//! ```text
//! made = change of (balance of the cables + T + C) - f . dx - tau . theta - sum F . (g0 - g1)
//! ```
//!
//! over the integration of a Rapier step, from the state that it began with to the one that it
//! predicted: T kinetic energy of the bodies, C that of what mechanisms make them carry, f and tau
//! the forces and torques on them (constant in the step: gravity, the user's, and the reaction
//! estimate, by which contacts and joints take part), dx and theta how they moved and turned, F the
//! mean force at a pin and g its gap. Under the discrete gradient it is the energy law of the
//! island.
//!
//! # Validity
//!
//! What Rapier's step makes of the prediction is between two such steps, and no energy of
//! integration: impulses of contacts and joints, damping of bodies, the motors that let them feel
//! their cables; and so is what a user does. The impact of a cable that follows a body whose
//! velocity jumped is dissipation. The energy of the run has no work of f and tau: on a mechanism,
//! whose bodies carry some 1e4 of their mass along what joints hold, they turn its momentum, and
//! their work is large and ends in C. By the law, what they do work on, moves, is lifted, strained
//! or dissipated, and that counts. Where a gap closes, the work of its force is uncertain by all of
//! itself: of bodies in contact, which Rapier moves a little in each step, that adds up to some per
//! cent of the energy in a second, and only what is more is told.
//!
//! By the energy law, which counts the residual of the step itself, islands are judged whatever
//! acts on their cables: contacts, reels, sheaves, drums. By the other methods, those with sheaves,
//! drums or contact are not: the works of these are not known. Islands in which a cable is not
//! watched are not judged.
//!
//! # Alternatives considered
//!
//! The energy of the world from host step to host step, with the work of Rapier by the deviation of
//! bodies at their mean velocity: contacts act within Rapier's substeps, on cables through the
//! impedance of the step, and that is of the first order in the step: a right run had 1e-3 of its
//! energy made. The energy of the run with the work of f and tau: that was 860 J of a boom that has
//! 10 J, and 2 J that were lost in a snap remained untold (seed 60013 of tests/seeds).

use crate::contents::Contents;
use crate::convert::vector;
use crate::islands::{Island, Member};
use crate::mechanism::velocity_of;
use crate::step::prediction::Prediction;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::integrate::OneStep;
use lariat_ancf::island::RigidBody;
use lariat_ancf::warning::IslandChange;
use lariat_ancf::warning::balance::{CableTerms, Sizes, weight_and_stiffness};
use rapier::pipeline::PhysicsWorld;

/// Returns whether an island has a balance; `by_law` if it has an energy law.
fn is_judged(contents: &Contents, island: &Island, by_law: bool) -> bool {
    let moves = island.members.iter().any(|member| !matches!(member, Member::Driven(_)));
    let plain = by_law || island.wheels.is_empty() && island.pairs.is_empty();
    let mut slots = island.cables.iter().filter_map(|&cable| contents.cables.get(cable));
    moves && plain && slots.all(|slot| slot.cable.is_watched() && (by_law || slot.cable.effects().contact.is_none()))
}

/// Reads an island that is ready to be integrated.
pub(crate) fn begin(contents: &Contents, island: &Island, prediction: &mut Prediction) {
    prediction.energy.start = None;
    let by_law = is_by_law(prediction);
    if !is_judged(contents, island, by_law) {
        return;
    }
    let Prediction { energy, start, .. } = prediction;
    let mut terms = CableTerms::default();
    for slot in island.cables.iter().filter_map(|&cable| contents.cables.get(cable)) {
        let of_cable = match by_law {
            true => CableTerms::of_works(&slot.cable),
            false => CableTerms::of(&slot.cable, &mut energy.buffer),
        };
        terms.add(&of_cable);
    }
    energy.start = Some(terms);
    energy.gaps.clear();
    for pin in &island.pins {
        let Some(slot) = contents.cables.get(island.cables[pin.cable]) else { continue };
        let (cable, body) = (&slot.cable, &start[pin.body]);
        energy.gaps.push(cable.node_position(pin.node) - body.point(&pin.anchor));
    }
}

/// Returns whether the island has the energy law of the discrete gradient.
fn is_by_law(prediction: &Prediction) -> bool {
    prediction.integrator.is_some_and(|integrator| integrator.method.uses_discrete_gradients())
}

/// Adds what integration made of an island in a Rapier step of `h` (s) to the balance of its first
/// cable. Its cables are as predicted.
pub(crate) fn note(
    contents: &mut Contents,
    world: &PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
) {
    let Some(before) = prediction.energy.start.take() else { return };
    let by_law = is_by_law(prediction);
    let Prediction { energy, start, end, coupled, accounts, .. } = prediction;
    let mut terms = CableTerms::default();
    let mut sizes = Sizes::default();
    for slot in island.cables.iter().filter_map(|&cable| contents.cables.get(cable)) {
        terms.add(&CableTerms::of(&slot.cable, &mut energy.buffer));
        let (weight, stiffness) = weight_and_stiffness(&slot.cable);
        (sizes.weight, sizes.stiffness) = (sizes.weight + weight, sizes.stiffness + stiffness);
    }
    (sizes.kinetic, sizes.strain, sizes.gravity) = (terms.kinetic, terms.strain, terms.gravity);
    let mut work = terms.work - terms.on_bodies - (before.work - before.on_bodies);
    let mut made = terms.sum() - before.sum();
    let mut uncertain = terms.uncertain - before.uncertain;
    for (m, member) in island.members.iter().enumerate() {
        let Member::Body(handle) = member else { continue };
        let Some(body) = world.bodies.get(*handle) else { return };
        let (first, last) = (&start[m], &end[m]);
        let weight = vector(world.gravity) * first.mass * f64::from(body.gravity_scale());
        let moved = last.position - first.position;
        let turned = (last.rotation * first.rotation.inverse()).scaled_axis();
        let of_others = (first.force - weight).dot(&moved) + first.torque.dot(&turned);
        made += kinetic(last) - kinetic(first) - weight.dot(&moved) - of_others;
        sizes.kinetic += kinetic(last);
        sizes.gravity -= weight.dot(&last.position);
        sizes.weight += weight.norm();
    }
    for pair in coupled.iter() {
        let energy = |bodies: &[RigidBody]| {
            let [one, two] = pair.bodies.map(|body| velocity_of(&bodies[body]));
            one.dot(&(pair.matrix * two))
        };
        made += energy(end) - energy(start);
    }
    for ((pin, account), gap) in island.pins.iter().zip(accounts.iter()).zip(&energy.gaps) {
        let Some(slot) = contents.cables.get(island.cables[pin.cable]) else { continue };
        if let Member::Driven(_) = island.members[pin.body] {
            continue;
        }
        let closed = gap - (slot.cable.node_position(pin.node) - end[pin.body].point(&pin.anchor));
        let of_gap = account.impulse.dot(&closed) / h;
        work += of_gap;
        made -= of_gap;
        // by what force the end of the cable came to where the body had been put is not known
        uncertain += account.force.dot(&closed).abs().max(of_gap.abs());
    }
    if by_law {
        (made, uncertain) = (terms.by_law - before.by_law, 0.0);
    }
    let parts = [island.cables.len(), island.members.len()];
    let dissipated = terms.dissipated - before.dissipated;
    let step = IslandChange { made, by_law, dissipated, work, sizes, uncertain, parts };
    if let Some(slot) = contents.cables.get_mut(island.cables[0]) {
        slot.cable.note_island(&step);
    }
}

/// Returns the kinetic energy of a body and of what it carries in J.
pub(super) fn kinetic(body: &RigidBody) -> f64 {
    let velocity = velocity_of(body);
    body.kinetic_energy() + body.carried.map_or(0.0, |carried| 0.5 * velocity.dot(&(carried * velocity)))
}
