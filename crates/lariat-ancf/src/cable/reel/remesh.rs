//! Splitting and merging the element at the eye of a reel.
//!
//! # Equation
//!
//! *Split* above 1.6 of its full length h: the node at y = h takes position, slope and velocities of the particle there,
//! `r = S e`, `r' = S e' + l' w`, `t' = S_y e' + l' w_y`, so shape, mass, momentum and kinetic energy stay to rounding.
//!
//! *Merge* below 0.4 h with the element before: the outer nodes keep position and slope, so the pull at the eye does not jump; the
//! slope there keeps the rate of its particle, `t' + l' (r''_new - r''_old)`. Then the velocities take the jump of the momentum,
//!
//! ```text
//! v += M^-1 rho int S^T (v_old - S e' - l' w_new) dy          over all free coordinates
//! ```
//!
//! which is a projection in the norm of the mass: momentum stays but for the impulse on supports, and kinetic energy falls but for the
//! product of `v_old - v_new` with l' w_new, of the order of the waves that the mesh does not resolve. Where the energy is then more than
//! before, nodes [move](super::settle). The change of the whole energy is on the account [`remeshed`](super::ReelReading::remeshed).
//!
//! At the start of a cable the same is done to the reversed one.
//!
//! # Validity
//!
//! A node that is held, or between elements of different sections, is not merged away: the reel stops before it.
//!
//! # Alternatives considered
//!
//! Merging by deleting the node: loses up to 2 % of the momentum, and feeds waves of the mesh. Splitting at 1.5 and merging at 0.5:
//! no hysteresis, it chatters.

use super::plan::LEAST;
use crate::cable::Cable;
use crate::cable::sample::combine;
use crate::element::flow::flow_weights;
use crate::element::shape;
use crate::element::side::Side;
use crate::error::Error;
use crate::quadrature::gauss_legendre;
use crate::section::Element;
use crate::system::project_vector;
use nalgebra::Vector3;

/// Length above which the element at the eye is split, as a share of its full length.
const MOST: f64 = 1.6;
/// Rate in m/s below which the time in which an element passes the eye is not asked for.
const LEAST_RATE: f64 = 1e-3;
/// Largest number of splits in a part of a host step.
const MOST_SPLITS: usize = 100;

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
}

impl Cable {
    /// Splits or merges the elements at the eyes of reels where their lengths ask for it; does nothing without a reel.
    /// [`step`](Self::step) does so by itself. Between the steps of an [`Island`](crate::island::Island) the caller does, because the
    /// numbers of nodes change: at a reel at the end that of the eye, at one at the start all others
    /// ([`nodes_from_start`](Self::nodes_from_start)).
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix of the new mesh is singular.
    pub fn remesh_reel(&mut self) -> Result<(), Error> {
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
            let held = self.model.support(side.nodes(count + 1)[0]).is_some();
            // the other element may be at an eye, too
            let can_merge = !held && count > reels.sides().count();
            let length = self.elements()[e].length;
            let splits = length > MOST * full.length;
            let merges = can_merge && length < LEAST * full.length.min(full_before);
            if !splits && !merges {
                return Ok(());
            }
            let energy = self.energy().total();
            let most = energy + self.energy_to_add(side, full.length);
            let mut turned = Turned {
                side,
                q: self.positions().to_vec(),
                v: self.velocities().to_vec(),
                at_eye: self.elements()[e],
                before: inner.map(|e| self.elements()[e]),
                full,
                next: reels.element(self.number(e) + if side == Side::End { 1 } else { -1 }),
                rate: winding.extent[1],
            };
            [&mut turned.q, &mut turned.v].into_iter().for_each(|x| side.turn(x));
            if splits {
                self.split(turned)?;
            } else {
                self.merge(turned)?;
            }
            self.settle(most, self.longest_wave().max(full.length / winding.extent[1].abs().max(LEAST_RATE)))?;
            let change = self.energy().total() - energy;
            if let Some(winding) = &mut self.snapshot.windings[side as usize] {
                winding.remeshed += change;
            }
        }
        Ok(())
    }

    /// Replaces the last `removed` elements before the eye by `elements`, ordered towards it, with the turned state that goes with them.
    fn replace_elements(&mut self, turned: Turned, removed: usize, elements: &[Element]) -> Result<(), Error> {
        let Turned { side, mut q, mut v, .. } = turned;
        let (before, added) = (self.nodes(), elements.len() as i64 - removed as i64);
        let mut model = self.model.clone();
        let inner = model.elements.len() - removed;
        match side {
            Side::End => drop(model.elements.splice(inner.., elements.iter().copied())),
            Side::Start => drop(model.elements.splice(..removed, elements.iter().rev().copied())),
        }
        model.renumber(before, if side == Side::Start { added } else { 0 });
        [&mut q, &mut v].into_iter().for_each(|x| side.turn(x));
        self.rebuild(model)?;
        (self.snapshot.state.q, self.snapshot.state.v) = (q, v);
        let memory = &mut self.snapshot.state.memory;
        memory.acceleration.clear();
        memory.algorithmic.clear();
        let step = memory.step;
        self.disturb();
        // the length of steps is still a good proposal
        self.snapshot.state.memory.step = step;
        if let Some(winding) = &mut self.snapshot.windings[side as usize] {
            winding.extent[0] = elements[elements.len() - 1].length;
            winding.length_before = winding.extent[0];
            if added > 0 { winding.splits += 1 } else { winding.merges += 1 }
        }
        self.sync_reel();
        Ok(())
    }

    fn split(&mut self, mut turned: Turned) -> Result<(), Error> {
        let Turned { q, v, at_eye: Element { length, .. }, full, next, rate, .. } = &mut turned;
        let (length, full, next, rate) = (*length, *full, *next, *rate);
        let e = q.len() / 6 - 2;
        let xi = full.length / length;
        let [w, w_y] = flow_weights(xi, length);
        let (s, s_y) = (shape::position(xi, length), shape::slope(xi, length));
        let node_q = [combine(q, e, s), combine(q, e, s_y)];
        let node_v = [combine(v, e, s) + rate * combine(q, e, w), combine(v, e, s_y) + rate * combine(q, e, w_y)];
        let at = 6 * (e + 1);
        q.splice(at..at, node_q.iter().flatten().copied());
        v.splice(at..at, node_v.iter().flatten().copied());
        self.replace_elements(turned, 1, &[full, Element { length: length - full.length, ..next }])
    }

    fn merge(&mut self, mut turned: Turned) -> Result<(), Error> {
        let Turned { side, at_eye: gone, before: Some(kept), rate, .. } = turned else { return Ok(()) };
        let e = turned.q.len() / 6 - 3;
        let whole = Element { length: kept.length + gone.length, ..kept };
        let (old_q, old_v) = (turned.q.clone(), turned.v.clone());
        let Turned { q, v, .. } = &mut turned;
        let removed = 6 * (e + 1)..6 * (e + 2);
        q.drain(removed.clone());
        v.drain(removed);
        let bend = |q: &[f64], e: usize, length: f64| combine(q, e, shape::second_derivative(1.0, length));
        let bent = rate * (bend(q, e, whole.length) - bend(&old_q, e + 1, gone.length));
        let eye = v.len() - 3;
        (0..3).for_each(|x| v[eye + x] += bent[x]);
        // what the new velocities miss of the old momentum
        let inertia = self.model.inertia(&kept);
        let mut missed = vec![0.0; v.len()];
        for (from, part, element) in [(0.0, e, kept), (kept.length, e + 1, gone)] {
            for (x, g) in gauss_legendre(6) {
                let mut old: Vector3<f64> = combine(&old_v, part, shape::position(x, element.length));
                if part > e {
                    old += rate * combine(&old_q, part, flow_weights(x, element.length)[0]);
                }
                let xi = (from + x * element.length) / whole.length;
                let s = shape::position(xi, whole.length);
                let new = combine(v, e, s) + rate * combine(q, e, flow_weights(xi, whole.length)[0]);
                for k in 0..4 {
                    for i in 0..3 {
                        missed[6 * e + 3 * k + i] += g * element.length * inertia * s[k] * (old - new)[i];
                    }
                }
            }
        }
        side.turn(&mut missed);
        self.replace_elements(turned, 2, &[whole])?;
        self.take_up(missed)
    }

    /// Changes velocities by an impulse on all coordinates, but those that supports hold.
    pub(super) fn take_up(&mut self, mut impulse: Vec<f64>) -> Result<(), Error> {
        // nodes on bodies move with them: the next step of the island shares their jump with the bodies
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
