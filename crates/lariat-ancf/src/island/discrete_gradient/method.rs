//! An island as the [discrete gradient](crate::integrate::discrete_gradient) sees it.

use super::body::BodyStep;
use super::{IslandStep, rescale};
use crate::error::StepFailure;
use crate::integrate::discrete_gradient::{Balance, Closing, DiscreteGradientSystem, Event};
use crate::system::CableStep;

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
            equations.note_load(state.time, &state.q, &state.v);
        }
        self.cables[0].step_buffers.after = None;
    }

    fn predict(&mut self, h: f64, closing: Closing) {
        self.note_angular_momentum();
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            equations.begin_laws(state.time, h);
            buffers.recall(state, h);
            equations.prescribe_change(state, buffers);
        }
        self.begin_wheels(h);
        self.buffers.bodies.iter_mut().for_each(|body| body.predict(h));
        self.begin_drums(h);
        self.follow();
        for cable in self.cables.iter_mut() {
            let CableStep { equations, state, buffers } = cable.step_parts();
            equations.find_contacts(state, buffers, (&self.buffers.paths, closing.obstacles));
        }
        self.find_pairs(h, closing.cables);
    }

    fn iterate(&mut self, fresh: bool, share: f64) -> Result<Balance, StepFailure> {
        self.cables.iter_mut().for_each(|cable| cable.diagnostics_mut().newton_iterations += 1);
        if fresh {
            self.linearise_pairs();
            self.linearise()?;
            self.factor_bodies(self.cables[0].step_buffers.h)?;
            self.linearise_laws();
        }
        self.add_increment(share)?;
        self.follow();
        Ok(self.balance())
    }

    fn rescale(&mut self, balance: &mut Balance, largest_share: f64) -> bool {
        rescale::rescale(self, balance, largest_share)
    }

    fn renew_friction(&mut self, least: f64) -> bool {
        let missed: f64 = self.cables.iter_mut().map(|cable| cable.step_buffers.contact.find_lag()).sum();
        let mut any = false;
        for cable in self.cables.iter_mut() {
            let contact = &mut cable.step_buffers.contact;
            contact.lags &= missed > least;
            contact.renew_friction();
            any |= contact.lags;
        }
        any
    }

    fn add_missed(&mut self) -> bool {
        // each cable, although one will do
        self.cables.iter_mut().fold(false, |any, cable| {
            let CableStep { equations, state, buffers } = cable.step_parts();
            equations.add_missed_contacts(state, buffers) || any
        })
    }

    fn crosses(&mut self) -> bool {
        let passes = self.cables.iter_mut().fold(false, |any, cable| {
            let CableStep { equations, state, buffers } = cable.step_parts();
            equations.passes_obstacles(state, buffers) || any
        });
        self.do_pairs_cross() || passes
    }

    fn land(&mut self, balance: &mut Balance, least: f64) {
        self.land_contacts(balance, least);
    }

    fn accept(&mut self, balance: &Balance) {
        self.accept_wheels();
        for (c, (cable, own)) in self.cables.iter_mut().zip(&self.buffers.cables).enumerate() {
            let CableStep { mut equations, state, buffers } = cable.step_parts();
            if self.accounts.momentum.holds(c) {
                own.give_momentum(c, equations.system, state, buffers, self.accounts);
            }
            for hold in &own.holds {
                let action = hold.action(&self.buffers.bodies[hold.body], buffers.h);
                self.accounts.pins[hold.pin].add_mean(buffers.h, hold.slope, action);
            }
            equations.accept_step(state, buffers);
        }
        self.remember_pairs();
        self.buffers.bodies.iter_mut().for_each(BodyStep::accept);
        let balance = self.restore_angular_momentum(balance);
        // the law is that of the whole: the first cable keeps it
        self.cables[0].system.meter.law.add(&balance);
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, state, .. } = cable.step_parts();
            equations.note_load(state.time, &state.q, &state.v);
        }
    }

    fn count(&mut self, event: Event) {
        self.count_event(event);
    }

    fn splits(&self) -> u64 {
        self.cables[0].diagnostics().split_steps
    }
}
