//! Energy, force and tangent of one element for a pair of rules.
//!
//! `U = EA l/8 (g.A.g - 2 a.g + 1) + (2 EI/l) u(g)` ([`axial`](crate::axial), [`bending`](crate::bending)); derivatives with respect to the
//! control vectors by [`gram`](super::gram). The nodes follow by the constant map d1 = 3 (r_j - r_i)/l, done where the result is
//! scattered. Generic over [`Real`]: one element in `f64`, eight in lanes.

use super::gram::{Control, Six, Upper, gradient, gram, hessian_block};
use crate::Real;
use crate::axial::AxialTable;
use crate::bending::Bending;

/// Stiffness of one element: `axial = EA l/4` (J), `bending = 2 EI/l` (J).
#[derive(Clone, Copy, Debug)]
pub struct Stiffness<T> {
    /// EA l/4, in J.
    pub axial: T,
    /// 2 EI/l, in J.
    pub bending: T,
}

/// Second derivatives with respect to the control vectors: the 3x3 blocks (0,0), (0,1), (0,2), (1,1), (1,2), (2,2).
pub type Blocks<T> = [[[T; 3]; 3]; 6];

/// Axial and bending energy in J.
pub fn energy<B: Bending>(table: &AxialTable, bending: &B, stiffness: Stiffness<f64>, d: &Control<f64>) -> (f64, f64) {
    let g = gram(d);
    (0.5 * stiffness.axial * table.energy(&g), stiffness.bending * bending.energy(&g))
}

/// Gradient of the energy with respect to the control vectors, in N m (the force is its negative).
#[inline(always)]
pub fn force<T: Real, B: Bending>(
    table: &AxialTable,
    bending: &B,
    stiffness: Stiffness<T>,
    d: &Control<T>,
) -> Control<T> {
    let g = gram(d);
    let mut n: Six<T> = table.gradient(&g, stiffness.axial);
    bending.add_gradient(&g, stiffness.bending, &mut n);
    gradient(&n, d)
}

/// Gradient and second derivatives of the energy with respect to the control vectors.
#[inline(always)]
pub fn force_and_tangent<T: Real, B: Bending>(
    table: &AxialTable,
    bending: &B,
    stiffness: Stiffness<T>,
    d: &Control<T>,
) -> (Control<T>, Blocks<T>) {
    let g = gram(d);
    let mut n: Six<T> = table.gradient(&g, stiffness.axial);
    let mut h: Upper<T> = table.hessian(stiffness.axial);
    bending.add_hessian(&g, stiffness.bending, &mut n, &mut h);
    let blocks = [
        hessian_block(0, 0, &n, &h, d),
        hessian_block(0, 1, &n, &h, d),
        hessian_block(0, 2, &n, &h, d),
        hessian_block(1, 1, &n, &h, d),
        hessian_block(1, 2, &n, &h, d),
        hessian_block(2, 2, &n, &h, d),
    ];
    (gradient(&n, d), blocks)
}
