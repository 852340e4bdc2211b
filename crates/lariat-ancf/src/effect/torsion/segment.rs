//! The segments of a cable between holds of its spin.
//!
//! # Equation
//!
//! ```text
//! K = 1/sum(l_e/GJ)        Phi1 = Phi0 + sum_e D Phi_e + D theta_last - D theta_first
//! D(K Phi^2/2) = K_m Phi_m D Phi + (Phi0^2 + Phi1^2)/4 D K        D K = -GJ D L/(L0 L1)
//! ```
//!
//! The second line is exact where the length L of the segment changes, too.
//!
//! # Validity
//!
//! The sum of increments is the angle between the directors of both holds modulo a full turn to
//! rounding, however long the run: nothing drifts.

use super::Torsion;
use super::element::{self, Blocks, COORDINATES, TwistChange, node_step, twist_change, twist_hessian};
use super::lengths::Lengths;
use super::path::twist_along;
use super::stranded::{Strands, elongation, elongation_gradient, elongation_hessian, rest_elongation};
use crate::effect::RestShape;
use crate::linalg::{Block, BlockTridiagonal};
use crate::section::Element;
use crate::state::SegmentTwist;
use nalgebra::Matrix3;

/// What the curve of a segment adds to its twist over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CurveChange {
    /// Twist in rad.
    pub angle: f64,
    /// What the elongation of a [stranded](super::stranded) rope counts as twist, in rad.
    pub stretch: f64,
    /// Number of pairs that slip.
    pub slips: u64,
    /// Its secants in rad/m by the lengths of the elements at eyes, of the start and of the end of
    /// the cable.
    pub by_lengths: [f64; 2],
}

/// The elements between two neighbouring holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    /// Nodes of the holds, ascending.
    pub nodes: [usize; 2],
    /// K in N m.
    pub stiffness: f64,
    /// Where tension makes torque.
    pub strands: Option<Strands>,
    /// What the elongation of a rest stretch counts there as twist, in rad.
    pub rest: f64,
}

impl Segment {
    /// Returns that between two nodes that hold the spin of a cable, ascending, of a shape without
    /// stress.
    pub fn between(torsion: &Torsion, shape: Option<&RestShape>, elements: &[Element], nodes: [usize; 2]) -> Self {
        let (own, strands) = (&elements[nodes[0]..nodes[1]], Strands::of(torsion));
        let of = |strands: Strands, e: usize| strands.share(&elements[e]) * rest_elongation(shape, elements, e);
        let rest = strands.map_or(0.0, |strands| (nodes[0]..nodes[1]).map(|e| of(strands, e)).sum());
        let stiffness = match strands {
            None => torsion.stiffness / own.iter().map(|element| element.length).sum::<f64>(),
            Some(strands) => own.iter().map(|e| e.length / strands.torsional(e)).sum::<f64>().recip(),
        };
        Segment { nodes, stiffness, strands, rest }
    }

    /// Returns the twist in rad that makes the torque at a twist of the material: that of the
    /// elongation of a [stranded](super::stranded) rope with it.
    pub fn loaded(&self, elements: &[Element], q: &[f64], twist: f64) -> f64 {
        let Some(strands) = self.strands else { return twist };
        let of =
            |e: usize| strands.share(&elements[e]) * elongation(&q[6 * e..6 * e + COORDINATES], elements[e].length);
        twist + self.elements().map(of).sum::<f64>() - self.rest
    }

    /// Returns the twist rate in rad/m of an element at a twist of the material in rad: the same in
    /// all, but where tension that differs along the segment makes torque.
    pub fn rate_in(&self, (elements, shape): (&[Element], Option<&RestShape>), q: &[f64], twist: f64, e: usize) -> f64 {
        let Some(strands) = self.strands else {
            return twist / elements[self.elements()].iter().map(|element| element.length).sum::<f64>();
        };
        let (element, own) = (&elements[e], &q[6 * e..6 * e + COORDINATES]);
        let of_torque = self.torque(elements, q, twist) / strands.torsional(element);
        let elastic = elongation(own, element.length) - rest_elongation(shape, elements, e);
        of_torque - strands.share(element) * elastic / element.length
    }

    /// Returns the torque in N m at a twist of the material in rad.
    pub fn torque(&self, elements: &[Element], q: &[f64], twist: f64) -> f64 {
        self.stiffness * self.loaded(elements, q, twist)
    }

    /// Returns the numbers of the elements.
    pub(super) fn elements(&self) -> core::ops::Range<usize> {
        self.nodes[0]..self.nodes[1]
    }

    /// Returns whether an element is one of them.
    pub fn contains(&self, e: usize) -> bool {
        self.elements().contains(&e)
    }

    /// Returns the number of elements.
    pub fn count(&self) -> u64 {
        self.elements().len() as u64
    }

    /// Returns the coordinates of its nodes within those of the cable.
    pub fn range(&self) -> core::ops::Range<usize> {
        6 * self.nodes[0]..6 * self.nodes[1] + 6
    }

    /// Calls `f` with each element, the range of its coordinates in the cable, and that in the
    /// segment.
    fn for_each(&self, mut f: impl FnMut(usize, core::ops::Range<usize>, core::ops::Range<usize>)) {
        for e in self.elements() {
            let own = 6 * (e - self.nodes[0]);
            f(e, 6 * e..6 * e + COORDINATES, own..own + COORDINATES);
        }
    }

    /// Returns the twist that the curve adds over a change of the coordinates and of the lengths,
    /// and sets the secant.
    pub fn change(&self, lengths: &Lengths<'_>, q: &[f64], step: &[f64], secant: &mut Vec<f64>) -> CurveChange {
        secant.clear();
        secant.resize(self.range().len(), 0.0);
        let (mut sum, mut part) = (CurveChange::default(), [0.0; COORDINATES]);
        let node = |n: usize| node_step(&q[6 * n..6 * n + 6], &step[6 * n..6 * n + 6]);
        // neighbours share a node
        let mut first = node(self.nodes[0]);
        self.for_each(|e, at, own| {
            let last = node(e + 1);
            let change: TwistChange =
                twist_change(&q[at.clone()], &step[at], [&first, &last], lengths.of(e), &mut part);
            first = last;
            sum.angle += change.angle;
            sum.slips += change.slips;
            if let Some(side) = lengths.side(e) {
                sum.by_lengths[side] = change.by_length;
            }
            secant[own].iter_mut().zip(&part).for_each(|(out, x)| *out += x);
        });
        let Some(strands) = self.strands else { return sum };
        self.for_each(|e, at, own| {
            let (element, mean) = (lengths.element(e), |i: usize| q[at.start + i] + 0.5 * step[at.start + i]);
            elongation_gradient(mean, element.length, strands.share(element), &mut part);
            sum.stretch += step[at.clone()].iter().zip(&part).map(|(d, g)| d * g).sum::<f64>();
            secant[own].iter_mut().zip(&part).for_each(|(out, x)| *out += x);
        });
        sum
    }

    /// Returns the twist in rad that the curve adds between two shapes without a step between them,
    /// and the number of pairs that slip ([`path`](super::path)).
    pub fn follow(&self, elements: &[Element], [from, to]: [&[f64]; 2]) -> (f64, u64) {
        let of = |q: &[f64], e: usize| element::directions(&q[6 * e..6 * e + COORDINATES], elements[e].length);
        let own = self.elements().map(|e| twist_along(of(from, e), of(to, e)));
        own.fold((0.0, 0), |(angle, slips), (a, s)| (angle + a, slips + s))
    }

    /// Returns K at both ends of a step.
    pub fn stiffnesses(&self, torsion: Option<&Torsion>, lengths: &Lengths<'_>) -> [f64; 2] {
        let flows = self.elements().any(|e| lengths.side(e).is_some());
        let Some(torsion) = torsion.filter(|_| flows) else { return [self.stiffness; 2] };
        [0, 1].map(|end| torsion.stiffness / self.elements().map(|e| lengths.of(e)[end]).sum::<f64>())
    }

    /// Sets the gradient of the twist of the curve.
    pub fn gradient(&self, elements: &[Element], q: &[f64], gradient: &mut Vec<f64>) {
        gradient.clear();
        gradient.resize(self.range().len(), 0.0);
        let mut part = [0.0; COORDINATES];
        self.for_each(|e, at, own| {
            element::twist_gradient(&q[at], elements[e].length, &mut part);
            gradient[own].iter_mut().zip(&part).for_each(|(out, x)| *out += x);
        });
        let Some(strands) = self.strands else { return };
        self.for_each(|e, at, own| {
            let (length, share) = (elements[e].length, strands.share(&elements[e]));
            elongation_gradient(|i| q[at.start + i], length, share, &mut part);
            gradient[own].iter_mut().zip(&part).for_each(|(out, x)| *out += x);
        });
    }

    /// Adds a factor times the Hessian of the twist at coordinates `q(i)` to a matrix.
    pub fn add_hessian(
        &self,
        lengths: &Lengths<'_>,
        q: impl Fn(usize) -> f64,
        factor: f64,
        matrix: &mut BlockTridiagonal,
    ) {
        if factor == 0.0 {
            return;
        }
        let mut local = [0.0; COORDINATES];
        self.for_each(|e, at, _| {
            local.iter_mut().zip(at).for_each(|(out, i)| *out = q(i));
            let blocks: Blocks = twist_hessian(&local, lengths.mean(e), factor);
            for (row, column) in [(0, 0), (1, 0), (1, 1)] {
                let (first, last) = (&blocks[row][column], &blocks[2 + row][2 + column]);
                add_block(&mut matrix.diag[e], [row, column], first);
                add_block(&mut matrix.diag[e + 1], [row, column], last);
                if row != column {
                    add_block(&mut matrix.diag[e], [column, row], &first.transpose());
                    add_block(&mut matrix.diag[e + 1], [column, row], &last.transpose());
                }
            }
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                add_block(&mut matrix.lower[e], [row, column], &blocks[2 + row][column]);
            }
        });
        let Some(strands) = self.strands else { return };
        for e in self.elements() {
            let (element, share) = (lengths.element(e), strands.share(lengths.element(e)));
            let entry = |row: usize, column: usize| factor * share * elongation_hessian(row, column, element.length);
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                for x in 0..3 {
                    let (r, c) = (3 * row + x, 3 * column + x);
                    matrix.diag[e].0[c][r] += entry(row, column);
                    matrix.diag[e + 1].0[c][r] += entry(2 + row, 2 + column);
                    matrix.lower[e].0[c][r] += entry(2 + row, column);
                }
            }
        }
    }

    /// Returns what is left of the twists of a state for this segment: of segments that it covers
    /// in part, their share by length.
    fn left_of(&self, elements: &[Element], state: &[SegmentTwist]) -> SegmentTwist {
        let length = |from: usize, to: usize| elements[from..to.max(from)].iter().map(|e| e.length).sum::<f64>();
        let mut own = SegmentTwist { nodes: self.nodes, ..SegmentTwist::default() };
        for other in state.iter().filter(|other| other.nodes[1] < elements.len() + 1) {
            let both = [self.nodes[0].max(other.nodes[0]), self.nodes[1].min(other.nodes[1])];
            if both == other.nodes {
                own.twist += other.twist;
            } else if both[1] > both[0] {
                own.twist += other.twist * length(both[0], both[1]) / length(other.nodes[0], other.nodes[1]);
            }
            for side in (0..2).filter(|&side| other.nodes[side] == self.nodes[side]) {
                own.attitudes[side] = other.attitudes[side];
            }
        }
        own
    }
}

/// Adds a block over r or t to one over both.
fn add_block(to: &mut Block, [row, column]: [usize; 2], block: &Matrix3<f64>) {
    for (to, from) in to.0[3 * column..3 * column + 3].iter_mut().zip(block.column_iter()) {
        to[3 * row..3 * row + 3].iter_mut().zip(from.iter()).for_each(|(to, x)| *to += x);
    }
}

/// Makes the twists of a state those of its present segments. As built, they are the initial twist,
/// from when two nodes hold it;
/// a new hold holds the twist that is there, and what lost a hold has lost its twist.
pub(crate) fn follow_holds(
    torsion: &Torsion,
    elements: &[Element],
    segments: &[Segment],
    state: &mut Option<Vec<SegmentTwist>>,
) {
    let is_right = |twists: &[SegmentTwist]| {
        twists.len() == segments.len() && twists.iter().zip(segments).all(|(a, b)| a.nodes == b.nodes)
    };
    match state {
        Some(twists) if is_right(twists) => {}
        None if segments.is_empty() => {}
        Some(twists) => *twists = segments.iter().map(|segment| segment.left_of(elements, twists)).collect(),
        None => {
            let all: f64 = segments.iter().map(|segment| segment.stiffness.recip()).sum();
            let own = |segment: &Segment| {
                let twist = core::f64::consts::TAU * torsion.initial_twist / (segment.stiffness * all);
                SegmentTwist { nodes: segment.nodes, twist, ..SegmentTwist::default() }
            };
            *state = Some(segments.iter().map(own).collect());
        }
    }
}
