//! Splitting and merging the element at the eye of a reel.
//!
//! # Equation
//!
//! *Split* above 1.6 of its full length h: the node at y = h takes position, slope and velocities
//! of the particle there, `r = S e`, `r' = S e' + l' w`, `t' = S_y e' + l' w_y`, so shape, mass,
//! momentum and kinetic energy stay to rounding.
//!
//! *Merge* below 0.4 h with the element before: the outer nodes keep position and slope, so the
//! pull at the eye does not jump; the slope there keeps the rate of its particle, `t' + l'
//! (r''_new - r''_old)`, as far as no clamp holds that. Then the velocities take the jump of the
//! momentum,
//!
//! ```text
//! v += M^-1 rho int S^T (v_old - S e' - l' w_new) dy          over all free coordinates
//! ```
//!
//! which is a projection in the norm of the mass: momentum stays but for the impulse on supports,
//! and kinetic energy falls but for the product of `v_old - v_new` with l' w_new, of the order of
//! the waves that the mesh does not resolve. The shape has changed and with it `int rho r x v`: a
//! cable that no support holds takes that up by a rigid rotation about its centre of mass. Where
//! the energy is then more than before, nodes [move](super::settle). The change of the whole energy
//! is on the account [`remeshed`](super::ReelReading::remeshed).
//!
//! The discrete gradient remembers the last step: a node that a split makes has the changes of its
//! particle, and the others keep theirs, so that no force jumps; where that would hold more energy
//! than before, less is remembered. At the start of a cable the same is done to the reversed one.
//!
//! # Validity
//!
//! Contacts are of elements that are not at an eye: those of one that comes to it are forgotten,
//! and their energy is lost. A node that is held, or before an element with a point load or of
//! another section, is not merged away: the reel stops before it.
//!
//! # Alternatives considered
//!
//! Merging by deleting the node: loses up to 2 % of the momentum, and feeds waves of the mesh.
//! Splitting at 1.5 and merging at 0.5: no hysteresis, it chatters.

use crate::cable::Cable;
use crate::element::shape::{self, combine};
use crate::element::side::Side;
use crate::element::variable_length::feed_weights;
use crate::error::Error;
use crate::quadrature::gauss_legendre;
use crate::scales::reel::{LEAST, MOST, MOST_SPLITS, PASSING_RATE};
use crate::section::Element;
use crate::state::{Differences, renumber};
use crate::system::project_vector;
use nalgebra::Vector3;

/// The end of a cable at a reel, turned so that the eye is its last node.
struct Turned {
    side: Side,
    q: Vec<f64>,
    v: Vec<f64>,
    /// The element at the eye, and the one before.
    at_eye: Element,
    before: Option<Element>,
    /// The former at its full length; the next one of the stock.
    full: Element,
    next: Element,
    rate: f64,
    /// Changes of `q` and `v` over the last step of the discrete gradient, and at its beginning
    /// length in m and rate in m/s of the element at the eye.
    changes: Option<[Vec<f64>; 2]>,
    length_before: f64,
    rate_before: f64,
}

impl Turned {
    /// Returns the vectors over all nodes.
    fn vectors(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        let Turned { q, v, changes, .. } = self;
        [q, v].into_iter().chain(changes.iter_mut().flatten())
    }
}

impl Cable {
    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn remesh_reel(&mut self) -> Result<(), Error> {
        Side::BOTH.into_iter().try_for_each(|side| self.remesh_at(side))
    }

    fn remesh_at(&mut self, side: Side) -> Result<(), Error> {
        for _ in 0..MOST_SPLITS {
            let Some(winding) = self.snapshot.windings[side as usize] else { return Ok(()) };
            let (count, reels) = (self.elements().len(), &self.model.reels);
            let e = side.element(count);
            let full = reels.element(self.number(e));
            let inner = if side == Side::End { e.checked_sub(1) } else { Some(e + 1).filter(|&e| e < count) };
            let full_before = inner.map_or(0.0, |e| reels.element(self.number(e)).length);
            let length = self.elements()[e].length;
            let (splits, short) = (length > MOST * full.length, length < LEAST * full.length.min(full_before));
            let can_merge = || {
                let held = self.model.support(side.nodes(count + 1)[0]).is_some();
                // the other element may be at an eye, too
                !held && !self.keeps_node_behind(side, length, 0) && count > reels.sides().count()
            };
            if !(splits || short && can_merge()) {
                return Ok(());
            }
            let energy = self.energy().total();
            let most = energy + self.energy_to_add(side, full.length);
            let (differences, store) = (&self.snapshot.state.memory.differences, self.energy_in_store());
            let mut turned = Turned {
                side,
                q: self.positions().to_vec(),
                v: self.velocities().to_vec(),
                at_eye: self.elements()[e],
                before: inner.map(|e| self.elements()[e]),
                full,
                next: reels.element(self.number(e) + if side == Side::End { 1 } else { -1 }),
                rate: winding.extent[1],
                changes: (!differences.is_empty())
                    .then(|| [&differences.displacement, &differences.velocity].map(Vec::clone)),
                length_before: winding.length_before,
                rate_before: winding.extent[1] - winding.extent[2] * differences.step,
            };
            turned.vectors().for_each(|x| side.turn(x));
            if splits {
                self.split(turned)?;
            } else {
                self.merge(turned)?;
            }
            let curves = self.twisted_curves();
            self.settle(most, self.longest_wave().max(full.length / winding.extent[1].abs().max(PASSING_RATE)))?;
            self.follow_mesh(&curves);
            self.bound_store(store);
            let change = self.energy().total() - energy;
            if let Some(winding) = &mut self.snapshot.windings[side as usize] {
                winding.remeshed += change;
            }
        }
        Ok(())
    }

    /// Replaces the last `removed` elements before the eye by `elements`, ordered towards it, with
    /// the turned state that goes with them.
    fn replace_elements(&mut self, mut turned: Turned, removed: usize, elements: &[Element]) -> Result<(), Error> {
        let (before, added) = (self.nodes(), elements.len() as i64 - removed as i64);
        let side = turned.side;
        turned.vectors().for_each(|x| side.turn(x));
        let Turned { q, v, changes, .. } = turned;
        let mut model = self.model.clone();
        let inner = model.elements.len() - removed;
        match side {
            Side::End => drop(model.elements.splice(inner.., elements.iter().copied())),
            Side::Start => drop(model.elements.splice(..removed, elements.iter().rev().copied())),
        }
        let added_first = if side == Side::Start { added } else { 0 };
        let (number, curves) = (model.renumbering(before, added_first), self.twisted_curves());
        model.renumber(before, added_first);
        self.rebuild(model)?;
        (self.snapshot.state.q, self.snapshot.state.v) = (q, v);
        let memory = &mut self.snapshot.state.memory;
        for node in memory.torsion.iter_mut().flatten().flat_map(|twist| &mut twist.nodes) {
            *node = number(*node);
        }
        self.follow_mesh(&curves);
        let memory = &mut self.snapshot.state.memory;
        memory.acceleration.clear();
        memory.algorithmic.clear();
        let (step, differences) = (memory.step, core::mem::take(&mut memory.differences));
        let (mut contacts, mut pairs) = (core::mem::take(&mut memory.contacts), core::mem::take(&mut memory.pairs));
        self.disturb();
        let moved = |element: usize| match side {
            Side::End => Some(element).filter(|&e| e < inner),
            Side::Start => element.checked_sub(removed).map(|e| e + elements.len()),
        };
        let lost =
            renumber(&mut contacts, |contact| contact, moved) + renumber(&mut pairs, |pair| &mut pair.contact, moved);
        let memory = &mut self.snapshot.state.memory;
        (memory.contacts, memory.pairs) = (contacts, pairs);
        self.snapshot.law.contacts += lost;
        // the length of steps is still a good proposal
        memory.step = step;
        if let Some([displacement, velocity]) = changes {
            memory.differences = Differences { displacement, velocity, ..differences };
        }
        if let Some(winding) = &mut self.snapshot.windings[side as usize] {
            winding.length_before += elements[elements.len() - 1].length - winding.extent[0];
            winding.extent[0] = elements[elements.len() - 1].length;
            if added > 0 { winding.splits += 1 } else { winding.merges += 1 }
        }
        self.sync_reel();
        Ok(())
    }

    /// Makes the memory of the discrete gradient hold no more than an energy in J; what it holds
    /// less is dissipated.
    fn bound_store(&mut self, most: f64) {
        let held = self.energy_in_store();
        let differences = &mut self.snapshot.state.memory.differences;
        if held > most {
            let share = (most / held).sqrt();
            let Differences { velocity, displacement, .. } = differences;
            velocity.iter_mut().chain(displacement).for_each(|x| *x *= share);
            if self.energy_in_store() > most {
                // what flows does not scale
                self.snapshot.state.memory.differences.clear();
                self.sync_reel();
            }
        }
        self.snapshot.law.numerical += most - self.energy_in_store();
    }

    fn split(&mut self, mut turned: Turned) -> Result<(), Error> {
        let Turned { at_eye: Element { length, .. }, full, next, rate, length_before, rate_before, .. } = turned;
        let Turned { q, v, changes, .. } = &mut turned;
        let e = q.len() / 6 - 2;
        // the particle at `full` from the far node: position and slope, and their rates
        let particle = |q: &[f64], v: &[f64], length: f64, rate: f64| {
            let xi = full.length / length;
            let [w, w_y] = feed_weights(xi, length);
            [shape::position(xi, length), shape::slope(xi, length)].into_iter().zip([w, w_y]).fold(
                [Vec::new(), Vec::new()],
                |[mut r, mut u], (s, w)| {
                    r.extend(combine(q, e, &s).iter());
                    u.extend((combine(v, e, &s) + rate * combine(q, e, &w)).iter());
                    [r, u]
                },
            )
        };
        let at = 6 * (e + 1);
        let node = particle(q, v, length, rate);
        if let Some([dq, dv]) = changes {
            let before = |x: &[f64], d: &[f64]| x.iter().zip(d).map(|(x, d)| x - d).collect::<Vec<_>>();
            let old = particle(&before(q, dq), &before(v, dv), length_before, rate_before);
            for ((list, node), old) in [dq, dv].into_iter().zip(&node).zip(&old) {
                list.splice(at..at, before(node, old));
            }
        }
        for (list, node) in [q, v].into_iter().zip(node) {
            list.splice(at..at, node);
        }
        self.replace_elements(turned, 1, &[full, Element { length: length - full.length, ..next }])
    }

    fn merge(&mut self, mut turned: Turned) -> Result<(), Error> {
        let Turned { side, at_eye: gone, before: Some(kept), rate, .. } = turned else { return Ok(()) };
        let e = turned.q.len() / 6 - 3;
        let whole = Element { length: kept.length + gone.length, ..kept };
        let (old_q, old_v) = (turned.q.clone(), turned.v.clone());
        turned.vectors().for_each(|x| drop(x.drain(6 * (e + 1)..6 * (e + 2))));
        let Turned { q, v, .. } = &mut turned;
        let bend = |q: &[f64], e: usize, length: f64| combine(q, e, &shape::second_derivative(1.0, length));
        let bent = rate * (bend(q, e, whole.length) - bend(&old_q, e + 1, gone.length));
        let mut at_eye = [0.0; 6];
        at_eye[3..].copy_from_slice(bent.as_slice());
        // a clamp holds its direction
        let held = self.model.support(side.nodes(self.nodes())[1]).filter(|support| !support.attached);
        held.iter().for_each(|support| support.project(&mut at_eye));
        let eye = v.len() - 6;
        (3..6).for_each(|x| v[eye + x] += at_eye[x]);
        // what the new velocities miss of the old momentum
        let inertia = self.model.inertia(&kept);
        let mut missed = vec![0.0; v.len()];
        for (from, part, element) in [(0.0, e, kept), (kept.length, e + 1, gone)] {
            for (x, g) in gauss_legendre(6) {
                let mut old: Vector3<f64> = combine(&old_v, part, &shape::position(x, element.length));
                if part > e {
                    old += rate * combine(&old_q, part, &feed_weights(x, element.length)[0]);
                }
                let xi = (from + x * element.length) / whole.length;
                let s = shape::position(xi, whole.length);
                let new = combine(v, e, &s) + rate * combine(q, e, &feed_weights(xi, whole.length)[0]);
                for k in 0..4 {
                    for i in 0..3 {
                        missed[6 * e + 3 * k + i] += g * element.length * inertia * s[k] * (old - new)[i];
                    }
                }
            }
        }
        side.turn(&mut missed);
        let angular = self.momentum().angular;
        self.replace_elements(turned, 2, &[whole])?;
        self.take_up(missed)?;
        self.keep_angular_momentum(&angular);
        Ok(())
    }

    /// Changes velocities by an impulse on all coordinates, but those that supports hold.
    pub(super) fn take_up(&mut self, mut impulse: Vec<f64>) -> Result<(), Error> {
        // nodes on bodies move with them: the next step of the island shares their jump with the
        // bodies
        let mut free = self.model.clone();
        free.supports.retain(|(_, support)| !support.attached);
        let outcome = self.system.factor_mass(&free).and_then(|()| {
            project_vector(&free, &mut impulse);
            self.system.mass.solve(self.system.level, &mut impulse);
            self.system.factor_mass(&self.model)
        });
        outcome.map_err(|failure| self.step_failed(self.time(), 0.0, failure))?;
        self.snapshot.state.v.iter_mut().zip(&impulse).for_each(|(v, d)| *v += d);
        Ok(())
    }
}
