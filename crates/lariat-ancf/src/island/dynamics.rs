//! The interface of an island to the integrators: accelerations, implicit stages, error filter.

use super::energy_balance;
use super::equations::{IslandEquations, MatrixKind};
use super::hold::{stack, vector};
use super::pin_accounts::PinAccounts;
use super::rotation::{jacobian_inverse, jacobian_rate};
use crate::effect::acts::ForceInput;
use crate::error::StepFailure;
use crate::integrate::newton::{self, Increment, Linearised};
use crate::integrate::{Dynamics, ErrorNorm, Stage};
use crate::state::State;

/// Vectors over all coordinates, reused from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Vectors {
    pub rhs: Vec<f64>,
    pub z: Vec<f64>,
    pub velocity: Vec<f64>,
    pub jump: Vec<f64>,
    /// Always zero.
    zero: Vec<f64>,
}

impl Vectors {
    /// Makes room for `size` coordinates.
    pub fn resize(&mut self, size: usize) {
        for vector in [&mut self.rhs, &mut self.z, &mut self.velocity, &mut self.jump, &mut self.zero] {
            vector.resize(size, 0.0);
        }
    }
}

/// An island during one host step.
pub(super) struct IslandDynamics<'a, 'b> {
    pub equations: IslandEquations<'a, 'b>,
    pub accounts: &'a mut PinAccounts,
    /// Which errors count.
    pub norm: ErrorNorm,
    pub vectors: &'a mut Vectors,
}

/// The nonlinear equations of one stage of an island, for Newton's iteration.
struct IslandStage<'a, 'b, 'c> {
    equations: &'a mut IslandEquations<'b, 'c>,
    stage: &'a Stage,
    base: &'a [f64],
    velocity_base: &'a [f64],
    y: &'a mut [f64],
    v: &'a mut [f64],
    z: &'a mut [f64],
    rhs: &'a mut [f64],
}

impl IslandStage<'_, '_, '_> {
    /// Computes positions and velocities from z, those of held coordinates from their bodies, and z
    /// of held coordinates.
    fn update(&mut self) {
        for i in 0..self.z.len() {
            self.y[i] = self.base[i] + self.z[i];
            self.v[i] = self.velocity_base[i] + self.stage.dv_dq * self.z[i];
        }
        let layout = self.equations.layout;
        layout.follow(self.stage.time, self.y, self.v);
        layout.follow_acceleration(self.stage.time, self.stage.c2, self.y, self.v, self.z);
    }
}

impl Linearised for IslandStage<'_, '_, '_> {
    fn corner_tolerance(&self) -> f64 {
        let slack = self.equations.cables.iter().any(|cable| cable.model.goes_slack());
        if slack { self.stage.newton_tolerance } else { 0.0 }
    }

    fn increment(&mut self, fresh: bool) -> Result<Increment, StepFailure> {
        let IslandStage { equations, stage, y, v, z, rhs, .. } = self;
        for cable in equations.cables.iter_mut() {
            cable.diagnostics_mut().newton_iterations += 1;
        }
        let at = ForceInput { time: stage.time, scale: stage.c2, q: y, v, dv_dq: stage.dv_dq };
        if fresh {
            equations.matrices.factored = 0.0;
            equations.cable_rows_and_matrices(&at, z, rhs)?;
            equations.factor_bodies(MatrixKind::Step, stage.c2, y, v, rhs)?;
            equations.matrices.factored = stage.c2;
        } else {
            equations.cable_rows(&at, z, rhs);
        }
        equations.layout.body_rows(stage.c2, y, v, z, rhs);
        let imbalance = equations.imbalance(stage.c2, rhs);
        equations.solve(MatrixKind::Step, y, rhs);
        let mut size = Increment { displacement: equations.norm(rhs), rotation: 0.0, imbalance };
        for (cable, part) in equations.parts() {
            let (_, slope) = cable.system.scales.extent(&rhs[part.range()]);
            size.rotation = size.rotation.max(slope);
        }
        for i in 0..equations.layout.bodies.len() {
            let at = equations.layout.body_at(i);
            size.rotation = size.rotation.max(vector(&rhs[at + 3..]).norm());
        }
        Ok(size)
    }

    fn apply(&mut self, share: f64) {
        let layout = self.equations.layout;
        for i in 0..layout.bodies_at {
            self.z[i] += share * self.rhs[i];
        }
        for body in 0..layout.bodies.len() {
            let at = layout.body_at(body);
            let rotation = jacobian_inverse(&vector(&self.y[at + 3..])) * vector(&self.rhs[at + 3..]);
            for x in 0..3 {
                self.z[at + x] += share * self.rhs[at + x];
                self.z[at + 3 + x] += share * rotation[x];
            }
        }
        self.update();
    }

    fn exact(&self) -> bool {
        has_exact_tangent(self.equations)
    }

    fn not_finite(&self) -> StepFailure {
        let node = self.rhs.iter().position(|x| !x.is_finite()).unwrap_or(0) / 6;
        StepFailure::NotFinite { what: "Newton increment", node }
    }
}

fn has_exact_tangent(equations: &IslandEquations<'_, '_>) -> bool {
    equations.cables.iter().all(|cable| cable.model.has_exact_tangent())
}

impl Dynamics for IslandDynamics<'_, '_> {
    fn size(&self) -> usize {
        self.equations.layout.size()
    }

    fn place(&mut self, state: &mut State) {
        let time = state.time;
        for (cable, part) in self.equations.cables.iter_mut().zip(&self.equations.layout.parts) {
            let (q, v) = (&mut state.q[part.range()], &mut state.v[part.range()]);
            cable.equations().0.place_supports(time, q, v);
        }
        self.prescribe(time, &mut state.q, &mut state.v);
    }

    fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for (cable, part) in self.equations.parts() {
            for (node, support) in &cable.model.supports {
                let range = part.at + 6 * node..part.at + 6 * node + 6;
                support.prescribe(time, &mut q[range.clone()], &mut v[range]);
            }
        }
        let layout = self.equations.layout;
        for (i, body) in layout.bodies.iter().enumerate() {
            let at = layout.body_at(i);
            for x in (0..6).filter(|&x| !body.free[x]) {
                v[at + x] = if x < 3 { body.velocity[x] } else { body.angular_velocity[x - 3] };
            }
        }
        layout.follow(time, q, v);
    }

    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], k: &mut [f64]) -> Result<(), StepFailure> {
        let Self { equations, vectors, .. } = self;
        let (layout, rhs) = (equations.layout, &mut vectors.rhs);
        // accelerations that do not depend on unknown ones: supports, and the centripetal terms of
        // pins
        k.fill(0.0);
        for (cable, part) in equations.parts() {
            for (node, support) in &cable.model.supports {
                let at = part.at + 6 * node;
                k[at..at + 6].copy_from_slice(&support.acceleration(time));
            }
        }
        for i in 0..layout.bodies.len() {
            // zero angular acceleration: theta'' = -J^-1 J' theta'
            let at = layout.body_at(i);
            let (theta, rate) = (vector(&q[at + 3..]), vector(&v[at + 3..]));
            let k0 = -(jacobian_inverse(&theta) * (jacobian_rate(&theta, &rate) * rate));
            k[at + 3..at + 6].copy_from_slice(k0.as_slice());
        }
        layout.follow_acceleration(time, 1.0, q, v, k);
        for cable in equations.cables.iter_mut() {
            cable.equations().0.begin_acceleration(time)?;
        }
        equations.factor_mass(q, v)?;
        equations.cable_rows(&ForceInput { time, scale: 1.0, q, v, dv_dq: 0.0 }, k, rhs);
        layout.body_rows(1.0, q, v, k, rhs);
        equations.solve(MatrixKind::Mass, q, rhs);
        for i in 0..layout.bodies_at {
            k[i] += rhs[i];
        }
        for i in 0..layout.bodies.len() {
            let at = layout.body_at(i);
            let rotation = jacobian_inverse(&vector(&q[at + 3..])) * vector(&rhs[at + 3..]);
            for x in 0..3 {
                k[at + x] += rhs[at + x];
                k[at + 3 + x] += rotation[x];
            }
        }
        match k.iter().position(|x| !x.is_finite()) {
            None => Ok(()),
            Some(i) => Err(StepFailure::NotFinite { what: "acceleration", node: i / 6 }),
        }
    }

    fn solve_stage(
        &mut self,
        stage: &Stage,
        base: &mut [f64],
        velocity_base: &mut [f64],
        y: &mut [f64],
        acceleration: &mut [f64],
    ) -> Result<(), StepFailure> {
        let Self { equations, vectors, .. } = self;
        let layout = equations.layout;
        let Vectors { rhs, z, velocity, .. } = &mut **vectors;
        for (cable, part) in equations.parts() {
            for (node, support) in &cable.model.supports {
                let range = part.at + 6 * node..part.at + 6 * node + 6;
                support.prescribe_stage(
                    stage,
                    &mut base[range.clone()],
                    &mut velocity_base[range.clone()],
                    &mut acceleration[range],
                );
            }
        }
        for (i, body) in layout.bodies.iter().enumerate() {
            let at = layout.body_at(i);
            for x in (0..6).filter(|&x| !body.free[x]) {
                acceleration[at + x] = 0.0;
            }
        }
        for i in 0..z.len() {
            z[i] = stage.c2 * acceleration[i];
        }
        let wanted = stage.newton_tolerance;
        let mut tolerance = wanted;
        for (cable, part) in equations.cables.iter_mut().zip(&layout.parts) {
            let of_cable = cable.equations().0.tolerance(wanted, stage, &base[part.range()], &z[part.range()]);
            tolerance = tolerance.min(of_cable);
        }
        let keep = stage.reuse && stage.c2 > 0.0 && equations.matrices.factored == stage.c2;
        let mut problem = IslandStage { equations, stage, base, velocity_base, y, v: velocity, z, rhs };
        problem.update();
        let outcome = newton::iterate(&mut problem, tolerance, keep);
        for i in 0..z.len() {
            acceleration[i] = z[i] / stage.c2;
        }
        // the velocities of held coordinates are those of their bodies, not of the integrator's
        // base
        for hold in layout.holds() {
            for i in hold.at..hold.at + 3 {
                velocity_base[i] = velocity[i] - stage.dv_dq * z[i];
            }
        }
        outcome
    }

    fn filter(&mut self, error: &mut [f64]) {
        let Self { equations, vectors, .. } = self;
        let layout = equations.layout;
        let Vectors { rhs, zero, .. } = &mut **vectors;
        rhs.fill(0.0);
        equations.multiply_mass(error, rhs);
        for (i, body) in layout.bodies.iter().enumerate() {
            let at = layout.body_at(i);
            let spin = body.world_inertia(&body.rotation) * vector(&error[at + 3..]);
            for x in 0..3 {
                rhs[at + x] = body.mass * error[at + x];
                rhs[at + 3 + x] = spin[x];
            }
            if let Some((momentum, spin)) = body.carried_momentum(&vector(&error[at..]), &vector(&error[at + 3..])) {
                for x in 0..3 {
                    rhs[at + x] += momentum[x];
                    rhs[at + 3 + x] += spin[x];
                }
            }
        }
        let of_body = |i: usize| {
            let at = layout.body_at(i);
            stack(&vector(&error[at..]), &vector(&error[at + 3..]))
        };
        layout.add_coupled_momenta(1.0, of_body, rhs);
        // the attitudes at the start of the step are accurate enough for a filter
        layout.pass_pinned_rows(zero, rhs);
        equations.solve(MatrixKind::Step, zero, rhs);
        error.copy_from_slice(rhs);
    }

    fn norm(&self, error: &[f64]) -> f64 {
        match self.norm {
            ErrorNorm::Bodies => self.equations.norm_of_bodies(error).unwrap_or_else(|| self.equations.norm(error)),
            ErrorNorm::Every | ErrorNorm::Motion => self.equations.norm(error),
        }
    }

    fn step_accepted(&mut self, before: &State, after: &mut State, h: f64) {
        for (cable, part) in self.equations.cables.iter_mut().zip(&self.equations.layout.parts) {
            cable.equations().0.add_work(before, after, h, part.range(), &part.driven);
        }
    }

    fn spurious_energy(&mut self, before: &State, after: &State, h: f64) -> Option<(f64, f64)> {
        energy_balance::spurious_energy(&mut self.equations, before, after, h, &mut self.vectors.rhs)
    }

    fn state_reached(&mut self, state: &State) {
        self.accounts.integrate_to(&mut self.equations, state, &mut self.vectors.rhs);
        for (cable, part) in self.equations.cables.iter_mut().zip(&self.equations.layout.parts) {
            let part = [&state.q[part.range()], &state.v[part.range()]];
            // no method of these islands carries torsion
            cable.equations().0.note_load(state.time, part, &None);
        }
    }

    fn is_isolated(&self) -> bool {
        false
    }

    fn newton_iterations(&self) -> u64 {
        self.equations.cables[0].diagnostics().newton_iterations
    }

    fn depends_on_velocity(&self) -> bool {
        true
    }

    fn has_exact_tangent(&self) -> bool {
        has_exact_tangent(&self.equations)
    }

    fn frequency_bound(&self) -> f64 {
        self.equations.cables.iter().map(|c| c.frequency_bound()).fold(0.0, f64::max)
    }
}
