//! Projected strain: the default. Neither locks nor leaves modes without energy.
//!
//! The Green strain of an element is quartic in xi; a bent inextensible element cannot make all of it vanish, which is
//! membrane locking. Projected on linear functions of xi it can. A share delta of the exact energy keeps the one mode that
//! is left:
//!
//! ```text
//! U = EA l/8 [ (1 - delta) ((a.g - 1)^2 + 12 (d.g)^2) + delta (g.A.g - 2 a.g + 1) ]
//! a = int b,   d = int (xi - 1/2) b,   delta = 1e-3
//! ```
//!
//! *Source.* Assumed-strain / B-bar projection (Hughes 2000, section 4.5; Simo & Hughes 1986), applied to this element here.
//! *Validity.* With 2-point bending or more, T1 or T2. *Measured* (`tests/pendulum.rs`, `tests/elastica.rs`): 10 elements,
//! paper's pendulum against the real beam 2.4e-3 m, exact strain 1.1e-2 m. *Rejected.* Two-point axial quadrature (a zero-energy
//! mode); mean strain with full curvature (two); delta = 0 (one); 1e-2 locks again in part.

use super::{AxialTable, add_outer, exact, moment};

/// Share of the exact energy.
pub const DELTA: f64 = 1e-3;

/// The projected-strain rule.
pub fn table() -> AxialTable {
    let (a, d) = (moment(|_| 1.0), moment(|xi| xi - 0.5));
    let exact = exact::table();
    let mut matrix = exact.matrix.map(|x| DELTA * x);
    add_outer(&mut matrix, 1.0 - DELTA, &a);
    add_outer(&mut matrix, 12.0 * (1.0 - DELTA), &d);
    AxialTable::new(a, matrix)
}
