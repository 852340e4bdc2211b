//! Linear equations with the contacts between cables: a matrix that is factored, and rows of few.
//!
//! # Equation
//!
//! ```text
//! (T + B^T B) x = r        S = 1 + B T^-1 B^T,   S z = B T^-1 r,   x = T^-1 (r - B^T z)
//! ```
//!
//! T is that of the cables and bodies without these contacts, B has up to three rows per contact. With few rows S is summed and factored: one solution with T
//! per row. With many, S z = b is solved by conjugate gradients, one solution with T per iteration, until the forces that are left, `B^T (b - S z)`, are
//! small beside those of the contacts, `B^T z`: the residual b - S z itself would leave forces that grow with their stiffness.
//!
//! # References
//!
//! Woodbury 1950; Golub & Van Loan 2013, sections 2.1.4 and 11.3.
//!
//! # Alternatives considered
//!
//! Conjugate gradients on T + B^T B with T as preconditioner: as many iterations, but a residual in the units of coordinates. A share of the first
//! residual as the end of the iterations (forces off by 4e-3 with stiff contacts: the test of this file).

use crate::error::StepFailure;
use crate::linalg::Dense;

/// Largest number of rows with which S is factored.
const MOST_FACTORED: usize = 100;
/// Share of the contact forces below which what conjugate gradients leave of them is small.
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
        let square = |row: &Row| row.iter().flat_map(|(_, _, part)| part).map(|x| x * x).sum::<f64>();
        let mean = rows.iter().map(square).sum::<f64>() / n as f64;
        scale.clear();
        scale.extend(rows.iter().map(|row| 1.0 / (square(row) + 1e-6 * mean).max(f64::MIN_POSITIVE)));
        // what is left of (T + B^T B) x = r are the forces B^T residual
        let force = |z: &[f64], scale: &[f64]| z.iter().zip(scale).map(|(z, s)| z * z / s).sum::<f64>();
        residual.clone_from(z);
        z.fill(0.0);
        direction.clear();
        direction.extend(residual.iter().zip(&*scale).map(|(r, s)| r * s));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut size = dot(residual, direction);
        for _ in 0..MOST_ITERATIONS * n {
            if force(residual, scale) <= TOLERANCE * TOLERANCE * force(z, scale) || size <= 0.0 {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Coordinates of ten elements under a diagonal matrix.
    struct OnDiagonal {
        diagonal: Vec<f64>,
        x: Vec<f64>,
        saved: Vec<f64>,
    }

    impl PairSystem for OnDiagonal {
        fn clear(&mut self) {
            self.x.fill(0.0);
        }

        fn add(&mut self, row: &Row, scale: f64) {
            for (_, element, part) in row {
                self.x[6 * element..6 * element + 12].iter_mut().zip(part).for_each(|(x, part)| *x += scale * part);
            }
        }

        fn solve(&mut self) {
            self.x.iter_mut().zip(&self.diagonal).for_each(|(x, d)| *x /= d);
        }

        fn read(&self, row: &Row) -> f64 {
            let parts =
                row.iter().flat_map(|(_, element, part)| self.x[6 * element..6 * element + 12].iter().zip(part));
            parts.map(|(x, part)| x * part).sum()
        }

        fn save(&mut self) {
            self.saved.clone_from(&self.x);
        }

        fn subtract(&mut self) {
            self.x.iter_mut().zip(&self.saved).for_each(|(x, saved)| *x = saved - *x);
        }
    }

    /// The solution satisfies `(T + B^T B) x = r`, with few rows, which are factored, and with many, which are iterated, whatever their stiffness.
    ///
    /// *Source.* The equation itself.
    #[test]
    fn the_solution_satisfies_the_equation_with_few_rows_and_with_many() {
        for (count, stiffness) in [(3, 1e3), (MOST_FACTORED, 1e3), (MOST_FACTORED + 1, 1.0), (160, 1e3), (240, 1e5)] {
            let mut seed = 0.37 + 1e-3 * count as f64;
            let mut next = || {
                seed = (seed * 997.0 + 0.123_f64).fract();
                2.0 * seed - 1.0
            };
            let mut low_rank = LowRank::default();
            for k in 0..count {
                let scale = f64::sqrt(stiffness * (1.0 + (k % 7) as f64));
                let [one, other] = [k % 10, (k / 10 + 3) % 10];
                let [first, second] = [0, 1].map(|_| core::array::from_fn(|_| scale * next()));
                low_rank.push([(0, one, first), (0, other, second)]);
            }
            let diagonal: Vec<f64> = (0..66).map(|i| 1.0 + 0.3 * f64::from(i % 5)).collect();
            let right: Vec<f64> = (0..66).map(|_| next()).collect();
            let mut system = OnDiagonal { diagonal, x: right.clone(), saved: Vec::new() };
            // factoring uses the right-hand side
            let rows = low_rank.rows.clone();
            low_rank.factor(&mut system).unwrap();
            system.x.clone_from(&right);
            system.solve();
            low_rank.complete(&mut system);
            let solution = system.x.clone();
            let products: Vec<f64> = rows.iter().map(|row| system.read(row)).collect();
            for (i, x) in system.x.iter_mut().enumerate() {
                *x = system.diagonal[i] * solution[i] - right[i];
            }
            rows.iter().zip(products).for_each(|(row, product)| system.add(row, product));
            let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
            let off = size(&system.x) / size(&right);
            println!("{count} rows of {stiffness:e}: off by {off:.1e}");
            assert!(off < 1e-6, "{count} rows of {stiffness:e}: {off:e}");
        }
    }
}
