//! The cable's impedance inside Rapier's step: motors between a pinned body and a heavy ledger.
//!
//! D is the pin's block of (C + B')^-1: C the compliance of the body's cables over the step
//! ([`Impedance`](lariat_ancf::island::Impedance)), B' the mobility of the bodies at their pins,
//! `1/m - [r_i]x I^-1 [r_j]x`, with that of the body itself scaled by [`OWN_SHARE`]. Rapier's motor with damping d acts over its
//! substeps as the impulse `d h (target - mean velocity)`, so d = D/h on the axes of D.

use crate::attachment::{Attachment, Ledger};
use crate::convert::{to_pose, to_vector, vector};
use crate::islands::IslandStep;
use crate::linkage;
use crate::near::touches;
use ::nalgebra::{DMatrix, Matrix3, UnitQuaternion, Vector3};
use lariat_ancf::island::RigidBody;
use rapier::dynamics::{GenericJointBuilder, JointAxesMask, JointAxis, MotorModel, RigidBodyBuilder, RigidBodyHandle};
use rapier::math::{Real, Vector};
use rapier::pipeline::PhysicsWorld;

/// Mass of a ledger in kg: what it gains in a step is the impulse that passed.
const LEDGER_MASS: f64 = 1e9;
/// A junction has no mass, but the matrix must have an inverse: as light as this, in kg.
const JUNCTION_MASS: f64 = 1e-6;
/// Share of the body's own mobility in B'.
const OWN_SHARE: f64 = 0.1;
const AXES: [JointAxis; 3] = [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ];

/// Whether a body is near another, a link of a multibody, or joined to a dynamic body, so that it may deviate from its prediction and
/// has to feel the cable meanwhile. One that is joined to a fixed body does better without: Rapier's joint yields to the motors, and
/// leaves a gap of 1e-2 m at 5 kN where it leaves 4e-6 m without.
pub(crate) fn may_meet_something(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    touches(world, handle) || is_linked(world, handle)
}

/// Whether a body is the heavy end of an attachment's motors, and none of the user's.
pub(crate) fn is_ledger(body: &rapier::dynamics::RigidBody) -> bool {
    f64::from(body.mass()) >= 0.5 * LEDGER_MASS
}

/// Whether a body is a link of a multibody, or joined to a dynamic body.
pub(crate) fn is_linked(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    let dynamic =
        |b: RigidBodyHandle| b != handle && world.bodies.get(b).is_some_and(|b| b.is_dynamic() && !is_ledger(b));
    world.multibody_joints.rigid_body_link(handle).is_some()
        || world.impulse_joints.attached_enabled_joints(handle).any(|(a, b, _, _)| dynamic(a) || dynamic(b))
}

/// Whether a body is near no other, and no joint holds it but to a ledger.
pub(crate) fn is_alone(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    let ledger = |b: RigidBodyHandle| world.bodies.get(b).is_some_and(is_ledger);
    let held = world.impulse_joints.attached_joints(handle).any(|(a, b, _, _)| !ledger(a) && !ledger(b));
    !held && !may_meet_something(world, handle)
}

/// D for every pin of `island` on body `body`, by pin index.
pub(crate) fn driving_point(island: &IslandStep, body: usize) -> Vec<(usize, Matrix3<f64>)> {
    let start = &island.start;
    let cables: Vec<usize> =
        (0..island.cables.len()).filter(|&c| island.pins.iter().any(|p| p.cable == c && p.body == body)).collect();
    let near: Vec<usize> = (0..island.pins.len()).filter(|&p| cables.contains(&island.pins[p].cable)).collect();
    let n = 3 * near.len();
    let mut m = DMatrix::<f64>::zeros(n, n);
    for (a, &i) in near.iter().enumerate() {
        for (b, &j) in near.iter().enumerate() {
            let (p, q) = (&island.pins[i], &island.pins[j]);
            let mut block = Matrix3::zeros();
            if p.cable == q.cable {
                let own: Vec<usize> = (0..island.pins.len()).filter(|&k| island.pins[k].cable == p.cable).collect();
                let at = |pin: usize| 3 * own.iter().position(|&k| k == pin).expect("a pin of its own cable");
                let c = island.impedances[p.cable].compliance();
                block += c.fixed_view::<3, 3>(at(i), at(j));
            }
            if p.body == q.body {
                let share = if p.body == body { OWN_SHARE } else { 1.0 };
                block += mobility(&start[p.body], &p.anchor, &q.anchor) * share;
            }
            m.fixed_view_mut::<3, 3>(3 * a, 3 * b).copy_from(&block);
        }
    }
    let Some(inverse) = m.try_inverse() else { return Vec::new() };
    near.iter()
        .enumerate()
        .filter(|&(_, &pin)| island.pins[pin].body == body)
        .map(|(a, &pin)| (pin, inverse.fixed_view::<3, 3>(3 * a, 3 * a).into_owned()))
        .collect()
}

/// Velocity at one point of a body per impulse at another, in 1/kg.
fn mobility(body: &RigidBody, a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    let (ra, rb) = (body.rotation * a, body.rotation * b);
    if body.carried.is_some()
        && let Some(mobility) = linkage::inertia(body).try_inverse()
    {
        let mut out = Matrix3::zeros();
        let at = |r: usize, c: usize| mobility.fixed_view::<3, 3>(3 * r, 3 * c).into_owned();
        out += at(0, 0) + at(0, 1) * rb.cross_matrix();
        out -= ra.cross_matrix() * (at(1, 0) + at(1, 1) * rb.cross_matrix());
        return out;
    }
    let mass = if body.mass > 0.0 { body.mass } else { JUNCTION_MASS };
    let masked = Matrix3::from_diagonal(&Vector3::from_fn(|i, _| f64::from(u8::from(body.free[i])) / mass));
    let mut inverse = body.world_inertia(&body.rotation).try_inverse().unwrap_or_else(Matrix3::zeros);
    for x in (0..3).filter(|&x| !body.free[3 + x]) {
        inverse.row_mut(x).fill(0.0);
        inverse.column_mut(x).fill(0.0);
    }
    masked - ra.cross_matrix() * inverse * rb.cross_matrix()
}

/// Sets the motors of an attachment: impedance `d` (kg) about the velocity `target` of the anchor over `h` (s).
pub(crate) fn drive(
    world: &mut PhysicsWorld,
    attachment: &mut Attachment,
    d: &Matrix3<f64>,
    target: &Vector3<f64>,
    h: f64,
) {
    let ledger = *attachment.ledger.get_or_insert_with(|| {
        let body = world.insert_body(
            RigidBodyBuilder::dynamic().gravity_scale(0.0).additional_mass(LEDGER_MASS as Real).lock_rotations(),
        );
        let mut joint = GenericJointBuilder::new(JointAxesMask::empty());
        for axis in AXES {
            joint = joint.motor_model(axis, MotorModel::ForceBased);
        }
        Ledger { body, joint: world.insert_impulse_joint(body, attachment.body, joint) }
    });
    if let Some(body) = world.bodies.get_mut(ledger.body) {
        body.set_linvel(Vector::ZERO, false);
        body.reset_forces(false);
    }
    let eigen = ((d + d.transpose()) * 0.5).symmetric_eigen();
    let mut axes = eigen.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.column_mut(2).neg_mut();
    }
    let frame = UnitQuaternion::from_matrix(&axes);
    let wanted = frame.inverse() * target;
    if let Some(joint) = world.impulse_joints.get_mut(ledger.joint, false) {
        joint.data.set_enabled(true);
        joint.data.set_local_frame1(to_pose(&Vector3::zeros(), &frame));
        joint.data.set_local_anchor2(to_vector(&attachment.anchor));
        for (i, axis) in AXES.into_iter().enumerate() {
            let damping = eigen.eigenvalues[i].max(0.0) / h;
            joint.data.set_motor(axis, 0.0, wanted[i] as Real, 0.0, damping as Real);
        }
    }
}

/// Switches the motors of an attachment off.
pub(crate) fn idle(world: &mut PhysicsWorld, attachment: &Attachment) {
    let Some(ledger) = attachment.ledger else { return };
    if world.impulse_joints.get(ledger.joint).is_some_and(|j| j.data.is_enabled())
        && let Some(joint) = world.impulse_joints.get_mut(ledger.joint, false)
    {
        joint.data.set_enabled(false);
    }
}

/// Impulse of the motors on the body over the last step, in N s; the ledger is at rest again.
pub(crate) fn passed(world: &mut PhysicsWorld, attachment: &Attachment) -> Vector3<f64> {
    let Some(ledger) = attachment.ledger else { return Vector3::zeros() };
    let Some(body) = world.bodies.get_mut(ledger.body) else { return Vector3::zeros() };
    let impulse = -vector(body.linvel()) * LEDGER_MASS;
    body.set_linvel(Vector::ZERO, false);
    impulse
}
