//! [Potentials](crate::Potential) of points of the cable in its equations.

use super::step_vectors::StepVectors;
use crate::effect::potential::{Potential, over_step};
use crate::element::assembly::{add_force, add_tangent};
use crate::element::shape::{self, combine};
use crate::linalg::BlockTridiagonal;
use crate::model::Model;
use nalgebra::DMatrix;

/// Where they are: element and shape functions, in their order.
#[derive(Clone, Debug, Default)]
pub(crate) struct PointPotentials {
    located: Vec<(usize, [f64; 4])>,
}

impl PointPotentials {
    pub fn new(model: &Model) -> Self {
        let mut own = PointPotentials::default();
        own.locate(model);
        own
    }

    /// Finds the elements.
    pub fn locate(&mut self, model: &Model) {
        self.located.clear();
        self.located.extend(model.potentials.list.iter().map(|own| {
            let (element, xi) = model.locate(own.arc_length);
            (element, shape::position(xi, model.elements[element].length))
        }));
    }

    /// Returns the number of potentials.
    pub fn count(&self) -> u64 {
        self.located.len() as u64
    }

    /// Returns the functions, each with its element and shape functions.
    fn iter<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = (&'a dyn Potential, usize, &'a [f64; 4])> {
        let located = model.potentials.list.iter().zip(&self.located);
        located.filter_map(|(own, (element, shape))| Some((own.potential.as_deref()?, *element, shape)))
    }

    /// Returns their energy in J.
    pub fn energy(&self, model: &Model, q: &[f64]) -> f64 {
        self.iter(model).map(|(potential, e, shape)| potential.energy(&combine(q, e, shape))).sum()
    }

    /// Adds `scale` times their forces to `out`, and minus the derivatives to the matrix.
    pub fn add(
        &self,
        model: &Model,
        (q, scale): (&[f64], f64),
        out: &mut [f64],
        mut matrix: Option<&mut BlockTridiagonal>,
    ) {
        for (potential, e, shape) in self.iter(model) {
            let position = combine(q, e, shape);
            add_force(out, e, shape, &(potential.gradient(&position) * -scale));
            if let Some(matrix) = matrix.as_deref_mut() {
                add_tangent(matrix, e, shape, &(potential.hessian(&position) * scale));
            }
        }
    }

    /// Adds their mean forces over a step to `external`, and `b h^2` times minus the derivatives to
    /// the matrix.
    pub fn add_over_step(
        &self,
        model: &Model,
        q: &[f64],
        b: &mut StepVectors,
        mut matrix: Option<&mut BlockTridiagonal>,
    ) {
        for (potential, e, shape) in self.iter(model) {
            let (start, change) = (combine(q, e, shape), combine(&b.change, e, shape));
            let (gradient, tangent) = over_step(potential, &start, &change);
            add_force(&mut b.external, e, shape, &-gradient);
            if let Some(matrix) = matrix.as_deref_mut() {
                add_tangent(matrix, e, shape, &(tangent * (b.leg.b * b.h * b.h)));
            }
        }
    }

    /// Adds minus the derivatives of their forces to a full matrix.
    pub fn add_stiffness(&self, model: &Model, q: &[f64], matrix: &mut DMatrix<f64>) {
        for (potential, e, shape) in self.iter(model) {
            let hessian = potential.hessian(&combine(q, e, shape));
            for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
                matrix[(6 * e + i, 6 * e + j)] += shape[i / 3] * shape[j / 3] * hessian[(i % 3, j % 3)];
            }
        }
    }
}
