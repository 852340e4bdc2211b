//! Tests of the sparse symmetric factorisation.

use super::*;
use nalgebra::{DMatrix, DVector};

/// Numbers from -0.5 to 0.5.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }
}

/// Fills a matrix with these couplings and signs, and returns it in full.
fn fill(
    matrix: &mut SparseSymmetric,
    signs: &[f64],
    pairs: &[(usize, usize)],
    mut next: impl FnMut() -> f64,
) -> DMatrix<f64> {
    let n = signs.len();
    let mut full = DMatrix::zeros(6 * n, 6 * n);
    matrix.begin(n);
    for (i, &sign) in signs.iter().enumerate() {
        if sign < 0.0 {
            matrix.set_negative(i);
            (0..6).for_each(|x| full[(6 * i + x, 6 * i + x)] -= 1.0);
        }
        let root = DMatrix::from_fn(6, 6, |_, _| next());
        let own = (&root * root.transpose() + DMatrix::identity(6, 6) * 12.0) * sign;
        (0..6).for_each(|c| (0..6).for_each(|r| matrix.block(i, i).0[c][r] += own[(r, c)]));
        let mut view = full.view_mut((6 * i, 6 * i), (6, 6));
        view += own;
    }
    for &(i, j) in pairs {
        let own = DMatrix::from_fn(6, 6, |_, _| next());
        (0..6).for_each(|c| (0..6).for_each(|r| matrix.block(i.max(j), i.min(j)).0[c][r] += own[(r, c)]));
        let mut view = full.view_mut((6 * i.max(j), 6 * i.min(j)), (6, 6));
        view += &own;
        let mut view = full.view_mut((6 * i.min(j), 6 * i.max(j)), (6, 6));
        view += own.transpose();
    }
    full
}

/// Couplings of a square grid.
fn grid(side: usize) -> Vec<(usize, usize)> {
    let at = |i: usize, j: usize| i * side + j;
    let right = (0..side).flat_map(|i| (1..side).map(move |j| (at(i, j - 1), at(i, j))));
    let down = (1..side).flat_map(|i| (0..side).map(move |j| (at(i - 1, j), at(i, j))));
    right.chain(down).collect()
}

/// Chains, stars and nets, positive definite and quasidefinite.
///
/// *Source.* LU factorisation by nalgebra.
#[test]
fn solutions_match_an_independent_factorisation() {
    let star: Vec<_> = (1..9).map(|i| (0, i)).collect();
    let chain: Vec<_> = (1..12).map(|i| (i, i - 1)).collect();
    for (count, pairs) in [(1, vec![]), (9, star), (12, chain), (25, grid(5))] {
        for every in [1, 3] {
            let signs: Vec<f64> = (0..count).map(|i| if every > 1 && i % every == 1 { -1.0 } else { 1.0 }).collect();
            let mut next = random(7 + count as u64);
            let mut matrix = SparseSymmetric::default();
            let full = fill(&mut matrix, &signs, &pairs, &mut next);
            matrix.factor().unwrap();
            assert!(!matrix.is_dense, "{count}");
            assert_eq!(matrix.negative() == 0, signs.iter().all(|sign| *sign > 0.0));
            let b = DVector::from_fn(6 * count, |_, _| next());
            let expected = full.lu().solve(&b).unwrap();
            let mut x = b.as_slice().to_vec();
            matrix.solve(&mut x);
            let off = (DVector::from_vec(x) - &expected).amax();
            assert!(off < 1e-13 * expected.amax().max(1.0), "{count} {every}: {off:e}");
        }
    }
}

/// Locked rows are those of the identity, and the others are solved without them.
#[test]
fn locked_rows_are_those_of_the_identity() {
    let mut next = random(3);
    let mut matrix = SparseSymmetric::default();
    let mut full = fill(&mut matrix, &[1.0; 4], &[(0, 1), (1, 2), (2, 3)], &mut next);
    matrix.lock(2, &[true, false, true, true, false, true]);
    for row in [13, 16] {
        full.row_mut(row).fill(0.0);
        full.column_mut(row).fill(0.0);
        full[(row, row)] = 1.0;
    }
    matrix.factor().unwrap();
    let b = DVector::from_fn(24, |_, _| next());
    let mut x = b.as_slice().to_vec();
    matrix.solve(&mut x);
    assert!((DVector::from_vec(x) - full.lu().solve(&b).unwrap()).amax() < 1e-13);
}

/// A matrix with pivots of the wrong sign is factored with exchanges, and is not positive definite.
#[test]
fn an_indefinite_matrix_is_dense() {
    let mut next = random(5);
    let mut matrix = SparseSymmetric::default();
    let mut full = fill(&mut matrix, &[1.0; 3], &[(0, 1), (1, 2)], &mut next);
    matrix.block(1, 1).0[2][2] = -9.0;
    full[(8, 8)] = -9.0;
    matrix.factor().unwrap();
    assert!(matrix.is_dense && matrix.negative() > 0);
    let b = DVector::from_fn(18, |_, _| next());
    let mut x = b.as_slice().to_vec();
    matrix.solve(&mut x);
    assert!((DVector::from_vec(x) - full.lu().solve(&b).unwrap()).amax() < 1e-12);
}

#[test]
fn a_singular_matrix_and_one_that_is_not_finite_are_errors() {
    let mut matrix = SparseSymmetric::default();
    matrix.begin(2);
    assert!(matrix.factor().is_err());
    fill(&mut matrix, &[1.0; 2], &[(0, 1)], random(1));
    matrix.block(1, 0).0[3][2] = f64::NAN;
    assert!(matrix.factor().is_err());
}

/// A chain has no fill-in, and a net of 10 x 10 has at most 600 blocks of 4950, with 180 couplings
/// of its own.
#[test]
fn a_chain_and_a_net_are_ordered_with_few_fill_ins() {
    let mut order = Elimination::default();
    order.order(80, (1..80).map(|i| (i, i - 1)));
    assert_eq!(order.rows.len(), 79);
    order.order(100, grid(10).into_iter());
    println!("net: {} blocks below the diagonal", order.rows.len());
    assert!(order.rows.len() <= 600, "{}", order.rows.len());
    assert!((0..100).all(|block| order.block[order.position[block]] == block));
}
