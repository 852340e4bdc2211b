//! Elements at eyes over a step of the [discrete gradient](crate::integrate::discrete_gradient): see [`flow`](super).

use super::{Flow, Flows, Source};
use crate::element::flow::{FlowElement, Table, add_product};
use crate::element::mass;
use crate::integrate::State;
use crate::integrate::discrete_gradient::{BETA, Buffers};
use crate::model::Model;
use crate::system::Equations;

/// True iterates of an eye: change, linearised, change of the step before.
type Iterates = [[f64; 3]; 3];

impl Equations<'_> {
    /// Sets the lengths of a step of the discrete gradient, and moves the eyes in its iterates to where they are on elements of the
    /// lengths at the beginning; returns the true iterates by flow.
    pub fn begin_flow_step(&mut self, state: &State, b: &mut Buffers) -> [Iterates; 2] {
        let mut saved = [Iterates::default(); 2];
        for (k, saved) in (0..self.system.flows.list.len()).zip(&mut saved) {
            let flow = self.system.flows.list[k];
            let (mean, [l0, l1]) = flow.over(state.time, b.h);
            self.system.set_each_length(self.model, k, [l0, mean.length, 0.5 * (1.0 / l0 + 1.0 / l1)]);
            if flow.stands() {
                continue;
            }
            let [far, eye] = flow.side.nodes(self.model.nodes()).map(|node| 6 * node);
            let lists = [&mut b.change, &mut b.linearised, &mut b.change_before];
            for (i, (list, saved)) in lists.into_iter().zip(saved).enumerate().filter(|(_, (list, _))| !list.is_empty())
            {
                // the other end of the step: its end, or the beginning of the one before
                let (sign, other) = if i < 2 { (1.0, l1) } else { (-1.0, flow.length_before) };
                for x in 0..3 {
                    saved[x] = list[eye + x];
                    let at_far = state.q[far + x] + sign * list[far + x];
                    let at_eye = state.q[eye + x] + sign * list[eye + x];
                    list[eye + x] = sign * (at_far + l0 / other * (at_eye - at_far) - state.q[eye + x]);
                }
            }
        }
        saved
    }

    /// Ends what [`begin_flow_step`](Self::begin_flow_step) began, and scales the forces of the elements on the eyes in the residual.
    pub fn end_flow_step(&mut self, state: &State, b: &mut Buffers, saved: [Iterates; 2]) {
        for (flow, saved) in self.system.flows.list.iter_mut().zip(saved) {
            let (_, [l0, l1]) = flow.over(state.time, b.h);
            let share = 0.5 * (1.0 + l0 / l1);
            let [far, eye] = flow.side.nodes(self.model.nodes()).map(|node| 6 * node);
            if flow.stands() {
                flow.eye_force = core::array::from_fn(|x| b.rhs[eye + x] / b.h);
                continue;
            }
            for (list, saved) in [&mut b.change, &mut b.linearised, &mut b.change_before].into_iter().zip(saved) {
                if !list.is_empty() {
                    list[eye..eye + 3].copy_from_slice(&saved);
                }
            }
            for x in 0..3 {
                let force = b.rhs[eye + x];
                flow.eye_force[x] = force / b.h;
                b.rhs[eye + x] = share * force;
                b.rhs[far + x] += (1.0 - share) * force;
            }
        }
    }

    /// Adds the forces of the flows over a step of the discrete gradient to those without potential, and their derivatives to the
    /// matrix if it is asked for.
    pub fn add_flows_over_step(&mut self, state: &State, b: &mut Buffers, matrix: bool) {
        let (model, system) = (self.model, &mut *self.system);
        for flow in system.flows.list.iter().filter(|flow| !flow.stands()) {
            let impulse = flow.impulse(model, &StepMotion::of(flow, state, b), false);
            flow.side.add(&impulse.map(|x| x / b.h), &mut b.external);
            if matrix {
                let table = flow.impulse_table(model, state.time, b.h);
                flow.add_symmetric(model, &mut system.step.matrix, |r, c| table[r][c]);
            }
        }
    }
}

impl Flows {
    /// Moves the eyes in the change of coordinates over the last step to where they would be on elements of the present lengths.
    pub fn shift_eyes_before(&self, q: &[f64], change: &mut [f64]) {
        for flow in &self.list {
            let [far, eye] = flow.side.nodes(q.len() / 6).map(|node| 6 * node);
            let ratio = flow.extent.length / flow.length_before;
            for x in 0..3 {
                let [at_far, at_eye] = [far, eye].map(|node| q[node + x] - change[node + x]);
                change[eye + x] = q[eye + x] - at_far - ratio * (at_eye - at_far);
            }
        }
    }
}

/// Coordinates and velocities of the element at an eye at both ends of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepMotion {
    pub time: f64,
    pub h: f64,
    pub q: [[f64; 12]; 2],
    pub v: [[f64; 12]; 2],
}

impl StepMotion {
    /// Returns that of the present iterate.
    pub fn of(flow: &Flow, state: &State, b: &Buffers) -> Self {
        let of = |x: &[f64]| flow.side.gather(x);
        let (q, v, change, velocity_change) = (of(&state.q), of(&state.v), of(&b.change), of(&b.velocity_change));
        let sum = |x: [f64; 12], d: [f64; 12]| core::array::from_fn(|i| x[i] + d[i]);
        StepMotion { time: state.time, h: b.h, q: [q, sum(q, change)], v: [v, sum(v, velocity_change)] }
    }
}

impl Flow {
    /// Returns the impulse of the inertia of the element over a step, `-D p + h l' (G^T v^ + l' K q_m)` and the momentum of the material that
    /// enters at the eye; that of riding stock is a part of p, and what enters comes from it. Without `all` it is less the part
    /// `-M_m D v`, which the mass matrix has.
    pub(super) fn impulse(&self, model: &Model, motion: &StepMotion, all: bool) -> [f64; 12] {
        let StepMotion { time, h, q, v } = *motion;
        let (mean, lengths) = self.over(time, h);
        let mut out = [0.0; 12];
        let of_mean = self.with(model, mean);
        let inertia = of_mean.inertia;
        for (end, sign) in [(0, 1.0), (1, -1.0)] {
            let mut at = FlowElement { inertia, extent: self.at(time + h * end as f64) };
            if let (0, Some(rate)) = (end, self.left_rate) {
                at.extent.rate = rate;
            }
            let mut table = mass::consistent(inertia, lengths[end]);
            let mut point = self.stock(lengths[end]) * inertia;
            if !all {
                let of_mean = mass::consistent(inertia, mean.length);
                (0..16).for_each(|i| table[i / 4][i % 4] -= of_mean[i / 4][i % 4]);
                point -= self.stock(mean.length) * inertia;
            }
            table[2][2] += point;
            add_product(&table, sign, &v[end], &mut out);
            add_product(&at.momentum_matrix(), sign, &q[end], &mut out);
        }
        let middle = core::array::from_fn(|i| 0.5 * (q[0][i] + q[1][i]));
        let velocity = core::array::from_fn(|i| (q[1][i] - q[0][i]) / h);
        let [by_velocity, by_position] = of_mean.gradient_matrices();
        add_product(&by_velocity, h, &velocity, &mut out);
        add_product(&by_position, h, &middle, &mut out);
        if self.source == Source::Outside {
            for x in 6..9 {
                out[x] += inertia * h * mean.rate * (velocity[x] - mean.rate * middle[3 + x]);
            }
        }
        out
    }

    /// Returns the negative derivatives of the [impulse](Self::impulse), without the part of the mass matrix, by the changes of velocity. With
    /// riding stock or a sheave it is changed to a table whose symmetric part has the same sums over the rows of positions: one linear solve
    /// then keeps the momentum.
    fn impulse_table(&self, model: &Model, time: f64, h: f64) -> Table {
        let (mean, [_, last]) = self.over(time, h);
        let [end, middle] = [self.at(time + h), mean].map(|extent| self.with(model, extent));
        let inertia = middle.inertia;
        let (mut table, of_mean) = (mass::consistent(inertia, last), mass::consistent(inertia, mean.length));
        let momentum = end.momentum_matrix();
        let [by_velocity, by_position] = middle.gradient_matrices();
        for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
            table[a][b] +=
                BETA * h * (momentum[a][b] - by_velocity[a][b] - 0.5 * h * by_position[a][b]) - of_mean[a][b];
        }
        let entering = inertia * h * mean.rate;
        if self.source == Source::Outside {
            table[2][2] -= entering * BETA;
            table[2][3] += entering * 0.5 * BETA * h * mean.rate;
            return table;
        }
        // the elements put their own mass into the matrix, not that of the stock
        table[2][2] += inertia * self.stock(last);
        let symmetric: Table = core::array::from_fn(|a| core::array::from_fn(|b| 0.5 * (table[a][b] + table[b][a])));
        let missed: [f64; 4] = core::array::from_fn(|b| table[0][b] + table[2][b] - symmetric[0][b] - symmetric[2][b]);
        let mut table = symmetric;
        table[0][0] += missed[0];
        table[2][2] += missed[2];
        for b in [1, 3] {
            table[2][b] += missed[b];
            table[b][2] += missed[b];
        }
        table
    }
}
