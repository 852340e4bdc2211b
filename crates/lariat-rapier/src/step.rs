//! One host step: predict, Rapier's step, reconcile, as many times as configured.

use crate::attachment::{AttachmentHandle, Event};
use crate::body::{self, BodyMemory, is_integrated};
use crate::convert::{rotation, vector};
use crate::islands::IslandStep;
use crate::set::CableSet;
use crate::{Error, hand_over, impedance};
use ::nalgebra::{UnitQuaternion, Vector3};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Cable, Integrator, Motion, StepControl};
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
        outcome
    }

    /// Before a Rapier step of `world.integration_parameters.dt`: integrates cables and their bodies, and hands the motion over.
    /// For those who own the loop; follow with Rapier's step and [`reconcile`](Self::reconcile).
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn predict(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
        self.predict_part(world, 1)
    }

    /// One of `parts` equal parts of a host step.
    fn predict_part(&mut self, world: &mut PhysicsWorld, parts: u32) -> Result<(), Error> {
        let h = f64::from(world.integration_parameters.dt);
        self.end_lost_attachments(world)?;
        self.find_islands(world);
        self.move_ends(world, h)?;
        let mut islands = core::mem::take(&mut self.islands);
        let outcome = islands.iter_mut().try_for_each(|island| self.predict_island(world, island, h, parts));
        self.islands = islands;
        outcome
    }

    /// After the Rapier step: settles bodies and cables.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn reconcile(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
        let h = f64::from(world.integration_parameters.dt);
        let mut islands = core::mem::take(&mut self.islands);
        for island in &mut islands {
            self.reconcile_island(world, island, h);
        }
        self.islands = islands;
        Ok(())
    }

    fn end_lost_attachments(&mut self, world: &mut PhysicsWorld) -> Result<(), Error> {
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

    /// Ends on bodies that are not integrated follow them; the others are attached.
    fn move_ends(&mut self, world: &PhysicsWorld, h: f64) -> Result<(), Error> {
        for a in self.attachments.iter().flatten() {
            let cable = self.cables[a.cable.0 as usize].as_mut().expect("attachments of removed cables are removed");
            let support = cable.support(At::Node(a.node))?;
            if is_integrated(world, a.body) {
                if !support.attached {
                    cable.attach(At::Node(a.node))?;
                }
                continue;
            }
            let body = &world.bodies[a.body];
            let start = vector(body.translation()) + rotation(*body.rotation()) * a.anchor;
            let (place, attitude) = match body.body_type() {
                RigidBodyType::KinematicPositionBased => {
                    (vector(body.next_position().translation), rotation(body.next_position().rotation))
                }
                RigidBodyType::KinematicVelocityBased => {
                    let next = body.predict_position_using_velocity(h as Real);
                    (vector(next.translation), rotation(next.rotation))
                }
                _ => (vector(body.translation()), rotation(*body.rotation())),
            };
            let end = place + attitude * a.anchor;
            let from = cable.node_position(a.node);
            let time = cable.time();
            let velocity = (end - start) / h;
            cable.set_motion(a.node, Motion::hermite(time, h, (from, velocity), (end, velocity)))?;
        }
        Ok(())
    }

    fn predict_island(
        &mut self,
        world: &mut PhysicsWorld,
        island: &mut IslandStep,
        h: f64,
        parts: u32,
    ) -> Result<(), Error> {
        let integrator = part_of(self.island_integrator(&island.cables), parts);
        let mut cables = pick(&mut self.cables, &island.cables);
        let time = cables[0].time();
        island.bodies.clear();
        for &handle in &island.handles {
            if !self.memory.iter().any(|m| m.handle == handle) {
                self.memory.push(BodyMemory::new(handle));
            }
            let memory = self.memory.iter().find(|m| m.handle == handle).expect("just made");
            island.bodies.push(body::read(world, handle, memory, time)?);
        }
        if island.handles.is_empty() {
            for cable in &mut cables {
                cable.step(h)?;
            }
            return Ok(());
        }
        let start = island.bodies.clone();
        self.solver.step(&mut cables, &mut island.bodies, &island.pins, integrator, h)?;
        island.given.clear();
        for (i, &handle) in island.handles.iter().enumerate() {
            let memory = self.memory.iter().find(|m| m.handle == handle).expect("made above");
            world.islands.wake_up(&mut world.bodies, handle, false);
            island.given.push(hand_over::give(world, handle, &island.bodies[i], memory, h));
        }
        self.set_motors(world, island, &start, h)
    }

    fn set_motors(
        &mut self,
        world: &mut PhysicsWorld,
        island: &mut IslandStep,
        start: &[RigidBody],
        h: f64,
    ) -> Result<(), Error> {
        let near: Vec<bool> = island.handles.iter().map(|&b| impedance::may_meet_something(world, b)).collect();
        island.motors.clear();
        island.motors.resize(island.pins.len(), false);
        if near.iter().any(|&n| n) {
            let mut cables = pick(&mut self.cables, &island.cables);
            island.impedances.resize_with(cables.len(), Default::default);
            for (c, cable) in cables.iter_mut().enumerate() {
                let nodes: Vec<usize> = island.pins.iter().filter(|p| p.cable == c).map(|p| p.node).collect();
                island.impedances[c].update(cable, &nodes, h)?;
            }
        }
        for (b, near) in near.into_iter().enumerate() {
            let driven = if near { impedance::driving_point(island, start, b) } else { Vec::new() };
            for (pin, d) in driven {
                let anchor = island.pins[pin].anchor;
                let target = (island.bodies[b].point(&anchor) - start[b].point(&anchor)) / h;
                let attachment = self.attachments[island.attachments[pin]].as_mut().expect("pins have attachments");
                impedance::drive(world, attachment, &d, &target, h);
                island.motors[pin] = true;
            }
        }
        for (pin, driven) in island.motors.iter().enumerate() {
            if !driven && let Some(attachment) = &self.attachments[island.attachments[pin]] {
                impedance::idle(world, attachment);
            }
        }
        Ok(())
    }

    fn reconcile_island(&mut self, world: &mut PhysicsWorld, island: &mut IslandStep, h: f64) {
        let mut impulses = vec![Vector3::zeros(); island.pins.len()];
        for (pin, impulse) in impulses.iter_mut().enumerate() {
            if island.motors[pin]
                && let Some(attachment) = &self.attachments[island.attachments[pin]]
            {
                *impulse = impedance::passed(world, attachment);
            }
        }
        for (b, &handle) in island.handles.iter().enumerate() {
            if !world.bodies.contains(handle) {
                continue;
            }
            let end = &island.bodies[b];
            let mut total = (Vector3::zeros(), Vector3::zeros());
            for (pin, p) in island.pins.iter().zip(&impulses).filter(|(p, _)| p.body == b) {
                total.0 += p;
                total.1 += (end.rotation * pin.anchor).cross(p);
            }
            let memory = self.memory.iter_mut().find(|m| m.handle == handle).expect("made in predict");
            let deviated = hand_over::settle(world, handle, end, &island.given[b], memory, total, h);
            if !deviated {
                for (_, p) in island.pins.iter().zip(&mut impulses).filter(|(p, _)| p.body == b) {
                    *p = Vector3::zeros();
                }
            }
        }
        if impulses.iter().any(|p| *p != Vector3::zeros()) {
            for (c, cable) in pick(&mut self.cables, &island.cables).into_iter().enumerate() {
                let own: Vec<Vector3<f64>> =
                    island.pins.iter().zip(&impulses).filter(|(p, _)| p.cable == c).map(|(_, p)| *p).collect();
                island.impedances[c].kick(cable, &own);
            }
        }
        self.account(world, island);
    }

    /// Gaps after the step.
    fn account(&mut self, world: &PhysicsWorld, island: &IslandStep) {
        for (pin, &index) in island.pins.iter().zip(&island.attachments) {
            let Some(a) = self.attachments[index].as_mut() else { continue };
            let Some(body) = world.bodies.get(a.body) else { continue };
            let Some(cable) = &self.cables[a.cable.0 as usize] else { continue };
            let memory = self.memory.iter().find(|m| m.handle == a.body);
            let anchor = match memory.and_then(|m| m.exact.as_ref()) {
                Some(exact) => exact.position + exact.rotation * pin.anchor,
                None => vector(body.translation()) + rotation(*body.rotation()) * a.anchor,
            };
            a.gap = (cable.node_position(a.node) - anchor).norm();
        }
    }

    /// The integrator of an island: its cables' if they agree, else the tightest tolerance among them.
    fn island_integrator(&self, cables: &[usize]) -> Integrator {
        let all = || cables.iter().filter_map(|&c| self.cables[c].as_ref()).map(Cable::integrator);
        let first = all().next().unwrap_or_default();
        if all().all(|i| i == first) {
            return first;
        }
        let rank = |i: &Integrator| match i.control {
            StepControl::Tolerance(tolerance) => tolerance,
            _ => f64::INFINITY,
        };
        all().fold(first, |best, i| if rank(&i) < rank(&best) { i } else { best })
    }
}

/// What `integrator` promises for a host step, for one of its `parts`.
fn part_of(integrator: Integrator, parts: u32) -> Integrator {
    let control = match integrator.control {
        StepControl::Tolerance(tolerance) => StepControl::Tolerance(tolerance / f64::from(parts)),
        StepControl::Substeps(substeps) => StepControl::Substeps(substeps.div_ceil(parts)),
        control => control,
    };
    Integrator { control, ..integrator }
}

/// The cables of an island, in its order (ascending indices).
fn pick<'a>(cables: &'a mut [Option<Cable>], indices: &[usize]) -> Vec<&'a mut Cable> {
    cables
        .iter_mut()
        .enumerate()
        .filter(|(i, _)| indices.binary_search(i).is_ok())
        .filter_map(|(_, c)| c.as_mut())
        .collect()
}
