//! Islands that cannot step: their cables and bodies stand still while all others go on.
//!
//! # Scheme
//! Cables and bodies of the island are as they were before its step, and so are their clocks.
//! During Rapier's step its bodies are immovable obstacles: all axes are locked, velocities and
//! forces are zero. Afterwards they have their own state again, whatever it was. The island is
//! tried again in the next host step.
//!
//! # Validity
//! Rapier cannot lock a link of a multibody: it moves freely from rest during Rapier's step, and is
//! set back afterwards. A body whose position is not finite is held where it was last; if that is
//! not known, Rapier disables it.

use crate::body::record::{ExactState, Records};
use crate::body::{SavedBody, replace_loads};
use crate::islands::Island;
use rapier::dynamics::{LockedAxes, Multibody, RigidBodyHandle};
use rapier::math::{Pose, Vector};
use rapier::pipeline::PhysicsWorld;

/// The bodies of an island that could not step, with the state to restore after Rapier's step.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldBodies {
    bodies: Vec<HeldBody>,
    /// Multibodies by one of their links.
    multibodies: Vec<(RigidBodyHandle, Multibody)>,
}

#[derive(Clone, Copy, Debug)]
struct HeldBody {
    handle: RigidBodyHandle,
    pose: Pose,
    saved: SavedBody,
    locked: LockedAxes,
}

impl HeldBodies {
    /// Holds the bodies of an island that are awake.
    pub fn hold(&mut self, records: &Records, world: &mut PhysicsWorld, island: &Island) {
        for handle in island.bodies() {
            if world.bodies[handle].is_sleeping() || self.bodies.iter().any(|held| held.handle == handle) {
                continue;
            }
            let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else {
                self.add(records, world, handle, LockedAxes::all());
                continue;
            };
            if let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) {
                self.multibodies.push((handle, multibody.clone()));
                multibody.generalized_velocity_mut().fill(0.0);
                let links: Vec<RigidBodyHandle> = multibody.links().map(|link| link.rigid_body_handle()).collect();
                links.into_iter().for_each(|link| self.add(records, world, link, LockedAxes::empty()));
            }
        }
    }

    /// Stops a body, and locks `axes` beside those that are locked.
    fn add(&mut self, records: &Records, world: &mut PhysicsWorld, handle: RigidBodyHandle, axes: LockedAxes) {
        let Some(body) = world.bodies.get_mut(handle) else { return };
        let (pose, locked) = (*body.position(), body.locked_axes());
        self.bodies.push(HeldBody { handle, pose, saved: SavedBody::of(body), locked });
        replace_loads(body, Vector::ZERO, Vector::ZERO);
        body.set_linvel(Vector::ZERO, false);
        body.set_angvel(Vector::ZERO, false);
        body.set_locked_axes(locked | axes, false);
        let last = records.get(handle).and_then(|record| record.exact.as_ref()).map(ExactState::pose);
        if let Some(last) = last.filter(|_| !pose.is_finite()) {
            body.set_position(last, false);
        }
    }

    /// Restores the bodies that are still in the world.
    pub fn release(&mut self, world: &mut PhysicsWorld) {
        for (link, multibody) in self.multibodies.drain(..) {
            if let Some(link) = world.multibody_joints.rigid_body_link(link).copied()
                && let Some(current) = world.multibody_joints.get_multibody_mut(link.multibody)
            {
                *current = multibody;
            }
        }
        for held in self.bodies.drain(..) {
            let Some(body) = world.bodies.get_mut(held.handle) else { continue };
            if *body.position() != held.pose {
                body.set_position(held.pose, false);
            }
            body.set_locked_axes(held.locked, false);
            held.saved.restore_settings(body);
            held.saved.restore_velocities(body);
        }
    }
}
