//! Ends on bodies that feel nothing: fixed, kinematic, disabled ones carry them along.

use crate::convert::{rotation, vector};
use crate::islands::{IslandStep, Member};
use crate::set::CableSet;
use ::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use lariat_ancf::island::{CLOSING_SPEED, RigidBody};
use lariat_ancf::{At, Motion};
use rapier::dynamics::{RigidBodyHandle, RigidBodyType};
use rapier::pipeline::PhysicsWorld;

/// An anchor nearer than this to where it was, in m, has not moved.
const STILL: f64 = 1e-12;

/// Greatest turn of a body in a Rapier step, in rad, unless it is allowed to turn faster.
pub(crate) const MOST_TURN: f64 = core::f64::consts::FRAC_PI_4;

/// Place and attitude of a body now.
fn pose(world: &PhysicsWorld, body: RigidBodyHandle) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let body = &world.bodies[body];
    (vector(body.translation()), rotation(*body.rotation()))
}

/// Place and attitude of a body that Rapier moves by itself, `h` (s) from now.
fn pose_after(world: &PhysicsWorld, handle: RigidBodyHandle, h: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let body = &world.bodies[handle];
    match body.body_type() {
        _ if !body.is_enabled() => pose(world, handle),
        RigidBodyType::KinematicPositionBased => {
            (vector(body.next_position().translation), rotation(body.next_position().rotation))
        }
        RigidBodyType::KinematicVelocityBased => moved(world, handle, h),
        _ => pose(world, handle),
    }
}

/// Place and attitude of a kinematic body after Rapier moved it by its velocity for `h` (s): Rapier turns it by a linearised rotation in
/// each substep, by at most [`MOST_TURN`] in a step, and no faster than its greatest velocity.
fn moved(world: &PhysicsWorld, handle: RigidBodyHandle, h: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let body = &world.bodies[handle];
    let parameters = &world.integration_parameters;
    let substeps = parameters.num_solver_iterations.max(1);
    let (mut velocity, mut spin) = (vector(body.linvel()), vector(body.angvel()));
    let (most, fastest) = (f64::from(parameters.max_linear_velocity()), velocity.norm());
    if fastest > most {
        velocity *= most / fastest;
    }
    if !body.is_fast_rotation_allowed() && spin.norm() * h > MOST_TURN {
        spin *= MOST_TURN / (h * spin.norm());
    }
    // (1 + t/2) normalised is a turn by 2 atan(|t|/2)
    let half = 0.5 * spin.norm() * h / substeps as f64;
    let turn = spin.try_normalize(0.0).map_or_else(Vector3::zeros, |axis| axis * (2.0 * half.atan() * substeps as f64));
    let attitude = UnitQuaternion::from_scaled_axis(turn) * rotation(*body.rotation());
    // Rapier's place of the centre may be that of the last step
    let local = vector(body.local_center_of_mass());
    let centre = vector(body.translation()) + rotation(*body.rotation()) * local + velocity * h;
    (centre - attitude * local, attitude)
}

/// A body that feels nothing as an island sees it: its origin and attitude, with the uniform motion of the coming step.
pub(crate) fn driven(world: &PhysicsWorld, handle: RigidBodyHandle, h: f64) -> Result<RigidBody, lariat_ancf::Error> {
    let ((place, attitude), (to, turned)) = (pose(world, handle), pose_after(world, handle, h));
    let mut body = RigidBody::new(1.0, Matrix3::identity(), place)?;
    body.rotation = attitude;
    body.velocity = (to - place) / h;
    // of one that stands still rounding makes no spin
    if turned != attitude {
        body.angular_velocity = (turned * attitude.inverse()).scaled_axis() / h;
    }
    body.free = [false; 6];
    Ok(body)
}

impl CableSet {
    /// Whether anything that an island's ends are prescribed by, or clamped to, moves in the coming step, or was moved.
    pub(crate) fn is_pulled(&self, world: &PhysicsWorld, island: &IslandStep, h: f64) -> bool {
        let by_support = island.supports.iter().any(|&index| {
            let Some(a) = &self.attachments[index] else { return false };
            let (place, attitude) = pose_after(world, a.body, h);
            a.placed.is_none_or(|before| (place + attitude * a.anchor - before).norm() > STILL)
        });
        let moved = island.pins.iter().zip(&island.attachments).any(|(pin, index)| {
            let a = index.and_then(|i| self.attachments[i].as_ref());
            let (Member::Driven(body), Some(a)) = (island.members[pin.body], a) else { return false };
            let (place, attitude) = pose(world, body);
            a.placed.is_none_or(|before| (place + attitude * a.anchor - before).norm() > STILL)
        });
        let turns =
            |member: &Member| matches!(member, Member::Driven(b) if pose(world, *b) != pose_after(world, *b, h));
        by_support || moved || island.members.iter().any(turns)
    }

    /// Prescribes the ends of an island whose bodies feel nothing, over the coming step.
    pub(crate) fn move_ends(&mut self, world: &PhysicsWorld, island: &IslandStep, h: f64) -> Result<(), crate::Error> {
        for &index in &island.supports {
            let Some(a) = &mut self.attachments[index] else { continue };
            let Some(slot) = &mut self.cables[a.cable.0 as usize] else { continue };
            let cable = &mut slot.cable;
            let ((place, attitude), (to, turned)) = (pose(world, a.body), pose_after(world, a.body, h));
            let (start, end) = (place + attitude * a.anchor, to + turned * a.anchor);
            let from = cable.node_position(a.node);
            // after a teleport the cable must live through it
            let behind = from - start;
            let left = (1.0 - CLOSING_SPEED * h / (1.5 * behind.norm()).max(f64::MIN_POSITIVE)).max(0.0);
            let end = end + behind * left;
            let motion = if start == end && from == end {
                Motion::fixed(end)
            } else {
                let velocity = (to + turned * a.anchor - start) / h;
                Motion::hermite(cable.time(), h, (from, velocity), (end, velocity))
            };
            if cable.support(At::Node(a.node))?.position != Some(motion) {
                cable.set_motion(a.node, motion)?;
            }
            a.placed.get_or_insert(start);
        }
        Ok(())
    }

    /// Reads what the prescribed ends of an island felt in the step that was done.
    pub(crate) fn account_ends(&mut self, world: &PhysicsWorld, island: &IslandStep) {
        for &index in &island.supports {
            let Some(a) = &mut self.attachments[index] else { continue };
            let Some(slot) = &mut self.cables[a.cable.0 as usize] else { continue };
            let Some(body) = world.bodies.get(a.body) else { continue };
            let anchor = vector(body.translation()) + rotation(*body.rotation()) * a.anchor;
            let (force, _) = slot.cable.pull(a.node);
            let mean = 0.5 * (a.account.force + force);
            let gap = slot.cable.node_position(a.node) - anchor;
            let before = a.placed.replace(anchor).unwrap_or(anchor);
            a.account.work += mean.dot(&(anchor - before));
            a.account.residual += mean.dot(&(a.account.gap - gap));
            a.account.force = force;
            a.account.moment = Vector3::zeros();
            a.account.gap = gap;
        }
    }
}
