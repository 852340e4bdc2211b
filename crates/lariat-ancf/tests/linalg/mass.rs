//! Mass matrix: product and solution against the same matrix in 6x6 blocks.

use super::{Random, bits, from_fn, levels};
use fearless_simd::Level;
use lariat_ancf::linalg::{BlockTridiagonal, MassFactorisation, MassMatrix, Reason};

/// Consistent mass matrix of Hermite beam elements of unit length, as for a cable.
fn cable_mass(nodes: usize) -> MassMatrix {
    let mut m = MassMatrix::zeros(nodes);
    for e in 0..nodes - 1 {
        for (node, sign) in [(e, 1.0), (e + 1, -1.0)] {
            m.diag[node][0] += 156.0 / 420.0;
            m.diag[node][1] += sign * 22.0 / 420.0;
            m.diag[node][2] += 4.0 / 420.0;
        }
        m.lower[e] = [54.0, 13.0, -13.0, -3.0].map(|v| v / 420.0);
    }
    m
}

fn mass_blocks(m: &MassMatrix) -> BlockTridiagonal {
    from_fn(m.nodes(), |r, c| {
        let (i, j) = (r / 6, c / 6);
        let (p, q) = (r % 6 / 3, c % 6 / 3);
        match (r % 3 == c % 3, i == j) {
            (true, true) => m.diag[i][p + q],
            (true, false) => m.lower[j][2 * p + q],
            _ => 0.0,
        }
    })
}

#[test]
fn mass_matrices_match_block_matrices() {
    let mut random = Random(4);
    for n in (2..20).chain([101, 200]) {
        let m = cable_mass(n);
        let blocks = mass_blocks(&m);
        let x = random.vector(6 * n);
        let (mut y, mut z) = (vec![0.0; 6 * n], vec![0.0; 6 * n]);
        m.multiply(&x, &mut y);
        blocks.multiply(&x, &mut z);
        for (p, q) in y.iter().zip(&z) {
            assert!((p - q).abs() < 1e-15);
        }
        let mut f = MassFactorisation::default();
        f.factor(&m).unwrap();
        let mut first = None;
        for level in levels() {
            let mut solved = y.clone();
            f.solve(level, &mut solved);
            for (p, q) in x.iter().zip(&solved) {
                assert!((p - q).abs() < 1e-12, "n = {n}: {p} {q}");
            }
            assert_eq!(*first.get_or_insert(bits(&solved)), bits(&solved));
        }
    }
}

#[test]
fn mass_matrices_that_are_not_positive_definite_are_errors() {
    let mut f = MassFactorisation::default();
    for n in [2, 5, 6] {
        for node in 0..n {
            for (value, reason) in [(f64::NAN, Reason::NonFinite), (-1.0, Reason::NotPositive)] {
                let mut m = cable_mass(n);
                m.diag[node][0] = value;
                let error = f.factor(&m).unwrap_err();
                assert_eq!(error.reason, reason);
                let mut m = cable_mass(n);
                m.lower[node.min(n - 2)][3] = f64::INFINITY;
                assert!(f.factor(&m).is_err());
            }
        }
        assert!(f.factor(&MassMatrix::zeros(n)).is_err());
        assert_eq!(f.nodes(), 0);
    }
    let one = MassMatrix { diag: vec![[2.0, 0.5, 1.0]], lower: vec![] };
    f.factor(&one).unwrap();
    let mut x = [2.5, 0.0, 0.0, 1.5, 0.0, 0.0];
    f.solve(Level::new(), &mut x);
    assert!((x[0] - 1.0).abs() < 1e-15 && (x[3] - 1.0).abs() < 1e-15);
}
