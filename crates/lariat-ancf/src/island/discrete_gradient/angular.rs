//! The angular momentum of an island that nothing holds, or one point at rest, over a step.
//! Equations: `system/angular.rs`.

use super::body::BodyStep;
use super::{CableBuffers, IslandStep};
use crate::island::hold::vector;
use crate::support::{SlopeSupport, Support};
use crate::system::angular::{Momenta, Restoration};
use crate::system::{CableStep, Source};
use crate::term::{Balance, Reason, StepStart, StepTerm, Verdict};
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
            momenta.add_cable(&mut equations, (state.time, [&state.q, &state.v]), buffers);
        }
        self.moving().for_each(|body| body.add_momenta(momenta));
    }

    /// Returns the bodies that are not driven.
    fn moving(&self) -> impl Iterator<Item = &BodyStep> {
        self.buffers.bodies.iter().filter(|body| !body.is_driven())
    }

    /// Notes the angular momentum of a step of length `h` (s) when it begins, if nothing holds the
    /// island but one point.
    fn note_angular_momentum(&mut self, h: f64) {
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

    /// Returns whether material passes an end of a cable: what that changes is known only when the
    /// step was accepted.
    fn feeds_material(&self) -> bool {
        self.cables.iter().any(|cable| !cable.system.feeds.is_empty())
    }

    /// Returns what restores the momenta at the end of the step, before or after that was
    /// `accepted`, with the share of all motion that is owed then; and counts in the balance what
    /// it does to the energy. `None` where nothing is restored.
    fn find_restoration(&mut self, balance: &mut Balance, accepted: bool) -> Option<(Restoration, f64)> {
        let first = &self.cables[0].step_buffers;
        let (before, leg) = (first.before?, first.leg);
        if self.cables.iter().any(|cable| cable.step_buffers.contact.is_held()) {
            return None;
        }
        let (mut momenta, mut outside) = (Momenta::about(first.pivot), [Vector3::zeros(); 2]);
        let mut add = |own: [Vector3<f64>; 2]| (0..2).for_each(|i| outside[i] += own[i]);
        for (cable, CableBuffers { end, .. }) in self.cables.iter_mut().zip(&mut self.buffers.cables) {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            buffers.outside.iter().for_each(|own| add(*own));
            let time = if accepted { state.time } else { state.time + buffers.h };
            let [q, v] = if accepted {
                [&state.q, &state.v]
            } else {
                equations.end_of_step(state, buffers, end);
                let [q, v] = &*end;
                [q, v]
            };
            momenta.add_second_difference(equations.system, q, buffers);
            momenta.add_cable(&mut equations, (time, [q, v]), buffers);
        }
        for body in self.moving() {
            let mut end = body.clone();
            if !accepted {
                end.accept();
            }
            add(end.outside_impulses());
            end.add_second_difference(&mut momenta);
            end.add_momenta(&mut momenta);
        }
        let owed = self.cables[0].snapshot.state.memory.differences.owed;
        let restoration = momenta.restore(owed, (before, outside), (leg, balance));
        Some((restoration, momenta.share_of(&restoration.owed, balance.weight)))
    }

    /// Restores the momenta after an accepted step, and returns its balance with what that does to
    /// the energy.
    pub(super) fn restore_momenta(&mut self, mut balance: Balance) -> Balance {
        let restoration = match self.buffers.restoration.take() {
            None if self.feeds_material() => self.find_restoration(&mut balance, true).map(|(found, _)| found),
            found => found,
        };
        let Some(Restoration { turn, after, owed }) = restoration else { return balance };
        self.cables[0].snapshot.state.memory.differences.owed = owed;
        self.cables[0].step_buffers.after = Some(after);
        self.cables.iter_mut().for_each(|cable| turn.turn_cable(&mut cable.snapshot.state));
        self.buffers.bodies.iter_mut().filter(|body| !body.is_driven()).for_each(|body| body.turn(&turn));
        balance
    }
}

/// The momenta of what nothing holds, or one point, as a term of a step.
///
/// Its verdict: a step is divided at whose end more momentum is owed than a small share of the
/// motion, because there is no energy from which it could be restored.
pub(super) struct Momentum;

impl StepTerm<IslandStep<'_, '_>> for Momentum {
    /// None: it is of no feature, but of all that moves.
    fn name(_: &mut Vec<&'static str>) {}

    fn begin(island: &mut IslandStep<'_, '_>, step: &StepStart) {
        island.note_angular_momentum(step.h);
        (island.buffers.restoration, island.buffers.may_owe) = (None, step.may_owe);
    }

    fn examine(island: &mut IslandStep<'_, '_>, balance: &mut Balance) -> Verdict {
        if island.feeds_material() {
            return Verdict::Accept;
        }
        let found = island.find_restoration(balance, false);
        island.buffers.restoration = found.map(|(restoration, _)| restoration);
        match found {
            Some((_, owed)) if owed > island.buffers.may_owe => Verdict::Divide(Reason::OwedMomentum),
            _ => Verdict::Accept,
        }
    }
}
