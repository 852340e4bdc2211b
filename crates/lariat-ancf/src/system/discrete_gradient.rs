//! One cable under the [discrete gradient](crate::integrate::discrete_gradient).

use super::angular::outside_impulses;
use super::lanes::MatrixOutput;
use super::lanes::discrete_gradient::{CoordinateStep, ElementLoss};
use super::vectors::dot;
use super::{Equations, System};
use crate::effect::EffectWork;
use crate::effect::acts::{ForceInput, PointForce, StepInput};
use crate::integrate::discrete_gradient::sum_of_forces;
use crate::scales::LEAST_HEIGHT;
use crate::state::State;
use crate::support::{SlopeSupport, Support};
use crate::system::StepVectors;
use crate::term::{Account, Balance};
use core::ops::Range;

/// A cable, its state and the buffers of a step.
pub(crate) struct CableStep<'a> {
    pub equations: Equations<'a>,
    pub state: &'a mut State,
    pub buffers: &'a mut StepVectors,
}

/// Returns the components of a node (r, t) that a support prescribes.
fn prescribed(support: &Support) -> Range<usize> {
    let first = if support.position.is_some() { 0 } else { 3 };
    let last = if matches!(support.slope, SlopeSupport::Prescribed(_)) { 6 } else { 3 };
    first..last
}

impl System {
    /// Returns `x.M x`; `product` is a buffer.
    pub fn mass_square(&self, x: &[f64], product: &mut [f64]) -> f64 {
        self.mass.multiply(self.level, x, product);
        dot(x, product)
    }
}

impl Equations<'_> {
    /// Begins a host step: puts prescribed coordinates in place if supports or the state were
    /// changed.
    pub fn begin_host_step(&self, state: &mut State) {
        let memory = &mut state.memory;
        memory.valid = false;
        if memory.differences.is_empty() || memory.differences.revision != memory.revision {
            self.prescribe(state.time, &mut state.q, &mut state.v);
            // steps begin with the last changes: what is across a clamp that was turned would stay
            let memory = &mut state.memory.differences;
            for changes in [&mut memory.velocity, &mut memory.displacement].into_iter().filter(|x| !x.is_empty()) {
                for (node, support) in &self.model.supports {
                    support.keep_direction(&mut changes[6 * node + 3..6 * node + 6]);
                }
            }
        }
    }

    /// Returns the coordinates that supports prescribe, with their values at a time.
    fn prescribed_at(&self, time: f64) -> impl Iterator<Item = (usize, f64)> {
        self.model.supports.iter().flat_map(move |(node, support)| {
            let (mut q, mut v) = ([0.0; 6], [0.0; 6]);
            support.prescribe(time, &mut q, &mut v);
            prescribed(support).map(move |x| (6 * node + x, q[x]))
        })
    }

    /// Sets the changes of prescribed coordinates, so that they end where their supports are.
    pub fn prescribe_change(&self, state: &State, b: &mut StepVectors) {
        for (i, end) in self.prescribed_at(state.time + b.h) {
            b.change[i] = end - state.q[i];
            b.velocity_change[i] = (b.change[i] / b.h - state.v[i] + b.leg.a * b.velocity_before[i]) / b.leg.b;
        }
    }

    /// Computes `h (G + F - f) - M D v` of the present iterate into `rhs`, and the step matrix if
    /// asked. Without it, returns what the elements lose, and adds the work of effects to `work`.
    pub fn step_residual(
        &mut self,
        state: &State,
        b: &mut StepVectors,
        matrix: bool,
        work: &mut EffectWork,
    ) -> ElementLoss {
        let eyes = self.begin_feed_step(state, b);
        let loss = self.step_elements(state, b, matrix);
        self.end_feed_step(state, b, eyes);
        self.external_forces(state, b, matrix, work);
        let (system, to) = (&mut *self.system, matrix);
        let to = to.then_some(&mut system.step.matrix);
        self.diagnostics.load_evaluations += system.potentials.count();
        system.potentials.add_over_step(self.model, &state.q, b, to);
        if !matrix && b.outside.is_some() {
            b.outside = Some(outside_impulses(&state.q, b));
        }
        self.add_feeds_over_step(state, b, matrix);
        if let Some(effects) = &self.system.forces.in_element {
            effects.add_dissipated(loss.effects, work);
        }
        let StepVectors { h, velocity_change, rhs, external, product, .. } = b;
        self.system.mass.multiply(self.system.level, velocity_change, product);
        let others = external.iter().zip(&*product);
        rhs.iter_mut().zip(others).for_each(|(rhs, (force, momentum))| *rhs += *h * force - momentum);
        rhs.iter_mut().zip(&b.pair_impulses).for_each(|(rhs, impulse)| *rhs += impulse);
        if !matrix {
            rhs.iter_mut().zip(&b.term_impulses).for_each(|(rhs, impulse)| *rhs += impulse);
        }
        if matrix && !b.contact.is_empty() {
            self.diagnostics.effects.contact += b.contact.count();
            b.contact.linearise(&b.change, &mut b.rhs, &mut self.system.step.matrix);
        }
        loss
    }

    /// Computes the part of the elements.
    fn step_elements(&mut self, state: &State, b: &mut StepVectors, matrix: bool) -> ElementLoss {
        let (system, diagnostics) = (&mut *self.system, &mut *self.diagnostics);
        let (level, forces) = (system.level, &mut system.forces);
        let (elements, effects) = (&forces.elements, forces.in_element.as_ref());
        let count = elements.count() as u64;
        let across = b.divided || !(b.contact.is_empty() && b.pair_impulses.is_empty());
        let StepVectors { h, leg, change, change_before, kept, linearised, rhs, .. } = b;
        let step = CoordinateStep {
            start: &state.q,
            change,
            before: change_before,
            kept: *kept,
            linearised,
            h: *h,
            leg: *leg,
            across,
        };
        rhs.fill(0.0);
        if elements.bends() {
            diagnostics.bending_evaluations += count;
        }
        if let Some(effects) = effects {
            effects.count(count, true, &mut diagnostics.effects);
        }
        if matrix {
            diagnostics.tangent_evaluations += count;
            let to = MatrixOutput { matrix: &mut system.step.matrix, mass_scale: 1.0 };
            elements.add_discrete_gradient_and_matrix(level, effects, step, rhs, to);
            ElementLoss::default()
        } else {
            diagnostics.force_evaluations += count;
            elements.add_discrete_gradient(level, effects, step, rhs)
        }
    }

    /// Computes the forces of everything else, G + F, into `external`. Loads and the coefficients
    /// of drag are those of the iterate about which the step is linear: the present one if the
    /// matrix is asked for.
    fn external_forces(&mut self, state: &State, b: &mut StepVectors, matrix: bool, work: &mut EffectWork) {
        let (system, diagnostics) = (&mut *self.system, &mut *self.diagnostics);
        let (level, forces) = (system.level, &mut system.forces);
        let count = forces.elements.count() as u64;
        let at_points = forces.act_at_points();
        let lines_feed = !system.feeds.is_empty() && self.model.effects.line_loads.is_some();
        if at_points || lines_feed || !self.model.loads.is_empty() {
            if matrix {
                b.linearised.clear();
            }
            b.find_means(&state.q);
            system.feeds.add_drift_over_step(state, b, matrix);
        }
        if lines_feed {
            let lines = &system.loads.of_effects.line_loads;
            work.line_loads += dot(lines, &b.change) + system.feeds.work_on_lengths(state, b, lines);
        }
        let time = state.time + 0.5 * b.h;
        let [middle, velocity, middle_before, velocity_before] = &b.means;
        let (external, force) = (&mut b.external[..], &mut b.product[..]);
        external.fill(0.0);
        if at_points {
            let input = StepInput { time, middle, velocity, middle_before, velocity_before, h: b.h, leg: b.leg };
            let mut to = if matrix { Some(&mut system.step.matrix) } else { None };
            let counts = (count, &mut diagnostics.effects);
            forces.at_points.add_over_step(level, input, (external, force), to.as_deref_mut(), work, counts);
            if let Some(densities) = &mut forces.densities {
                force.fill(0.0);
                densities.add_over_step(level, input, force, to);
                external.iter_mut().zip(force.iter()).for_each(|(out, f)| *out += f);
                work.force_densities += b.h * dot(force, velocity);
                diagnostics.effects.force_densities += count;
            }
        }
        let loads = ForceInput { time, q: middle_before, v: &[], dv_dq: 0.0, scale: 1.0 };
        if at_points {
            system.feeds.note_point_forces((state.time, b.h), middle, external);
        }
        if self.model.loads.is_empty() {
            return system.loads.add(&self.model.loads, loads, external, None, diagnostics);
        }
        let before = dot(external, &b.change);
        system.loads.add(&self.model.loads, loads, external, None, diagnostics);
        let dead = system.loads.gravity_work(&b.change) + system.loads.effect_work(&b.change);
        b.load_work = dot(external, &b.change) - before - dead;
    }

    /// Returns what the present iterate does to the energy, but for the product of residual and
    /// velocity: `rhs` is then the residual of all coordinates.
    pub fn step_balance(&mut self, state: &State, b: &mut StepVectors, work: &mut EffectWork) -> Balance {
        let loss = self.step_residual(state, b, false, work);
        (b.lost, b.damped) = (0.0, loss.effects);
        let mut balance = Balance { numerical: loss.numerical, ..Balance::default() };
        balance.to(Account::Elements).loss = loss.effects;
        let StepVectors { h, external, product, .. } = &*b;
        balance.impulse = sum_of_forces(product) + *h * sum_of_forces(external);
        if !self.model.loads.is_empty() {
            balance.to(Account::Loads).work = b.load_work;
        }
        if !b.contact.is_empty() {
            self.balance_contacts(state, b, &mut balance, work);
        }
        self.balance_motors(state, b, &mut balance);
        let system = &*self.system;
        let StepVectors { h, leg, velocity_before, velocity_change, change, rhs, external, product, .. } = b;
        for (node, support) in &self.model.supports {
            if support.position.is_some() {
                balance.impulse += sum_of_forces(&rhs[6 * node..6 * node + 6]);
            }
            for x in prescribed(support) {
                balance.to(Account::Supports).work -= rhs[6 * node + x] * change[6 * node + x] / *h;
            }
        }
        // the forces are used up
        let changes = velocity_change.iter().zip(&*velocity_before);
        external.iter_mut().zip(changes).for_each(|(out, (now, before))| *out = now - before);
        balance.numerical += 0.5 * leg.a * system.mass_square(external, product);
        let kinetic = 0.5 * system.mass_square(&state.v, product);
        balance.held += kinetic + loss.strain + system.scales.weight_energy;
        balance.weight = system.scales.weight_energy;
        balance.of_gravity = balance.weight / LEAST_HEIGHT * *h;
        balance
    }

    /// Adds a share of the increment of the velocity change in `rhs` to the iterate, which becomes
    /// the one about which it was linearised.
    pub fn apply_increment(b: &mut StepVectors, share: f64) {
        b.linearised.clone_from(&b.change);
        let StepVectors { rhs, velocity_change, change, h, leg, .. } = b;
        let (rhs, moved) = (&*rhs, *h * leg.b);
        velocity_change.iter_mut().zip(rhs).for_each(|(change, increment)| *change += share * increment);
        change.iter_mut().zip(rhs).for_each(|(change, increment)| *change += moved * (share * increment));
    }

    /// Computes coordinates and velocities of the end of the step of a cable whose ends are fixed
    /// to its material, to the bit as [`accept_step`](Self::accept_step) leaves them.
    pub fn end_of_step(&self, state: &State, b: &StepVectors, [q, v]: &mut [Vec<f64>; 2]) {
        q.clear();
        q.extend(state.q.iter().zip(&b.change).map(|(q, change)| q + change));
        v.clear();
        v.extend(state.v.iter().zip(&b.velocity_change).map(|(v, change)| v + change));
        v.iter_mut().zip(&b.taken).for_each(|(v, taken)| *v -= taken);
        v.iter_mut().zip(&b.landed).for_each(|(v, landed)| *v -= landed);
        for (i, end) in self.prescribed_at(state.time + b.h) {
            q[i] = end;
        }
    }

    /// Makes the end of the step the state.
    pub fn accept_step(&mut self, state: &mut State, b: &StepVectors) {
        self.end_feeds_of_step(state, b);
        state.q.iter_mut().zip(&b.change).for_each(|(q, change)| *q += change);
        state.v.iter_mut().zip(&b.velocity_change).for_each(|(v, change)| *v += change);
        state.v.iter_mut().zip(&b.taken).for_each(|(v, taken)| *v -= taken);
        state.v.iter_mut().zip(&b.landed).for_each(|(v, landed)| *v -= landed);
        state.time += b.h;
        // the sum above misses them by rounding: a cable between bodies at rest would never be
        // still
        for (i, end) in self.prescribed_at(state.time) {
            state.q[i] = end;
        }
        let memory = &mut state.memory;
        b.contact.remember(&mut memory.contacts);
        memory.lost = (b.lost / b.h).max(0.0);
        memory.damped = (b.damped / b.h).max(0.0);
        memory.differences.velocity.clone_from(&b.velocity_change);
        memory.differences.velocity.iter_mut().zip(&b.landed).for_each(|(change, landed)| *change -= landed);
        memory.differences.displacement.clone_from(&b.change);
        memory.differences.step = b.h;
        memory.differences.dissipation = b.leg.a;
        memory.differences.revision = memory.revision;
        let meter = &mut self.system.meter;
        meter.work += meter.work_of_step;
    }
}
