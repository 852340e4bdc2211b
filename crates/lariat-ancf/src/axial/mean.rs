//! Mean Green strain: one strain for the whole element.
//!
//! `U = EA l/8 (a.g - 1)^2`, so `A = a a^T`. *Source.* Our reading of model L2 of Berzeri & Shabana 2000, as used by
//! Bulin & Hajzman ("L2T2"); the text that defines L2 was not available, and the paper's 10-element figure
//! (1.02e-2 m) is met to within 80 % only (see `lariat table1`). *Validity.* Together with T1 or T2, which hold |r'| constant
//! in the element; beside a full-curvature rule two modes per element cost no energy. *Rejected.* Strain of the chord
//! (1.6e-2 m from the real beam where this gives 1.1e-2 with the paper's pendulum; independent solver).

use super::{AxialTable, add_outer, moment};

/// The mean-strain rule.
pub fn table() -> AxialTable {
    let a = moment(|_| 1.0);
    let mut matrix = [0.0; 21];
    add_outer(&mut matrix, 1.0, &a);
    AxialTable::new(a, matrix)
}
