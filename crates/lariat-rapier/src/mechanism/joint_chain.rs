//! Bodies held together by impulse joints.
//!
//! # Equation
//! ```text
//! W = E^T R      R = P M^-1 E      a = P M^-1 f      a0 = E^T (a + a_c)
//! ```
//! M holds the masses of all bodies that joints connect, G the rows of the locked axes and of the
//! active limits ([`super::constraints`]), and E picks the attached body. Where the loads f of the
//! other bodies are included, a limit is active if the joint is at it; elsewhere if it pushed in
//! Rapier's last substep and would with the cables added.
//!
//! A body of a chain that is given a velocity alone would be stopped by its neighbours, so all
//! bodies of the chain change their velocities together.
//!
//! # References
//! Udwadia & Kalaba 1992.

use super::constraints::{Constraints, Limit};
use super::joint_gap::{arm, is_stiff};
use super::joint_opening::{JointRows, opening};
use super::limits;
use super::loads::{CarriedLoads, are_isolated, can_predict_loads};
use super::of_body::{Mechanism, Velocities};
use super::request::Request;
use crate::body::ledger::is_ledger;
use crate::body::spatial::stack_spatial;
use crate::body::unsettled::JointGap;
use crate::convert::{rotation, symmetric, vector};
use crate::scales::mechanism::{LIGHT_LINK, MAX_BODIES};
use ::nalgebra::{DMatrix, DVector, Matrix3, UnitQuaternion, Vector3, Vector6};
use rapier::dynamics::{ImpulseJoint, RigidBody, RigidBodyHandle};
use rapier::pipeline::PhysicsWorld;

/// A joint, and by its two bodies their index in the chain; `None` for one that is not part of it.
type ChainJoint<'a> = ([Option<usize>; 2], &'a ImpulseJoint);

/// Returns the bodies that impulse joints connect with one, itself included; empty if none does.
pub(super) fn bodies(world: &PhysicsWorld, handle: RigidBodyHandle) -> Vec<RigidBodyHandle> {
    connected(world, handle).map_or_else(Vec::new, |(bodies, _)| bodies)
}

/// Returns the mechanism of a body; `None` if no joint holds it.
pub(super) fn find(world: &PhysicsWorld, request: &Request) -> Option<Mechanism> {
    let handle = request.handle;
    let (bodies, joints) = connected(world, handle)?;
    let n = 6 * bodies.len();
    let half = request.half_step;
    let inverse = inverse_mass(world, &bodies, half);
    let predicts_loads = bodies.len() < MAX_BODIES && can_predict_loads(world, &bodies, request);
    let mut loads = CarriedLoads::default();
    // the loads on others alone, and those on all bodies
    let mut forces = [DMatrix::<f64>::zeros(n, 1), DMatrix::<f64>::zeros(n, 1)];
    for (i, body) in bodies.iter().enumerate() {
        let of_member = request.members.iter().find(|(member, _)| member == body);
        let is_other = of_member.is_none() && predicts_loads;
        let load =
            if is_other { loads.add(world, *body) } else { of_member.map_or_else(Vector6::zeros, |(_, load)| *load) };
        forces[1].fixed_view_mut::<6, 1>(6 * i, 0).copy_from(&load);
        if is_other {
            forces[0].fixed_view_mut::<6, 1>(6 * i, 0).copy_from(&load);
        }
    }
    let Rows { rows, limits, of_joints } = constraint_rows(world, &joints, n, predicts_loads, half)?;
    let rows_now = constraint_rows(world, &joints, n, predicts_loads, 0.0)?.rows;
    let turning = (&rows - rows_now) * velocities(world, &bodies) / half;
    let spread = &inverse * rows.transpose();
    let columns = inverse.columns(0, 6).into_owned();
    let [free, all] = forces.map(|forces| &inverse * forces);
    let constraints = Constraints { rows, spread, turning, limits, substep: request.substep };
    // once for all members of the island that it holds
    let is_first = request.members.iter().find(|(m, _)| bodies.contains(m)).is_some_and(|(m, _)| *m == handle);
    let opening = match is_first && predicts_loads && has_light_link(world, &bodies) {
        true => opening(&constraints, &of_joints, (request.substep, request.sweeps)),
        false => JointGap::default(),
    };
    let (response, free, turned) = constraints.project(&columns, &free, &all)?;
    loads.of_body = free.fixed_view::<6, 1>(0, 0) + turned.fixed_rows::<6>(0);
    loads.accelerations = free.column(0).into_owned();
    loads.isolated = predicts_loads && are_isolated(world, &bodies);
    let members = bodies.iter().enumerate().filter(|(_, body)| request.is_member(**body));
    let mobilities = members.map(|(i, body)| (*body, response.fixed_view::<6, 6>(6 * i, 0).into_owned())).collect();
    let before = bodies.iter().map(|b| (*b, world.bodies[*b].linvel(), world.bodies[*b].angvel())).collect();
    Some(Mechanism { handle, response, mobilities, before: Velocities::OfBodies(before), loads, opening })
}

/// Returns the bodies that impulse joints connect with one, itself first, and the joints; `None` if
/// no joint holds it, or one of them is a link of a multibody.
fn connected(world: &PhysicsWorld, handle: RigidBodyHandle) -> Option<(Vec<RigidBodyHandle>, Vec<ChainJoint<'_>>)> {
    let holds = |joint: &ImpulseJoint| !joint.data.locked_axes.is_empty();
    if !world.impulse_joints.attached_enabled_joints(handle).any(|(_, _, _, joint)| holds(joint)) {
        return None;
    }
    let mut bodies = vec![handle];
    let mut joints: Vec<ChainJoint> = Vec::new();
    let mut next = 0;
    while next < bodies.len() {
        for (a, b, _, joint) in world.impulse_joints.attached_enabled_joints(bodies[next]) {
            if !holds(joint) {
                continue;
            }
            let ends = [a, b].map(|h| {
                let known = bodies.iter().position(|x| *x == h);
                let moves = |b: &RigidBody| b.is_dynamic() && !is_ledger(b);
                if known.is_none() && bodies.len() < MAX_BODIES && world.bodies.get(h).is_some_and(moves) {
                    bodies.push(h);
                    return Some(bodies.len() - 1);
                }
                known
            });
            // a joint is met at each of its bodies
            if ends.into_iter().flatten().min() == Some(next) {
                joints.push((ends, joint));
            }
        }
        next += 1;
    }
    let has_link = bodies.iter().any(|b| world.multibody_joints.rigid_body_link(*b).is_some());
    (!has_link).then_some((bodies, joints))
}

/// Returns whether one of the bodies is so light beside all that it may carry little through its
/// joints.
fn has_light_link(world: &PhysicsWorld, bodies: &[RigidBodyHandle]) -> bool {
    let masses = || bodies.iter().map(|body| f64::from(world.bodies[*body].mass()));
    masses().any(|mass| mass < LIGHT_LINK * masses().sum::<f64>())
}

/// Returns the velocities of all bodies.
fn velocities(world: &PhysicsWorld, bodies: &[RigidBodyHandle]) -> DVector<f64> {
    let of = |body: &RigidBodyHandle| {
        stack_spatial(&vector(world.bodies[*body].linvel()), &vector(world.bodies[*body].angvel()))
    };
    let mut stacked = DVector::zeros(6 * bodies.len());
    bodies.iter().enumerate().for_each(|(i, body)| stacked.fixed_rows_mut::<6>(6 * i).copy_from(&of(body)));
    stacked
}

/// Returns M^-1 after a time (s) of the present motion.
fn inverse_mass(world: &PhysicsWorld, bodies: &[RigidBodyHandle], time: f64) -> DMatrix<f64> {
    let mut inverse = DMatrix::<f64>::zeros(6 * bodies.len(), 6 * bodies.len());
    for (i, body) in bodies.iter().enumerate() {
        let properties = world.bodies[*body].mass_properties();
        let linear = Matrix3::from_diagonal(&vector(properties.effective_inv_mass));
        inverse.view_mut((6 * i, 6 * i), (3, 3)).copy_from(&linear);
        let angular = symmetric(&properties.effective_world_inv_inertia);
        let turned = turn_in(&world.bodies[*body], time).to_rotation_matrix();
        let angular = turned.matrix() * angular * turned.matrix().transpose();
        inverse.view_mut((6 * i + 3, 6 * i + 3), (3, 3)).copy_from(&angular);
    }
    inverse
}

/// Returns the rotation of a body in a time (s) of the present motion.
fn turn_in(body: &RigidBody, time: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(vector(body.angvel()) * time)
}

/// Returns centre of mass and attitude of a body after a time (s) of the present motion.
fn place_in(body: &RigidBody, time: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let centre = vector(body.center_of_mass()) + vector(body.linvel()) * time;
    (centre, turn_in(body, time) * rotation(*body.rotation()))
}

/// G.
struct Rows {
    rows: DMatrix<f64>,
    /// By row, its limit.
    limits: Vec<Option<Limit>>,
    /// By joint, which rows are its own.
    of_joints: Vec<JointRows>,
}

/// Returns G with `n` columns after a time (s) of the present motion.
fn constraint_rows(
    world: &PhysicsWorld,
    joints: &[ChainJoint],
    n: usize,
    predicts_loads: bool,
    time: f64,
) -> Option<Rows> {
    let active =
        |joint: &ImpulseJoint| if predicts_loads { limits::reached(world, joint) } else { limits::pushing(joint) };
    let held = |joint: &ImpulseJoint| joint.data.locked_axes.bits() | active(joint);
    let count: usize = joints.iter().map(|(_, joint)| held(joint).count_ones() as usize).sum();
    let mut rows = DMatrix::<f64>::zeros(count, n);
    let mut found: Vec<Option<Limit>> = Vec::with_capacity(count);
    let mut of_joints = Vec::with_capacity(joints.len());
    for (ends, joint) in joints {
        let (a, b) = (world.bodies.get(joint.body1())?, world.bodies.get(joint.body2())?);
        let places = [place_in(a, time), place_in(b, time)];
        let basis = (places[0].1 * rotation(joint.data.local_frame1.rotation)).to_rotation_matrix();
        let at = vector(joint.data.local_frame2.translation - b.local_center_of_mass());
        let point = places[1].0 + places[1].1 * at;
        let held = held(joint);
        of_joints.push(JointRows {
            first: found.len(),
            count: held.count_ones() as usize,
            directions: if is_stiff(joint) { (held & 0b111).count_ones() as usize } else { 0 },
            arm: arm(a, b, joint),
        });
        for axis in (0..6).filter(|axis| held & (1 << axis) != 0) {
            let row = found.len();
            let along = basis.matrix().column(axis % 3).into_owned();
            for (index, (centre, _), sign) in [(ends[0], places[0], -1.0), (ends[1], places[1], 1.0)] {
                let Some(index) = index else { continue };
                let (linear, angular) =
                    if axis < 3 { (along, (point - centre).cross(&along)) } else { (Vector3::zeros(), along) };
                for x in 0..3 {
                    rows[(row, 6 * index + x)] = sign * linear[x];
                    rows[(row, 6 * index + 3 + x)] = sign * angular[x];
                }
            }
            let limited =
                joint.data.locked_axes.bits() & (1 << axis) == 0 && !limits::hold_both_sides(&joint.data.limits[axis]);
            found.push(limited.then(|| {
                if predicts_loads {
                    Limit { side: limits::nearest_side(world, joint, axis), impulse: 0.0 }
                } else {
                    let impulse = -f64::from(joint.data.limits[axis].impulse);
                    Limit { side: impulse.signum(), impulse }
                }
            }));
        }
    }
    Some(Rows { rows, limits: found, of_joints })
}
