//! Load incrementation by Newton's method: finds unstable shapes too, which moments require.
//!
//! The ramp starts at the share of the loads that the present shape already carries, else at the
//! equilibrium without point loads. The increment of load is doubled if it converges quickly and
//! halved if it fails.
//!
//! # References
//!
//! Crisfield 1991, section 9.4 (load incrementation with automatic steps).

use super::attempt::{Budget, EquilibriumReport, Failure, largest_change};
use crate::cable::Cable;
use crate::linalg::Definiteness;
use crate::model::{LoadScale, largest_force};
use crate::scales::statics::{
    CARRIED_RESIDUAL, FEW_ITERATIONS, FIRST_INCREMENT, INTERMEDIATE_CHANGE, MAX_ITERATIONS_OF_INCREMENT,
    MAX_SLOPE_CHANGE, MIN_INCREMENT, RAMP_ROUNDING, STAGNATION,
};
use crate::system::project_vector;

impl Cable {
    /// Ramps the loads up to their full size.
    pub(crate) fn ramp_loads(&mut self, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let mut share = self.carried_share();
        if share.is_none() {
            self.minimise_energy(0.0, budget)?;
            share = Some(0.0);
        }
        let mut share = share.unwrap_or(0.0);
        let mut step = FIRST_INCREMENT;
        let mut good = self.snapshot.state.q.clone();
        let mut before: Option<(f64, Vec<f64>)> = None;
        loop {
            let next = if share + 1.01 * step >= 1.0 { 1.0 } else { share + step };
            if let Some((from, q)) = &before {
                let ratio = (next - share) / (share - from);
                self.snapshot.state.q.iter_mut().zip(q).for_each(|(q, q0)| *q += ratio * (*q - q0));
            }
            let done = budget.done;
            match self.newton(next, budget) {
                Ok(report) if next == 1.0 => return Ok(EquilibriumReport { iterations: budget.done, ..report }),
                Ok(_) => {
                    let q = core::mem::replace(&mut good, self.snapshot.state.q.clone());
                    before = (next > share).then_some((share, q));
                    share = next;
                    if budget.done - done <= FEW_ITERATIONS {
                        step *= 2.0;
                    }
                }
                Err(failure) => {
                    self.snapshot.state.q.copy_from_slice(&good);
                    step = 0.5 * (next - share);
                    if step < MIN_INCREMENT || budget.spent() {
                        return Err(failure);
                    }
                }
            }
        }
    }

    /// Returns the share of the point loads that balances the present shape, if any does.
    fn carried_share(&mut self) -> Option<f64> {
        let n = self.positions().len();
        let lever = LoadScale::new(&self.model, self.positions()).element;
        let (mut equations, state) = self.equations();
        equations.prescribe(state.time, &mut state.q, &mut state.v);
        let (mut none, mut load) = (vec![0.0; n], vec![0.0; n]);
        equations.static_force(0.0, &state.q, 1.0, &mut none);
        equations.static_force(1.0, &state.q, 1.0, &mut load);
        project_vector(equations.model, &mut none);
        project_vector(equations.model, &mut load);
        load.iter_mut().zip(&none).for_each(|(load, none)| *load -= none);
        let square: f64 = load.iter().map(|x| x * x).sum();
        let share = -none.iter().zip(&load).map(|(a, b)| a * b).sum::<f64>() / square;
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { return None };
        let size = largest_force(&load, lever);
        load.iter_mut().zip(&none).for_each(|(load, none)| *load = none + share * *load);
        (largest_force(&load, lever) <= CARRIED_RESIDUAL * size).then_some(share)
    }

    /// Solves by Newton's method with capped increments at a share `load` of the point loads; to
    /// the full tolerance at the full load.
    fn newton(&mut self, load: f64, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::new(&self.model, self.positions());
        let tolerance = budget.tolerance * scale.force + scale.rounding;
        let (mut equations, state) = self.equations();
        equations.prescribe(state.time, &mut state.q, &mut state.v);
        let q = &mut state.q;
        let mut rhs = vec![0.0; q.len()];
        let (mut cause, mut residual) = (None, f64::NAN);
        // at rounding on a thin cable no slope changes any more
        let (mut close, mut before) = (false, f64::INFINITY);
        for _ in 0..MAX_ITERATIONS_OF_INCREMENT {
            if !budget.take() {
                break;
            }
            equations.static_force_and_matrix(load, q, 1.0, 0.0, &mut rhs);
            project_vector(equations.model, &mut rhs);
            residual = largest_force(&rhs, scale.element);
            let kind = match equations.factor() {
                Ok(kind) => kind,
                Err(failure) => {
                    cause = Some(failure);
                    break;
                }
            };
            if close {
                let stable = matches!(kind, Definiteness::PositiveDefinite);
                return Ok(EquilibriumReport { iterations: budget.done, residual, stable });
            }
            equations.solve(&mut rhs);
            let (_, slope) = largest_change(&rhs);
            let damp = MAX_SLOPE_CHANGE / slope.max(MAX_SLOPE_CHANGE);
            if !damp.is_finite() || !slope.is_finite() {
                break;
            }
            q.iter_mut().zip(&rhs).for_each(|(q, dq)| *q += damp * dq);
            if load < 1.0 && slope < INTERMEDIATE_CHANGE {
                return Ok(EquilibriumReport { iterations: budget.done, residual, stable: false });
            }
            // a small residual is not enough: see `polish`
            close = slope < RAMP_ROUNDING || (residual <= tolerance && slope < STAGNATION && slope > 0.5 * before);
            before = slope;
        }
        Err(Failure { cause, residual, fold: None })
    }
}
