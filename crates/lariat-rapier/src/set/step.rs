//! Host steps of a set: the part of its interface that advances it.

use super::{CableSet, slack};
use crate::contact;
use crate::edit::{breaking, world_mark};
use crate::error::Error;
use crate::read::warnings;
use crate::step::{self, HostStep};
use rapier::pipeline::{EventHandler, PhysicsHooks, PhysicsWorld};

impl CableSet {
    /// Advances cables and world by a host step of `world.integration_parameters.dt`, split into
    /// Rapier steps as the [`Settings`](crate::Settings) say.
    ///
    /// # Errors
    /// [`Error::StepRefused`] if cables cannot step. They and their bodies are then as after the
    /// last Rapier step that they could make, and all other cables and bodies have advanced; every
    /// such island is in [`failures`](Self::failures). With any other error nothing has advanced.
    pub fn step(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
        self.step_with_events(world, &(), &())
    }

    /// As [`step`](Self::step), with hooks and an event handler for Rapier.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_with_events(
        &mut self,
        world: &mut PhysicsWorld,
        hooks: &dyn PhysicsHooks,
        events: &dyn EventHandler,
    ) -> Result<(), Error> {
        let mut host = self.begin(world)?;
        let mut outcome = Ok(());
        while host.is_unfinished() {
            outcome = self.predict_next(world, &mut host);
            if outcome.is_ok() {
                world.step_with_events(hooks, events);
                self.reconcile(world);
            }
        }
        outcome.and(self.finish(world, host))
    }

    /// Begins a host step, for those who step Rapier themselves: as long as
    /// [`is_unfinished`](HostStep::is_unfinished), call [`predict_next`](Self::predict_next), step
    /// Rapier, and call [`reconcile`](Self::reconcile); in the end, or after an error, call
    /// [`finish`](Self::finish). Meanwhile `world.integration_parameters.dt` is that of a Rapier
    /// step.
    ///
    /// # Errors
    /// [`Error::TimeStep`]; [`Error::OtherWorld`] for a world that is not that of the attachments,
    /// which stay as they are.
    pub fn begin(&mut self, world: &mut PhysicsWorld) -> Result<HostStep, Error> {
        world_mark::check(&mut self.contents, world)?;
        slack::draw_all_outside(&mut self.contents, world)?;
        let host = step::begin(&mut self.stepper, &mut self.contents, world, &self.settings)?;
        if host.is_unfinished() {
            warnings::introduce(&mut self.contents, world, (self.settings.warn_level, self.interface));
        }
        Ok(host)
    }

    /// Predicts the next Rapier step of a host step: integrates cables and their bodies, and gives
    /// Rapier the motion of the bodies.
    ///
    /// # Errors
    /// An error that concerns the whole set; cables and bodies are then as before. An island that
    /// cannot step is no error here: it is in [`failures`](Self::failures).
    pub fn predict_next(&mut self, world: &mut PhysicsWorld, host: &mut HostStep) -> Result<(), Error> {
        step::predict_next(&mut self.stepper, &mut self.contents, world, &self.settings, host)
    }

    /// Updates cables and bodies after Rapier's step.
    pub fn reconcile(&mut self, world: &mut PhysicsWorld) {
        step::reconcile(&mut self.stepper, &mut self.contents, world, &self.settings);
    }

    /// Ends a host step: `world.integration_parameters.dt` is the host's again.
    ///
    /// # Errors
    /// The error of the first of [`failures`](Self::failures).
    pub fn finish(&mut self, world: &mut PhysicsWorld, host: HostStep) -> Result<(), Error> {
        let is_complete = host.is_complete();
        step::finish(&mut self.stepper, &mut self.contents, world, host);
        if is_complete {
            contact::events::compare(&mut self.contents, &mut self.stepper.events);
            let told = (self.settings.warn_level, self.interface);
            warnings::note(&mut self.contents, world, told, &mut self.stepper.events);
            breaking::break_overloaded(&mut self.contents, &mut self.stepper.events);
        }
        self.failures().first().map_or(Ok(()), |failure| Err(failure.error.clone()))
    }
}
