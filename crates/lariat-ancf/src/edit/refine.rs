//! A new node on a cable, without changing its shape or motion.
//!
//! # Equation
//!
//! The element is split at xi; the new node gets the position and the slope dr/ds that the element
//! has there, and their rates. A cubic is its own Hermite interpolant on any part, so both parts
//! reproduce it exactly: strains, momenta and kinetic energy stay to rounding. Elastic energy stays
//! where the rule integrates it exactly, else it changes by the error of the rule, because the rule
//! of two elements sees more of the strain than that of one. With the projected axial rule, eps the
//! Green strain and P its projection on linear functions of the whole element,
//!
//! ```text
//! 0 <= U' - U <= (1 - delta) EA/2 int (eps - P eps)^2 dx
//! ```
//!
//! since both parts together project on a larger space. The change is recorded:
//! [`Cable::inserted_energy`](crate::coupling::Coupling::inserted_energy).
//!
//! # Validity
//!
//! Any element; a split near a node leaves a short, stiff element, which makes explicit methods
//! slow.
//!
//! # References
//!
//! de Casteljau's subdivision; Pythagoras' theorem for the projections.
//!
//! # Alternatives considered
//!
//! A new node off the curve, where the energy is that of before: shape and angular momentum would
//! jump instead.

use crate::at::At;
use crate::cable::Cable;
use crate::element::shape::{self, combine};
use crate::error::Error;
use crate::section::Element;
use crate::state::{State, renumber};

impl Cable {
    /// Returns the node at a point, and places one if none is within 1e-9 of the length. Nodes
    /// behind it move up by one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the point is not on the cable, [`Error::NotWithReel`] if it is in
    /// the element at a reel.
    pub fn insert_node(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        let s = self.arc_length(at)?;
        if let Ok(node) = self.node(At::ArcLength(s)) {
            return Ok(node);
        }
        let (e, xi) = self.model.locate(s);
        let node = e + 1;
        if self.model.reels.sides().any(|side| side.element(self.elements().len()) == e) {
            return Err(Error::NotWithReel {
                cable: self.name().to_string(),
                what: "a new node in the element at the eye",
            });
        }
        let mut model = self.model.clone();
        let whole = model.elements[e];
        model.elements[e] = Element { length: xi * whole.length, ..whole };
        model.elements.insert(node, Element { length: (1.0 - xi) * whole.length, ..whole });
        if self.has_reel() {
            model.reels.refine(self.number(e), [model.elements[e], model.elements[node]]);
        }
        model.supports.iter_mut().filter(|(n, _)| *n >= node).for_each(|(n, _)| *n += 1);
        model.effects.refine(e, xi);
        let strain_energy = |cable: &Cable| {
            let (axial, bending) = cable.system.forces.strain_energy(cable.positions());
            axial + bending
        };
        let before = strain_energy(self);
        let mut snapshot = self.snapshot.clone();
        let cut = |x: &mut Vec<f64>| {
            let [r, t] = [shape::position, shape::slope].map(|of| combine(x, e, &of(xi, whole.length)));
            x.splice(6 * node..6 * node, r.iter().chain(t.iter()).copied());
        };
        snapshot.prescribed.iter_mut().filter(|led| led.node >= node).for_each(|led| led.node += 1);
        let State { q, v, memory, .. } = &mut snapshot.state;
        cut(q);
        cut(v);
        memory.acceleration.clear();
        memory.algorithmic.clear();
        memory.valid = false;
        // contacts of the element that is split are found anew
        let number = |element: usize| (element != e).then_some(element + usize::from(element > e));
        renumber(&mut memory.contacts, |contact| contact, number);
        // the twist of a segment is that of its material, whatever its elements
        for held in memory.torsion.iter_mut().flatten().flat_map(|twist| &mut twist.nodes) {
            *held += usize::from(*held >= node);
        }
        if !memory.differences.is_empty() {
            cut(&mut memory.differences.velocity);
            cut(&mut memory.differences.displacement);
        }
        let mut cable = Cable::from_parts(model, snapshot, self.integrator)?;
        cable.diagnostics = self.diagnostics;
        cable.watch = self.watch.take();
        cable.default_integrator = self.default_integrator;
        cable.revision = self.revision;
        cable.snapshot.inserted_energy += strain_energy(&cable) - before;
        cable.revise();
        *self = cable;
        Ok(node)
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn inserted_energy(&self) -> f64 {
        self.snapshot.inserted_energy
    }
}
