//! The parts of a cable, lent apart to what steps it.

use super::Cable;
use crate::error::{Error, StepFailure};
use crate::state::State;
use crate::system::{CableDynamics, CableStep, Equations};

impl Cable {
    /// Begins what is summed and compared in a host step, and taken over if that succeeds.
    pub(crate) fn begin_accounts(&mut self) {
        self.system.meter.begin();
        self.system.load = self.snapshot.load;
        self.system.load.begin(self.snapshot.passed_at_start());
    }

    pub(crate) fn step_failed(&self, at: f64, step: f64, failure: StepFailure) -> Error {
        let posed = self.posed.filter(|(time, ..)| *time == self.time());
        let failure = match (posed, failure) {
            // a limit is one whatever happens
            (None, failure) | (_, failure @ StepFailure::WorkLimit) => failure,
            (Some((_, key, distance)), cause) => StepFailure::PosedObstacle { key, distance, cause: Box::new(cause) },
        };
        log::warn!("cable {:?}: step failed at t = {at} s: {failure}", self.model.name);
        Error::StepFailed { cable: self.model.name.clone(), time: self.time(), at, step, failure }
    }

    pub(crate) fn equations(&mut self) -> (Equations<'_>, &mut State) {
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        (equations, &mut self.snapshot.state)
    }

    pub(crate) fn step_parts(&mut self) -> CableStep<'_> {
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        CableStep { equations, state: &mut self.snapshot.state, buffers: &mut self.step_buffers }
    }

    pub(crate) fn dynamics(&mut self) -> (CableDynamics<'_>, &State) {
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        (CableDynamics { equations, buffers: &mut self.buffers }, &self.snapshot.state)
    }

    /// Rejects a cable that cannot be stepped by itself.
    pub(crate) fn check_complete(&self) -> Result<(), Error> {
        self.check_forces()?;
        if self.model.reels.sides().any(|side| self.needs_island(side)) {
            let reason = "its end is at a sheave or on a drum: only an island with that sheave or drum steps it";
            return Err(Error::ReelPlace { cable: self.name().to_string(), reason });
        }
        match self.model.supports.iter().find(|(_, s)| s.attached) {
            None => Ok(()),
            Some((node, _)) => Err(Error::Attached { cable: self.name().to_string(), node: *node }),
        }
    }
}
