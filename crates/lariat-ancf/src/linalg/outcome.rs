//! The outcome of a factorisation: the signs of the eigenvalues, or why it failed.

/// The signs of the eigenvalues, as far as they are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definiteness {
    /// All eigenvalues are positive.
    PositiveDefinite,
    /// Not positive definite.
    Indefinite {
        /// Number of negative eigenvalues; `None` where rounding leaves the count uncertain.
        negative: Option<usize>,
    },
}

/// Why a matrix could not be factored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// An entry is NaN or infinite, or the elimination overflowed.
    NonFinite,
    /// No usable pivot: the matrix is singular.
    Pivot,
    /// The estimated reciprocal condition number is below the bound: singular to working precision.
    Condition,
    /// Entries grew so much during the elimination that the factors are worthless.
    Growth,
    /// A mass matrix that is not positive definite.
    NotPositive,
}

/// The matrix is singular to working precision, or not finite.
#[derive(thiserror::Error, Debug, Clone, PartialEq)]
#[error("matrix cannot be factored at node {node}: {reason:?} (pivot {pivot:e}, scale {scale:e})")]
#[non_exhaustive]
pub struct SingularMatrix {
    /// Node of the offending entry or of the smallest pivot.
    pub node: usize,
    /// The smallest pivot (of the equilibrated matrix for the general path), 0 if there is none.
    pub pivot: f64,
    /// What the pivot is measured against: the largest entry (same scaling), 0 if there is none.
    pub scale: f64,
    /// What went wrong.
    pub reason: Reason,
}
