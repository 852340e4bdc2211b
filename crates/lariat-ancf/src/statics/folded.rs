//! Elements folded on themselves: shapes that balance and are no cable.
//!
//! The strain that an element projects on linear functions vanishes not only where the element has its own length:
//! along a line, with P_k the Legendre polynomials on the element, `r' = (1/3 - 3/2 P_1 - 5/6 P_2) e` (the far slope
//! is -2 e, the chord a third of the length) has mean square 1 and no first moment, and so has `r' = sqrt(5) P_2 e`.
//! Only the small share of the exact strain resists, so such a shape can rest in equilibrium. A node whose slope
//! points backwards in every element that meets there, or an element that runs backwards in its middle while its ends
//! run forwards, is none that a cable takes.
//!
//! *Validity.* A sharp bend (a limp cable round one node, a loop that closes within one element) is not folded: there
//! the slope is across the chords. Slopes that a support holds are the user's.

use crate::element::shape;
use crate::model::Model;
use crate::support::SlopeSupport;
use nalgebra::Vector3;

/// Cosine of the angle between slope and chord below which the slope points backwards.
const BACKWARDS: f64 = -0.05;
/// Shortest slope that a fold is straightened to.
const SHORTEST: f64 = 0.1;

fn vector(q: &[f64], at: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&q[at..at + 3])
}

/// True if `t` points backwards along `chord`.
fn against(t: &Vector3<f64>, chord: &Vector3<f64>) -> bool {
    t.dot(chord) < BACKWARDS * t.norm() * chord.norm()
}

/// Chord of an element.
fn chord(q: &[f64], e: usize) -> Vector3<f64> {
    vector(q, 6 * e + 6) - vector(q, 6 * e)
}

/// True if the slope of a node points backwards in every element that meets there.
fn flipped(model: &Model, q: &[f64], node: usize) -> bool {
    let held = model.support(node).is_some_and(|s| s.slope != SlopeSupport::Free);
    let t = vector(q, 6 * node + 3);
    !held
        && (node == 0 || against(&t, &chord(q, node - 1)))
        && (node + 1 == model.nodes() || against(&t, &chord(q, node)))
}

/// True if an element runs backwards in its middle while its ends run forwards.
fn buckled(model: &Model, q: &[f64], e: usize) -> bool {
    let weights = shape::slope(0.5, model.elements[e].length);
    let middle: Vector3<f64> = (0..4).map(|k| weights[k] * vector(q, 6 * e + 3 * k)).sum();
    let ends = vector(q, 6 * e + 3) + vector(q, 6 * e + 9);
    against(&middle, &chord(q, e)) || against(&middle, &ends)
}

/// The first element that is folded.
pub(super) fn folded(model: &Model, q: &[f64]) -> Option<usize> {
    let node = (0..model.nodes()).find(|&i| flipped(model, q, i)).map(|i| i.min(model.elements.len() - 1));
    node.or_else(|| (0..model.elements.len()).find(|&e| buckled(model, q, e)))
}

/// Lays the free slopes of folded elements along the chords, as long as these are stretched.
pub(super) fn unfold(model: &Model, q: &mut [f64]) {
    for node in 0..model.nodes() {
        let elements = node.saturating_sub(1)..(node + 1).min(model.elements.len());
        let bad = flipped(model, q, node) || elements.clone().any(|e| buckled(model, q, e));
        let held = model.support(node).is_some_and(|s| s.slope != SlopeSupport::Free);
        let along = elements.clone().map(|e| chord(q, e)).sum::<Vector3<f64>>();
        let length: f64 = elements.map(|e| model.elements[e].length).sum();
        if bad && !held && along.norm() > 0.0 {
            q[6 * node + 3..6 * node + 6]
                .copy_from_slice((along.normalize() * (along.norm() / length).max(SHORTEST)).as_slice());
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

    /// The two folds of the head of this file are seen, at an end and within, and straightened.
    ///
    /// *Source.* Their r' is written there; the middle of sqrt(5) P_2 runs backwards at half of the ends' speed, and
    /// its chord is 0: here with the chord 0.3, r' = 0.3 + 2.13 P_2.
    #[test]
    fn folds_are_seen_and_straightened() {
        let mut flipped = cable();
        flipped.snapshot.state.q[18] = 2.0 + 1.0 / 3.0;
        flipped.snapshot.state.q[21] = -2.0;
        let mut buckled = cable();
        for (at, x) in [(12, 1.3), (18, 2.3), (9, 2.43), (15, 2.43)] {
            buckled.snapshot.state.q[at] = x;
        }
        for (mut cable, element) in [(flipped, 2), (buckled, 1)] {
            assert_eq!(folded(&cable.model, cable.positions()), Some(element));
            unfold(&cable.model, &mut cable.snapshot.state.q);
            assert_eq!(folded(&cable.model, cable.positions()), None);
        }
    }

    /// A hairpin within one element, a corner at a node, and a clamp against the chord are bends, not folds.
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
        assert_eq!(folded(&hairpin.model, hairpin.positions()), None);
        let mut corner = cable();
        let nodes = [[0.0, 0.0, 0.0, -1.0], [0.0, -1.0, 1.2, 0.0], [0.1, 0.0, 0.0, 1.0], [0.1, 1.0, 0.0, 1.0]];
        for (i, [x, y, dx, dy]) in nodes.into_iter().enumerate() {
            corner.snapshot.state.q[6 * i..6 * i + 6].copy_from_slice(&[x, y, 0.0, dx, dy, 0.0]);
        }
        assert_eq!(folded(&corner.model, corner.positions()), None);
        let mut clamped = cable();
        let support = crate::Support { slope: SlopeSupport::Direction(-Vector3::x()), ..crate::Support::default() };
        clamped.set_support(At::Start, support).unwrap();
        clamped.snapshot.state.q[3] = -1.0;
        assert_eq!(folded(&clamped.model, clamped.positions()), None);
    }
}
