//! The Rapier side of a scene: its bodies, and its cables once they are attached to them.
//!
//! Bodies never sleep. One step goes to the next time at which the run stops. A step shorter than the host step is split into
//! proportionally fewer Rapier steps, so that probes between host times do not shorten the Rapier steps much.

mod build;
mod energy;
mod explain;
mod joints;
mod overlap;
mod parts;
mod reading;
mod script;
mod statics;
mod warnings;
mod water;

pub use build::collider;
pub use energy::BodyTerms;
pub use parts::Parts;
pub use reading::BodyState;
pub use script::Script;
pub use statics::Settled;

use crate::error::Error;
use crate::scene::body::BodyKind;
use crate::scene::{Scene, SheaveScene};
use crate::warning::Warning;
use lariat_ancf::coupling::{Coupling, SegmentTwist};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Break, Cable, Momentum, Vector3};
use lariat_rapier::convert::{to_vector, vector};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::math::Real;
use lariat_rapier::rapier::prelude::PhysicsWorld;
use lariat_rapier::{
    AttachmentHandle, AttachmentKind, AttachmentReading, CableHandle, CableSet, Drum, Event, Gap, SheaveHandle,
    SheaveOptions,
};
use serde::{Deserialize, Serialize};

/// Rapier steps of a host step: a run is for accuracy, in contacts too, and its cost is that of the cables.
const RAPIER_STEPS: u32 = 4;
/// Largest difference of velocities at the start that is rounding, in m/s.
const JOLT: f64 = 1e-5;
/// Share of the length of a cable from which a gap that closes is told.
const CLOSING: f64 = 1e-3;

/// The bodies of a scene, and its cables during a run.
#[derive(Serialize, Deserialize)]
pub struct Physics {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    cables: CableSet,
    handles: Vec<CableHandle>,
    /// By cable, that of the scene of which it is a part.
    sources: Vec<usize>,
    /// By attachment of the scene; `None` for one to the world, which is a support of the cable.
    attachments: Vec<Option<AttachmentHandle>>,
    sheaves: Vec<SheaveHandle>,
    /// By attachment, force and moment of the cable at t = 0, with the body still held.
    held_by: Vec<(Vector3<f64>, Vector3<f64>)>,
    /// Rapier steps per host step.
    rapier_steps: u32,
    /// What moves and loads the bodies.
    script: Script,
    /// Sum of all steps done, in s.
    reached: f64,
    /// Largest gap so far in m.
    max_gap: f64,
    /// Cables and bodies that were found in each other.
    passed: Vec<(usize, usize)>,
    /// By body, work of the loads on it in J.
    load_work: Vec<f64>,
}

impl Clone for Physics {
    fn clone(&self) -> Self {
        let w = &self.world;
        let world = PhysicsWorld {
            gravity: w.gravity,
            integration_parameters: w.integration_parameters,
            islands: w.islands.clone(),
            broad_phase: w.broad_phase.clone(),
            narrow_phase: w.narrow_phase.clone(),
            bodies: w.bodies.clone(),
            colliders: w.colliders.clone(),
            impulse_joints: w.impulse_joints.clone(),
            multibody_joints: w.multibody_joints.clone(),
            soft_bodies: w.soft_bodies.clone(),
            // the rest are buffers
            ..PhysicsWorld::default()
        };
        Physics {
            world,
            bodies: self.bodies.clone(),
            cables: self.cables.clone(),
            handles: self.handles.clone(),
            sources: self.sources.clone(),
            attachments: self.attachments.clone(),
            sheaves: self.sheaves.clone(),
            held_by: self.held_by.clone(),
            rapier_steps: self.rapier_steps,
            script: self.script.clone(),
            reached: self.reached,
            max_gap: self.max_gap,
            passed: self.passed.clone(),
            load_work: self.load_work.clone(),
        }
    }
}

impl Physics {
    /// Builds the bodies as drawn, without cables.
    ///
    /// # Errors
    /// [`Error::Body`]; not for a checked scene.
    pub fn build(scene: &Scene) -> Result<Self, Error> {
        let mut world = PhysicsWorld::new();
        world.gravity = to_vector(&scene.gravity);
        // a limit of 400 m/s would change the motion silently
        world.integration_parameters.normalized_max_linear_velocity = Real::MAX;
        if let Some(n) = scene.solver_iterations {
            world.integration_parameters.num_solver_iterations = n;
        }
        let mut bodies = Vec::new();
        for body in &scene.bodies {
            let failed = |problem| Error::Body { time: 0.0, body: body.name.clone(), problem };
            bodies.push(build::insert(&mut world, body).map_err(failed)?);
        }
        joints::insert(&mut world, scene, &bodies).map_err(|(body, problem)| Error::Body {
            time: 0.0,
            body,
            problem,
        })?;
        // runs watch the cables themselves
        let mut cables = CableSet::new();
        cables.settings.watch = false;
        let (rapier_steps, load_work) = (RAPIER_STEPS, vec![0.0; bodies.len()]);
        let script = Script::new(scene, &bodies);
        cables.set_water(water::fill(&mut world, scene, &bodies)?);
        Ok(Physics {
            world,
            bodies,
            cables,
            handles: Vec::new(),
            sources: Vec::new(),
            attachments: Vec::new(),
            sheaves: Vec::new(),
            held_by: Vec::new(),
            rapier_steps,
            script,
            reached: 0.0,
            max_gap: 0.0,
            passed: Vec::new(),
            load_work,
        })
    }

    /// Gives cables the twists that they had before bodies took hold of them.
    pub fn keep_twists(&mut self, twists: Vec<Option<Vec<SegmentTwist>>>) {
        for (handle, twists) in self.handles.iter().zip(twists) {
            if let (Ok(cable), Some(twists)) = (self.cables.get_mut(*handle), twists) {
                cable.set_twists(twists);
            }
        }
    }

    /// Takes the cables of the scene, attaches them to the bodies and joins them to each other; `held_by` are force (N) and moment
    /// (N m) of the cable on the support at each attachment until now.
    ///
    /// # Errors
    /// [`Error::Mechanics`] or [`Error::Coupling`]; not for a checked scene.
    pub fn take(
        &mut self,
        scene: &Scene,
        cables: Vec<Cable>,
        held_by: &[(Vector3<f64>, Vector3<f64>)],
    ) -> Result<(), Error> {
        self.handles = cables.into_iter().map(|cable| self.cables.insert(cable)).collect();
        self.sources = (0..self.handles.len()).collect();
        self.held_by = held_by.to_vec();
        for attachment in &scene.attachments {
            let Some(body) = attachment.body else {
                self.attachments.push(None);
                continue;
            };
            let (cable, body) = (self.handles[attachment.cable], self.bodies[body]);
            let at = At::ArcLength(attachment.arc_length);
            let kind = if attachment.clamp { AttachmentKind::Clamp } else { AttachmentKind::Ball };
            let gap = match attachment.gap {
                // the scene was checked in f64 already
                Gap::Refuse(limit) => Gap::Refuse(limit.max(1e-3)),
                Gap::Close => Gap::Close,
            };
            let kind = kind.with_gap(gap);
            let attached = match attachment.anchor {
                None => self.cables.attach_here(&self.world, cable, at, body, kind),
                Some(anchor) => self.cables.attach(&self.world, cable, at, body, to_vector(&anchor), kind),
            };
            self.attachments.push(Some(attached.map_err(|error| self.explain(scene, 0.0, error))?));
        }
        for junction in &scene.junctions {
            let [a, b] = junction.points.map(|(cable, s)| (self.handles[cable], At::ArcLength(s)));
            self.cables.join(a, b).map_err(|error| self.explain(scene, 0.0, error))?;
        }
        for (cable, own) in scene.cables.iter().enumerate() {
            let (Some(drum), Some(reel)) = (own.drum, &own.reel) else { continue };
            let end = if own.reel_at_start { At::Start } else { At::End };
            let wound = Drum { body: self.bodies[drum.body], axis: to_vector(&drum.axis), radius: drum.radius as Real };
            let added = self.cables.add_drum(&self.world.bodies, (self.handles[cable], end), wound, reel.clone());
            added.map_err(|error| self.explain(scene, 0.0, error))?;
        }
        for sheave in &scene.sheaves {
            let SheaveScene { friction, turns, inertia, brake, radius, on_wheel, along, .. } = *sheave;
            let [from, to] = sheave.cables.map(|cable| self.handles[cable]);
            // what is on the wheel turns with it
            let inertia = inertia + scene.cables[sheave.cables[0]].sections.last().mass_per_length * on_wheel;
            let along = along.then_some(on_wheel);
            let options = SheaveOptions { inertia, friction, turns, brake, radius, along };
            let added = self.cables.add_sheave((from, At::End), (to, At::Start), options);
            self.sheaves.push(added.map_err(|error| self.explain(scene, 0.0, error))?);
        }
        Ok(())
    }

    /// Returns the readings of a sheave, as [`World::sheave`](crate::run::World::sheave).
    pub fn sheave(&self, sheave: usize) -> Option<[f64; 6]> {
        let sheave = self.cables.sheave(*self.sheaves.get(sheave)?).ok()?;
        let [from, to] = sheave.ends().map(|(cable, at)| self.cables.get(cable).ok()?.reel(at));
        let (from, to) = (from?, to?);
        Some([sheave.passed(), to.rate, from.tension, to.tension, sheave.force(), sheave.lost()])
    }

    /// Returns whether a sheave stands because its cable cannot run on: at a point that is held or loaded, or at its last element.
    pub fn sheave_stopped(&self, sheave: usize) -> bool {
        let ends = self.sheaves.get(sheave).and_then(|sheave| Some(self.cables.sheave(*sheave).ok()?.ends()));
        let at_end = |(cable, at): (CableHandle, At)| {
            let reel = self.cables.get(cable).ok().and_then(|cable| cable.reel(at));
            reel.is_some_and(|reel| reel.stopped)
        };
        ends.is_some_and(|ends| ends.into_iter().any(at_end))
    }

    /// Returns whether the two sides of an attachment start at different velocities, and a warning
    /// for each where that is a shock, or where a gap is to close.
    ///
    /// # Errors
    /// [`Error::Mechanics`]; not for a checked scene.
    pub fn jolts(&self, scene: &Scene) -> Result<(bool, Vec<Warning>), Error> {
        let (cables, mut jolts, mut differ) = (self.cables(), Vec::new(), false);
        for attachment in &scene.attachments {
            let Some(body) = attachment.body else { continue };
            let at = scene.present(attachment.cable, cables[attachment.cable], attachment.arc_length);
            let point = cables[attachment.cable].sample(at)?;
            let state = self.body(scene, body, 0.0);
            let there = state.velocity + state.angular_velocity.cross(&(point.position - state.position));
            let difference = point.velocity - there;
            let pose = self.world.bodies[self.bodies[body]].position();
            let held = attachment.anchor.map(|anchor| vector(pose.transform_point(to_vector(&anchor))));
            let apart = held.map_or(0.0, |held| (point.position - held).norm());
            if apart > CLOSING * cables[attachment.cable].length() && matches!(attachment.gap, Gap::Close) {
                let (attachment, cable) = (attachment.name.clone(), scene.cables[attachment.cable].name.clone());
                jolts.push(Warning::ClosingGap { attachment, cable, gap_m: apart });
            }
            if difference.norm() <= JOLT {
                continue;
            }
            differ = true;
            let carried = scene.attachments.iter().filter(|other| other.cable == attachment.cable);
            let bodies = carried.filter_map(|other| self.world.bodies.get(self.bodies[other.body?]));
            let mass: f64 = bodies.filter(|body| body.is_dynamic()).map(|body| f64::from(body.mass())).sum();
            let shock = cables[attachment.cable].shock(at, &difference, mass * scene.gravity.norm())?;
            if shock.is_large() {
                let (attachment, cable) = (attachment.name.clone(), scene.cables[attachment.cable].name.clone());
                let (force_n, difference_m_s) = (shock.force, difference.norm());
                jolts.push(Warning::VelocityJump { attachment, cable, force_n, difference_m_s });
            }
        }
        Ok((differ, jolts))
    }

    /// Advances cables and bodies from one time to another, in s.
    ///
    /// # Errors
    /// [`Error::Mechanics`] names the cable and the time, [`Error::Body`] the body.
    pub fn advance(&mut self, scene: &Scene, from: f64, to: f64) -> Result<(), Error> {
        // steps rounded to single precision add up to another time: the next step compensates for the last
        let dt = (to - self.reached) as Real;
        if dt <= 0.0 {
            return Ok(());
        }
        let share = f64::from(self.rapier_steps) * f64::from(dt) / scene.dt;
        let steps = (share - 1e-3).ceil().clamp(1.0, f64::from(self.rapier_steps)) as u32;
        self.cables.settings.rapier_steps = steps;
        self.world.integration_parameters.dt = dt;
        self.script.set(&mut self.world, from, to);
        let before = self.places(scene);
        self.cables.step(&mut self.world).map_err(|error| self.explain(scene, from, error))?;
        self.add_load_work(scene, &before);
        self.reached += f64::from(dt / steps as Real) * f64::from(steps);
        for (_, attachment) in self.cables.attachments() {
            self.max_gap = self.max_gap.max(attachment.gap());
        }
        // Rapier disables bodies whose state is not finite
        match self.bodies.iter().position(|&body| !self.world.bodies[body].is_enabled()) {
            None => Ok(()),
            Some(i) => {
                let problem = "its position or velocity is not finite".to_string();
                Err(Error::Body { time: to, body: scene.bodies[i].name.clone(), problem })
            }
        }
    }

    /// Cuts a cable at an arc length in m.
    ///
    /// # Errors
    /// [`Error::Mechanics`] for a point that is not between the ends.
    pub fn cut(&mut self, scene: &Scene, time: f64, cable: usize, arc_length: f64) -> Result<(), Error> {
        let cut = self.cables.cut(self.handles[cable], arc_length);
        cut.map(|_| ()).map_err(|error| self.explain(scene, time, error))
    }

    /// Returns the cables that broke or were cut since the last call, by their position, with what they carried. The rest of
    /// each is the next of all cables.
    pub fn take_breaks(&mut self) -> Vec<(usize, Break)> {
        let mut breaks = Vec::new();
        for event in self.cables.take_events() {
            if let Event::Broken { cable, rest, how } = event
                && let Some(part) = self.handles.iter().position(|handle| *handle == cable)
            {
                self.handles.push(rest);
                self.sources.push(self.sources[part]);
                breaks.push((part, how));
            }
        }
        breaks
    }

    /// Lets no cable break any more.
    pub fn withstand_all(&mut self) {
        for handle in &self.handles {
            // no limit is a strength that every cable takes
            let _ = self.cables.set_strength(*handle, None);
        }
    }

    /// Returns the cables, in the order of the scene, and after them the parts of those that broke.
    pub fn cables(&self) -> Vec<&Cable> {
        self.cables.iter().map(|(_, cable)| cable).collect()
    }

    /// Returns force, moment, gap and work at an attachment; `None` for one to the world. At t = 0 force and moment are those on a
    /// body that is still held.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for an attachment of the scene.
    pub fn reading(&self, index: usize, time: f64) -> Result<Option<AttachmentReading>, Error> {
        let Some(handle) = self.attachments.get(index).copied().flatten() else { return Ok(None) };
        let attachment = self.cables.attachment(handle).map_err(|source| Error::Coupling { time, source })?;
        let mut reading = *attachment.reading();
        if time == 0.0 {
            // before the first step there is no force of the coupling yet
            (reading.force, reading.moment) = self.held_by[index];
        }
        Ok(Some(reading))
    }

    /// Returns the largest gap of all attachments at the ends of all steps so far, in m.
    pub fn max_gap(&self) -> f64 {
        self.max_gap
    }

    /// Returns the state of a body at a time.
    pub fn body(&self, scene: &Scene, index: usize, time: f64) -> BodyState {
        let state = reading::state(&self.world.bodies[self.bodies[index]]);
        let body = &scene.bodies[index];
        if body.kind == BodyKind::Kinematic {
            // that of Rapier is the mean over its last step
            let (velocity, angular_velocity) = body.course.velocities(time);
            return BodyState { velocity, angular_velocity, ..state };
        }
        state
    }

    /// Returns kinetic energy and potential energy in gravity of the dynamic bodies, in J. Added mass has no weight.
    pub fn energy(&self, scene: &Scene) -> (f64, f64) {
        let (mut kinetic, mut gravity) = (0.0, 0.0);
        for (body, &handle) in scene.bodies.iter().zip(&self.bodies) {
            if body.kind != BodyKind::Dynamic {
                continue;
            }
            let Some(rigid) = lariat_rapier::rigid_body(&self.world, handle) else { continue };
            let added = self.cables.water().map_or(0.0, |water| water.added_mass(handle));
            kinetic += rigid.kinetic_energy() + self.further_kinetic(handle, &rigid);
            gravity -= (rigid.mass - added) * scene.gravity.dot(&rigid.position);
        }
        (kinetic, gravity)
    }

    /// Returns the momentum of the dynamic bodies.
    pub fn momentum(&self, scene: &Scene) -> Momentum {
        let zero = Momentum { linear: Vector3::zeros(), angular: Vector3::zeros() };
        self.dynamic(scene).fold(zero, |sum, (handle, body)| {
            let (linear, angular) = body.momentum();
            let further = self.cables.water().and_then(|water| water.further_mass(&self.world, handle));
            let further = further.map_or(Vector3::zeros(), |further| further * body.velocity);
            let angular = angular + body.position.cross(&further);
            Momentum { linear: sum.linear + linear + further, angular: sum.angular + angular }
        })
    }

    fn dynamic(&self, scene: &Scene) -> impl Iterator<Item = (RigidBodyHandle, RigidBody)> {
        let bodies = scene.bodies.iter().zip(&self.bodies).filter(|(body, _)| body.kind == BodyKind::Dynamic);
        bodies.filter_map(|(_, &handle)| Some((handle, lariat_rapier::rigid_body(&self.world, handle)?)))
    }
}
