//! One factorisation for many solutions: [`twisted`](super::twisted) for positive definite
//! matrices, [`banded`](super::banded) for all others.
//!
//! # Equation
//!
//! A x = b.
//!
//! # Validity
//!
//! A factorisation that returned `Ok` solves without NaN for finite right-hand sides that do not
//! overflow; after an `Err` there are no factors, and `solve` panics.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 4.5.1.
//!
//! # Alternatives considered
//!
//! - A choice by the caller: a matrix turns out to be indefinite only during the elimination.
//! - The unpivoted factors of an indefinite matrix: their growth is unbounded.

use super::banded::Banded;
use super::block::BlockTridiagonal;
use super::outcome::{Definiteness, SingularMatrix};
use super::substitution;
use super::twisted::{self, Node};
use fearless_simd::{Level, dispatch};

/// Which factors are in the buffers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum State {
    #[default]
    Empty,
    Twisted,
    Banded(Definiteness),
}

/// A factored block-tridiagonal matrix, with buffers that are reused.
#[derive(Clone, Debug, Default)]
pub struct Factorisation {
    nodes: Vec<Node>,
    banded: Banded,
    state: State,
}

impl Factorisation {
    /// Factors `a`. Allocates only if it is larger than all previous matrices, and for the first
    /// matrix that is not positive definite.
    ///
    /// # Errors
    /// If the matrix is singular to working precision or has an entry that is not finite.
    ///
    /// # Panics
    /// If the numbers of diagonal and lower blocks do not match.
    pub fn factor(&mut self, level: Level, a: &BlockTridiagonal) -> Result<Definiteness, SingularMatrix> {
        self.factor_with(level, a, true)
    }

    /// Factors `a` as [`factor`](Self::factor) does, without counting negative eigenvalues: a
    /// matrix that is positive definite except for rounding may then be called indefinite. The
    /// factors are the same.
    ///
    /// # Errors
    /// As [`factor`](Self::factor).
    pub fn factor_to_solve(&mut self, level: Level, a: &BlockTridiagonal) -> Result<Definiteness, SingularMatrix> {
        self.factor_with(level, a, false)
    }

    fn factor_with(&mut self, level: Level, a: &BlockTridiagonal, count: bool) -> Result<Definiteness, SingularMatrix> {
        a.check();
        self.state = State::Empty;
        self.nodes.resize(a.nodes(), Node::ZERO);
        let nodes = &mut self.nodes[..];
        if nodes.is_empty() || dispatch!(level, simd => twisted::factor(simd, a, nodes)) {
            self.state = State::Twisted;
            return Ok(Definiteness::PositiveDefinite);
        }
        let definiteness = self.banded.factor(level, a, count)?;
        self.state = State::Banded(definiteness);
        Ok(definiteness)
    }

    /// Returns the number of nodes of the factored matrix.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// Replaces `rhs` (6 numbers per node) by A^-1 rhs.
    ///
    /// # Panics
    /// If nothing has been factored successfully or the length does not match.
    pub fn solve(&self, level: Level, rhs: &mut [f64]) {
        self.solve_many(level, rhs, 1);
    }

    /// Solves for `count` right-hand sides, each contiguous, with the same bits as one `solve` for
    /// each.
    ///
    /// # Panics
    /// If nothing has been factored successfully or the length does not match.
    pub fn solve_many(&self, level: Level, rhs: &mut [f64], count: usize) {
        let n = self.nodes.len();
        assert_eq!(rhs.len(), 6 * n * count, "length of the right-hand sides");
        assert_ne!(self.state, State::Empty, "no factorisation to solve with");
        if n == 0 {
            return;
        }
        if self.state != State::Twisted {
            for one in rhs.chunks_exact_mut(6 * n) {
                self.banded.solve(level, one);
            }
            return;
        }
        let nodes = &self.nodes[..];
        let (sixes, _) = rhs.as_chunks_mut::<6>();
        let mut fours = sixes.chunks_exact_mut(4 * n);
        for four in &mut fours {
            let (ab, cd) = four.split_at_mut(2 * n);
            let (a, b) = ab.split_at_mut(n);
            let (c, d) = cd.split_at_mut(n);
            dispatch!(level, simd => substitution::solve(simd, nodes, [a, b, c, d]));
        }
        for one in fours.into_remainder().chunks_exact_mut(n) {
            dispatch!(level, simd => substitution::solve(simd, nodes, [one]));
        }
    }

    /// Returns the number of negative eigenvalues, if it is certain.
    pub fn negative_eigenvalues(&self) -> Option<usize> {
        match self.state {
            State::Twisted => Some(0),
            State::Banded(Definiteness::PositiveDefinite) => Some(0),
            State::Banded(Definiteness::Indefinite { negative }) => negative,
            State::Empty => None,
        }
    }

    /// Returns the sign of the determinant, 1.0 or -1.0; `None` if nothing has been factored.
    pub fn determinant_sign(&self) -> Option<f64> {
        match self.state {
            State::Twisted => Some(1.0),
            State::Banded(_) => Some(self.banded.determinant_sign()),
            State::Empty => None,
        }
    }
}
