//! In a flow: the cable is let go and moves to where it comes to rest, by an L-stable integrator with growing steps.
//!
//! Drag depends on the direction of the cable, so a flow has no potential to go down, and its tangent is not symmetric, which Newton's
//! iteration here needs. The motion itself finds the shape: drag damps it, and a step far beyond the period of everything is an implicit
//! Euler step towards rest, whose error falls by its own length in periods. *Source.* Kelley & Keyes 1998 (pseudo-transient
//! continuation). *Validity.* Steady flow (that of the cable's present time, held), shapes that are stable in the flow; the rate is
//! linear. *Rejected.* Newton with the symmetric half of the tangent: it ends in a cycle on a towed cable.

use super::scale::{LoadScale, largest_force};
use super::{Budget, EquilibriumReport, Failure};
use crate::cable::{Cable, project_vector};
use crate::integrate::{Integrator, Method, NewtonMode, StepControl};

/// Growth of a step that succeeded, and shrinkage of one that failed.
const GROWTH: f64 = 1.3;
const SHRINK: f64 = 0.25;
/// Steps that failed one after the other.
const FAILURES: usize = 12;

impl Cable {
    /// Moves the cable to rest in the flow.
    pub(super) fn drift(&mut self, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let (integrator, time) = (self.integrator(), self.time());
        let method = Method::GeneralisedAlpha { rho: 0.0, newton: NewtonMode::Converged };
        let quiet = Integrator { method, control: StepControl::Substeps(1) };
        if self.set_integrator(quiet).is_err() {
            return Err(Failure::default());
        }
        // the ramp of the point loads is in "time": hold it at full load
        let loads = self.model.loads.clone();
        self.model.loads.iter_mut().for_each(|load| load.ramp = 0.0);
        self.system.hold_flow(time);
        self.still();
        let outcome = self.drift_on(budget);
        self.system.release_flow(&self.model);
        self.model.loads = loads;
        self.state.phase.time = time;
        self.still();
        // it was the cable's own a moment ago
        let _ = self.set_integrator(integrator);
        outcome
    }

    fn drift_on(&mut self, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::of(&self.model, self.positions());
        let mut step = 0.1 / scale.mu.sqrt();
        let mut rhs = vec![0.0; self.positions().len()];
        let (mut residual, mut failures, mut cause) = (f64::NAN, 0, None);
        while budget.take() {
            match self.step(step) {
                Ok(()) => {
                    failures = 0;
                    step *= GROWTH;
                }
                Err(error) => {
                    failures += 1;
                    step *= SHRINK;
                    if failures == FAILURES {
                        if let crate::error::Error::StepFailed { failure, .. } = error {
                            cause = Some(failure);
                        }
                        break;
                    }
                    continue;
                }
            }
            let (mut equations, phase) = self.equations();
            equations.force(1.0, &phase.q, 1.0, &mut rhs);
            project_vector(equations.model, &mut rhs);
            residual = largest_force(&rhs, scale.element);
            if residual <= budget.tolerance * scale.force + scale.rounding {
                return Ok(EquilibriumReport { iterations: budget.done, residual, stable: true });
            }
        }
        Err(Failure { cause, residual })
    }
}
