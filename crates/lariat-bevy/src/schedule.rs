//! Schedules and system sets: what runs when, so that users can put systems between.

use crate::breaking;
use crate::clock::FixedClock;
use crate::diagnostics::Diagnostics;
use crate::event;
use crate::prepare::{self, ChangedEffects};
use crate::world::{Cables, Physics};
use crate::{publish, step};
use bevy_ecs::schedule::{IntoScheduleConfigs, Schedule, ScheduleLabel, Schedules, SystemSet};
use bevy_ecs::world::World;

/// One host step of `Physics.integration_parameters.dt`: [`CableSystems::Prepare`], then [`RapierStep`] as often as
/// [`Settings::rapier_steps`](lariat_rapier::Settings) says, then [`CableSystems::Publish`].
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct CableStep;

/// One Rapier step: [`CableSystems::Predict`], [`CableSystems::Engine`], [`CableSystems::Reconcile`].
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct RapierStep;

/// For hosts that step Rapier themselves: [`CableSystems::Prepare`] and [`CableSystems::Predict`] of a host step that is one Rapier step.
/// [`Physics`] must hold Rapier's world, with its `integration_parameters.dt`.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct BeforeEngine;

/// For hosts that step Rapier themselves: [`CableSystems::Reconcile`] and [`CableSystems::Publish`].
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct AfterEngine;

/// The stages of a host step, in their order. Put systems before, between and after them.
///
/// | set | schedule | what it does |
/// |---|---|---|
/// | `Prepare` | [`CableStep`] | takes in what was spawned, changed, removed |
/// | `Predict` | [`RapierStep`] | integrates cables and their bodies, hands the motion to Rapier |
/// | `Engine` | [`RapierStep`] | Rapier's own step |
/// | `Reconcile` | [`RapierStep`] | settles bodies and cables |
/// | `Publish` | [`CableStep`] | readings, poses, counts, events |
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CableSystems {
    /// Takes in what was spawned, changed, removed.
    Prepare,
    /// Integrates cables and their bodies.
    Predict,
    /// Rapier's own step.
    Engine,
    /// Settles bodies and cables.
    Reconcile,
    /// Readings, poses, counts, events.
    Publish,
}

/// Sets a world up: resources, messages and schedules. [`Physics`] is kept if it is there. Twice does no harm.
pub fn install(world: &mut World) {
    if world.contains_resource::<Cables>() {
        return;
    }
    world.init_resource::<Physics>();
    world.init_resource::<Cables>();
    world.init_resource::<Diagnostics>();
    world.init_resource::<ChangedEffects>();
    world.init_resource::<FixedClock>();
    event::register(world);
    let mut schedules = world.get_resource_or_init::<Schedules>();
    for schedule in [cable_step(), rapier_step(), before_engine(), after_engine()] {
        schedules.insert(schedule);
    }
}

fn cable_step() -> Schedule {
    let mut schedule = Schedule::new(CableStep);
    schedule.configure_sets((CableSystems::Prepare, CableSystems::Publish).chain());
    add_prepare(&mut schedule);
    schedule.add_systems(step::advance.after(CableSystems::Prepare).before(CableSystems::Publish));
    add_publish(&mut schedule);
    schedule
}

fn before_engine() -> Schedule {
    let mut schedule = Schedule::new(BeforeEngine);
    schedule.configure_sets((CableSystems::Prepare, CableSystems::Predict).chain());
    add_prepare(&mut schedule);
    schedule.add_systems((step::begin_one.before(step::predict), step::predict).in_set(CableSystems::Predict));
    schedule
}

fn after_engine() -> Schedule {
    let mut schedule = Schedule::new(AfterEngine);
    schedule.configure_sets((CableSystems::Reconcile, CableSystems::Publish).chain());
    schedule.add_systems((step::reconcile, step::finish).chain().in_set(CableSystems::Reconcile));
    add_publish(&mut schedule);
    schedule
}

fn add_prepare(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            prepare::begin,
            prepare::retire,
            prepare::build_planned,
            prepare::make_bodies,
            prepare::watch_effects,
            prepare::change_effects,
            prepare::take_cables,
            prepare::bind,
            prepare::remember,
            prepare::end,
        )
            .chain()
            .in_set(CableSystems::Prepare),
    );
}

fn add_publish(schedule: &mut Schedule) {
    schedule.add_systems(
        (publish::read_attachments, publish::count, publish::read_bodies, breaking::part, publish::send)
            .chain()
            .in_set(CableSystems::Publish),
    );
}

fn rapier_step() -> Schedule {
    let mut schedule = Schedule::new(RapierStep);
    schedule.configure_sets((CableSystems::Predict, CableSystems::Engine, CableSystems::Reconcile).chain());
    schedule.add_systems((
        step::predict.in_set(CableSystems::Predict),
        step::engine.in_set(CableSystems::Engine),
        step::reconcile.in_set(CableSystems::Reconcile),
    ));
    schedule
}
