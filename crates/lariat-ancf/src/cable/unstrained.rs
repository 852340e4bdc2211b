//! A cable drawn around corners, laid without strain.
//!
//! # Equation
//!
//! A cable is smooth at its nodes, and a polyline is not: elements at its corners, laid on it, are
//! too long or too short. The nodes are moved until the axial energy of the rule
//! [`projected`](crate::element::axial::projected), beyond that of the even stretch f_0 of the
//! drawing, is below 1e-8 EA L. It is a sum of squares of the Green strain, in Legendre polynomials
//! over the element,
//!
//! ```text
//! U = EA/2 |c|^2        c_(e,j) = sqrt(l delta_j) (eps_j - [j = 0] (f_0^2 - 1)/2), j = 0..4        delta_j = 1, 1, delta, delta, delta
//! d q = -W^-1 J^T (J W^-1 J^T + mu)^-1 c        J = dc/dq
//! ```
//!
//! and the change of the nodal coordinates is small in the norm W (steps of Levenberg and
//! Marquardt): positions weigh 1, slopes the square of the distance l/8 over which they act. mu
//! falls with every step, so that the corners move first, and the iteration ends where the energy
//! is low enough. `J W^-1 J^T` is tridiagonal in blocks of the elements.
//!
//! # Validity
//!
//! The start, the end, held nodes and nodes that the user asked for stay where they are drawn,
//! clamps keep their direction. At a corner on such a node the cable is laid as if it ended there,
//! for it is cut there or held, and the node keeps the mean direction of its sides: elements beside
//! it stay strained until it is [opened](super::Cable::open_corner). A shape of less than 1e-6 EA L
//! stays as drawn. Random polylines of 3 to 6 points, with corners up to 150 degrees and 4 to 60
//! elements, end below 1e-7 EA L, with nodes at most 0.6 elements beside where they were laid
//! (`tests/corners.rs`); two legs with one right angle, by 0.13 elements. The other axial rules ask
//! more of a bent element, and keep more energy.
//!
//! # References
//!
//! Nocedal & Wright 2006, section 10.3 (Levenberg-Marquardt).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/elements.md.

use super::layout::Laid;
use crate::element::shape;
use crate::quadrature::{gauss_legendre, legendre};
use crate::scales::cable::{DAMPING, EASE, ENOUGH, MOST_ITERATIONS, STAYS};
use crate::scales::element::DELTA;
use nalgebra::{SMatrix, SVector, Vector3};

/// What of a node stays as drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Kept {
    pub position: bool,
    pub slope: bool,
}

/// Layout: number of polynomials in which the strain of an element is written: it is quartic.
const TERMS: usize = 5;
/// Strain of an element in these polynomials, by the root of its energy over EA/2.
type Strain = SVector<f64, TERMS>;
/// Its derivatives by position and slope of both nodes.
type Rows = SMatrix<f64, TERMS, 12>;
type Block = SMatrix<f64, TERMS, TERMS>;
/// Position and slope of the nodes.
type Nodes = Vec<[Vector3<f64>; 2]>;

/// A part of a cable that is laid by itself.
struct Span<'a> {
    /// Arc lengths of its nodes in m.
    s: &'a [f64],
    /// By node, the inverse weights of position and slope, zero where they are kept.
    weights: Vec<[f64; 2]>,
    /// Green strain of the drawn stretch.
    strain: f64,
    /// Points of an element, and the share of the strain there in each of the polynomials.
    points: Vec<(f64, Strain)>,
}

/// Moves the nodes at arc lengths `s` (m), laid with an even stretch, until the elements have
/// hardly another strain.
pub(super) fn unstrain(laid: &mut [Laid], s: &[f64], kept: &[Kept], stretch: f64) {
    let stretch = stretch.max(1.0);
    let last = laid.len() - 1;
    let mut from = 0;
    for to in 1..=last {
        if to == last || (kept[to].position && laid[to].corner.is_some()) {
            unstrain_span(&mut laid[from..=to], &s[from..=to], &kept[from..=to], 0.5 * (stretch * stretch - 1.0));
            from = to;
        }
    }
}

fn unstrain_span(laid: &mut [Laid], s: &[f64], kept: &[Kept], strain: f64) {
    let last = laid.len() - 1;
    let is_end = |i: usize| i == 0 || i == last;
    let is_open_end = |i: usize| is_end(i) && laid[i].corner.is_some();
    let weights = (0..=last).map(|i| {
        let (from, to) = (i.saturating_sub(1), (i + 1).min(last));
        let lever = (s[to] - s[from]) / (8.0 * (to - from) as f64);
        let of = |kept: bool, weight: f64| if kept { 0.0 } else { weight };
        [of(kept[i].position, 1.0), of(kept[i].slope || is_open_end(i), lever.powi(-2))]
    });
    let point = |(xi, weight): (f64, f64)| {
        let term = |j: usize| {
            let share = if j < 2 { 1.0 } else { DELTA };
            weight * (share * (2 * j + 1) as f64).sqrt() * legendre(j, 2.0 * xi - 1.0).0
        };
        (xi, Strain::from_fn(|j, _| term(j)))
    };
    let points = gauss_legendre(TERMS).into_iter().map(point).collect();
    let span = Span { s, weights: weights.collect(), strain, points };
    let mut q: Nodes = laid.iter().map(|node| [node.position, node.slope]).collect();
    for (i, side) in [(0, 1), (last, 0)] {
        if let Some(sides) = laid[i].corner {
            q[i][1] = sides[side];
        }
    }
    // U = EA/2 |c|^2
    let unit = 2.0 * (s[last] - s[0]);
    if span.square(&q) <= STAYS * unit || !span.solve(&mut q, ENOUGH * unit) {
        return;
    }
    for (i, (node, [position, slope])) in laid.iter_mut().zip(q).enumerate() {
        if !is_end(i) || node.corner.is_none() {
            *node = Laid { position, slope, corner: None };
        }
    }
}

impl Span<'_> {
    fn length(&self, e: usize) -> f64 {
        self.s[e + 1] - self.s[e]
    }

    /// Returns r' at a point of an element, and the weights by which it is made.
    fn slope(&self, q: &Nodes, e: usize, xi: f64) -> (Vector3<f64>, [f64; 4]) {
        let weights = shape::slope(xi, self.length(e));
        ((0..4).map(|k| weights[k] * q[e + k / 2][k % 2]).sum(), weights)
    }

    /// Returns the strain of an element beyond that of the drawn stretch.
    fn strain(&self, q: &Nodes, e: usize) -> Strain {
        let at = |&(xi, terms): &(f64, Strain)| {
            let green = 0.5 * (self.slope(q, e, xi).0.norm_squared() - 1.0);
            terms * (green - self.strain)
        };
        self.points.iter().map(at).sum::<Strain>() * self.length(e).sqrt()
    }

    fn square(&self, q: &Nodes) -> f64 {
        (0..self.s.len() - 1).map(|e| self.strain(q, e).norm_squared()).sum()
    }

    fn rows(&self, q: &Nodes, e: usize) -> Rows {
        let mut rows = Rows::zeros();
        for (xi, terms) in &self.points {
            let (slope, weights) = self.slope(q, e, *xi);
            for (k, weight) in weights.into_iter().enumerate() {
                let mut by_node = rows.fixed_columns_mut::<3>(3 * k);
                by_node += terms * slope.transpose() * (weight * self.length(e).sqrt());
            }
        }
        rows
    }

    /// Returns W^-1 J^T of an element, transposed.
    fn weighted(&self, rows: &Rows, e: usize) -> Rows {
        let mut weighted = *rows;
        for k in 0..4 {
            weighted.fixed_columns_mut::<3>(3 * k).scale_mut(self.weights[e + k / 2][k % 2]);
        }
        weighted
    }

    /// Moves the nodes until the square of the strain is at most `enough`, or as small as it can be
    /// made; returns whether it fell.
    fn solve(&self, q: &mut Nodes, enough: f64) -> bool {
        let elements = self.s.len() - 1;
        let first = self.square(q);
        let (mut square, mut damping) = (first, DAMPING[0]);
        for _ in 0..MOST_ITERATIONS {
            if square <= enough || damping > DAMPING[1] {
                break;
            }
            let rows: Vec<Rows> = (0..elements).map(|e| self.rows(q, e)).collect();
            let weighted: Vec<Rows> = (0..elements).map(|e| self.weighted(&rows[e], e)).collect();
            let strain: Vec<Strain> = (0..elements).map(|e| self.strain(q, e)).collect();
            let mean = rows.iter().zip(&weighted).map(|(row, weighted)| row.dot(weighted)).sum::<f64>()
                / (TERMS * elements) as f64;
            let multipliers = solve_blocks(&rows, &weighted, strain, damping * mean);
            let trial = multipliers.map(|multipliers| moved(q, &weighted, &multipliers));
            match trial.map(|trial| (self.square(&trial), trial)) {
                Some((reached, trial)) if reached < square => {
                    (*q, square) = (trial, reached);
                    damping *= EASE;
                }
                _ => damping /= EASE.powi(3),
            }
        }
        square < first
    }
}

fn moved(q: &Nodes, weighted: &[Rows], multipliers: &[Strain]) -> Nodes {
    let mut moved = q.clone();
    for (e, (weighted, multiplier)) in weighted.iter().zip(multipliers).enumerate() {
        for k in 0..4 {
            moved[e + k / 2][k % 2] -= weighted.fixed_columns::<3>(3 * k).tr_mul(multiplier);
        }
    }
    moved
}

/// Solves `(J W^-1 J^T + mu) y = c` by blocks of the elements; `None` if a block is singular.
fn solve_blocks(rows: &[Rows], weighted: &[Rows], mut y: Vec<Strain>, damping: f64) -> Option<Vec<Strain>> {
    let elements = rows.len();
    // elements share the last six coordinates of one and the first six of the other
    let beside = |e: usize| rows[e].fixed_columns::<6>(6) * weighted[e + 1].fixed_columns::<6>(0).transpose();
    let mut inverses: Vec<Block> = Vec::with_capacity(elements);
    for e in 0..elements {
        let mut block = rows[e] * weighted[e].transpose() + Block::identity() * damping;
        if e > 0 {
            let coupling = beside(e - 1);
            let left = coupling.tr_mul(&inverses[e - 1]);
            block -= left * coupling;
            let before = left * y[e - 1];
            y[e] -= before;
        }
        inverses.push(block.try_inverse()?);
    }
    for e in (0..elements).rev() {
        let behind = if e + 1 < elements { beside(e) * y[e + 1] } else { Strain::zeros() };
        y[e] = inverses[e] * (y[e] - behind);
    }
    Some(y)
}
