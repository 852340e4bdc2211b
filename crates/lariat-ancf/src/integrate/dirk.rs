//! Diagonally implicit Runge-Kutta methods for `M q'' = F`, each given by its tableau.
//!
//! # Equation
//!
//! With stage velocities V_i and accelerations k_i, the first-order form q' = v, v' = k reduces
//! stage by stage to one equation of half the size (Hairer & Wanner 1996, IV.8):
//!
//! ```text
//! v^ = v_n + h sum_{j<i} a_ij k_j        q^ = q_n + h sum_{j<i} a_ij V_j + h a_ii v^
//! M (Q_i - q^) = (h a_ii)^2 F(Q_i, v^ + (Q_i - q^)/(h a_ii))       k_i = (Q_i - q^)/(h a_ii)^2
//! ```
//!
//! The error estimate is `e = h sum (b_j - b^_j) V_j`, filtered by (M + c^2 K)^-1 M so that stiff
//! components, which an L-stable method damps, do not determine the step.
//!
//! # Validity
//!
//! Any stiffness for L-stable tableaus.
//!
//! # References
//!
//! Hairer & Wanner 1996, IV.8. The filter: Shampine 1980; Hosea & Shampine 1996.
//!
//! # Alternatives considered
//!
//! One tangent for all stages, without a test of its contraction: Newton's iteration fails on thin
//! cables and steps shrink.

use super::dynamics::{Dynamics, Stage};
use super::one_step::{OneStep, Scratch, StepRequest, add_scaled};
use crate::error::StepFailure;
use crate::state::State;

/// An embedded error estimate.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// Weights `b - b^`.
    pub weights: &'static [f64],
    /// Exponent of h in the estimate.
    pub order: u32,
    /// Factor on the estimate by which a tolerance meets the error of the result (see
    /// `tests/tolerance.rs`).
    pub calibration: f64,
}

/// A tableau with one diagonal value; row `i` holds a_i0 .. a_ii.
#[derive(Clone, Copy, Debug)]
pub struct Tableau {
    /// Name of the method.
    pub name: &'static str,
    /// Rows of A.
    pub a: &'static [&'static [f64]],
    /// Weights of the result; equal to the last row of A for a stiffly accurate method.
    pub b: &'static [f64],
    /// Error estimate, if the method has one.
    pub estimate: Option<Estimate>,
}

impl Tableau {
    /// Returns the abscissa of stage `i`.
    pub fn c(&self, i: usize) -> f64 {
        self.a[i].iter().sum()
    }

    /// Extrapolates the acceleration of stage `i` from the stages before it, by a polynomial.
    fn predict(&self, i: usize, before: &[Vec<f64>], at_start: &[f64], k: &mut [f64]) {
        if before.is_empty() {
            k.copy_from_slice(at_start);
            return;
        }
        k.fill(0.0);
        // at most the last three stages: polynomials of higher degree amplify accelerations that
        // are not smooth
        let first = i.saturating_sub(3);
        for j in first..i {
            let weight =
                (first..i).filter(|&m| m != j).fold(1.0, |w, m| w * (self.c(i) - self.c(m)) / (self.c(j) - self.c(m)));
            add_scaled(k, weight, &before[j]);
        }
    }

    /// Returns whether the last stage is the result.
    pub fn stiffly_accurate(&self) -> bool {
        self.a[self.a.len() - 1] == self.b
    }
}

impl OneStep for Tableau {
    fn name(&self) -> String {
        self.name.to_string()
    }

    fn stages(&self) -> usize {
        self.a.len()
    }

    fn estimate_order(&self) -> Option<u32> {
        self.estimate.map(|estimate| estimate.order)
    }

    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        StepRequest { h, newton_tolerance, estimate }: StepRequest,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        let stages = self.a.len();
        let Scratch {
            next, base, velocity_base, error, stage_velocities: stage_v, stage_accelerations: stage_k, ..
        } = scratch;
        for i in 0..stages {
            let row = self.a[i];
            let diagonal = row[i] * h;
            if diagonal == 0.0 {
                stage_v[i].copy_from_slice(&now.v);
                stage_k[i].copy_from_slice(&now.memory.acceleration);
                continue;
            }
            velocity_base.copy_from_slice(&now.v);
            base.copy_from_slice(&now.q);
            for j in 0..i {
                if row[j] != 0.0 {
                    add_scaled(velocity_base, h * row[j], &stage_k[j]);
                    add_scaled(base, h * row[j], &stage_v[j]);
                }
            }
            add_scaled(base, diagonal, velocity_base);
            let (before, rest) = stage_k.split_at_mut(i);
            let k = &mut rest[0];
            self.predict(i, before, &now.memory.acceleration, k);
            let stage = Stage {
                time: now.time + self.c(i) * h,
                c2: diagonal * diagonal,
                dv_dq: 1.0 / diagonal,
                newton_tolerance,
                reuse: i > 1,
            };
            system.solve_stage(&stage, base, velocity_base, &mut next.q, k)?;
            let v = &mut stage_v[i];
            v.copy_from_slice(velocity_base);
            add_scaled(v, diagonal, k);
        }
        if self.stiffly_accurate() {
            next.v.copy_from_slice(&stage_v[stages - 1]);
            next.memory.acceleration.copy_from_slice(&stage_k[stages - 1]);
            system.prescribe(now.time + h, &mut next.q, &mut next.v);
        } else {
            next.q.copy_from_slice(&now.q);
            next.v.copy_from_slice(&now.v);
            for j in 0..stages {
                add_scaled(&mut next.q, h * self.b[j], &stage_v[j]);
                add_scaled(&mut next.v, h * self.b[j], &stage_k[j]);
            }
            system.prescribe(now.time + h, &mut next.q, &mut next.v);
            system.acceleration(now.time + h, &next.q, &next.v, &mut next.memory.acceleration)?;
        }
        let Some(embedded) = self.estimate.filter(|_| estimate) else { return Ok(None) };
        error.fill(0.0);
        for (j, &weight) in embedded.weights.iter().enumerate() {
            if weight != 0.0 {
                add_scaled(error, h * weight, &stage_v[j]);
            }
        }
        system.filter(error);
        error.iter_mut().for_each(|e| *e *= embedded.calibration);
        Ok(Some(system.norm(error)))
    }
}
