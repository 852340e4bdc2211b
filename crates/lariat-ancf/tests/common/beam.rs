//! A rod of unit numbers and its lowest mode: for tests of effects.

use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{At, Cable, CableBuilder, Effects, Section, Vector3};
use nalgebra::{DMatrix, SymmetricEigen};

/// Effects with one change.
pub fn only(change: impl FnOnce(&mut Effects)) -> Effects {
    let mut effects = Effects::default();
    change(&mut effects);
    effects
}

/// A rod of unit length and stiffness, clamped, without gravity.
pub fn cantilever(elements: usize) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .section(Section::from_stiffness(1e4, 1.0, 1.0).unwrap())
        .elements(elements)
        .gravity(Vector3::zeros())
        .clamp(At::Start)
}

/// Lowest eigenfrequency (rad/s) and mode of a cable at its present state.
pub fn first_mode(cable: &mut Cable) -> (f64, Vec<f64>) {
    let (mut k, mut m) = (cable.stiffness_matrix(), cable.mass_matrix());
    cable.apply_supports(&mut k);
    cable.apply_supports(&mut m);
    let (k, m): (DMatrix<f64>, DMatrix<f64>) = (super::dense(&k), super::dense(&m));
    let inverse = m.cholesky().unwrap().l().try_inverse().unwrap();
    let eigen = SymmetricEigen::new(&inverse * k * inverse.transpose());
    // held coordinates have eigenvalue 1 by the projection; unit stiffness puts the first mode at 12.4
    let lowest = (0..eigen.eigenvalues.len())
        .filter(|&i| eigen.eigenvalues[i] > 1.0 + 1e-6)
        .min_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]))
        .unwrap();
    let mode = inverse.transpose() * eigen.eigenvectors.column(lowest);
    (eigen.eigenvalues[lowest].sqrt(), mode.as_slice().to_vec())
}
