//! One cable under the [discrete gradient](crate::integrate::discrete_gradient).

use super::lanes::MatrixOutput;
use super::lanes::secant::{CoordinateStep, ElementLoss};
use super::rigid::relative_velocities;
use super::{Equations, System, project_vector};
use crate::cable::Cable;
use crate::effect::EffectWork;
use crate::effect::acts::{ForceInput, PointForce, StepInput, VelocityInput};
use crate::error::StepFailure;
use crate::integrate::State;
use crate::integrate::discrete_gradient::{ALPHA, BETA, Balance, Buffers, Event, SecantSystem};
use crate::support::{SlopeSupport, Support};
use core::ops::Range;

/// Share of the velocities relative to rigid motion that a step may lose by rescaling: that of half of their energy.
const MAX_TAKEN_SHARE: f64 = 0.292_893_218_813_452_5;

/// A cable, its state and the buffers of a step.
pub(crate) struct SecantCable<'a> {
    pub equations: Equations<'a>,
    pub state: &'a mut State,
    pub buffers: &'a mut Buffers,
}

/// The components of a node (r, t) that a support prescribes.
fn prescribed(support: &Support) -> Range<usize> {
    let first = if support.position.is_some() { 0 } else { 3 };
    let last = if matches!(support.slope, SlopeSupport::Prescribed(_)) { 6 } else { 3 };
    first..last
}

pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

impl System {
    /// Returns `x.M x`; `product` is a buffer.
    pub fn mass_square(&self, x: &[f64], product: &mut [f64]) -> f64 {
        self.mass.multiply(self.level, x, product);
        dot(x, product)
    }
}

impl Equations<'_> {
    /// Sets the changes of prescribed coordinates, so that they end where their supports are.
    pub fn prescribe_change(&self, state: &State, b: &mut Buffers) {
        for (node, support) in &self.model.supports {
            let (mut q, mut v) = ([0.0; 6], [0.0; 6]);
            support.prescribe(state.time + b.h, &mut q, &mut v);
            for x in prescribed(support) {
                let i = 6 * node + x;
                b.change[i] = q[x] - state.q[i];
                b.velocity_change[i] = (b.change[i] / b.h - state.v[i] + ALPHA * b.velocity_before[i]) / BETA;
            }
        }
    }

    /// Computes `h (G + F - f) - M D v` of the present iterate into `rhs`, and the step matrix if asked; without it, returns what the elements
    /// lose. `work` is that of effects.
    pub fn secant_residual(
        &mut self,
        state: &State,
        b: &mut Buffers,
        matrix: bool,
        work: &mut EffectWork,
    ) -> ElementLoss {
        let h = b.h;
        let (system, diagnostics) = (&mut *self.system, &mut *self.diagnostics);
        let (level, forces) = (system.level, &mut system.forces);
        let count = forces.elements.count() as u64;
        let in_element = forces.in_element.as_ref();
        b.rhs.fill(0.0);
        let mut rhs = core::mem::take(&mut b.rhs);
        let Buffers { change, change_before: before, linearised, .. } = &*b;
        let step = CoordinateStep { start: &state.q, change, before, linearised, h };
        let mut loss = ElementLoss::default();
        if matrix {
            let to = MatrixOutput { matrix: &mut system.step.matrix, mass_scale: 1.0 };
            forces.elements.add_secant_and_matrix(level, in_element, step, &mut rhs, to);
            diagnostics.tangent_evaluations += count;
        } else {
            loss = forces.elements.add_secant(level, in_element, step, &mut rhs);
            diagnostics.force_evaluations += count;
        }
        if forces.elements.bends() {
            diagnostics.bending_evaluations += count;
        }
        if let Some(effects) = in_element {
            effects.count(count, true, &mut diagnostics.effects);
            effects.add_dissipated(loss.effects, work);
        }
        let at_points = forces.at_points.any() || forces.densities.is_some();
        if at_points || !self.model.loads.is_empty() {
            if matrix {
                // loads and coefficients of drag are those of the present iterate
                b.linearised.clear();
            }
            b.find_means(&state.q);
        }
        let time = state.time + 0.5 * h;
        if at_points {
            let [middle, velocity, middle_before, velocity_before] = &b.means;
            let input = StepInput { time, middle, velocity, middle_before, velocity_before, h };
            let mut to = if matrix { Some(&mut system.step.matrix) } else { None };
            b.external.fill(0.0);
            let (out, force) = (&mut b.external[..], &mut b.product[..]);
            let counts = (count, &mut diagnostics.effects);
            forces.at_points.add_over_step(level, input, (out, force), to.as_deref_mut(), work, counts);
            if let Some(densities) = &mut forces.densities {
                force.fill(0.0);
                densities.add_over_step(level, input, force, to);
                out.iter_mut().zip(force.iter()).for_each(|(out, f)| *out += f);
                work.force_densities += h * dot(force, velocity);
                diagnostics.effects.force_densities += count;
            }
            rhs.iter_mut().zip(&b.external).for_each(|(r, f)| *r += h * f);
        }
        let loads = ForceInput { time, q: &b.means[2], velocity: VelocityInput::REST, scale: h };
        system.loads.add(&self.model.loads, loads, &mut rhs, None, diagnostics);
        system.mass.multiply(level, &b.velocity_change, &mut b.product);
        rhs.iter_mut().zip(&b.product).for_each(|(r, m)| *r -= m);
        b.rhs = rhs;
        loss
    }

    /// Returns what the present iterate does to the energy, but for the product of residual and velocity: `rhs` is the residual of all
    /// coordinates.
    pub fn secant_balance(&mut self, state: &State, b: &mut Buffers, work: &mut EffectWork) -> Balance {
        let loss = self.secant_residual(state, b, false, work);
        let mut balance = Balance { numerical: loss.numerical, effects: loss.effects, ..Balance::default() };
        let system = &*self.system;
        if !self.model.loads.is_empty() {
            let input = ForceInput {
                time: state.time + 0.5 * b.h,
                q: &b.means[2],
                velocity: VelocityInput::REST,
                scale: 1.0,
            };
            b.external.fill(0.0);
            system.loads.add(&self.model.loads, input, &mut b.external, None, self.diagnostics);
            let dead = system.loads.gravity_work(&b.change) + system.loads.effect_work(&b.change);
            balance.loads = dot(&b.external, &b.change) - dead;
        }
        for (node, support) in &self.model.supports {
            for x in prescribed(support) {
                balance.supports -= b.rhs[6 * node + x] * b.change[6 * node + x] / b.h;
            }
        }
        for i in 0..b.external.len() {
            b.external[i] = b.velocity_change[i] - b.velocity_before[i];
        }
        balance.numerical += 0.5 * ALPHA * system.mass_square(&b.external, &mut b.product);
        for i in 0..b.external.len() {
            b.external[i] = state.v[i] + b.velocity_change[i];
        }
        let kinetic = 0.5 * system.mass_square(&b.external, &mut b.product);
        balance.scale = kinetic + loss.strain + system.scales.weight_energy;
        balance
    }

    /// Adds an increment of the velocity change to the iterate, which becomes the one about which it was linearised.
    pub fn apply_increment(b: &mut Buffers, increment: &[f64]) {
        b.linearised.clone_from(&b.change);
        for i in 0..increment.len() {
            b.velocity_change[i] += increment[i];
            b.change[i] += b.h * BETA * increment[i];
        }
    }

    /// Makes the end of the step the state.
    pub fn accept_secant(&mut self, state: &mut State, b: &Buffers) {
        for i in 0..b.change.len() {
            state.q[i] += b.change[i];
            state.v[i] += b.velocity_change[i];
        }
        state.v.iter_mut().zip(&b.taken).for_each(|(v, taken)| *v -= taken);
        state.time += b.h;
        let memory = &mut state.memory;
        memory.differences.velocity.clone_from(&b.velocity_change);
        memory.differences.displacement.clone_from(&b.change);
        memory.differences.step = b.h;
        memory.differences.revision = memory.revision;
    }
}

impl SecantSystem for SecantCable<'_> {
    fn time(&self) -> f64 {
        self.state.time
    }

    fn set_time(&mut self, time: f64) {
        self.state.time = time;
    }

    fn begin(&mut self) {
        let memory = &mut self.state.memory;
        memory.valid = false;
        memory.step = 0.0;
        if memory.differences.is_empty() || memory.differences.revision != memory.revision {
            self.equations.prescribe(self.state.time, &mut self.state.q, &mut self.state.v);
        }
    }

    fn predict(&mut self, h: f64) {
        self.buffers.recall(self.state, h);
        self.equations.prescribe_change(self.state, self.buffers);
    }

    fn iterate(&mut self) -> Result<Balance, StepFailure> {
        let SecantCable { equations, state, buffers: b } = self;
        equations.diagnostics.newton_iterations += 1;
        equations.secant_residual(state, b, true, &mut EffectWork::default());
        equations.factor_to_solve()?;
        let mut increment = core::mem::take(&mut b.rhs);
        equations.solve(&mut increment);
        Equations::apply_increment(b, &increment);
        b.rhs = increment;
        if !b.rhs.iter().all(|x| x.is_finite()) {
            return Err(equations.not_finite("Newton increment", &b.rhs));
        }
        equations.system.meter.work_of_step = EffectWork::default();
        let mut work = EffectWork::default();
        let mut balance = equations.secant_balance(state, b, &mut work);
        equations.system.meter.work_of_step = work;
        project_vector(equations.model, &mut b.rhs);
        balance.residual = -dot(&b.rhs, &b.change) / b.h;
        Ok(balance)
    }

    fn rescale(&mut self, balance: &mut Balance) -> bool {
        let SecantCable { equations, state, buffers } = self;
        // the other buffers are free now
        let Buffers { velocity_change, change, rhs, external, product, taken, linearised, .. } = &mut **buffers;
        for i in 0..change.len() {
            product[i] = state.q[i] + change[i];
            rhs[i] = state.v[i] + velocity_change[i];
        }
        taken.clone_from(rhs);
        relative_velocities(equations.model, equations.system, product, taken, external, linearised);
        let energy = 0.5 * equations.system.mass_square(taken, external);
        let share = share_to_take(energy, dot(rhs, external), balance.excess());
        match share {
            Some(share) => {
                taken.iter_mut().for_each(|x| *x *= share);
                balance.rescaled += balance.excess();
                true
            }
            None => {
                taken.clear();
                false
            }
        }
    }

    fn accept(&mut self, balance: &Balance) {
        self.equations.accept_secant(self.state, self.buffers);
        let meter = &mut self.equations.system.meter;
        meter.work += meter.work_of_step;
        meter.law.add(balance);
    }

    fn count(&mut self, event: Event) {
        match event {
            Event::Rescaled => self.equations.diagnostics.rescaled_steps += 1,
            Event::Split => self.equations.diagnostics.split_steps += 1,
        }
    }
}

/// Returns the smaller share u for which v - u w has less kinetic energy than v by the excess, from `1/2 w.M w` and `v.M w`; `None` if
/// there is none that is small enough.
pub(crate) fn share_to_take(energy: f64, product: f64, excess: f64) -> Option<f64> {
    let root = product * product - 4.0 * energy * excess;
    let share = (product - root.max(0.0).sqrt()) / (2.0 * energy);
    (root >= 0.0 && (0.0..=MAX_TAKEN_SHARE).contains(&share)).then_some(share)
}

impl Cable {
    /// Returns the energy in J that the method `discrete-gradient` holds beyond the mechanical energy: S of the last step. Its law is about
    /// the sum of both.
    pub fn energy_in_store(&self) -> f64 {
        let (q, differences) = (self.positions(), &self.snapshot().state.memory.differences);
        if differences.is_empty() {
            return 0.0;
        }
        let still = vec![0.0; q.len()];
        let mut buffer = still.clone();
        let step =
            CoordinateStep { start: q, change: &still, before: &differences.displacement, linearised: &[], h: 1.0 };
        let elastic = self.system.forces.elements.add_secant(self.system.level, None, step, &mut buffer).numerical;
        elastic + 0.5 * ALPHA * self.system.mass_square(&differences.velocity, &mut buffer)
    }
}
