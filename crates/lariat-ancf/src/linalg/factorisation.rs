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
use crate::simd::dispatch;
use fearless_simd::Level;

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

    /// Factors `a` if it is safely positive definite, and returns whether it is.
    ///
    /// # Panics
    /// As [`factor`](Self::factor).
    pub fn factor_if_definite(&mut self, level: Level, a: &BlockTridiagonal) -> bool {
        a.check();
        self.state = State::Empty;
        self.nodes.resize(a.nodes(), Node::ZERO);
        let nodes = &mut self.nodes[..];
        let definite = nodes.is_empty() || dispatch!(level, simd => twisted::factor(simd, a, nodes));
        if definite {
            self.state = State::Twisted;
        }
        definite
    }

    fn factor_with(&mut self, level: Level, a: &BlockTridiagonal, count: bool) -> Result<Definiteness, SingularMatrix> {
        if self.factor_if_definite(level, a) {
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
        assert_eq!(rhs.len(), 6 * self.nodes.len(), "length of the right-hand side");
        assert_ne!(self.state, State::Empty, "no factorisation to solve with");
        if rhs.is_empty() {
            return;
        }
        match self.twisted() {
            Some(nodes) => {
                let (sixes, _) = rhs.as_chunks_mut::<6>();
                dispatch!(level, simd => substitution::solve(simd, nodes, sixes));
            }
            None => self.banded.solve(level, rhs),
        }
    }

    /// Returns the factors of a positive definite matrix; `None` if there are others.
    pub(super) fn twisted(&self) -> Option<&[Node]> {
        (self.state == State::Twisted).then_some(&self.nodes[..])
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
