//! The inertia that couples bodies, over a step of the discrete gradient.
//!
//! # Equation
//!
//! As that of [one body](super::body), it is constant over a host step with the velocities of
//! positions in world axes and those of rotations in body axes. The energy law is then that of the
//! quadratic form of all bodies.

use super::body::BodyStep;
use crate::island::CoupledInertia;
use crate::one_leg::OneLeg;
use crate::term::Balance;
use nalgebra::Vector6;

/// Completes the rows of the bodies: loads and inertia, that which couples them included.
pub(super) fn complete_rows(bodies: &[BodyStep], coupled: &[CoupledInertia], rows: &mut [f64]) {
    for (body, row) in bodies.iter().zip(rows.chunks_exact_mut(6)) {
        body.complete_row(row);
    }
    for (i, momentum) in coupled.iter().flat_map(|c| c.momenta(|i| bodies[i].change)) {
        bodies[i].subtract_momentum(&momentum, &mut rows[6 * i..6 * i + 6]);
    }
}

/// Returns the product of two vectors of the bodies over the coupled inertia: of one with itself,
/// twice its energy.
pub(super) fn coupled_product(
    coupled: &[CoupledInertia],
    one: impl Fn(usize) -> Vector6<f64>,
    two: impl Fn(usize) -> Vector6<f64>,
) -> f64 {
    coupled.iter().flat_map(|c| c.momenta(&two)).map(|(i, p)| one(i).dot(&p)).sum()
}

/// Adds the coupled inertia's part of what is dissipated by the method, and held when the step
/// begins.
pub(super) fn add_coupled_energies(bodies: &[BodyStep], coupled: &[CoupledInertia], leg: OneLeg, total: &mut Balance) {
    for c in coupled {
        let seconds = c.bodies.map(|i| bodies[i].second_difference());
        total.numerical += leg.a * seconds[0].dot(&(c.matrix * seconds[1]));
    }
    total.held += 0.5 * coupled_product(coupled, |i| bodies[i].velocity, |i| bodies[i].velocity);
}
