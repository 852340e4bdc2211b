//! One host step of a cable by itself, or of many that nothing connects.

mod fleet;
#[cfg(feature = "parallel")]
mod grain;
mod reel;

use crate::scales::SMALLEST;
pub use fleet::{FleetError, step_all};
#[cfg(feature = "parallel")]
pub use grain::{cost_of_step, jobs_of_task};

use crate::cable::{Cable, check_integrator};
use crate::error::{Error, require};
use crate::integrate::{IntegratorRef, WorkLimit, step_control};
use crate::island::advance_alone;
use crate::system::{CableDynamics, Equations};

impl Cable {
    /// Advances the cable by `dt` (s), the host's step, with its integrator. `dt` = 0 does nothing.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a `dt` that is negative, not finite, or below 1e-100 and not
    /// zero; [`Error::StepFailed`] if the step failed: the cable is then exactly as before.
    /// [`Error::Attached`] for a cable with [attached](crate::coupling::Coupling::attach) nodes,
    /// which only an [`island`](crate::island) can step.
    pub fn step(&mut self, dt: f64) -> Result<(), Error> {
        let integrator = self.integrator;
        self.step_with(dt, &integrator)
    }

    /// Advances the cable as [`step`](Self::step) does, with this `&Integrator` instead of the
    /// cable's own. Its method may be of another crate.
    ///
    /// # Errors
    /// As [`step`](Self::step), [`Integrator::checked`](crate::Integrator::checked) and
    /// [`set_integrator`](Self::set_integrator).
    pub fn step_with<'a>(&mut self, dt: f64, integrator: impl Into<IntegratorRef<'a>>) -> Result<(), Error> {
        let integrator = integrator.into();
        integrator.check()?;
        check_integrator(&self.model, integrator.method)?;
        require("dt (s)", dt, dt == 0.0 || dt >= SMALLEST, "0, or >= 1e-100").map_err(|e| e.of_cable(self.name()))?;
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

    fn step_in_workspace(&mut self, dt: f64, integrator: IntegratorRef<'_>) -> Result<(), Error> {
        self.before.copy_from(&self.snapshot.state);
        self.stop_ended();
        self.bend_struts(|_| {});
        self.refresh_memory();
        self.begin_accounts();
        let (counts, outcome) = if integrator.method.uses_discrete_gradients() {
            advance_alone(self, integrator, dt)
        } else {
            self.begin_torsion();
            let (model, state) = (&self.model, &mut self.snapshot.state);
            let equations = Equations { model, system: &mut self.system, diagnostics: &mut self.diagnostics };
            state.memory.differences.clear();
            let mut dynamics = CableDynamics { equations, buffers: &mut self.buffers };
            let outcome = step_control::advance(&mut dynamics, integrator, state, dt, &mut self.scratch);
            self.buffers.torsion = self.system.torsion_forces.take();
            outcome
        };
        self.diagnostics.steps += counts.steps;
        self.diagnostics.rejected_steps += counts.rejected;
        self.diagnostics.unresolved_steps += counts.unresolved;
        self.diagnostics.cut_steps += u64::from(integrator.limit.is_some_and(WorkLimit::has_reduced));
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
}
