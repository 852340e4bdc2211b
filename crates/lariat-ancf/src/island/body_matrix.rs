//! The matrix of an island's bodies: their inertia, and the cables condensed on the held coordinates.
//!
//! # Equation
//!
//! ```text
//! B + sum G^T W G          G = (1, -[arm]x) of a held position, (0, -[arm]x) of a held slope, 1 of a touched body
//! ```

use super::coupling::CoupledInertia;
use super::rotation::skew;
use crate::error::StepFailure;
use crate::linalg::Dense;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// The matrix, and its factors.
#[derive(Clone, Debug, Default)]
pub(super) struct BodyMatrix {
    /// Row-major; above the diagonal blocks it is not complete.
    entries: Vec<f64>,
    dense: Dense,
    /// Number of rows.
    n: usize,
    levers: Vec<Lever>,
}

/// Three coordinates that follow a body, by `G = (linear 1, angular)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lever {
    pub body: usize,
    pub linear: bool,
    pub angular: Matrix3<f64>,
}

impl Lever {
    /// Of held coordinates with an arm; those of a slope only turn.
    pub fn held(body: usize, arm: &Vector3<f64>, slope: bool) -> Self {
        Lever { body, linear: !slope, angular: -skew(arm) }
    }

    /// Of a body's own velocity and angular velocity.
    pub fn own(body: usize) -> [Self; 2] {
        [
            Lever { body, linear: true, angular: Matrix3::zeros() },
            Lever { body, linear: false, angular: Matrix3::identity() },
        ]
    }
}

impl BodyMatrix {
    /// Begins anew for a number of bodies.
    pub fn begin(&mut self, bodies: usize) {
        self.n = 6 * bodies;
        self.entries.clear();
        self.entries.resize(self.n * self.n, 0.0);
    }

    fn add(&mut self, row: usize, column: usize, block: &Matrix3<f64>) {
        for r in 0..3 {
            for c in 0..3 {
                self.entries[(row + r) * self.n + column + c] += block[(r, c)];
            }
        }
    }

    /// Adds the inertia of a body in world axes.
    pub fn add_inertia(&mut self, body: usize, inertia: &Matrix6<f64>) {
        for (r, c) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
            self.add(6 * body + r, 6 * body + c, &inertia.fixed_view::<3, 3>(r, c).into_owned());
        }
    }

    /// Adds an inertia that couples two bodies, in world axes.
    pub fn add_coupled(&mut self, coupled: &CoupledInertia) {
        let [one, two] = coupled.bodies.map(|body| 6 * body);
        for (r, c) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
            let block = coupled.matrix.fixed_view::<3, 3>(r, c).into_owned();
            self.add(one + r, two + c, &block);
            self.add(two + c, one + r, &block.transpose());
        }
    }

    /// Adds a block to the rotations of a body.
    pub fn add_rotational(&mut self, body: usize, block: &Matrix3<f64>) {
        self.add(6 * body + 3, 6 * body + 3, block);
    }

    /// Adds a cable that is condensed on held coordinates, to the blocks on and below the diagonal.
    pub fn add_cable(&mut self, w: &[f64], levers: impl Iterator<Item = Lever>) {
        let mut list = core::mem::take(&mut self.levers);
        list.clear();
        list.extend(levers);
        let count = 3 * list.len();
        for (a, one) in list.iter().enumerate() {
            let (first, turned) = (6 * one.body, one.angular.transpose());
            for (b, other) in list.iter().enumerate().filter(|(_, other)| other.body <= one.body) {
                let second = 6 * other.body;
                let block = Matrix3::from_fn(|r, c| w[(3 * a + r) * count + 3 * b + c]);
                let rotated = block * other.angular;
                self.add(first + 3, second + 3, &(turned * rotated));
                if one.linear {
                    self.add(first, second + 3, &rotated);
                }
                if other.linear {
                    self.add(first + 3, second, &(turned * block));
                }
                if one.linear && other.linear {
                    self.add(first, second, &block);
                }
            }
        }
        self.levers = list;
    }

    /// Locks the axes of a body that are not free.
    pub fn lock(&mut self, body: usize, free: &[bool; 6]) {
        for x in (0..6).filter(|&x| !free[x]) {
            let row = 6 * body + x;
            for j in 0..self.n {
                self.entries[row * self.n + j] = 0.0;
                self.entries[j * self.n + row] = 0.0;
            }
            self.entries[row * self.n + row] = 1.0;
        }
    }

    /// Factors it.
    ///
    /// # Errors
    /// If it is singular or not finite.
    pub fn factor(&mut self) -> Result<(), StepFailure> {
        Ok(self.dense.factor(&self.entries, self.n)?)
    }

    /// Solves in place.
    pub fn solve(&mut self, rows: &mut [f64]) {
        self.dense.solve(rows);
    }

    /// Returns whether it is positive definite.
    pub fn is_positive_definite(&self) -> bool {
        self.dense.is_positive_definite()
    }
}
