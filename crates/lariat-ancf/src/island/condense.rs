//! Static condensation of a cable's matrix on its held coordinates.
//!
//! # Equation
//!
//! With f the free coordinates of a cable and p those of its pinned positions and clamped slopes
//! (whose length is free),
//!
//! ```text
//! Y = A_ff^-1 A_fp        W = A_pp - A_pf Y        r_p - A_pf A_ff^-1 r_f
//! ```
//!
//! Bodies that the cable touches stand beside the held coordinates, with columns and blocks of
//! their own ([`contact`](crate::contact)), and so do the forces of contacts with cables.
//!
//! W (3 rows per pin, 6 per clamp or touched body, 3 per contact with a cable) is the dynamic
//! stiffness of the cable at the bodies; Y gives the increments of the cable from those of the
//! bodies. Neither needs the columns of Y: a [`SchurComplement`] brings them half of the way.
//!
//! # References
//!
//! Guyan 1965; Golub & Van Loan 2013, section 4.5.1 (bordered systems).
//!
//! # Alternatives considered
//!
//! Lagrange multipliers: the same solves, and an indefinite matrix in addition.

use super::hold::Hold;
use crate::contact::{Border, PairColumns};
use crate::linalg::{BlockTridiagonal, Factorisation, SchurComplement};
use fearless_simd::Level;

/// What stands beside the free coordinates of a cable, in the order of the rows of W.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Columns<'a> {
    pub holds: &'a [Hold],
    /// The bodies that it touches.
    pub touched: &'a [Border],
    /// Its number among the cables.
    pub strand: usize,
    /// Contacts between cables, and which of them are its own.
    pub pairs: &'a [PairColumns],
    pub own: &'a [usize],
}

/// Nonzero rows of a column of A: up to three nodes from `first`.
#[derive(Clone, Copy, Debug, Default)]
struct Column {
    first: usize,
    nodes: usize,
    rows: [f64; 18],
}

/// The condensed matrix of a cable.
#[derive(Clone, Debug, Default)]
pub(super) struct Condensed {
    /// By held coordinate: the column of A, before and after projection.
    columns: Vec<Column>,
    schur: SchurComplement,
    /// W, row-major.
    pub w: Vec<f64>,
    size: usize,
    /// Columns of touched bodies, six each, before and after projection.
    borders: Vec<f64>,
    /// A vector of the cable.
    scratch: Vec<f64>,
}

impl Condensed {
    /// Reads the columns of the held coordinates from `a`, before it is projected, and those of
    /// touched bodies.
    pub fn read(&mut self, a: &BlockTridiagonal, holds: &[Hold], borders: &[Border]) {
        self.size = 6 * a.nodes();
        self.columns.clear();
        self.borders.clear();
        borders.iter().for_each(|border| self.borders.extend_from_slice(&border.columns));
        for &Hold { node, slope, .. } in holds {
            let offset = if slope { 3 } else { 0 };
            for x in offset..offset + 3 {
                let first = node.saturating_sub(1);
                let mut column = Column { first, nodes: (node + 2).min(a.nodes()) - first, rows: [0.0; 18] };
                for k in 0..column.nodes {
                    let at = first + k;
                    for r in 0..6 {
                        column.rows[6 * k + r] = match at.cmp(&node) {
                            std::cmp::Ordering::Less => a.lower[at].0[r][x],
                            std::cmp::Ordering::Equal => a.diag[at].0[x][r],
                            std::cmp::Ordering::Greater => a.lower[node].0[x][r],
                        };
                    }
                }
                self.columns.push(column);
            }
        }
    }

    /// Completes the condensation with the factored, projected matrix; `project` removes held rows
    /// from a vector.
    pub fn complete(
        &mut self,
        level: Level,
        factorisation: &Factorisation,
        columns: Columns<'_>,
        project: impl Fn(&mut [f64]),
    ) {
        let Columns { holds, touched: borders, strand, pairs, own } = columns;
        let (held, size) = (self.columns.len(), self.size);
        let before_pairs = held + 6 * borders.len();
        let count = before_pairs + 3 * own.len();
        self.w.clear();
        self.w.resize(count * count, 0.0);
        self.scratch.clear();
        self.scratch.resize(size, 0.0);
        self.schur.begin(size / 6, count);
        for (j, column) in self.columns.iter_mut().enumerate() {
            for (q, &Hold { node, slope, .. }) in holds.iter().enumerate() {
                if node >= column.first && node < column.first + column.nodes {
                    let at = 6 * (node - column.first) + if slope { 3 } else { 0 };
                    for x in 0..3 {
                        self.w[(3 * q + x) * count + j] = column.rows[at + x];
                    }
                }
            }
            let range = 6 * column.first..6 * (column.first + column.nodes);
            let rows = &mut column.rows[..6 * column.nodes];
            self.scratch[range.clone()].copy_from_slice(rows);
            project(&mut self.scratch);
            rows.copy_from_slice(&self.scratch[range.clone()]);
            self.scratch[range].fill(0.0);
            self.schur.set(j, column.first, rows);
        }
        for (k, column) in self.borders.chunks_exact_mut(size.max(1)).enumerate() {
            for (q, &Hold { node, slope, .. }) in holds.iter().enumerate() {
                for x in 0..3 {
                    let value = column[6 * node + if slope { 3 } else { 0 } + x];
                    self.w[(3 * q + x) * count + held + k] = value;
                    self.w[(held + k) * count + 3 * q + x] = value;
                }
            }
            for x in 0..6 {
                self.w[(held + k) * count + held + k / 6 * 6 + x] = borders[k / 6].block[(k % 6, x)];
            }
            project(column);
            self.schur.set(held + k, 0, column);
        }
        for (k, ends) in own.iter().map(|pair| &pairs[*pair]).enumerate() {
            for x in 0..3 {
                let j = before_pairs + 3 * k + x;
                for end in ends.iter().filter(|end| end.strand == strand) {
                    let part = &mut self.scratch[6 * end.element..6 * end.element + 12];
                    part.iter_mut().zip(&end.columns[x]).for_each(|(out, value)| *out += value);
                }
                for (q, &Hold { node, slope, .. }) in holds.iter().enumerate() {
                    for y in 0..3 {
                        let value = self.scratch[6 * node + if slope { 3 } else { 0 } + y];
                        self.w[(3 * q + y) * count + j] = value;
                        self.w[j * count + 3 * q + y] = value;
                    }
                }
                project(&mut self.scratch);
                for end in ends.iter().filter(|end| end.strand == strand) {
                    let range = 6 * end.element..6 * end.element + 12;
                    self.schur.set(j, end.element, &self.scratch[range]);
                }
                for end in ends.iter().filter(|end| end.strand == strand) {
                    self.scratch[6 * end.element..6 * end.element + 12].fill(0.0);
                }
            }
        }
        self.schur.complete(level, factorisation);
        self.schur.subtract_from(level, &mut self.w);
    }

    /// Computes `out = A_pf A_ff^-1 r_f` for projected rows `r_f`, which [`expand`](Self::expand)
    /// needs as this leaves them. The held coordinates come first, then those of touched bodies,
    /// then contacts. The factorisation is that of [`complete`](Self::complete).
    pub fn reduce(&self, level: Level, factorisation: &Factorisation, rows: &mut [f64], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.w.len().isqrt(), 0.0);
        self.schur.reduce(level, factorisation, rows, out);
    }

    /// Computes `A_ff^-1 r_f - Y displacements` in place.
    pub fn expand(&self, level: Level, factorisation: &Factorisation, displacements: &[f64], rows: &mut [f64]) {
        self.schur.expand(level, factorisation, displacements, rows);
    }
}
