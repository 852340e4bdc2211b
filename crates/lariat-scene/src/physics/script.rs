//! What a scene does to its bodies as time goes: kinematic bodies follow their paths, and loads act.
//!
//! Loads on bodies have their value at the middle of a step, and act at the point of the body where
//! it is at the beginning of the step. Water is that of the set of cables.

use super::reading;
use crate::scene::body::BodyKind;
use crate::scene::course::Course;
use crate::scene::{BodyLoadScene, Scene};
use lariat_rapier::convert::{to_pose, to_vector};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::prelude::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// What moves and loads the bodies of a scene.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Script {
    courses: Vec<(RigidBodyHandle, Course)>,
    loads: Vec<(RigidBodyHandle, BodyLoadScene)>,
    /// Whether loads act in full from the start, whatever their ramps.
    pub(super) full_loads: bool,
}

impl Script {
    /// Takes what a scene does to its bodies.
    pub(super) fn new(scene: &Scene, bodies: &[RigidBodyHandle]) -> Self {
        let kinematic = scene.bodies.iter().zip(bodies).filter(|(body, _)| body.kind == BodyKind::Kinematic);
        Script {
            courses: kinematic.map(|(body, handle)| (*handle, body.course.clone())).collect(),
            loads: scene.body_loads.iter().map(|load| (bodies[load.body], load.clone())).collect(),
            full_loads: false,
        }
    }

    /// Leaves kinematic bodies that do not move by themselves to whoever moves them.
    pub(super) fn leave_resting(&mut self) {
        self.courses.retain(|(_, course)| !course.is_at_rest());
    }

    /// Sets where kinematic bodies go, and the loads, for a step from one time to another in s.
    /// Bodies that were removed are left out.
    pub fn set(&mut self, world: &mut PhysicsWorld, from: f64, to: f64) {
        for (handle, course) in &self.courses {
            let (position, rotation) = course.pose(to);
            if let Some(body) = world.bodies.get_mut(*handle) {
                body.set_next_kinematic_position(to_pose(&position, &rotation));
            }
        }
        for (handle, _) in &self.loads {
            let Some(body) = world.bodies.get_mut(*handle) else { continue };
            body.reset_forces(false);
            body.reset_torques(false);
        }
        for (handle, load) in &self.loads {
            let Some(body) = world.bodies.get_mut(*handle) else { continue };
            let state = reading::state(body);
            let point = state.position + state.rotation * load.point;
            let (force, moment) = load.at(0.5 * (from + to), self.full_loads);
            body.add_force_at_point(to_vector(&force), to_vector(&point), true);
            body.add_torque(to_vector(&moment), true);
        }
    }
}
