//! The angular momentum of an island that nothing holds, over a step. Equations:
//! `system/angular.rs`.

use super::IslandStep;
use super::body::BodyStep;
use crate::system::angular::Momenta;
use crate::system::{CableStep, Source};
use crate::term::Balance;

impl IslandStep<'_, '_> {
    /// Returns whether nothing holds the island, and all of it is in the equations.
    fn is_free(&self) -> bool {
        let supports = |attached: bool| {
            let of = self.cables.iter().flat_map(|cable| &cable.model.supports);
            of.filter(|(_, support)| support.attached == attached).count()
        };
        let outside = |cable: &crate::Cable| cable.system.feeds.list.iter().any(|feed| feed.source == Source::Outside);
        supports(false) == 0
            && supports(true) == self.layout.pins.len()
            && !self.cables.iter().any(|cable| outside(cable))
            && self.buffers.coupled.is_empty()
            && self.buffers.bodies.iter().all(BodyStep::is_free)
    }

    /// Returns the momenta of all at the present state.
    fn momenta(&mut self, momenta: &mut Momenta) {
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            momenta.add_cable(&mut equations, state, buffers);
        }
        self.buffers.bodies.iter().for_each(|body| body.add_momenta(momenta));
    }

    /// Notes the angular momentum when a step begins, if nothing holds the island.
    pub(super) fn note_angular_momentum(&mut self) {
        let after = self.cables[0].step_buffers.after.take();
        let before = self.is_free().then(|| {
            after.unwrap_or_else(|| {
                let mut momenta = Momenta::default();
                self.momenta(&mut momenta);
                momenta.before()
            })
        });
        for cable in self.cables.iter_mut() {
            let b = &mut cable.step_buffers;
            (b.before, b.outside) = (before, before.map(|_| Default::default()));
        }
    }

    /// Restores the angular momentum after an accepted step, and returns its balance with what that
    /// does to the energy.
    pub(super) fn restore_angular_momentum(&mut self, mut balance: Balance) -> Balance {
        let Some(before) = self.cables[0].step_buffers.before else { return balance };
        if self.cables.iter().any(|cable| cable.step_buffers.contact.is_held()) {
            return balance;
        }
        let leg = self.cables[0].step_buffers.leg;
        let (mut momenta, mut outside) = (Momenta::default(), [nalgebra::Vector3::zeros(); 2]);
        let mut add = |own: [nalgebra::Vector3<f64>; 2]| (0..2).for_each(|i| outside[i] += own[i]);
        for cable in self.cables.iter_mut() {
            let CableStep { equations, state, buffers } = cable.step_parts();
            buffers.outside.iter().for_each(|own| add(*own));
            momenta.add_second_difference(equations.system, state, buffers);
        }
        for body in &self.buffers.bodies {
            add(body.outside_impulses());
            body.add_second_difference(&mut momenta);
        }
        self.momenta(&mut momenta);
        let owed = &mut self.cables[0].snapshot.state.memory.differences.owed;
        let (turn, after) = momenta.restore(owed, (before, outside), (leg, &mut balance));
        self.cables[0].step_buffers.after = Some(after);
        self.cables.iter_mut().for_each(|cable| turn.turn_cable(&mut cable.snapshot.state));
        self.buffers.bodies.iter_mut().for_each(|body| body.turn(&turn));
        balance
    }
}
