//! Elements folded on themselves: numerical equilibria that are not physical configurations of a
//! cable.
//!
//! # Equation
//!
//! The strain that an element projects on linear functions vanishes not only where the element has
//! its own length: along a line, with P_k the Legendre polynomials on the element, `r' = (1/3 - 3/2
//! P_1 - 5/6 P_2) e` (the far slope is -2 e, the chord a third of the length) has mean square 1 and
//! no first moment, and so has `r' = sqrt(5) P_2 e`. Only the small share of the exact strain
//! resists, so such a shape can be in equilibrium. An element is folded if the slope of a node
//! points backwards in every element of the node, or if the element runs backwards in its middle
//! while its ends run forwards.
//!
//! A straight element of this rule folds by itself where it is compressed by more than its share
//! delta of the exact energy: the stiffness of `r' = f + x P_2` is EA (delta f^2 + eps). A thick
//! cable folds without bending, and may run backwards from there on. So, with bending stiffness,
//! the slope at a clamp must point along the clamp, and the tangent of an element with EI/(EA
//! l^2) > 1e-4 must turn by less than 90 degrees in each quarter of it: no beam turns more, its
//! surface would be strained by 13 % or more.
//!
//! # Validity
//!
//! A sharp bend (a cable without bending stiffness around one node, a loop that closes within one
//! element) is not folded: there the slope is across the chords. Slopes that a support holds are
//! not judged.

use super::self_stress::first_self_stress;
use crate::cable::Cable;
use crate::element::shape;
use crate::model::Model;
use crate::rule::BendingRule;
use crate::scales::statics::{BACKWARD_COSINE, MIN_SLOPE, REVERSED_STRETCH, THICK};
use crate::section::Element;
use crate::support::SlopeSupport;
use nalgebra::Vector3;

fn vector(q: &[f64], at: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&q[at..at + 3])
}

/// Returns whether `t` points backwards along `chord`.
fn is_backward(t: &Vector3<f64>, chord: &Vector3<f64>) -> bool {
    t.dot(chord) < BACKWARD_COSINE * t.norm() * chord.norm()
}

/// Returns the chord of an element.
fn chord(q: &[f64], e: usize) -> Vector3<f64> {
    vector(q, 6 * e + 6) - vector(q, 6 * e)
}

/// Returns whether the slope of a node points backwards in every element of the node.
fn is_reversed(model: &Model, q: &[f64], node: usize) -> bool {
    let held = model.support(node).is_some_and(|s| s.slope != SlopeSupport::Free);
    let t = vector(q, 6 * node + 3);
    !held
        && (node == 0 || is_backward(&t, &chord(q, node - 1)))
        && (node + 1 == model.nodes() || is_backward(&t, &chord(q, node)))
}

/// Returns whether an element runs backwards in its middle while its ends run forwards.
fn is_buckled(model: &Model, q: &[f64], e: usize) -> bool {
    let weights = shape::slope(0.5, model.elements[e].length);
    let middle: Vector3<f64> = (0..4).map(|k| weights[k] * vector(q, 6 * e + 3 * k)).sum();
    let ends = vector(q, 6 * e + 3) + vector(q, 6 * e + 9);
    is_backward(&middle, &chord(q, e)) || is_backward(&middle, &ends)
}

/// Returns whether the tangent of a thick element turns by more than 90 degrees within a quarter of
/// it.
fn is_cusped(model: &Model, q: &[f64], e: usize) -> bool {
    let Element { length, section } = model.elements[e];
    let bends = model.rule.bending != BendingRule::None;
    if !bends || section.bending_stiffness <= THICK * section.axial_stiffness * length * length {
        return false;
    }
    let tangent = |quarter: u8| -> Vector3<f64> {
        let weights = shape::slope(0.25 * f64::from(quarter), length);
        (0..4).map(|k| weights[k] * vector(q, 6 * e + 3 * k)).sum()
    };
    (0..4).any(|quarter| tangent(quarter).dot(&tangent(quarter + 1)) <= 0.0)
}

/// Returns whether the slope at a clamp points against it, on a cable that bends.
fn is_clamped_backwards(model: &Model, q: &[f64], node: usize) -> bool {
    let e = node.min(model.elements.len() - 1);
    let bends = model.rule.bending != BendingRule::None && model.elements[e].section.bending_stiffness > 0.0;
    let along = |d: &Vector3<f64>| d.dot(&vector(q, 6 * node + 3));
    match model.support(node).map(|support| &support.slope) {
        Some(SlopeSupport::Direction(d) | SlopeSupport::Attached(d)) => bends && along(d) < REVERSED_STRETCH,
        _ => false,
    }
}

/// Returns the first element that is folded, by its slopes or as one that [strains
/// itself](super::self_stress).
pub(crate) fn first_fold(cable: &Cable, q: &[f64]) -> Option<usize> {
    first_folded(&cable.model, q).or_else(|| first_self_stress(cable, q))
}

/// Returns the first element that is folded by its slopes.
fn first_folded(model: &Model, q: &[f64]) -> Option<usize> {
    let reversed = |&i: &usize| is_reversed(model, q, i) || is_clamped_backwards(model, q, i);
    let node = (0..model.nodes()).find(reversed).map(|i| i.min(model.elements.len() - 1));
    node.or_else(|| (0..model.elements.len()).find(|&e| is_buckled(model, q, e) || is_cusped(model, q, e)))
}

/// Sets the free slopes of folded elements along the chords, with the stretch of the chords, and
/// those of one that [strains itself](super::self_stress), if there is one.
pub(crate) fn straighten(cable: &Cable, q: &mut [f64]) {
    let (model, strained) = (&cable.model, first_self_stress(cable, q));
    for node in 0..model.nodes() {
        let elements = node.saturating_sub(1)..(node + 1).min(model.elements.len());
        let folded =
            is_reversed(model, q, node) || elements.clone().any(|e| is_buckled(model, q, e) || Some(e) == strained);
        let held = model.support(node).is_some_and(|s| s.slope != SlopeSupport::Free);
        let along = elements.clone().map(|e| chord(q, e)).sum::<Vector3<f64>>();
        let length: f64 = elements.map(|e| model.elements[e].length).sum();
        if folded && !held && along.norm() > 0.0 {
            q[6 * node + 3..6 * node + 6]
                .copy_from_slice((along.normalize() * (along.norm() / length).max(MIN_SLOPE)).as_slice());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{At, Cable, Section};

    /// Three elements of 1 m along x from the origin.
    fn cable() -> Cable {
        Cable::builder()
            .points([Vector3::zeros(), 3.0 * Vector3::x()])
            .section(Section::from_stiffness(1e4, 1.0, 1.0).unwrap())
            .elements(3)
            .build()
            .unwrap()
    }

    /// The two folds of the module page are found, at an end and within the cable, and
    /// straightened.
    ///
    /// *Source.* Their r' is given there; the middle of sqrt(5) P_2 runs backwards at half of the
    /// ends' speed, and its chord is 0: here with the chord 0.3, r' = 0.3 + 2.13 P_2.
    #[test]
    fn folds_are_found_and_straightened() {
        let mut flipped = cable();
        flipped.snapshot.state.q[18] = 2.0 + 1.0 / 3.0;
        flipped.snapshot.state.q[21] = -2.0;
        let mut buckled = cable();
        for (at, x) in [(12, 1.3), (18, 2.3), (9, 2.43), (15, 2.43)] {
            buckled.snapshot.state.q[at] = x;
        }
        for (mut cable, element) in [(flipped, 2), (buckled, 1)] {
            assert_eq!(first_folded(&cable.model, cable.positions()), Some(element));
            let mut q = cable.positions().to_vec();
            straighten(&cable, &mut q);
            cable.snapshot.state.q = q;
            assert_eq!(first_folded(&cable.model, cable.positions()), None);
        }
    }

    /// A hairpin within one element, a corner at a node, and a clamp against the chord are bends,
    /// not folds.
    ///
    /// *Source.* Their slopes are across the chords, or held.
    #[test]
    fn sharp_bends_are_not_folds() {
        let mut hairpin = cable();
        // down, round, and up
        let nodes = [[0.0, 0.0, 0.0, -1.0], [0.0, -1.0, 0.0, -1.0], [0.3, -1.0, 0.0, 1.0], [0.3, 0.0, 0.0, 1.0]];
        for (i, [x, y, dx, dy]) in nodes.into_iter().enumerate() {
            hairpin.snapshot.state.q[6 * i..6 * i + 6].copy_from_slice(&[x, y, 0.0, dx, dy, 0.0]);
        }
        assert_eq!(first_folded(&hairpin.model, hairpin.positions()), None);
        let mut corner = cable();
        let nodes = [[0.0, 0.0, 0.0, -1.0], [0.0, -1.0, 1.2, 0.0], [0.1, 0.0, 0.0, 1.0], [0.1, 1.0, 0.0, 1.0]];
        for (i, [x, y, dx, dy]) in nodes.into_iter().enumerate() {
            corner.snapshot.state.q[6 * i..6 * i + 6].copy_from_slice(&[x, y, 0.0, dx, dy, 0.0]);
        }
        assert_eq!(first_folded(&corner.model, corner.positions()), None);
        let mut clamped = cable();
        let support = crate::Support { slope: SlopeSupport::Direction(-Vector3::x()), ..crate::Support::default() };
        clamped.set_support(At::Start, support).unwrap();
        clamped.snapshot.state.q[3] = -1.0;
        assert_eq!(first_folded(&clamped.model, clamped.positions()), None);
    }
}
