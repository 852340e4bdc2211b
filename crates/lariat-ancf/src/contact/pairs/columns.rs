//! What a contact between cables adds to the linear equations of an iteration.
//!
//! # Equation
//!
//! A contact has the tangent R^T R, with up to three rows R over the coordinates of both elements.
//! Its forces R^T z are unknowns of their own beside those of the bodies:
//!
//! ```text
//! (T + R^T R) x = r        (T R^T; R -1) (x; z) = (r; 0)
//! ```
//!
//! # Validity
//!
//! Any stiffness: the matrix is quasidefinite where T is positive definite, and z is a force, so
//! that it does not become singular as the contact becomes rigid.
//!
//! # References
//!
//! Golub & Van Loan 2013, section 4.5.1 (bordered systems); Vanderbei 1995 (quasidefinite
//! matrices).
//!
//! # Alternatives considered
//!
//! The formula of Woodbury with one whole solution per row, and conjugate gradients from a hundred
//! rows on: docs/decisions/border.md.

/// The columns at one end of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairEnd {
    pub strand: usize,
    pub element: usize,
    /// Over the coordinates of the element.
    pub columns: [[f64; 12]; 3],
}

/// Those of a contact.
pub(crate) type PairColumns = [PairEnd; 2];
