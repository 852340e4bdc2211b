//! Prediction: cables and the bodies attached to them are integrated together.
//!
//! # Scheme
//! The island solver ([`lariat_ancf::island`]) integrates cables and bodies as one system. A body
//! is free but for gravity, the user's forces and the reaction estimate; one that joints hold has
//! the inertia and the loads of its whole mechanism ([`crate::mechanism`]).
//!
//! # Validity
//! What Rapier's step makes of a body that something holds moves its cables by one implicit step
//! ([`Impedance`](lariat_ancf::island::Impedance)). Error control resolves waves that this step
//! does not, and each correction adds a little to them: on undamped cables they grow until the
//! tension is lost. As long as a body rests against a contact or a limit of a multibody, cables
//! under error control therefore have a Kelvin-Voigt time of 0.1 h or more, which adds 0.05 h w to
//! the damping ratio of an axial wave of angular frequency w
//! ([`Cable::set_least_damping`](lariat_ancf::coupling::Coupling::set_least_damping)). For one body
//! that is enough at any mass; where bodies are so light that Rapier's steps do not resolve their
//! vibration (h w > 0.6, [`substepping`]), the island is integrated by the discrete gradient in
//! Rapier's steps, of 1/240 s or less, and an [event](crate::Event::Degraded) says so (test
//! contact.rs).
//!
//! # Alternatives considered
//! What was tried, and what it gave: docs/decisions/rapier.md.

use crate::body;
use crate::body::prescribed_motion::PrescribedMotions;
use crate::body::proximity;
use crate::body::spatial::stack_spatial;
use crate::contents::Contents;
use crate::error::Error;
use crate::islands::{Island, Member};
use crate::mechanism::{self, Group, Jointed};
use crate::scales::TIME_ROUNDING;
use crate::scales::step::{CHEAPEST_STEP, MAX_CONTROLLED_STEP, MAX_PARTS, MAX_PHASE, MIN_DAMPING};
use crate::step::budget::CHEAPEST;
use crate::step::energy;
use crate::step::kinematic_ends;
use crate::step::prediction::{Prediction, StepParameters};
use crate::step::reels;
use crate::step::substepping;
use ::nalgebra::{Matrix6, Vector6};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::integrate::OneStep;
use lariat_ancf::island::{PinConstraint, RigidBody};
use lariat_ancf::{Integrator, StepControl};
use rapier::pipeline::PhysicsWorld;

/// Reads members and integrator of an island that will be [integrated](crate::step::integrate) over
/// a step.
pub(crate) fn prepare(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    motions: &PrescribedMotions,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) -> Result<(), Error> {
    let mut integrator = share_of(integrator(contents, island, step), step.rapier_steps);
    let mut least = 0.0;
    prediction.parts = 1;
    prediction.wheels.clear();
    prediction.start.clear();
    prediction.end.clear();
    prediction.groups.clear();
    prediction.coupled.clear();
    prediction.wheels.extend(island.wheels.over(contents, &island.cables));
    if !island.members.is_empty() {
        reels::check(world, island)?;
        read_members(contents, world, motions, island, prediction, step)?;
        if island.bodies().next().is_some() {
            if is_controlled(&integrator) {
                let held = held_phase(contents, world, island, prediction, step.h);
                least = if held.is_some() { MIN_DAMPING * step.h } else { 0.0 };
                if held.is_some_and(|phase| phase > MAX_PHASE) {
                    integrator = CHEAPEST;
                    prediction.degraded = true;
                }
            }
            prediction.parts = parts(&integrator, step.h);
            integrator = share_of(integrator, prediction.parts);
        }
    }
    let by_law = Some(integrator.method.uses_discrete_gradients());
    for &cable in &island.cables {
        let Some(slot) = contents.cables.get_mut(cable) else { continue };
        slot.cable.set_least_damping(least);
        slot.by_law = by_law;
    }
    prediction.integrator = Some(integrator);
    energy::begin(contents, island, prediction);
    Ok(())
}

/// Returns the largest h w, in steps of `h` (s), of the bodies of an island that rest against a
/// contact, 0 for those at limits of a multibody.
fn held_phase(
    contents: &Contents,
    world: &PhysicsWorld,
    island: &Island,
    prediction: &Prediction,
    h: f64,
) -> Option<f64> {
    let phase = |(index, pin): (&Option<usize>, &PinConstraint)| match &prediction.mechanisms[pin.body] {
        Some(mechanism) => mechanism.loads.limited.then_some(0.0),
        None => substepping::resting_phase(contents, world, contents.attachments.get((*index)?)?, h),
    };
    island.attachments.iter().zip(&island.pins).filter_map(phase).reduce(f64::max)
}

/// Takes over what the integration of an island tells about its attachments and junctions.
pub(crate) fn complete(contents: &mut Contents, island: &Island, prediction: &Prediction) {
    if island.members.is_empty() {
        return;
    }
    for (account, attachment) in prediction.accounts.iter().zip(&island.attachments) {
        if let Some(a) = attachment.and_then(|a| contents.attachments.get_mut(a)) {
            a.predicted = *account;
        }
    }
    for (member, end) in island.members.iter().zip(&prediction.end) {
        if let Member::Junction(j) = member
            && let Some(junction) = contents.junctions.get_mut(*j)
        {
            junction.memory = end.memory;
        }
    }
}

/// Reads the members of an island before the step.
fn read_members(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    motions: &PrescribedMotions,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) -> Result<(), Error> {
    let time = contents.cables.get(island.cables[0]).map_or(0.0, |s| s.cable.time());
    for member in &island.members {
        let body = match member {
            Member::Body(handle) => {
                mechanism::prepare(world, *handle);
                let record = contents.records.record_mut(*handle);
                if record.reaction != Vector6::zeros() && proximity::is_isolated(world, *handle) {
                    // what the body was in contact with is gone
                    record.reaction = Vector6::zeros();
                }
                body::read(world, *handle, record, time)?
            }
            Member::Driven(handle) => kinematic_ends::driven_body(world, motions, *handle, step)?,
            Member::Junction(j) => {
                let junction = contents.junctions.get(*j).expect("islands are found anew when a junction ends");
                junction.point(contents.cable(junction.nodes[0].0)?)?
            }
        };
        prediction.start.push(body);
    }
    find_mechanisms(contents, world, island, prediction, step);
    carry_further_mass(contents, world, island, prediction);
    prediction.end.extend_from_slice(&prediction.start);
    Ok(())
}

/// Lets the members that nothing but cables moves carry the added mass that Rapier does not
/// ([`crate::water`]).
fn carry_further_mass(contents: &mut Contents, world: &PhysicsWorld, island: &Island, prediction: &mut Prediction) {
    let Some(water) = &mut contents.water else { return };
    for ((member, body), mechanism) in island.members.iter().zip(&mut prediction.start).zip(&prediction.mechanisms) {
        let Member::Body(handle) = member else { continue };
        let alone = mechanism.is_none() && proximity::is_isolated(world, *handle);
        if let Some((further, force)) = water.carry(*handle, alone) {
            let mut carried = Matrix6::zeros();
            carried.fixed_view_mut::<3, 3>(0, 0).copy_from(&further);
            body.carried = Some(carried);
            body.force += force;
        }
    }
}

/// Finds the mechanisms of the members, and adds inertia and loads of the bodies that these move
/// with.
fn find_mechanisms(
    contents: &Contents,
    world: &PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) {
    let Prediction { start, mechanisms, groups, coupled, .. } = prediction;
    groups.clear();
    coupled.clear();
    mechanisms.clear();
    mechanisms.resize_with(start.len(), || None);
    if island.bodies().all(|handle| proximity::is_unjointed(world, handle)) {
        return;
    }
    let bodies = || island.members.iter().enumerate().filter_map(|(m, member)| Some((m, member.body()?)));
    let members: Vec<_> = bodies().map(|(m, handle)| (handle, cable_load(contents, island, m, &start[m]))).collect();
    let of_cables =
        |handle| contents.records.get(handle).map_or_else(Vector6::zeros, |record| record.pull - record.reaction);
    let is_attached = |b| contents.attachments.values().any(|a| a.body == b);
    let parameters = &world.integration_parameters;
    let substep = step.h / parameters.num_solver_iterations.max(1) as f64;
    let sweeps = parameters.num_internal_pgs_iterations.max(1);
    let half_step = 0.5 * step.h;
    let request = |handle| mechanism::Request {
        handle,
        members: &members,
        half_step,
        substep,
        sweeps,
        is_attached: &is_attached,
    };
    let mut together: Vec<Vec<usize>> = Vec::new();
    for (m, handle) in bodies() {
        mechanisms[m] = mechanism::find(world, &request(handle));
        if mechanisms[m].is_some() {
            let knows = |&other: &usize| mechanisms[other].as_ref().is_some_and(|o| o.mobility_of(handle).is_some());
            match together.iter_mut().find(|group| group.iter().any(knows)) {
                Some(group) => group.push(m),
                None => together.push(vec![m]),
            }
        }
    }
    for members in together {
        let jointed = members.iter().filter_map(|&member| {
            let mechanism = mechanisms[member].as_ref()?;
            let body = &start[member];
            let load = stack_spatial(&body.force, &body.torque) + of_cables(island.members[member].body()?);
            Some(Jointed { member, body, mechanism, load })
        });
        match Group::new(&jointed.collect::<Vec<_>>(), half_step) {
            Some(group) => {
                group.load(start, coupled);
                groups.push(group);
            }
            // they move as if alone
            None => members.into_iter().for_each(|m| mechanisms[m] = None),
        }
    }
}

/// Returns the force and torque on a member: its own, and those of its cables at the end of the
/// last step.
fn cable_load(contents: &Contents, island: &Island, member: usize, body: &RigidBody) -> Vector6<f64> {
    let mut load = stack_spatial(&body.force, &body.torque);
    for pin in island.pins_on(member) {
        if let Some(a) = island.attachments[pin].and_then(|i| contents.attachments.get(i)) {
            let (force, moment) = (a.reading.force, a.reading.moment);
            let torque = (body.rotation * island.pins[pin].anchor).cross(&force) + moment;
            load += stack_spatial(&force, &torque);
        }
    }
    load
}

/// Returns the integrator of an island: that of its cables if they agree, else the one with the
/// tightest tolerance, or with the shortest steps; where anything asks for the discrete gradient
/// (contact, torsion, clutches, sheaves, drums), of those that are one.
fn integrator(contents: &Contents, island: &Island, step: &StepParameters) -> Integrator {
    let slots = || island.cables.iter().filter_map(|&c| contents.cables.get(c));
    let by_gradient = |i: &Integrator| i.method.uses_discrete_gradients();
    let can = slots().any(|slot| by_gradient(&slot.cable.integrator()));
    let only = can && (!island.wheels.is_empty() || slots().any(|slot| slot.cable.needs_discrete_gradient()));
    let all = || slots().map(|slot| slot.cable.integrator()).filter(|i| !only || by_gradient(i));
    let first = all().next().unwrap_or_default();
    if all().all(|i| i == first) {
        return first;
    }
    let host = step.host;
    let fineness = |i: &Integrator| match i.control {
        StepControl::Tolerance(tolerance) | StepControl::ToleranceOf(tolerance, _) => (tolerance, 0.0),
        StepControl::Substeps(count) => (f64::INFINITY, host / f64::from(count)),
        StepControl::MaxStep(h) => (f64::INFINITY, h.min(host)),
        // as short as they get without an error that asks for it
        StepControl::Adaptive(_) => (f64::INFINITY, CHEAPEST_STEP.min(host)),
        StepControl::Stable(_) => (f64::INFINITY, f64::INFINITY),
    };
    all().fold(first, |best, i| if fineness(&i) < fineness(&best) { i } else { best })
}

/// Returns into how many equal parts of at most [`MAX_CONTROLLED_STEP`] a step of `h` (s) is
/// divided.
fn parts(integrator: &Integrator, h: f64) -> u32 {
    if is_controlled(integrator) {
        ((h / MAX_CONTROLLED_STEP) * (1.0 - TIME_ROUNDING)).ceil().clamp(1.0, MAX_PARTS) as u32
    } else {
        1
    }
}

/// Returns whether an integrator controls its error and does not keep an energy law at any step.
fn is_controlled(integrator: &Integrator) -> bool {
    let is_tolerance = matches!(integrator.control, StepControl::Tolerance(_) | StepControl::ToleranceOf(..));
    is_tolerance && !integrator.method.uses_discrete_gradients()
}

/// Returns the integrator for one of `count` equal parts of the step that `integrator` is meant
/// for.
fn share_of(integrator: Integrator, count: u32) -> Integrator {
    let control = match integrator.control {
        StepControl::Tolerance(tolerance) => StepControl::Tolerance(tolerance / f64::from(count)),
        StepControl::ToleranceOf(tolerance, norm) => StepControl::ToleranceOf(tolerance / f64::from(count), norm),
        StepControl::Substeps(substeps) => StepControl::Substeps(substeps.div_ceil(count)),
        control => control,
    };
    Integrator { control, ..integrator }
}
