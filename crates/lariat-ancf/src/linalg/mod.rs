//! Linear algebra of a cable: symmetric block-tridiagonal matrices with 6x6 blocks, O(n); and of an
//! island: symmetric sparse matrices of such blocks.
//!
//! Public for users of the matrices of a cable, such as
//! [`Cable::stiffness_matrix`](crate::coupling::Linearisation::stiffness_matrix), and for the
//! benchmarks; a simulation does not call it.
//!
//! # Equation
//!
//! A x = b with A = A^T block tridiagonal, by one of two factorisations, chosen by the matrix:
//! - positive definite: block L D L^T without pivoting, eliminated from both ends towards the
//!   middle node, with the scalar L D L^T inside a block;
//! - otherwise: L U with partial pivoting on the equilibrated band.
//!
//! # Validity
//!
//! `Ok` means that all pivots are safely positive (first factorisation) or that pivot growth and an
//! estimate of the condition number are within their bounds (second); everything else is an error
//! that names a node. Results have the same bits at every SIMD level: all sums have a fixed order
//! and no multiply-add is fused.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., sections 3.5.2, 4.1, 4.3.3 and 4.5.1.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/solvers.md.

mod banded;
mod block;
mod dense;
mod elimination;
mod equilibrate;
mod factorisation;
mod inertia;
mod lanes;
mod mass;
mod outcome;
mod product;
mod schur;
mod sparse;
mod substitution;
mod twisted;

pub use block::{Block, BlockTridiagonal};
pub(crate) use dense::Dense;
pub use factorisation::Factorisation;
pub use mass::{MassFactorisation, MassMatrix};
pub use outcome::{Definiteness, Reason, SingularMatrix};
pub use schur::SchurComplement;
pub(crate) use schur::{GROUP, Span};
pub(crate) use sparse::SparseSymmetric;
