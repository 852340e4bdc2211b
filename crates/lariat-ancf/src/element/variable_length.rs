//! The element at the eye of a reel: material enters it at its last node, and its length is a
//! coordinate. At the start of a cable it is [mirrored](super::side).
//!
//! # Equation
//!
//! y is the material distance from the first node, `xi = y/l`, `D = diag(1, l, 1, l)`, N the
//! Hermite functions, P = diag(0, 1, 0, 1). The motion of real particles is linear in the nodal
//! coordinates e:
//!
//! ```text
//! r(y, t) = S(y; l(t)) e(t)      S = N D      S_l = (1/l) (N P - xi N') D      S_ll = (1/l^2) (2 xi N' + xi^2 N'' - 2 xi N' P) D
//! v = S e' + l' w,  w = S_l e    (0 at the first node, -t at the eye)          a = S e'' + 2 l' S_l e' + (l'' S_l + l'^2 S_ll) e
//! M e'' + 2 l' G e' + (l'' G + l'^2 H) e = F          G = rho D G^ D    H = (rho/l) D H^ D
//! T = 1/2 e'.M e' + l' e'.G e + 1/2 l'^2 e.K e        K = (rho/l) D K^ D        p = M e' + l' G e
//! p' - l' (G^T e' + l' K e) - rho l' v_eye on r_eye = F                            the same with the momentum p
//! B = e.[G^T e'' + 2 l' K e' + (l'' K + l'^2 J) e] + dU/dl - rho (w^ D e).g      J = (rho/l^2) D J^ D
//! ```
//!
//! B is the force that the inertia, the strain energy and the weight of the element exert on its
//! length; dU/dl is at fixed e. The tables are integrals of products of polynomials.
//!
//! # Validity
//!
//! Any motion; all other elements are made of the same particles for ever. The winch's pull on the
//! cable at the eye is `F = -B - 1/2 rho l'^2 (f^2 - 1)`, f the stretch there, for a drum that runs
//! with the rate l'.
//!
//! # References
//!
//! Own derivation, checked against differences of S(y; l) e and quadrature below. Elements with
//! flowing material: Peng, Wei & Zhou, Appl. Math. Mech. 38 (2017) 1785.
//!
//! # Alternatives considered
//!
//! - A mass matrix of the momentary length without G, H, K: wrong by the thrust of the entering
//!   mass.
//! - All nodes at rest in space: every element then has these terms.
//! - Releasing node by node, or a rest length without its mass: jumps, and the wrong mass.

use super::shape;
use crate::Real;
use crate::real::Over;

/// A table over (r_i, t_i, r_j, t_j); those of integers are times 420.
pub(crate) type Table<T = f64> = [[T; 4]; 4];

const G: Table =
    [[78.0, 26.0, -78.0, -2.0], [18.0, 6.0, -18.0, -1.0], [132.0, 44.0, -132.0, -68.0], [-24.0, -8.0, 24.0, 6.0]];
const K: Table = [
    [144.0, 48.0, -144.0, -36.0],
    [48.0, 16.0, -48.0, -12.0],
    [-144.0, -48.0, 144.0, 36.0],
    [-36.0, -12.0, 36.0, 44.0],
];
/// Coefficient: of the vector of weight over 420.
const W: [f64; 4] = [210.0, 70.0, -210.0, -70.0];
const G_T: Table = {
    let (mut out, mut k) = (G, 0);
    while k < 16 {
        out[k / 4][k % 4] = G[k % 4][k / 4];
        k += 1;
    }
    out
};
/// `dG/dl - K`, with what is at the eye: `S^T S_l` is -1 there over (r_j, t_j).
const H: Table = {
    let (mut out, mut k) = (by_length(&G, 0.0), 0);
    while k < 16 {
        out[k / 4][k % 4] -= K[k / 4][k % 4];
        k += 1;
    }
    out[2][3] += 420.0;
    out
};
/// `J + J^T = dK/dl`, less what is at the eye: `S_l^T S_l` is 1 there over (t_j, t_j).
const J_SUM: Table = {
    let mut out = by_length(&K, -1.0);
    out[3][3] -= 420.0;
    out
};

/// Returns l times the derivative by l of `l^power D (table) D`, as such a table.
const fn by_length(table: &Table, power: f64) -> Table {
    let (mut out, mut k) = (*table, 0);
    while k < 16 {
        out[k / 4][k % 4] *= power + (k / 4 % 2 + k % 2) as f64;
        k += 1;
    }
    out
}

/// Length of the element, its rate and acceleration: m, m/s, m/s^2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Extent<T = f64> {
    pub length: T,
    pub rate: T,
    pub acceleration: T,
}

/// The element at an instant: mass per length in kg/m and extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VariableLength<T = f64> {
    pub inertia: f64,
    pub extent: Extent<T>,
}

impl<T: Real> VariableLength<T> {
    /// Returns `D (sum of factors times tables) D`, times the mass per length.
    #[inline(always)]
    fn weighted<const N: usize>(&self, terms: [(T, &Table); N]) -> Table<T> {
        let length = self.extent.length;
        let (zero, one) = (length.splat(0.0), length.splat(1.0));
        let (unit, d) = (self.inertia / 420.0, [one, length, one, length]);
        let mut out = [[zero; 4]; 4];
        for a in 0..4 {
            for b in 0..4 {
                let mut entry = zero;
                for (factor, table) in &terms {
                    entry = entry + *factor * table[a][b];
                }
                out[a][b] = d[a] * unit * d[b] * entry;
            }
        }
        out
    }

    /// Returns the matrices of `2 l' G` and of `l'' G + l'^2 H`.
    pub fn matrices(&self) -> [Table<T>; 2] {
        let Extent { length, rate, acceleration } = self.extent;
        [self.weighted([(rate * 2.0, &G)]), self.weighted([(acceleration, &G), (rate * rate / length, &H)])]
    }

    /// Adds `scale` times the force `-(2 l' G v + (l'' G + l'^2 H) q)` of the feed on the element's
    /// 12 coordinates.
    pub fn add_force(&self, scale: f64, q: &[T; 12], v: &[T; 12], out: &mut [T; 12]) {
        let [by_velocity, by_position] = self.matrices();
        add_product(&by_velocity, -scale, v, out);
        add_product(&by_position, -scale, q, out);
    }

    /// Adds the momentum `l' G q`.
    pub fn add_momentum(&self, q: &[T; 12], out: &mut [T; 12]) {
        add_product(&self.momentum_matrix(), 1.0, q, out);
    }

    /// Returns `l' G`.
    #[inline(always)]
    pub fn momentum_matrix(&self) -> Table<T> {
        self.weighted([(self.extent.rate, &G)])
    }

    /// Returns `l' G^T` and `l'^2 K`, which give the derivative of the kinetic energy by the
    /// coordinates.
    #[inline(always)]
    pub fn gradient_matrices(&self) -> [Table<T>; 2] {
        let Extent { length, rate, .. } = self.extent;
        [self.weighted([(rate, &G_T)]), self.weighted([(rate * rate / length, &K)])]
    }

    /// Returns the kinetic energy beyond that of the mass matrix, `l' v.G q + 1/2 l'^2 q.K q`, in
    /// J.
    pub fn kinetic_energy(&self, q: &[T; 12], v: &[T; 12]) -> T {
        let [by_velocity, by_position] = self.gradient_matrices();
        let mut force = [self.extent.rate.splat(0.0); 12];
        add_product(&by_position, 0.5, q, &mut force);
        add_product(&by_velocity, 1.0, v, &mut force);
        dot(q, &force)
    }

    /// Returns B without the strain energy, in N: inertia and weight, with accelerations `a` of the
    /// coordinates.
    #[inline(always)]
    pub fn length_force<U: Over<T>>(&self, [q, v, a]: [&[U; 12]; 3], weight: &[f64; 3]) -> U {
        let Extent { length, rate, acceleration } = self.extent;
        let square = [(acceleration / length, &K), (rate * rate / (length * length) * 0.5, &J_SUM)];
        let mut force = [q[0].splat(0.0); 12];
        add_product(&self.weighted([(length.splat(1.0), &G_T)]), 1.0, a, &mut force);
        add_product(&self.weighted([(rate * 2.0 / length, &K)]), 1.0, v, &mut force);
        add_product(&self.weighted(square), 1.0, q, &mut force);
        for b in 0..4 {
            let d = if b % 2 == 1 { length } else { length.splat(1.0) };
            for x in 0..3 {
                force[3 * b + x] = force[3 * b + x] - d * (W[b] / 420.0) * weight[x];
            }
        }
        dot(q, &force)
    }
}

/// Returns the product of 12 numbers.
#[inline(always)]
pub(crate) fn dot<T: Real>(x: &[T; 12], y: &[T; 12]) -> T {
    let mut sums = [x[0].splat(0.0); 3];
    for b in 0..4 {
        for i in 0..3 {
            sums[i] = sums[i] + x[3 * b + i] * y[3 * b + i];
        }
    }
    sums[0] + sums[1] + sums[2]
}

/// Adds `scale` times the product of a table and 12 coordinates.
#[inline(always)]
pub(crate) fn add_product<T: Real, U: Over<T>>(table: &Table<T>, scale: f64, x: &[U; 12], out: &mut [U; 12]) {
    for a in 0..4 {
        for b in 0..4 {
            for i in 0..3 {
                out[3 * a + i] = out[3 * a + i] + x[3 * b + i] * (table[a][b] * scale);
            }
        }
    }
}

/// Returns the weights of the coordinates in w = S_l e and in dw/dy at `xi`.
pub(crate) fn feed_weights(xi: f64, length: f64) -> [[f64; 4]; 2] {
    let (n, slope, second) =
        (shape::position(xi, length), shape::slope(xi, length), shape::second_derivative(xi, length));
    let p = |k: usize| if k % 2 == 1 { 1.0 } else { 0.0 };
    // N' D = l slope, N'' D = l^2 second
    [
        core::array::from_fn(|k| p(k) * n[k] / length - xi * slope[k]),
        core::array::from_fn(|k| p(k) * slope[k] / length - slope[k] / length - xi * second[k]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::gauss_legendre;
    use approx::assert_relative_eq;

    const L: f64 = 0.37;
    const RHO: f64 = 1.3;

    /// Any 12 numbers.
    fn some(seed: f64) -> [f64; 12] {
        core::array::from_fn(|i| (seed + 1.7 * i as f64).sin())
    }

    /// S(y; l) e at a material point.
    fn at(y: f64, l: f64, e: &[f64; 12]) -> [f64; 3] {
        let s = shape::position(y / l, l);
        core::array::from_fn(|x| (0..4).map(|k| s[k] * e[3 * k + x]).sum())
    }

    /// Velocity and acceleration of a material point by differences of its position in time: S(y;
    /// l(t)) e(t) is all that is used.
    fn motion(y: f64, [q, v, a]: &[[f64; 12]; 3], feed: &Extent) -> [[f64; 3]; 2] {
        let h = 1e-3;
        let place = |t: f64| {
            let l = feed.length + t * feed.rate + 0.5 * t * t * feed.acceleration;
            at(y, l, &core::array::from_fn(|i| q[i] + t * v[i] + 0.5 * t * t * a[i]))
        };
        // six points: error h^6
        let p: Vec<[f64; 3]> = (-3..=3).map(|k| place(f64::from(k) * h)).collect();
        let first = [-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0];
        let second = [2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0];
        let sum = |c: [f64; 7], d: f64| core::array::from_fn(|x| (0..7).map(|k| c[k] * p[k][x]).sum::<f64>() / d);
        [sum(first, 60.0 * h), sum(second, 180.0 * h * h)]
    }

    /// Force, momentum, kinetic energy and the force on the length are the integrals of what the
    /// particles do.
    ///
    /// *Source.* D'Alembert: generalised force of inertia = int rho a . dr, by Gauss points and
    /// differences in time.
    #[test]
    fn the_tables_are_the_inertia_of_the_particles() {
        let feed = Extent { length: L, rate: 0.8, acceleration: -1.9 };
        let element = VariableLength { inertia: RHO, extent: feed };
        let state = [some(0.3), some(1.1), some(2.9)];
        let [q, v, a] = state;
        let weight = [0.4, -9.0, 2.0];
        let mass = crate::element::mass::consistent(RHO, L);
        let (mut force, mut momentum, mut kinetic, mut on_length) = ([0.0; 12], [0.0; 12], 0.0, 0.0);
        for (x, g) in gauss_legendre(6) {
            let [speed, acceleration] = motion(x * L, &state, &feed);
            let (s, [w, _]) = (shape::position(x, L), feed_weights(x, L));
            for i in 0..3 {
                for k in 0..4 {
                    force[3 * k + i] -= g * L * RHO * s[k] * acceleration[i];
                    momentum[3 * k + i] += g * L * RHO * s[k] * speed[i];
                    on_length += g * L * w[k] * q[3 * k + i] * (RHO * acceleration[i] - weight[i]);
                }
                kinetic += 0.5 * g * L * RHO * speed[i] * speed[i];
            }
        }
        let product = |x: &[f64; 12], i: usize| (0..4).map(|b| mass[i / 3][b] * x[3 * b + i % 3]).sum::<f64>();
        let (mut by_table, mut momentum_by_table) = ([0.0; 12], [0.0; 12]);
        element.add_force(1.0, &q, &v, &mut by_table);
        element.add_momentum(&q, &mut momentum_by_table);
        for i in 0..12 {
            assert_relative_eq!(by_table[i] - product(&a, i), force[i], epsilon = 1e-7);
            assert_relative_eq!(momentum_by_table[i] + product(&v, i), momentum[i], epsilon = 1e-9);
        }
        let own: f64 = (0..12).map(|i| 0.5 * v[i] * product(&v, i)).sum();
        assert_relative_eq!(own + element.kinetic_energy(&q, &v), kinetic, epsilon = 1e-9);
        assert_relative_eq!(element.length_force([&q, &v, &a], &weight), on_length, epsilon = 1e-6);
    }

    /// w is the derivative of S(y; l) e by l at a fixed particle, and dw/dy that along the cable; w
    /// = -t at the eye.
    #[test]
    fn feed_weights_are_derivatives_at_a_fixed_particle() {
        let (q, h) = (some(0.7), 1e-5);
        for xi in [0.0, 0.3, 0.8, 1.0] {
            let [w, dw] = feed_weights(xi, L).map(|weights| -> [f64; 3] {
                core::array::from_fn(|x| (0..4).map(|k| weights[k] * q[3 * k + x]).sum())
            });
            let w_at = |y: f64| -> [f64; 3] {
                let (up, down) = (at(y, L + h, &q), at(y, L - h, &q));
                core::array::from_fn(|x| (up[x] - down[x]) / (2.0 * h))
            };
            let (y, step) = (xi * L, 1e-4);
            for x in 0..3 {
                assert_relative_eq!(w[x], w_at(y)[x], epsilon = 1e-7);
                assert_relative_eq!(dw[x], (w_at(y + step)[x] - w_at(y - step)[x]) / (2.0 * step), epsilon = 1e-4);
                if xi == 1.0 {
                    assert_relative_eq!(w[x], -q[9 + x], epsilon = 1e-14);
                }
            }
        }
    }
}
