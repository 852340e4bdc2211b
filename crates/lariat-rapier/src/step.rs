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

/// Where position-based kinematic bodies are to be at the end of a host step.
type Targets = Vec<(RigidBodyHandle, Pose, Pose)>;

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
        let dt = world.integration_parameters.dt;
        if !self.moves_on(dt)? {
            world.step_with_events(hooks, events);
            return Ok(());
        }
        let steps = self.settings.rapier_steps.max(1);
        let targets: Targets = world
            .bodies
            .iter()
            .filter(|(_, b)| {
                b.body_type() == RigidBodyType::KinematicPositionBased && b.next_position() != b.position()
            })
            .map(|(h, b)| (h, *b.position(), *b.next_position()))
            .collect();
        world.integration_parameters.dt = dt / steps as Real;
        self.events.clear();
        let mut outcome = Ok(());
        for k in 1..=steps {
            for (handle, from, to) in &targets {
                let share = f64::from(k) / f64::from(steps);
                let turn = rotation(to.rotation) * rotation(from.rotation).inverse();
                let attitude = UnitQuaternion::from_scaled_axis(turn.scaled_axis() * share) * rotation(from.rotation);
                let place = vector(from.translation).lerp(&vector(to.translation), share);
                let pose = if k == steps { *to } else { crate::convert::to_pose(&place, &attitude) };
                world.bodies[*handle].set_next_kinematic_position(pose);
            }
            outcome = self.predict_part(world, steps);
            if outcome.is_err() {
                break;
            }
            world.step_with_events(hooks, events);
            outcome = self.reconcile(world);
            if outcome.is_err() {
                break;
            }
        }
        world.integration_parameters.dt = dt;
        if outcome.is_err() {
            for (handle, _, to) in targets {
                world.bodies[handle].set_next_kinematic_position(to);
            }
        }
        outcome
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
