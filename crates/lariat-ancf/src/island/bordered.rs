//! The linear equations of an island: cables that are banded, and a border of their own.
//!
//! # Equation
//!
//! ```text
//! (T B; B^T D) (x; y) = (r; s)        S = D - B^T T^-1 B,   S y = s - B^T T^-1 r,   x = T^-1 (r - B y)
//! ```
//!
//! T has one band per cable. The border y are the bodies, the slopes of [cuts](super::cuts) and the
//! forces of contacts between cables; its columns B are sparse: those of held coordinates p are
//! A_fp G, those of a touched body and of a contact are in the elements where it acts. D is the
//! inertia of the bodies and A_pp, and -1 of the forces. Each cable is [condensed](super::condense)
//! to its W, and
//!
//! ```text
//! S = B + sum G^T W G          G = (1, -[arm]x) of a held position, (0, -[arm]x) of a held slope,
//!                              1 of a touched body, a cut and the forces of a contact
//! ```
//!
//! # Validity
//!
//! Any number of cables, bodies and contacts: two of the border are coupled only if a cable joins
//! them, and S is [sparse](crate::linalg). The contacts of one cable with itself are all coupled:
//! n of them take 9 n^2 numbers and of the order of (3 n)^3 operations, which hundreds make dear.
//!
//! # References
//!
//! Golub & Van Loan 2013, section 4.5.1 (bordered systems).
//!
//! # Alternatives considered
//!
//! docs/decisions/border.md.

use super::condense::Condensed;
use super::coupling::CoupledInertia;
use super::cuts;
use super::hold::vector;
use super::rotation::skew;
use crate::error::StepFailure;
use crate::linalg::{Block, Factorisation, SparseSymmetric};
use fearless_simd::Level;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// The matrix of an island, and its factors but those of the bands.
#[derive(Clone, Debug, Default)]
pub(super) struct Bordered {
    cables: Vec<Beside>,
    /// S.
    sparse: SparseSymmetric,
}

/// A cable beside the border.
#[derive(Clone, Debug, Default)]
struct Beside {
    condensed: Condensed,
    /// What its coordinates in the border follow.
    levers: Vec<Lever>,
    /// B^T T^-1 r, then the increments of these coordinates.
    values: Vec<f64>,
}

/// Three coordinates that follow a block of the border, by `G = (linear 1, angular)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lever {
    body: usize,
    linear: bool,
    angular: Matrix3<f64>,
    /// Whether `angular` is not 0.
    turns: bool,
}

impl Lever {
    /// Of held coordinates with an arm; those of a slope only turn.
    pub fn held(body: usize, arm: &Vector3<f64>, slope: bool) -> Self {
        Lever { body, linear: !slope, angular: -skew(arm), turns: true }
    }

    /// Adds what a force on the coordinates does to the block.
    fn pass(&self, force: &Vector3<f64>, rows: &mut [f64]) {
        let row = &mut rows[6 * self.body..6 * self.body + 6];
        let angular = self.angular.tr_mul(force);
        for x in 0..3 {
            if self.linear {
                row[x] += force[x];
            }
            row[3 + x] += angular[x];
        }
    }

    /// Returns the increments of the coordinates.
    fn moved(&self, rows: &[f64]) -> Vector3<f64> {
        let of = &rows[6 * self.body..6 * self.body + 6];
        let rotated = self.angular * vector(&of[3..]);
        if self.linear { vector(of) + rotated } else { rotated }
    }

    /// Of the forces of a contact, or the slope of a cut, of which two are a block from `first` on.
    pub fn of_own(first: usize, number: usize) -> Self {
        Self::own(first + number / 2)[number % 2]
    }

    /// Of a body's own velocity and angular velocity.
    pub fn own(body: usize) -> [Self; 2] {
        [
            Lever { body, linear: true, angular: Matrix3::zeros(), turns: false },
            Lever { body, linear: false, angular: Matrix3::identity(), turns: true },
        ]
    }
}

impl Bordered {
    /// Makes room for a number of cables.
    pub fn resize(&mut self, cables: usize) {
        self.cables.resize_with(cables, Beside::default);
    }

    /// Returns the condensed matrix of a cable.
    pub fn cable(&mut self, cable: usize) -> &mut Condensed {
        &mut self.cables[cable].condensed
    }

    /// Begins the border anew for a number of bodies, the cuts of cables, and a number of contacts
    /// between cables. Two cuts, or two contacts, are a block.
    pub fn begin(&mut self, bodies: usize, cuts: impl Iterator<Item = usize> + Clone, contacts: usize) {
        let first = bodies + cuts.clone().map(cuts::blocks).sum::<usize>();
        let count = first + contacts.div_ceil(2);
        self.sparse.begin(count);
        (first..count).for_each(|block| self.sparse.set_negative(block));
        let mut end = bodies;
        for cuts in cuts {
            end += cuts::blocks(cuts);
            if cuts % 2 == 1 {
                // half of the last block is nobody's
                let block = self.sparse.block(end - 1, end - 1);
                (3..6).for_each(|x| block.0[x][x] = 1.0);
            }
        }
    }

    /// Adds the inertia of a body in world axes.
    pub fn add_inertia(&mut self, body: usize, inertia: &Matrix6<f64>) {
        add(self.sparse.block(body, body), inertia);
    }

    /// Adds an inertia that couples two bodies, in world axes.
    pub fn add_coupled(&mut self, coupled: &CoupledInertia) {
        let [one, two] = coupled.bodies;
        let transposed = coupled.matrix.transpose();
        add(self.sparse.block(one.max(two), one.min(two)), if one < two { &transposed } else { &coupled.matrix });
        if one == two {
            add(self.sparse.block(one, one), &transposed);
        }
    }

    /// Adds a block to the rotations of a body.
    pub fn add_rotational(&mut self, body: usize, block: &Matrix3<f64>) {
        self.sparse.block(body, body).add(3, 3, block);
    }

    /// Returns what the coordinates of a cable in the border follow, to be set before it is added
    /// or reduced.
    pub fn levers(&mut self, cable: usize) -> &mut Vec<Lever> {
        &mut self.cables[cable].levers
    }

    /// Adds a condensed cable, to the blocks on and below the diagonal.
    pub fn add_cable(&mut self, cable: usize) {
        let Beside { condensed, levers: list, .. } = &mut self.cables[cable];
        condensed.w.for_each(|[a, b], block| {
            let (one, other) = (&list[a], &list[b]);
            if other.body <= one.body {
                add_coupling(self.sparse.block(one.body, other.body), [one, other], &block);
            }
            if a != b && one.body <= other.body {
                add_coupling(self.sparse.block(other.body, one.body), [other, one], &block.transpose());
            }
        });
    }

    /// Locks the axes of a body that are not free.
    pub fn lock(&mut self, body: usize, free: &[bool; 6]) {
        self.sparse.lock(body, free);
    }

    /// Factors it.
    ///
    /// # Errors
    /// If it is singular or not finite.
    pub fn factor(&mut self) -> Result<(), StepFailure> {
        Ok(self.sparse.factor()?)
    }

    /// Brings a cable half of the way from its rows to its increments, and adds what it does to the
    /// rows of the border. The factors are those with which it was condensed.
    pub fn reduce(
        &mut self,
        cable: usize,
        (level, factors): (Level, &Factorisation),
        rhs: &mut [f64],
        rows: &mut [f64],
    ) {
        let Beside { condensed, levers, values } = &mut self.cables[cable];
        condensed.reduce(level, factors, rhs, values);
        for (lever, reduced) in levers.iter().zip(values.chunks_exact(3)) {
            lever.pass(&-vector(reduced), rows);
        }
    }

    /// Returns the number of rows of the border.
    pub fn rows(&self) -> usize {
        self.sparse.size()
    }

    /// Solves for the border in place.
    pub fn solve(&mut self, rows: &mut [f64]) {
        self.sparse.solve(rows);
    }

    /// Completes the increments of a cable with those of the border, and returns those of its
    /// coordinates in the border, three numbers each.
    pub fn expand<'a>(
        &'a mut self,
        cable: usize,
        (level, factors): (Level, &Factorisation),
        rhs: &mut [f64],
        rows: &[f64],
    ) -> &'a [f64] {
        let Beside { condensed, levers, values } = &mut self.cables[cable];
        values.clear();
        values.extend(levers.iter().flat_map(|lever| <[f64; 3]>::from(lever.moved(rows))));
        condensed.expand(level, factors, values, rhs);
        values
    }

    /// Returns the number of products of blocks of six that condensation and factors take.
    #[cfg(test)]
    pub fn products(&self) -> usize {
        self.sparse.products() + self.cables.iter().map(|cable| cable.condensed.products()).sum::<usize>()
    }

    /// Returns the number of its negative eigenvalues, without those of the cables.
    pub fn negative(&self) -> usize {
        self.sparse.negative()
    }
}

/// Adds what couples the coordinates of two levers to the block of what they follow.
fn add_coupling(out: &mut Block, [one, other]: [&Lever; 2], block: &Matrix3<f64>) {
    if other.turns {
        let rotated = block * other.angular;
        if one.turns {
            out.add(3, 3, &(one.angular.transpose() * rotated));
        }
        if one.linear {
            out.add(0, 3, &rotated);
        }
    }
    if one.turns && other.linear {
        out.add(3, 0, &(one.angular.transpose() * block));
    }
    if one.linear && other.linear {
        out.add(0, 0, block);
    }
}

fn add(block: &mut Block, matrix: &Matrix6<f64>) {
    for (out, column) in block.0.iter_mut().zip(matrix.column_iter()) {
        out.iter_mut().zip(&column).for_each(|(x, y)| *x += y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{PairColumns, PairEnd};
    use crate::island::condense::Columns;
    use crate::linalg::BlockTridiagonal;
    use nalgebra::{DMatrix, DVector};

    /// Two cables of seven and five nodes with contacts of each with itself and with the other, few
    /// and many, soft and stiff, satisfy `(T + R^T R) x = r`: x is a difference, whose rounding
    /// times the stiffness is what is left.
    ///
    /// *Source.* The equation itself, with the matrix in full.
    #[test]
    fn contacts_between_cables_are_solved_with_the_cables() {
        let mut state = 11u64;
        let mut next = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let (nodes, starts, level) = ([7, 5], [0, 42], Level::new());
        for (contacts, stiffness) in [(1, 1e3), (2, 1e3), (7, 1e5), (40, 1.0), (60, 1e5)] {
            let mut full = DMatrix::<f64>::zeros(72, 72);
            let matrices = [0, 1].map(|c| {
                let mut matrix = BlockTridiagonal::zeros(nodes[c]);
                for node in 0..nodes[c] {
                    for x in 0..6 {
                        matrix.diag[node].0[x][x] = 8.0 + next();
                        for y in (0..6).filter(|_| node + 1 < nodes[c]) {
                            matrix.lower[node].0[x][y] = 0.5 * next();
                            let at = starts[c] + 6 * node;
                            full[(at + 6 + y, at + x)] = matrix.lower[node].0[x][y];
                            full[(at + x, at + 6 + y)] = matrix.lower[node].0[x][y];
                        }
                        let at = starts[c] + 6 * node + x;
                        full[(at, at)] = matrix.diag[node].0[x][x];
                    }
                }
                matrix
            });
            let pairs: Vec<PairColumns> = (0..contacts)
                .map(|k| {
                    let scale = f64::sqrt(stiffness * (1 + k % 7) as f64);
                    let ends = [(k % 2, k % 4), ((k / 2) % 2, (k / 3 + 1) % 4)];
                    ends.map(|(strand, element)| PairEnd {
                        strand,
                        element,
                        columns: core::array::from_fn(|_| core::array::from_fn(|_| scale * next())),
                    })
                })
                .collect();
            for x in 0..3 {
                for pair in &pairs {
                    let mut row = DVector::<f64>::zeros(72);
                    for end in pair {
                        let at = starts[end.strand] + 6 * end.element;
                        (0..12).for_each(|i| row[at + i] += end.columns[x][i]);
                    }
                    full += &row * row.transpose();
                }
            }
            let mut bordered = Bordered::default();
            bordered.resize(2);
            bordered.begin(0, [].into_iter(), contacts);
            let mut factors = [Factorisation::default(), Factorisation::default()];
            let own =
                [0, 1].map(|c| (0..contacts).filter(|&k| pairs[k].iter().any(|e| e.strand == c)).collect::<Vec<_>>());
            let levers = |c: usize| own[c].iter().map(|&k| Lever::of_own(0, k));
            for c in 0..2 {
                factors[c].factor(level, &matrices[c]).unwrap();
                let columns = Columns { strand: c, pairs: &pairs, own: &own[c], ..Columns::default() };
                bordered.cable(c).read(&matrices[c], &[], &[]);
                bordered.cable(c).complete(level, &factors[c], columns, |_, _| {});
                bordered.levers(c).extend(levers(c));
                bordered.add_cable(c);
            }
            bordered.factor().unwrap();
            assert!(bordered.negative() > 0);
            let right = DVector::from_fn(72, |_, _| next());
            let mut x = right.as_slice().to_vec();
            let mut rows = vec![0.0; bordered.rows()];
            let (first, second) = x.split_at_mut(42);
            for (c, part) in [(0, &mut *first), (1, &mut *second)] {
                bordered.reduce(c, (level, &factors[c]), part, &mut rows);
            }
            bordered.solve(&mut rows);
            for (c, part) in [(0, first), (1, second)] {
                bordered.expand(c, (level, &factors[c]), part, &rows);
            }
            let off = (full * DVector::from_vec(x) - &right).norm() / right.norm();
            println!("{contacts} contacts of {stiffness:e}: off by {off:.1e}");
            assert!(off < 1e-7, "{contacts} contacts of {stiffness:e}: {off:e}");
        }
    }
}
