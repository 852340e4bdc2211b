//! TR-BDF2: order 2, L-stable, stiffly accurate.
//!
//! # Equation
//!
//! The trapezoidal rule to `(2 - sqrt 2) h`, then BDF2. The error estimate is the embedded
//! third-order formula of Hosea & Shampine, which estimates the error of the result itself.
//!
//! # Validity
//!
//! Any stiffness; the cheapest L-stable method at coarse tolerances.
//!
//! # References
//!
//! Bank et al. 1985; Hosea & Shampine, Appl. Numer. Math. 20 (1996) 21.
//!
//! # Alternatives considered
//!
//! BDF2 in its multistep form: it must restart at every change of load.

use super::dirk::{Estimate, Tableau};

/// Coefficient: (2 - sqrt 2)/2.
const D: f64 = 0.292_893_218_813_452_4;
/// Coefficient: sqrt 2/4.
const W: f64 = 0.353_553_390_593_273_8;

/// The tableau.
pub const TABLEAU: Tableau = Tableau {
    name: "tr-bdf2",
    a: &[&[0.0], &[D, D], &[W, W, D]],
    b: &[W, W, D],
    estimate: Some(Estimate {
        weights: &[W - (1.0 - W) / 3.0, W - (3.0 * W + 1.0) / 3.0, D - D / 3.0],
        order: 3,
        calibration: 1.0,
    }),
};
