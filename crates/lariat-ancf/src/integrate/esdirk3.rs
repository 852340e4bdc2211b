//! ESDIRK3(2)4L\[2\]SA: three implicit stages, order 3, L-stable, stiffly accurate.
//!
//! # Equation
//!
//! The tableau below. The error estimate is the embedded formula of order 2 multiplied by 1.9, a
//! factor tuned on the paper's pendulum: with a smaller one, the error of one host step in 120
//! exceeds ten tolerances there (`tests/tolerance.rs`).
//!
//! # Validity
//!
//! Any stiffness; [`esdirk4`](super::esdirk4) is the better choice except at the coarsest steps.
//!
//! # References
//!
//! Kennedy & Carpenter, Appl. Numer. Math. 44 (2003) 139 (the implicit half of ARK3(2)4L\[2\]SA).

use super::dirk::{Estimate, Tableau};

/// Coefficient: gamma.
const G: f64 = 1_767_732_205_903.0 / 4_055_673_282_236.0;
/// Coefficient: the weights.
const B: [f64; 4] = [
    1_471_266_399_579.0 / 7_840_856_788_654.0,
    -4_482_444_167_858.0 / 7_529_755_066_697.0,
    11_266_239_266_428.0 / 11_593_286_722_821.0,
    G,
];

/// The tableau.
pub const TABLEAU: Tableau = Tableau {
    name: "esdirk3",
    a: &[
        &[0.0],
        &[G, G],
        &[2_746_238_789_719.0 / 10_658_868_560_708.0, -640_167_445_237.0 / 6_845_629_431_997.0, G],
        &B,
    ],
    b: &B,
    estimate: Some(Estimate {
        weights: &[
            B[0] - 2_756_255_671_327.0 / 12_835_298_489_170.0,
            B[1] + 10_771_552_573_575.0 / 22_201_958_757_719.0,
            B[2] - 9_247_589_265_047.0 / 10_645_013_368_117.0,
            B[3] - 2_193_209_047_091.0 / 5_459_859_503_100.0,
        ],
        order: 3,
        calibration: 1.9,
    }),
};
