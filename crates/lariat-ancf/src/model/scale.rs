//! Reference magnitudes of force and energy for the tolerances of the iterations.

use super::Model;
use crate::effect::potential::Attached;
use crate::element::shape::{self, combine};
use crate::section::Element;

/// Reference magnitudes of a cable under its loads.
pub(crate) struct LoadScale {
    /// Sum of the loads, or the largest tension at the start if there are none, in N.
    pub force: f64,
    /// Residual force due to rounding in N.
    pub rounding: f64,
    /// Energy difference due to rounding in J.
    pub energy_rounding: f64,
    /// First value of mu in 1/s^2.
    pub mu: f64,
    /// Mass of the cable in kg.
    pub mass: f64,
    /// Length of the cable in m.
    pub length: f64,
    /// Length of the shortest element in m.
    pub element: f64,
}

impl LoadScale {
    /// Computes them for a model at coordinates `q`.
    pub fn new(model: &Model, q: &[f64]) -> Self {
        let length = model.length();
        let mass: f64 = model.elements.iter().map(|e| e.length * e.section.mass_per_length).sum();
        let stiffest = model.elements.iter().map(|e| e.section.axial_stiffness).fold(0.0f64, f64::max);
        // a short thick element is stiffer in bending than in stretch
        let bend = |e: &Element| 12.0 * e.section.bending_stiffness / (e.length * e.length);
        let steepest = model.elements.iter().map(bend).fold(stiffest, f64::max);
        let shortest = model.elements.iter().map(|e| e.length).fold(f64::INFINITY, f64::min);
        let pull = |own: &Attached| {
            let (e, xi) = model.locate(own.arc_length);
            let position = combine(q, e, &shape::position(xi, model.elements[e].length));
            own.potential.as_ref().map_or(0.0, |potential| potential.gradient(&position).norm())
        };
        let loads: f64 = model.loads.iter().map(|l| l.force.norm() + l.moment.norm() / length).sum();
        let loads = loads + model.potentials.list.iter().map(pull).sum::<f64>();
        let strain = q
            .chunks_exact(6)
            .map(|x| 0.5 * (x[3] * x[3] + x[4] * x[4] + x[5] * x[5] - 1.0).abs())
            .fold(0.0f64, f64::max);
        let outer = loads + model.dead_resultant().1;
        let force = if outer > 0.0 { outer } else { stiffest * strain.clamp(1e-9, 1.0) };
        let reach = q.chunks_exact(6).flat_map(|x| &x[..3]).fold(1.0f64, |m, x| m.max(x.abs()));
        let epsilon = f64::EPSILON * (1.0 + reach / shortest);
        LoadScale {
            force,
            rounding: 16.0 * steepest * epsilon,
            energy_rounding: 16.0 * stiffest * length * f64::EPSILON,
            mu: 10.0 * force / (mass * length),
            mass,
            length,
            element: shortest,
        }
    }
}

/// Returns the largest force on a node in N: on its position, and on its slope divided by the
/// length `lever` (m), where moments act.
pub(crate) fn largest_force(rhs: &[f64], lever: f64) -> f64 {
    rhs.chunks_exact(6).fold(0.0f64, |worst, x| {
        let force = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        let moment = (x[3] * x[3] + x[4] * x[4] + x[5] * x[5]).sqrt() / lever;
        let size = if force > moment || force.is_nan() { force } else { moment };
        if size > worst || size.is_nan() { size } else { worst }
    })
}
