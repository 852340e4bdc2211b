//! Prediction: cables and the bodies attached to them are integrated together.
//!
//! # Scheme
//! The island solver ([`lariat_ancf::island`]) integrates cables and bodies as one system. A body
//! is free but for gravity, the user's forces and the reaction estimate; one that joints hold has
//! the inertia and the loads of its whole mechanism ([`crate::mechanism`]).

use crate::body;
use crate::contents::Contents;
use crate::error::Error;
use crate::islands::{Island, Member};
use crate::mechanism;
use crate::spatial::{split_spatial, stack_spatial};
use crate::step::kinematic_ends;
use crate::step::prediction::{Prediction, StepParameters};
use crate::step::prescribed_motion::PrescribedMotions;
use crate::step::proximity;
use ::nalgebra::{Matrix3, Vector6};
use lariat_ancf::island::{Island as IslandSolver, RigidBody};
use lariat_ancf::{Integrator, StepControl};
use rapier::pipeline::PhysicsWorld;

/// Longest step in s of an integrator that controls the error of cables: it does not see that of
/// the bodies. Two balls on a cable lose 3e-5 of their angular momentum in 10 s if only the cable
/// chooses the step, and 4e-7 with this bound.
const MAX_CONTROLLED_STEP: f64 = 1.0 / 240.0;

/// Integrates the cables and members of an island over a step, into `prediction`.
pub(crate) fn integrate(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    solver: &mut IslandSolver,
    motions: &PrescribedMotions,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) -> Result<(), Error> {
    let integrator = share_of(integrator(contents, island), step.rapier_steps);
    if island.members.is_empty() {
        for cable in contents.cables_at(&island.cables) {
            cable.step_with(step.h, &integrator)?;
        }
        return Ok(());
    }
    read_members(contents, world, motions, island, prediction, step)?;
    let parts = if island.bodies().next().is_some() { parts(&integrator, step.h) } else { 1 };
    let integrator = share_of(integrator, parts);
    for part in 0..parts {
        for (body, start) in prediction.end.iter_mut().zip(&prediction.start) {
            let [first, last] = start.unsteadiness;
            let first = if part == 0 { first } else { Default::default() };
            body.unsteadiness = [first, if part + 1 == parts { last } else { Default::default() }];
        }
        let mut cables = contents.cables_at(&island.cables);
        solver.step(&mut cables, &mut prediction.end, &island.pins, integrator, step.h / f64::from(parts))?;
        for (account, attachment) in solver.accounts().iter().zip(&island.attachments) {
            let Some(a) = attachment.and_then(|a| contents.attachments.get_mut(a)) else { continue };
            if part == 0 {
                a.predicted = *account;
            } else {
                a.predicted.add(account);
            }
        }
    }
    for (member, end) in island.members.iter().zip(&prediction.end) {
        if let Member::Junction(j) = member
            && let Some(junction) = contents.junctions.get_mut(*j)
        {
            junction.memory = end.memory;
        }
    }
    Ok(())
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
    prediction.start.clear();
    prediction.mechanisms.clear();
    for (m, member) in island.members.iter().enumerate() {
        let mut mechanism = None;
        let body = match member {
            Member::Body(handle) => {
                mechanism::prepare(world, *handle);
                let record = contents.records.record_mut(*handle);
                if record.reaction != Vector6::zeros() && proximity::is_isolated(world, *handle) {
                    // what the body was in contact with is gone
                    record.reaction = Vector6::zeros();
                }
                let mut body = body::read(world, *handle, record, time)?;
                if body.inertia == Matrix3::zeros() {
                    // a point mass does not rotate, but the solver needs an inverse
                    body.inertia = Matrix3::identity();
                }
                let request = mechanism::Request {
                    handle: *handle,
                    body: &body,
                    load: cable_load(contents, island, m, &body),
                    substep: step.h / world.integration_parameters.num_solver_iterations.max(1) as f64,
                    is_attached: &|b| contents.attachments.values().any(|a| a.body == b),
                };
                if let Some(found) = mechanism::find(world, &request) {
                    let (force, torque) = split_spatial(&found.load);
                    body.force += force;
                    body.torque += torque;
                    body.carried = Some(found.carried);
                    mechanism = Some(found.mechanism);
                }
                body
            }
            Member::Driven(handle) => kinematic_ends::driven_body(world, motions, *handle, step)?,
            Member::Junction(j) => {
                let junction = contents.junctions.get(*j).expect("islands are found anew when a junction ends");
                junction.point(contents.cable(junction.nodes[0].0)?)?
            }
        };
        prediction.start.push(body);
        prediction.mechanisms.push(mechanism);
    }
    prediction.end.clear();
    prediction.end.extend_from_slice(&prediction.start);
    Ok(())
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
/// tightest tolerance.
fn integrator(contents: &Contents, island: &Island) -> Integrator {
    let all = || island.cables.iter().filter_map(|&c| contents.cables.get(c)).map(|s| s.cable.integrator());
    let first = all().next().unwrap_or_default();
    if all().all(|i| i == first) {
        return first;
    }
    let tolerance = |i: &Integrator| match i.control {
        StepControl::Tolerance(tolerance) | StepControl::ToleranceOf(tolerance, _) => tolerance,
        _ => f64::INFINITY,
    };
    all().fold(first, |best, i| if tolerance(&i) < tolerance(&best) { i } else { best })
}

/// Returns into how many equal parts of at most [`MAX_CONTROLLED_STEP`] a step of `h` (s) is
/// divided.
fn parts(integrator: &Integrator, h: f64) -> u32 {
    match integrator.control {
        StepControl::Tolerance(_) => ((h / MAX_CONTROLLED_STEP) * (1.0 - 1e-6)).ceil().clamp(1.0, 1024.0) as u32,
        _ => 1,
    }
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
