//! Symplectic Runge-Kutta-Nystrom methods of order 4 (6 stages) and 6 (11 stages) for q'' = f(q).
//!
//! # Equation
//!
//! Compositions of kicks and drifts, see [`explicit`](super::explicit). Because the kinetic energy
//! is quadratic, some order conditions are void, and the error constants are hundreds of times
//! smaller than those of Yoshida's compositions of the same order.
//!
//! # Validity
//!
//! Forces that do not depend on velocity; h omega_max below the stability limit.
//!
//! # References
//!
//! Blanes & Moan, J. Comput. Appl. Math. 142 (2002) 313: SRKN-6b and SRKN-11b.

use super::explicit::Composition;

/// Coefficient: of the source named above.
const B4: [f64; 3] = [0.082_984_406_417_405_2, 0.396_309_801_498_368, -0.039_056_304_922_348_6];
/// Coefficient: of the source named above.
const A4: [f64; 2] = [0.245_298_957_184_271, 0.604_872_665_711_080];

/// Order 4.
pub const ORDER_4: Composition = Composition {
    name: "rkn4",
    kicks: &[B4[0], B4[1], B4[2], 1.0 - 2.0 * (B4[0] + B4[1] + B4[2])],
    drifts: &[A4[0], A4[1], 0.5 - (A4[0] + A4[1])],
    stages: 6,
    stability_limit: 3.163,
};

/// Coefficient: of the source named above.
const B6: [f64; 5] = [
    0.041_464_998_518_262_4,
    0.198_128_671_918_067,
    -0.040_006_192_104_153_3,
    0.075_253_984_301_580_7,
    -0.011_511_387_420_687_9,
];
/// Coefficient: of the source named above.
const A6: [f64; 5] = [
    0.123_229_775_946_271,
    0.290_553_797_799_558,
    -0.127_049_212_625_417,
    -0.246_331_761_062_075,
    0.357_208_872_795_928,
];

/// Order 6.
#[expect(clippy::approx_constant)] // the limit is not pi
pub const ORDER_6: Composition = Composition {
    name: "rkn6",
    kicks: &[B6[0], B6[1], B6[2], B6[3], B6[4], 0.5 - (B6[0] + B6[1] + B6[2] + B6[3] + B6[4])],
    drifts: &[A6[0], A6[1], A6[2], A6[3], A6[4], 1.0 - 2.0 * (A6[0] + A6[1] + A6[2] + A6[3] + A6[4])],
    stages: 11,
    stability_limit: 3.141,
};
