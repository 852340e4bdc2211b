//! Matrices that are singular, nearly singular or not finite.

use super::{Random, backward_error, from_fn, levels};
use fearless_simd::Level;
use lariat_ancf::linalg::{BlockTridiagonal, Factorisation, Reason};

/// Returns a chain of springs along each of the six unknowns; if `ends` is 0 constant vectors are
/// in its kernel.
fn springs(nodes: usize, ends: f64) -> BlockTridiagonal {
    from_fn(nodes, |r, c| {
        let (i, j) = (r / 6, c / 6);
        let neighbours = f64::from(i > 0) + f64::from(i + 1 < nodes);
        let stiffness = [1.0, 3.0, 1e-6, 7.0, 1e9, 0.1][r % 6];
        match (r % 6 == c % 6, i == j) {
            (true, true) => stiffness * (neighbours + if i == 0 { ends } else { 0.0 }),
            (true, false) => -stiffness,
            _ => 0.0,
        }
    })
}

#[test]
fn singular_matrices_are_errors() {
    for level in levels() {
        let mut f = Factorisation::default();
        for n in [1, 2, 3, 50, 200] {
            let error = f.factor(level, &springs(n, 0.0)).unwrap_err();
            assert!(error.node < n && matches!(error.reason, Reason::Pivot | Reason::Condition));
            assert!(f.factor(level, &BlockTridiagonal::zeros(n)).is_err());
        }
        // rank one blocks
        let a = from_fn(1, |r, c| ((r + 1) * (c + 1)) as f64 / 3.0);
        assert!(f.factor(level, &a).is_err());
        // singular and indefinite: two equal rows and columns in different nodes
        let mut a = Random(5).matrix(2, 0.0);
        for c in 0..6 {
            let v = a.lower[0].0[c][5];
            a.lower[0].0[c][4] = v;
            let v = a.diag[1].0[c][5];
            a.diag[1].0[c][4] = v;
        }
        for r in 0..6 {
            let v = a.diag[1].0[5][r];
            a.diag[1].0[4][r] = v;
        }
        assert!(f.factor(level, &a).is_err());
    }
}

#[test]
fn nearly_singular_matrices_are_solved_accurately_or_are_errors() {
    for n in [2, 20, 200] {
        for k in 1..18 {
            let a = springs(n, 0.1f64.powi(k));
            let b = vec![1.0; 6 * n];
            let mut f = Factorisation::default();
            if f.factor(Level::new(), &a).is_ok() {
                let mut x = b.clone();
                f.solve(Level::new(), &mut x);
                let error = backward_error(&a, &x, &b);
                assert!(error < 1e-13, "n = {n}, k = {k}: {error:e}");
                assert!(k < 15);
            } else {
                assert!(k > 9, "n = {n}, k = {k}");
            }
        }
    }
}

#[test]
fn entries_that_are_not_finite_are_errors() {
    let mut random = Random(9);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for n in [1, 2, 5, 6] {
            for node in 0..n {
                for (r, c) in [(0, 0), (5, 5), (0, 5), (5, 0), (2, 3), (3, 2)] {
                    for lower in [false, true] {
                        let mut a = random.matrix(n, 6.0);
                        if lower && node + 1 < n {
                            a.lower[node].0[c][r] = bad;
                        } else {
                            a.diag[node].0[c][r] = bad;
                        }
                        let error = Factorisation::default().factor(Level::new(), &a).unwrap_err();
                        assert_eq!((error.node, error.reason), (node, Reason::NonFinite));
                    }
                }
            }
        }
    }
}

#[test]
#[should_panic(expected = "no factorisation")]
fn solving_after_an_error_panics() {
    let mut f = Factorisation::default();
    assert!(f.factor(Level::new(), &BlockTridiagonal::zeros(2)).is_err());
    f.solve(Level::new(), &mut [0.0; 12]);
}
