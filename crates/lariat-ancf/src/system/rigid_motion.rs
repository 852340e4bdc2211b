//! The part of a cable's velocities that is no rigid motion.
//!
//! # Equation
//!
//! The rigid motions that supports allow are all six of a cable without any, the rotations about
//! the node whose position is held, if that is the only support, and none otherwise. The relative
//! velocities are what is left after their projection in the norm of the mass matrix:
//!
//! ```text
//! w = v - v_support - sum_k c_k b_k,     b_j.M w = 0
//! ```
//!
//! so scaling w changes neither linear nor angular momentum (with a support: about it).

use super::System;
use crate::model::Model;
use crate::scales::system::LEAST_PIVOT;
use crate::support::SlopeSupport;
use nalgebra::{Matrix6, Vector3, Vector6};

/// Translations and rotations about a point.
pub(crate) struct Modes<'a> {
    pub q: &'a [f64],
    pub origin: Vector3<f64>,
}

impl Modes<'_> {
    /// Velocity of the vector `i/3` of the cable in mode `k`: translations before rotations.
    fn at(&self, k: usize, i: usize) -> Vector3<f64> {
        let position = i.is_multiple_of(6);
        if k < 3 {
            return if position { Vector3::ith(k, 1.0) } else { Vector3::zeros() };
        }
        let arm = Vector3::from_column_slice(&self.q[i..i + 3]);
        Vector3::ith(k - 3, 1.0).cross(&if position { arm - self.origin } else { arm })
    }

    /// Adds the momenta of velocities `v` in the modes from `first` on, and the inertia of these;
    /// `momentum` and `mode` are buffers.
    pub fn add_momenta(
        &self,
        system: &System,
        (first, v): (usize, &[f64]),
        [momentum, mode]: [&mut [f64]; 2],
        (inertia, momenta): (&mut Matrix6<f64>, &mut Vector6<f64>),
    ) {
        let vectors = || (0..self.q.len()).step_by(3);
        let inner = |k: usize, p: &[f64]| {
            vectors().map(|i| self.at(k, i).dot(&Vector3::from_column_slice(&p[i..i + 3]))).sum::<f64>()
        };
        system.mass.multiply(system.level, v, momentum);
        (first..6).for_each(|k| momenta[k] += inner(k, momentum));
        for k in first..6 {
            vectors().for_each(|i| mode[i..i + 3].copy_from_slice(self.at(k, i).as_slice()));
            system.mass.multiply(system.level, mode, momentum);
            (first..6).for_each(|j| inertia[(j, k)] += inner(j, momentum));
        }
    }
}

/// Replaces the velocities `w` at coordinates `q` by their relative part; `momentum` and `mode` are
/// buffers.
pub(crate) fn relative_velocities(
    model: &Model,
    system: &System,
    q: &[f64],
    w: &mut [f64],
    momentum: &mut [f64],
    mode: &mut [f64],
) {
    let origin = |node: usize| Vector3::from_column_slice(&q[6 * node..6 * node + 3]);
    let (first, modes) = match &model.supports[..] {
        [] => (0, Modes { q, origin: origin(0) }),
        [(node, support)] if support.position.is_some() && support.slope == SlopeSupport::Free => {
            let velocity = Vector3::from_column_slice(&w[6 * node..6 * node + 3]);
            for w in w.chunks_exact_mut(6) {
                (0..3).for_each(|x| w[x] -= velocity[x]);
            }
            (3, Modes { q, origin: origin(*node) })
        }
        supports => {
            for (node, support) in supports {
                support.project(&mut w[6 * node..6 * node + 6]);
            }
            return;
        }
    };
    let (mut matrix, mut rhs) = (Matrix6::zeros(), Vector6::zeros());
    modes.add_momenta(system, (first, &*w), [momentum, mode], (&mut matrix, &mut rhs));
    let c = solve(&mut matrix, rhs);
    for i in (0..q.len()).step_by(3) {
        let rigid: Vector3<f64> = (first..6).map(|k| modes.at(k, i) * c[k]).sum();
        (0..3).for_each(|x| w[i + x] -= rigid[x]);
    }
}

/// Solves a semi-definite system by L D L^T; what has no pivot stays zero.
pub(crate) fn solve(a: &mut Matrix6<f64>, mut b: Vector6<f64>) -> Vector6<f64> {
    let diagonal = a.diagonal();
    let sound = |k: usize, pivot: f64| pivot > LEAST_PIVOT * diagonal[k];
    for k in 0..6 {
        let pivot = a[(k, k)];
        if !sound(k, pivot) {
            continue;
        }
        for i in k + 1..6 {
            let factor = a[(i, k)] / pivot;
            for j in k + 1..6 {
                a[(i, j)] -= factor * a[(k, j)];
            }
            b[i] -= factor * b[k];
        }
    }
    let mut x = Vector6::zeros();
    for k in (0..6).rev() {
        if sound(k, a[(k, k)]) {
            x[k] = (b[k] - (k + 1..6).map(|j| a[(k, j)] * x[j]).sum::<f64>()) / a[(k, k)];
        }
    }
    x
}
