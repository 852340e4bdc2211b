//! What all cables of a world did: counts, and time per stage.

use bevy_ecs::resource::Resource;
use std::time::{Duration, Instant};

/// Counts and times since the world was set up, or [`reset`](Self::reset). Cables that went away stay counted.
#[derive(Resource, Clone, Debug, Default)]
pub struct Diagnostics {
    /// Host steps.
    pub host_steps: u64,
    /// Host steps that were refused.
    pub refused_steps: u64,
    /// Sum over cables: steps, rejected steps, Newton iterations, evaluations by effect.
    pub cables: lariat_ancf::Diagnostics,
    /// Elements evaluated, by force strategy.
    pub elements_by_rule: Vec<(lariat_ancf::Rule, u64)>,
    /// Work of cables on bodies through all attachments, in J.
    pub interface_work: f64,
    /// Wall-clock time by stage; not reproducible.
    pub times: Times,
}

/// Wall-clock time spent in each stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Taking in what was spawned, changed and removed.
    pub prepare: Duration,
    /// Integrating cables and their bodies.
    pub predict: Duration,
    /// Rapier's own steps.
    pub engine: Duration,
    /// Settling bodies and cables.
    pub reconcile: Duration,
    /// Readings, poses, events.
    pub publish: Duration,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Stage {
    Prepare,
    Predict,
    Engine,
    Reconcile,
    Publish,
}

impl Diagnostics {
    /// All to zero.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    pub(crate) fn spent(&mut self, stage: Stage, since: Instant) {
        let time = match stage {
            Stage::Prepare => &mut self.times.prepare,
            Stage::Predict => &mut self.times.predict,
            Stage::Engine => &mut self.times.engine,
            Stage::Reconcile => &mut self.times.reconcile,
            Stage::Publish => &mut self.times.publish,
        };
        *time += since.elapsed();
    }

    /// Adds what a cable did since it was counted last.
    pub(crate) fn count(&mut self, rule: lariat_ancf::Rule, done: &lariat_ancf::Diagnostics) {
        self.cables += *done;
        let elements = done.element_evaluations();
        match self.elements_by_rule.iter_mut().find(|(r, _)| *r == rule) {
            Some((_, sum)) => *sum += elements,
            None => self.elements_by_rule.push((rule, elements)),
        }
    }
}
