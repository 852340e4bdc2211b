//! Brings a set and its world to rest by their motion, where statics have no law: bodies that rest
//! on others, cables that touch each other, themselves, or bodies that they move.
//!
//! # Equation
//!
//! Dynamic relaxation with kinetic damping. All starts at rest, as it was drawn, and moves under
//! what acts on it at the end of its ramps; at a peak of the kinetic energy all velocities become
//! zero, but not sooner than a quarter, a half or a whole second after the last time, in turn: at
//! each peak of what vibrates fast, what moves slowly would hardly begin. It rests when no point
//! moves by more than a share of the largest extent in a time from rest.
//!
//! It must be a peak: a vibration that is stopped where it turns keeps its amplitude, and each stop
//! begins it anew in the same phase.
//!
//! # Validity
//!
//! With friction, as in motion: where it comes to rest depends on how it was drawn. Nothing that
//! acts or holds may change with time. All dynamic bodies come to rest, those without a cable, too.
//! What passes something on its way has to rest on the side on which it was drawn.
//!
//! # References
//!
//! Barnes 1999; Day 1965.

use super::passed::{Moved, check_passed};
use super::report::Relaxed;
use super::solve::BodyForce;
use crate::body::is_integrated;
use crate::body::ledger::is_ledger;
use crate::contact;
use crate::contact::broad::Finder;
use crate::contents::Contents;
use crate::convert::{to_vector, vector};
use crate::error::Error;
use crate::handle::CableHandle;
use crate::scales::contents::ATTACHMENT_GAP;
use crate::scales::statics::{RELAXATION_STEP, RELAXATION_STEPS, STILL, STILL_STEPS, UNTOUCHED, WINDOWS};
use crate::step::settings::Settings;
use crate::step::{self, Stepper};
use ::nalgebra::Vector3;
use lariat_ancf::Cable;
use lariat_ancf::coupling::Coupling;
use rapier::dynamics::{RigidBody, RigidBodyHandle, RigidBodyType};
use rapier::math::{Real, Vector};
use rapier::pipeline::PhysicsWorld;

/// A set and its world while they come to rest.
struct Relaxation {
    contents: Contents,
    world: PhysicsWorld,
    stepper: Stepper,
    /// Forces and torques of the users on each body, without those at points.
    own: Vec<(RigidBodyHandle, Vector, Vector)>,
    /// Whether a cable began otherwise than as it was drawn.
    looks_at_sides: bool,
}

/// Moves a set and its world to where they come to rest from how cables were `drawn`; returns
/// `None` and leaves both as they are if they do not, or if something changes with time.
///
/// # Errors
/// [`Error::CablesPassInStatics`], [`Error::CablePassesBodyInStatics`] if they rest beyond what
/// they touch.
pub(super) fn relax(
    contents: &mut Contents,
    (finder, world): (&Finder, &mut PhysicsWorld),
    (forces, drawn): (&[BodyForce], &[(CableHandle, Cable)]),
) -> Result<Option<Relaxed>, Error> {
    let Some(mut relaxation) = Relaxation::new(contents, world, drawn) else { return Ok(None) };
    let Some(relaxed) = relaxation.run(forces) else { return Ok(None) };
    if relaxation.passed_something() {
        if world.colliders.iter().any(|(_, collider)| collider.parent().is_none()) {
            // nothing is known of its sides
            return Ok(None);
        }
        relaxation.check_sides(contents, (finder, world), drawn)?;
    }
    relaxation.take_over(contents, world);
    Ok(Some(relaxed))
}

/// Returns whether cables touch what statics do not compute: themselves, each other, or bodies that
/// they move.
pub(super) fn has_more_contact(contents: &Contents) -> bool {
    let mut contacts = contents.cables.iter().filter_map(|(_, slot)| slot.cable.effects().contact.as_ref());
    contacts.any(|contact| contact.itself || contact.cables || contents.attachments.values().next().is_some())
}

/// Returns the largest way in m of a point in a quarter of a second from rest, if it is more than
/// that of what stands, [`UNTOUCHED`] times as much where cables touch nothing that statics do not
/// compute; `None`, too, if something changes with time.
pub(super) fn moves(contents: &Contents, world: &PhysicsWorld, forces: &[BodyForce]) -> Option<f64> {
    let mut relaxation = Relaxation::new(contents, world, &[])?;
    let (from, mut way, mut touches) = (relaxation.places(), 0.0f64, relaxation.touches_more());
    for _ in 0..STILL_STEPS {
        if !relaxation.is_steady() {
            return None;
        }
        relaxation.step(forces).ok()?;
        way = way.max(largest_way(&from, &relaxation.places()));
        touches |= relaxation.touches_more();
    }
    let limit = relaxation.limit() * if touches { 1.0 } else { UNTOUCHED };
    (way > limit).then_some(way)
}

impl Relaxation {
    fn new(contents: &Contents, world: &PhysicsWorld, drawn: &[(CableHandle, Cable)]) -> Option<Self> {
        let (mut contents, mut world, mut looks_at_sides) = (contents.clone(), copy(world), false);
        for (handle, cable) in drawn {
            let held = contents.attachments.values().filter(|a| a.cable == *handle);
            let nodes: Vec<usize> = held.map(|a| a.node).collect();
            let Some(slot) = contents.cables.get_mut(handle.0 as usize) else { continue };
            if slot.cable.positions().len() != cable.positions().len() {
                continue;
            }
            // drawn away from what it is attached to, it begins where it was brought there
            let gap = |node: usize| (slot.cable.node_position(node) - cable.node_position(node)).norm();
            if nodes.into_iter().all(|node| gap(node) <= ATTACHMENT_GAP) {
                slot.cable.set_coordinates(cable.positions(), cable.velocities()).ok()?;
            } else {
                looks_at_sides = true;
            }
        }
        for slot in contents.cables.values_mut() {
            slot.cable.begin_relaxation();
            *slot.cable.diagnostics_mut() = Default::default();
            (slot.modified, slot.asleep) = (true, false);
        }
        contents.changed = true;
        let own =
            world.bodies.iter().filter(|(_, b)| b.is_dynamic()).map(|(h, b)| (h, b.user_force(), b.user_torque()));
        let own = own.collect();
        for (_, body) in world.bodies.iter_mut().filter(|(_, body)| !body.is_fixed()) {
            let pose = *body.position();
            body.set_next_kinematic_position(pose);
            stop(body);
        }
        world.integration_parameters.dt = RELAXATION_STEP as Real;
        Some(Relaxation { contents, world, stepper: Stepper::default(), own, looks_at_sides })
    }

    /// Returns whether a cable touches what statics do not compute: itself, another one, or a body
    /// that cables move.
    fn touches_more(&self) -> bool {
        let moved = |key: u64| {
            let body = self.world.colliders.get(contact::collider(key)).and_then(|collider| collider.parent());
            body.is_some_and(|body| is_integrated(&self.world, body) && self.contents.held_bodies().any(|b| b == body))
        };
        self.contents.cables.iter().any(|(_, slot)| {
            slot.cable.cable_contacts().any(|touch| touch.normal_force > 0.0)
                || slot.cable.contacts().any(|touch| moved(touch.obstacle))
        })
    }

    /// Returns whether nothing that acts or holds changes with time.
    fn is_steady(&self) -> bool {
        let time = f64::from(RELAXATION_STEPS) * RELAXATION_STEP;
        let cables = self.contents.cables.iter().map(|(_, slot)| &slot.cable);
        cables.into_iter().all(|cable| cable.is_held_still() && cable.is_loaded_steadily(time))
            && self.contents.water.as_ref().is_none_or(|water| water.is_steady(time))
    }

    fn run(&mut self, forces: &[BodyForce]) -> Option<Relaxed> {
        let limit = self.limit();
        let (mut since, mut windows, mut way, mut from) = (0, 0, 0.0f64, self.places());
        let (mut before, mut last) = (0.0, 0.0);
        for host_steps in 1..=RELAXATION_STEPS {
            if !self.is_steady() {
                break;
            }
            self.step(forces).ok()?;
            since += 1;
            way = way.max(largest_way(&from, &self.places()));
            if since >= STILL_STEPS && way < limit {
                return Some(Relaxed { host_steps, way });
            }
            let kinetic = self.kinetic_energy();
            if since >= WINDOWS[windows % WINDOWS.len()] && last >= before && kinetic < last {
                self.stop();
                (windows, since, way, from) = (windows + 1, 0, 0.0, self.places());
            }
            (before, last) = (last, kinetic);
        }
        None
    }

    /// Returns whether something went, or may have gone, through something else on the way.
    fn passed_something(&self) -> bool {
        self.looks_at_sides || self.contents.cables.iter().any(|(_, slot)| slot.cable.diagnostics().crossed_steps > 0)
    }

    /// Refuses shapes beyond what cables touch, seen from how they were `drawn` in a world.
    fn check_sides(
        &self,
        contents: &Contents,
        (finder, world): (&Finder, &PhysicsWorld),
        drawn: &[(CableHandle, Cable)],
    ) -> Result<(), Error> {
        let found = self.contents.cables.iter();
        let moved = found.filter_map(|(index, slot)| Moved::of(contents, drawn, (index, &slot.cable)));
        let bodies = self.world.bodies.iter().filter(|(_, body)| !is_ledger(body));
        let poses: Vec<_> = bodies.map(|(handle, body)| (handle, *body.position())).collect();
        check_passed(contents, finder, world, moved.collect(), &poses).map_err(Error::by_motion)
    }

    fn step(&mut self, forces: &[BodyForce]) -> Result<(), Error> {
        let Relaxation { contents, world, stepper, own, .. } = self;
        for (handle, force, torque) in &*own {
            let body = &mut world.bodies[*handle];
            set_forces(body, *force, *torque);
            for at in forces.iter().filter(|at| at.body == *handle) {
                let point = *body.position() * at.point;
                body.add_force_at_point(to_vector(&at.force), point, false);
            }
        }
        let settings = Settings { sleep_speed: 0.0, watch: false, ..Settings::default() };
        let mut host = step::begin(stepper, contents, world, &settings)?;
        let mut outcome = Ok(());
        while host.is_unfinished() && outcome.is_ok() {
            outcome = step::predict_next(stepper, contents, world, &settings, &mut host);
            if outcome.is_ok() {
                world.step();
                step::reconcile(stepper, contents, world, &settings);
            }
        }
        step::finish(stepper, contents, world, host);
        outcome?;
        stepper.failures.first().map_or(Ok(()), |failure| Err(failure.error.clone()))
    }

    fn stop(&mut self) {
        for slot in self.contents.cables.values_mut() {
            slot.cable.stop();
            slot.modified = true;
        }
        self.world.bodies.iter_mut().filter(|(_, body)| body.is_dynamic()).for_each(|(_, body)| stop(body));
    }

    fn kinetic_energy(&self) -> f64 {
        let bodies = self.world.bodies.iter().filter(|(_, body)| !is_ledger(body));
        let cables = self.contents.cables.iter().map(|(_, slot)| slot.cable.energy().kinetic);
        bodies.map(|(_, body)| f64::from(body.kinetic_energy())).chain(cables).sum()
    }

    /// Returns the largest way in m of a point of what stands.
    fn limit(&self) -> f64 {
        STILL * self.contents.cables.iter().map(|(_, slot)| slot.cable.length()).fold(0.0, f64::max)
    }

    /// Returns points that may move: three of each body beside its origin, and nodes.
    fn places(&self) -> Vec<Vector3<f64>> {
        let moving = self.world.bodies.iter().filter(|(h, b)| is_integrated(&self.world, *h) && !is_ledger(b));
        let bodies = moving.flat_map(|(_, body)| {
            let corners = [Vector::ZERO, Vector::X, Vector::Y, Vector::Z];
            corners.map(|corner| vector(*body.position() * corner))
        });
        let cables = self
            .contents
            .cables
            .iter()
            .flat_map(|(_, slot)| (0..slot.cable.nodes()).map(|node| slot.cable.node_position(node)));
        bodies.chain(cables).collect()
    }

    /// Ends at rest, and takes over poses, shapes and contacts.
    fn take_over(mut self, contents: &mut Contents, world: &mut PhysicsWorld) {
        self.stop();
        for (index, slot) in contents.cables.iter() {
            let Some(own) = self.contents.cables.get_mut(index) else { continue };
            own.cable.end_relaxation(&slot.cable);
            (own.introduced, own.compared) = (slot.introduced, slot.compared);
        }
        for (handle, body) in self.world.bodies.iter_mut() {
            let Some(before) = world.bodies.get(handle) else { continue };
            if body.body_type() == RigidBodyType::KinematicVelocityBased {
                body.set_linvel(before.linvel(), false);
                body.set_angvel(before.angvel(), false);
            }
        }
        for (handle, force, torque) in &self.own {
            set_forces(&mut self.world.bodies[*handle], *force, *torque);
        }
        if let (Some(own), Some(water)) = (&mut self.contents.water, &contents.water) {
            own.set_time(water.time());
        }
        self.world.integration_parameters = world.integration_parameters;
        replace(world, self.world);
        *contents = self.contents;
        contents.changed = true;
    }
}

/// Returns the largest way between the same points; nothing is known of a mesh that changed.
fn largest_way(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> f64 {
    if from.len() != to.len() {
        return f64::INFINITY;
    }
    from.iter().zip(to).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max)
}

/// Gives a body the force and the torque of the users.
fn set_forces(body: &mut RigidBody, force: Vector, torque: Vector) {
    body.reset_forces(false);
    body.reset_torques(false);
    body.add_force(force, false);
    body.add_torque(torque, false);
}

fn stop(body: &mut RigidBody) {
    body.set_linvel(Vector::ZERO, true);
    body.set_angvel(Vector::ZERO, true);
}

/// Gives a world the state of another.
pub(super) fn replace(world: &mut PhysicsWorld, mut by: PhysicsWorld) {
    core::mem::swap(&mut world.physics_pipeline, &mut by.physics_pipeline);
    *world = by;
}

/// Returns a world in the state of another.
pub(super) fn copy(world: &PhysicsWorld) -> PhysicsWorld {
    let mut copy = PhysicsWorld::new();
    copy.gravity = world.gravity;
    copy.integration_parameters = world.integration_parameters;
    copy.islands = world.islands.clone();
    copy.broad_phase = world.broad_phase.clone();
    copy.narrow_phase = world.narrow_phase.clone();
    copy.bodies = world.bodies.clone();
    copy.colliders = world.colliders.clone();
    copy.impulse_joints = world.impulse_joints.clone();
    copy.multibody_joints = world.multibody_joints.clone();
    copy.soft_bodies = world.soft_bodies.clone();
    copy
}
