//! Work of effects and change of energy over a step of one cable.
//!
//! # Equation
//!
//! ```text
//! spurious = T + U + V (after) - T + U + V (before) - external work
//! ```
//!
//! T kinetic, U strain energy, V potential of gravity, constant forces and point loads. The work on a fluid is taken by the smaller of
//! its powers at the ends of the step, so that the error of a quadrature does not count as spurious. The work of internal damping is
//! left out, which hides a little spurious energy.
//!
//! # Validity
//!
//! Supports and reels that stand still, loads at their full value without moments, no force of the user's own: elsewhere the external work is not
//! known well enough.

use super::Equations;
use crate::effect::EffectWork;
use crate::effect::acts::{ForceInput, PointForce};
use crate::effect::work::{POINTS, hermite};
use crate::integrate::{EnergyLaw, State};
use crate::load::PointLoad;
use core::ops::Range;
use nalgebra::Vector3;

/// The work of effects in the present host step, and the vectors to compute work and energy.
#[derive(Clone, Debug, Default)]
pub(crate) struct EnergyMeter {
    pub work: EffectWork,
    /// The work of effects in a step of the discrete gradient.
    pub work_of_step: EffectWork,
    /// Work of a reel and of the material that enters in the present host step, in J.
    pub reel_work: f64,
    /// The energy law of the discrete gradient in the present host step.
    pub law: EnergyLaw,
    q: Vec<f64>,
    v: Vec<f64>,
    force: Vec<f64>,
}

impl EnergyMeter {
    /// Begins a host step.
    pub fn begin(&mut self) {
        self.work = EffectWork::default();
        self.reel_work = 0.0;
        self.law = EnergyLaw::default();
    }
}

/// Rounding error of the total energy, as a share of it.
const ROUNDING: f64 = 1e-14;

/// Strain whose energy is added to that of a cable at rest, with which spurious energy is compared.
const LEAST_STRAIN: f64 = 1e-5;

/// Spurious energy of a step in J, and kinetic and strain energy at both ends, with that of [`LEAST_STRAIN`].
pub(crate) struct EnergyChange {
    pub spurious: f64,
    pub before: f64,
    pub after: f64,
}

impl Equations<'_> {
    /// Adds the work of effects in a step of length `h` (s); `range` is the cable's part of the states.
    pub fn add_effect_work(&mut self, before: &State, after: &State, h: f64, range: Range<usize>) {
        if self.system.flow.is_some() {
            self.system.meter.reel_work += self.flow_work(before, after, h, range.end);
        }
        let system = &mut *self.system;
        let (forces, meter) = (&mut system.forces, &mut system.meter);
        let in_element = forces.in_element.as_ref().filter(|effects| effects.dissipates());
        if in_element.is_none() && !forces.at_points.any() && forces.densities.is_none() {
            return;
        }
        let EnergyMeter { work, q, v, force, .. } = meter;
        [&mut *q, &mut *v, &mut *force].into_iter().for_each(|x| x.resize(range.len(), 0.0));
        for (weights, share) in hermite().into_iter().zip(POINTS) {
            for (i, k) in range.clone().enumerate() {
                let mix = |x0: f64, d0: f64, x1: f64, d1: f64| {
                    weights[0] * x0 + weights[1] * h * d0 + weights[2] * x1 + weights[3] * h * d1
                };
                q[i] = mix(before.q[k], before.v[k], after.q[k], after.v[k]);
                v[i] = mix(before.v[k], before.memory.acceleration[k], after.v[k], after.memory.acceleration[k]);
            }
            if let Some(flow) = &system.flow {
                flow.strain_velocity(before.time + share * h, q, v);
            }
            let mut power = EffectWork::default();
            if let Some(effects) = in_element {
                forces.elements.add_effect_power(effects, q, v, &mut power);
            }
            let input = ForceInput { time: before.time + share * h, q, v, dv_dq: 0.0, scale: 1.0 };
            forces.at_points.add_power(system.level, input, force, &mut power);
            if let Some(densities) = &mut forces.densities {
                force.fill(0.0);
                densities.add(system.level, input, force, None);
                power.force_densities = force.iter().zip(v.iter()).map(|(f, v)| f * v).sum();
            }
            work.add_scaled(0.5 * h, &power);
        }
    }

    /// Returns whether the external work is known by energies. Nodes that are attached to bodies are left to the island.
    fn external_work_is_known(&self, time: f64) -> bool {
        let steady = |load: &PointLoad| load.moment == Vector3::zeros() && load.factor(time) == 1.0;
        self.model.supports.iter().all(|(_, support)| support.is_still())
            && self.model.loads.iter().all(steady)
            && self.system.forces.densities.is_none()
            && self.system.flow.as_ref().is_none_or(|flow| flow.extent.rate == 0.0 && flow.extent.acceleration == 0.0)
    }

    /// Returns kinetic and strain energy, and their sum with the potential of gravity and loads, in J.
    fn mechanical_energy(&mut self, time: f64, q: &[f64], v: &[f64]) -> (f64, f64) {
        let system = &mut *self.system;
        system.set_flow(self.model, time);
        let momentum = &mut system.meter.force;
        momentum.resize(v.len(), 0.0);
        system.mass.multiply(system.level, v, momentum);
        let kinetic =
            0.5 * momentum.iter().zip(v).map(|(p, v)| p * v).sum::<f64>() + system.flow_kinetic(self.model, time, q, v);
        let (axial, bending) = system.forces.strain_energy(q);
        let own = kinetic + axial + bending;
        let loads = &system.loads;
        let work = loads.gravity_work(q) + loads.effect_work(q) + loads.point_work(self.model, 1.0, q);
        (own, own - work)
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

    /// Returns the change of energy between two states; `range` is the cable's part of them. `None` if the external work is not known.
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
