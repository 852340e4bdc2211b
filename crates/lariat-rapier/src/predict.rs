//! Before a Rapier step: cables and bodies are integrated together, and the motion is handed over.

use crate::body;
use crate::islands::{IslandStep, Member};
use crate::set::{CableSet, Slot};
use crate::{CableHandle, Error, bear, ends, hand_over, impedance, linkage, mechanism, near};
use ::nalgebra::{Vector3, Vector6};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{Cable, Integrator, StepControl};
use rapier::pipeline::PhysicsWorld;

impl CableSet {
    /// Predicts one of `parts` equal parts of a host step. If an island cannot step, all of them and their bodies are as before.
    pub(crate) fn predict_part(&mut self, world: &mut PhysicsWorld, parts: u32) -> Result<(), Error> {
        let h = f64::from(world.integration_parameters.dt);
        if core::mem::take(&mut self.pending) {
            // predicted, and never reconciled
            let islands = core::mem::take(&mut self.islands);
            islands.iter().for_each(|island| take_back(world, island));
            self.islands = islands;
        }
        self.end_lost_attachments(world)?;
        self.follow_gravity(world)?;
        self.find_islands(world)?;
        let mut islands = core::mem::take(&mut self.islands);
        islands.iter_mut().for_each(|island| island.given.clear());
        self.refused.clear();
        let fastest = near::fastest(world);
        let mut outcome = Ok(());
        for k in 0..islands.len() {
            outcome = self.predict_island(world, &mut islands[k], h, parts, fastest);
            if outcome.is_err() {
                islands[..=k].iter().for_each(|island| self.undo(world, island));
                self.refused.extend(islands[k].cables.iter().map(|&c| CableHandle(c as u32)));
                break;
            }
        }
        self.pending = outcome.is_ok();
        self.islands = islands;
        outcome
    }

    fn predict_island(
        &mut self,
        world: &mut PhysicsWorld,
        island: &mut IslandStep,
        h: f64,
        parts: u32,
        fastest: f64,
    ) -> Result<(), Error> {
        island.given.clear();
        island.before.clear();
        island
            .before
            .extend(island.cables.iter().filter_map(|&c| self.cables[c].as_ref()).map(|s| s.cable.snapshot().clone()));
        island.idle = self.sleeps(world, island, h);
        if island.idle {
            pick(&mut self.cables, &island.cables).into_iter().for_each(|cable| cable.rest(h));
            return Ok(());
        }
        self.move_ends(world, island, h)?;
        for a in island.supports.iter().filter_map(|&index| self.attachments[index].as_ref()) {
            impedance::idle(world, a);
        }
        let integrator = part_of(self.island_integrator(&island.cables), parts);
        if island.members.is_empty() {
            for cable in pick(&mut self.cables, &island.cables) {
                cable.step_with(h, &integrator)?;
            }
            return Ok(());
        }
        self.read_members(world, island, h)?;
        let mut cables = pick(&mut self.cables, &island.cables);
        self.solver.step(&mut cables, &mut island.bodies, &island.pins, integrator, h)?;
        for (account, attachment) in self.solver.accounts().iter().zip(&island.attachments) {
            if let Some(a) = attachment.and_then(|a| self.attachments[a].as_mut()) {
                a.passed = *account;
            }
        }
        for (i, member) in island.members.iter().enumerate() {
            let mut given = None;
            match member {
                Member::Body(handle) if !world.bodies[*handle].is_sleeping() => {
                    let remembered = self.remember(*handle);
                    let (start, end) = (&island.start[i], &island.bodies[i]);
                    let linkage = island.linkages[i].as_ref();
                    given = Some(hand_over::give(world, *handle, (start, end), linkage, remembered, h));
                }
                Member::Junction(j) => {
                    if let Some(junction) = &mut self.junctions[*j] {
                        junction.memory = island.bodies[i].memory;
                    }
                }
                _ => {}
            }
            island.given.push(given);
        }
        self.set_motors(world, island, h, fastest)
    }

    /// Force and torque on a member as its cables pulled at the end of the last step, with its own.
    fn load(&self, island: &IslandStep, member: usize, body: &RigidBody) -> Vector6<f64> {
        let mut load = linkage::both(&body.force, &body.torque);
        for (pin, index) in island.pins.iter().zip(&island.attachments).filter(|(pin, _)| pin.body == member) {
            if let Some(a) = index.and_then(|i| self.attachments[i].as_ref()) {
                let torque = (body.rotation * pin.anchor).cross(&a.account.force) + a.account.moment;
                load += linkage::both(&a.account.force, &torque);
            }
        }
        load
    }

    /// Members as they are when the step begins.
    fn read_members(&mut self, world: &mut PhysicsWorld, island: &mut IslandStep, h: f64) -> Result<(), Error> {
        let time = self.cables[island.cables[0]].as_ref().map_or(0.0, |s| s.cable.time());
        let substep = h / world.integration_parameters.num_solver_iterations.max(1) as f64;
        island.start.clear();
        island.linkages.clear();
        for (m, member) in island.members.iter().enumerate() {
            let mut linkage = None;
            let body = match member {
                Member::Body(handle) => {
                    mechanism::prepare(world, *handle);
                    let remembered = self.remember(*handle);
                    let learnt = remembered.force != Vector3::zeros() || remembered.torque != Vector3::zeros();
                    if learnt && impedance::is_alone(world, *handle) {
                        // what it met is gone
                        (remembered.force, remembered.torque) = Default::default();
                    }
                    let mut body = body::read(world, *handle, remembered, time)?;
                    let load = self.load(island, m, &body);
                    let held = |b| self.attachments.iter().flatten().any(|a| a.body == b);
                    if let Some((found, carried, others)) = linkage::find(world, *handle, &body, &load, substep, &held)
                    {
                        let (force, torque) = linkage::halves(&others);
                        body.force += force;
                        body.torque += torque;
                        body.carried = Some(carried);
                        linkage = Some(found);
                    }
                    body
                }
                Member::Driven(handle) => ends::driven(world, *handle, h)?,
                Member::Junction(j) => {
                    let junction = self.junctions[*j].as_ref().expect("islands are found anew when one ends");
                    junction.point(self.get(junction.nodes[0].0)?)?
                }
            };
            island.start.push(body);
            island.linkages.push(linkage);
        }
        island.bodies.clear();
        island.bodies.extend_from_slice(&island.start);
        Ok(())
    }

    /// Lets a body that may deviate from its prediction feel the cables within Rapier's step, in which no other body is faster than `fastest`
    /// (m/s).
    fn set_motors(
        &mut self,
        world: &mut PhysicsWorld,
        island: &mut IslandStep,
        h: f64,
        fastest: f64,
    ) -> Result<(), Error> {
        let way = |i: usize| island.bodies[i].position - island.start[i].position;
        let near = |world: &PhysicsWorld, i: usize| match (&island.members[i], &island.given[i]) {
            (Member::Body(handle), Some(_)) => {
                impedance::may_meet_something(world, *handle)
                    || near::runs_into(world, *handle, &way(i), h, fastest).is_some()
            }
            _ => false,
        };
        island.motors.clear();
        island.motors.resize(island.pins.len(), false);
        if (0..island.members.len()).any(|i| near(world, i)) {
            let mut cables = pick(&mut self.cables, &island.cables);
            island.impedances.resize_with(cables.len(), Default::default);
            for (c, cable) in cables.iter_mut().enumerate() {
                let nodes: Vec<usize> = island.pins.iter().filter(|p| p.cable == c).map(|p| p.node).collect();
                island.impedances[c].update(cable, &nodes, h)?;
            }
        }
        for i in 0..island.members.len() {
            if !near(world, i) {
                continue;
            }
            for (pin, d) in impedance::driving_point(island, i) {
                let anchor = island.pins[pin].anchor;
                let target = (island.bodies[i].point(&anchor) - island.start[i].point(&anchor)) / h;
                if let Some(a) = island.attachments[pin].and_then(|a| self.attachments[a].as_mut()) {
                    impedance::drive(world, a, &d, &target, h);
                    island.motors[pin] = true;
                }
            }
        }
        for (pin, driven) in island.motors.iter().enumerate() {
            if !driven && let Some(a) = island.attachments[pin].and_then(|a| self.attachments[a].as_ref()) {
                impedance::idle(world, a);
            }
        }
        Ok(())
    }

    /// Takes a prediction back.
    fn undo(&mut self, world: &mut PhysicsWorld, island: &IslandStep) {
        self.restore_cables(island);
        for member in &island.members {
            if let Member::Junction(j) = member
                && let Some(junction) = &mut self.junctions[*j]
            {
                junction.memory = None;
            }
        }
        take_back(world, island);
    }

    /// Puts the cables of an island back to where they were before the step.
    pub(crate) fn restore_cables(&mut self, island: &IslandStep) {
        for (cable, before) in pick(&mut self.cables, &island.cables).into_iter().zip(&island.before) {
            // a state of the cable itself always fits
            let _ = cable.restore(before.clone());
        }
    }

    /// The integrator of an island: its cables' if they agree, else the tightest tolerance among them.
    fn island_integrator(&self, cables: &[usize]) -> Integrator {
        let all = || cables.iter().filter_map(|&c| self.cables[c].as_ref()).map(|s| s.cable.integrator());
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

/// Gives the bodies of an island back what they were given in place of.
fn take_back(world: &mut PhysicsWorld, island: &IslandStep) {
    let given = island.members.iter().zip(&island.given).zip(&island.linkages);
    // the last that was given first: of a mechanism, the first knows how it was
    for ((member, given), linkage) in given.rev() {
        let (Member::Body(handle), Some(given)) = (member, given) else { continue };
        if world.bodies.contains(*handle) {
            hand_over::take_back(world, *handle, linkage.as_ref(), given);
        } else if let Some(linkage) = linkage {
            bear::restore(world, linkage.borne());
        }
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

/// The cables of an island, in its order.
pub(crate) fn pick<'a>(cables: &'a mut [Option<Box<Slot>>], indices: &[usize]) -> Vec<&'a mut Cable> {
    let mut picked: Vec<(usize, &mut Cable)> = cables
        .iter_mut()
        .enumerate()
        .filter_map(|(i, slot)| Some((indices.iter().position(|&k| k == i)?, &mut slot.as_mut()?.cable)))
        .collect();
    picked.sort_by_key(|(place, _)| *place);
    picked.into_iter().map(|(_, cable)| cable).collect()
}
