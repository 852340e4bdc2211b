//! Gauss-Legendre quadrature on the unit interval.
//!
//! Nodes are the roots of the Legendre polynomial P_n, found by Newton's method from Chebyshev's
//! estimate (Golub & Welsch 1969 is the alternative for large n; n <= 10 does not need an
//! eigenvalue solver). An n-point rule integrates polynomials of degree 2n - 1 exactly.

/// Abscissae on `[0, 1]` and weights (their sum is 1) of the `points`-point Gauss-Legendre rule,
/// ascending.
pub fn gauss_legendre(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    let mut rule: Vec<(f64, f64)> = (0..points)
        .map(|i| {
            let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            for _ in 0..100 {
                let (p, dp) = legendre(points, x);
                let step = p / dp;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            let (_, dp) = legendre(points, x);
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * dp * dp))
        })
        .collect();
    // the rule is symmetric about 1/2: make the rounding symmetric too
    for i in 0..points / 2 {
        let j = points - 1 - i;
        let x = 0.5 * (rule[i].0 + (1.0 - rule[j].0));
        let w = 0.5 * (rule[i].1 + rule[j].1);
        rule[i] = (x, w);
        rule[j] = (1.0 - x, w);
    }
    if points % 2 == 1 {
        rule[points / 2].0 = 0.5;
    }
    rule
}

/// Legendre polynomial P_n(x) and its derivative.
pub(crate) fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut p0, mut p1) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (p0, p1) = (p1, ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k);
    }
    if n == 0 {
        return (1.0, 0.0);
    }
    (p1, n as f64 * (x * p1 - p0) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::gauss_legendre;
    use approx::assert_abs_diff_eq;

    #[test]
    fn n_points_integrate_degree_two_n_minus_one_exactly_and_not_the_next() {
        for points in 1..=10 {
            let rule = gauss_legendre(points);
            let integral = |degree: i32| rule.iter().map(|&(x, w)| w * x.powi(degree)).sum::<f64>();
            for degree in 0..2 * points as i32 {
                assert_abs_diff_eq!(integral(degree), 1.0 / f64::from(degree + 1), epsilon = 2e-15);
            }
            // error of x^(2n) on [0, 1]: (n!)^4 / ((2n+1) ((2n)!)^2) (Davis & Rabinowitz 1984,
            // 2.7.12)
            let factorial = |k: usize| (1..=k).map(|v| v as f64).product::<f64>();
            let exact_error = factorial(points).powi(4) / ((2 * points + 1) as f64 * factorial(2 * points).powi(2));
            let error = 1.0 / (2 * points + 1) as f64 - integral(2 * points as i32);
            assert_abs_diff_eq!(error, exact_error, epsilon = 1e-15);
        }
    }
}
