//! [Impact](crate::contact) of the cables of an island on obstacles, on its bodies and on each
//! other.

use super::super::hold::vector;
use super::IslandStep;
use super::coupled::coupled_product;
use crate::contact::When;
use crate::element::shape::combine;
use crate::scales::contact::MAX_SOLVES;
use crate::system::CableStep;
use crate::system::StepVectors;
use crate::term::{Account, Balance};
use nalgebra::Vector3;

impl IslandStep<'_, '_> {
    /// Takes the velocity across contacts that push at the end of the step, if it has more energy
    /// than `least` (J).
    pub(super) fn land_contacts(&mut self, balance: &mut Balance, least: f64) {
        let mut energy = 0.0;
        let bodies = &self.buffers.bodies;
        for cable in self.cables.iter_mut() {
            let CableStep { equations, state, buffers: b } = cable.step_parts();
            equations.find_velocities(state, b);
            energy += equations.find_impacts(state, b, |when, i, arm| bodies[i].velocity_at(when, arm));
        }
        let cables = &*self.cables;
        let velocities = |when: When, c: usize| match when {
            When::Begin => &cables[c].snapshot.state.v,
            When::End => &cables[c].step_buffers.external,
        };
        energy += self.buffers.pairs.find_impacts(
            |c, e| cables[c].model.elements[e].section.mass_per_length,
            |when, c, e, shape| combine(velocities(when, c), e, shape),
        );
        if energy <= least {
            return;
        }
        self.solve_impacts();
        let gives = self.cables.iter().any(|cable| cable.step_buffers.contact.gives_velocity())
            || self.buffers.pairs.gives_velocity();
        for solve in 0..MAX_SOLVES {
            if !self.settle_impacts(solve == 0) {
                break;
            }
            self.solve_impacts();
        }
        let [mut taken, mut held, mut work] = [0.0; 3];
        for cable in self.cables.iter_mut() {
            let CableStep { mut equations, buffers, .. } = cable.step_parts();
            let own = equations.energy_of_impacts(buffers);
            (taken, held) = (taken + own[0], held + own[1]);
            let StepVectors { contact, landed, .. } = &*buffers;
            work += contact.work_of_impacts(|e, shape| combine(landed, e, shape));
        }
        let a = self.cables[0].step_buffers.leg.a;
        let coupled = &self.buffers.coupled;
        let bodies = &self.buffers.bodies;
        for body in bodies {
            let momentum = body.momentum_of(&body.landed);
            taken += momentum.dot(&body.carried_velocity());
            held += 0.5 * (1.0 + a) * momentum.dot(&body.landed);
        }
        held += 0.5 * (1.0 + a) * coupled_product(coupled, |i| bodies[i].landed, |i| bodies[i].landed);
        taken += coupled_product(coupled, |i| bodies[i].carried_velocity(), |i| bodies[i].landed);
        let share = share_of_impact(balance, [taken, held, work], gives);
        for cable in self.cables.iter_mut() {
            cable.step_buffers.landed.iter_mut().for_each(|w| *w *= share);
        }
        self.buffers.bodies.iter_mut().for_each(|body| body.landed *= share);
    }

    /// Solves for the velocities that impacts take.
    fn solve_impacts(&mut self) {
        self.buffers.rows.fill(0.0);
        for cable in self.cables.iter_mut() {
            let StepVectors { contact, landed, rhs, .. } = &mut cable.step_buffers;
            landed.clear();
            landed.resize(rhs.len(), 0.0);
            contact.pass_impacts(landed, &mut self.buffers.rows);
        }
        let cables = &mut *self.cables;
        self.buffers.pairs.pass_impacts(|c, e, impulse| {
            let own = &mut cables[c].step_buffers.landed[6 * e..6 * e + 12];
            own.iter_mut().zip(impulse).for_each(|(x, impulse)| *x += impulse);
        });
        for (cable, own) in self.cables.iter_mut().zip(&self.buffers.cables) {
            let StepVectors { landed, rhs, .. } = &mut cable.step_buffers;
            for hold in &own.holds {
                hold.pass(&vector(&landed[hold.at..]), &mut self.buffers.rows);
            }
            // the solution is in the place of the residual, which is read when the step is accepted
            core::mem::swap(landed, rhs);
        }
        self.solve();
        for cable in self.cables.iter_mut() {
            let StepVectors { landed, rhs, .. } = &mut cable.step_buffers;
            core::mem::swap(landed, rhs);
        }
        let rows = &self.buffers.rows;
        for (body, row) in self.buffers.bodies.iter_mut().zip(rows.chunks_exact(6)) {
            body.land(row);
        }
    }

    /// Sets the impulses of impacts; returns whether another solve sees more of them.
    fn settle_impacts(&mut self, first: bool) -> bool {
        let rows = &self.buffers.rows;
        let of_body = |i: usize, arm: &Vector3<f64>| vector(&rows[6 * i..]) + vector(&rows[6 * i + 3..]).cross(arm);
        let on_obstacles = self.cables.iter_mut().fold(false, |any, cable| {
            let StepVectors { contact, landed, .. } = &mut cable.step_buffers;
            contact.settle_impacts(|e, shape| combine(landed, e, shape), of_body, first) || any
        });
        let cables = &*self.cables;
        let landed = |c: usize, e: usize, shape: &[f64; 4]| combine(&cables[c].step_buffers.landed, e, shape);
        self.buffers.pairs.settle_impacts(landed, first) || on_obstacles
    }
}

/// Returns the share of an impact that makes no energy ([`impact`](crate::contact)) but the work of
/// obstacles and what contacts lost in the step, and adds it to the balance: `[P, E, W]` are its
/// terms. One that `gives` velocity may also take back what the step lost numerically.
fn share_of_impact(balance: &mut Balance, [taken, held, work]: [f64; 3], gives: bool) -> f64 {
    let lost = balance.of(Account::Contacts).loss + if gives { balance.numerical } else { 0.0 };
    let (half, lost) = (0.5 * (taken + work), (lost - balance.residual.max(0.0)).max(0.0));
    let most = half + (half * half + held * lost).sqrt();
    let share = (most / held).clamp(0.0, 1.0);
    if share > 0.0 {
        let entry = balance.to(Account::Contacts);
        entry.loss += share * (taken + work) - share * share * held;
        entry.work += share * work;
        if gives && entry.loss < 0.0 {
            let taken_back = core::mem::take(&mut entry.loss);
            balance.numerical += taken_back;
        }
        share
    } else {
        // also of what is no number
        0.0
    }
}
