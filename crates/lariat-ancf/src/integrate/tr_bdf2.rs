//! TR-BDF2: trapezoid to `(2 - sqrt 2) h`, then BDF2. Order 2, L-stable, stiffly accurate.
//!
//! *Error.* The embedded third-order formula of Hosea & Shampine: the estimate is of the result itself. *Source.* Bank et al.
//! 1985; Hosea & Shampine, Appl. Numer. Math. 20 (1996) 21. *Validity.* Any stiffness; the cheapest L-stable method at coarse
//! tolerance. *Rejected.* BDF2 in its multistep form: it must restart at every change of load.

use super::dirk::Tableau;

/// (2 - sqrt 2)/2.
const D: f64 = 0.292_893_218_813_452_4;
/// sqrt 2/4.
const W: f64 = 0.353_553_390_593_273_8;

/// The tableau.
pub const TABLEAU: Tableau = Tableau {
    a: &[&[0.0], &[D, D], &[W, W, D]],
    b: &[W, W, D],
    error: &[W - (1.0 - W) / 3.0, W - (3.0 * W + 1.0) / 3.0, D - D / 3.0],
    calibration: 1.0,
};
