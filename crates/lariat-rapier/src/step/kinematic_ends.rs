//! Cable ends on fixed, kinematic and disabled bodies: prescribed motion.
//!
//! A ball attachment prescribes the position of its node over the step; a clamp is a driven body of
//! its island, whose uniform motion rotates the tangent. Rapier moves a kinematic body by its
//! velocity with a linearised rotation in each substep, by at most [`MAX_ROTATION_PER_STEP`] in a
//! step; its pose after the step is computed the same way, so that the end is where Rapier puts the
//! body.

use crate::attachment::Attachment;
use crate::contents::Contents;
use crate::convert::{rotation, to_pose, vector};
use crate::error::Error;
use crate::islands::{Island, Member};
use ::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use lariat_ancf::island::{CLOSING_SPEED, RigidBody};
use lariat_ancf::{At, Motion};
use rapier::dynamics::{RigidBodyHandle, RigidBodyType};
use rapier::math::Pose;
use rapier::pipeline::PhysicsWorld;

/// Distance in m within which an anchor counts as unmoved.
const UNMOVED_DISTANCE: f64 = 1e-12;

/// Largest rotation of a body in a Rapier step, in rad, unless it is allowed to rotate faster.
pub(crate) const MAX_ROTATION_PER_STEP: f64 = core::f64::consts::FRAC_PI_4;

/// Poses of the position-based kinematic bodies that move in a host step.
#[derive(Clone, Debug, Default)]
pub(crate) struct KinematicTargets {
    /// Body, pose before the host step, pose after it.
    targets: Vec<(RigidBodyHandle, Pose, Pose)>,
}

impl KinematicTargets {
    /// Reads the targets that the user set.
    pub fn read(world: &PhysicsWorld) -> Self {
        let targets = world.bodies.iter().filter_map(|(handle, body)| {
            let moves =
                body.body_type() == RigidBodyType::KinematicPositionBased && body.next_position() != body.position();
            moves.then(|| (handle, *body.position(), *body.next_position()))
        });
        KinematicTargets { targets: targets.collect() }
    }

    /// Sets the pose of each body for the end of step `done` of `steps`.
    pub fn advance(&self, world: &mut PhysicsWorld, done: u32, steps: u32) {
        for (handle, from, to) in &self.targets {
            let Some(body) = world.bodies.get_mut(*handle) else { continue };
            let share = f64::from(done) / f64::from(steps);
            let turn = rotation(to.rotation) * rotation(from.rotation).inverse();
            let attitude = UnitQuaternion::from_scaled_axis(turn.scaled_axis() * share) * rotation(from.rotation);
            let position = vector(from.translation).lerp(&vector(to.translation), share);
            let pose = if done == steps { *to } else { to_pose(&position, &attitude) };
            body.set_next_kinematic_position(pose);
        }
    }

    /// Restores the targets that the user set.
    pub fn restore(&self, world: &mut PhysicsWorld) {
        for (handle, _, to) in &self.targets {
            if let Some(body) = world.bodies.get_mut(*handle) {
                body.set_next_kinematic_position(*to);
            }
        }
    }
}

/// Position of the origin of a body in m, and its attitude.
type OriginPose = (Vector3<f64>, UnitQuaternion<f64>);

/// Returns the pose of a body.
fn pose(world: &PhysicsWorld, body: RigidBodyHandle) -> OriginPose {
    let body = &world.bodies[body];
    (vector(body.translation()), rotation(*body.rotation()))
}

/// Returns the pose of a body with prescribed motion after a step of `h` (s).
fn pose_after(world: &PhysicsWorld, handle: RigidBodyHandle, h: f64) -> OriginPose {
    let body = &world.bodies[handle];
    match body.body_type() {
        _ if !body.is_enabled() => pose(world, handle),
        RigidBodyType::KinematicPositionBased => {
            (vector(body.next_position().translation), rotation(body.next_position().rotation))
        }
        RigidBodyType::KinematicVelocityBased => moved_by_velocity(world, handle, h),
        _ => pose(world, handle),
    }
}

/// Returns the pose of a kinematic body after Rapier moved it by its velocity for `h` (s): no
/// faster than Rapier's greatest velocity.
fn moved_by_velocity(world: &PhysicsWorld, handle: RigidBodyHandle, h: f64) -> OriginPose {
    let body = &world.bodies[handle];
    let parameters = &world.integration_parameters;
    let substeps = parameters.num_solver_iterations.max(1);
    let (mut velocity, mut spin) = (vector(body.linvel()), vector(body.angvel()));
    let (max_speed, speed) = (f64::from(parameters.max_linear_velocity()), velocity.norm());
    if speed > max_speed {
        velocity *= max_speed / speed;
    }
    if !body.is_fast_rotation_allowed() && spin.norm() * h > MAX_ROTATION_PER_STEP {
        spin *= MAX_ROTATION_PER_STEP / (h * spin.norm());
    }
    // the normalised quaternion (1, t/2) is a rotation by 2 atan(|t|/2)
    let half = 0.5 * spin.norm() * h / substeps as f64;
    let turn = spin.try_normalize(0.0).map_or_else(Vector3::zeros, |axis| axis * (2.0 * half.atan() * substeps as f64));
    let attitude = UnitQuaternion::from_scaled_axis(turn) * rotation(*body.rotation());
    // Rapier's world centre of mass may be that of the last step
    let local = vector(body.local_center_of_mass());
    let centre = vector(body.translation()) + rotation(*body.rotation()) * local + velocity * h;
    (centre - attitude * local, attitude)
}

/// Returns a body with prescribed motion as a driven body of an island: its origin and attitude,
/// and the uniform motion of the coming step.
pub(crate) fn driven_body(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    h: f64,
) -> Result<RigidBody, lariat_ancf::Error> {
    let ((from, attitude), (to, turned)) = (pose(world, handle), pose_after(world, handle, h));
    let mut body = RigidBody::new(1.0, Matrix3::identity(), from)?;
    body.rotation = attitude;
    body.velocity = (to - from) / h;
    // a body that stands still must get no angular velocity by rounding
    if turned != attitude {
        body.angular_velocity = (turned * attitude.inverse()).scaled_axis() / h;
    }
    body.free = [false; 6];
    Ok(body)
}

/// Returns whether an end of an island with prescribed motion moves in the coming step, or was
/// moved since the last.
pub(crate) fn have_moved(contents: &Contents, world: &PhysicsWorld, island: &Island, h: f64) -> bool {
    let has_moved = |a: &Attachment, (origin, attitude): OriginPose| {
        a.last_anchor.is_none_or(|before| (origin + attitude * a.anchor - before).norm() > UNMOVED_DISTANCE)
    };
    let mut supports = island.supports.iter().filter_map(|&i| contents.attachments.get(i));
    let mut clamps = island.pins.iter().zip(&island.attachments).filter_map(|(pin, index)| {
        let Member::Driven(body) = island.members[pin.body] else { return None };
        Some((body, contents.attachments.get((*index)?)?))
    });
    let rotates = |member: &Member| matches!(member, Member::Driven(b) if pose(world, *b) != pose_after(world, *b, h));
    supports.any(|a| has_moved(a, pose_after(world, a.body, h)))
        || clamps.any(|(body, a)| has_moved(a, pose(world, body)))
        || island.members.iter().any(rotates)
}

/// Prescribes the motion of the supported nodes of an island over the coming step.
pub(crate) fn prescribe(contents: &mut Contents, world: &PhysicsWorld, island: &Island, h: f64) -> Result<(), Error> {
    for &index in &island.supports {
        let Some(a) = contents.attachments.get_mut(index) else { continue };
        let Some(slot) = contents.cables.get_mut(a.cable.0 as usize) else { continue };
        let cable = &mut slot.cable;
        let ((origin, attitude), (to, turned)) = (pose(world, a.body), pose_after(world, a.body, h));
        let (start, end) = (origin + attitude * a.anchor, to + turned * a.anchor);
        let from = cable.node_position(a.node);
        // after a teleport the node follows with CLOSING_SPEED at most
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
        a.last_anchor.get_or_insert(start);
    }
    Ok(())
}

/// Reads force, gap and work at the supported nodes of an island after a step.
pub(crate) fn read(contents: &mut Contents, world: &PhysicsWorld, island: &Island) {
    for &index in &island.supports {
        let Some(a) = contents.attachments.get_mut(index) else { continue };
        let Some(slot) = contents.cables.get_mut(a.cable.0 as usize) else { continue };
        if !world.bodies.contains(a.body) {
            continue;
        }
        let (origin, attitude) = pose(world, a.body);
        let anchor = origin + attitude * a.anchor;
        let (force, _) = slot.cable.pull(a.node);
        let mean = 0.5 * (a.reading.force + force);
        let gap = slot.cable.node_position(a.node) - anchor;
        let before = a.last_anchor.replace(anchor).unwrap_or(anchor);
        a.reading.work += mean.dot(&(anchor - before));
        a.reading.residual += mean.dot(&(a.reading.gap - gap));
        a.reading.force = force;
        a.reading.moment = Vector3::zeros();
        a.reading.gap = gap;
    }
}
