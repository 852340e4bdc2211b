//! One evaluation of everything that acts on a cable, `F(q, q', t)`, and the solution with its step
//! matrix.

use super::lanes::MatrixOutput;
use super::{System, project_matrix, project_vector};
use crate::diagnostics::Diagnostics;
use crate::effect::acts::ForceInput;
use crate::error::StepFailure;
use crate::integrate::Stage;
use crate::integrate::discrete_gradient::sum_of_forces;
use crate::linalg::Definiteness;
use crate::model::Model;
use crate::scales::system::RELATIVE_TOLERANCE;
use crate::support::Support;

/// A model with its system and counters.
pub(crate) struct Equations<'a> {
    pub model: &'a Model,
    pub system: &'a mut System,
    pub diagnostics: &'a mut Diagnostics,
}

impl Equations<'_> {
    /// Computes the force of everything into `out`, times the input's factor.
    pub fn force(&mut self, input: ForceInput<'_>, out: &mut [f64]) {
        self.evaluate(input.time, input, out, None);
    }

    /// Computes the force into `out`, and the step matrix `mass_scale M + scale (K + dv/dq C)`, not
    /// yet projected, into the system's: K = -dF/dq, C = -dF/dq'.
    pub fn force_and_matrix(&mut self, input: ForceInput<'_>, mass_scale: f64, out: &mut [f64]) {
        self.evaluate(input.time, input, out, Some(mass_scale));
    }

    /// Computes the force on the cable at rest into `out`; `time` is that of the point loads,
    /// everything else is as at the cable's own time.
    pub fn static_force(&mut self, time: f64, q: &[f64], scale: f64, out: &mut [f64]) {
        self.evaluate(time, self.static_input(q, scale), out, None);
    }

    /// Computes [`static_force`](Self::static_force), and the step matrix `mass_scale M + scale K`.
    pub fn static_force_and_matrix(&mut self, time: f64, q: &[f64], scale: f64, mass_scale: f64, out: &mut [f64]) {
        self.evaluate(time, self.static_input(q, scale), out, Some(mass_scale));
    }

    fn static_input<'a>(&self, q: &'a [f64], scale: f64) -> ForceInput<'a> {
        ForceInput { time: self.system.static_time, q, v: &[], dv_dq: 0.0, scale }
    }

    /// Returns the sum of the impulses that the rows `scale F - M z` of a cable leave unbalanced,
    /// and of those that must balance: of `inertia`, M z, of the weight, and of what holds nodes.
    pub fn unbalanced(&self, scale: f64, rows: &[f64], inertia: &[f64]) -> [f64; 2] {
        let holds = |support: &Support| support.position.is_some() || support.attached;
        let held = self.model.supports.iter().filter(|(_, support)| holds(support));
        let held: f64 = held.map(|(node, _)| sum_of_forces(&rows[6 * node..6 * node + 6])).sum();
        let weight = 1e3 * self.system.scales.weight_energy;
        [sum_of_forces(rows) - held, sum_of_forces(inertia) + held + scale * weight]
    }

    fn evaluate(&mut self, load_time: f64, input: ForceInput<'_>, out: &mut [f64], mass_scale: Option<f64>) {
        out.fill(0.0);
        if input.v.is_empty() {
            // statics know no time, and nothing flows
            self.system.set_feeds_at_start(self.model);
        } else {
            self.system.set_feeds(self.model, input.time);
        }
        let (system, diagnostics) = (&mut *self.system, &mut *self.diagnostics);
        let matrix = &mut system.step.matrix;
        if mass_scale.is_some() {
            // empty outside of steps
            matrix.resize(self.model.nodes());
        }
        let n = self.model.elements.len() as u64;
        let to = mass_scale.map(|mass_scale| MatrixOutput { matrix: &mut *matrix, mass_scale });
        system.forces.add(system.level, system.feeds.velocities(input), out, to, diagnostics);
        match mass_scale {
            None => diagnostics.force_evaluations += n,
            Some(_) => diagnostics.tangent_evaluations += n,
        }
        if system.forces.elements.bends() {
            diagnostics.bending_evaluations += n;
        }
        let loads = ForceInput { time: load_time, ..input };
        system.loads.add(&self.model.loads, loads, out, mass_scale.map(|_| &mut *matrix), diagnostics);
        let (q, scale) = (input.q, input.scale);
        diagnostics.load_evaluations += system.potentials.count();
        system.potentials.add(self.model, (q, scale), out, mass_scale.map(|_| &mut *matrix));
        system.static_contact.add(self.model, (q, scale), out, mass_scale.map(|_| &mut *matrix));
        let to = mass_scale.map(|_| &mut *matrix);
        if let Some(torsion) = &mut system.torsion_forces {
            diagnostics.effects.torsion += torsion.add(self.model, &input, out, to);
        }
        system.feeds.add(self.model, &input, out, mass_scale.map(|_| matrix));
    }

    /// Overwrites prescribed coordinates and velocities by their values at `time`.
    pub fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for (node, support) in &self.model.supports {
            let range = 6 * node..6 * node + 6;
            support.prescribe(time, &mut q[range.clone()], &mut v[range]);
        }
    }

    /// Factors the mass matrix at `time` (s) if it depends on time.
    pub fn begin_acceleration(&mut self, time: f64) -> Result<(), StepFailure> {
        if self.system.feeds.is_empty() {
            return Ok(());
        }
        self.system.set_feeds(self.model, time);
        self.system.factor_mass(self.model)
    }

    /// Projects and factors the step matrix, and returns whether it is positive definite.
    pub fn factor(&mut self) -> Result<Definiteness, StepFailure> {
        self.factor_with(true)
    }

    /// Projects and factors the step matrix.
    pub fn factor_to_solve(&mut self) -> Result<(), StepFailure> {
        self.factor_with(false).map(|_| ())
    }

    fn factor_with(&mut self, count: bool) -> Result<Definiteness, StepFailure> {
        if let Some((what, node)) = self.system.forces.not_finite() {
            return Err(StepFailure::NotFinite { what, node });
        }
        let (level, step) = (self.system.level, &mut self.system.step);
        project_matrix(self.model, &mut step.matrix);
        self.diagnostics.factorisations += 1;
        let kind = if count {
            step.factorisation.factor(level, &step.matrix)?
        } else {
            step.factorisation.factor_to_solve(level, &step.matrix)?
        };
        let kind = self.factor_torsion(kind)?;
        if !matches!(kind, Definiteness::PositiveDefinite) {
            self.diagnostics.indefinite_factorisations += 1;
        }
        Ok(kind)
    }

    /// Solves with the factored step matrix, in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.diagnostics.solves += 1;
        project_vector(self.model, rhs);
        self.system.step.factorisation.solve(self.system.level, rhs);
        self.complete_by_torsion(rhs);
    }

    /// Returns the stage's Newton tolerance in m, at most `tolerance`, for the initial guess `z`
    /// and coordinates `base`.
    ///
    /// z = c2 k: in a short step the tolerance must not hide the acceleration; on a stiff cable a
    /// displacement d within the tolerance may be a large strain d/l, so EA d/l is held below a
    /// share of the inertia force rho A L k as well. No tolerance is below rounding.
    pub fn tolerance(&self, tolerance: f64, stage: &Stage, base: &[f64], z: &[f64]) -> f64 {
        let scales = &self.system.scales;
        let scale = scales.extent(z).0 * (scales.stiff_time_squared / stage.c2).min(1.0);
        let rounding = 4.0 * f64::EPSILON * base.iter().fold(1.0f64, |m, x| m.max(x.abs()));
        tolerance.min(RELATIVE_TOLERANCE * scale).max(rounding)
    }

    /// Returns the failure for a vector over all coordinates that is not finite.
    pub fn not_finite(&self, what: &'static str, x: &[f64]) -> StepFailure {
        let node = x.iter().position(|x| !x.is_finite()).unwrap_or(0) / 6;
        let (what, node) = self.system.forces.not_finite().unwrap_or((what, node));
        StepFailure::NotFinite { what, node }
    }
}
