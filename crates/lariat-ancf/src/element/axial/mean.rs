//! Mean Green strain: one strain for the whole element.
//!
//! # Equation
//!
//! `U = EA l/8 (a.g - 1)^2`, so `A = a a^T`.
//!
//! # Validity
//!
//! Together with T1 or T2, which keep |r'| constant in the element; beside a full-curvature rule it
//! leaves two zero-energy modes per element.
//!
//! # References
//!
//! Our reading of model L2 of Berzeri & Shabana 2000, as used by Bulin & Hajzman ("L2T2"); the text
//! that defines L2 was not available. With T2 as it stands here the pendulum is 1.67e-2 m from
//! G10-10 with 10 elements (`lariat table1`) where the paper prints 1.02e-2; T2 with the stretch of
//! the chord would give 1.17e-2 (assets/reference/table1_reproduction.csv), but then T2 would be
//! another model than in ST2, where it reproduces the paper.
//!
//! # Alternatives considered
//!
//! Strain of the chord: farther from the real beam (assets/reference/pendulum_convergence.json,
//! L1chord).

use super::{AxialTable, add_outer, moment};

/// The mean-strain rule.
pub fn table() -> AxialTable {
    let a = moment(|_| 1.0);
    let mut matrix = [0.0; 21];
    add_outer(&mut matrix, 1.0, &a);
    AxialTable::new(a, matrix)
}
