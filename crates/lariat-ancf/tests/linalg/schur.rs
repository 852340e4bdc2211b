//! The Schur complement of a border against dense solutions.

use crate::{Random, bits, dense, levels};
use lariat_ancf::linalg::{Factorisation, SchurComplement};
use nalgebra::{DMatrix, DVector};

/// Random borders of definite and indefinite matrices: columns of one node, of three, and of all, in any order.
#[test]
fn borders_of_every_size_match_dense_solutions_with_the_same_bits_at_every_level() {
    let mut random = Random(31);
    let mut border = SchurComplement::default();
    for (nodes, shift) in (1..14).flat_map(|nodes| [(nodes, 6.0), (nodes, 0.0)]) {
        let a = random.matrix(nodes, shift);
        let inverse = dense(&a).try_inverse().unwrap();
        for count in [0, 1, 3, 4, 7, 8, 9, 15, 16, 17, 30] {
            let mut b = DMatrix::zeros(6 * nodes, count);
            let mut parts = Vec::new();
            for j in 0..count {
                let length = [1, 3, nodes][(random.next().to_bits() % 3) as usize].min(nodes);
                let first = (((random.next() + 0.5) * (nodes - length + 1) as f64) as usize).min(nodes - length);
                let rows = random.vector(6 * length);
                b.view_mut((6 * first, j), (6 * length, 1)).copy_from_slice(&rows);
                parts.push((first, rows));
            }
            let d = DVector::from_vec(random.vector(count));
            let start = random.matrix(count.div_ceil(6).max(1), 0.0);
            let symmetric = dense(&start).view((0, 0), (count, count)).into_owned();
            let rhs = DVector::from_vec(random.vector(6 * nodes));
            let expected_w = &symmetric - b.transpose() * &inverse * &b;
            let (expected_y, expected_x) = (b.transpose() * &inverse * &rhs, &inverse * (&rhs - &b * &d));
            let mut first: Option<[Vec<u64>; 3]> = None;
            for level in levels() {
                let mut factors = Factorisation::default();
                factors.factor(level, &a).unwrap();
                border.begin(nodes, count);
                parts.iter().enumerate().for_each(|(j, (first, rows))| border.set(j, *first, rows));
                border.complete(level, &factors);
                let (mut w, mut y, mut x) =
                    (symmetric.as_slice().to_vec(), vec![f64::NAN; count], rhs.as_slice().to_vec());
                border.subtract_from(level, &mut w);
                border.reduce(level, &factors, &mut x, &mut y);
                border.expand(level, &factors, d.as_slice(), &mut x);
                let w_matrix = DMatrix::from_vec(count, count, w.clone());
                assert_eq!(w_matrix, w_matrix.transpose(), "{nodes} nodes, {count} columns: not symmetric");
                let size = 1.0 + inverse.amax();
                assert!((w_matrix - &expected_w).abs().max() <= 1e-12 * size * size, "{nodes} nodes, {count} columns");
                for (found, expected) in [(&x, &expected_x), (&y, &expected_y)] {
                    let error = (DVector::from_vec(found.clone()) - expected).amax();
                    assert!(error <= 1e-12 * size * size, "{nodes} nodes, {count} columns: {error:e}");
                }
                let now = [bits(&w), bits(&y), bits(&x)];
                assert_eq!(*first.get_or_insert_with(|| now.clone()), now, "bits differ between levels");
            }
        }
    }
}
