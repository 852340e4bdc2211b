//! One host step of a cable by itself.

use super::Cable;
use crate::error::{Error, StepFailure, require};
use crate::integrate::{IntegratorRef, OneStep, State, discrete_gradient, step_control};
use crate::model::Model;
use crate::system::{CableDynamics, CableStep, Equations};

/// Shortest step in s: squares of its smallest part must not vanish.
pub(crate) const SHORTEST_STEP: f64 = 1e-100;

impl Cable {
    /// Advances the cable by `dt` (s), the host's step, with its integrator. `dt` = 0 does nothing.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a `dt` that is negative, not finite, or below 1e-100 and not zero; [`Error::StepFailed`] if
    /// the step failed: the cable is then exactly as before. [`Error::Attached`] for a cable with
    /// [attached](Self::attach) nodes, which only an [`island`](crate::island) can step.
    pub fn step(&mut self, dt: f64) -> Result<(), Error> {
        let integrator = self.integrator;
        self.step_with(dt, &integrator)
    }

    /// Advances the cable as [`step`](Self::step) does, with this integrator instead of the cable's own: `&Integrator`, or an
    /// [`IntegratorRef`] with a method of another crate.
    ///
    /// # Errors
    /// As [`step`](Self::step), [`Integrator::checked`](crate::Integrator::checked) and [`set_integrator`](Self::set_integrator).
    pub fn step_with<'a>(&mut self, dt: f64, integrator: impl Into<IntegratorRef<'a>>) -> Result<(), Error> {
        let integrator = integrator.into();
        integrator.check()?;
        check_integrator(&self.model, integrator.method)?;
        require("dt (s)", dt, dt == 0.0 || dt >= SHORTEST_STEP, "0, or >= 1e-100")
            .map_err(|e| e.of_cable(self.name()))?;
        if dt == 0.0 {
            return Ok(());
        }
        self.check_complete()?;
        self.model.obstacles.check_bodies(self.name(), 0)?;
        if self.has_reel() {
            self.step_with_reel(dt, integrator)?;
        } else {
            self.with_workspace(|cable| cable.step_in_workspace(dt, integrator))?;
        }
        self.note_step();
        Ok(())
    }

    pub(super) fn step_in_workspace(&mut self, dt: f64, integrator: IntegratorRef<'_>) -> Result<(), Error> {
        self.before.copy_from(&self.snapshot.state);
        self.refresh_memory();
        self.begin_accounts();
        let equations = Equations { model: &self.model, system: &mut self.system, diagnostics: &mut self.diagnostics };
        let state = &mut self.snapshot.state;
        let (counts, outcome) = if integrator.method.uses_discrete_gradients() {
            let mut cable = CableStep { equations, state, buffers: &mut self.step_buffers };
            discrete_gradient::advance(&mut cable, integrator, dt)
        } else {
            state.memory.differences.clear();
            let mut dynamics = CableDynamics { equations, buffers: &mut self.buffers };
            step_control::advance(&mut dynamics, integrator, state, dt, &mut self.scratch)
        };
        self.diagnostics.steps += counts.steps;
        self.diagnostics.rejected_steps += counts.rejected;
        match outcome {
            Ok(()) => {
                self.diagnostics.host_steps += 1;
                self.snapshot.add_work_of_step(&mut self.system, &self.before.q);
                Ok(())
            }
            Err(failed) => {
                self.snapshot.state.copy_from(&self.before);
                Err(self.step_failed(failed.time, failed.step, failed.failure))
            }
        }
    }

    /// Begins what is summed and compared in a host step, and taken over if that succeeds.
    pub(crate) fn begin_accounts(&mut self) {
        self.system.meter.begin();
        self.system.load = self.snapshot.load;
        self.system.load.begin(self.snapshot.passed_at_start());
    }

    pub(crate) fn step_failed(&self, at: f64, step: f64, failure: StepFailure) -> Error {
        log::warn!("cable {:?}: step failed at t = {at} s: {failure}", self.model.name);
        Error::StepFailed { cable: self.model.name.clone(), time: self.time(), at, step, failure }
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
}

/// Checks that a cable has an implicit method where an effect or a reel needs one, the discrete gradient for contact, and with a reel a method by
/// which its account of energy closes.
pub(crate) fn check_integrator(model: &Model, method: &dyn OneStep) -> Result<(), Error> {
    if model.effects.contact.is_some() && !method.uses_discrete_gradients() {
        return Err(Error::ContactMethod { cable: model.name.clone(), method: method.name() });
    }
    if model.effects.needs_implicit_integrator() && method.stability_limit().is_some() {
        return Err(Error::ExplicitDamping { cable: model.name.clone(), method: method.name() });
    }
    if !model.reels.is_empty() && method.stability_limit().is_some() {
        return Err(Error::ExplicitReel { cable: model.name.clone(), method: method.name() });
    }
    let refused = |reason| Err(Error::ReelMethod { cable: model.name.clone(), method: method.name(), reason });
    if model.reels.have_laws() && !method.uses_discrete_gradients() {
        return refused("with max_force its rate is an unknown, which only discrete-gradient solves for");
    }
    if !model.reels.is_empty() && !method.uses_discrete_gradients() && method.estimate_order().is_none() {
        return refused(
            "its work is not accounted for where the steps do not resolve the waves of the mesh and the method leaves them ringing; use \
             discrete-gradient, or an implicit method with an estimate of its error, as esdirk4",
        );
    }
    Ok(())
}
