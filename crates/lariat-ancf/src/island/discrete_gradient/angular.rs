//! The angular momentum of an island that nothing holds, over a step. Equations: `system/angular.rs`.

use super::IslandStep;
use super::body::BodyStep;
use crate::island::hold::vector;
use crate::support::{SlopeSupport, Support};
use crate::system::angular::Momenta;
use crate::system::{CableStep, Source};
use crate::term::Balance;
use nalgebra::Vector3;

impl IslandStep<'_, '_> {
    /// Returns the one point at rest that is held, if there is one, or `None` if something else holds the island, or not all of it is in
    /// the equations.
    fn pivot(&self, h: f64) -> Option<Option<Vector3<f64>>> {
        let supports = || self.cables.iter().flat_map(|cable| &cable.model.supports);
        let attached = supports().filter(|(_, support)| support.attached).count();
        let mut held = supports().filter(|(_, support)| !support.attached);
        let outside = |cable: &crate::Cable| cable.system.feeds.list.iter().any(|feed| feed.source == Source::Outside);
        let whole = attached == self.layout.pins.len()
            && !self.cables.iter().any(|cable| outside(cable))
            && self.buffers.coupled.is_empty()
            && self.buffers.bodies.iter().all(BodyStep::is_free);
        let pivot = match held.next() {
            None => None,
            Some((_, support)) if held.next().is_none() => Some(self.at_rest(support, h)?),
            Some(_) => return None,
        };
        whole.then_some(pivot)
    }

    /// Returns the point that a support holds at rest, about which the slope turns freely.
    fn at_rest(&self, support: &Support, h: f64) -> Option<Vector3<f64>> {
        let time = self.cables[0].time();
        let at = |time: f64| {
            let (mut q, mut v) = ([0.0; 6], [0.0; 6]);
            support.prescribe(time, &mut q, &mut v);
            (vector(&q), vector(&v))
        };
        let (start, end) = (at(time), at(time + h));
        let rests = start == end && start.1 == Vector3::zeros();
        (support.position.is_some() && support.slope == SlopeSupport::Free && rests).then_some(start.0)
    }

    /// Returns the momenta of all at the present state.
    fn momenta(&mut self, momenta: &mut Momenta) {
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            momenta.add_cable(&mut equations, state, buffers);
        }
        self.buffers.bodies.iter().for_each(|body| body.add_momenta(momenta));
    }

    /// Notes the angular momentum of a step of length `h` (s) when it begins, if nothing holds the island but one point.
    pub(super) fn note_angular_momentum(&mut self, h: f64) {
        let pivot = self.pivot(h);
        let first = &mut self.cables[0].step_buffers;
        let same = first.pivot == pivot.flatten();
        first.pivot = pivot.flatten();
        let after = first.after.take().filter(|_| same);
        let before = pivot.map(|pivot| {
            after.unwrap_or_else(|| {
                let mut momenta = Momenta::about(pivot);
                self.momenta(&mut momenta);
                momenta.before()
            })
        });
        for cable in self.cables.iter_mut() {
            let b = &mut cable.step_buffers;
            (b.before, b.outside) = (before, before.map(|_| Default::default()));
        }
    }

    /// Restores the angular momentum after an accepted step, and returns its balance with what that does to the energy.
    pub(super) fn restore_angular_momentum(&mut self, mut balance: Balance) -> Balance {
        let Some(before) = self.cables[0].step_buffers.before else { return balance };
        if self.cables.iter().any(|cable| cable.step_buffers.contact.is_held()) {
            return balance;
        }
        let (mut momenta, mut outside) = (Momenta::about(self.cables[0].step_buffers.pivot), [Vector3::zeros(); 2]);
        let mut add = |own: [Vector3<f64>; 2]| (0..2).for_each(|i| outside[i] += own[i]);
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
        let (turn, after) = momenta.restore(owed, (before, outside), &mut balance);
        self.cables[0].step_buffers.after = Some(after);
        self.cables.iter_mut().for_each(|cable| turn.turn_cable(&mut cable.snapshot.state));
        self.buffers.bodies.iter_mut().for_each(|body| body.turn(&turn));
        balance
    }
}
