//! An island as the [discrete gradient](crate::integrate::discrete_gradient) sees it.

use super::terms::Terms;
use super::{IslandStep, rescale};
use crate::error::StepFailure;
use crate::integrate::discrete_gradient::{DiscreteGradientSystem, Event, Pace};
use crate::system::CableStep;
use crate::term::{Balance, Settled, Stage, StepStart, StepTerm, Verdict};

impl IslandStep<'_, '_> {
    /// Takes from the work of damping what a step that is not solved hides of it (J): of each cable
    /// the same share.
    fn take_from_damping(&mut self, hidden: f64) {
        let works = || self.cables.iter().map(|cable| cable.system.meter.work_of_step.damping.min(0.0));
        let all = -works().sum::<f64>();
        if hidden > 0.0 && all > 0.0 {
            let left = 1.0 - (hidden / all).min(1.0);
            self.cables.iter_mut().for_each(|cable| cable.system.meter.work_of_step.damping *= left);
        }
    }
}

impl DiscreteGradientSystem for IslandStep<'_, '_> {
    fn time(&self) -> f64 {
        self.cables[0].time()
    }

    fn set_time(&mut self, time: f64) {
        self.cables.iter_mut().for_each(|cable| cable.snapshot.state.time = time);
    }

    fn begin(&mut self) {
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, state, .. } = cable.step_parts();
            equations.begin_host_step(state);
            equations.note_load(state.time, [&state.q, &state.v], &state.memory.torsion);
        }
        self.cables[0].step_buffers.after = None;
        Terms::begin_host_step(self);
    }

    fn predict(&mut self, step: &StepStart) {
        Terms::begin(self, step);
    }

    fn iterate(&mut self, fresh: bool, share: f64) -> Result<Balance, StepFailure> {
        self.cables.iter_mut().for_each(|cable| cable.diagnostics_mut().newton_iterations += 1);
        if fresh {
            self.linearise_pairs();
            self.linearise()?;
            let first = &self.cables[0].step_buffers;
            let step = (first.h, first.leg);
            self.factor_bodies(step)?;
            self.border_torsion(step)?;
            self.linearise_laws();
        }
        self.add_increment(share)?;
        self.follow();
        self.buffers.rows.fill(0.0);
        Terms::evaluate(self);
        let mut balance = Balance::default();
        Terms::balance(self, &mut balance);
        Ok(balance)
    }

    fn verdict(&self, balance: &Balance, stage: Stage) -> Verdict {
        Terms::verdict(self, balance, stage)
    }

    fn settle(&mut self, balance: &Balance) -> Settled {
        Terms::settle(self, balance)
    }

    fn inspect(&mut self, balance: &Balance) -> Verdict {
        Terms::inspect(self, balance)
    }

    fn rescale(&mut self, balance: &mut Balance, largest_share: f64) -> bool {
        rescale::rescale(self, balance, largest_share)
    }

    fn error(&mut self) -> f64 {
        self.error_of_step()
    }

    fn estimate(&mut self) -> Option<f64> {
        self.estimate_of_step()
    }

    fn needs_short_steps(&self) -> bool {
        self.is_disturbed()
    }

    fn size(&self) -> f64 {
        self.size_of_shortest()
    }

    fn pace(&self) -> Pace {
        self.cables.iter().fold(Pace::default(), |pace, cable| pace.and(&cable.snapshot.state.memory.pace))
    }

    fn set_pace(&mut self, pace: Pace) {
        self.cables.iter_mut().for_each(|cable| cable.snapshot.state.memory.pace = pace);
    }

    fn proposal(&self) -> f64 {
        let proposals = self.cables.iter().map(|cable| cable.snapshot.state.memory.step);
        proposals.fold(f64::INFINITY, f64::min)
    }

    fn propose(&mut self, step: f64) {
        self.cables.iter_mut().for_each(|cable| cable.snapshot.state.memory.step = step);
    }

    fn finish(&mut self, balance: &mut Balance) -> Verdict {
        Terms::finish(self, balance);
        Terms::examine(self, balance)
    }

    fn accept(&mut self, balance: Balance) {
        self.buffers.unsteady = self.has_impact();
        let shortened = self.energy_shortened();
        self.take_from_damping(balance.hidden[1]);
        Terms::accept(self);
        let balance = self.restore_momenta(balance);
        // the law is that of the whole: the first cable keeps it
        let law = &mut self.cables[0].system.meter.law;
        law.add(&balance);
        law.shortened += shortened;
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, state, .. } = cable.step_parts();
            equations.note_load(state.time, [&state.q, &state.v], &state.memory.torsion);
        }
    }

    fn count(&mut self, event: Event) {
        for (c, cable) in self.cables.iter_mut().enumerate() {
            let diagnostics = cable.diagnostics_mut();
            match event {
                Event::Iterated(reason) => diagnostics.iterations_for.count(reason),
                // the law of the whole is that of the first cable, and so is what is told of it
                Event::Unsolved => diagnostics.unsolved_steps += u64::from(c == 0),
                Event::Rescaled => diagnostics.rescaled_steps += 1,
                Event::Divided(reason) => {
                    diagnostics.split_steps += 1;
                    diagnostics.divisions_for.count(reason);
                }
            }
        }
    }

    fn splits(&self) -> u64 {
        self.cables[0].diagnostics().split_steps
    }
}
