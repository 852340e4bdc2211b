//! The motion of fixed and kinematic bodies over a host step, as it is prescribed to their cables.
//!
//! # Equation
//! ```text
//! a = 2 (v - v')/(H + H')        s = a.a'/max(a.a, a'.a'), at least 0
//! v0 = (1 - s) (v - s a H/2) + s v1'        v1 = v + s a H/2
//! ```
//! v is the mean velocity of the body's reference point over a host step of H, v0 and v1 are its
//! velocities at both ends; the values of the last host step have a prime; angular velocities
//! alike. The reference point is one that hardly accelerates: the centre of mass of a body that
//! Rapier moves by its velocity; of one that is moved to poses x, R the point c (body axes) with
//! the least of
//! ```text
//! (theta/12)^2 |dv + dV c|^2 + (eps/H + e)^2 |c|^2        dv = (x1 - x0)/H - (x0 - x')/H'    dV = (R1 - R0)/H - (R0 - R')/H'
//! ```
//! The first term is what the velocity at the end lacks if the acceleration of c turns by theta in
//! the host step, the second what c adds by the rounding eps of an attitude, and by e, the error of
//! the angular velocity at the end, for which a quarter of its second difference is taken. A body
//! on a steady circle gets the centre of the circle, one that does not rotate its origin.
//!
//! Between the ends the body follows cubics, so that its motion is once continuously
//! differentiable where it accelerates steadily (s = 1). Where it starts, stops or turns a corner
//! (s = 0), its velocity jumps, as Rapier's does. A body that rotates steadily gives each anchor
//! the velocity v + w x r at both ends of a step.
//!
//! The poses lie on a line in time where they can, within their rounding
//! ([`crate::body::motion_memory`]).
//!
//! # Validity
//! A body that is slower than the rounding of its position per host step is at rest in some of
//! them, and keeps that rounding; so does one that accelerates, and attitudes do. The error of the
//! velocities of the reference point is of second order in H: a winch that circles without turning
//! keeps it. If a host step is split, a body that Rapier moves by its velocity is between the ends
//! where Rapier moves it to: uniformly from its first to its last pose.
//!
//! # Alternatives considered
//! What was tried, and what it gave: docs/decisions/rapier.md.

use crate::body::is_integrated;
use crate::body::motion_memory::{Line, MotionMemory, Velocities};
use crate::body::pose::{OriginPose, pose};
use crate::body::record::Records;
use crate::convert::{rotation, to_pose, vector};
use crate::scales::body::MAX_ROTATION_PER_STEP;
use ::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use rapier::dynamics::{RigidBodyHandle, RigidBodyType};
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// The motion of one body over a host step.
#[derive(Clone, Debug)]
struct BodyMotion {
    handle: RigidBodyHandle,
    /// Whether the user prescribes its pose at the end, not its velocity.
    by_pose: bool,
    /// The reference point, in body axes.
    reference: Vector3<f64>,
    /// Poses at both ends of the Rapier step in progress; those of the host step are in the memory.
    step: [OriginPose; 2],
    /// Velocities at both ends beyond the mean.
    beyond: [Velocities; 2],
    memory: MotionMemory,
}

/// The motions of all bodies over a host step to which cables are attached and that no force moves.
/// Bodies that the user moves to a pose are among them even without cables.
#[derive(Clone, Debug, Default)]
pub(crate) struct PrescribedMotions(Vec<BodyMotion>);

/// Returns the pose of a body with prescribed motion after a step of `h` (s).
pub(crate) fn pose_after(world: &PhysicsWorld, handle: RigidBodyHandle, h: f64) -> OriginPose {
    let body = &world.bodies[handle];
    match body.body_type() {
        _ if !body.is_enabled() => pose(world, handle),
        RigidBodyType::KinematicPositionBased => {
            (vector(body.next_position().translation), rotation(body.next_position().rotation))
        }
        RigidBodyType::KinematicVelocityBased => moved_by_velocity(world, handle, pose(world, handle), h),
        _ => pose(world, handle),
    }
}

/// Returns the pose of a kinematic body after Rapier moved it from `start` by its velocity for `h`
/// (s), with a linearised rotation in each substep.
fn moved_by_velocity(world: &PhysicsWorld, handle: RigidBodyHandle, start: OriginPose, h: f64) -> OriginPose {
    let body = &world.bodies[handle];
    let substeps = world.integration_parameters.num_solver_iterations.max(1);
    let (velocity, mut spin) = (vector(body.linvel()), vector(body.angvel()));
    if velocity == Vector3::zeros() && spin == Vector3::zeros() {
        return start;
    }
    if !body.is_fast_rotation_allowed() && spin.norm() * h > MAX_ROTATION_PER_STEP {
        spin *= MAX_ROTATION_PER_STEP / (h * spin.norm());
    }
    // the normalised quaternion (1, t/2) is a rotation by 2 atan(|t|/2)
    let half = 0.5 * spin.norm() * h / substeps as f64;
    let turn = spin.try_normalize(0.0).map_or_else(Vector3::zeros, |axis| axis * (2.0 * half.atan() * substeps as f64));
    let attitude = UnitQuaternion::from_scaled_axis(turn) * start.1;
    // Rapier's world centre of mass may be that of the last step
    let local = vector(body.local_center_of_mass());
    let centre = start.0 + start.1 * local + velocity * h;
    (centre - attitude * local, attitude)
}

/// Returns the uniform velocities of the body's point `local` from one pose to another in `h` (s).
fn mean([from, to]: &[OriginPose; 2], local: &Vector3<f64>, h: f64) -> Velocities {
    let point = |(origin, attitude): &OriginPose| origin + attitude * local;
    [(point(to) - point(from)) / h, (to.1 * from.1.inverse()).scaled_axis() / h]
}

/// Returns how far an acceleration continues that of the last step, 0 to 1.
fn steadiness(now: &Vector3<f64>, before: &Vector3<f64>) -> f64 {
    let largest = now.norm_squared().max(before.norm_squared());
    if largest > 0.0 { (now.dot(before) / largest).max(0.0) } else { 0.0 }
}

impl BodyMotion {
    fn read(records: &Records, world: &PhysicsWorld, handle: RigidBodyHandle, dt: f64) -> Self {
        let by_pose = world.bodies[handle].body_type() == RigidBodyType::KinematicPositionBased;
        let start = records.place(world, handle);
        let last = records.get(handle).and_then(|record| record.motion);
        let mut line = last.map_or_else(Line::default, |last| last.line);
        let end = match world.bodies[handle].body_type() {
            RigidBodyType::KinematicVelocityBased if world.bodies[handle].is_enabled() => {
                moved_by_velocity(world, handle, start, dt)
            }
            _ => {
                let (to, attitude) = pose_after(world, handle, dt);
                if to == pose(world, handle).0 {
                    // it rests
                    line = Line::default();
                    (start.0, attitude)
                } else {
                    (line.follow(&start.0, to, dt), attitude)
                }
            }
        };
        let curved = line.count == 2 && last.is_some_and(|last| last.line.count == 2);
        let poses = [start, end];
        let reference = match last {
            _ if !by_pose => vector(world.bodies[handle].local_center_of_mass()),
            Some(last) => least_accelerated_point(&poses, dt, &last),
            None => Vector3::zeros(),
        };
        let mean = mean(&poses, &reference, dt);
        let mut acceleration = Velocities::default();
        let mut beyond = [Velocities::default(); 2];
        if let Some(last) = last {
            let before = self::mean(&last.poses, &reference, last.step);
            let [v, w] = last.end;
            let end = [v + w.cross(&(last.poses[1].1 * reference)), w];
            for x in 0..2 {
                let a = (mean[x] - before[x]) * (2.0 / (dt + last.step));
                let s = steadiness(&a, &last.acceleration[x]);
                let half = a * (0.5 * s * dt);
                beyond[0][x] = (end[x] - mean[x]) * s - half * (1.0 - s);
                beyond[1][x] = half;
                acceleration[x] = a;
            }
        }
        let [v, w] = [0, 1].map(|x| mean[x] + beyond[1][x]);
        let end = [v - w.cross(&(poses[1].1 * reference)), w];
        let memory = MotionMemory { poses, acceleration, end, step: dt, line, curved };
        BodyMotion { handle, by_pose, reference, step: poses, beyond, memory }
    }

    /// Returns pose and velocities at a share of the host step of a body that is moved to a pose.
    fn at(&self, share: f64) -> (OriginPose, Velocities) {
        let ([first, last], h) = (self.beyond, self.memory.step);
        let [v, w] = mean(&self.memory.poses, &self.reference, h);
        let (x0, r0) = &self.memory.poses[0];
        let (c0, c1) = (share * (1.0 - share) * (1.0 - share) * h, -share * share * (1.0 - share) * h);
        let (d0, d1) = ((1.0 - share) * (1.0 - 3.0 * share), share * (3.0 * share - 2.0));
        let turn = w * (share * h) + first[1] * c0 + last[1] * c1;
        let attitude = UnitQuaternion::from_scaled_axis(turn) * r0;
        let point = x0 + r0 * self.reference + v * (share * h) + first[0] * c0 + last[0] * c1;
        let origin = point - attitude * self.reference;
        let velocities = core::array::from_fn(|x| [v, w][x] + first[x] * d0 + last[x] * d1);
        ((origin, attitude), velocities)
    }
}

/// Returns the reference point, in body axes, of a body that is moved to poses in a host step of
/// `h` (s) after the `last`.
fn least_accelerated_point(poses: &[OriginPose; 2], h: f64, last: &MotionMemory) -> Vector3<f64> {
    let rates = |poses: &[OriginPose; 2], h: f64| {
        let [start, end] = [0, 1].map(|i| poses[i].1.to_rotation_matrix().into_inner());
        (mean(poses, &Vector3::zeros(), h), (end - start) / h)
    };
    let (([v1, w], turning1), ([v0, w0], turning0)) = (rates(poses, h), rates(&last.poses, last.step));
    let (change, turning) = (v1 - v0, turning1 - turning0);
    let unsteady = (w - w0 - last.acceleration[1] * (0.5 * (h + last.step))).norm() / 4.0;
    let weight = 12.0 * (f64::from(Real::EPSILON) / h + unsteady) / (w.norm() * h);
    let squares = turning.tr_mul(&turning) + Matrix3::from_diagonal_element(weight * weight);
    // a body that does not rotate has an infinite weight
    squares.cholesky().map_or_else(Vector3::zeros, |squares| -squares.solve(&turning.tr_mul(&change)))
}

impl PrescribedMotions {
    /// Reads the motions of the `attached` bodies in a host step of `dt` (s).
    pub fn read(
        &mut self,
        attached: impl Iterator<Item = RigidBodyHandle>,
        records: &Records,
        world: &PhysicsWorld,
        dt: f64,
    ) {
        let motions = &mut self.0;
        motions.clear();
        let prescribed = |body: &RigidBodyHandle| {
            world.bodies.get(*body).is_some_and(|b| b.is_kinematic()) && !is_integrated(world, *body)
        };
        for body in attached.filter(prescribed) {
            if motions.iter().all(|m| m.handle != body) {
                motions.push(BodyMotion::read(records, world, body, dt));
            }
        }
    }

    /// Adds the bodies without cables that the user moves to a pose, since the host step is split.
    pub fn add_others(&mut self, records: &Records, world: &PhysicsWorld, dt: f64) {
        let moves = world.bodies.iter().filter(|(_, body)| {
            body.body_type() == RigidBodyType::KinematicPositionBased && body.next_position() != body.position()
        });
        for (handle, _) in moves {
            if self.0.iter().all(|m| m.handle != handle) {
                self.0.push(BodyMotion::read(records, world, handle, dt));
            }
        }
    }

    /// Begins the Rapier step from one share of the host step to another: where each body is and
    /// will be; sets the poses of those that the user moves to one.
    pub fn advance(&mut self, records: &mut Records, world: &mut PhysicsWorld, (from, to): (f64, f64)) {
        let h = f64::from(world.integration_parameters.dt);
        for motion in &mut self.0 {
            if !world.bodies.contains(motion.handle) {
                continue;
            }
            motion.step = if motion.by_pose {
                [from, to].map(|share| motion.at(share).0)
            } else if world.bodies[motion.handle].is_enabled() {
                let start = records.place(world, motion.handle);
                let step = [start, moved_by_velocity(world, motion.handle, start, h)];
                let spin = vector(world.bodies[motion.handle].angvel());
                records.record_mut(motion.handle).spin.note(&step, &spin, h);
                step
            } else {
                [records.place(world, motion.handle); 2]
            };
            records.record_mut(motion.handle).next_place = Some(motion.step[1]);
            if motion.by_pose {
                let (origin, attitude) = motion.step[1];
                world.bodies[motion.handle].set_next_kinematic_position(to_pose(&origin, &attitude));
            }
        }
    }

    /// Restores the poses that the user set.
    pub fn restore(&self, world: &mut PhysicsWorld) {
        for motion in self.0.iter().filter(|motion| motion.by_pose) {
            if let Some(body) = world.bodies.get_mut(motion.handle) {
                let (origin, attitude) = &motion.memory.poses[1];
                body.set_next_kinematic_position(to_pose(origin, attitude));
            }
        }
    }

    /// Keeps what the next host step needs.
    pub fn remember(&self, records: &mut Records) {
        for motion in &self.0 {
            records.record_mut(motion.handle).motion = Some(motion.memory);
        }
    }

    /// Returns the poses of a body at both ends of the Rapier step of `h` (s) in progress.
    pub fn poses(&self, world: &PhysicsWorld, handle: RigidBodyHandle, h: f64) -> [OriginPose; 2] {
        let known = self.0.iter().find(|motion| motion.handle == handle);
        known.map_or_else(|| [pose(world, handle), pose_after(world, handle, h)], |motion| motion.step)
    }

    /// Returns the poses of a body at both ends of the Rapier step of `h` (s) from one share of the
    /// host step to another, and the velocities of its origin there.
    pub fn ends(
        &self,
        world: &PhysicsWorld,
        handle: RigidBodyHandle,
        (from, to): (f64, f64),
        h: f64,
    ) -> [(OriginPose, Velocities); 2] {
        let poses = self.poses(world, handle, h);
        let motion = self.0.iter().find(|motion| motion.handle == handle);
        let local = motion.map_or_else(Vector3::zeros, |motion| motion.reference);
        let mut velocities = [mean(&poses, &local, h); 2];
        if let Some(motion) = motion {
            if motion.by_pose {
                velocities = [motion.at(from).1, motion.at(to).1];
            } else {
                for (at_end, i) in [(from == 0.0, 0), (to == 1.0, 1)] {
                    (0..2).filter(|_| at_end).for_each(|x| velocities[i][x] += motion.beyond[i][x]);
                }
            }
        }
        core::array::from_fn(|i| {
            let [v, w] = velocities[i];
            (poses[i], [v - w.cross(&(poses[i].1 * local)), w])
        })
    }
}
