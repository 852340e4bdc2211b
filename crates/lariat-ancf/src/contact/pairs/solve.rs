//! Linear equations with the contacts between cables: a matrix that is factored, and rows of few.
//!
//! # Equation
//!
//! ```text
//! (T + B^T B) x = r        S = 1 + B T^-1 B^T,   S z = B T^-1 r,   x = T^-1 (r - B^T z)
//! ```
//!
//! T is that of the cables and bodies without these contacts, B has up to three rows per contact. With few rows S is summed and factored: one solution with T
//! per row. With many, S z is found by conjugate gradients, one solution with T per iteration.
//!
//! # References
//!
//! Woodbury 1950; Golub & Van Loan 2013, sections 2.1.4 and 11.3.
//!
//! # Alternatives considered
//!
//! Conjugate gradients on T + B^T B with T as preconditioner: as many iterations, but a residual in the units of coordinates.

use crate::error::StepFailure;
use crate::linalg::Dense;

/// Largest number of rows with which S is factored.
const MOST_FACTORED: usize = 100;
/// Share of its start to which conjugate gradients reduce the residual.
const TOLERANCE: f64 = 1e-7;
/// Iterations of these per row.
const MOST_ITERATIONS: usize = 2;

/// A row of B: by end, the strand, the element, and the row over its coordinates.
pub(crate) type Row = [(usize, usize, [f64; 12]); 2];

/// The rows, and S.
#[derive(Clone, Debug, Default)]
pub(crate) struct LowRank {
    rows: Vec<Row>,
    matrix: Vec<f64>,
    factors: Dense,
    /// Solution, residual, direction, its product, and the diagonal of S nearly.
    vectors: [Vec<f64>; 5],
}

/// The equations with T.
pub(crate) trait PairSystem {
    /// Sets the right-hand side to zero.
    fn clear(&mut self);

    /// Adds `scale` times a row to the right-hand side.
    fn add(&mut self, row: &Row, scale: f64);

    /// Solves in place.
    fn solve(&mut self);

    /// Returns the product of a row with the solution.
    fn read(&self, row: &Row) -> f64;

    /// Puts the solution aside.
    fn save(&mut self);

    /// Sets the solution to the one that was put aside less itself.
    fn subtract(&mut self);
}

impl LowRank {
    pub fn clear(&mut self) {
        self.rows.clear();
    }

    pub fn push(&mut self, row: Row) {
        self.rows.push(row);
    }

    /// Sums and factors S, if it is small.
    ///
    /// # Errors
    /// If it is singular.
    pub fn factor(&mut self, system: &mut impl PairSystem) -> Result<(), StepFailure> {
        let n = self.rows.len();
        if n == 0 || n > MOST_FACTORED {
            return Ok(());
        }
        self.matrix.clear();
        self.matrix.resize(n * n, 0.0);
        for k in 0..n {
            system.clear();
            system.add(&self.rows[k], 1.0);
            system.solve();
            for i in k..n {
                self.matrix[i * n + k] = system.read(&self.rows[i]);
            }
            self.matrix[k * n + k] += 1.0;
        }
        Ok(self.factors.factor(&self.matrix, n)?)
    }

    /// Completes a solution with T to one with the contacts.
    pub fn complete(&mut self, system: &mut impl PairSystem) {
        let n = self.rows.len();
        if n == 0 {
            return;
        }
        let z = &mut self.vectors[0];
        z.clear();
        z.extend(self.rows.iter().map(|row| system.read(row)));
        system.save();
        if n <= MOST_FACTORED {
            self.factors.solve(z);
        } else {
            self.iterate(system);
        }
        system.clear();
        for (row, z) in self.rows.iter().zip(&self.vectors[0]) {
            system.add(row, *z);
        }
        system.solve();
        system.subtract();
    }

    /// Solves S z = b by conjugate gradients, b in the first vector.
    fn iterate(&mut self, system: &mut impl PairSystem) {
        let LowRank { rows, vectors: [z, residual, direction, product, scale], .. } = self;
        let n = rows.len();
        // rows differ by the stiffness of their contacts
        scale.clear();
        scale.extend(rows.iter().map(|row| row.iter().flat_map(|(_, _, part)| part).map(|x| x * x).sum::<f64>()));
        let mean = scale.iter().sum::<f64>() / n as f64;
        scale.iter_mut().for_each(|x| *x = 1.0 / (*x + 1e-6 * mean).max(f64::MIN_POSITIVE));
        residual.clone_from(z);
        z.fill(0.0);
        direction.clear();
        direction.extend(residual.iter().zip(&*scale).map(|(r, s)| r * s));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut size = dot(residual, direction);
        let enough = TOLERANCE * TOLERANCE * size;
        for _ in 0..MOST_ITERATIONS * n {
            if size <= enough {
                return;
            }
            system.clear();
            rows.iter().zip(&*direction).for_each(|(row, d)| system.add(row, *d));
            system.solve();
            product.clear();
            product.extend(rows.iter().zip(&*direction).map(|(row, d)| d + system.read(row)));
            let step = size / dot(direction, product);
            if !step.is_finite() {
                return;
            }
            for i in 0..n {
                z[i] += step * direction[i];
                residual[i] -= step * product[i];
            }
            let next: f64 = (0..n).map(|i| residual[i] * residual[i] * scale[i]).sum();
            let keep = next / size;
            size = next;
            for i in 0..n {
                direction[i] = residual[i] * scale[i] + keep * direction[i];
            }
        }
    }
}
