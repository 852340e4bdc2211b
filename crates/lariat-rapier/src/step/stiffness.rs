//! What the taut cables of a body do to it when something displaces it.
//!
//! # Equation
//! ```text
//! K = sum over the parts of its cables:   EA/l e e^T + T/d (I - e e^T)
//! ```
//! A part is what lies between a pin of the body and a held end of its cable: l its length, e the
//! chord of its element next to the pin, d the length and T the tension of that.
//!
//! # Validity
//! An upper bound where nothing between pin and end is held, but for the bending of the cable. The
//! body is displaced without being turned. What may become taut within the step counts: a cable
//! that sags gives way ([`substepping`](super::substepping)).
//!
//! # References
//! The stiffness matrix of a bar with its geometric part: Bathe, Finite Element Procedures, ch. 6.

use crate::contents::attachment::Attachment;
use crate::scales::step::SLACK_SHARE;
use ::nalgebra::{Matrix3, Vector3};
use lariat_ancf::{At, Cable, Element};

/// The stiffness of the cables of a body, in N/m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stiffness {
    matrix: Matrix3<f64>,
    /// Upper bound in any direction: as if all pulled along one line.
    pub sum: f64,
}

impl Stiffness {
    /// Returns that of the cables that may be taut within `dt` (s), if the body moves by `change`
    /// (m) beside its present motion.
    pub fn of<'a>(parts: impl Iterator<Item = &'a Part>, (dt, change): (f64, f64)) -> Self {
        let mut stiffness = Stiffness { matrix: Matrix3::zeros(), sum: 0.0 };
        for part in parts.filter(|part| part.speed * dt + change > SLACK_SHARE * part.slack) {
            let along = part.direction * part.direction.transpose();
            stiffness.matrix += along * part.axial + (Matrix3::identity() - along) * part.lateral;
            stiffness.sum += part.axial + part.lateral;
        }
        stiffness
    }

    /// Returns that along a direction of length 1.
    pub fn along(&self, direction: &Vector3<f64>) -> f64 {
        direction.dot(&(self.matrix * direction))
    }
}

/// The part of a cable between a node and a held end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Of its chord at the node, of length 1; 0 if that has none.
    direction: Vector3<f64>,
    /// Upper bounds of its stiffness in N/m along this direction, and across.
    axial: f64,
    lateral: f64,
    /// Its length without strain less its chord, in m.
    slack: f64,
    /// Relative speed of its ends in m/s.
    speed: f64,
}

/// Returns length in m and compliance in m/N of an element.
pub(super) fn length_and_compliance(e: &Element) -> [f64; 2] {
    [e.length, e.length / e.section.axial_stiffness]
}

/// Returns the parts of a cable between an attachment and the held ends; `between` gives length in
/// m and compliance in m/N of the elements between two nodes, the first before the second.
pub(super) fn parts<'a, F: Fn(usize, usize) -> [f64; 2] + 'a>(
    cable: &'a Cable,
    a: &Attachment,
    between: F,
) -> impl Iterator<Item = Part> + use<'a, F> {
    let velocity = |n: usize| Vector3::from_column_slice(&cable.velocities()[6 * n..6 * n + 3]);
    let last = cable.elements().len();
    // the number may be that of before a change of the cable
    let node = a.node.min(last);
    let held = |end: usize| cable.support(At::Node(end)).is_ok_and(|s| s.attached || s.position.is_some());
    [0, last].into_iter().filter(move |end| *end != node && held(*end)).map(move |end| {
        let [length, compliance] = between(node.min(end), node.max(end));
        let chord = (cable.node_position(node) - cable.node_position(end)).norm();
        let (next, near) = if end < node { (node - 1, node - 1) } else { (node + 1, node) };
        let (beside, near) = (cable.node_position(next) - cable.node_position(node), &cable.elements()[near]);
        let tension = near.section.axial_stiffness * (beside.norm() / near.length - 1.0);
        Part {
            direction: beside.try_normalize(0.0).unwrap_or_default(),
            axial: 1.0 / compliance,
            lateral: tension.max(0.0) / near.length,
            slack: length - chord,
            speed: (velocity(node) - velocity(end)).norm(),
        }
    })
}
