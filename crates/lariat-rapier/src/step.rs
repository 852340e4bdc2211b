//! One host step: predict, Rapier's step, reconcile, as many times as configured.

use crate::Error;
use crate::attachment::AttachmentHandle;
use crate::convert::{rotation, vector};
use crate::event::Event;
use crate::set::CableSet;
use ::nalgebra::UnitQuaternion;
use rapier::dynamics::{RigidBodyHandle, RigidBodyType};
use rapier::math::{Pose, Real};
use rapier::pipeline::{EventHandler, PhysicsHooks, PhysicsWorld};

/// A host step that is taken apart; see [`CableSet::begin`].
#[derive(Clone, Debug)]
pub struct HostStep {
    dt: Real,
    steps: u32,
    done: u32,
    failed: bool,
    /// Where position-based kinematic bodies come from and are to be at the end.
    targets: Vec<(RigidBodyHandle, Pose, Pose)>,
}

impl HostStep {
    /// Whether Rapier steps are left.
    pub fn is_unfinished(&self) -> bool {
        !self.failed && self.done < self.steps
    }

    /// Whether a prediction was refused: there is nothing for Rapier to step.
    pub fn is_refused(&self) -> bool {
        self.failed
    }
}

impl CableSet {
    /// One host step of `world.integration_parameters.dt`, split into [`Settings::rapier_steps`](crate::Settings).
    ///
    /// # Errors
    /// [`Error::Cable`] if a cable's step is refused, [`Error::BodyNotFinite`]; the cables are then as after the last Rapier step
    /// that could be done.
    pub fn step(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
        self.step_with_events(world, &(), &())
    }

    /// [`step`](Self::step) with Rapier's hooks and event handler.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_with_events(
        &mut self,
        world: &mut PhysicsWorld,
        hooks: &dyn PhysicsHooks,
        events: &dyn EventHandler,
    ) -> Result<(), Error> {
        let mut host = self.begin(world)?;
        let mut outcome = Ok(());
        while host.is_unfinished() {
            outcome = self.predict_next(world, &mut host);
            if outcome.is_err() {
                break;
            }
            world.step_with_events(hooks, events);
            outcome = self.reconcile(world);
            if outcome.is_err() {
                break;
            }
        }
        self.finish(world, host);
        outcome
    }

    /// Begins a host step that is taken apart, for those who step Rapier themselves: as long as
    /// [`is_unfinished`](HostStep::is_unfinished), [`predict_next`](Self::predict_next), Rapier's step, and
    /// [`reconcile`](Self::reconcile); in the end, whatever happened, [`finish`](Self::finish). Meanwhile
    /// `world.integration_parameters.dt` is that of a Rapier step.
    ///
    /// # Errors
    /// [`Error::TimeStep`].
    pub fn begin(&mut self, world: &mut PhysicsWorld) -> Result<HostStep, Error> {
        let dt = world.integration_parameters.dt;
        let moves = self.moves_on(dt)?;
        let steps = if moves { self.parts(world, f64::from(dt)) } else { 1 };
        let mut targets = Vec::new();
        if moves {
            self.events.clear();
            targets.extend(world.bodies.iter().filter_map(|(h, b)| {
                let moved = b.body_type() == RigidBodyType::KinematicPositionBased && b.next_position() != b.position();
                moved.then(|| (h, *b.position(), *b.next_position()))
            }));
            world.integration_parameters.dt = dt / steps as Real;
        }
        Ok(HostStep { dt, steps, done: 0, failed: false, targets })
    }

    /// Predicts the next Rapier step of a host step.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn predict_next(&mut self, world: &mut PhysicsWorld, host: &mut HostStep) -> Result<(), Error> {
        if !host.is_unfinished() {
            return Ok(());
        }
        if host.done > 0 {
            self.split_finer(world, host);
        }
        host.done += 1;
        if !self.moves_on(host.dt)? {
            return Ok(());
        }
        for (handle, from, to) in &host.targets {
            let Some(body) = world.bodies.get_mut(*handle) else { continue };
            let share = f64::from(host.done) / f64::from(host.steps);
            let turn = rotation(to.rotation) * rotation(from.rotation).inverse();
            let attitude = UnitQuaternion::from_scaled_axis(turn.scaled_axis() * share) * rotation(from.rotation);
            let place = vector(from.translation).lerp(&vector(to.translation), share);
            let pose = if host.done == host.steps { *to } else { crate::convert::to_pose(&place, &attitude) };
            body.set_next_kinematic_position(pose);
        }
        let outcome = self.predict_part(world, host.steps);
        host.failed |= outcome.is_err();
        outcome
    }

    /// Splits what is left of a host step finer, if a body met another since it began.
    fn split_finer(&self, world: &mut PhysicsWorld, host: &mut HostStep) {
        let most = self.settings.most_rapier_steps / host.steps;
        let finer = self.parts(world, f64::from(host.dt)).div_ceil(host.steps).min(most);
        if finer > 1 {
            (host.steps, host.done) = (host.steps * finer, host.done * finer);
            world.integration_parameters.dt = host.dt / host.steps as Real;
        }
    }

    /// Ends a host step: `world.integration_parameters.dt` is the host's again.
    pub fn finish(&mut self, world: &mut PhysicsWorld, host: HostStep) {
        world.integration_parameters.dt = host.dt;
        if host.is_unfinished() || host.failed {
            for (handle, _, to) in host.targets {
                if let Some(body) = world.bodies.get_mut(handle) {
                    body.set_next_kinematic_position(to);
                }
            }
        }
    }

    /// Whether time passes in a step of `dt` (s).
    fn moves_on(&self, dt: Real) -> Result<bool, Error> {
        let valid = dt.is_finite() && dt >= 0.0;
        if valid { Ok(dt > 0.0) } else { Err(Error::TimeStep { dt: f64::from(dt) }) }
    }

    /// Before a Rapier step of `world.integration_parameters.dt`: integrates cables and their bodies, and hands the motion over.
    /// A tolerance counts for this step. For those who own the loop; follow with Rapier's step and [`reconcile`](Self::reconcile).
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn predict(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
        self.events.clear();
        if self.moves_on(world.integration_parameters.dt)? { self.predict_part(world, 1) } else { Ok(()) }
    }

    /// After the Rapier step: settles bodies and cables.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn reconcile(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
        let h = f64::from(world.integration_parameters.dt);
        if !core::mem::take(&mut self.pending) {
            return Ok(());
        }
        let mut islands = core::mem::take(&mut self.islands);
        for island in &mut islands {
            self.reconcile_island(world, island, h);
            island.given.clear();
        }
        self.islands = islands;
        Ok(())
    }

    pub(crate) fn end_lost_attachments(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
        for i in 0..self.attachments.len() {
            let Some(a) = &self.attachments[i] else { continue };
            if world.bodies.contains(a.body) {
                continue;
            }
            let (attachment, body) = (AttachmentHandle(i as u32), a.body);
            self.detach(world, attachment)?;
            self.events.push(Event::AttachmentEnded { attachment, body });
        }
        self.memory.retain(|m| world.bodies.contains(m.handle));
        Ok(())
    }
}
