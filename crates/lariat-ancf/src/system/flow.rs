//! The element at the eye of a reel within the equations of its cable.
//!
//! # Equation
//!
//! Implicit stages evaluate the element at its length l(t): its stiffness, mass and weight are those of l, and the
//! [forces of the flow](crate::element::flow) are added. Internal damping sees the rates of the control vectors, of which
//! `d1 = 3 (r_j - r_i)/l` changes with l, too.
//!
//! In a step of the discrete gradient from l0 to l1 the strain energy is `U = l C_a u_a(g) + C_b u_b(g)/l`. With the means over the step
//!
//! ```text
//! D d1 = 3 [D(r_j - r_i) (1/l)_m + (r_j - r_i)_m D(1/l)]      D U = f . D q + Y D l to rounding
//! ```
//!
//! The loop over the elements keeps its form: it is given the eye where it would be on an element of the length l0 with the same control
//! vectors, and its force is scaled by `l0 (1/l)_m`. Inertia, forces of the flow and weight are those of the mean length.
//!
//! # Validity
//!
//! Elastic work is exact for any step; kinetic energy to the second order of the step. The tangent takes the symmetric part of the
//! forces of the flow.

use super::elements::with_bending;
use super::{Equations, System};
use crate::effect::acts::{ForceInput, Single};
use crate::effect::work::{POINTS, hermite};
use crate::element::flow::{Extent, FlowElement};
use crate::element::gram::{Control, gram};
use crate::element::kernel::{ElementState, GramState, Kernel, NoEffects, Stiffness, energy};
use crate::integrate::State;
use crate::integrate::discrete_gradient::{BETA, Buffers};
use crate::linalg::BlockTridiagonal;
use crate::model::Model;
use core::ops::Range;

/// The element at the eye of a reel, which is the last of its cable, during a step.
#[derive(Clone, Debug)]
pub(crate) struct Flow {
    /// Time in s at which the extent is.
    pub start: f64,
    /// Extent at that time; the acceleration stays.
    pub extent: Extent,
    /// Velocities as internal damping sees them.
    velocity: Vec<f64>,
    /// Force of the loop over the elements on the eye in the last iterate of the discrete gradient, in N.
    eye_force: [f64; 3],
    /// Length in m at the beginning of the last step.
    pub length_before: f64,
    /// Whether an end of the cable stops it.
    pub stopped: bool,
}

impl Flow {
    /// A flow at rest.
    pub fn new(length: f64) -> Self {
        let extent = Extent { length, ..Extent::default() };
        Flow { start: 0.0, extent, velocity: Vec::new(), eye_force: [0.0; 3], length_before: length, stopped: false }
    }

    /// Returns the extent at a time in s.
    pub fn at(&self, time: f64) -> Extent {
        let Extent { length, rate, acceleration } = self.extent;
        let t = time - self.start;
        Extent { length: length + t * (rate + 0.5 * t * acceleration), rate: rate + t * acceleration, acceleration }
    }

    /// Returns the mean of a step from `time` of length `h` (s), and the lengths at both ends.
    fn over(&self, time: f64, h: f64) -> (Extent, [f64; 2]) {
        let [first, last] = [self.at(time), self.at(time + h)];
        let mean = Extent {
            length: 0.5 * (first.length + last.length),
            rate: (last.length - first.length) / h,
            acceleration: first.acceleration,
        };
        (mean, [first.length, last.length])
    }

    /// Returns velocities as internal damping of the element at the eye sees them.
    pub fn damping_velocity(&mut self, at: &ForceInput<'_>) -> &[f64] {
        let mut velocity = core::mem::take(&mut self.velocity);
        velocity.clear();
        velocity.extend_from_slice(at.v);
        self.strain_velocity(at.time, at.q, &mut velocity);
        self.velocity = velocity;
        &self.velocity
    }

    /// Makes of velocities those that internal damping sees, at `time` (s).
    pub fn strain_velocity(&self, time: f64, q: &[f64], v: &mut [f64]) {
        let Extent { length, rate, .. } = self.at(time);
        let eye = v.len() - 6;
        for x in 0..3 {
            v[eye + x] -= (q[eye + x] - q[eye - 6 + x]) * rate / length;
        }
    }

    /// Adds the forces of the flow to `out`, and their negative derivatives to the matrix.
    pub fn add(&self, model: &Model, at: &ForceInput<'_>, out: &mut [f64], matrix: Option<&mut BlockTridiagonal>) {
        if at.v.is_empty() {
            return;
        }
        let element = of_last(model, self.at(at.time));
        let range = last(model);
        element.add_force(at.scale, &at.q[range.clone()], &at.v[range.clone()], &mut out[range]);
        if let Some(matrix) = matrix {
            let [by_velocity, by_position] = element.matrices();
            let entry = |r: usize, c: usize| at.scale * (at.dv_dq * by_velocity[r][c] + by_position[r][c]);
            add_symmetric(matrix, model.nodes() - 2, entry);
        }
    }
}

/// Returns the last element with this extent.
fn of_last(model: &Model, extent: Extent) -> FlowElement {
    FlowElement { inertia: model.inertia(&model.elements[model.elements.len() - 1]), extent }
}

/// Range of the coordinates of the last element.
fn last(model: &Model) -> Range<usize> {
    6 * (model.nodes() - 2)..6 * model.nodes()
}

impl System {
    /// Sets what depends on the length of the element at the eye to `time` (s).
    pub fn set_flow(&mut self, model: &Model, time: f64) {
        if let Some(flow) = &self.flow {
            self.set_lengths(model, flow.at(time));
        }
    }

    /// Sets what depends on the length of the element at the eye.
    pub fn set_lengths(&mut self, model: &Model, Extent { length, .. }: Extent) {
        self.set_each_length(model, [length, length, 1.0 / length]);
    }

    /// Sets the lengths of the element at the eye: that of its control vectors, that of axial stiffness and mass, and the inverse
    /// of that of bending.
    fn set_each_length(&mut self, model: &Model, [shape, mean, inverse]: [f64; 3]) {
        let e = model.elements.len() - 1;
        let element = &model.elements[e];
        let elements = &mut self.forces.elements;
        elements.scale[e] = 3.0 / shape;
        elements.axial[e] = 0.25 * element.section.axial_stiffness * mean;
        elements.flexural[e] = 2.0 * element.section.bending_stiffness * inverse;
        elements.set_mass(e, model.inertia(element), mean);
        self.mass.set_last(model, mean);
        self.loads.weigh_last(model, mean);
    }

    /// Notes the length at the beginning of a step of the discrete gradient, `time` (s), for the next one.
    pub fn end_flow_step_at(&mut self, time: f64) {
        if let Some(flow) = &mut self.flow {
            flow.length_before = flow.at(time).length;
        }
    }

    /// Returns the kinetic energy in J that the flow adds to that of the mass matrix.
    pub fn flow_kinetic(&self, model: &Model, time: f64, q: &[f64], v: &[f64]) -> f64 {
        let Some(flow) = &self.flow else { return 0.0 };
        let range = last(model);
        of_last(model, flow.at(time)).kinetic_energy(&q[range.clone()], &v[range])
    }

    /// Adds the momentum of the flow at `time` (s) to `p`.
    pub fn add_flow_momentum(&self, model: &Model, time: f64, q: &[f64], p: &mut [f64]) {
        if let Some(flow) = &self.flow {
            let range = last(model);
            of_last(model, flow.at(time)).add_momentum(&q[range.clone()], &mut p[range]);
        }
    }

    /// Returns the strain energy of the last element in J, axial and bending, at a length and control vectors.
    fn flow_energy(&self, model: &Model, d: &Control<f64>, length: f64) -> (f64, f64) {
        let e = model.elements.len() - 1;
        let section = &model.elements[e].section;
        let stiffness = Stiffness {
            axial: 0.25 * section.axial_stiffness * length,
            bending: 2.0 * section.bending_stiffness / length,
        };
        let elements = &self.forces.elements;
        let own = with_bending!(&elements.bending, bending => energy(&elements.table, bending, stiffness, d));
        let state = GramState { table: &elements.table, stiffness, g: gram(d), rates: None };
        let of_effects = self.forces.in_element.as_ref().map_or((0.0, 0.0), |effects| effects.energy(e, &state));
        (own.0 + of_effects.0, own.1 + of_effects.1)
    }

    /// Returns dU/dl of the last element at fixed coordinates, in N.
    fn strain_length_force(&self, model: &Model, q: &[f64], length: f64) -> f64 {
        let e = model.elements.len() - 1;
        let section = &model.elements[e].section;
        let stiffness = Stiffness {
            axial: 0.25 * section.axial_stiffness * length,
            bending: 2.0 * section.bending_stiffness / length,
        };
        let elements = &self.forces.elements;
        let d = control(q, length);
        let state = ElementState { stiffness, d, velocity: None };
        let table = &elements.table;
        let gradient = with_bending!(&elements.bending, bending => match &self.forces.in_element {
            None => Kernel { table, bending, effects: &NoEffects }.force(&state, &NoEffects),
            Some(effects) => Kernel { table, bending, effects }.force(&state, &Single(e)),
        });
        let (axial, bending) = self.flow_energy(model, &d, length);
        (axial - bending - (0..3).map(|x| d[1][x] * gradient[1][x]).sum::<f64>()) / length
    }

    /// Returns pull and power of the winch at the coordinates, velocities and accelerations of the last element.
    pub fn flow_force(&self, model: &Model, time: f64, [q, v, a]: [&[f64]; 3]) -> FlowForce {
        let Some(flow) = &self.flow else { return FlowForce::default() };
        let extent = flow.at(time);
        let element = of_last(model, extent);
        let weight = weight_of_last(model);
        let on_length = element.length_force(q, v, a, &weight) + self.strain_length_force(model, q, extent.length);
        let square = q[9] * q[9] + q[10] * q[10] + q[11] * q[11];
        FlowForce {
            pull: -on_length - 0.5 * element.inertia * extent.rate * extent.rate * (square - 1.0),
            power: extent.rate * (on_length + entering(&element, &weight, q, v)),
        }
    }
}

/// Control vectors of an element with 12 coordinates.
fn control(q: &[f64], length: f64) -> Control<f64> {
    let s = 3.0 / length;
    [[q[3], q[4], q[5]], core::array::from_fn(|x| s * (q[6 + x] - q[x])), [q[9], q[10], q[11]]]
}

/// Adds the symmetric part of a 4x4 table to the blocks of element `e`.
fn add_symmetric(matrix: &mut BlockTridiagonal, e: usize, entry: impl Fn(usize, usize) -> f64) {
    for a in 0..4 {
        for b in 0..4 {
            let value = 0.5 * (entry(a, b) + entry(b, a));
            // rows of coordinate a, columns of coordinate b; only one triangle of blocks is stored
            let block = match (a / 2, b / 2) {
                (0, 0) => &mut matrix.diag[e],
                (1, 1) => &mut matrix.diag[e + 1],
                (1, 0) => &mut matrix.lower[e],
                _ => continue,
            };
            for x in 0..3 {
                block.0[3 * (b % 2) + x][3 * (a % 2) + x] += value;
            }
        }
    }
}

/// What a reel does, at an instant.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FlowForce {
    /// Pull of the winch on the cable in N.
    pub pull: f64,
    /// Power in W that winch and entering material bring.
    pub power: f64,
}

impl Equations<'_> {
    /// Returns the work of winch and entering material over a step of a method with accelerations, by the two points of Gauss on
    /// the cubics of velocity; `end` is where the cable's part of the states ends.
    pub fn flow_work(&self, before: &State, after: &State, h: f64, end: usize) -> f64 {
        let range = end - 12..end;
        let mut work = 0.0;
        for s in POINTS {
            let (cubic, slope) = hermite(s);
            let mix = |w: [f64; 4], [x0, d0, x1, d1]: [&[f64]; 4]| -> [f64; 12] {
                let of = |k: usize| w[0] * x0[k] + h * w[1] * d0[k] + w[2] * x1[k] + h * w[3] * d1[k];
                core::array::from_fn(|i| of(range.start + i))
            };
            let (a0, a1) = (&before.memory.acceleration[..], &after.memory.acceleration[..]);
            let q = mix(cubic, [&before.q, &before.v, &after.q, &after.v]);
            let velocities = [&before.v[..], a0, &after.v[..], a1];
            let (v, a) = (mix(cubic, velocities), mix(slope, velocities).map(|x| x / h));
            work += 0.5 * h * self.system.flow_force(self.model, before.time + s * h, [&q, &v, &a]).power;
        }
        work
    }

    /// Returns the work of winch and entering material over a step of the discrete gradient.
    pub fn flow_work_of_step(&self, state: &State, b: &Buffers) -> f64 {
        let (model, system) = (self.model, &*self.system);
        let Some(flow) = &system.flow else { return 0.0 };
        let (mean, [l0, l1]) = flow.over(state.time, b.h);
        let range = last(model);
        let (q, change) = (&state.q[range.clone()], &b.change[range.clone()]);
        let at = |share: f64| -> [f64; 12] { core::array::from_fn(|i| q[i] + share * change[i]) };
        let (start, middle, end) = (at(0.0), at(0.5), at(1.0));
        let [u0, u1] = [(&start, l0), (&end, l1)].map(|(q, l)| (system.flow_energy(model, &control(q, l), l), l));
        let inverse = 1.0 / l1 - 1.0 / l0;
        let of_eye: f64 = (0..3).map(|x| flow.eye_force[x] * (middle[6 + x] - middle[x])).sum();
        let elastic = (l1 - l0) * 0.5 * (u0.0.0 / u0.1 + u1.0.0 / u1.1)
            + inverse * (0.5 * (u0.0.1 * u0.1 + u1.0.1 * u1.1) - l0 * of_eye);
        let element = of_last(model, mean);
        let weight = weight_of_last(model);
        let velocity: [f64; 12] = core::array::from_fn(|i| change[i] / b.h);
        let acceleration: [f64; 12] = core::array::from_fn(|i| b.velocity_change[range.start + i] / b.h);
        let inertial = element.length_force(&middle, &velocity, &acceleration, &weight);
        elastic + (l1 - l0) * (inertial + entering(&element, &weight, &middle, &velocity))
    }

    /// Sets the lengths of a step of the discrete gradient, and moves the eye in its iterates to where it is on an element of the
    /// length at the beginning; returns the true iterates of the eye.
    pub fn begin_flow_step(&mut self, state: &State, b: &mut Buffers) -> Option<[[f64; 3]; 3]> {
        let flow = self.system.flow.as_ref()?;
        let (mean, [l0, l1]) = flow.over(state.time, b.h);
        let before = flow.length_before;
        self.system.set_each_length(self.model, [l0, mean.length, 0.5 * (1.0 / l0 + 1.0 / l1)]);
        let eye = state.q.len() - 6;
        let mut saved = [[0.0; 3]; 3];
        for (k, list) in [&mut b.change, &mut b.linearised, &mut b.change_before].into_iter().enumerate() {
            if list.is_empty() {
                continue;
            }
            // the other end of the step: its end, or the beginning of the one before
            let (sign, other) = if k < 2 { (1.0, l1) } else { (-1.0, before) };
            for x in 0..3 {
                saved[k][x] = list[eye + x];
                let i = state.q[eye - 6 + x] + sign * list[eye - 6 + x];
                let j = state.q[eye + x] + sign * list[eye + x];
                list[eye + x] = sign * (i + l0 / other * (j - i) - state.q[eye + x]);
            }
        }
        Some(saved)
    }

    /// Ends what [`begin_flow_step`](Self::begin_flow_step) began, and scales the force of the element on the eye in the residual.
    pub fn end_flow_step(&mut self, state: &State, b: &mut Buffers, saved: Option<[[f64; 3]; 3]>) {
        let (Some(saved), Some(flow)) = (saved, &mut self.system.flow) else { return };
        let (_, [l0, l1]) = flow.over(state.time, b.h);
        let share = 0.5 * (1.0 + l0 / l1);
        let eye = state.q.len() - 6;
        for (list, saved) in [&mut b.change, &mut b.linearised, &mut b.change_before].into_iter().zip(saved) {
            if !list.is_empty() {
                list[eye..eye + 3].copy_from_slice(&saved);
            }
        }
        for x in 0..3 {
            let force = b.rhs[eye + x];
            flow.eye_force[x] = force / b.h;
            b.rhs[eye + x] = share * force;
            b.rhs[eye - 6 + x] += (1.0 - share) * force;
        }
    }

    /// Adds the forces of the flow over a step of the discrete gradient to those without potential, and their derivatives to the
    /// matrix if it is asked for.
    pub fn add_flow_over_step(&mut self, state: &State, b: &mut Buffers, matrix: bool) {
        let (model, system) = (self.model, &mut *self.system);
        let Some(flow) = &system.flow else { return };
        let (mean, _) = flow.over(state.time, b.h);
        let element = of_last(model, mean);
        let range = last(model);
        let (q, change) = (&state.q[range.clone()], &b.change[range.clone()]);
        let middle: [f64; 12] = core::array::from_fn(|i| q[i] + 0.5 * change[i]);
        let velocity: [f64; 12] = core::array::from_fn(|i| change[i] / b.h);
        element.add_force(1.0, &middle, &velocity, &mut b.external[range]);
        if matrix {
            let [by_velocity, by_position] = element.matrices();
            let entry = |r: usize, c: usize| BETA * b.h * (by_velocity[r][c] + 0.5 * b.h * by_position[r][c]);
            add_symmetric(&mut system.step.matrix, model.nodes() - 2, entry);
        }
    }
}

/// Returns the weight per length of the last element in N/m.
fn weight_of_last(model: &Model) -> [f64; 3] {
    model.weight(&model.elements[model.elements.len() - 1]).into()
}

/// Returns what entering material brings beside the force on the length, in N: its kinetic energy and its weight at the eye.
fn entering(element: &FlowElement, weight: &[f64; 3], q: &[f64], v: &[f64]) -> f64 {
    let Extent { rate, .. } = element.extent;
    let mut sum = 0.0;
    for x in 0..3 {
        let speed = v[6 + x] - rate * q[9 + x];
        sum += element.inertia * (-rate * speed * q[9 + x] - 0.5 * speed * speed) - weight[x] * q[6 + x];
    }
    sum
}
