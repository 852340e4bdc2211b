//! Projected strain: the default. Neither locks nor has zero-energy modes.
//!
//! # Equation
//!
//! The Green strain of an element is quartic in xi; a bent inextensible element cannot make all of
//! it vanish, which is membrane locking. Projected on linear functions of xi it can. A share delta
//! of the exact energy stiffens the one mode that is left:
//!
//! ```text
//! U = EA l/8 [ (1 - delta) ((a.g - 1)^2 + 12 (d.g)^2) + delta (g.A.g - 2 a.g + 1) ]
//! a = int b,   d = int (xi - 1/2) b,   delta = 1e-3
//! ```
//!
//! # Validity
//!
//! With bending by two points or more, T1 or T2. Measured by `tests/pendulum.rs` and
//! `tests/elastica.rs`: 10 elements, the paper's pendulum against the real beam 2.4e-3 m, exact
//! strain 1.1e-2 m.
//!
//! # References
//!
//! Assumed-strain / B-bar projection (Hughes 2000, section 4.5; Simo & Hughes 1986), applied to
//! this element here.
//!
//! # Alternatives considered
//!
//! Two-point axial quadrature (one zero-energy mode); mean strain with full curvature (two); delta
//! = 0 (one); delta = 1e-2 locks again in part.

use super::{AxialTable, add_outer, exact, moment};
pub use crate::scales::element::DELTA;

/// Creates the table of the projected-strain rule.
pub fn table() -> AxialTable {
    let (a, d) = (moment(|_| 1.0), moment(|xi| xi - 0.5));
    let exact = exact::table();
    let mut matrix = exact.matrix.map(|x| DELTA * x);
    add_outer(&mut matrix, 1.0 - DELTA, &a);
    add_outer(&mut matrix, 12.0 * (1.0 - DELTA), &d);
    AxialTable::new(a, matrix).with_linear(d)
}
