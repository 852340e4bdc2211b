//! The potential energy, and the work of moments over a step.

use crate::element::shape;
use crate::load::PointLoad;
use crate::model::Model;
use crate::system::Equations;
use nalgebra::Vector3;

/// Returns the work in J of the full moments while the tangents at their points rotate from those
/// of `from` to those of `to`: moment times angle about its axis.
pub(super) fn moment_work(model: &Model, from: &[f64], to: &[f64]) -> f64 {
    let work = |load: &PointLoad| {
        let size = load.moment.norm();
        if size == 0.0 {
            return 0.0;
        }
        let axis = load.moment / size;
        let (e, xi) = model.locate(load.arc_length);
        let weights = shape::slope(xi, model.elements[e].length);
        let normal = |q: &[f64]| {
            let n = &q[6 * e..6 * e + 12];
            let t: Vector3<f64> = (0..4).map(|k| weights[k] * Vector3::from_column_slice(&n[3 * k..3 * k + 3])).sum();
            t - axis * axis.dot(&t)
        };
        let (a, b) = (normal(from), normal(to));
        size * axis.dot(&a.cross(&b)).atan2(a.dot(&b))
    };
    model.loads.iter().map(work).sum()
}

/// Returns the potential energy in J, with point forces at a share `load`.
pub(crate) fn potential(equations: &Equations<'_>, load: f64, q: &[f64]) -> f64 {
    let (axial, bending) = equations.system.forces.strain_energy(q);
    axial
        + bending
        + equations.system.static_contact.energy(equations.model, q)
        + equations
            .system
            .torsion_forces
            .as_ref()
            .map_or(0.0, |torsion| torsion.energy(equations.model, (q, equations.system.static_time)))
        + equations.system.potentials.energy(equations.model, q)
        - equations.system.loads.gravity_work(q)
        - equations.system.loads.effect_work(q)
        - equations.system.loads.point_work(equations.model, load, q)
}
