//! Minimising the potential energy by pseudo-transient Newton iteration, which ends in a stable
//! shape.
//!
//! # Equation
//!
//! `(K + mu M) dq = F(q)`. Large mu follows the gradient of the potential energy in the metric of
//! mass, mu = 0 is Newton's method. A step is kept if it lowers the energy and the matrix is
//! positive definite; then mu falls, else it grows. A moment has no potential; it enters by its
//! work over the step, moment times the angle about its axis by which the tangent rotates.
//! Increments are capped. The iteration ends by Newton's method alone (`polish`), or on a saddle,
//! which is left (`saddle`).
//!
//! A step that rotates a thin cable stretches it in second order, which costs a large axial energy.
//! Such a step is not rejected at once: a few more iterations make it the implicit step `F(q + dq)
//! = mu M dq`, whose energy is low again.
//!
//! # References
//!
//! Kelley & Keyes 1998 (pseudo-transient continuation); Rockafellar 1976 (proximal point).

use super::attempt::{Budget, EquilibriumReport, Failure, largest_change};
use super::potential::{moment_work, potential};
use crate::cable::Cable;
use crate::error::StepFailure;
use crate::linalg::Definiteness;
use crate::model::{LoadScale, largest_force};
use crate::scales::statics::{
    IMPLICIT_ITERATIONS, MAX_FAILED_POLISHES, MAX_MU, MAX_RESIDUAL_GROWTH, MAX_SADDLES, MAX_SLOPE_CHANGE, MIN_MU,
    NEAR_SADDLE,
};
use crate::system::{Equations, project_vector};
use nalgebra::Vector3;

/// The outcome of one step.
enum Step {
    /// Accepted, with its energy in J and residual in N.
    Accepted { energy: f64, residual: f64 },
    /// Rejected: mu must grow.
    Rejected,
}

/// The outcome of [`Minimisation::polish`].
pub(super) enum Polished {
    /// The increments are rounding; with the residual in N.
    Converged(f64),
    /// K is not positive definite.
    Indefinite,
    /// The increments did not fall; the shape is as it was.
    Failed,
}

/// An equilibrium that was left, to return to if no lower one is found.
pub(super) struct Saddle {
    pub q: Vec<f64>,
    /// Potential energy in J.
    pub energy: f64,
    /// Residual in N.
    pub residual: f64,
}

/// The iteration at a share `load` of the point loads.
pub(super) struct Minimisation<'a> {
    pub equations: Equations<'a>,
    pub scale: LoadScale,
    pub load: f64,
    pub mu: f64,
    pub rhs: Vec<f64>,
    trial: Vec<f64>,
    /// The best trial of the present step.
    pub best: Vec<f64>,
    pub step: Vec<f64>,
    pub inertia: Vec<f64>,
    /// The first saddle that was left.
    pub saddle: Option<Saddle>,
}

impl Cable {
    /// Minimises the potential energy at a share `load` of the point loads.
    pub(crate) fn minimise_energy(&mut self, load: f64, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::new(&self.model, self.positions());
        let tolerance = budget.tolerance * scale.force + scale.rounding;
        let n = self.positions().len();
        let (equations, state) = self.equations();
        equations.prescribe(state.time, &mut state.q, &mut state.v);
        let [rhs, trial, best, step, inertia] = core::array::from_fn(|_| vec![0.0; n]);
        let mu = scale.mu;
        let mut this = Minimisation { equations, scale, load, mu, rhs, trial, best, step, inertia, saddle: None };
        let q = &mut state.q;
        let outcome = this.descend(q, tolerance, budget);
        match this.saddle.take() {
            // no lower shape was found: it was not a saddle, but an indifferent shape
            Some(saddle)
                if outcome.is_err()
                    || potential(&this.equations, load, q) > saddle.energy - this.scale.energy_rounding =>
            {
                q.copy_from_slice(&saddle.q);
                Ok(EquilibriumReport { iterations: budget.done, residual: saddle.residual, stable: false })
            }
            _ => outcome,
        }
    }
}

impl Minimisation<'_> {
    /// Minimises from `q`, until the residual in N is within `tolerance` and the shape converged.
    fn descend(&mut self, q: &mut [f64], tolerance: f64, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let model = self.equations.model;
        let has_potential = model.loads.iter().all(|load| load.moment == Vector3::zeros());
        // an indifferent cable and one under moments have no saddle to leave
        let leaves = has_potential && !model.supports.is_empty();
        let (mut saddles, mut failed) = (if leaves { 0 } else { MAX_SADDLES }, 0);
        let mut energy = f64::INFINITY;
        let mut residual = f64::NAN;
        let mut cause = None;
        for _ in 0..budget.attempt {
            if !budget.take() {
                break;
            }
            residual = self.evaluate(q);
            if !residual.is_finite() {
                cause = Some(StepFailure::NotFinite { what: "force", node: 0 });
                break;
            }
            if !energy.is_finite() {
                energy = potential(&self.equations, self.load, q);
            }
            let small = residual <= tolerance;
            if small {
                match self.polish(q, budget) {
                    Polished::Converged(residual) => {
                        return Ok(EquilibriumReport { iterations: budget.done, residual, stable: true });
                    }
                    Polished::Indefinite => {
                        let here = Saddle { q: q.to_vec(), energy, residual };
                        if saddles == MAX_SADDLES || !self.leave_saddle(q, budget) {
                            return Ok(EquilibriumReport { iterations: budget.done, residual, stable: false });
                        }
                        self.saddle.get_or_insert(here);
                        saddles += 1;
                        energy = f64::INFINITY;
                        continue;
                    }
                    Polished::Failed if failed == MAX_FAILED_POLISHES => {
                        return Ok(EquilibriumReport { iterations: budget.done, residual, stable: false });
                    }
                    Polished::Failed => {
                        failed += 1;
                        self.evaluate(q);
                    }
                }
            }
            let kind = self.equations.factor();
            let definite = matches!(kind, Ok(Definiteness::PositiveDefinite));
            if !definite {
                if residual <= NEAR_SADDLE * self.scale.force && saddles < MAX_SADDLES {
                    saddles = if self.leave_saddle(q, budget) { saddles + 1 } else { MAX_SADDLES };
                    energy = f64::INFINITY;
                    continue;
                }
                cause = kind.err();
                if !self.raise_mu(4.0) {
                    break;
                }
                continue;
            }
            match self.step(q, energy, residual, budget) {
                Step::Accepted { energy: after, residual } => {
                    q.copy_from_slice(&self.best);
                    energy = after;
                    let (mu, scale) = (self.mu, &self.scale);
                    self.mu = if mu < scale.mu * 1e-9 || residual < 1e-6 * scale.force { 0.0 } else { mu / 4.0 };
                }
                Step::Rejected if self.raise_mu(10.0) => {}
                Step::Rejected => break,
            }
        }
        Err(Failure { cause, residual, fold: None })
    }

    /// Evaluates force and matrix at `q`, and returns the residual in N.
    pub(super) fn evaluate(&mut self, q: &[f64]) -> f64 {
        self.equations.static_force_and_matrix(self.load, q, 1.0, self.mu, &mut self.rhs);
        project_vector(self.equations.model, &mut self.rhs);
        largest_force(&self.rhs, self.scale.element)
    }

    /// Multiplies mu by `factor`, and returns whether it is still within its bounds.
    fn raise_mu(&mut self, factor: f64) -> bool {
        self.mu = (factor * self.mu).max(self.scale.mu * MIN_MU);
        self.mu <= self.scale.mu * MAX_MU
    }

    /// Takes a step from `q` with the factored matrix.
    fn step(&mut self, q: &[f64], energy: f64, residual: f64, budget: &mut Budget) -> Step {
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
            let Equations { system, model, .. } = &self.equations;
            let falls = gain < -rounding || (gain <= rounding && after <= residual);
            if falls && !system.static_contact.passes(model, q, &self.trial) {
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
