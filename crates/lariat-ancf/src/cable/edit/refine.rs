//! A new node on a cable, without changing its shape or motion.
//!
//! # Equation
//!
//! The element is split at xi; the new node gets the position and the slope dr/ds that the element has there, and their rates. A cubic is
//! its own Hermite interpolant on any part, so both parts reproduce it exactly: strains, momenta and kinetic energy stay to rounding,
//! elastic energy to the error of the rule.
//!
//! # Validity
//!
//! Any element; a split near a node leaves a short, stiff element, which makes explicit methods slow.
//!
//! # References
//!
//! de Casteljau's subdivision.

use crate::cable::{At, Cable};
use crate::element::shape;
use crate::error::Error;
use crate::integrate::State;
use crate::section::Element;
use nalgebra::Vector3;

impl Cable {
    /// Returns the node at a point, and places one if none is within 1e-9 of the length. Nodes behind it move up by one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the point is not on the cable.
    pub fn insert_node(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        let s = self.arc_length(at)?;
        if let Ok(node) = self.node(At::ArcLength(s)) {
            return Ok(node);
        }
        let (e, xi) = self.model.locate(s);
        let node = e + 1;
        let mut model = self.model.clone();
        let whole = model.elements[e];
        model.elements[e] = Element { length: xi * whole.length, ..whole };
        model.elements.insert(node, Element { length: (1.0 - xi) * whole.length, ..whole });
        model.supports.iter_mut().filter(|(n, _)| *n >= node).for_each(|(n, _)| *n += 1);
        model.effects.refine(e, xi);
        let mut snapshot = self.snapshot.clone();
        let cut = |x: &mut Vec<f64>| {
            let point = |weights: [f64; 4]| -> Vector3<f64> {
                (0..4).map(|k| weights[k] * Vector3::from_column_slice(&x[6 * e + 3 * k..6 * e + 3 * k + 3])).sum()
            };
            let (r, t) = (point(shape::position(xi, whole.length)), point(shape::slope(xi, whole.length)));
            x.splice(6 * node..6 * node, r.iter().chain(t.iter()).copied());
        };
        let State { q, v, memory, .. } = &mut snapshot.state;
        cut(q);
        cut(v);
        memory.acceleration.clear();
        memory.algorithmic.clear();
        memory.valid = false;
        if !memory.differences.is_empty() {
            cut(&mut memory.differences.velocity);
            cut(&mut memory.differences.displacement);
        }
        let mut cable = Cable::from_parts(model, snapshot, self.integrator)?;
        cable.diagnostics = self.diagnostics;
        cable.default_integrator = self.default_integrator;
        cable.revision = self.revision;
        cable.revise();
        *self = cable;
        Ok(node)
    }
}
