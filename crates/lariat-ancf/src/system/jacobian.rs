//! The exact derivatives of the force by position and by velocity, of everything that acts on a
//! cable.
//!
//! # Equation
//!
//! ```text
//! K = -dF/dq        C = -dF/dq'        F = elastic + rest shape + damping + drag + own force densities + potentials + moments of point loads
//! ```
//!
//! K is not symmetric with damping, drag or moments: they are no gradients. Each element is
//! evaluated by the scalar form of its kernels with dual numbers, once per coordinate.
//!
//! # Validity
//!
//! Exact to rounding, but at kinks: the rows of a flow's profile, drag at zero speed; forces of the
//! user's own to the error of their derivatives. For linear stability, control, and checks of the
//! step matrix.
//!
//! # Alternatives considered
//!
//! K in the matrix of the step, which takes the symmetric parts that
//! [`damping`](crate::effect::damping) and [`drag`](crate::effect::drag) name.

use super::System;
use super::elements::Elements;
use super::forces::Forces;
use crate::dual::{Dual, constant};
use crate::effect::acts::{ForceInput, PointForce, Single};
use crate::element::gram::Control;
use crate::element::kernel::{ElementState, Kernel, Stiffness};
use crate::element::shape;
use crate::model::Model;
use nalgebra::{DMatrix, Vector3};

/// Negative derivatives of the generalised force over all coordinates, without supports.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobians {
    /// -dF/dq in N/m, N, N m.
    pub stiffness: DMatrix<f64>,
    /// -dF/dq' in N s/m, N s, N m s.
    pub damping: DMatrix<f64>,
}

impl Jacobians {
    /// Computes the derivatives for a cable with these equations, at a state.
    pub(crate) fn new(system: &System, model: &Model, at: ForceInput<'_>) -> Self {
        let n = at.q.len();
        let mut out = Jacobians { stiffness: DMatrix::zeros(n, n), damping: DMatrix::zeros(n, n) };
        add_elements(&system.forces, at, [1.0, 0.0], &mut out.stiffness);
        add_elements(&system.forces, at, [0.0, 1.0], &mut out.damping);
        add_moments(model, at, &mut out.stiffness);
        system.potentials.add_stiffness(model, at.q, &mut out.stiffness);
        out
    }
}

/// Adds the negative derivatives of the forces of all elements along `q += rates[0] e_i`, `v +=
/// rates[1] e_i`.
fn add_elements(forces: &Forces, at: ForceInput<'_>, rates: [f64; 2], matrix: &mut DMatrix<f64>) {
    for e in 0..forces.elements.count() {
        for i in 0..12 {
            let seed = |x: &[f64], rate: f64| -> [Dual; 12] {
                core::array::from_fn(|k| Dual { value: x[6 * e + k], slope: if k == i { rate } else { 0.0 } })
            };
            let force = element_force(forces, e, at.time, &seed(at.q, rates[0]), &seed(at.v, rates[1]));
            for (k, f) in force.iter().enumerate() {
                matrix[(6 * e + k, 6 * e + i)] -= f.slope;
            }
        }
    }
}

/// Computes what strain, damping and rest shape of one element do on its control vectors, and the
/// scale of the middle one, its chord.
pub(super) fn control_force(forces: &Forces, e: usize, [q, v]: [&[Dual; 12]; 2]) -> (Control<Dual>, f64) {
    let elements = &forces.elements;
    let s = elements.slope_scale(e);
    let control = |x: &[Dual; 12]| -> Control<Dual> {
        [[x[3], x[4], x[5]], core::array::from_fn(|i| (x[6 + i] - x[i]) * s), [x[9], x[10], x[11]]]
    };
    let Stiffness { axial, bending } = elements.stiffness(e);
    let stiffness = Stiffness { axial: constant(axial), bending: constant(bending) };
    let state = ElementState { stiffness, d: control(q), velocity: Some(control(v)) };
    let Elements { table, bending, .. } = elements;
    (Kernel { table, bending, effects: &forces.in_element.as_ref() }.force(&state, &Single(e)), s)
}

/// Computes elastic force and effects of one element.
pub(super) fn element_force(forces: &Forces, e: usize, time: f64, q: &[Dual; 12], v: &[Dual; 12]) -> [Dual; 12] {
    let (f, s) = control_force(forces, e, [q, v]);
    let mut out = [constant(0.0); 12];
    for x in 0..3 {
        out[x] = f[1][x] * s;
        out[3 + x] = -f[0][x];
        out[6 + x] = -(f[1][x] * s);
        out[9 + x] = -f[2][x];
    }
    forces.at_points.add_dual(e, time, q, v, &mut out);
    if let Some(densities) = &forces.densities {
        densities.add_dual(e, time, q, v, &mut out);
    }
    out
}

/// Adds the moments of point loads: F = S^T (m x t)/|t|^2.
fn add_moments(model: &Model, ForceInput { time, q, .. }: ForceInput<'_>, matrix: &mut DMatrix<f64>) {
    for load in model.loads.iter().filter(|load| load.moment != Vector3::zeros()) {
        let (e, xi) = model.locate(load.arc_length);
        let weights = shape::slope(xi, model.elements[e].length);
        let m = load.moment * load.factor(time);
        let t: Vector3<f64> =
            (0..4).map(|k| weights[k] * Vector3::from_column_slice(&q[6 * e + 3 * k..6 * e + 3 * k + 3])).sum();
        let square = t.norm_squared();
        let derivative = (m.cross_matrix() - m.cross(&t) * t.transpose() * (2.0 / square)) / square;
        for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
            matrix[(6 * e + i, 6 * e + j)] -= weights[i / 3] * weights[j / 3] * derivative[(i % 3, j % 3)];
        }
    }
}
