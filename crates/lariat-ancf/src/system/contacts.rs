//! Contacts of one cable with obstacles, in a step of the discrete gradient.

use super::{Equations, dot};
use crate::contact::{BodyPath, ContactStep, Motion, When};
use crate::effect::EffectWork;
use crate::element::shape::combine;
use crate::state::State;
use crate::system::StepVectors;
use crate::term::Balance;
use nalgebra::Vector3;

impl Equations<'_> {
    /// Finds the contacts of a step, if the cable can have any, with obstacles and with bodies of
    /// an island; they close offsets if `close`.
    pub fn find_contacts(&self, state: &State, b: &mut StepVectors, (bodies, close): (&[BodyPath], bool)) {
        let lost = if close { state.memory.lost } else { 0.0 };
        self.with_contacts(state, b, (bodies, lost), |contact, motion| contact.begin(motion));
    }

    /// Adds contacts with thin parts of obstacles that the iterate entered; returns whether there
    /// are any.
    pub fn add_missed_contacts(&self, state: &State, b: &mut StepVectors) -> bool {
        self.with_contacts(state, b, (&[], 0.0), ContactStep::add_missed)
    }

    /// Returns whether the iterate goes through thin parts of obstacles.
    pub fn passes_obstacles(&self, state: &State, b: &mut StepVectors) -> bool {
        self.with_contacts(state, b, (&[], 0.0), ContactStep::passes)
    }

    /// Calls `f` with the contacts of a step and its iterate, with bodies of an island, and the
    /// power in W that closes offsets.
    fn with_contacts<T>(
        &self,
        state: &State,
        b: &mut StepVectors,
        (bodies, lost): (&[BodyPath], f64),
        f: impl FnOnce(&mut ContactStep, &Motion<'_>) -> T,
    ) -> T {
        let StepVectors { contact, change, h, leg, .. } = b;
        let (q, v, memory) = (&state.q[..], &state.v[..], &state.memory.contacts[..]);
        f(
            contact,
            &Motion { model: self.model, time: state.time, h: *h, leg: *leg, q, v, change, memory, lost, bodies },
        )
    }

    /// Adds contact forces to the residual of the present iterate, and what they do to its balance.
    pub(super) fn balance_contacts(
        &mut self,
        state: &State,
        b: &mut StepVectors,
        balance: &mut Balance,
        work: &mut EffectWork,
    ) {
        self.with_contacts(state, b, (&[], 0.0), |contact, motion| contact.complete(motion));
        let contacts = b.contact.balance(&b.change, &mut b.rhs);
        self.diagnostics.effects.contact += b.contact.count();
        work.contact += contacts.work;
        b.lost = contacts.loss;
        contacts.add_to(balance, b.h);
    }

    /// Computes the velocities at the end of the step into `external`, which is free then.
    pub fn find_velocities(&self, state: &State, b: &mut StepVectors) {
        for i in 0..b.external.len() {
            b.external[i] = state.v[i] + b.velocity_change[i] - b.taken.get(i).unwrap_or(&0.0);
        }
    }

    /// Finds the impacts of these velocities, those at the beginning and those of bodies, and
    /// returns their energy in J.
    pub fn find_impacts(
        &self,
        state: &State,
        b: &mut StepVectors,
        body: impl Fn(When, usize, &Vector3<f64>) -> Vector3<f64>,
    ) -> f64 {
        let StepVectors { contact, external, .. } = b;
        let mass = |element: usize| self.model.elements[element].section.mass_per_length;
        let velocities = |when| if when == When::Begin { &state.v } else { &*external };
        contact.find_impacts(mass, |when, e, shape| combine(velocities(when), e, shape), body)
    }

    /// Returns what impacts take of the energy in J of velocities and store in proportion to their
    /// share, and in proportion to its square.
    pub fn energy_of_impacts(&mut self, b: &mut StepVectors) -> [f64; 2] {
        let held = 0.5 * (1.0 + b.leg.a) * self.system.mass_square(&b.landed, &mut b.product);
        [dot(&b.external, &b.product) + b.leg.a * dot(&b.velocity_change, &b.product), held]
    }
}
