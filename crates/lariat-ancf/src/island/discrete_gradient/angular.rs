//! The angular momentum of an island that nothing holds, or one point at rest, over a step.
//! Equations: `system/angular.rs`.

use super::IslandStep;
use super::body::BodyStep;
use crate::island::hold::vector;
use crate::support::{SlopeSupport, Support};
use crate::system::angular::Momenta;
use crate::system::{CableStep, Source};
use crate::term::Balance;
use nalgebra::Vector3;

/// What holds an island.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    Free,
    /// At one point at rest, about which it turns freely.
    At(Vector3<f64>),
    /// In any other way, or not all of it is in the equations.
    Otherwise,
}

impl Held {
    /// Returns what it is with another point that is held.
    fn and(self, point: Option<Vector3<f64>>) -> Self {
        match (self, point) {
            (Held::Free, Some(point)) => Held::At(point),
            _ => Held::Otherwise,
        }
    }
}

impl IslandStep<'_, '_> {
    /// Returns what holds the island in a step of length `h` (s).
    fn held(&self, h: f64) -> Held {
        let supports = || self.cables.iter().flat_map(|cable| &cable.model.supports);
        let attached = supports().filter(|(_, support)| support.attached).count();
        let outside = |cable: &crate::Cable| cable.system.feeds.list.iter().any(|feed| feed.source == Source::Outside);
        let bodies = &self.buffers.bodies;
        let whole = attached == self.layout.pins.len()
            && !self.cables.iter().any(|cable| outside(cable))
            && self.buffers.coupled.is_empty()
            && bodies
                .iter()
                .enumerate()
                .all(|(i, body)| body.is_free() || body.is_at_rest() || body.is_point() && self.is_held_at_centre(i));
        if !whole {
            return Held::Otherwise;
        }
        let of_supports = supports().filter(|(_, support)| !support.attached).map(|(_, s)| self.at_rest(s, h));
        let holds = self.buffers.cables.iter().flat_map(|own| &own.holds);
        let of_bodies = holds.filter(|hold| bodies[hold.body].is_driven()).map(|hold| {
            let body = &bodies[hold.body];
            (!hold.slope).then(|| body.position + body.rotation * self.layout.pins[hold.pin].anchor)
        });
        // a body at rest that a cable may touch holds more than a point
        let touches = |cable: &crate::Cable| cable.model.effects.contact.is_some();
        match of_supports.chain(of_bodies).fold(Held::Free, Held::and) {
            Held::At(_) if bodies.iter().any(BodyStep::is_driven) && self.cables.iter().any(|c| touches(c)) => {
                Held::Otherwise
            }
            Held::Free if bodies.iter().any(BodyStep::is_driven) => Held::Otherwise,
            // a cable alone takes 7 % more iterations with it, in some seconds 50 %
            Held::At(_) if self.moving().next().is_none() => Held::Otherwise,
            held => held,
        }
    }

    /// Returns whether all that a body holds is pinned to its centre of mass.
    fn is_held_at_centre(&self, body: usize) -> bool {
        let mut holds = self.buffers.cables.iter().flat_map(|own| &own.holds).filter(|hold| hold.body == body);
        holds.all(|hold| !hold.slope && self.layout.pins[hold.pin].anchor == Vector3::zeros())
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
        self.moving().for_each(|body| body.add_momenta(momenta));
    }

    /// Returns the bodies that are not driven.
    fn moving(&self) -> impl Iterator<Item = &BodyStep> {
        self.buffers.bodies.iter().filter(|body| !body.is_driven())
    }

    /// Notes the angular momentum of a step of length `h` (s) when it begins, if nothing holds the
    /// island but one point.
    pub(super) fn note_angular_momentum(&mut self, h: f64) {
        let held = self.held(h);
        let pivot = if let Held::At(point) = held { Some(point) } else { None };
        let first = &mut self.cables[0].step_buffers;
        let same = core::mem::replace(&mut first.pivot, pivot) == pivot;
        let after = first.after.take().filter(|_| same);
        let before = (held != Held::Otherwise).then(|| {
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

    /// Restores the angular momentum after an accepted step, and returns its balance with what that
    /// does to the energy.
    pub(super) fn restore_angular_momentum(&mut self, mut balance: Balance) -> Balance {
        let Some(before) = self.cables[0].step_buffers.before else { return balance };
        if self.cables.iter().any(|cable| cable.step_buffers.contact.is_held()) {
            return balance;
        }
        let leg = self.cables[0].step_buffers.leg;
        let (mut momenta, mut outside) = (Momenta::about(self.cables[0].step_buffers.pivot), [Vector3::zeros(); 2]);
        let mut add = |own: [Vector3<f64>; 2]| (0..2).for_each(|i| outside[i] += own[i]);
        for cable in self.cables.iter_mut() {
            let CableStep { equations, state, buffers } = cable.step_parts();
            buffers.outside.iter().for_each(|own| add(*own));
            momenta.add_second_difference(equations.system, state, buffers);
        }
        for body in self.moving() {
            add(body.outside_impulses());
            body.add_second_difference(&mut momenta);
        }
        self.momenta(&mut momenta);
        let owed = &mut self.cables[0].snapshot.state.memory.differences.owed;
        let (turn, after) = momenta.restore(owed, (before, outside), (leg, &mut balance));
        self.cables[0].step_buffers.after = Some(after);
        self.cables.iter_mut().for_each(|cable| turn.turn_cable(&mut cable.snapshot.state));
        self.buffers.bodies.iter_mut().filter(|body| !body.is_driven()).for_each(|body| body.turn(&turn));
        balance
    }
}
