//! The equations of one cable, `M q'' = F(q, t)`, as the integrators see them.
//!
//! Newton for a stage `M z = c2 F(base + z)`: `(M + c2 K) dz = c2 F - M z`, full steps under a cap on the change of slope. A
//! factored tangent is tried again at the next iteration, and at the next stage of the same step, as long as increments shrink by
//! 0.3 or more with it (a force and a solve cost a third of a new tangent); at the first that does not, it is dropped.
//! *Stop.* What is left after increment d_k is predicted as 2 d_k^2/d_{k-1} with a kept tangent, d_k^3/d_{k-1}^2 with a fresh one; the
//! iteration ends when that, or d_k itself, is below the tolerance. *Rejected.* A line search on the residual (stagnates on thin
//! cables: the residual of stiff axial modes hides the progress of the bending modes); a tangent kept blindly over a step (Newton
//! diverges on steel and steps shrink); tangents kept across host steps (a restored snapshot would not replay bitwise).

use super::model::Model;
use super::projection::{project_matrix, project_vector};
use super::system::{MassSolver, System};
use crate::diagnostics::Diagnostics;
use crate::error::StepFailure;
use crate::integrate::{Dynamics, Newton, Stage};
use crate::linalg::Definiteness;

/// Newton iterations before a stage is given up.
const MAX_ITERATIONS: usize = 12;
/// Largest change of a slope vector in one Newton iteration.
const SLOPE_CAP: f64 = 0.5;
/// Newton's tolerance is at most this share of the displacement that the acceleration makes in the stage, and of the strain
/// that it makes in the cable (loosened a hundred times, steel gains energy and shows spurious tension at coarse tolerances).
const RELATIVE_TOLERANCE: f64 = 1e-2;
/// A tangent is kept for the next iteration or stage while increments shrink by this factor.
const CHORD_CONTRACTION: f64 = 0.3;
/// One iteration is enough if the second increment is below this share of the first.
const ONCE_CONTRACTION: f64 = 0.1;

/// A model with its system and counters: what the integrators see.
pub(crate) struct Equations<'a> {
    pub model: &'a Model,
    pub system: &'a mut System,
    pub diagnostics: &'a mut Diagnostics,
}

impl Equations<'_> {
    fn count_elements(&mut self, tangent: bool) {
        let n = self.model.elements.len() as u64;
        if tangent {
            self.diagnostics.tangent_evaluations += n;
        } else {
            self.diagnostics.force_evaluations += n;
        }
        if self.system.elements.bends() {
            self.diagnostics.bending_evaluations += n;
        }
    }

    /// `out = scale F(q, time)`: elastic forces, gravity, loads.
    pub fn force(&mut self, time: f64, q: &[f64], scale: f64, out: &mut [f64]) {
        out.fill(0.0);
        self.system.elements.add_force(self.system.level, q, scale, out);
        self.count_elements(false);
        self.system.add_loads(self.model, time, q, scale, out, false, self.diagnostics);
    }

    /// `out = scale F(q, time)`, and the step matrix `mass_scale M - scale dF/dq`, not yet projected.
    pub fn force_and_matrix(&mut self, time: f64, q: &[f64], scale: f64, mass_scale: f64, out: &mut [f64]) {
        out.fill(0.0);
        let system = &mut *self.system;
        system.elements.add_force_and_matrix(system.level, q, scale, mass_scale, out, &mut system.matrix);
        self.count_elements(true);
        self.system.add_loads(self.model, time, q, scale, out, true, self.diagnostics);
    }

    /// Projects and factors the step matrix.
    pub fn factor(&mut self) -> Result<Definiteness, StepFailure> {
        project_matrix(self.model, &mut self.system.matrix);
        self.diagnostics.factorisations += 1;
        let kind = self.system.factorisation.factor(self.system.level, &self.system.matrix)?;
        if !matches!(kind, Definiteness::PositiveDefinite) {
            self.diagnostics.indefinite_factorisations += 1;
        }
        Ok(kind)
    }

    /// Solves with the factored step matrix, in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.diagnostics.solves += 1;
        project_vector(self.model, rhs);
        self.system.factorisation.solve(self.system.level, rhs);
    }

    /// `rhs = c2 F(y) - M z`; with the matrix if asked.
    fn residual(&mut self, stage: &Stage, y: &[f64], z: &[f64], rhs: &mut [f64], scratch: &mut [f64], matrix: bool) {
        if matrix {
            self.force_and_matrix(stage.time, y, stage.c2, 1.0, rhs);
        } else {
            self.force(stage.time, y, stage.c2, rhs);
        }
        self.system.multiply_mass(z, scratch);
        for (r, m) in rhs.iter_mut().zip(scratch.iter()) {
            *r -= m;
        }
    }

    fn newton(
        &mut self,
        stage: &Stage,
        base: &[f64],
        y: &mut [f64],
        z: &mut [f64],
        rhs: &mut [f64],
        product: &mut [f64],
    ) -> Result<(), StepFailure> {
        let (tolerance, once) = match stage.newton {
            Newton::Converge(tolerance) => (tolerance, false),
            Newton::Once(tolerance) => (tolerance, true),
        };
        // z = c2 k. In a short step the tolerance must not swallow the acceleration; on a stiff cable a displacement d within
        // the tolerance may be a large strain d/l, so EA d/l is held below a share of the inertia force rho A L k as well.
        // Below rounding nothing can be met.
        let scale = self.system.extent(z).0 * (self.system.stiff_time_squared / stage.c2).min(1.0);
        let rounding = 4.0 * f64::EPSILON * base.iter().fold(1.0f64, |m, x| m.max(x.abs()));
        let tolerance = tolerance.min(RELATIVE_TOLERANCE * scale).max(rounding);
        let mut chord = stage.reuse && self.system.factored == stage.c2;
        let mut chords_contract = true;
        let mut before = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            self.diagnostics.newton_iterations += 1;
            self.residual(stage, y, z, rhs, product, !chord);
            if !chord {
                self.system.factored = 0.0;
                self.factor()?;
                self.system.factored = stage.c2;
            }
            self.solve(rhs);
            let (size, slope) = self.system.extent(rhs);
            let damp = if slope > SLOPE_CAP { SLOPE_CAP / slope } else { 1.0 };
            let size = damp * size;
            let ratio = size / before;
            if chord && !(ratio < CHORD_CONTRACTION || iteration == 1 && damp == 1.0) {
                // the old tangent does not serve: drop this increment and take a new one
                chord = false;
                chords_contract = false;
                if size.is_finite() {
                    continue;
                }
            }
            if !size.is_finite() {
                return Err(not_finite("Newton increment", rhs));
            }
            for i in 0..z.len() {
                z[i] += damp * rhs[i];
                y[i] = base[i] + z[i];
            }
            // what is left, if increments go on as they did: with one tangent linearly, with fresh ones quadratically
            let left = match (iteration, chord) {
                (1, _) => size,
                (_, true) => size * (2.0 * ratio).min(1.0),
                (_, false) => size * ratio * ratio,
            };
            if damp == 1.0 && (left.min(size) <= tolerance || once && chord && ratio <= ONCE_CONTRACTION) {
                return Ok(());
            }
            if iteration == MAX_ITERATIONS || (!chord && iteration > 5 && ratio > 2.0) {
                return Err(StepFailure::NotConverged { iterations: iteration, increment: size });
            }
            chord = chords_contract && damp == 1.0;
            before = size;
        }
        unreachable!("the loop returns at its last iteration")
    }
}

fn not_finite(what: &'static str, x: &[f64]) -> StepFailure {
    StepFailure::NotFinite { what, node: x.iter().position(|x| !x.is_finite()).unwrap_or(0) / 6 }
}

impl Dynamics for Equations<'_> {
    fn size(&self) -> usize {
        6 * self.model.nodes()
    }

    fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for (node, support) in &self.model.supports {
            let range = 6 * node..6 * node + 6;
            support.prescribe(time, &mut q[range.clone()], &mut v[range]);
        }
    }

    fn acceleration(&mut self, time: f64, q: &[f64], _: &[f64], acceleration: &mut [f64]) -> Result<(), StepFailure> {
        let mut rhs = core::mem::take(&mut self.system.rhs);
        self.force(time, q, 1.0, &mut rhs);
        acceleration.fill(0.0);
        let mut moving = false;
        for (node, support) in &self.model.supports {
            let held = support.acceleration(time);
            moving |= held != [0.0; 6];
            acceleration[6 * node..6 * node + 6].copy_from_slice(&held);
        }
        if moving {
            let mut z = core::mem::take(&mut self.system.z);
            self.system.multiply_mass(acceleration, &mut z);
            for (r, m) in rhs.iter_mut().zip(&z) {
                *r -= m;
            }
            self.system.z = z;
        }
        project_vector(self.model, &mut rhs);
        self.diagnostics.mass_solves += 1;
        match &self.system.mass_solver {
            MassSolver::Scalar(factorisation) => factorisation.solve(self.system.level, &mut rhs),
            MassSolver::Block(factorisation) => factorisation.solve(self.system.level, &mut rhs),
        }
        let finite = rhs.iter().all(|x| x.is_finite());
        for (a, r) in acceleration.iter_mut().zip(&rhs) {
            *a += r;
        }
        self.system.rhs = rhs;
        if finite { Ok(()) } else { Err(not_finite("acceleration", acceleration)) }
    }

    fn solve_stage(
        &mut self,
        stage: &Stage,
        base: &mut [f64],
        velocity_base: &mut [f64],
        y: &mut [f64],
        acceleration: &mut [f64],
    ) -> Result<(), StepFailure> {
        for (node, support) in &self.model.supports {
            let range = 6 * node..6 * node + 6;
            support.prescribe(stage.time, &mut base[range.clone()], &mut velocity_base[range.clone()]);
            let held = support.acceleration(stage.time);
            support.project(&mut acceleration[range.clone()]);
            for (i, a) in range.zip(held) {
                base[i] -= stage.c2 * a;
                velocity_base[i] -= stage.rate * stage.c2 * a;
                acceleration[i] += a;
            }
        }
        let mut z = core::mem::take(&mut self.system.z);
        let mut rhs = core::mem::take(&mut self.system.rhs);
        for i in 0..z.len() {
            z[i] = stage.c2 * acceleration[i];
            y[i] = base[i] + z[i];
        }
        let mut product = core::mem::take(&mut self.system.product);
        let outcome = self.newton(stage, base, y, &mut z, &mut rhs, &mut product);
        self.system.product = product;
        for i in 0..z.len() {
            acceleration[i] = z[i] / stage.c2;
        }
        self.system.z = z;
        self.system.rhs = rhs;
        outcome
    }

    fn filter(&mut self, error: &mut [f64]) {
        let mut m = core::mem::take(&mut self.system.z);
        self.system.multiply_mass(error, &mut m);
        error.copy_from_slice(&m);
        self.system.z = m;
        self.solve(error);
    }

    fn norm(&self, error: &[f64]) -> f64 {
        self.system.extent(error).0
    }

    fn frequency_bound(&self) -> f64 {
        self.system.frequency_bound
    }
}
