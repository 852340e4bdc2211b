//! The equations of one cable, `M q'' = F(q, q', t)`, as the integrators see them.
//!
//! # Equation
//!
//! A stage `M z = c2 F(base + z, velocity_base + rate z)` is solved with `(M + c2 (K + rate C)) dz
//! = c2 F - M z` by [`newton`](crate::integrate::newton); K = -dF/dq, C = -dF/dq'.

use super::rigid_motion::relative_velocities;
use super::vectors::dot;
use super::{Buffers, Equations, project_vector};
use crate::effect::acts::ForceInput;
use crate::error::StepFailure;
use crate::integrate::discrete_gradient::share_to_take;
use crate::integrate::newton::{self, Increment, Linearised};
use crate::integrate::{Dynamics, Stage};
use crate::state::State;
use crate::support::Support;

/// The equations of a cable with the buffers that a step needs.
pub(crate) struct CableDynamics<'a> {
    pub equations: Equations<'a>,
    pub buffers: &'a mut Buffers,
}

/// One stage of one cable, as Newton's iteration sees it.
struct CableStage<'a, 'b> {
    equations: &'a mut Equations<'b>,
    buffers: &'a mut Buffers,
    stage: &'a Stage,
    base: &'a [f64],
    velocity_base: &'a [f64],
    y: &'a mut [f64],
}

impl Linearised for CableStage<'_, '_> {
    fn corner_tolerance(&self) -> f64 {
        if self.equations.model.goes_slack() { self.stage.newton_tolerance } else { 0.0 }
    }

    fn increment(&mut self, fresh: bool) -> Result<Increment, StepFailure> {
        let CableStage { equations, stage, y, velocity_base, .. } = self;
        let Buffers { rhs, product, z, velocity, .. } = &mut *self.buffers;
        equations.diagnostics.newton_iterations += 1;
        for (i, v) in velocity.iter_mut().enumerate() {
            *v = velocity_base[i] + stage.dv_dq * z[i];
        }
        // c2 F - M z, and the matrix
        let input = ForceInput { time: stage.time, q: y, v: velocity, dv_dq: stage.dv_dq, scale: stage.c2 };
        if fresh {
            equations.force_and_matrix(input, 1.0, rhs);
        } else {
            equations.force(input, rhs);
        }
        equations.system.mass.multiply(equations.system.level, z, product);
        for (r, m) in rhs.iter_mut().zip(product.iter()) {
            *r -= m;
        }
        if fresh {
            equations.system.step.factored = 0.0;
            equations.factor_to_solve()?;
            equations.system.step.factored = stage.c2;
        }
        let mut imbalance = 0.0;
        if equations.model.depends_on_velocity() {
            let [unbalanced, impulse] = equations.unbalanced(stage.c2, rhs, product);
            imbalance = unbalanced / impulse;
        }
        equations.solve(rhs);
        let (displacement, slope) = equations.system.scales.extent(rhs);
        Ok(Increment { displacement, rotation: slope, imbalance })
    }

    fn apply(&mut self, share: f64) {
        let Buffers { rhs, z, .. } = &mut *self.buffers;
        for i in 0..z.len() {
            z[i] += share * rhs[i];
            self.y[i] = self.base[i] + z[i];
        }
    }

    fn exact(&self) -> bool {
        self.equations.model.has_exact_tangent()
    }

    fn not_finite(&self) -> StepFailure {
        self.equations.not_finite("Newton increment", &self.buffers.rhs)
    }
}

impl Dynamics for CableDynamics<'_> {
    fn size(&self) -> usize {
        6 * self.equations.model.nodes()
    }

    fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        self.equations.prescribe(time, q, v);
    }

    fn place(&mut self, state: &mut State) {
        self.equations.place_supports(state.time, &mut state.q, &mut state.v);
        self.equations.accept_torsion(state);
    }

    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), StepFailure> {
        let CableDynamics { equations, buffers: Buffers { rhs, z, .. } } = self;
        equations.begin_acceleration(time)?;
        equations.force(ForceInput { time, q, v, dv_dq: 0.0, scale: 1.0 }, rhs);
        let (level, mass) = (equations.system.level, &equations.system.mass);
        let held = |support: &Support| support.acceleration(time);
        let moving = equations.model.supports.iter().any(|(_, support)| held(support) != [0.0; 6]);
        if moving {
            acceleration.fill(0.0);
            for (node, support) in &equations.model.supports {
                acceleration[6 * node..6 * node + 6].copy_from_slice(&held(support));
            }
            mass.multiply(level, acceleration, z);
            for (r, m) in rhs.iter_mut().zip(z.iter()) {
                *r -= m;
            }
        }
        project_vector(equations.model, rhs);
        equations.diagnostics.mass_solves += 1;
        mass.solve(level, rhs);
        let finite = rhs.iter().fold(true, |finite, x| finite & x.is_finite());
        if moving {
            acceleration.iter_mut().zip(rhs.iter()).for_each(|(a, r)| *a += r);
        } else {
            acceleration.copy_from_slice(rhs);
        }
        if finite { Ok(()) } else { Err(equations.not_finite("acceleration", acceleration)) }
    }

    fn solve_stage(
        &mut self,
        stage: &Stage,
        base: &mut [f64],
        velocity_base: &mut [f64],
        y: &mut [f64],
        acceleration: &mut [f64],
    ) -> Result<(), StepFailure> {
        let CableDynamics { equations, buffers } = self;
        for (node, support) in &equations.model.supports {
            let range = 6 * node..6 * node + 6;
            support.prescribe_stage(
                stage,
                &mut base[range.clone()],
                &mut velocity_base[range.clone()],
                &mut acceleration[range],
            );
        }
        let z = &mut buffers.z;
        for i in 0..z.len() {
            z[i] = stage.c2 * acceleration[i];
            y[i] = base[i] + z[i];
        }
        let tolerance = equations.tolerance(stage.newton_tolerance, stage, base, z);
        let keep = stage.reuse && stage.c2 > 0.0 && equations.system.step.factored == stage.c2;
        let mut problem = CableStage { equations, buffers, stage, base, velocity_base, y };
        let outcome = newton::iterate(&mut problem, tolerance, keep);
        for (k, z) in acceleration.iter_mut().zip(&buffers.z) {
            *k = z / stage.c2;
        }
        outcome
    }

    fn filter(&mut self, error: &mut [f64]) {
        let CableDynamics { equations, buffers: Buffers { z, .. } } = self;
        equations.system.mass.multiply(equations.system.level, error, z);
        error.copy_from_slice(z);
        equations.solve(error);
    }

    fn norm(&self, error: &[f64]) -> f64 {
        self.equations.system.scales.extent(error).0
    }

    fn newton_iterations(&self) -> u64 {
        self.equations.diagnostics.newton_iterations
    }

    fn depends_on_velocity(&self) -> bool {
        self.equations.model.depends_on_velocity()
    }

    fn has_exact_tangent(&self) -> bool {
        self.equations.model.has_exact_tangent()
    }

    fn step_accepted(&mut self, before: &State, after: &mut State, h: f64) {
        self.equations.add_work(before, after, h, 0..after.q.len(), &[]);
        self.equations.accept_torsion(after);
    }

    fn state_reached(&mut self, state: &State) {
        self.equations.note_load(state.time, [&state.q, &state.v], &state.memory.torsion);
    }

    fn spurious_energy(&mut self, before: &State, after: &State, h: f64) -> Option<(f64, f64)> {
        let change = self.equations.energy_between(before, after, h, 0..after.q.len())?;
        Some((change.spurious, change.before.max(change.after)))
    }

    fn take_energy(&mut self, state: &mut State, energy: f64, largest: f64) -> f64 {
        let CableDynamics { equations, buffers: Buffers { rhs: w, product, z, .. } } = self;
        w.copy_from_slice(&state.v);
        if equations.model.supports.is_empty() {
            relative_velocities(equations.model, equations.system, &state.q, w, product, z);
        }
        for (node, support) in &equations.model.supports {
            support.project(&mut w[6 * node..6 * node + 6]);
        }
        let own = 0.5 * equations.system.mass_square(w, product);
        let all = dot(&state.v, product);
        let reach = (largest / equations.system.scales.extent(w).0).min(1.0);
        let share = share_to_take(own, all, energy, reach).unwrap_or(reach);
        // a cable at rest has none to take
        if !(own > 0.0 && share > 0.0) {
            return 0.0;
        }
        state.v.iter_mut().zip(w.iter()).for_each(|(v, w)| *v -= share * w);
        let taken = share * (all - share * own);
        equations.system.meter.law.rescaled += taken;
        taken
    }

    fn frequency_bound(&self) -> f64 {
        let Equations { model, system, .. } = &self.equations;
        let of_torsion = system.torsion_forces.as_ref().map_or(0.0, |torsion| torsion.frequency_square(model));
        system.scales.frequency_bound.hypot(of_torsion.sqrt())
    }
}
