//! An island as the integrators see it: accelerations, implicit stages, error filter.

use super::rotation::{jacobian_inverse, jacobian_rate};
use super::system::Work;
use super::workspace::vector;
use crate::cable::Rates;
use crate::error::StepFailure;
use crate::integrate::newton::{self, Increment, Linearised};
use crate::integrate::{Dynamics, Stage, State};

/// One stage of an island, as Newton sees it.
struct IslandStage<'a, 'b, 'c> {
    work: &'a mut Work<'b, 'c>,
    stage: &'a Stage,
    base: &'a [f64],
    velocity_base: &'a [f64],
    y: &'a mut [f64],
    v: &'a mut [f64],
    z: &'a mut [f64],
    rhs: &'a mut [f64],
}

impl IslandStage<'_, '_, '_> {
    /// Positions and velocities from z, held ones from their bodies; z of held ones follows.
    fn update(&mut self) {
        for i in 0..self.z.len() {
            self.y[i] = self.base[i] + self.z[i];
            self.v[i] = self.velocity_base[i] + self.stage.dv_dq * self.z[i];
        }
        self.work.follow(self.stage.time, self.y, self.v);
        self.work.follow_acceleration(self.stage.time, self.stage.c2, self.y, self.v, self.z);
    }
}

impl Linearised for IslandStage<'_, '_, '_> {
    fn increment(&mut self, fresh: bool) -> Result<Increment, StepFailure> {
        let IslandStage { work, stage, y, v, z, rhs, .. } = self;
        for cable in work.cables.iter_mut() {
            cable.diagnostics_mut().newton_iterations += 1;
        }
        if fresh {
            work.workspace.factored = 0.0;
        }
        let rates = Rates { v, rate: stage.dv_dq };
        work.cable_rows(stage.time, stage.c2, y, rates, z, rhs, fresh)?;
        if fresh {
            work.factor_bodies(false, y, v, rhs)?;
            work.workspace.factored = stage.c2;
        }
        work.body_rows(stage.c2, y, v, z, rhs);
        work.solve_rows(false, y, rhs);
        let mut size = Increment { displacement: work.norm_of(rhs), rotation: 0.0 };
        for (cable, part) in work.cables.iter().zip(&work.workspace.cables) {
            let (_, slope) = cable.system.extent(&rhs[part.at..part.at + part.size]);
            size.rotation = size.rotation.max(slope);
        }
        for i in 0..work.bodies.len() {
            let at = work.body_at(i);
            size.rotation = size.rotation.max(vector(&rhs[at + 3..]).norm());
        }
        Ok(size)
    }

    fn apply(&mut self, share: f64) {
        for i in 0..self.work.workspace.bodies_at {
            self.z[i] += share * self.rhs[i];
        }
        for body in 0..self.work.bodies.len() {
            let at = self.work.body_at(body);
            let turn = jacobian_inverse(&vector(&self.y[at + 3..])) * vector(&self.rhs[at + 3..]);
            for x in 0..3 {
                self.z[at + x] += share * self.rhs[at + x];
                self.z[at + 3 + x] += share * turn[x];
            }
        }
        self.update();
    }

    fn exact(&self) -> bool {
        self.work.has_exact_tangent()
    }

    fn not_finite(&self) -> StepFailure {
        let node = self.rhs.iter().position(|x| !x.is_finite()).unwrap_or(0) / 6;
        StepFailure::NotFinite { what: "Newton increment", node }
    }
}

impl Work<'_, '_> {
    /// Size in m of a vector of increments, rotations by the lever they move.
    fn norm_of(&self, x: &[f64]) -> f64 {
        let mut worst = 0.0f64;
        let mut take = |size: f64| worst = if size > worst || size.is_nan() { size } else { worst };
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            take(cable.system.extent(&x[part.at..part.at + part.size]).0);
        }
        for (i, lever) in self.workspace.levers.iter().enumerate() {
            let at = self.body_at(i);
            take(vector(&x[at..]).norm());
            take(vector(&x[at + 3..]).norm() * lever);
        }
        worst
    }
}

impl Dynamics for Work<'_, '_> {
    fn size(&self) -> usize {
        self.workspace.bodies_at + 6 * self.bodies.len()
    }

    fn prescribe(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            for (node, support) in &cable.model.supports {
                let range = part.at + 6 * node..part.at + 6 * node + 6;
                support.prescribe(time, &mut q[range.clone()], &mut v[range]);
            }
        }
        for (i, body) in self.workspace.bodies.iter().enumerate() {
            let at = self.body_at(i);
            for x in (0..6).filter(|&x| !body.free[x]) {
                v[at + x] = if x < 3 { body.velocity[x] } else { body.angular_velocity[x - 3] };
            }
        }
        self.follow(time, q, v);
    }

    fn acceleration(&mut self, time: f64, q: &[f64], v: &[f64], k: &mut [f64]) -> Result<(), StepFailure> {
        // accelerations that do not depend on unknown ones: supports, and the centripetal part of pins
        k.fill(0.0);
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            for (node, support) in &cable.model.supports {
                let at = part.at + 6 * node;
                k[at..at + 6].copy_from_slice(&support.acceleration(time));
            }
        }
        for i in 0..self.bodies.len() {
            // zero angular acceleration: theta'' = -J^-1 J' theta'
            let at = self.body_at(i);
            let (theta, rate) = (vector(&q[at + 3..]), vector(&v[at + 3..]));
            let k0 = -(jacobian_inverse(&theta) * (jacobian_rate(&theta, &rate) * rate));
            k[at + 3..at + 6].copy_from_slice(k0.as_slice());
        }
        self.follow_acceleration(time, 1.0, q, v, k);
        self.factor_mass(q, v)?;
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        let rows = self.cable_rows(time, 1.0, q, Rates { v, rate: 0.0 }, k, &mut rhs, false);
        if rows.is_ok() {
            self.body_rows(1.0, q, v, k, &mut rhs);
            self.solve_rows(true, q, &mut rhs);
        }
        for i in 0..self.workspace.bodies_at {
            k[i] += rhs[i];
        }
        for i in 0..self.bodies.len() {
            let at = self.body_at(i);
            let turn = jacobian_inverse(&vector(&q[at + 3..])) * vector(&rhs[at + 3..]);
            for x in 0..3 {
                k[at + x] += rhs[at + x];
                k[at + 3 + x] += turn[x];
            }
        }
        self.workspace.rhs = rhs;
        rows?;
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
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            for (node, support) in &cable.model.supports {
                let at = part.at + 6 * node;
                support.prescribe_stage(
                    stage,
                    &mut base[at..at + 6],
                    &mut velocity_base[at..at + 6],
                    &mut acceleration[at..at + 6],
                );
            }
        }
        for (i, body) in self.workspace.bodies.iter().enumerate() {
            let at = self.workspace.bodies_at + 6 * i;
            for x in (0..6).filter(|&x| !body.free[x]) {
                acceleration[at + x] = 0.0;
            }
        }
        let mut z = core::mem::take(&mut self.workspace.z);
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        let mut velocity = core::mem::take(&mut self.workspace.velocity);
        for i in 0..z.len() {
            z[i] = stage.c2 * acceleration[i];
        }
        let wanted = stage.newton.tolerance();
        let mut tolerance = wanted;
        for c in 0..self.cables.len() {
            let (equations, part) = self.equations(c);
            let range = part.at..part.at + part.size;
            tolerance = tolerance.min(equations.tolerance(wanted, stage, &base[range.clone()], &z[range]));
        }
        let keep = stage.reuse && stage.c2 > 0.0 && self.workspace.factored == stage.c2;
        let mut problem =
            IslandStage { work: self, stage, base, velocity_base, y, v: &mut velocity, z: &mut z, rhs: &mut rhs };
        problem.update();
        let outcome = newton::iterate(&mut problem, tolerance, stage.newton.once(), keep);
        for i in 0..z.len() {
            acceleration[i] = z[i] / stage.c2;
        }
        // the velocities of held coordinates are those of their bodies, not of the integrator's base
        for hold in self.workspace.cables.iter().flat_map(|work| &work.holds) {
            for i in hold.at..hold.at + 3 {
                velocity_base[i] = velocity[i] - stage.dv_dq * z[i];
            }
        }
        self.workspace.z = z;
        self.workspace.rhs = rhs;
        self.workspace.velocity = velocity;
        outcome
    }

    fn filter(&mut self, error: &mut [f64]) {
        let mut rhs = core::mem::take(&mut self.workspace.rhs);
        rhs.fill(0.0);
        for (cable, part) in self.cables.iter().zip(&self.workspace.cables) {
            let range = part.at..part.at + part.size;
            cable.system.multiply_mass(&error[range.clone()], &mut rhs[range]);
        }
        for (i, body) in self.bodies.iter().enumerate() {
            let at = self.body_at(i);
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
        // attitudes at the start of the step are near enough for a filter
        let zero = core::mem::take(&mut self.workspace.zero);
        self.pass_pinned_rows(&zero, &mut rhs);
        self.solve_rows(false, &zero, &mut rhs);
        error.copy_from_slice(&rhs);
        self.workspace.zero = zero;
        self.workspace.rhs = rhs;
    }

    fn norm(&self, error: &[f64]) -> f64 {
        self.norm_of(error)
    }

    fn step_accepted(&mut self, before: &State, after: &State, h: f64) {
        for c in 0..self.cables.len() {
            let (mut equations, part) = self.equations(c);
            let range = part.at..part.at + part.size;
            equations.add_effect_work(before, after, h, range);
        }
    }

    fn spurious_energy(&mut self, before: &State, after: &State, h: f64) -> Option<(f64, f64)> {
        self.energy_between(before, after, h)
    }

    fn newton_iterations(&self) -> u64 {
        self.cables.first().map_or(0, |cable| cable.diagnostics().newton_iterations)
    }

    fn state_reached(&mut self, phase: &State) {
        self.account(phase);
    }

    fn depends_on_velocity(&self) -> bool {
        true
    }

    fn has_exact_tangent(&self) -> bool {
        self.cables.iter().all(|cable| cable.effects().has_exact_tangent())
    }

    fn frequency_bound(&self) -> f64 {
        self.cables.iter().map(|c| c.frequency_bound()).fold(0.0, f64::max)
    }
}
