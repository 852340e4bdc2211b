//! Minimising the potential energy by pseudo-transient Newton iteration, which ends in a stable
//! shape.
//!
//! # Equation
//!
//! `(K + mu M) dq = F(q)`. Large mu follows the gradient of the potential energy in the metric of
//! mass, mu = 0 is Newton's method. A step is kept if it lowers the energy and the matrix is
//! positive definite; then mu falls, else it grows. A moment has no potential; it enters by its
//! work over the step, moment times the angle about its axis by which the tangent rotates. The
//! iteration ends quadratically. Increments are capped.
//!
//! A step that rotates a thin cable stretches it in second order, which costs a large axial energy.
//! Such a step is not rejected at once: a few more iterations make it the implicit step `F(q + dq)
//! = mu M dq`, whose energy is low again.
//!
//! # References
//!
//! Kelley & Keyes 1998 (pseudo-transient continuation); Rockafellar 1976 (proximal point).

use super::attempt::{Budget, EquilibriumReport, Failure, MAX_SLOPE_CHANGE, largest_change};
use super::potential::{moment_work, potential};
use super::scale::{LoadScale, largest_force};
use crate::cable::Cable;
use crate::error::StepFailure;
use crate::linalg::Definiteness;
use crate::system::{Equations, project_vector};

/// Newton iterations that make a step that raised the energy an implicit one.
const IMPLICIT_ITERATIONS: usize = 6;
/// Growth of the residual above which a step that lowered the energy is made an implicit one too.
const MAX_RESIDUAL_GROWTH: f64 = 4.0;
/// Smallest mu after a failed step, and largest, as shares of its first value.
const MIN_MU: f64 = 1e-6;
const MAX_MU: f64 = 1e15;

/// The outcome of one step.
enum Step {
    /// Accepted, with its energy in J and residual in N.
    Accepted { energy: f64, residual: f64 },
    /// Rejected: mu must grow.
    Rejected,
    /// A Newton step at rounding: the shape is converged.
    Converged,
}

/// The iteration at a share `load` of the point loads.
struct Minimisation<'a> {
    equations: Equations<'a>,
    scale: LoadScale,
    load: f64,
    mu: f64,
    rhs: Vec<f64>,
    trial: Vec<f64>,
    /// The best trial of the present step.
    best: Vec<f64>,
    step: Vec<f64>,
    inertia: Vec<f64>,
}

impl Cable {
    /// Minimises the potential energy at a share `load` of the point loads.
    pub(super) fn minimise_energy(&mut self, load: f64, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::new(&self.model, self.positions());
        let tolerance = budget.tolerance * scale.force + scale.rounding;
        let n = self.positions().len();
        let (equations, state) = self.equations();
        equations.prescribe(state.time, &mut state.q, &mut state.v);
        let [rhs, trial, best, step, inertia] = core::array::from_fn(|_| vec![0.0; n]);
        let mu = scale.mu;
        let mut this = Minimisation { equations, scale, load, mu, rhs, trial, best, step, inertia };
        let q = &mut state.q;
        let mut energy = f64::INFINITY;
        let mut residual = f64::NAN;
        let mut cause = None;
        for _ in 0..budget.attempt {
            if !budget.take() {
                break;
            }
            residual = this.evaluate(q);
            if !residual.is_finite() {
                cause = Some(StepFailure::NotFinite { what: "force", node: 0 });
                break;
            }
            if !energy.is_finite() {
                energy = potential(&this.equations, load, q);
            }
            let small = residual <= tolerance;
            let kind = this.equations.factor();
            let definite = matches!(kind, Ok(Definiteness::PositiveDefinite));
            if small && this.mu == 0.0 {
                return Ok(EquilibriumReport { iterations: budget.done, residual, stable: definite });
            }
            if small && definite {
                // the force is converged: the last step is Newton's, to converge the shape and to
                // judge stability
                this.mu = 0.0;
                this.equations.static_force_and_matrix(load, q, 1.0, 0.0, &mut this.rhs);
                let stable = matches!(this.equations.factor(), Ok(Definiteness::PositiveDefinite));
                if !stable {
                    return Ok(EquilibriumReport { iterations: budget.done, residual, stable });
                }
            }
            if !definite {
                cause = kind.err();
                if !this.raise_mu(4.0) {
                    break;
                }
                continue;
            }
            match this.step(q, energy, residual, small, budget) {
                Step::Converged => return Ok(EquilibriumReport { iterations: budget.done, residual, stable: true }),
                Step::Accepted { energy: after, residual } => {
                    q.copy_from_slice(&this.best);
                    energy = after;
                    let (mu, scale) = (this.mu, &this.scale);
                    this.mu = if mu < scale.mu * 1e-9 || residual < 1e-6 * scale.force { 0.0 } else { mu / 4.0 };
                }
                Step::Rejected if this.raise_mu(10.0) => {}
                Step::Rejected => break,
            }
        }
        Err(Failure { cause, residual })
    }
}

impl Minimisation<'_> {
    /// Evaluates force and matrix at `q`, and returns the residual in N.
    fn evaluate(&mut self, q: &[f64]) -> f64 {
        self.equations.static_force_and_matrix(self.load, q, 1.0, self.mu, &mut self.rhs);
        project_vector(self.equations.model, &mut self.rhs);
        largest_force(&self.rhs, self.scale.element)
    }

    /// Multiplies mu by `factor`, and returns whether it is still within its bounds.
    fn raise_mu(&mut self, factor: f64) -> bool {
        self.mu = (factor * self.mu).max(self.scale.mu * MIN_MU);
        self.mu <= self.scale.mu * MAX_MU
    }

    /// Takes a step from `q` with the factored matrix; `small` if the residual is within its
    /// tolerance.
    fn step(&mut self, q: &[f64], energy: f64, residual: f64, small: bool, budget: &mut Budget) -> Step {
        self.equations.solve(&mut self.rhs);
        let (displacement, slope) = largest_change(&self.rhs);
        let length = 0.2 * self.scale.length;
        let damp = (MAX_SLOPE_CHANGE / slope.max(MAX_SLOPE_CHANGE)).min(length / displacement.max(length));
        for i in 0..q.len() {
            self.trial[i] = q[i] + damp * self.rhs[i];
        }
        let mut accepted = Step::Rejected;
        let mut change = slope.min(MAX_SLOPE_CHANGE);
        for iteration in 0..=IMPLICIT_ITERATIONS {
            if iteration > 0 {
                if !budget.take() {
                    break;
                }
                match self.iterate_implicit(q, change) {
                    Some(after) => change = after,
                    None => break,
                }
            }
            self.equations.static_force(self.load, &self.trial, 1.0, &mut self.rhs);
            project_vector(self.equations.model, &mut self.rhs);
            let after = largest_force(&self.rhs, self.scale.element);
            let trial_energy = potential(&self.equations, self.load, &self.trial);
            let gain = trial_energy - energy - self.load * moment_work(self.equations.model, q, &self.trial);
            // near the end energies differ by less than their rounding: then the residual decides
            let rounding = self.scale.energy_rounding;
            if gain < -rounding || (gain <= rounding && after <= residual) {
                accepted = Step::Accepted { energy: trial_energy, residual: after };
                self.best.copy_from_slice(&self.trial);
                // with a much larger residual the next step would begin by raising the energy
                if self.mu == 0.0 || iteration > 0 || after <= MAX_RESIDUAL_GROWTH * residual {
                    break;
                }
                continue;
            }
            if matches!(accepted, Step::Accepted { .. }) {
                break;
            }
            if self.mu == 0.0 && after <= residual * 4.0 && small {
                return Step::Converged;
            }
            if self.mu == 0.0 || !gain.is_finite() {
                break;
            }
        }
        accepted
    }

    /// Does one Newton iteration of the implicit step `F(trial) = mu M (trial - q)` with a fresh
    /// matrix, and returns the largest change of a slope; `None` if it does not converge. `before`
    /// is the change of the iteration before.
    fn iterate_implicit(&mut self, q: &[f64], before: f64) -> Option<f64> {
        let Self { equations, rhs, trial, step, inertia, .. } = self;
        for i in 0..q.len() {
            step[i] = trial[i] - q[i];
        }
        equations.static_force_and_matrix(self.load, trial, 1.0, self.mu, rhs);
        equations.system.mass.multiply(equations.system.level, step, inertia);
        rhs.iter_mut().zip(inertia.iter()).for_each(|(f, m)| *f -= self.mu * m);
        if !matches!(equations.factor(), Ok(Definiteness::PositiveDefinite)) {
            return None;
        }
        equations.solve(rhs);
        let change = largest_change(rhs).1;
        let damp = MAX_SLOPE_CHANGE / change.max(MAX_SLOPE_CHANGE);
        if !change.is_finite() || change > 2.0 * MAX_SLOPE_CHANGE || damp == 1.0 && change > 0.5 * before {
            return None;
        }
        trial.iter_mut().zip(rhs.iter()).for_each(|(q, dq)| *q += damp * dq);
        Some(change)
    }
}
