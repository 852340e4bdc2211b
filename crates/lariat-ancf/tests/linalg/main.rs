//! Block-tridiagonal and mass factorisations against dense solutions, at every SIMD level.

use fearless_simd::Level;
use lariat_ancf::linalg::{BlockTridiagonal, Definiteness, Factorisation};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

mod mass;
mod schur;
mod singular;

/// Returns every level of the processor, best first.
fn levels() -> Vec<Level> {
    let best = Level::new();
    #[allow(unused_mut)]
    let mut levels = vec![best, Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(best.as_avx2().map(Level::Avx2));
        levels.extend(best.as_sse4_2().map(Level::Sse4_2));
        levels.extend(best.as_sse2().map(Level::Sse2));
    }
    levels
}

/// Uniform numbers in -1/2..1/2 (xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }

    /// Random symmetric blocks with `shift` added to the diagonal.
    fn matrix(&mut self, nodes: usize, shift: f64) -> BlockTridiagonal {
        let mut a = BlockTridiagonal::zeros(nodes);
        for b in &mut a.diag {
            for c in 0..6 {
                for r in 0..=c {
                    let v = self.next();
                    b.0[c][r] = v;
                    b.0[r][c] = v;
                }
                b.0[c][c] += shift;
            }
        }
        for b in &mut a.lower {
            for c in 0..6 {
                for r in 0..6 {
                    b.0[c][r] = self.next();
                }
            }
        }
        a
    }
}

fn dense(a: &BlockTridiagonal) -> DMatrix<f64> {
    let mut m = DMatrix::zeros(6 * a.nodes(), 6 * a.nodes());
    for (i, b) in a.diag.iter().enumerate() {
        for c in 0..6 {
            for r in 0..6 {
                m[(6 * i + r, 6 * i + c)] = b.0[c][r];
            }
        }
    }
    for (i, b) in a.lower.iter().enumerate() {
        for c in 0..6 {
            for r in 0..6 {
                m[(6 * i + 6 + r, 6 * i + c)] = b.0[c][r];
                m[(6 * i + c, 6 * i + 6 + r)] = b.0[c][r];
            }
        }
    }
    m
}

/// Block-tridiagonal matrix with the entries of a function of row and column.
fn from_fn(nodes: usize, f: impl Fn(usize, usize) -> f64) -> BlockTridiagonal {
    let mut a = BlockTridiagonal::zeros(nodes);
    for i in 0..nodes {
        for c in 0..6 {
            for r in 0..6 {
                a.diag[i].0[c][r] = f(6 * i + r, 6 * i + c);
                if i + 1 < nodes {
                    a.lower[i].0[c][r] = f(6 * i + 6 + r, 6 * i + c);
                }
            }
        }
    }
    a
}

/// Backward error max |b - A x| / (|A| |x|), norms over rows.
fn backward_error(a: &BlockTridiagonal, x: &[f64], b: &[f64]) -> f64 {
    let mut ax = vec![0.0; x.len()];
    a.multiply(x, &mut ax);
    let norm = dense(a).row_iter().fold(0.0f64, |m, r| m.max(r.lp_norm(1)));
    let size = x.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    ax.iter().zip(b).fold(0.0f64, |m, (p, q)| m.max((p - q).abs())) / (norm * size)
}

fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|v| v.to_bits()).collect()
}

/// Factors and solves at every level, compares the bits, and returns definiteness and backward
/// error.
fn solve_everywhere(a: &BlockTridiagonal, b: &[f64]) -> (Definiteness, f64) {
    let mut first: Option<(Definiteness, Vec<f64>)> = None;
    for level in levels() {
        let mut f = Factorisation::default();
        let verdict = f.factor(level, a).unwrap();
        let mut x = b.to_vec();
        f.solve(level, &mut x);
        assert!(x.iter().all(|v| v.is_finite()));
        match &first {
            None => first = Some((verdict, x)),
            Some((v, y)) => {
                assert_eq!(*v, verdict);
                assert_eq!(bits(y), bits(&x), "bits differ between levels");
            }
        }
    }
    let (verdict, x) = first.unwrap();
    (verdict, backward_error(a, &x, b))
}

fn negative_eigenvalues(a: &BlockTridiagonal) -> usize {
    dense(a).symmetric_eigenvalues().iter().filter(|v| **v < 0.0).count()
}

#[test]
fn products_match_dense_products() {
    let mut random = Random(7);
    for n in [1, 2, 3, 8] {
        let a = random.matrix(n, 0.0);
        let x = random.vector(6 * n);
        let mut y = vec![0.0; 6 * n];
        a.multiply(&x, &mut y);
        let exact = dense(&a) * DVector::from_vec(x);
        assert!((DVector::from_vec(y) - exact).amax() < 1e-14);
    }
}

#[test]
fn positive_definite_systems_of_every_size_are_solved() {
    let mut random = Random(1);
    for n in (1..=50).chain([200]) {
        let a = random.matrix(n, 6.0);
        let b = random.vector(6 * n);
        let (verdict, error) = solve_everywhere(&a, &b);
        assert_eq!(verdict, Definiteness::PositiveDefinite);
        assert!(error < 1e-15, "n = {n}: {error:e}");
        let mut f = Factorisation::default();
        f.factor(Level::new(), &a).unwrap();
        let mut y = b.clone();
        f.solve(Level::new(), &mut y);
        let exact = dense(&a).lu().solve(&DVector::from_vec(b)).unwrap();
        assert!((DVector::from_vec(y) - exact).amax() < 1e-13);
        assert_eq!((f.negative_eigenvalues(), f.determinant_sign()), (Some(0), Some(1.0)));
    }
}

#[test]
fn indefinite_systems_of_every_size_are_solved_and_their_inertia_counted() {
    let mut random = Random(2);
    let mut certain = 0;
    for n in (1..=30).chain([200]) {
        let a = random.matrix(n, 0.0);
        let b = random.vector(6 * n);
        let (verdict, error) = solve_everywhere(&a, &b);
        assert!(error < 1e-14, "n = {n}: {error:e}");
        if let Definiteness::Indefinite { negative: Some(count) } = verdict {
            assert_eq!(count, negative_eigenvalues(&a));
            certain += 1;
        }
    }
    assert!(certain >= 25, "{certain}");
}

#[test]
fn zero_leading_pivots_are_no_obstacle() {
    for n in [1, 2, 5] {
        // (0 1; 1 0) blocks: three negative eigenvalues per node
        let a = from_fn(n, |r, c| f64::from(r / 2 == c / 2 && r != c));
        let b: Vec<f64> = (0..6 * n).map(|i| i as f64).collect();
        let (verdict, error) = solve_everywhere(&a, &b);
        assert_eq!(verdict, Definiteness::Indefinite { negative: Some(3 * n) });
        assert_eq!(error, 0.0);
    }
}

#[test]
fn systems_of_extreme_scale_are_solved() {
    let mut random = Random(11);
    for power in [-900, -480, -460, 460, 480, 900] {
        let scale = 2f64.powi(power);
        for shift in [0.0, 6.0] {
            let mut a = random.matrix(9, shift);
            for b in a.diag.iter_mut().chain(&mut a.lower) {
                b.0.iter_mut().flatten().for_each(|v| *v *= scale);
            }
            let mut b = random.vector(54);
            b.iter_mut().for_each(|v| *v *= scale);
            let (_, error) = solve_everywhere(&a, &b);
            assert!(error < 1e-14, "{power} {shift}: {error:e}");
        }
    }
}

#[test]
fn right_hand_sides_that_begin_with_zeros_are_solved_with_the_same_bits() {
    let mut random = Random(23);
    for nodes in 1..12 {
        let a = random.matrix(nodes, 6.0);
        for level in levels() {
            let mut factorisation = Factorisation::default();
            assert_eq!(factorisation.factor(level, &a), Ok(Definiteness::PositiveDefinite));
            for zeros in 0..6 * nodes {
                let b: Vec<f64> = (0..6 * nodes).map(|i| if i < zeros { 0.0 } else { random.next() }).collect();
                let mut x = b.clone();
                factorisation.solve(level, &mut x);
                // nothing is left out of a side whose zeros are negative
                let mut whole: Vec<f64> = b.iter().map(|&b| if b == 0.0 { -0.0 } else { b }).collect();
                factorisation.solve(level, &mut whole);
                assert_eq!(x, whole, "{nodes} nodes, {zeros} zeros");
                assert!(backward_error(&a, &x, &b) < 1e-15, "{nodes} nodes, {zeros} zeros");
            }
        }
    }
}

#[test]
fn buffers_are_reused_and_an_empty_matrix_is_valid() {
    let mut f = Factorisation::default();
    assert_eq!(f.determinant_sign(), None);
    f.factor(Level::new(), &BlockTridiagonal::default()).unwrap();
    f.solve(Level::new(), &mut []);
    let mut random = Random(3);
    for (n, shift) in [(9, 6.0), (3, 0.0), (4, 6.0), (11, 0.0)] {
        let a = random.matrix(n, shift);
        let b = random.vector(6 * n);
        f.factor(Level::new(), &a).unwrap();
        let mut x = b.clone();
        f.solve(Level::new(), &mut x);
        assert!(backward_error(&a, &x, &b) < 1e-14);
    }
}

/// Elements that are much stiffer in one random direction than in the others, as those of a thin
/// cable.
#[test]
fn systems_stiff_in_random_directions_are_solved() {
    let mut random = Random(6);
    for power in [0, 4, 8, 10] {
        let mut a = BlockTridiagonal::zeros(60);
        for b in &mut a.diag {
            for c in 0..6 {
                b.0[c][c] = 1.0;
            }
        }
        for e in 0..59 {
            for stiffness in [10f64.powi(power), 10f64.powi(power / 2), 1.0] {
                let v = random.vector(12);
                for c in 0..6 {
                    for r in 0..6 {
                        a.diag[e].0[c][r] += stiffness * (v[r] * v[c]);
                        a.diag[e + 1].0[c][r] += stiffness * (v[6 + r] * v[6 + c]);
                        a.lower[e].0[c][r] += stiffness * (v[6 + r] * v[c]);
                    }
                }
            }
        }
        let b = random.vector(360);
        let (verdict, error) = solve_everywhere(&a, &b);
        println!("{power} {error:e}");
        assert_eq!(verdict, Definiteness::PositiveDefinite);
        assert!(error < 1e-14, "{power}: {error:e}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// With any shift and row scaling the solution is backward stable and the inertia, where it is
    /// returned, correct.
    #[test]
    fn random_systems_are_solved_with_small_backward_error(
        seed in 1u64..u64::MAX, nodes in 1usize..12, shift in -6.0..6.0f64, spread in 0i32..12,
    ) {
        let mut random = Random(seed);
        let mut a = random.matrix(nodes, shift);
        let scales: Vec<f64> = (0..6 * nodes)
            .map(|_| 2f64.powi((random.next() * 2.0 * f64::from(spread)) as i32))
            .collect();
        for i in 0..nodes {
            for c in 0..6 {
                for r in 0..6 {
                    a.diag[i].0[c][r] *= scales[6 * i + r] * scales[6 * i + c];
                    if i + 1 < nodes {
                        a.lower[i].0[c][r] *= scales[6 * i + 6 + r] * scales[6 * i + c];
                    }
                }
            }
        }
        let b = random.vector(6 * nodes);
        let (verdict, error) = solve_everywhere(&a, &b);
        prop_assert!(error < 1e-13, "{error:e}");
        let negative = negative_eigenvalues(&a);
        match verdict {
            Definiteness::PositiveDefinite => prop_assert_eq!(negative, 0),
            Definiteness::Indefinite { negative: Some(count) } => prop_assert_eq!(count, negative),
            Definiteness::Indefinite { negative: None } => {}
        }
    }
}
