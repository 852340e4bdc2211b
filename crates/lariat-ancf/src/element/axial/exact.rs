//! Exact integral of the squared Green strain.
//!
//! # Equation
//!
//! `a = int b dxi`, `A = int b b^T dxi`; b b^T has degree 8, which five Gauss points integrate
//! exactly, so this is also what G5-x to G10-x give, to rounding.
//!
//! # Validity
//!
//! Any state; locks for thin cables (error ~ EA L^2/EI until elements are short), because the
//! quartic part of the strain cannot vanish in a bent element.
//!
//! # References
//!
//! Bulin & Hajzman, strategy "S" (symbolic).
//!
//! # Alternatives considered
//!
//! The 12x12x12x12 symbolic tensor of the paper: the same number, a thousand terms.

use super::{AxialTable, gauss};

/// The exact rule.
pub fn table() -> AxialTable {
    gauss::table(5)
}

#[cfg(test)]
mod tests {
    use crate::element::gram::{Six, quadratic_form};
    use approx::assert_relative_eq;

    /// The closed form in Bernstein control vectors (630 A, and a), integrated by hand; c1 = d1 -
    /// d0 - d2.
    #[test]
    fn five_gauss_points_give_the_closed_form_integrals() {
        const A630: [[f64; 6]; 6] = [
            [70., 35., 5., 10., 5., 1.],
            [35., 40., 10., 20., 16., 5.],
            [5., 10., 4., 8., 10., 5.],
            [10., 20., 8., 16., 20., 10.],
            [5., 16., 10., 20., 40., 35.],
            [1., 5., 5., 10., 35., 70.],
        ];
        const A: [f64; 6] = [1. / 5., 1. / 5., 1. / 15., 2. / 15., 1. / 5., 1. / 5.];
        let table = super::table();
        let gram = |v: [f64; 3]| [v[0] * v[0], v[0] * v[1], v[0] * v[2], v[1] * v[1], v[1] * v[2], v[2] * v[2]];
        for seed in 0..20 {
            let x = |k: i32| (f64::from(seed * 7 + k) * 1.37).sin();
            let d = [x(1), x(2), x(3)];
            let g_c: Six<f64> = gram([d[0], d[1] - d[0] - d[2], d[2]]);
            let g_d = gram(d);
            let quadratic: f64 =
                (0..6).map(|i| (0..6).map(|j| g_c[i] * A630[i][j] * g_c[j]).sum::<f64>()).sum::<f64>() / 630.0;
            assert_relative_eq!(
                quadratic_form(&table.matrix, &g_d, &g_d),
                quadratic,
                epsilon = 1e-14,
                max_relative = 1e-13
            );
            let linear: f64 = (0..6).map(|i| A[i] * g_c[i]).sum();
            let ours: f64 = (0..6).map(|i| table.a[i] * g_d[i]).sum();
            assert_relative_eq!(ours, linear, epsilon = 1e-14, max_relative = 1e-13);
        }
    }
}
