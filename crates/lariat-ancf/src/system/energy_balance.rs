//! Work of effects, loads and supports, and change of energy, over a step of one cable.
//!
//! # Equation
//!
//! The work of a force over a step is that along the cubic `q(s)` through positions and velocities
//! at both ends of the step:
//!
//! ```text
//! effects, loads   int F(q(s), q'(s), t) . q'(s) ds                     2 Gauss points
//! effects          h F(q(1/2), dq/h, t) . dq/h                          if the step is not resolved
//! motors           int M theta' ds                                      2 Gauss points
//! supports         J_p . dq_p/h + h (R0 - R1) . (v0 - v1)_p/12          J_p = sum_i w_p(i) (M (v1 - v0) - h (F0 + F1)/2)_i
//! their slopes     int ((1 - s) R0 + s R1) . q'(s) ds                   R = M q'' - F of prescribed coordinates
//! a jump           (v1.M v1 - v0.M v0)/2
//! ```
//!
//! A step is not resolved if the power along the cubic is more than twice that of the mean velocity
//! `dq/h`: velocities at its ends are then transients that the method damps. By what the two differ
//! the work is uncertain: 6e-3 J of 0.37 J that damping takes of a rope whose end is set in motion
//! at once, with a tolerance of 1e-4 m. Accelerations are not used, because `h q''` is no velocity
//! that the cable has. J_p is the impulse by which a held node p gives the cable the momentum that
//! it gains, with the weights of [`pin_momentum`](crate::island); the mean of the reactions R at
//! both ends of a step is none where a jump of velocity leaves transients. Where the two differ by
//! more than half of J_p, the second term, by which the force varies with the velocity, is left
//! out. Spurious energy is
//!
//! ```text
//! spurious = T + U + V (after) - T + U + V (before) - external work
//! ```
//!
//! T kinetic, U strain energy, V potential of gravity, constant forces and point loads. The work on
//! a fluid is taken by the smaller of its powers at the ends of the step, so that the error of a
//! quadrature does not count as spurious. The work of internal damping is left out, which hides a
//! little spurious energy.
//!
//! # Validity
//!
//! Supports and reels that stand still, loads at their full value without moments, no force of the
//! user's own: elsewhere the external work is not known well enough.

use super::Equations;
use super::meter::EnergyMeter;
use crate::effect::EffectWork;
use crate::effect::acts::{ForceInput, PointForce};
use crate::effect::work::{POINTS, hermite};
use crate::load::PointLoad;
use crate::scales::LEAST_STRAIN;
use crate::scales::system::ROUNDING;
use crate::state::State;
use crate::support::Support;
use core::ops::Range;
use nalgebra::Vector3;

/// Returns whether a support does work: it moves, and is none of an island's.
fn moves((_, support): &(usize, Support)) -> bool {
    !support.attached && !support.is_still()
}

/// Spurious energy of a step in J, and kinetic and strain energy at both ends, with that of
/// [`LEAST_STRAIN`].
pub(crate) struct EnergyChange {
    pub spurious: f64,
    pub before: f64,
    pub after: f64,
}

impl Equations<'_> {
    /// Adds the work of effects, point loads, moving supports and nodes `driven` by an island in a
    /// step of length `h` (s); `range` is the cable's part of the states.
    pub fn add_work(&mut self, before: &State, after: &State, h: f64, range: Range<usize>, driven: &[usize]) {
        for k in 0..self.system.feeds.list.len() {
            let feed = self.system.feeds.list[k];
            self.system.meter.feed_work[feed.side as usize] += self.feed_work(&feed, before, after, h, range.clone());
        }
        self.add_effect_work(before, after, h, range.clone());
        if !driven.is_empty() || self.model.supports.iter().any(moves) {
            self.add_support_work(before, after, h, range, driven);
        }
    }

    fn add_effect_work(&mut self, before: &State, after: &State, h: f64, range: Range<usize>) {
        let forces = &self.system.forces;
        let dissipates = forces.in_element.as_ref().is_some_and(|effects| effects.dissipates());
        let line_loads = !self.system.feeds.is_empty() && self.model.effects.line_loads.is_some();
        let twist_damps = self.twist_damps();
        let torsion = self.model.effects.torsion.as_ref().filter(|_| self.system.torsion_forces.is_some());
        let effects = dissipates || forces.act_at_points() || line_loads || twist_damps;
        let motors = torsion.is_some_and(|torsion| !torsion.is_still(before.time));
        if !effects && !motors && self.model.loads.is_empty() {
            return;
        }
        let (mut along, mut loads, mut turned) = (EffectWork::default(), 0.0, 0.0);
        for s in POINTS {
            self.read_cubic(s, (before, after, h), range.clone());
            let time = before.time + s * h;
            if effects {
                along.add_scaled(0.5 * h, &self.effect_power(time));
            }
            let EnergyMeter { q, v, .. } = &self.system.meter;
            if let Some(torsion) = self.system.torsion_forces.as_mut().filter(|_| motors) {
                let input = ForceInput { time, q, v, dv_dq: 0.0, scale: 1.0 };
                turned += 0.5 * h * torsion.powers(self.model, &input)[1];
            }
            loads += 0.5 * h * self.system.loads.point_power(&self.model.loads, time, q, v);
        }
        let meter = &mut self.system.meter;
        meter.law.loads += loads;
        meter.law.supports += turned;
        if !effects {
            return;
        }
        self.read_cubic(0.5, (before, after, h), range.clone());
        for (v, k) in self.system.meter.v.iter_mut().zip(range) {
            *v = (after.q[k] - before.q[k]) / h;
        }
        let mut mean = EffectWork::default();
        mean.add_scaled(h, &self.effect_power(before.time + 0.5 * h));
        let apart = (along.total() - mean.total()).abs();
        let meter = &mut self.system.meter;
        meter.work += if apart <= mean.total().abs() { along } else { mean };
        meter.law.uncertain += apart;
    }

    /// Returns whether the twist is damped, where forces have torsion in them.
    fn twist_damps(&self) -> bool {
        let damps = self.model.effects.torsion.as_ref().is_some_and(|torsion| torsion.damping > 0.0);
        damps && self.system.torsion_forces.is_some()
    }

    /// Reads positions and velocities at the share `s` of a step into the meter.
    fn read_cubic(&mut self, s: f64, (before, after, h): (&State, &State, f64), range: Range<usize>) {
        let EnergyMeter { q, v, force, .. } = &mut self.system.meter;
        [&mut *q, &mut *v, &mut *force].into_iter().for_each(|x| x.resize(range.len(), 0.0));
        let (positions, velocities) = hermite(s);
        for (i, k) in range.enumerate() {
            let ends = [before.q[k], h * before.v[k], after.q[k], h * after.v[k]];
            let at = |weights: [f64; 4]| (0..4).map(|j| weights[j] * ends[j]).sum::<f64>();
            (q[i], v[i]) = (at(positions), at(velocities) / h);
        }
    }

    /// Returns the power of effects that have no energy, at positions and velocities of the meter.
    fn effect_power(&mut self, time: f64) -> EffectWork {
        let twist_damps = self.twist_damps();
        let system = &mut *self.system;
        system.set_feeds(self.model, time);
        let (forces, EnergyMeter { q, v, force, .. }) = (&mut system.forces, &mut system.meter);
        let input = ForceInput { time, q, v, dv_dq: 0.0, scale: 1.0 };
        let with_feeds = !system.feeds.is_empty();
        let [strain, input] = system.feeds.velocities(input);
        let mut power = EffectWork::default();
        if let Some(effects) = forces.in_element.as_ref().filter(|effects| effects.dissipates()) {
            forces.elements.add_effect_power(effects, q, strain.v, &mut power);
        }
        if with_feeds {
            let of_lines = &system.loads.of_effects.line_loads;
            power.line_loads = of_lines.iter().zip(input.v).map(|(f, v)| f * v).sum();
        }
        forces.at_points.add_power(system.level, input, force, &mut power);
        if let Some(torsion) = system.torsion_forces.as_mut().filter(|_| twist_damps) {
            power.torsion = -torsion.powers(self.model, &input)[0];
        }
        if let Some(densities) = &mut forces.densities {
            force.fill(0.0);
            densities.add(system.level, input, force, None);
            power.force_densities = force.iter().zip(input.v).map(|(f, v)| f * v).sum();
        }
        power
    }

    /// Puts supports in place, and adds the work by which one that starts or stops at once does so.
    pub fn place_supports(&mut self, time: f64, q: &mut [f64], v: &mut [f64]) {
        let jumps = |(node, support): &(usize, Support)| {
            let range = 6 * node..6 * node + 6;
            let [mut at, mut velocity] = [[0.0; 6]; 2];
            at.copy_from_slice(&q[range.clone()]);
            velocity.copy_from_slice(&v[range.clone()]);
            support.prescribe(time, &mut at, &mut velocity);
            !support.attached && velocity[..] != v[range]
        };
        if !self.model.supports.iter().any(jumps) {
            self.prescribe(time, q, v);
            return;
        }
        let mut momentum = core::mem::take(&mut self.system.meter.force);
        momentum.resize(v.len(), 0.0);
        let before = self.system.mass_square(v, &mut momentum);
        self.prescribe(time, q, v);
        let gained = self.system.mass_square(v, &mut momentum) - before;
        let meter = &mut self.system.meter;
        meter.law.supports += 0.5 * gained;
        meter.force = momentum;
    }

    /// Adds the work of supports that move, and of driven nodes.
    fn add_support_work(&mut self, before: &State, after: &State, h: f64, range: Range<usize>, driven: &[usize]) {
        let meter = &mut self.system.meter;
        let mut reactions = core::mem::take(&mut meter.reactions);
        let [mut missed, mut inertia] = [&mut meter.missed, &mut meter.v].map(core::mem::take);
        reactions.iter_mut().chain([&mut missed, &mut inertia]).for_each(|x| x.resize(range.len(), 0.0));
        let change = |k: usize| after.v[k] - before.v[k];
        inertia.iter_mut().zip(range.clone()).for_each(|(dv, k)| *dv = change(k));
        // the mass of the element at a reel is that of the middle of the step
        self.system.set_feeds(self.model, before.time + 0.5 * h);
        self.system.mass.multiply(self.system.level, &inertia, &mut missed);
        for (state, reaction) in [before, after].into_iter().zip(&mut reactions) {
            let [q, v, a] = [&state.q, &state.v, &state.memory.acceleration].map(|x| &x[range.clone()]);
            self.force(ForceInput { time: state.time, q, v, dv_dq: 0.0, scale: 1.0 }, reaction);
            missed.iter_mut().zip(&*reaction).for_each(|(p, f)| *p -= 0.5 * h * f);
            self.system.mass.multiply(self.system.level, a, &mut inertia);
            reaction.iter_mut().zip(&inertia).for_each(|(f, ma)| *f = ma - *f);
        }
        let moving = |node: usize, support: &Support| driven.contains(&node) || moves(&(node, *support));
        let mut work = 0.0;
        for (held, (node, support)) in self.model.supports.iter().enumerate().filter(|(_, (n, s))| moving(*n, s)) {
            let [r0, r1] = &reactions;
            let way = |i: usize| after.q[range.start + i] - before.q[range.start + i];
            let beyond = |i: usize| -h / 12.0 * (r0[i] - r1[i]) * change(range.start + i);
            for i in 6 * node + 3..6 * node + 6 {
                work += 0.5 * (r0[i] + r1[i]) * way(i) + beyond(i);
            }
            if support.position.is_none() && !support.attached {
                continue;
            }
            let at = 6 * node;
            let mean = Vector3::from_fn(|x, _| 0.5 * h * (r0[at + x] + r1[at + x]));
            let impulse = self.impulse_at(held, &missed);
            let resolved = (impulse - mean).norm() <= 0.5 * impulse.norm();
            work +=
                (0..3).map(|x| impulse[x] * way(at + x) / h + if resolved { beyond(at + x) } else { 0.0 }).sum::<f64>();
        }
        let meter = &mut self.system.meter;
        meter.law.supports += work;
        (meter.reactions, meter.missed, meter.v) = (reactions, missed, inertia);
    }

    /// Returns the share of momenta `p` of all nodes that one of the supports gives: those of nodes
    /// between two held ones by the number of nodes.
    fn impulse_at(&self, held: usize, p: &[f64]) -> Vector3<f64> {
        let holds = |(_, support): &&(usize, Support)| support.attached || support.position.is_some();
        let (before, from) = self.model.supports.split_at(held);
        let here = from[0].0;
        let last = before.iter().rfind(holds).map(|(node, _)| *node);
        let next = from[1..].iter().find(holds).map(|(node, _)| *node);
        let share = |node: usize| {
            let other = if node < here { last } else { next };
            other.map_or(1.0, |other| 1.0 - node.abs_diff(here) as f64 / other.abs_diff(here) as f64)
        };
        let range = last.map_or(0, |last| last + 1)..next.unwrap_or(p.len() / 6);
        range.map(|node| Vector3::from_column_slice(&p[6 * node..6 * node + 3]) * share(node)).sum()
    }

    /// Returns whether the external work is known by energies. Nodes that are attached to bodies
    /// are left to the island.
    fn external_work_is_known(&self, time: f64) -> bool {
        let steady =
            |load: &PointLoad| load.moment == Vector3::zeros() && load.history.is_empty() && load.factor(time) == 1.0;
        self.model.supports.iter().all(|(_, support)| support.is_still())
            && self.model.loads.iter().all(steady)
            && self.model.effects.torsion.as_ref().is_none_or(|torsion| torsion.is_still(time))
            && self.system.forces.densities.is_none()
            && self.system.feeds.are_still()
    }

    /// Returns kinetic and strain energy, and their sum with the potential of gravity and loads, in
    /// J.
    fn mechanical_energy(&mut self, time: f64, q: &[f64], v: &[f64]) -> (f64, f64) {
        let system = &mut *self.system;
        system.set_feeds(self.model, time);
        let momentum = &mut system.meter.force;
        momentum.resize(v.len(), 0.0);
        system.mass.multiply(system.level, v, momentum);
        let kinetic =
            0.5 * momentum.iter().zip(v).map(|(p, v)| p * v).sum::<f64>() + system.feed_kinetic(self.model, time, q, v);
        let (axial, bending) = system.forces.strain_energy(q);
        let torsion = system.torsion_forces.as_ref().map_or(0.0, |torsion| torsion.energy(self.model, (q, time)));
        let own = kinetic + axial + bending + torsion;
        let loads = &system.loads;
        let work = loads.gravity_work(q) + loads.effect_work(q) + loads.point_work(self.model, 1.0, q);
        (own, own + system.potentials.energy(self.model, q) - work)
    }

    /// Returns the power in W that effects at Gauss points give to the cable.
    fn point_power(&mut self, (time, q, v): (f64, &[f64], &[f64])) -> f64 {
        let system = &mut *self.system;
        let mut power = EffectWork::default();
        let input = ForceInput { time, q, v, dv_dq: 0.0, scale: 1.0 };
        system.meter.force.resize(v.len(), 0.0);
        system.forces.at_points.add_power(system.level, input, &mut system.meter.force, &mut power);
        power.total()
    }

    /// Returns the change of energy between two states; `range` is the cable's part of them. `None`
    /// if the external work is not known.
    pub fn energy_between(
        &mut self,
        before: &State,
        after: &State,
        h: f64,
        range: Range<usize>,
    ) -> Option<EnergyChange> {
        if !self.external_work_is_known(before.time) {
            return None;
        }
        let [first, last] = [before, after].map(|p| (p.time, &p.q[range.clone()], &p.v[range.clone()]));
        let (own_before, total_before) = self.mechanical_energy(first.0, first.1, first.2);
        let (own_after, total_after) = self.mechanical_energy(last.0, last.1, last.2);
        // the work that the cable does on a fluid
        let on_fluid = h * (-self.point_power(first)).min(-self.point_power(last));
        // the totals are differences of larger numbers
        let rounding = ROUNDING * (total_before.abs() + own_before + total_after.abs() + own_after);
        let spurious = total_after - total_before + on_fluid - rounding;
        let stiffness: f64 = self.model.elements.iter().map(|e| e.section.axial_stiffness * e.length).sum();
        let least = 0.5 * stiffness * LEAST_STRAIN * LEAST_STRAIN;
        Some(EnergyChange { spurious, before: own_before + least, after: own_after + least })
    }
}
