//! Energy that a step of one cable makes: what kinetic, strain, gravity and load energy grow by, beyond what a fluid did. What
//! internal damping takes is not added: it hides a little.

use super::equations::Equations;
use crate::integrate::State;
use crate::load::PointLoad;
use core::ops::Range;
use nalgebra::Vector3;

/// Energy in J that was made, and kinetic and strain energy at both ends.
pub(crate) struct Made {
    pub made: f64,
    pub before: f64,
    pub after: f64,
}

impl Equations<'_> {
    /// Whether what acts on the cable from outside is known by its energy: supports stand still, loads are forces at their
    /// full value. Nodes that are pinned to bodies are those bodies' to judge.
    pub(crate) fn is_isolated(&self, time: f64) -> bool {
        let steady = |load: &PointLoad| load.moment == Vector3::zeros() && load.factor(time) == 1.0;
        self.model.supports.iter().all(|(_, support)| support.is_still()) && self.model.loads.iter().all(steady)
    }

    /// Kinetic and strain energy, and their sum with the energy of gravity and loads, in J.
    pub(crate) fn mechanical_energy(&mut self, q: &[f64], v: &[f64]) -> (f64, f64) {
        let mut momentum = core::mem::take(&mut self.system.product);
        momentum.resize(v.len(), 0.0);
        self.system.multiply_mass(v, &mut momentum);
        let kinetic = 0.5 * momentum.iter().zip(v).map(|(p, v)| p * v).sum::<f64>();
        self.system.product = momentum;
        let (axial, bending) = self.system.strain_energy(q);
        let own = kinetic + axial + bending;
        let work = self.system.gravity_work(q) + self.system.line_work(q) + self.system.load_work(self.model, 1.0, q);
        (own, own - work)
    }

    /// Work that the cable does on a fluid while `h` (s) pass between two states, in J, by the smaller of the powers at its ends: what a
    /// quadrature is off by is not taken for made.
    fn work_on_fluid(&mut self, h: f64, before: (f64, &[f64], &[f64]), after: (f64, &[f64], &[f64])) -> f64 {
        let level = self.system.level;
        let Some(fluid) = &mut self.system.fluid else { return 0.0 };
        let [first, last] = [before, after].map(|(t, q, v)| fluid.power(level, t, q, v));
        h * first.min(last)
    }

    /// Energy made between two phases; `range` is the cable's part of them.
    pub(crate) fn energy_between(
        &mut self,
        before: &State,
        after: &State,
        h: f64,
        range: Range<usize>,
    ) -> Option<Made> {
        if !self.is_isolated(before.time) {
            return None;
        }
        let [(t0, q0, v0), (t1, q1, v1)] = [before, after].map(|p| (p.time, &p.q[range.clone()], &p.v[range.clone()]));
        let (own_before, total_before) = self.mechanical_energy(q0, v0);
        let (own_after, total_after) = self.mechanical_energy(q1, v1);
        let made = total_after - total_before + self.work_on_fluid(h, (t0, q0, v0), (t1, q1, v1));
        Some(Made { made, before: own_before, after: own_after })
    }
}
