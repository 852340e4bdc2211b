//! ESDIRK4(3)6L\[2\]SA: five implicit stages, order 4, L-stable, stiffly accurate. The default.
//!
//! # Equation
//!
//! The tableau below. The error estimate is the embedded formula of order 3 multiplied by 2.5: on
//! pendulums it estimates 40 % of the error of the result (`tests/tolerance.rs` compares the
//! product with the true error).
//!
//! # Validity
//!
//! Any stiffness. It is the default because it costs less than ESDIRK3 for errors below 5e-4 m on
//! the paper's pendulum and below 1e-5 m on taut steel (docs/accuracy).
//!
//! # References
//!
//! Kennedy & Carpenter, Appl. Numer. Math. 44 (2003) 139 (the implicit half of ARK4(3)6L\[2\]SA).
//!
//! # Alternatives considered
//!
//! - Rosenbrock methods (RODAS4, 5P): on stiff cables at 1/60 s they return a wrong answer without
//!   an error.
//! - Two-stage Gauss: Newton's iteration diverges on thin cables.

use super::dirk::{Estimate, Tableau};

/// Coefficient: gamma.
const G: f64 = 0.25;
/// Coefficient: the weights.
const B: [f64; 6] = [82_889.0 / 524_892.0, 0.0, 15_625.0 / 83_664.0, 69_875.0 / 102_672.0, -2_260.0 / 8_211.0, G];

/// The tableau.
pub const TABLEAU: Tableau = Tableau {
    name: "esdirk4",
    a: &[
        &[0.0],
        &[G, G],
        &[8_611.0 / 62_500.0, -1_743.0 / 31_250.0, G],
        &[5_012_029.0 / 34_652_500.0, -654_441.0 / 2_922_500.0, 174_375.0 / 388_108.0, G],
        &[
            15_267_082_809.0 / 155_376_265_600.0,
            -71_443_401.0 / 120_774_400.0,
            730_878_875.0 / 902_184_768.0,
            2_285_395.0 / 8_070_912.0,
            G,
        ],
        &B,
    ],
    b: &B,
    estimate: Some(Estimate {
        weights: &[
            B[0] - 4_586_570_599.0 / 29_645_900_160.0,
            0.0,
            B[2] - 178_811_875.0 / 945_068_544.0,
            B[3] - 814_220_225.0 / 1_159_782_912.0,
            B[4] + 3_700_637.0 / 11_593_932.0,
            B[5] - 61_727.0 / 225_920.0,
        ],
        order: 4,
        calibration: 2.5,
    }),
};
