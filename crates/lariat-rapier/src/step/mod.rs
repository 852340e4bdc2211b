//! The host step: predict, Rapier's step, reconcile, as many times as a host step has Rapier steps.
//!
//! A body that is free, or touches something, goes through nine files, of which this is the first:
//!
//! | file | per Rapier step |
//! |---|---|
//! | [`mod@host_step`], [`substepping`], [`held_bodies`], [`mod@stiffness`] | the Rapier steps of a host step, and how many it has |
//! | [`predict`] | reads cables and bodies before the step |
//! | [`integrate`] | integrates them together, all islands at once |
//! | [`apply`] | gives Rapier the predicted motion; reverts it |
//! | [`impedance`] | lets a body that may deviate feel its cables within Rapier's step, and the cables what that did |
//! | [`next_pins`] | and what that does at the next pins of these cables |
//! | [`mod@reconcile`] | takes over what Rapier's step made of it |
//! | [`reaction`] | what contacts and joints did to it, expected again |
//!
//! The others hold only for what they name:
//!
//! | file | |
//! |---|---|
//! | [`kinematic_ends`] | ends of cables on fixed and kinematic bodies |
//! | [`groups`], [`mechanism`](crate::mechanism) | bodies on joints |
//! | [`sleep`], [`waking`] | bodies that rest, and those that Rapier's step woke |
//! | [`breaks`] | when a cable breaks within a Rapier step |
//! | [`reels`] | attachments and junctions of cables whose nodes move along them |
//! | [`budget`], [`settings`] | what a host step may cost, and how a set steps |
//! | [`energy`] | the energy balance of watched cables |
//! | [`refused`] | bodies of an island that cannot step |
//! | [`water`] | the forces of water on bodies |

pub(crate) mod apply;
mod breaks;
pub(crate) mod budget;
pub(crate) mod energy;
pub(crate) mod groups;
pub(crate) mod held_bodies;
mod host_step;
pub(crate) mod impedance;
pub(crate) mod integrate;
pub(crate) mod kinematic_ends;
mod next_pins;
pub(crate) mod predict;
pub(crate) mod prediction;
mod reaction;
pub(crate) mod reconcile;
pub(crate) mod reels;
pub(crate) mod refused;
pub(crate) mod settings;
pub(crate) mod sleep;
mod stiffness;
pub(crate) mod substepping;
mod waking;
pub(crate) mod water;

use crate::body;
use crate::body::prescribed_motion::PrescribedMotions;
use crate::body::proximity;
use crate::contact::broad::Finder;
use crate::contents::Contents;
use crate::edit::reel::beyond;
use crate::edit::{attach, breaking};
use crate::error::{Error, Failure};
use crate::events::Event;
use crate::handle::CableHandle;
use crate::islands::{Island, Islands};
use crate::scales::step::MAX_TURN_ERROR;
use budget::Remaining;
use held_bodies::HeldBodies;
pub use host_step::HostStep;
use lariat_ancf::Snapshot;
use lariat_ancf::coupling::Coupling;
use prediction::{Prediction, StepParameters};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;
use settings::Settings;

/// Buffers and events of the steps of a set. Nothing in them is state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stepper {
    islands: Islands,
    /// By island.
    predictions: Vec<Prediction>,
    /// Whether a prediction waits for its reconciliation.
    pending: bool,
    pub events: Vec<Event>,
    /// Finds what cables can touch.
    pub finder: Finder,
    /// The islands that could not step in this host step.
    pub failures: Vec<Failure>,
    /// Of the present host step.
    budget: Remaining,
    /// Buffers.
    buffers: integrate::Buffers,
    held: HeldBodies,
    motions: PrescribedMotions,
}

/// Begins a host step of `world.integration_parameters.dt`, which becomes that of a Rapier step.
pub(crate) fn begin(
    stepper: &mut Stepper,
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    settings: &Settings,
) -> Result<HostStep, Error> {
    let dt = world.integration_parameters.dt;
    if !(dt.is_finite() && dt >= 0.0) {
        return Err(Error::TimeStep { dt: f64::from(dt) });
    }
    let mut host = HostStep::new(dt);
    if dt > 0.0 {
        stepper.events.clear();
        stepper.failures.clear();
        stepper.budget = Remaining::new(settings.budget, f64::from(dt));
        stepper.predictions.iter_mut().for_each(|p| (p.budget, p.degraded) = (stepper.budget, false));
        let new = contents.held_bodies().filter(|&body| contents.records.get(body).is_none());
        new.chain(contents.records.handles()).for_each(|body| body::update_mass(world, body));
        host.steps = substepping::count(contents, world, settings, &mut stepper.held, f64::from(dt));
        host.motions = core::mem::take(&mut stepper.motions);
        let attached = contents.attachments.values().map(|a| a.body);
        host.motions.read(attached, &contents.records, world, f64::from(dt));
        if host.steps > 1 {
            host.motions.add_others(&contents.records, world, f64::from(dt));
        }
        world.integration_parameters.dt = dt / host.steps as Real;
        water::begin(contents);
    }
    Ok(host)
}

/// Predicts the next Rapier step of a host step. An island that cannot step stays as it is, with
/// its bodies, for the rest of the host step.
pub(crate) fn predict_next(
    stepper: &mut Stepper,
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    settings: &Settings,
    host: &mut HostStep,
) -> Result<(), Error> {
    if !host.is_unfinished() {
        return Ok(());
    }
    if host.done > 0 {
        breaking::break_overloaded(contents, &mut stepper.events);
        split_finer(contents, world, settings, &mut stepper.held, host);
    } else if host.dt > 0.0 {
        // one that is awake breaks where its prediction begins
        breaking::break_sleeping(contents, &mut stepper.events);
    }
    host.advance();
    if host.dt == 0.0 {
        return Ok(());
    }
    reels::remesh(contents)?;
    loop {
        world.integration_parameters.dt = host.lengths().1;
        revert_pending(stepper, world);
        water::take_off(contents, world, false);
        water::put_on(contents, world, settings, host);
        host.motions.advance(&mut contents.records, world, host.share());
        let outcome = predict_islands(stepper, contents, world, settings, host);
        host.failed = outcome.is_err();
        if !matches!(outcome, Ok(Predicted::Whole)) {
            water::take_off(contents, world, false);
        }
        match outcome? {
            Predicted::Whole => return Ok(()),
            Predicted::Coarse(parts) => host.refine(parts),
            Predicted::Overloaded(at) if at > 0.0 => host.divide(at),
            Predicted::Overloaded(_) => {
                host.begin_broken();
                breaking::break_overloaded(contents, &mut stepper.events);
            }
        }
        if host.rapier_steps() > 1 {
            host.motions.add_others(&contents.records, world, f64::from(host.dt));
        }
    }
}

/// Splits the rest of a host step finer, if a body met another since it began.
fn split_finer(
    contents: &Contents,
    world: &mut PhysicsWorld,
    settings: &Settings,
    held: &mut HeldBodies,
    host: &mut HostStep,
) {
    let max = settings.most_rapier_steps(f64::from(host.dt)) / host.steps;
    let needed = substepping::count(contents, world, settings, held, f64::from(host.dt));
    let finer = needed.div_ceil(host.steps).min(max);
    if finer > 1 && !host.is_divided() {
        (host.steps, host.done) = (host.steps * finer, host.done * finer);
    }
}

/// Ends a host step: `world.integration_parameters.dt` is the host's again.
pub(crate) fn finish(stepper: &mut Stepper, contents: &mut Contents, world: &mut PhysicsWorld, host: HostStep) {
    world.integration_parameters.dt = host.dt;
    if host.is_unfinished() || host.failed {
        host.motions.restore(world);
    } else if host.dt > 0.0 {
        host.motions.remember(&mut contents.records);
        water::finish(contents, f64::from(host.dt));
    }
    stepper.motions = host.motions;
}

/// What the prediction of a Rapier step gave; all but the first is reverted, to be predicted anew.
enum Predicted {
    Whole,
    /// A body turned otherwise by so much, or so much passed an eye, that it is to be divided into
    /// equal parts.
    Coarse(u32),
    /// A cable exceeded its limit at a share of it.
    Overloaded(f64),
}

/// Reverts what was predicted, and never reconciled.
fn revert_pending(stepper: &mut Stepper, world: &mut PhysicsWorld) {
    if core::mem::take(&mut stepper.pending) {
        for (island, prediction) in stepper.islands.list.iter().zip(&mut stepper.predictions) {
            prediction.held.release(world);
            apply::revert_bodies(world, island, prediction);
        }
    }
}

/// Predicts the next Rapier step of all islands.
fn predict_islands(
    stepper: &mut Stepper,
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    settings: &Settings,
    host: &HostStep,
) -> Result<Predicted, Error> {
    attach::end_lost(contents, world, &mut stepper.events)?;
    contents.follow_gravity(world)?;
    contents.held_bodies().for_each(|body| body::give_mass(world, body));
    let h = f64::from(world.integration_parameters.dt);
    stepper.finder.begin(contents, world, h);
    let step = loop {
        let step = prepare_islands(stepper, contents, world, settings, host)?;
        reels::mark(contents);
        let Stepper { islands, predictions, finder, buffers, .. } = &mut *stepper;
        integrate::integrate(contents, &islands.list, predictions, buffers, step.h);
        let stepped =
            || islands.list.iter().zip(predictions.iter()).filter(|(_, p)| p.integrator.is_some() && p.error.is_none());
        let turn = stepped().map(|(_, p)| groups::largest_turn_error(p, step.h)).fold(0.0, f64::max);
        let of_water = stepped().map(|(island, p)| water::parts(contents, island, p)).fold(1.0, f64::max);
        let passed = predictions.iter().map(parts_for_reels).fold(1.0, f64::max);
        let parts = (turn / MAX_TURN_ERROR).sqrt().max(passed).max(of_water).ceil().min(f64::from(u32::MAX)) as u32;
        let parts = parts.min(settings.most_rapier_steps(f64::from(host.dt)) / host.steps).max(1);
        // an island that cannot step has no motion, and no state from before it
        let before = |island: usize, cable: usize| {
            let moved = predictions.get(island).filter(|p| !p.refused && p.error.is_none())?;
            moved.snapshots.get(cable).map(Snapshot::positions)
        };
        let met = finder.neighbours.complete(contents, &islands.list, before);
        let overload = breaks::first_overload(contents, &islands.list, predictions, (settings, host), step.h);
        if !met && parts == 1 && overload.is_none() {
            break step;
        }
        // a body turned otherwise, a reel ran off, a cable broke, or cables met that were not
        // expected to: they are united, and the step begins anew
        for (island, prediction) in islands.list.iter().zip(predictions.iter()).filter(|(_, p)| !p.refused) {
            apply::revert(contents, world, island, prediction);
            let disturbed = prediction.sleep.disturbed;
            for &cable in &island.cables {
                contents.cables.get_mut(cable).into_iter().for_each(|slot| slot.modified |= disturbed);
            }
        }
        if parts > 1 {
            return Ok(Predicted::Coarse(parts));
        }
        if let Some(at) = overload.filter(|_| !met) {
            return Ok(Predicted::Overloaded(at));
        }
    };
    let Stepper { islands, predictions, events, failures, .. } = &mut *stepper;
    reels::follow(contents);
    for (island, prediction) in islands.list.iter().zip(predictions.iter_mut()) {
        if core::mem::take(&mut prediction.degraded) {
            let spent = prediction.budget.spent;
            for cable in island.cables.iter().map(|&c| CableHandle(c as u32)) {
                let told = events.iter_mut().find_map(|event| match event {
                    Event::Degraded { cable: other, iterations } if *other == cable => Some(iterations),
                    _ => None,
                });
                match told {
                    Some(iterations) => *iterations = spent,
                    None => events.push(Event::Degraded { cable, iterations: spent }),
                }
            }
        }
        if prediction.integrator.is_some() && prediction.error.is_none() {
            prediction.error = complete_island(contents, world, island, prediction, &step).err();
        }
        if let Some(error) = prediction.error.take() {
            apply::revert(contents, world, island, prediction);
            prediction.applied.clear();
            impedance::disable_motors(contents, world, island.attachments.iter().flatten().copied());
            failures.push(island.failure(contents, error));
            prediction.refused = true;
        }
        if prediction.refused {
            prediction.held.hold(&contents.records, world, island);
        }
    }
    stepper.pending = true;
    Ok(Predicted::Whole)
}

/// Returns into how many parts a Rapier step is to be divided because of what passes an eye in it:
/// the rate of a reel that nothing drives may grow within.
fn parts_for_reels(prediction: &Prediction) -> f64 {
    match &prediction.error {
        Some(Error::Cable(lariat_ancf::Error::FastReel { share, most, .. })) => share / most,
        _ => 1.0,
    }
}

/// Finds the islands of a Rapier step, and begins the prediction of all.
fn prepare_islands(
    stepper: &mut Stepper,
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    settings: &Settings,
    host: &HostStep,
) -> Result<StepParameters, Error> {
    let Finder { touching, neighbours, .. } = &stepper.finder;
    if contents.changed {
        beyond::count(contents);
    }
    stepper.islands.update(contents, world, touching, &neighbours.pairs)?;
    let budget = stepper.budget;
    stepper.predictions.resize_with(stepper.islands.list.len(), || Prediction { budget, ..Prediction::default() });
    stepper.predictions.iter_mut().for_each(|prediction| prediction.applied.clear());
    let is_awake = |body: RigidBodyHandle| !world.bodies[body].is_sleeping();
    let needs_speeds = stepper.islands.list.iter().any(|island| island.bodies().any(is_awake));
    let step = StepParameters {
        h: f64::from(world.integration_parameters.dt),
        host: f64::from(host.lengths().0) * f64::from(host.steps),
        rapier_steps: host.steps,
        share: host.share(),
        fastest: if needs_speeds { proximity::fastest(world) } else { 0.0 },
        sleep_speed: settings.sleep_speed,
    };
    let Stepper { islands, predictions, events, failures, finder, .. } = &mut *stepper;
    for (island, prediction) in islands.list.iter().zip(predictions.iter_mut()) {
        let failed = |failure: &Failure| failure.cables.iter().any(|c| island.cables.contains(&(c.0 as usize)));
        prediction.refused = failures.iter().any(failed);
        (prediction.integrator, prediction.error) = (None, None);
        if !prediction.refused {
            let outcome = prepare_island(contents, world, island, prediction, (&host.motions, &step), (finder, events));
            prediction.error = outcome.err();
        }
    }
    Ok(step)
}

/// Begins the prediction of a Rapier step of one island: it is then ready to be integrated, or
/// asleep.
fn prepare_island(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    (motions, step): (&PrescribedMotions, &StepParameters),
    (finder, events): (&mut Finder, &mut Vec<Event>),
) -> Result<(), Error> {
    contents.align_clocks(&island.cables)?;
    if step.share.0 == 0.0 {
        contents.for_cables(&island.cables, |_, cable| cable.plan_reels(step.host));
    }
    prediction.snapshots.resize_with(island.cables.len(), Snapshot::default);
    let snapshots = &mut prediction.snapshots;
    contents.for_cables(&island.cables, |c, cable| snapshots[c].clone_from(cable.snapshot()));
    check_links(contents, island)?;
    let ends_moved =
        island.bodies().next().is_some() && kinematic_ends::have_moved(contents, world, motions, island, step.h);
    let mut moved = ends_moved;
    for &cable in &island.cables {
        moved |= finder.gather(contents, world, (cable, island), (motions, step.share, step.h), events)?;
    }
    prediction.sleep = sleep::update(contents, world, island, moved, (step.h, step.sleep_speed), events);
    if prediction.sleep.asleep {
        if !impedance::are_held(contents, island, step.h) {
            impedance::hold(contents, world, island, prediction, step.h, |a| [a.reading.force, a.reading.moment])?;
        }
        contents.for_cables(&island.cables, |_, cable| cable.rest(step.h));
        return Ok(());
    }
    kinematic_ends::prescribe(contents, world, motions, island, step)?;
    impedance::disable_motors(contents, world, island.supports.iter().copied());
    predict::prepare(contents, world, motions, island, prediction, step)
}

/// Refuses an island that has lost a link of a multibody.
fn check_links(contents: &Contents, island: &Island) -> Result<(), Error> {
    let attached = island.attachments.iter().flatten().filter_map(|&index| contents.attachments.get(index));
    match attached.into_iter().find(|attachment| attachment.lost_link) {
        None => Ok(()),
        Some(a) => Err(Error::LinkLost {
            cable: contents.cable(a.cable)?.name().to_string(),
            body: a.body,
            gap: a.reading.gap.norm(),
        }),
    }
}

/// Gives Rapier the motion of an island that was integrated.
fn complete_island(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    prediction: &mut Prediction,
    step: &StepParameters,
) -> Result<(), Error> {
    predict::complete(contents, island, prediction);
    apply::apply(contents, world, island, prediction, step.h);
    impedance::set_motors(contents, world, island, prediction, step)?;
    island.wheels.keep(contents, &prediction.wheels);
    Ok(())
}

/// Reconciles all islands with Rapier's step.
pub(crate) fn reconcile(stepper: &mut Stepper, contents: &mut Contents, world: &mut PhysicsWorld, settings: &Settings) {
    if !core::mem::take(&mut stepper.pending) {
        return;
    }
    contents.listed = Some(world.colliders.len());
    contents.records.follow_kinematic(world);
    let h = f64::from(world.integration_parameters.dt);
    for (island, prediction) in stepper.islands.list.iter().zip(&mut stepper.predictions) {
        if core::mem::take(&mut prediction.refused) {
            prediction.held.release(world);
        } else {
            reconcile::reconcile(contents, world, island, prediction, (h, settings.sleep_speed));
        }
        prediction.applied.clear();
    }
    water::take_off(contents, world, true);
}
