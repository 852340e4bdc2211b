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
//! their own ([`contact`](crate::contact)), and so do the forces of contacts with cables. The
//! slopes of [cuts](super::cuts) are among the held coordinates here, and follow themselves.
//!
//! W (3 rows per pin or cut, 6 per clamp or touched body, 3 per contact with a cable) is the
//! dynamic stiffness of the cable at the bodies, and [sparse](super::coupled_groups) if the cable
//! is cut; Y gives the increments of the cable from those of the bodies. Neither needs the columns
//! of Y: a [`SchurComplement`] brings them half of the way.
//!
//! # References
//!
//! Guyan 1965; Golub & Van Loan 2013, section 4.5.1 (bordered systems).
//!
//! # Alternatives considered
//!
//! Lagrange multipliers: the same solves, and an indefinite matrix in addition.

use super::coupled_groups::CoupledGroups;
use super::hold::Held;
use crate::contact::{Border, PairColumns};
use crate::linalg::{BlockTridiagonal, Factorisation, SchurComplement};
use fearless_simd::Level;

/// What stands beside the free coordinates of a cable, in the order of the rows of W.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Columns<'a> {
    pub held: &'a [Held],
    /// The nodes at which it is cut, in ascending order.
    pub cuts: &'a [usize],
    /// The bodies that it touches.
    pub touched: &'a [Border],
    /// Its number among the cables.
    pub strand: usize,
    /// Contacts between cables, and which of them are its own.
    pub pairs: &'a [PairColumns],
    pub own: &'a [usize],
}

/// Nonzero rows of three columns of A: up to three nodes from `first`.
#[derive(Clone, Copy, Debug, Default)]
struct HeldColumns {
    first: usize,
    nodes: usize,
    rows: [[f64; 18]; 3],
}

/// The condensed matrix of a cable.
#[derive(Clone, Debug, Default)]
pub(super) struct Condensed {
    /// By held coordinates: the columns of A, before and after projection.
    columns: Vec<HeldColumns>,
    schur: SchurComplement,
    pub w: CoupledGroups,
    /// Number of columns.
    count: usize,
    size: usize,
    /// Columns of touched bodies, six each, before and after projection.
    borders: Vec<f64>,
    /// By node, which of the held coordinates are its position and its slope.
    at_node: Vec<[Option<usize>; 2]>,
    /// A vector of the cable.
    scratch: Vec<f64>,
}

/// Returns the first of three rows or columns of a position, or a slope, among those of a node.
fn offset(slope: usize) -> usize {
    3 * slope
}

/// Returns the nodes from the first to the last with entries in six columns of `size` numbers.
fn extent(columns: &[f64], size: usize) -> [usize; 2] {
    let mut nodes = [size / 6, 0];
    for column in columns.chunks_exact(size.max(1)) {
        let is_entry = |six: &[f64]| six.iter().any(|x| *x != 0.0);
        let sixes = || column.chunks_exact(6);
        if let (Some(first), Some(last)) = (sixes().position(is_entry), sixes().rposition(is_entry)) {
            nodes = [nodes[0].min(first), nodes[1].max(last + 1)];
        }
    }
    nodes
}

impl Condensed {
    /// Reads the columns of the held coordinates from `a`, before it is projected, and those of
    /// touched bodies.
    pub fn read(&mut self, a: &BlockTridiagonal, held: &[Held], borders: &[Border]) {
        self.size = 6 * a.nodes();
        self.columns.clear();
        self.borders.clear();
        borders.iter().for_each(|border| self.borders.extend_from_slice(&border.columns));
        self.at_node.clear();
        self.at_node.resize(a.nodes(), [None; 2]);
        for (triple, &Held { node, slope }) in held.iter().enumerate() {
            self.at_node[node][usize::from(slope)] = Some(triple);
            let first = node.saturating_sub(1);
            let mut columns = HeldColumns { first, nodes: (node + 2).min(a.nodes()) - first, rows: Default::default() };
            for (x, rows) in (offset(usize::from(slope))..).zip(&mut columns.rows) {
                for k in 0..columns.nodes {
                    let at = first + k;
                    for r in 0..6 {
                        rows[6 * k + r] = match at.cmp(&node) {
                            std::cmp::Ordering::Less => a.lower[at].0[r][x],
                            std::cmp::Ordering::Equal => a.diag[at].0[x][r],
                            std::cmp::Ordering::Greater => a.lower[node].0[x][r],
                        };
                    }
                }
            }
            self.columns.push(columns);
        }
    }

    /// Completes the condensation with the factored, projected matrix, with rows and columns of
    /// cuts those of the identity; `project` removes held rows from the nodes that begin with one.
    pub fn complete(
        &mut self,
        level: Level,
        factorisation: &Factorisation,
        columns: Columns<'_>,
        project: impl Fn(usize, &mut [f64]),
    ) {
        let Columns { held, cuts, touched, own, .. } = columns;
        self.count = 3 * held.len() + 6 * touched.len() + 3 * own.len();
        self.schur.begin(self.size / 6, self.count);
        self.schur.set_walls(cuts);
        self.find_coupled(factorisation, columns);
        let project = |first: usize, rows: &mut [f64]| {
            project(first, rows);
            let end = first + rows.len() / 6;
            let from = cuts.partition_point(|cut| *cut < first);
            cuts[from..].iter().take_while(|cut| **cut < end).for_each(|cut| {
                rows[6 * (cut - first) + 3..6 * (cut - first) + 6].fill(0.0);
            });
        };
        self.set_held(&project);
        self.set_touched(held.len(), touched, &project);
        self.set_pairs(held.len() + 2 * touched.len(), columns, &project);
        self.schur.complete(level, factorisation);
        self.schur.subtract_products(level, &self.w.pairs, &mut self.w.blocks);
    }

    /// Finds which groups of columns are coupled.
    fn find_coupled(&mut self, factorisation: &Factorisation, columns: Columns<'_>) {
        let Columns { held, touched, strand, pairs, own, .. } = columns;
        self.w.begin(self.count / 3);
        for (triple, column) in self.columns.iter().enumerate() {
            self.w.reach(triple, [column.first, column.first + column.nodes]);
        }
        for (k, six) in self.borders.chunks_exact((6 * self.size).max(1)).enumerate() {
            let nodes = extent(six, self.size);
            (0..2).for_each(|part| self.w.reach(held.len() + 2 * k + part, nodes));
        }
        for (k, &pair) in own.iter().enumerate() {
            for end in pairs[pair].iter().filter(|end| end.strand == strand) {
                self.w.reach(held.len() + 2 * touched.len() + k, [end.element, end.element + 2]);
            }
        }
        self.w.arrange(|nodes| self.schur.spread(factorisation, nodes));
    }

    fn set_held(&mut self, project: &impl Fn(usize, &mut [f64])) {
        for (j, columns) in self.columns.iter_mut().enumerate() {
            for k in 0..columns.nodes {
                for (slope, q) in self.at_node[columns.first + k].iter().enumerate() {
                    let Some(q) = q.filter(|q| *q <= j) else { continue };
                    let Some((block, [row, column])) = self.w.of(q, j) else { continue };
                    for (c, rows) in columns.rows.iter().enumerate() {
                        (0..3).for_each(|x| block.0[row + x][column + c] = rows[6 * k + offset(slope) + x]);
                    }
                }
            }
            for (c, rows) in columns.rows.iter_mut().enumerate() {
                let rows = &mut rows[..6 * columns.nodes];
                project(columns.first, rows);
                self.schur.set(3 * j + c, columns.first, rows);
            }
        }
    }

    /// Sets the columns of touched bodies, which come after `before` triples.
    fn set_touched(&mut self, before: usize, touched: &[Border], project: &impl Fn(usize, &mut [f64])) {
        for (k, column) in self.borders.chunks_exact_mut(self.size.max(1)).enumerate() {
            let (body, x) = (k / 6, k % 6);
            let triple = before + k / 3;
            set_products(&mut self.w, &self.at_node, 0, column, (triple, k % 3));
            for part in 0..2 {
                let row = before + 2 * body + part;
                if let Some((block, [r, c])) =
                    Some(row).filter(|row| *row <= triple).and_then(|row| self.w.of(row, triple))
                {
                    (0..3).for_each(|y| block.0[r + y][c + k % 3] = touched[body].block[(3 * part + y, x)]);
                }
            }
            project(0, column);
            self.schur.set(3 * before + k, 0, column);
        }
    }

    /// Sets the columns of contacts between cables, which come after `before` triples.
    fn set_pairs(&mut self, before: usize, columns: Columns<'_>, project: &impl Fn(usize, &mut [f64])) {
        let Columns { strand, pairs, own, .. } = columns;
        self.scratch.clear();
        self.scratch.resize(self.size, 0.0);
        for (k, ends) in own.iter().map(|pair| &pairs[*pair]).enumerate() {
            let ends = || ends.iter().filter(|end| end.strand == strand);
            let range = |element: usize| 6 * element..6 * element + 12;
            for x in 0..3 {
                for end in ends() {
                    let part = &mut self.scratch[range(end.element)];
                    part.iter_mut().zip(&end.columns[x]).for_each(|(out, value)| *out += value);
                }
                for end in ends() {
                    let part = &self.scratch[range(end.element)];
                    set_products(&mut self.w, &self.at_node, end.element, part, (before + k, x));
                }
                for end in ends() {
                    project(end.element, &mut self.scratch[range(end.element)]);
                }
                for end in ends() {
                    self.schur.set(3 * (before + k) + x, end.element, &self.scratch[range(end.element)]);
                }
                for end in ends() {
                    self.scratch[range(end.element)].fill(0.0);
                }
            }
        }
    }

    /// Computes `out = A_pf A_ff^-1 r_f` for projected rows `r_f`, which [`expand`](Self::expand)
    /// needs as this leaves them. The held coordinates come first, then those of touched bodies,
    /// then contacts. The factorisation is that of [`complete`](Self::complete).
    pub fn reduce(&self, level: Level, factorisation: &Factorisation, rows: &mut [f64], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.count, 0.0);
        self.schur.reduce(level, factorisation, rows, out);
    }

    /// Computes `A_ff^-1 r_f - Y displacements` in place.
    pub fn expand(&self, level: Level, factorisation: &Factorisation, displacements: &[f64], rows: &mut [f64]) {
        self.schur.expand(level, factorisation, displacements, rows);
    }

    /// Returns the number of products of blocks of six that the condensation takes.
    #[cfg(test)]
    pub fn products(&self) -> usize {
        self.w.pairs.iter().map(|pair| self.schur.common(*pair).len()).sum()
    }
}

/// Sets the entries of W of held coordinates and a column x of a triple, which are those of the
/// column in nodes from `first` on.
fn set_products(
    w: &mut CoupledGroups,
    at_node: &[[Option<usize>; 2]],
    first: usize,
    column: &[f64],
    (triple, x): (usize, usize),
) {
    for (six, at) in column.chunks_exact(6).zip(&at_node[first..]) {
        for (three, q) in six.chunks_exact(3).zip(at) {
            if let Some(q) = q.filter(|_| three.iter().any(|value| *value != 0.0))
                && let Some((block, [row, column])) = w.of(q, triple)
            {
                (0..3).for_each(|y| block.0[row + y][column + x] = three[y]);
            }
        }
    }
}
