//! Counters of all cables of a world, and wall-clock time per stage.

use bevy_ecs::resource::Resource;
use web_time::{Duration, Instant};

/// Counters and times since [`install`](crate::install) or [`reset`](Self::reset). Cables that were
/// removed stay counted.
#[derive(Resource, Clone, Debug, Default)]
pub struct Diagnostics {
    /// Host steps.
    pub host_steps: u64,
    /// Host steps that failed.
    pub failed_steps: u64,
    /// Sum over cables: steps, rejected steps, Newton iterations, evaluations by effect.
    pub cables: lariat_ancf::Diagnostics,
    /// Element evaluations by rule.
    pub elements_by_rule: Vec<(lariat_ancf::Rule, u64)>,
    /// Work of cables on bodies through all attachments in J.
    pub interface_work: f64,
    /// Wall-clock time by stage; not reproducible.
    pub times: Times,
    /// When the stage under way began.
    started: Option<Instant>,
}

/// Wall-clock time spent in each stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Times {
    /// Applying what was spawned, changed and removed.
    pub prepare: Duration,
    /// Integrating cables and their bodies.
    pub predict: Duration,
    /// Rapier's steps.
    pub engine: Duration,
    /// Reconciling bodies and cables.
    pub reconcile: Duration,
    /// Readings of attachments.
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
    /// Sets all counters and times to zero.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Starts the clock of a stage.
    pub(crate) fn start(&mut self) {
        self.started = Some(Instant::now());
    }

    /// Stops the clock, and adds the time to that of a stage.
    pub(crate) fn stop(&mut self, stage: Stage) {
        let time = match stage {
            Stage::Prepare => &mut self.times.prepare,
            Stage::Predict => &mut self.times.predict,
            Stage::Engine => &mut self.times.engine,
            Stage::Reconcile => &mut self.times.reconcile,
            Stage::Publish => &mut self.times.publish,
        };
        *time += self.started.take().map_or(Duration::ZERO, |started| started.elapsed());
    }

    /// Adds the counters of a cable since they were last read.
    pub(crate) fn count(&mut self, rule: lariat_ancf::Rule, done: &lariat_ancf::Diagnostics) {
        self.cables += *done;
        let elements = done.element_evaluations();
        match self.elements_by_rule.iter_mut().find(|(r, _)| *r == rule) {
            Some((_, sum)) => *sum += elements,
            None => self.elements_by_rule.push((rule, elements)),
        }
    }
}
