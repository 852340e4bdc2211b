//! The equations of one cable, `M q'' = F(q, q', t)`, as the integrators see them.
//!
//! A stage `M z = c2 F(base + z, velocity_base + rate z)` is solved with `(M + c2 (K + rate C)) dz = c2 F - M z` by
//! [`newton`](crate::integrate::newton); K = -dF/dq, C = -dF/dq'.

#[cfg(test)]
use super::exact::trial;
use super::kernel_effects::Rates;
use super::model::Model;
use super::projection::{project_matrix, project_vector};
use super::system::{MassSolver, System};
use crate::diagnostics::Diagnostics;
use crate::error::StepFailure;
use crate::integrate::newton::{self, Increment, Linearised};
use crate::integrate::{Dynamics, Stage, State};
use crate::linalg::Definiteness;

/// Newton's tolerance is at most this share of the displacement that the acceleration makes in the stage, and of the strain
/// that it makes in the cable (loosened a hundred times, steel gains energy and shows spurious tension at coarse tolerances).
const RELATIVE_TOLERANCE: f64 = 1e-2;

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

    /// `out = scale F(q, 0, time)`: elastic forces, gravity, loads of a cable at rest. For statics: `time` is that of the point
    /// loads, a flow is that of the cable's own time.
    pub fn force(&mut self, time: f64, q: &[f64], scale: f64, out: &mut [f64]) {
        out.fill(0.0);
        self.system.add_force(self.system.static_time, q, Rates::REST, scale, None, out, self.diagnostics);
        self.count_elements(false);
        self.system.add_loads(self.model, time, q, scale, out, false, self.diagnostics);
    }

    /// [`force`](Self::force), and the step matrix `mass_scale M + scale K`, not yet projected.
    pub fn force_and_matrix(&mut self, time: f64, q: &[f64], scale: f64, mass_scale: f64, out: &mut [f64]) {
        out.fill(0.0);
        self.system.add_force(self.system.static_time, q, Rates::REST, scale, Some(mass_scale), out, self.diagnostics);
        self.count_elements(true);
        self.system.add_loads(self.model, time, q, scale, out, true, self.diagnostics);
    }

    /// `out = scale F(q, v, time)`.
    pub fn moving_force(&mut self, time: f64, q: &[f64], v: &[f64], scale: f64, out: &mut [f64]) {
        out.fill(0.0);
        self.system.add_force(time, q, Rates { v, rate: 0.0 }, scale, None, out, self.diagnostics);
        self.count_elements(false);
        self.system.add_loads(self.model, time, q, scale, out, false, self.diagnostics);
    }

    /// [`moving_force`](Self::moving_force), and the step matrix `mass_scale M + scale (K + rate C)`, not yet projected.
    pub fn moving_force_and_matrix(
        &mut self,
        time: f64,
        q: &[f64],
        rates: Rates<'_>,
        scale: f64,
        mass_scale: f64,
        out: &mut [f64],
    ) {
        out.fill(0.0);
        self.system.add_force(time, q, rates, scale, Some(mass_scale), out, self.diagnostics);
        self.count_elements(true);
        self.system.add_loads(self.model, time, q, scale, out, true, self.diagnostics);
    }

    /// Projects and factors the step matrix, and tells whether it is positive definite.
    pub fn factor(&mut self) -> Result<Definiteness, StepFailure> {
        self.factor_with(true)
    }

    /// Projects and factors the step matrix.
    pub fn factor_to_solve(&mut self) -> Result<(), StepFailure> {
        self.factor_with(false).map(|_| ())
    }

    fn factor_with(&mut self, count: bool) -> Result<Definiteness, StepFailure> {
        project_matrix(self.model, &mut self.system.matrix);
        self.diagnostics.factorisations += 1;
        let (level, system) = (self.system.level, &mut *self.system);
        let kind = if count {
            system.factorisation.factor(level, &system.matrix)?
        } else {
            system.factorisation.factor_to_solve(level, &system.matrix)?
        };
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

    /// `rhs = c2 F(y, v) - M z`; with the matrix if asked.
    fn residual(
        &mut self,
        stage: &Stage,
        y: &[f64],
        v: &[f64],
        z: &[f64],
        rhs: &mut [f64],
        scratch: &mut [f64],
        matrix: bool,
    ) {
        if matrix {
            self.moving_force_and_matrix(stage.time, y, Rates { v, rate: stage.dv_dq }, stage.c2, 1.0, rhs);
        } else {
            self.moving_force(stage.time, y, v, stage.c2, rhs);
        }
        self.system.multiply_mass(z, scratch);
        for (r, m) in rhs.iter_mut().zip(scratch.iter()) {
            *r -= m;
        }
    }

    /// The stage's Newton tolerance in m, at most `tolerance`, for the initial guess `z` and coordinates `base`.
    ///
    /// z = c2 k: in a short step the tolerance must not swallow the acceleration; on a stiff cable a displacement d within the
    /// tolerance may be a large strain d/l, so EA d/l is held below a share of the inertia force rho A L k as well. Below
    /// rounding nothing can be met.
    pub fn tolerance(&self, tolerance: f64, stage: &Stage, base: &[f64], z: &[f64]) -> f64 {
        let scale = self.system.extent(z).0 * (self.system.stiff_time_squared / stage.c2).min(1.0);
        let rounding = 4.0 * f64::EPSILON * base.iter().fold(1.0f64, |m, x| m.max(x.abs()));
        tolerance.min(RELATIVE_TOLERANCE * scale).max(rounding)
    }
}

/// One stage of one cable, as Newton sees it.
struct CableStage<'a, 'b> {
    equations: &'a mut Equations<'b>,
    stage: &'a Stage,
    base: &'a [f64],
    velocity_base: &'a [f64],
    y: &'a mut [f64],
    /// Velocities, if a force depends on them.
    v: &'a mut [f64],
    z: &'a mut [f64],
    rhs: &'a mut [f64],
    product: &'a mut [f64],
}

impl Linearised for CableStage<'_, '_> {
    fn increment(&mut self, fresh: bool) -> Result<Increment, StepFailure> {
        let equations = &mut *self.equations;
        equations.diagnostics.newton_iterations += 1;
        for (i, v) in self.v.iter_mut().enumerate() {
            *v = self.velocity_base[i] + self.stage.dv_dq * self.z[i];
        }
        equations.residual(self.stage, self.y, self.v, self.z, self.rhs, self.product, fresh);
        if fresh {
            equations.system.factored = 0.0;
            equations.factor_to_solve()?;
            equations.system.factored = self.stage.c2;
        }
        #[cfg(test)]
        if trial::on() {
            trial::increment(equations, self.stage, self.y, self.v, self.rhs, fresh);
            let (displacement, slope) = equations.system.extent(self.rhs);
            return Ok(Increment { displacement, rotation: slope });
        }
        equations.solve(self.rhs);
        let (displacement, slope) = equations.system.extent(self.rhs);
        Ok(Increment { displacement, rotation: slope })
    }

    fn apply(&mut self, share: f64) {
        for i in 0..self.z.len() {
            self.z[i] += share * self.rhs[i];
            self.y[i] = self.base[i] + self.z[i];
        }
    }

    fn exact(&self) -> bool {
        #[cfg(test)]
        if trial::on() {
            return true;
        }
        self.equations.model.effects.has_exact_tangent()
    }

    fn not_finite(&self) -> StepFailure {
        not_finite("Newton increment", self.rhs)
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

    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), StepFailure> {
        let mut rhs = core::mem::take(&mut self.system.rhs);
        self.moving_force(time, q, v, 1.0, &mut rhs);
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
            support.prescribe_stage(
                stage,
                &mut base[range.clone()],
                &mut velocity_base[range.clone()],
                &mut acceleration[range],
            );
        }
        let mut z = core::mem::take(&mut self.system.z);
        let mut rhs = core::mem::take(&mut self.system.rhs);
        for i in 0..z.len() {
            z[i] = stage.c2 * acceleration[i];
            y[i] = base[i] + z[i];
        }
        let mut product = core::mem::take(&mut self.system.product);
        let tolerance = self.tolerance(stage.newton.tolerance(), stage, base, &z);
        let keep = stage.reuse && stage.c2 > 0.0 && self.system.factored == stage.c2;
        let mut velocity = core::mem::take(&mut self.system.velocity);
        let mut problem = CableStage {
            equations: self,
            stage,
            base,
            velocity_base,
            y,
            v: &mut velocity,
            z: &mut z,
            rhs: &mut rhs,
            product: &mut product,
        };
        let outcome = newton::iterate(&mut problem, tolerance, stage.newton.once(), keep);
        self.system.product = product;
        self.system.velocity = velocity;
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

    fn depends_on_velocity(&self) -> bool {
        self.model.effects.depends_on_velocity()
    }

    fn has_exact_tangent(&self) -> bool {
        self.model.effects.has_exact_tangent()
    }

    fn step_accepted(&mut self, before: &State, after: &State, h: f64) {
        self.add_effect_work(before, after, h, 0..after.q.len());
    }

    fn spurious_energy(&mut self, before: &State, after: &State, h: f64) -> Option<(f64, f64)> {
        let made = self.energy_between(before, after, h, 0..after.q.len())?;
        Some((made.made, made.before.max(made.after)))
    }

    fn newton_iterations(&self) -> u64 {
        self.diagnostics.newton_iterations
    }

    fn frequency_bound(&self) -> f64 {
        self.system.frequency_bound
    }
}
