//! The solution of linear equations to whose matrix a few columns are added.
//!
//! # Equation
//!
//! ```text
//! (A0 + sum b_s g_s g_s^T) x = r
//! x = x0 - Y C^-1 (g_s.x0)        x0 = A0^-1 r,  y_s = A0^-1 g_s,  C = diag(1/b_s) + (g_s.y_t)
//! n_-(A) = n_-(A0) - n_-(C)
//! ```
//!
//! n_- is the number of negative eigenvalues: without the second line statics would take a stable
//! twisted cable for an unstable one.
//!
//! # Validity
//!
//! A0 that is not singular. The cost of each column is that of one more right-hand side.
//!
//! # References
//!
//! Sherman & Morrison 1950; Haynsworth, Linear Algebra Appl. 1 (1968) 73 (additivity of inertia).
//!
//! # Alternatives considered
//!
//! The torque as one more unknown of the border of an island: its coordinates stand there in
//! threes, so that one torque would take three columns; and a cable by itself has no border.

use crate::linalg::{Dense, SingularMatrix};

/// C, factored.
#[derive(Clone, Debug, Default)]
pub(crate) struct RankUpdate {
    matrix: Vec<f64>,
    factors: Dense,
    forces: Vec<f64>,
}

impl RankUpdate {
    /// Factors C: `stiffness(s)` is b_s, `product(s, t)` is g_s.y_t.
    ///
    /// # Errors
    /// If it is singular.
    pub fn factor(
        &mut self,
        count: usize,
        stiffness: impl Fn(usize) -> f64,
        product: impl Fn(usize, usize) -> f64,
    ) -> Result<(), SingularMatrix> {
        self.matrix.clear();
        for s in 0..count {
            for t in 0..count {
                let own = if s == t { stiffness(s).recip() } else { 0.0 };
                self.matrix.push(own + product(s, t));
            }
        }
        self.factors.factor(&self.matrix, count)
    }

    /// Returns n_-(C).
    pub fn negative(&self) -> usize {
        self.factors.negative()
    }

    /// Returns by what factor each column y_s is to be subtracted from a solution x0 of which
    /// `product(s)` is g_s.x0.
    pub fn forces(&mut self, count: usize, product: impl Fn(usize) -> f64) -> &[f64] {
        self.forces.clear();
        self.forces.extend((0..count).map(product));
        self.factors.solve(&mut self.forces);
        &self.forces
    }
}
