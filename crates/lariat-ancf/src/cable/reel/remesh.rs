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
//! product of `v_old - v_new` with l' w_new, of the order of the waves that the mesh does not resolve. The change of the whole energy is
//! on the account [`remeshed`](super::ReelReading::remeshed).
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
use crate::error::Error;
use crate::quadrature::gauss_legendre;
use crate::section::Element;
use crate::system::project_vector;
use nalgebra::Vector3;

/// Length above which the element at the eye is split, as a share of its full length.
const MOST: f64 = 1.6;
/// Largest number of splits in a part of a host step.
const MOST_SPLITS: usize = 100;

impl Cable {
    /// Splits or merges the element at the eye of the reel where its length asks for it; does nothing without a reel.
    /// [`step`](Self::step) does so by itself. Between the steps of an [`Island`](crate::island::Island) the caller does, because the
    /// number of the node at the eye changes.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix of the new mesh is singular.
    pub fn remesh_reel(&mut self) -> Result<(), Error> {
        for _ in 0..MOST_SPLITS {
            let Some(own) = &self.model.reel else { return Ok(()) };
            let last = self.elements().len() - 1;
            let (length, full) = (self.elements()[last].length, own.element(last).length);
            let before = last.checked_sub(1).map_or(0.0, |e| own.element(e).length);
            let energy = self.energy().total();
            if length > MOST * full {
                self.split()?;
            } else if length < LEAST * full.min(before) && self.model.support(last).is_none() {
                self.merge()?;
            } else {
                return Ok(());
            }
            let change = self.energy().total() - energy;
            if let Some(winding) = &mut self.snapshot.winding {
                winding.remeshed += change;
            }
        }
        Ok(())
    }

    /// Replaces the mesh from the element `first` on, with the state that goes with it.
    fn replace_elements(&mut self, first: usize, elements: &[Element], q: Vec<f64>, v: Vec<f64>) -> Result<(), Error> {
        let eye = self.nodes() - 1;
        let mut model = self.model.clone();
        model.elements.truncate(first);
        model.elements.extend_from_slice(elements);
        let nodes = model.nodes();
        model.supports.iter_mut().filter(|(node, _)| *node == eye).for_each(|(node, _)| *node = nodes - 1);
        self.rebuild(model)?;
        (self.snapshot.state.q, self.snapshot.state.v) = (q, v);
        let memory = &mut self.snapshot.state.memory;
        memory.acceleration.clear();
        memory.algorithmic.clear();
        let step = memory.step;
        self.disturb();
        // the length of steps is still a good proposal
        self.snapshot.state.memory.step = step;
        if let Some(winding) = &mut self.snapshot.winding {
            winding.extent[0] = elements[elements.len() - 1].length;
            winding.length_before = winding.extent[0];
        }
        self.sync_reel();
        Ok(())
    }

    fn split(&mut self) -> Result<(), Error> {
        let (Some(own), Some(winding)) = (&self.model.reel, &mut self.snapshot.winding) else { return Ok(()) };
        let e = self.model.elements.len() - 1;
        let (full, next) = (own.element(e), own.element(e + 1));
        let length = self.model.elements[e].length;
        let (xi, rate) = (full.length / length, winding.extent[1]);
        winding.splits += 1;
        let [w, w_y] = flow_weights(xi, length);
        let (mut q, mut v) = (self.positions().to_vec(), self.velocities().to_vec());
        let (s, s_y) = (shape::position(xi, length), shape::slope(xi, length));
        let node_q = [combine(&q, e, s), combine(&q, e, s_y)];
        let node_v = [combine(&v, e, s) + rate * combine(&q, e, w), combine(&v, e, s_y) + rate * combine(&q, e, w_y)];
        let at = 6 * (e + 1);
        q.splice(at..at, node_q.iter().flatten().copied());
        v.splice(at..at, node_v.iter().flatten().copied());
        self.replace_elements(e, &[full, Element { length: length - full.length, ..next }], q, v)
    }

    fn merge(&mut self) -> Result<(), Error> {
        let Some(winding) = &mut self.snapshot.winding else { return Ok(()) };
        winding.merges += 1;
        let rate = winding.extent[1];
        let e = self.model.elements.len() - 2;
        let [kept, gone] = [self.model.elements[e], self.model.elements[e + 1]];
        let whole = Element { length: kept.length + gone.length, ..kept };
        let (old_q, old_v) = (self.positions().to_vec(), self.velocities().to_vec());
        let (mut q, mut v) = (old_q.clone(), old_v.clone());
        let removed = 6 * (e + 1)..6 * (e + 2);
        q.drain(removed.clone());
        v.drain(removed);
        let bend = |q: &[f64], e: usize, length: f64| combine(q, e, shape::second_derivative(1.0, length));
        let turned = rate * (bend(&q, e, whole.length) - bend(&old_q, e + 1, gone.length));
        let eye = v.len() - 3;
        (0..3).for_each(|x| v[eye + x] += turned[x]);
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
                let new = combine(&v, e, s) + rate * combine(&q, e, flow_weights(xi, whole.length)[0]);
                for k in 0..4 {
                    for i in 0..3 {
                        missed[6 * e + 3 * k + i] += g * element.length * inertia * s[k] * (old - new)[i];
                    }
                }
            }
        }
        self.replace_elements(e, &[whole], q, v)?;
        if let Err(failure) = self.system.factor_mass(&self.model) {
            return Err(self.step_failed(self.time(), 0.0, failure));
        }
        project_vector(&self.model, &mut missed);
        self.system.mass.solve(self.system.level, &mut missed);
        self.snapshot.state.v.iter_mut().zip(&missed).for_each(|(v, d)| *v += d);
        Ok(())
    }
}
