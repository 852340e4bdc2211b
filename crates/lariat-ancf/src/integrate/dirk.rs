//! Diagonally implicit Runge-Kutta methods for `M q'' = F`: one engine, a tableau per method.
//!
//! With stage velocities V_i and accelerations k_i, the first-order form q' = v, v' = k reduces stage by stage to one
//! equation of half the size (Hairer & Wanner 1996, IV.8):
//!
//! ```text
//! v^ = v_n + h sum_{j<i} a_ij k_j        q^ = q_n + h sum_{j<i} a_ij V_j + h a_ii v^
//! M (Q_i - q^) = (h a_ii)^2 F(Q_i, v^ + (Q_i - q^)/(h a_ii))       k_i = (Q_i - q^)/(h a_ii)^2
//! ```
//!
//! *Error.* `e = h sum (b_j - b^_j) V_j`, filtered by (M + c^2 K)^-1 M so that stiff components, which an L-stable method
//! damps, do not drive the step (Shampine 1980; Hosea & Shampine 1996). *Validity.* Any stiffness for L-stable tableaus.
//! *Rejected.* Tangents kept blindly over the stages: Newton fails on thin cables and steps shrink.

use super::dynamics::{Dynamics, Newton, Stage};
use super::{OneStep, Scratch, State};
use crate::error::StepFailure;

/// A tableau with one diagonal value; row `i` holds a_i0 .. a_ii.
#[derive(Clone, Copy, Debug)]
pub struct Tableau {
    /// Rows of A.
    pub a: &'static [&'static [f64]],
    /// Weights of the result; equal to the last row of A for a stiffly accurate method.
    pub b: &'static [f64],
    /// Weights `b - b^` of the error estimate; empty = none.
    pub error: &'static [f64],
    /// What the estimate is multiplied by, so that a tolerance meets the error of the result (see `tests/tolerance.rs`).
    pub calibration: f64,
}

impl Tableau {
    /// Abscissa of stage `i`.
    pub fn c(&self, i: usize) -> f64 {
        self.a[i].iter().sum()
    }

    /// Guesses the acceleration of stage `i` by the polynomial through those of the stages before it.
    fn predict(&self, i: usize, before: &[Vec<f64>], at_start: &[f64], k: &mut [f64]) {
        if before.is_empty() {
            k.copy_from_slice(at_start);
            return;
        }
        k.fill(0.0);
        // the last three stages at most: higher polynomials amplify what is not smooth
        let first = i.saturating_sub(3);
        for j in first..i {
            let weight =
                (first..i).filter(|&m| m != j).fold(1.0, |w, m| w * (self.c(i) - self.c(m)) / (self.c(j) - self.c(m)));
            add(k, weight, &before[j]);
        }
    }

    /// True if the last stage is the result.
    pub fn stiffly_accurate(&self) -> bool {
        self.a[self.a.len() - 1] == self.b
    }
}

/// `x += factor * y`.
pub(crate) fn add(x: &mut [f64], factor: f64, y: &[f64]) {
    for (x, y) in x.iter_mut().zip(y) {
        *x += factor * y;
    }
}

impl OneStep for Tableau {
    fn stages(&self) -> usize {
        self.a.len()
    }

    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        h: f64,
        newton_tolerance: f64,
        wanted: bool,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        let stages = self.a.len();
        let Scratch { next, base, velocity_base, error, stage_v, stage_k } = scratch;
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
                    add(velocity_base, h * row[j], &stage_k[j]);
                    add(base, h * row[j], &stage_v[j]);
                }
            }
            add(base, diagonal, velocity_base);
            let (before, rest) = stage_k.split_at_mut(i);
            let k = &mut rest[0];
            self.predict(i, before, &now.memory.acceleration, k);
            let stage = Stage {
                time: now.time + self.c(i) * h,
                c2: diagonal * diagonal,
                rate: 1.0 / diagonal,
                newton: Newton::Converge(newton_tolerance),
                reuse: i > 1,
            };
            system.solve_stage(&stage, base, velocity_base, &mut next.q, k)?;
            let v = &mut stage_v[i];
            v.copy_from_slice(velocity_base);
            add(v, diagonal, k);
        }
        if self.stiffly_accurate() {
            next.v.copy_from_slice(&stage_v[stages - 1]);
            next.memory.acceleration.copy_from_slice(&stage_k[stages - 1]);
            system.prescribe(now.time + h, &mut next.q, &mut next.v);
        } else {
            next.q.copy_from_slice(&now.q);
            next.v.copy_from_slice(&now.v);
            for j in 0..stages {
                add(&mut next.q, h * self.b[j], &stage_v[j]);
                add(&mut next.v, h * self.b[j], &stage_k[j]);
            }
            system.prescribe(now.time + h, &mut next.q, &mut next.v);
            system.acceleration(now.time + h, &next.q, &next.v, &mut next.memory.acceleration)?;
        }
        if self.error.is_empty() || !wanted {
            return Ok(None);
        }
        error.fill(0.0);
        for (j, &weight) in self.error.iter().enumerate() {
            if weight != 0.0 {
                add(error, h * weight, &stage_v[j]);
            }
        }
        system.filter(error);
        Ok(Some(self.calibration * system.norm(error)))
    }
}
