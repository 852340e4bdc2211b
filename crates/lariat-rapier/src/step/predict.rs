//! Prediction: cables and the bodies attached to them are integrated together.
//!
//! # Scheme
//! The island solver ([`lariat_ancf::island`]) integrates cables and bodies as one system. A body
//! is free but for gravity, the user's forces and the reaction estimate; one that joints hold has
//! the inertia and the loads of its whole mechanism ([`crate::mechanism`]).
//!
//! # Threads
//! With the feature `parallel`, islands are integrated on the threads of rayon's present pool. One reads and
//! writes nothing of another, nor of Rapier's world, so results are bitwise the same for any number of
//! threads.

use crate::body;
use crate::contents::Contents;
use crate::error::Error;
use crate::islands::{Island, Member};
use crate::mechanism;
use crate::spatial::{split_spatial, stack_spatial};
use crate::step::kinematic_ends;
use crate::step::prediction::{Prediction, StepParameters};
use crate::step::proximity;
use ::nalgebra::{Matrix3, Vector6};
use core::cell::RefCell;
use lariat_ancf::island::{Island as IslandSolver, RigidBody};
use lariat_ancf::{Cable, Integrator, StepControl};
use rapier::pipeline::PhysicsWorld;

/// Number of elements to integrate below which threads are left asleep: to wake them takes as long.
#[cfg(feature = "parallel")]
const FEW_ELEMENTS: usize = 64;

thread_local! {
    /// Buffers of the islands that this thread integrates.
    static SOLVERS: RefCell<Vec<IslandSolver>> = const { RefCell::new(Vec::new()) };
}

/// An island that is ready, with its cables.
struct Job<'a> {
    island: &'a Island,
    cables: Vec<&'a mut Cable>,
    prediction: &'a mut Prediction,
    integrator: Integrator,
    /// Time step in s.
    h: f64,
}

impl Job<'_> {
    fn run(&mut self) {
        self.prediction.error = self.integrate().err().map(Error::from);
    }

    fn integrate(&mut self) -> Result<(), lariat_ancf::Error> {
        let Job { island, cables, prediction, integrator, h } = self;
        if island.members.is_empty() {
            return cables.iter_mut().try_for_each(|cable| cable.step_with(*h, &*integrator));
        }
        let mut solver = SOLVERS.with_borrow_mut(Vec::pop).unwrap_or_default();
        let outcome = solver.step(cables, &mut prediction.end, &island.pins, *integrator, *h);
        prediction.accounts.clear();
        prediction.accounts.extend_from_slice(solver.accounts());
        SOLVERS.with_borrow_mut(|solvers| solvers.push(solver));
        outcome
    }
}

/// Reads members and integrator of an island that will be integrated over a step.
pub(crate) fn prepare(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) -> Result<(), Error> {
    if !island.members.is_empty() {
        read_members(contents, world, island, prediction, step.h)?;
    }
    prediction.integrator = Some(share_of(integrator(contents, island), step.rapier_steps));
    Ok(())
}

/// Integrates the islands that are ready over a step of `h` (s), into their predictions.
pub(crate) fn integrate(contents: &mut Contents, islands: &[Island], predictions: &mut [Prediction], h: f64) {
    let mut slots = contents.cables.all_mut();
    let ready = islands.iter().zip(predictions).filter_map(|(island, prediction)| {
        let integrator = prediction.integrator?;
        let own = island.cables.iter().filter_map(|&c| slots[c].take());
        let cables = own.map(|slot| &mut slot.cable).collect();
        Some(Job { island, cables, prediction, integrator, h })
    });
    run(&mut ready.collect::<Vec<_>>());
}

fn run(jobs: &mut [Job<'_>]) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        let elements = jobs.iter().flat_map(|job| &job.cables).map(|cable| cable.elements().len()).sum::<usize>();
        if jobs.len() > 1 && elements >= FEW_ELEMENTS {
            jobs.par_iter_mut().for_each(Job::run);
            return;
        }
    }
    jobs.iter_mut().for_each(Job::run);
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
    island: &Island,
    prediction: &mut Prediction,
    h: f64,
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
                    substep: h / world.integration_parameters.num_solver_iterations.max(1) as f64,
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
            Member::Driven(handle) => kinematic_ends::driven_body(world, *handle, h)?,
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
        StepControl::Tolerance(tolerance) => tolerance,
        _ => f64::INFINITY,
    };
    all().fold(first, |best, i| if tolerance(&i) < tolerance(&best) { i } else { best })
}

/// Returns the integrator for one of `count` equal parts of the step that `integrator` is meant
/// for.
fn share_of(integrator: Integrator, count: u32) -> Integrator {
    let control = match integrator.control {
        StepControl::Tolerance(tolerance) => StepControl::Tolerance(tolerance / f64::from(count)),
        StepControl::Substeps(substeps) => StepControl::Substeps(substeps.div_ceil(count)),
        control => control,
    };
    Integrator { control, ..integrator }
}
