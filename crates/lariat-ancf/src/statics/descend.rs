//! Downhill to a stable shape: pseudo-transient Newton iteration, `(K + mu M) dq = F(q)`.
//!
//! Large mu follows the gradient of the potential energy in the metric of mass, mu = 0 is Newton's method. A step is
//! kept if it lowers the energy and the matrix is positive definite; then mu falls, else it grows. A moment enters by
//! its work over the step, the angle about its axis by which the tangent turns: it has no potential, but the work of
//! each step is its own. So the iteration goes downhill to a *stable* shape, and ends quadratically. Increments are
//! capped.
//!
//! A step that turns a thin cable stretches it in second order, and EA makes a mountain of that. Such a step is not
//! refused at once: a few more iterations make it the implicit step `F(q + dq) = mu M dq`, which comes back into the
//! valley.
//!
//! *Source.* Kelley & Keyes 1998 (pseudo-transient continuation); Rockafellar 1976 (proximal point).

use super::potential::{moment_work, potential};
use super::scale::{LoadScale, largest_force};
use super::{Budget, EquilibriumReport, Failure, SLOPE_CAP, largest_change};
use crate::cable::Cable;
use crate::error::StepFailure;
use crate::linalg::Definiteness;
use crate::system::project_vector;

/// Newton iterations by which a step that raised the energy is made an implicit one.
const INNER: usize = 6;
/// Growth of the residual beyond which a step that lowered the energy is made an implicit one too.
const OFF_VALLEY: f64 = 4.0;

impl Cable {
    /// The iteration at a share `load` of the point loads.
    pub(super) fn descend(&mut self, load: f64, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::of(&self.model, self.positions());
        let tolerance = budget.tolerance * scale.force + scale.rounding;
        let time = self.time();
        let n = self.positions().len();
        let mut phase = core::mem::take(&mut self.snapshot.state);
        let (mut equations, _) = self.equations();
        equations.prescribe(time, &mut phase.q, &mut phase.v);
        let [mut rhs, mut trial, mut good, mut step, mut inertia] = core::array::from_fn(|_| vec![0.0; n]);
        let mut mu = scale.mu;
        let mut merit = f64::INFINITY;
        let mut residual = f64::NAN;
        let mut cause = None;
        let mut report = None;
        for _ in 0..budget.attempt {
            if !budget.take() {
                break;
            }
            equations.static_force_and_matrix(load, &phase.q, 1.0, mu, &mut rhs);
            project_vector(equations.model, &mut rhs);
            residual = largest_force(&rhs, scale.element);
            if !residual.is_finite() {
                cause = Some(StepFailure::NotFinite { what: "force", node: 0 });
                break;
            }
            if !merit.is_finite() {
                merit = potential(&equations, load, &phase.q);
            }
            let small = residual <= tolerance;
            let kind = equations.factor();
            let definite = matches!(kind, Ok(Definiteness::PositiveDefinite));
            if small && mu == 0.0 {
                report = Some(EquilibriumReport { iterations: budget.done, residual, stable: definite });
                break;
            }
            if small {
                // converged in force: the last step is Newton's, to settle the shape and to judge stability
                mu = if definite { 0.0 } else { mu };
                if mu == 0.0 {
                    equations.static_force_and_matrix(load, &phase.q, 1.0, 0.0, &mut rhs);
                    let stable = matches!(equations.factor(), Ok(Definiteness::PositiveDefinite));
                    if !stable {
                        report = Some(EquilibriumReport { iterations: budget.done, residual, stable });
                        break;
                    }
                }
            }
            if !definite {
                cause = kind.err();
                mu = (4.0 * mu).max(scale.mu * 1e-6);
                if mu > scale.mu * 1e15 {
                    break;
                }
                continue;
            }
            equations.solve(&mut rhs);
            let (move_, slope) = largest_change(&rhs);
            let damp = (SLOPE_CAP / slope.max(SLOPE_CAP)).min(0.2 * scale.length / move_.max(0.2 * scale.length));
            for i in 0..n {
                trial[i] = phase.q[i] + damp * rhs[i];
            }
            let mut kept = None;
            let mut change_before = slope.min(SLOPE_CAP);
            for inner in 0..=INNER {
                if inner > 0 {
                    // the implicit step: F(trial) = mu M (trial - q) by Newton's method with a fresh matrix
                    if !budget.take() {
                        break;
                    }
                    for i in 0..n {
                        step[i] = trial[i] - phase.q[i];
                    }
                    equations.static_force_and_matrix(load, &trial, 1.0, mu, &mut rhs);
                    equations.system.mass.multiply(equations.system.level, &step, &mut inertia);
                    rhs.iter_mut().zip(&inertia).for_each(|(f, m)| *f -= mu * m);
                    if !matches!(equations.factor(), Ok(Definiteness::PositiveDefinite)) {
                        break;
                    }
                    equations.solve(&mut rhs);
                    let now = largest_change(&rhs).1;
                    let damp = SLOPE_CAP / now.max(SLOPE_CAP);
                    if !now.is_finite() || now > 2.0 * SLOPE_CAP || damp == 1.0 && now > 0.5 * change_before {
                        break;
                    }
                    change_before = now;
                    trial.iter_mut().zip(&rhs).for_each(|(q, dq)| *q += damp * dq);
                }
                equations.static_force(load, &trial, 1.0, &mut rhs);
                project_vector(equations.model, &mut rhs);
                let after = largest_force(&rhs, scale.element);
                let energy = potential(&equations, load, &trial);
                let change = energy - merit - load * moment_work(equations.model, &phase.q, &trial);
                // energies differ by less than their rounding near the end: then the residual decides
                if change < -scale.energy_rounding || (change <= scale.energy_rounding && after <= residual) {
                    kept = Some((energy, after));
                    good.copy_from_slice(&trial);
                    // far off the valley, the next step would start uphill
                    if mu == 0.0 || inner > 0 || after <= OFF_VALLEY * residual {
                        break;
                    }
                    continue;
                }
                if kept.is_some() {
                    break;
                }
                if mu == 0.0 && after <= residual * 4.0 && small {
                    report = Some(EquilibriumReport { iterations: budget.done, residual, stable: true });
                    break;
                }
                if mu == 0.0 || !change.is_finite() {
                    break;
                }
            }
            if report.is_some() {
                break;
            }
            if let Some((energy, after)) = kept {
                phase.q.copy_from_slice(&good);
                merit = energy;
                mu = if mu < scale.mu * 1e-9 || after < 1e-6 * scale.force { 0.0 } else { mu / 4.0 };
            } else {
                mu = (10.0 * mu).max(scale.mu * 1e-6);
                if mu > scale.mu * 1e15 {
                    break;
                }
            }
        }
        self.snapshot.state = phase;
        report.ok_or(Failure { cause, residual })
    }
}
