//! The element as a function of six numbers.
//!
//! With xi = x/l the slope field of the element is a quadratic curve over three *control vectors*
//!
//! ```text
//! d0 = t_i      d1 = 3 (r_j - r_i)/l      d2 = t_j
//! r'  = b0 d0 + b1 d1 + b2 d2         b0 = (1-xi)^2 - 2 xi(1-xi), b1 = 2 xi(1-xi), b2 = xi^2 - 2 xi(1-xi)
//! r'' = (2/l) [ (3 xi - 2) d0 + (1 - 2 xi) d1 + (3 xi - 1) d2 ]
//! ```
//!
//! (the Bernstein control vectors are c0 = d0, c1 = d1 - d0 - d2, c2 = d2; the d basis spans the
//! same space and scatters to the nodes without combinations). An elastic energy that does not
//! change under rotation depends on the *Gram numbers* alone, g = (d0.d0, d0.d1, d0.d2, d1.d1,
//! d1.d2, d2.d2), so an elastic force model is a scalar function U(g):
//!
//! ```text
//! dU/dd_i         = sum_j n_ij d_j                            n_ii = 2 dU/dg_ii,  n_ij = dU/dg_ij
//! d2U/dd_i dd_k   = n_ik I + sum_mn h_(im)(kn) d_m d_n^T        h_ab = e_a e_b d2U/dg_a dg_b,  e = (2,1,1,2,1,2)
//! ```
//!
//! The arrays called `n` and `h` in this crate are these weighted derivatives.
//!
//! *Source.* Element: Bulin & Hajzman, "Various Strategies of Elastic Forces Evaluation in the
//! ANCF"; Gerstmayr & Shabana 2006. That frame indifference reduces U to the Gram matrix is the
//! first fundamental theorem of invariant theory for O(3) (Weyl 1946). *Validity.* Any element
//! state. *Rejected.* Shape-function matrices with 12x12 products (ten times the work), and
//! tangents by finite differences (Chrono's choice; they fail where the element is straight, which
//! is where these are exact).

use crate::Real;

/// Control vectors `[d0, d1, d2]`, each `[x, y, z]`.
pub type Control<T> = [[T; 3]; 3];
/// Six numbers, one per pair (00, 01, 02, 11, 12, 22).
pub type Six<T> = [T; 6];
/// Upper triangle of a symmetric 6x6 matrix, row by row: index of (a, b), a <= b, is [`upper`]`(a,
/// b)`.
pub type Upper<T> = [T; 21];

/// Weights of the pairs: a repeated index counts twice.
pub const PAIR_WEIGHT: Six<f64> = [2.0, 1.0, 1.0, 2.0, 1.0, 2.0];
/// Layout: `PAIR[i][j]` is the index of the pair (i, j) in a [`Six`].
pub const PAIR: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// Index of entry (a, b), in either order, of a symmetric 6x6 matrix stored as [`Upper`].
#[inline(always)]
pub const fn upper(a: usize, b: usize) -> usize {
    let (a, b) = if a <= b { (a, b) } else { (b, a) };
    a * 6 - a * (a + 1) / 2 + b
}

/// Dot product.
#[inline(always)]
pub fn dot<T: Real>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Gram numbers of the control vectors.
#[inline(always)]
pub fn gram<T: Real>(d: &Control<T>) -> Six<T> {
    [dot(&d[0], &d[0]), dot(&d[0], &d[1]), dot(&d[0], &d[2]), dot(&d[1], &d[1]), dot(&d[1], &d[2]), dot(&d[2], &d[2])]
}

/// Rates of the Gram numbers: `g'_ij = d_i . v_j + v_i . d_j`.
#[inline(always)]
pub fn gram_rates<T: Real>(d: &Control<T>, v: &Control<T>) -> Six<T> {
    // no closures: the compiler does not inline them into a function of another SIMD level
    [
        dot(&d[0], &v[0]) * PAIR_WEIGHT[0],
        dot(&d[0], &v[1]) + dot(&v[0], &d[1]),
        dot(&d[0], &v[2]) + dot(&v[0], &d[2]),
        dot(&d[1], &v[1]) * PAIR_WEIGHT[0],
        dot(&d[1], &v[2]) + dot(&v[1], &d[2]),
        dot(&d[2], &v[2]) * PAIR_WEIGHT[0],
    ]
}

/// Gradient of the energy with respect to the control vectors: `sum_j n_ij d_j`.
#[inline(always)]
pub fn gradient<T: Real>(n: &Six<T>, d: &Control<T>) -> Control<T> {
    let mut out = *d;
    for i in 0..3 {
        for x in 0..3 {
            out[i][x] = n[PAIR[i][0]] * d[0][x] + n[PAIR[i][1]] * d[1][x] + n[PAIR[i][2]] * d[2][x];
        }
    }
    out
}

/// Product of a weighted gradient and a change of the Gram numbers: the first-order change of the
/// energy.
#[inline(always)]
pub fn contract<T: Real>(n: &Six<T>, change: &Six<T>) -> T {
    (n[0] * change[0] + n[3] * change[3] + n[5] * change[5]) * 0.5
        + n[1] * change[1]
        + n[2] * change[2]
        + n[4] * change[4]
}

/// Second derivative of the energy with respect to the control vectors (i, k): a 3x3 block
/// `[row][column]`. On the diagonal, i = k, the block is symmetric and only its upper triangle is
/// computed and then copied.
#[inline(always)]
pub fn hessian_block<T: Real>(i: usize, k: usize, n: &Six<T>, h: &Upper<T>, d: &Control<T>) -> [[T; 3]; 3] {
    // y_m = sum_n h_(im)(kn) d_n, then block = sum_m d_m y_m^T + n_ik I
    let mut y = *d;
    for m in 0..3 {
        let (h0, h1, h2) =
            (h[upper(PAIR[i][m], PAIR[k][0])], h[upper(PAIR[i][m], PAIR[k][1])], h[upper(PAIR[i][m], PAIR[k][2])]);
        for x in 0..3 {
            y[m][x] = h0 * d[0][x] + h1 * d[1][x] + h2 * d[2][x];
        }
    }
    let mut block = *d;
    for r in 0..3 {
        let first = if i == k { r } else { 0 };
        for c in first..3 {
            block[r][c] = d[0][r] * y[0][c] + d[1][r] * y[1][c] + d[2][r] * y[2][c];
        }
        block[r][r] = block[r][r] + n[PAIR[i][k]];
    }
    if i == k {
        block[1][0] = block[0][1];
        block[2][0] = block[0][2];
        block[2][1] = block[1][2];
    }
    block
}

/// Linear form `c . x` with constant coefficients.
#[inline(always)]
pub fn form<T: Real>(c: &Six<f64>, x: &Six<T>) -> T {
    x[0] * c[0] + x[1] * c[1] + x[2] * c[2] + x[3] * c[3] + x[4] * c[4] + x[5] * c[5]
}

/// Coefficients of the slope `r' = b0 d0 + b1 d1 + b2 d2` at xi in `[0, 1]`.
pub fn slope_coefficients(xi: f64) -> [f64; 3] {
    let bubble = 2.0 * xi * (1.0 - xi);
    [(1.0 - xi).powi(2) - bubble, bubble, xi * xi - bubble]
}

/// The six numbers b with `|r'|^2 = b . g` at xi in `[0, 1]`.
pub fn slope_square(xi: f64) -> Six<f64> {
    let [b0, b1, b2] = slope_coefficients(xi);
    [b0 * b0, 2.0 * b0 * b1, 2.0 * b0 * b2, b1 * b1, 2.0 * b1 * b2, b2 * b2]
}

/// `e_a x_a`: from a plain to a weighted gradient.
pub fn weighted(x: &Six<f64>) -> Six<f64> {
    core::array::from_fn(|a| PAIR_WEIGHT[a] * x[a])
}

/// Six-by-six product `sum_ab x_a m_ab y_b` of a symmetric matrix stored as [`Upper`].
pub fn quadratic_form(m: &Upper<f64>, x: &Six<f64>, y: &Six<f64>) -> f64 {
    let mut sum = 0.0;
    for a in 0..6 {
        for b in 0..6 {
            sum += x[a] * m[upper(a, b)] * y[b];
        }
    }
    sum
}
