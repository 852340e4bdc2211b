//! Torsion in the stages of methods that evaluate forces, of a cable by itself.
//!
//! # Equation
//!
//! ```text
//! Phi(q, t) = Phi(start of step) + change along the curve to q + turns of motors since then
//! M = K (Phi + tau Phi')        Phi' = g.q' + rates of motors        g = dPhi/dq
//! F = -M g        -dF/dq - rate dF/dq' = M Hess(Phi) + K (1 + tau rate) g g^T - K tau g (Hess(Phi) q')^T
//! ```
//!
//! It is a force of coordinates and time, so methods keep their orders. The last term of the matrix
//! is left out: with damping the tangent is not exact. Explicit methods need a bound of the
//! frequencies: [`frequency_square`](crate::effect::torsion::segment::Segment::frequency_square).
//!
//! # Validity
//!
//! Cables without reels; on bodies the discrete gradient alone carries torsion.

use super::torsion::{ForceSegment, SIGNS, TorsionForces};
use super::{Equations, dot};
use crate::effect::acts::ForceInput;
use crate::effect::{EndSpin, Torsion};
use crate::model::Model;
use crate::state::State;

impl TorsionForces {
    /// Begins with a state, whose curve was `before` when its twists were noted. Returns how many
    /// pairs slip from there.
    pub fn begin_motion(&mut self, model: &Model, before: &[f64], state: &mut State) -> u64 {
        self.find(model, state);
        self.shape.clear();
        self.shape.extend_from_slice(before);
        self.since = Some(state.time);
        self.accept(model, state)
    }

    /// Advances the twists to a state, and leaves them in it. Returns how many pairs slip.
    pub fn accept(&mut self, model: &Model, state: &mut State) -> u64 {
        let mut slips = 0;
        for number in 0..self.segments.len() {
            let (turned, slipped) = self.turned(&self.segments[number], model, (&state.q, state.time));
            let own = &mut self.segments[number];
            (own.twist, slips) = (own.twist + turned, slips + slipped);
            let noted = state.memory.torsion.as_mut().and_then(|all| all.get_mut(number));
            noted.into_iter().for_each(|noted| (noted.twist, noted.change) = (own.twist, 0.0));
        }
        self.shape.copy_from_slice(&state.q);
        self.since = Some(state.time);
        slips
    }

    /// Returns by how much in rad motors have turned a segment since the last shape.
    pub(super) fn driven(&self, own: &ForceSegment, model: &Model, time: f64) -> f64 {
        let Some(since) = self.since else { return 0.0 };
        own.sum_of_motors(model, |spin| spin.angle(time) - spin.angle(since))
    }

    /// Returns the damping time in s; none in statics.
    pub(super) fn damping(&self, model: &Model) -> f64 {
        let of = |torsion: &Torsion| if self.since.is_some() { torsion.damping } else { 0.0 };
        model.effects.torsion.as_ref().map_or(0.0, of)
    }

    /// Returns by how much torsion raises a bound of the squares of the frequencies, in 1/s^2, at
    /// the last shape.
    pub fn frequency_square(&self, model: &Model) -> f64 {
        let of = |own: &ForceSegment| {
            own.segment.frequency_square(&model.elements, (&self.shape, own.twist), |element| model.inertia(element))
        };
        self.segments.iter().map(of).fold(0.0, f64::max)
    }

    /// Returns the power in W that damping takes, and that of motors.
    pub fn powers(&mut self, model: &Model, input: &ForceInput<'_>) -> [f64; 2] {
        let mut powers = [0.0; 2];
        for number in 0..self.segments.len() {
            let [elastic, damped] = self.torque_parts(number, model, input);
            let own = &self.segments[number];
            powers[0] += damped * own.rate(model, input);
            powers[1] += (elastic + damped) * own.sum_of_motors(model, |spin| spin.rate(input.time));
        }
        powers
    }
}

impl ForceSegment {
    /// Returns the sum over the motors at both holds, with their signs.
    fn sum_of_motors(&self, model: &Model, of: impl Fn(&EndSpin) -> f64) -> f64 {
        let Some(torsion) = &model.effects.torsion else { return 0.0 };
        self.segment.nodes.into_iter().zip(SIGNS).map(|(node, sign)| sign * of(model.end_spin(torsion, node))).sum()
    }

    /// Returns the rate in rad/s of the twist at its gradient.
    pub(super) fn rate(&self, model: &Model, input: &ForceInput<'_>) -> f64 {
        let of_motors = self.sum_of_motors(model, |spin| spin.rate(input.time));
        dot(&self.gradient, &input.v[self.segment.range()]) + of_motors
    }
}

impl Equations<'_> {
    /// Advances the twists to a state.
    pub fn accept_torsion(&mut self, state: &mut State) {
        if let Some(torsion) = &mut self.system.torsion_forces {
            self.diagnostics.twist_slips += torsion.accept(self.model, state);
        }
    }
}
