//! Projection of accelerations onto the motions that locked axes and active limits leave free.
//!
//! # Equation
//! ```text
//! P = 1 - M^-1 G^T (G M^-1 G^T)^-1 G      a_c = -M^-1 G^T (G M^-1 G^T)^-1 G' v
//! ```
//! Each row of G is a locked axis or a limit. A limit is given up if the accelerations by all loads
//! move the joint away from it. a_c keeps the velocities v on the motions that are free while G
//! turns with the bodies, at the rate G'.

use crate::scales::mechanism::REGULARISATION;
use ::nalgebra::{DMatrix, DVector};

/// A limit of a joint: the side to which it pushes, and the impulse with which it did, in N s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    pub side: f64,
    pub impulse: f64,
}

/// The rows of locked axes and limits.
pub(super) struct Constraints {
    /// G.
    pub rows: DMatrix<f64>,
    /// M^-1 G^T.
    pub spread: DMatrix<f64>,
    /// G' v.
    pub turning: DVector<f64>,
    /// By row, its limit; `None` for a locked axis.
    pub limits: Vec<Option<Limit>>,
    /// Time in s to which the impulses of the limits belong; 1 if there are none.
    pub substep: f64,
}

impl Constraints {
    /// Returns `P columns`, `P free` and a_c, with the limits that are active under the
    /// accelerations `all`.
    pub fn project(
        mut self,
        columns: &DMatrix<f64>,
        free: &DMatrix<f64>,
        all: &DMatrix<f64>,
    ) -> Option<(DMatrix<f64>, DMatrix<f64>, DVector<f64>)> {
        loop {
            let mut matrix = &self.rows * &self.spread;
            for i in 0..matrix.nrows() {
                // a row that nothing moves, or that was given up, holds nothing
                matrix[(i, i)] = if matrix[(i, i)] > 0.0 { matrix[(i, i)] * (1.0 + REGULARISATION) } else { 1.0 };
            }
            let matrix = matrix.cholesky()?;
            let impulses = matrix.solve(&(&self.rows * all)) * -self.substep;
            let opens = |(row, limit): (usize, &Option<Limit>)| {
                limit.is_some_and(|limit| limit.side * (limit.impulse + impulses[row]) < 0.0)
            };
            let Some(row) = self.limits.iter().enumerate().position(opens) else {
                let project = |x: &DMatrix<f64>| x - &self.spread * matrix.solve(&(&self.rows * x));
                let turned = &self.spread * matrix.solve(&self.turning);
                return Some((project(columns), project(free), -turned));
            };
            self.rows.row_mut(row).fill(0.0);
            self.spread.column_mut(row).fill(0.0);
            self.turning[row] = 0.0;
            self.limits[row] = None;
        }
    }
}
