//! Cables as a term of a step: elements, effects, loads and supports, and what pins hold of them.
//! Equations: `system/discrete_gradient.rs`, [`holds`](super::holds).

use super::super::pin_accounts::PinAccounts;
use super::{CableBuffers, IslandStep, StepBuffers};
use crate::effect::EffectWork;
use crate::integrate::discrete_gradient::sum_of_forces;
use crate::island::hold::vector;
use crate::state::State;
use crate::system::{CableStep, StepVectors, System, dot, project_vector};
use crate::term::{Account, Balance, StepStart, StepTerm};

/// The cables.
pub(super) struct Cables;

impl StepTerm<IslandStep<'_, '_>> for Cables {
    fn name(names: &mut Vec<&'static str>) {
        names.push("cables");
    }

    fn begin(island: &mut IslandStep<'_, '_>, step: &StepStart) {
        for cable in island.cables.iter_mut() {
            let CableStep { equations, state, buffers } = cable.step_parts();
            buffers.recall(state, step.h, step.leg);
            buffers.divided = step.divided;
            equations.prescribe_change(state, buffers);
        }
    }

    fn balance(island: &mut IslandStep<'_, '_>, total: &mut Balance) {
        let StepBuffers { cables: own, rows, .. } = &mut *island.buffers;
        for (cable, own) in island.cables.iter_mut().zip(own) {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            let mut work = EffectWork::default();
            total.add(&equations.step_balance(state, buffers, &mut work));
            equations.system.meter.work_of_step = work;
            own.pass_impulses(&buffers.rhs, rows);
            buffers.contact.pass_impulses(false, rows);
            for hold in &own.holds {
                total.residual += hold.residual(buffers.h);
                total.to(Account::Supports).aside += hold.work(buffers.h);
                if !hold.slope {
                    total.impulse += hold.impulse.norm();
                }
                buffers.rhs[hold.at..hold.at + 3].fill(0.0);
            }
            project_vector(equations.model, &mut buffers.rhs);
            total.residual -= dot(&buffers.rhs, &buffers.change) / buffers.h;
            total.imbalance += sum_of_forces(&buffers.rhs);
            // the free direction of a slope, for another iteration with the same factors
            for hold in own.holds.iter().filter(|hold| hold.slope) {
                buffers.rhs[hold.at..hold.at + 3].copy_from_slice(hold.impulse.as_slice());
            }
        }
    }

    fn accept(island: &mut IslandStep<'_, '_>) {
        let IslandStep { cables, accounts, buffers: StepBuffers { cables: own, bodies, .. }, .. } = island;
        for (c, (cable, own)) in cables.iter_mut().zip(own).enumerate() {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            if accounts.momentum.holds(c) {
                own.give_momentum(c, equations.system, state, buffers, accounts);
            }
            for hold in &own.holds {
                let action = hold.action(&bodies[hold.body], buffers.h);
                accounts.pins[hold.pin].add_mean(buffers.h, hold.slope, action);
            }
            equations.accept_step(state, buffers);
        }
    }
}

impl CableBuffers {
    /// Reads the impulses of the holds from the rows of the cable, and adds them to the rows of the
    /// bodies.
    pub(super) fn pass_impulses(&mut self, rhs: &[f64], rows: &mut [f64]) {
        for hold in &mut self.holds {
            hold.impulse = vector(&rhs[hold.at..]);
            hold.pass(&hold.impulse, rows);
        }
    }

    /// Gives the momentum that the step leaves beside the reactions to the pins.
    fn give_momentum(&self, c: usize, system: &System, state: &State, b: &mut StepVectors, accounts: &mut PinAccounts) {
        let StepVectors { rhs, external, product, velocity_change, taken, landed, change, .. } = b;
        let taken_at = |i: usize| taken.get(i).unwrap_or(&0.0) + landed.get(i).unwrap_or(&0.0);
        external.iter_mut().enumerate().for_each(|(i, w)| *w = taken_at(i));
        system.mass.multiply(system.level, external, product);
        // the residual of free rows, and reactions of slopes
        rhs.iter_mut().zip(&*product).for_each(|(f, taken)| *f += taken);
        for i in 0..external.len() {
            external[i] = state.v[i] + 0.5 * (velocity_change[i] - taken_at(i));
        }
        system.mass.multiply(system.level, external, product);
        let held = self.holds.iter().filter(|hold| !hold.slope).map(|hold| (hold.at, hold.impulse));
        accounts.momentum.add_step(c, rhs, held, [&state.q, change, product]);
    }
}
