//! Weight, constant forces of effects, and point loads.

use crate::diagnostics::Diagnostics;
use crate::effect::acts::ForceInput;
use crate::effect::tables::DeadForces;
use crate::element::{mass, shape};
use crate::linalg::BlockTridiagonal;
use crate::load::{PointLoad, moment_on_slope};
use crate::model::Model;
use nalgebra::Vector3;

/// Element of a point load, and the weights of its coordinates in position and slope there.
#[derive(Clone, Copy, Debug)]
struct Located {
    element: usize,
    position: [f64; 4],
    slope: [f64; 4],
}

/// Loads of a cable.
#[derive(Clone, Debug)]
pub(crate) struct Loads {
    /// By point load of the model.
    located: Vec<Located>,
    gravity_force: Vec<f64>,
    /// Constant forces of effects.
    pub of_effects: DeadForces,
    /// Weight and constant forces of effects.
    dead_force: Vec<f64>,
}

impl Loads {
    pub fn new(model: &Model) -> Self {
        let zeros = || vec![0.0; 6 * model.nodes()];
        let of_effects = model.effects.dead_forces(&model.target());
        let mut loads = Loads { located: Vec::new(), gravity_force: zeros(), of_effects, dead_force: zeros() };
        loads.weigh(model);
        loads.locate(model);
        loads
    }

    /// Sums the weight of the elements and the constant forces.
    pub fn weigh(&mut self, model: &Model) {
        self.gravity_force.fill(0.0);
        for (e, element) in model.elements.iter().enumerate() {
            let weight = model.weight(element);
            for (k, share) in mass::load_weights(element.length).iter().enumerate() {
                for x in 0..3 {
                    self.gravity_force[6 * e + 3 * k + x] += share * weight[x];
                }
            }
        }
        self.dead_force.copy_from_slice(&self.gravity_force);
        self.of_effects.add(&mut self.dead_force);
    }

    /// Sets weight and line load of element `e` to those of its length in m, with the weight of a
    /// length in m of material beyond each end.
    pub fn weigh_element(&mut self, model: &Model, e: usize, length: impl Fn(usize) -> f64, at_ends: [f64; 2]) {
        let (own, last) = (6 * e..6 * e + 12, model.elements.len());
        let loaded = !self.of_effects.line_loads.is_empty();
        let of_line = if loaded { model.line_force() } else { Vector3::zeros() };
        self.gravity_force[own.clone()].fill(0.0);
        if loaded {
            self.of_effects.line_loads[own.clone()].fill(0.0);
        }
        // the element, and both beside it
        for i in e.saturating_sub(1)..(e + 2).min(last) {
            let (weight, shares) = (model.weight(&model.elements[i]), mass::load_weights(length(i)));
            for node in [i, i + 1].into_iter().filter(|node| (e..=e + 1).contains(node)) {
                let k = if node == i { 0 } else { 2 };
                for at in 0..6 {
                    self.gravity_force[6 * node + at] += shares[k + at / 3] * weight[at % 3];
                    if loaded {
                        self.of_effects.line_loads[6 * node + at] += shares[k + at / 3] * of_line[at % 3];
                    }
                }
            }
        }
        for (node, beyond) in
            [(0, at_ends[0]), (last, at_ends[1])].into_iter().filter(|(node, _)| (e..=e + 1).contains(node))
        {
            let weight = model.weight(&model.elements[node.min(last - 1)]);
            (0..3).for_each(|x| self.gravity_force[6 * node + x] += beyond * weight[x]);
        }
        self.dead_force[own.clone()].copy_from_slice(&self.gravity_force[own.clone()]);
        if loaded {
            own.for_each(|at| self.dead_force[at] += self.of_effects.line_loads[at]);
        }
    }

    /// Finds the elements of the point loads.
    pub fn locate(&mut self, model: &Model) {
        self.located.clear();
        self.located.extend(model.loads.iter().map(|load| {
            let (element, xi) = model.locate(load.arc_length);
            let length = model.elements[element].length;
            Located { element, position: shape::position(xi, length), slope: shape::slope(xi, length) }
        }));
    }

    /// Returns the work of gravity from the origin to `q`, in J.
    pub fn gravity_work(&self, q: &[f64]) -> f64 {
        self.gravity_force.iter().zip(q).map(|(f, q)| f * q).sum()
    }

    /// Returns the work of constant forces of effects from the origin to `q`, in J.
    pub fn effect_work(&self, q: &[f64]) -> f64 {
        self.of_effects.work(q)
    }

    /// Returns the work of a share of the point forces from the origin to `q`, in J; moments have
    /// none in general.
    pub fn point_work(&self, model: &Model, share: f64, q: &[f64]) -> f64 {
        let work = |load: &PointLoad| {
            let (e, xi) = model.locate(load.arc_length);
            let weights = shape::position(xi, model.elements[e].length);
            (0..12).map(|i| weights[i / 3] * load.force[i % 3] * q[6 * e + i]).sum::<f64>()
        };
        model.loads.iter().map(|load| share * work(load)).sum()
    }

    /// Returns the power of the point loads in W at positions `q` and velocities `v`.
    pub fn point_power(&self, loads: &[PointLoad], time: f64, q: &[f64], v: &[f64]) -> f64 {
        let power = |(load, at): (&PointLoad, &Located)| {
            let sum = |weights: &[f64; 4], x: &[f64]| -> Vector3<f64> {
                let n = &x[6 * at.element..6 * at.element + 12];
                (0..4).map(|k| weights[k] * Vector3::from_column_slice(&n[3 * k..3 * k + 3])).sum()
            };
            let mut power = load.force.dot(&sum(&at.position, v));
            if load.moment != Vector3::zeros() {
                power += moment_on_slope(&load.moment, &sum(&at.slope, q)).0.dot(&sum(&at.slope, v));
            }
            load.factor(time) * power
        };
        loads.iter().zip(&self.located).map(power).sum()
    }

    /// Adds all loads to `out`, and their negative derivative to `matrix` if that is asked for.
    pub fn add(
        &self,
        loads: &[PointLoad],
        input: ForceInput<'_>,
        out: &mut [f64],
        mut matrix: Option<&mut BlockTridiagonal>,
        diagnostics: &mut Diagnostics,
    ) {
        let ForceInput { time, q, scale, .. } = input;
        for (out, g) in out.iter_mut().zip(&self.dead_force) {
            *out += scale * g;
        }
        for (load, located) in loads.iter().zip(&self.located) {
            diagnostics.load_evaluations += 1;
            let &Located { element: e, position, slope: weights } = located;
            let factor = scale * load.factor(time);
            let n = &mut out[6 * e..6 * e + 12];
            for (k, weight) in position.into_iter().enumerate() {
                for x in 0..3 {
                    n[3 * k + x] += factor * weight * load.force[x];
                }
            }
            if load.moment == Vector3::zeros() {
                continue;
            }
            let slope: Vector3<f64> =
                (0..4).map(|k| weights[k] * Vector3::from_column_slice(&q[6 * e + 3 * k..6 * e + 3 * k + 3])).sum();
            let (force, derivative) = moment_on_slope(&load.moment, &slope);
            for k in 0..4 {
                for x in 0..3 {
                    n[3 * k + x] += factor * weights[k] * force[x];
                }
            }
            let Some(matrix) = matrix.as_deref_mut() else { continue };
            for (k, m) in (0..4).flat_map(|k| (0..4).map(move |m| (k, m))) {
                let weight = -factor * weights[k] * weights[m];
                // rows of coordinate k, columns of coordinate m; only one triangle of blocks is
                // stored
                let block = match (k / 2, m / 2) {
                    (0, 0) => &mut matrix.diag[e],
                    (1, 1) => &mut matrix.diag[e + 1],
                    (1, 0) => &mut matrix.lower[e],
                    _ => continue,
                };
                for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
                    block.0[3 * (m % 2) + c][3 * (k % 2) + r] += weight * derivative[(r, c)];
                }
            }
        }
    }
}
