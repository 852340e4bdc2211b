//! Consistent mass matrix of one element, in closed form.
//!
//! # Equation
//!
//! `M = rho A l int S^T S dxi`, S the Hermite functions of [`shape`](super::shape). It is constant,
//! and the same 4x4 matrix for x, y and z.
//!
//! # References
//!
//! Any text on Hermite beams, e.g. Bathe 1996, section 4.2; checked against quadrature below.
//!
//! # Alternatives considered
//!
//! Lumping: order two in space, and the slopes would have no inertia, which limits the step.

use crate::Real;

/// The 4x4 matrix over (r_i, t_i, r_j, t_j), for mass per length in kg/m and length in m.
#[inline(always)]
pub fn consistent<T: Real>(mass_per_length: f64, length: T) -> [[T; 4]; 4] {
    let l = length;
    let k = l * mass_per_length / l.splat(420.0);
    let [l3, l4, l13, l22] = [l * 3.0, l * 4.0, l * 13.0, l * 22.0];
    [
        [k * 156.0, k * l22, k * 54.0, -(k * l13)],
        [k * l22, k * (l4 * l), k * l13, -(k * (l3 * l))],
        [k * 54.0, k * l13, k * 156.0, -(k * l22)],
        [-(k * l13), -(k * (l3 * l)), -(k * l22), k * (l4 * l)],
    ]
}

/// Weights `int S dxi * l` of a load per length, over (r_i, t_i, r_j, t_j).
pub fn load_weights(length: f64) -> [f64; 4] {
    let l = length;
    [l / 2.0, l * l / 12.0, l / 2.0, -l * l / 12.0]
}

#[cfg(test)]
mod tests {
    use crate::element::shape;
    use crate::quadrature::gauss_legendre;
    use approx::assert_relative_eq;

    #[test]
    fn closed_form_mass_equals_the_quadrature_of_the_shape_functions() {
        let (rho, l) = (0.37, 0.23);
        let m = super::consistent(rho, l);
        let w = super::load_weights(l);
        for i in 0..4 {
            let load: f64 = gauss_legendre(4).iter().map(|&(x, g)| g * l * shape::position(x, l)[i]).sum();
            assert_relative_eq!(w[i], load, max_relative = 1e-14);
            for j in 0..4 {
                let sum: f64 = gauss_legendre(4)
                    .iter()
                    .map(|&(x, g)| g * rho * l * shape::position(x, l)[i] * shape::position(x, l)[j])
                    .sum();
                assert_relative_eq!(m[i][j], sum, max_relative = 1e-13);
            }
        }
    }
}
