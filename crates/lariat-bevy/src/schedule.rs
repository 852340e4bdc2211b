//! Labels of schedules and system sets, so that users can order their systems against the stages of
//! a host step.

use bevy_ecs::schedule::{ScheduleLabel, SystemSet};

/// One host step of `Physics.integration_parameters.dt`: [`CableSystems::Prepare`], then
/// [`RapierStep`] as often as [`Settings::rapier_steps`](lariat_rapier::Settings) says, then
/// [`CableSystems::Publish`].
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct CableStep;

/// One Rapier step: [`CableSystems::Predict`], [`CableSystems::Engine`],
/// [`CableSystems::Reconcile`].
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct RapierStep;

/// For hosts that step Rapier themselves: [`CableSystems::Prepare`] and [`CableSystems::Predict`]
/// of a host step that is one Rapier step. [`Physics`](crate::Physics) must hold Rapier's world,
/// with its `integration_parameters.dt`.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct BeforeEngine;

/// For hosts that step Rapier themselves: [`CableSystems::Reconcile`] and
/// [`CableSystems::Publish`].
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct AfterEngine;

/// The stages of a host step, in their order. Systems can run before, between and after them.
///
/// | set | schedule | what it does |
/// |---|---|---|
/// | `Prepare` | [`CableStep`] | applies what was spawned, changed and removed |
/// | `Predict` | [`RapierStep`] | integrates cables with their bodies, and applies the motion to Rapier's bodies |
/// | `Engine` | [`RapierStep`] | Rapier's step |
/// | `Reconcile` | [`RapierStep`] | reconciles bodies and cables |
/// | `Publish` | [`CableStep`] | readings, poses, counters, events |
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CableSystems {
    /// Applies what was spawned, changed and removed.
    Prepare,
    /// Integrates cables with their bodies, and applies the motion to Rapier's bodies.
    Predict,
    /// Rapier's step.
    Engine,
    /// Reconciles bodies and cables.
    Reconcile,
    /// Readings, poses, counters, events.
    Publish,
}
