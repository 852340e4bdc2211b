//! Along the ramp of the loads by plain Newton steps: finds unstable shapes too, which is what a moment calls for.
//!
//! The ramp starts at the share of the loads that the shape at hand carries already, else at no load, downhill. A
//! step of the ramp that converges quickly is doubled, one that fails is halved.
//!
//! *Source.* Load incrementation with automatic steps (Crisfield 1991, section 9.4).

use super::scale::{LoadScale, largest_force};
use super::{Budget, EquilibriumReport, Failure, SLOPE_CAP, largest_change};
use crate::cable::Cable;
use crate::linalg::Definiteness;
use crate::system::project_vector;

/// First step of the ramp, as a share of the loads.
const FIRST_STEP: f64 = 0.125;
/// Shortest step of the ramp.
const SHORTEST_STEP: f64 = 1.0 / 1024.0;
/// Newton iterations of one step of the ramp.
const ITERATIONS: usize = 16;
/// A step that takes at most so many iterations is doubled.
const QUICK: usize = 9;
/// Change of slopes by which a step within the ramp has converged.
const INTERMEDIATE: f64 = 1e-4;
/// Residual, as a share of the loads, below which a shape counts as carrying a part of them.
const CARRIED: f64 = 1e-4;

impl Cable {
    /// Ramps the loads up to their full size.
    pub(super) fn follow(&mut self, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let mut share = self.carried_share();
        if share.is_none() {
            self.descend(0.0, budget)?;
            share = Some(0.0);
        }
        let mut share = share.unwrap_or(0.0);
        let mut step = FIRST_STEP;
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
                    if budget.done - done <= QUICK {
                        step *= 2.0;
                    }
                }
                Err(failure) => {
                    self.snapshot.state.q.copy_from_slice(&good);
                    step = 0.5 * (next - share);
                    if step < SHORTEST_STEP || budget.spent() {
                        return Err(failure);
                    }
                }
            }
        }
    }

    /// The share of the point loads that balances the present shape, if any does.
    fn carried_share(&mut self) -> Option<f64> {
        let n = self.positions().len();
        let arm = LoadScale::of(&self.model, self.positions()).element;
        let mut phase = core::mem::take(&mut self.snapshot.state);
        let (mut equations, _) = self.equations();
        equations.prescribe(phase.time, &mut phase.q, &mut phase.v);
        let (mut none, mut load) = (vec![0.0; n], vec![0.0; n]);
        equations.static_force(0.0, &phase.q, 1.0, &mut none);
        equations.static_force(1.0, &phase.q, 1.0, &mut load);
        project_vector(equations.model, &mut none);
        project_vector(equations.model, &mut load);
        load.iter_mut().zip(&none).for_each(|(load, none)| *load -= none);
        self.snapshot.state = phase;
        let square: f64 = load.iter().map(|x| x * x).sum();
        let share = -none.iter().zip(&load).map(|(a, b)| a * b).sum::<f64>() / square;
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { return None };
        let size = largest_force(&load, arm);
        load.iter_mut().zip(&none).for_each(|(load, none)| *load = none + share * *load);
        (largest_force(&load, arm) <= CARRIED * size).then_some(share)
    }

    /// Newton's method with capped increments at a share `load` of the point loads; to the full tolerance at the full
    /// load.
    fn newton(&mut self, load: f64, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        let scale = LoadScale::of(&self.model, self.positions());
        let tolerance = budget.tolerance * scale.force + scale.rounding;
        let mut phase = core::mem::take(&mut self.snapshot.state);
        let mut rhs = vec![0.0; phase.q.len()];
        let (mut equations, _) = self.equations();
        equations.prescribe(phase.time, &mut phase.q, &mut phase.v);
        let (mut report, mut cause, mut residual) = (None, None, f64::NAN);
        let mut close = false;
        for _ in 0..ITERATIONS {
            if !budget.take() {
                break;
            }
            equations.static_force_and_matrix(load, &phase.q, 1.0, 0.0, &mut rhs);
            project_vector(equations.model, &mut rhs);
            residual = largest_force(&rhs, scale.element);
            let kind = match equations.factor() {
                Ok(kind) => kind,
                Err(failure) => {
                    cause = Some(failure);
                    break;
                }
            };
            if residual <= tolerance || close {
                let stable = matches!(kind, Definiteness::PositiveDefinite);
                report = Some(EquilibriumReport { iterations: budget.done, residual, stable });
                break;
            }
            equations.solve(&mut rhs);
            let (_, slope) = largest_change(&rhs);
            let damp = SLOPE_CAP / slope.max(SLOPE_CAP);
            if !damp.is_finite() || !slope.is_finite() {
                break;
            }
            phase.q.iter_mut().zip(&rhs).for_each(|(q, dq)| *q += damp * dq);
            if load < 1.0 && slope < INTERMEDIATE {
                report = Some(EquilibriumReport { iterations: budget.done, residual, stable: false });
                break;
            }
            // rounding on a thin cable: nothing moves any more
            close = slope < 1e-13;
        }
        self.snapshot.state = phase;
        report.ok_or(Failure { cause, residual })
    }
}
