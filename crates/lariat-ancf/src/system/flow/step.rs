//! Elements at eyes over a step of the [discrete gradient](crate::integrate::discrete_gradient): see [`flow`](super).

use crate::integrate::State;
use crate::integrate::discrete_gradient::{BETA, Buffers};
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
        for flow in &system.flows.list {
            let (mean, _) = flow.over(state.time, b.h);
            let element = flow.with(model, mean);
            let (q, change) = (flow.side.gather(&state.q), flow.side.gather(&b.change));
            let middle = core::array::from_fn(|i| q[i] + 0.5 * change[i]);
            let mut force = [0.0; 12];
            element.add_force(1.0, &middle, &change.map(|x| x / b.h), &mut force);
            flow.side.add(&force, &mut b.external);
            if matrix {
                let [by_velocity, by_position] = element.matrices();
                let entry = |r: usize, c: usize| BETA * b.h * (by_velocity[r][c] + 0.5 * b.h * by_position[r][c]);
                flow.add_symmetric(model, &mut system.step.matrix, entry);
            }
        }
    }
}
