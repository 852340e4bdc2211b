//! One host step of an island by the discrete gradient.
//!
//! The velocity of a pinned node follows its own one-leg formula, so it deviates from that of its
//! body, by the second order of the step. The deviation at the end of a host step is known from the
//! memory of cable and body; only what differs from it in the next one, because an engine or a user
//! changed the body's velocity, is shared by an impact.

use super::{IslandStep, StepBuffers};
use crate::cable::Cable;
use crate::error::{Error, StepFailure};
use crate::integrate::{ErrorNorm, IntegratorRef, WorkLimit, discrete_gradient};
use crate::island::body::{BodyMemory, RigidBody};
use crate::island::dynamics::{IslandDynamics, Vectors};
use crate::island::equations::{IslandEquations, Matrices};
use crate::island::hold::vector;
use crate::island::layout::Layout;
use crate::island::pin_accounts::PinAccounts;
use crate::state::State;
use nalgebra::Vector3;

/// The parts of an island that a host step needs.
pub(in crate::island) struct HostStep<'a, 'b> {
    pub cables: &'a mut [&'b mut Cable],
    pub bodies: &'a mut [RigidBody],
    pub layout: &'a Layout,
    pub matrices: &'a mut Matrices,
    pub accounts: &'a mut PinAccounts,
    pub vectors: &'a mut Vectors,
    pub buffers: &'a mut StepBuffers,
    /// The coordinates of all, gathered.
    pub state: &'a mut State,
}

impl HostStep<'_, '_> {
    /// Advances by `dt` (s). Cables and bodies are as before if it fails.
    pub fn run(mut self, integrator: IntegratorRef<'_>, dt: f64) -> Result<(), Error> {
        self.buffers.begin(self.layout);
        for (own, cable) in self.buffers.cables.iter_mut().zip(self.cables.iter()) {
            own.start.copy_from(&cable.snapshot.state);
        }
        self.cables.iter_mut().for_each(|cable| cable.refresh_memory());
        let time = self.cables[0].time();
        if let Err(failure) = self.match_velocities(dt) {
            self.restore();
            return Err(self.cables[0].step_failed(time, 0.0, failure));
        }
        let HostStep { cables, layout, accounts, buffers, .. } = &mut self;
        let mut island = IslandStep { cables, layout, accounts, buffers };
        let (counts, outcome) = discrete_gradient::advance(&mut island, integrator, dt);
        for cable in self.cables.iter_mut() {
            let diagnostics = cable.diagnostics_mut();
            diagnostics.steps += counts.steps;
            diagnostics.rejected_steps += counts.rejected;
            diagnostics.unresolved_steps += counts.unresolved;
            diagnostics.cut_steps += u64::from(integrator.limit.is_some_and(WorkLimit::has_reduced));
        }
        if let Err(failed) = outcome {
            let within = self.cables.iter().try_for_each(|cable| cable.check_reach_of_reels(dt));
            self.restore();
            within?;
            return Err(self.cables[0].step_failed(failed.time, failed.step, failed.failure));
        }
        self.finish();
        Ok(())
    }

    fn restore(&mut self) {
        for (cable, own) in self.cables.iter_mut().zip(&mut self.buffers.cables) {
            core::mem::swap(&mut cable.snapshot.state, &mut own.start);
        }
    }

    fn finish(&mut self) {
        for (cable, own) in self.cables.iter_mut().zip(&self.buffers.cables) {
            let Cable { snapshot, system, .. } = &mut **cable;
            snapshot.add_work_of_step(system, &own.start.q);
            cable.diagnostics_mut().host_steps += 1;
        }
        for (body, own) in self.bodies.iter_mut().zip(&self.buffers.bodies) {
            own.write(body);
            body.memory = Some(BodyMemory::of_differences(body, own.differences()));
        }
        self.accounts.end(self.cables, self.layout);
    }

    /// Gives pinned nodes the velocities of their bodies, and the deviations that they had from
    /// them, for a step of `dt` (s).
    fn match_velocities(&mut self, dt: f64) -> Result<(), StepFailure> {
        let HostStep { cables, bodies, layout, matrices, accounts, vectors, buffers, state } = self;
        let deviations: &mut Vec<[Vector3<f64>; 2]> = &mut buffers.deviations;
        deviations.clear();
        deviations.extend((0..layout.pins.len()).map(|pin| deviation(cables, bodies, layout, pin, dt)));
        let add = |deviations: &[[Vector3<f64>; 2]], factor: f64, v: &mut [f64]| {
            for (pin, [position, slope]) in deviations.iter().enumerate() {
                let at = layout.pin_at(pin);
                for x in 0..3 {
                    v[at + x] += factor * position[x];
                    v[at + 3 + x] += factor * slope[x];
                }
            }
        };
        add(deviations, -1.0, &mut state.v);
        let equations = IslandEquations { cables, layout, matrices };
        IslandDynamics { equations, accounts, norm: ErrorNorm::Every, vectors }.match_velocities(state)?;
        add(deviations, 1.0, &mut state.v);
        for (cable, part) in cables.iter_mut().zip(&layout.parts) {
            let Cable { model, snapshot, .. } = &mut **cable;
            let own = &mut snapshot.state;
            let (q, v) = (&state.q[part.range()], &state.v[part.range()]);
            for node in 0..model.nodes() {
                let range = 6 * node..6 * node + 6;
                // prescribed coordinates have their own memory
                match model.support(node) {
                    None => own.v[range.clone()].copy_from_slice(&v[range]),
                    Some(support) if support.attached => {
                        own.q[range.clone()].copy_from_slice(&q[range.clone()]);
                        own.v[range.clone()].copy_from_slice(&v[range]);
                    }
                    Some(_) => {}
                }
            }
        }
        for (i, body) in buffers.bodies.iter_mut().enumerate() {
            let at = layout.body_at(i);
            body.set_velocity(&vector(&state.v[at..]), &vector(&state.v[at + 3..]));
        }
        Ok(())
    }
}

/// Returns the velocity of a pinned node, and of its slope if that is clamped, beside those that
/// its body had at the end of the last step; zero if that is not known. Before a shorter step, of
/// `dt` (s), it is what it would be of that, by the square of its length: else the node would swing
/// about its body by what a long step left.
fn deviation(cables: &[&mut Cable], bodies: &[RigidBody], layout: &Layout, pin: usize, dt: f64) -> [Vector3<f64>; 2] {
    let pin = &layout.pins[pin];
    let state = &cables[pin.cable].snapshot.state;
    let Some(last) = bodies[pin.body].memory.as_ref().and_then(|memory| memory.differences.as_ref()) else {
        return [Vector3::zeros(); 2];
    };
    if state.memory.differences.is_empty() {
        return [Vector3::zeros(); 2];
    }
    let at = 6 * pin.node;
    let [velocity, spin] = last.velocity;
    let position = vector(&state.v[at..]) - velocity - spin.cross(&(last.rotation * pin.anchor));
    let slope = pin.direction.map_or_else(Vector3::zeros, |direction| {
        let d = last.rotation * direction;
        let (t, rate) = (vector(&state.q[at + 3..]), vector(&state.v[at + 3..]));
        rate - d * d.dot(&rate) - spin.cross(&d) * d.dot(&t)
    });
    let share = (dt / last.step).min(1.0).powi(2);
    [position * share, slope * share]
}
