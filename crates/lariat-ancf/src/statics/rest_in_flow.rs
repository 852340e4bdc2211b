//! Equilibrium in a flow: the released cable moves until it is at rest, by an L-stable integrator
//! with growing steps.
//!
//! Drag depends on the direction of the cable, so a flow has no potential to minimise, and its
//! tangent is not symmetric, as the Newton iteration here requires. The motion itself converges to
//! the shape: drag damps it, and a step far longer than all periods is an implicit Euler step
//! towards rest, whose error falls with its length in periods.
//!
//! The search of an island takes a quarter of the time, and does not converge on a towed cable
//! without bending stiffness: this follows it.
//!
//! # Validity
//!
//! No contact. Steady flow (that of the cable's present time), and shapes that are stable in it.
//! Convergence is linear.
//!
//! # References
//!
//! Kelley & Keyes 1998 (pseudo-transient continuation).
//!
//! # Alternatives considered
//!
//! Newton's method with the symmetric part of the tangent: it ends in a cycle on a towed cable.

use super::attempt::{Budget, EquilibriumReport, Failure, largest_change};
use crate::cable::Cable;
use crate::integrate::{Integrator, Method, StepControl};
use crate::model::{LoadScale, largest_force};
use crate::scales::statics::{FLOW_AT_REST, FLOW_GROWTH, FLOW_REDUCTION, MAX_FAILURES};
use crate::system::project_vector;

impl Cable {
    /// Moves the cable to rest in the flow.
    pub(crate) fn follow_to_rest_in_flow(&mut self, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let (integrator, time) = (self.integrator(), self.time());
        let method = Method::GeneralisedAlpha { rho: 0.0 };
        let damping = Integrator { method, control: StepControl::Substeps(1) };
        if self.set_integrator(damping).is_err() {
            return Err(Failure::default());
        }
        // the ramp of the point loads depends on time: hold it at full load
        let loads = self.model.loads.clone();
        self.model.loads.iter_mut().for_each(|load| load.ramp = 0.0);
        self.system.forces.hold(time);
        self.set_at_rest();
        let outcome = self.step_to_rest(budget);
        self.system.forces.release(&self.model);
        self.model.loads = loads;
        self.snapshot.state.time = time;
        self.set_at_rest();
        // valid, because it was the cable's own
        let _ = self.set_integrator(integrator);
        outcome
    }

    fn step_to_rest(&mut self, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::new(&self.model, self.positions());
        let mut step = 0.1 / scale.mu.sqrt();
        let mut rhs = vec![0.0; self.positions().len()];
        let mut before = self.positions().to_vec();
        let (mut residual, mut failures, mut cause) = (f64::NAN, 0, None);
        while budget.take() {
            match self.step(step) {
                Ok(()) => {
                    failures = 0;
                    step *= FLOW_GROWTH;
                }
                Err(error) => {
                    failures += 1;
                    step *= FLOW_REDUCTION;
                    if failures == MAX_FAILURES {
                        if let crate::error::Error::StepFailed { failure, .. } = error {
                            cause = Some(failure);
                        }
                        break;
                    }
                    continue;
                }
            }
            before.iter_mut().zip(self.positions()).for_each(|(before, q)| *before -= q);
            let (displacement, slope) = largest_change(&before);
            let change = slope.max(displacement / scale.length);
            before.copy_from_slice(self.positions());
            let (mut equations, state) = self.equations();
            equations.static_force(1.0, &state.q, 1.0, &mut rhs);
            project_vector(equations.model, &mut rhs);
            residual = largest_force(&rhs, scale.element);
            if residual <= budget.tolerance * scale.force + scale.rounding && change <= FLOW_AT_REST {
                return Ok(EquilibriumReport { iterations: budget.done, residual, stable: true });
            }
        }
        Err(Failure { cause, residual, fold: None })
    }
}
