//! Forces between a cable and what holds it.
//!
//! # Equation
//!
//! ```text
//! f = M q'' - F on the position        m = t x (M q'' - F) of the slope t
//! ```
//!
//! F has the contacts in it, by their forces at the end of the last step; the accelerations of a
//! cable that touches something are the means of that step, and before one it is taken to rest.
//!
//! # Validity
//!
//! A contact of two cables is part of the state of one of them. To the other,
//! [`share_of_contact`](crate::coupling::Coupling::share_of_contact) gives it. The couple of
//! friction between cables, at most mu N r, is left out.

use super::Cable;
use crate::contact::PairTouch;
use crate::effect::acts::ForceInput;
use crate::element::shape::position;
use crate::error::Error;
use crate::integrate::Dynamics;
use crate::state::{ContactMemory, PairMemory};
use crate::system::Buffers;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Force and moment of a support on the cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Reaction {
    /// Node number.
    pub node: usize,
    /// Force on the cable in N.
    pub force: Vector3<f64>,
    /// Moment on the cable in N m.
    pub moment: Vector3<f64>,
}

impl Cable {
    /// Returns the reactions of all supports at the present state, by ascending node: force and
    /// moment of the support on the cable.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the present state has no finite acceleration.
    pub fn reactions(&mut self) -> Result<Vec<Reaction>, Error> {
        let mut reactions = self.with_torsion(Cable::reactions_of_forces)?;
        if self.model.effects.torsion.is_some() {
            reactions.iter_mut().for_each(|reaction| reaction.moment -= self.torsion_moment(reaction.node));
        }
        Ok(reactions)
    }

    fn reactions_of_forces(&mut self) -> Result<Vec<Reaction>, Error> {
        let n = self.positions().len();
        self.refresh_memory();
        let memory = &self.snapshot.state.memory;
        let mut acceleration = memory.acceleration.clone();
        let touches = !(memory.contacts.is_empty() && memory.pairs.is_empty());
        if touches && !memory.valid {
            acceleration = vec![0.0; n];
            if let Some(step) = memory.differences.length() {
                acceleration.iter_mut().zip(&memory.differences.velocity).for_each(|(a, v)| *a = v / step);
            }
        } else if !memory.valid {
            acceleration.resize(n, 0.0);
            let outcome = self.with_workspace(|cable| {
                let (mut dynamics, state) = cable.dynamics();
                dynamics.acceleration(state.time, &state.q, &state.v, &mut acceleration)
            });
            outcome.map_err(|failure| self.step_failed(self.time(), 0.0, failure))?;
        }
        let mut residual = vec![0.0; n];
        let mut inertia = vec![0.0; n];
        let (mut equations, state) = self.equations();
        equations
            .force(ForceInput { time: state.time, q: &state.q, v: &state.v, dv_dq: 0.0, scale: -1.0 }, &mut residual);
        equations.system.mass.multiply(equations.system.level, &acceleration, &mut inertia);
        let vector = |x: &[f64], y: &[f64]| Vector3::new(x[0] + y[0], x[1] + y[1], x[2] + y[2]);
        let reaction = |&(node, _): &(usize, _)| {
            let i = 6 * node;
            let slope = Vector3::from_column_slice(&state.q[i + 3..i + 6]);
            Reaction {
                node,
                force: vector(&residual[i..i + 3], &inertia[i..i + 3]),
                moment: slope.cross(&vector(&residual[i + 3..i + 6], &inertia[i + 3..i + 6])),
            }
        };
        let mut reactions: Vec<Reaction> = equations.model.supports.iter().map(reaction).collect();
        for reaction in &mut reactions {
            let (force, moment) = self.pull_of_contacts(reaction.node);
            reaction.force -= force;
            reaction.moment -= moment;
        }
        Ok(reactions)
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn pull(&mut self, node: usize) -> (Vector3<f64>, Vector3<f64>) {
        let (force, moment) = self.with_torsion(|cable| cable.with_workspace(|cable| cable.pull_in_workspace(node)));
        if self.model.effects.torsion.is_none() {
            return (force, moment);
        }
        (force, moment + self.torsion_moment(node))
    }

    fn pull_in_workspace(&mut self, node: usize) -> (Vector3<f64>, Vector3<f64>) {
        self.refresh_memory();
        let (dynamics, state) = self.dynamics();
        let (mut equations, Buffers { rhs, product, .. }) = (dynamics.equations, dynamics.buffers);
        equations.force(ForceInput { time: state.time, q: &state.q, v: &state.v, dv_dq: 0.0, scale: 1.0 }, rhs);
        if state.memory.valid {
            equations.system.mass.multiply(equations.system.level, &state.memory.acceleration, product);
            rhs.iter_mut().zip(product.iter()).for_each(|(r, m)| *r -= m);
        } else if let Some(step) = state.memory.differences.length() {
            // the discrete gradient knows the mean ones of its last step
            let differences = &state.memory.differences;
            equations.system.mass.multiply(equations.system.level, &differences.velocity, product);
            rhs.iter_mut().zip(product.iter()).for_each(|(r, m)| *r -= m / step);
        }
        let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);
        let (force, slope) = (vector(&rhs[6 * node..]), vector(&rhs[6 * node + 3..]));
        let moment = vector(&state.q[6 * node + 3..]).cross(&slope);
        let of_contacts = self.pull_of_contacts(node);
        (force + of_contacts.0, moment + of_contacts.1)
    }

    /// Returns what the contacts that the cable knows add to the pull on what holds a node.
    fn pull_of_contacts(&self, node: usize) -> (Vector3<f64>, Vector3<f64>) {
        let (memory, key) = (&self.snapshot.state.memory, self.model.contact_key);
        let now = self.snapshot.passed_at_start();
        let pairs = memory.pairs.iter().flat_map(|PairMemory { contact, arcs, passed }| {
            let force = contact.force_on_cable();
            let at = |side: usize| self.model.locate(arcs[side] + (now - passed[side]));
            [Some((at(0), force)), (contact.obstacle == key).then(|| (at(1), -force))]
        });
        let place = |contact: &ContactMemory| (contact.element as usize, contact.xi);
        let obstacles = memory.contacts.iter().map(|contact| (place(contact), contact.force_on_cable()));
        let shares = obstacles.chain(pairs.flatten()).map(|(at, force)| self.share(node, at, &force));
        shares.fold(Default::default(), |sum, share| (sum.0 + share.0, sum.1 + share.1))
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn share_of_contact(&self, node: usize, touch: &PairTouch) -> (Vector3<f64>, Vector3<f64>) {
        let force = touch.normal_force * touch.normal + touch.friction;
        self.share(node, self.model.locate(touch.arc_length), &force)
    }

    /// Returns the share of a force (N) at a place of an element that a node has: force, and moment
    /// about the node.
    fn share(&self, node: usize, (e, xi): (usize, f64), force: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let Some(side) = node.checked_sub(e).filter(|side| *side < 2) else { return Default::default() };
        let weights = position(xi, self.model.elements[e].length);
        let slope = Vector3::from_column_slice(&self.positions()[6 * node + 3..6 * node + 6]);
        (weights[2 * side] * force, slope.cross(force) * weights[2 * side + 1])
    }
}
