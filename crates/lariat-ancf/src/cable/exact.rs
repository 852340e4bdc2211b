//! The exact derivatives of the force by position and by velocity, of everything that acts on a cable.
//!
//! ```text
//! K = -dF/dq        C = -dF/dq'        F = elastic + rest shape + damping + drag + moments of point loads
//! ```
//!
//! K is not symmetric with damping, drag or moments: they are no gradients. Each element is evaluated by the scalar form of its kernels
//! with dual numbers, once per coordinate. *Validity.* Exact to rounding, but at kinks: the rows of a flow's profile, drag at no speed. *Use.*
//! Linear stability, control, checks of the step matrix. *Rejected* for the step: it takes the symmetric parts that [`damping`](crate::effect::damping) and [`drag`](crate::effect::drag) name. Newton's
//! iteration with K itself was measured, by a dense L U in place of the step's factors (`cargo test --release -p lariat-ancf --lib
//! exact_tangents -- --nocapture`; 1 s of each scene, steps of 1/60 s, iterations saved):
//!
//! | scene | game | engineering |
//! |---|---:|---:|
//! | rubber rod in water, 1 m/s | 0 % | 0 % |
//! | 2 mm line in water, 5 m/s | 0 % | 2 % |
//! | 2 mm line in water, 20 m/s | 36 % | 2 % |
//! | steel rope in water, 5 m/s | 1 % | 0 % |
//! | rubber rod, damping 1 ms | 0 % | 1 % |
//! | rubber rod, damping 10 ms | 0 % | 3 % |
//! | rubber rod, axial damping 1 s | 22 % | 17 % |
//! | steel rope, damping 1 ms | 0 % | 10 % |
//! | steel rope, axial damping 1 ms | -1 % | 3 % |
//! | 5 mm line, damping 10 ms, water at 3 m/s | 45 % | 1 % |
//!
//! No scene failed with either. Nor does Anderson's mixing of the increments replace it (depth 4, tried): fewer factorisations where drag rules,
//! but more iterations and rejected steps elsewhere (steel rope, damping 1 ms, engineering: 14 of 99 steps; none without). An unsymmetric matrix costs nine blocks for six per element and L U for L D L^T in the factors of every
//! iteration with a fresh tangent, so it would pay where drag or axial damping rule the motion, and nowhere else.

use super::Cable;
use super::assembly::with_bending;
use super::kernel_effects::sum;
use super::model::Model;
use super::system::System;
use crate::bending::Bending;
use crate::cable::assembly::BendingKernel;
use crate::dual::{Dual, constant};
use crate::effect::damping::gram_rates;
use crate::element::gram::{Control, Six, gradient, gram};
use crate::element::shape;
use nalgebra::{DMatrix, Vector3};

/// Negative derivatives of the generalised force over all coordinates, without supports.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobians {
    /// -dF/dq in N/m, N, N m.
    pub stiffness: DMatrix<f64>,
    /// -dF/dq' in N s/m, N s, N m s.
    pub damping: DMatrix<f64>,
}

impl Cable {
    /// The exact derivatives of the force at the present state, supports not applied. Dense, and some ten times the work of
    /// [`stiffness_matrix`](Self::stiffness_matrix): for tens or hundreds of nodes.
    pub fn jacobians(&self) -> Jacobians {
        let (q, v) = (self.positions(), self.velocities());
        let n = q.len();
        let mut out = Jacobians { stiffness: DMatrix::zeros(n, n), damping: DMatrix::zeros(n, n) };
        for (matrix, rates) in [(&mut out.stiffness, [1.0, 0.0]), (&mut out.damping, [0.0, 1.0])] {
            add_elements(&self.system, &self.model, self.time(), q, v, rates, matrix);
        }
        add_moments(&self.model, self.time(), q, &mut out.stiffness);
        out
    }
}

/// Adds the negative derivatives of the forces of all elements along `q += rates[0] e_i`, `v += rates[1] e_i`.
fn add_elements(
    system: &System,
    model: &Model,
    time: f64,
    q: &[f64],
    v: &[f64],
    rates: [f64; 2],
    matrix: &mut DMatrix<f64>,
) {
    for e in 0..model.elements.len() {
        for i in 0..12 {
            let seed = |x: &[f64], rate: f64| -> [Dual; 12] {
                core::array::from_fn(|k| Dual { value: x[6 * e + k], slope: if k == i { rate } else { 0.0 } })
            };
            let force = element_force(system, e, time, &seed(q, rates[0]), &seed(v, rates[1]));
            for (k, f) in force.iter().enumerate() {
                matrix[(6 * e + k, 6 * e + i)] -= f.slope;
            }
        }
    }
}

/// Elastic force and effects of one element.
fn element_force(system: &System, e: usize, time: f64, q: &[Dual; 12], v: &[Dual; 12]) -> [Dual; 12] {
    let elements = &system.elements;
    let s = elements.slope_scale(e);
    let control = |x: &[Dual; 12]| -> Control<Dual> {
        [[x[3], x[4], x[5]], core::array::from_fn(|i| (x[6 + i] - x[i]) * s), [x[9], x[10], x[11]]]
    };
    let d = control(q);
    let g = gram(&d);
    let (axial, flexural) = (constant(elements.axial[e]), constant(elements.flexural[e]));
    let mut n: Six<Dual> = elements.table.gradient(&g, axial);
    with_bending!(&elements.bending, bending => bending.add_gradient(&g, flexural, &mut n));
    let velocities = control(v);
    let mut viscous = [constant(0.0); 6];
    if let Some(kernel) = &system.kernel {
        kernel.add_dual(e, elements, &g, &gram_rates(&d, &velocities), [&mut n, &mut viscous]);
    }
    let f = sum(&gradient(&n, &d), &gradient(&viscous, &velocities));
    let mut out = [constant(0.0); 12];
    for x in 0..3 {
        out[x] = f[1][x] * s;
        out[3 + x] = -f[0][x];
        out[6 + x] = -(f[1][x] * s);
        out[9 + x] = -f[2][x];
    }
    if let Some(fluid) = &system.fluid {
        fluid.add_dual(e, time, q, v, &mut out);
    }
    out
}

/// Moments of point loads: F = S^T (m x t)/|t|^2.
fn add_moments(model: &Model, time: f64, q: &[f64], matrix: &mut DMatrix<f64>) {
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

#[cfg(test)]
pub(super) mod trial;
