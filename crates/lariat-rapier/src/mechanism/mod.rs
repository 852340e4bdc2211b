//! Mechanisms: what joints do to a body that a cable is attached to.
//!
//! A body that joints hold answers its cables with the inertia of all that it moves with, and
//! impulses on it change the velocities of all of it.
//!
//! # Equation
//! ```text
//! L = (W + e S)^-1      L x'' = f + L a0      v += R p,  or of a multibody  u += R p
//! ```
//! W is the mobility of the body in its mechanism, S that of the body alone, a0 its acceleration by
//! the loads on the other bodies ([`loads`]), and R the response of all bodies, or of the
//! generalised velocity u, to an impulse p and its moment about the centre of mass.
//!
//! # Validity
//! Stiff joints. Motors, contacts and centripetal forces enter by the reaction estimate. Two
//! attached bodies of one mechanism know of each other only by that estimate: the forces
//! of their ropes ripple, by up to 0.39 of their sum about the right mean (tests, arms.rs).
//!
//! # References
//! Khatib 1987, the operational space inertia.
//!
//! # Alternatives considered
//! The body as a free one, with the inertia of the others as a part of the reaction estimate: the
//! estimate lags, which adds energy where the step resolves the vibration of the cable (an arm of
//! three links of 1 kg on a soft rope oscillates by 130 N at 1/240 s). Rapier's softness of joints
//! in the matrix: the estimate along held axes then feeds on itself. No estimate where a mechanism
//! touches nothing: motors are then not predicted.

mod constraints;
mod inertia;
mod joint_chain;
mod limits;
mod loads;
mod multibody;
mod request;

pub(crate) use inertia::{implied_impulse, inertia, unconstrained_part};
pub(crate) use multibody::{prepare, refresh};
pub(crate) use request::Request;

use ::nalgebra::{Matrix6, Vector6};
use inertia::{JOINT_COMPLIANCE, own_inertia};
use joint_chain::JointChain;
use loads::CarriedLoads;
use multibody::MultibodyLink;
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// The bodies that a body moves with.
#[derive(Clone, Debug)]
pub(crate) struct Mechanism {
    kind: MechanismKind,
    pub loads: CarriedLoads,
}

/// What holds a mechanism together.
#[derive(Clone, Debug)]
enum MechanismKind {
    /// The body is a link of a multibody.
    Multibody(MultibodyLink),
    /// Impulse joints hold it.
    JointChain(JointChain),
}

/// The mechanism of a body, and its effect on the body.
pub(crate) struct Found {
    pub mechanism: Mechanism,
    /// Inertia beyond the body's own.
    pub carried: Matrix6<f64>,
    /// Force and torque on the body by the loads on the other bodies.
    pub load: Vector6<f64>,
}

/// Returns the mechanism of a body; `None` if it moves alone.
pub(crate) fn find(world: &PhysicsWorld, request: &Request) -> Option<Found> {
    let (kind, loads, mobility) = if world.multibody_joints.rigid_body_link(request.handle).is_some() {
        let (link, loads, mobility) = multibody::find(world, request)?;
        (MechanismKind::Multibody(link), loads, mobility)
    } else {
        let (chain, loads, mobility) = joint_chain::find(world, request)?;
        (MechanismKind::JointChain(chain), loads, mobility)
    };
    let (mobility, own) = ((mobility + mobility.transpose()) * 0.5, own_inertia(request.body));
    let total = (mobility + own.try_inverse()? * JOINT_COMPLIANCE).try_inverse()?;
    let load = total * loads.of_body;
    let finite = total.iter().chain(load.iter()).all(|x| x.is_finite());
    finite.then(|| Found { mechanism: Mechanism { kind, loads }, carried: total - own, load })
}

impl Mechanism {
    /// Returns whether the body is a link of a multibody.
    pub fn is_multibody(&self) -> bool {
        matches!(self.kind, MechanismKind::Multibody(_))
    }

    /// Applies an impulse and its moment to the body; all that it moves with follows.
    pub fn apply_impulse(&self, world: &mut PhysicsWorld, handle: RigidBodyHandle, impulse: &Vector6<f64>) {
        match &self.kind {
            MechanismKind::Multibody(link) => link.change_velocity(world, handle, &link.velocity_change(impulse)),
            MechanismKind::JointChain(chain) => chain.change_velocity(world, &chain.velocity_change(impulse)),
        }
    }

    /// Applies the change of velocity by the loads on the other bodies in `time` (s).
    pub fn apply_loads(&self, world: &mut PhysicsWorld, handle: RigidBodyHandle, time: f64) {
        if self.loads.bodies.is_empty() {
            return;
        }
        let change = &self.loads.accelerations * time;
        match &self.kind {
            MechanismKind::Multibody(link) => link.change_velocity(world, handle, &change),
            MechanismKind::JointChain(chain) => chain.change_velocity(world, &change),
        }
    }

    /// Restores the velocities before the step.
    pub fn revert(&self, world: &mut PhysicsWorld, handle: RigidBodyHandle) {
        match &self.kind {
            MechanismKind::Multibody(link) => link.revert(world, handle),
            MechanismKind::JointChain(chain) => chain.revert(world),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::read;
    use crate::record::BodyRecord;
    use crate::spatial::stack_spatial;
    use rapier::prelude::*;

    /// Returns two boxes of 2 and 3 kg, rotated and apart, welded to each other.
    fn welded_pair(multibody: bool) -> (PhysicsWorld, [RigidBodyHandle; 2]) {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let rotated = Vector::new(0.3, -0.2, 0.5);
        let mut add = |at: Vector, mass: Real| {
            let body = RigidBodyBuilder::dynamic().translation(at).rotation(rotated).can_sleep(false);
            world.insert(body, ColliderBuilder::cuboid(0.1, 0.2, 0.3).mass(mass)).0
        };
        let boxes = [add(Vector::new(1.0, 2.0, 0.0), 2.0), add(Vector::new(2.0, 2.5, -0.7), 3.0)];
        let between = world.bodies[boxes[0]].position().inverse() * *world.bodies[boxes[1]].position();
        let weld = FixedJointBuilder::new().local_frame1(between);
        if multibody {
            world.insert_multibody_joint(boxes[0], boxes[1], weld).unwrap();
        } else {
            world.insert_impulse_joint(boxes[0], boxes[1], weld);
        }
        world.step();
        (world, boxes)
    }

    /// Of a welded pair, what a body carries is the other's inertia about it, and the load on it is
    /// the other's weight with its moment; for impulse joints and a multibody, either body of the
    /// pair.
    ///
    /// Reference: the parallel-axis formula, and statics; the compliance of joints is taken out
    /// again. Bound: single precision.
    #[test]
    fn a_welded_body_carries_the_inertia_and_the_weight_of_the_other() {
        for (multibody, first) in [(false, 0), (false, 1), (true, 0), (true, 1)] {
            let (mut world, boxes) = welded_pair(multibody);
            let (here, there) = (boxes[first], boxes[1 - first]);
            world.gravity = Vector::new(0.0, -9.81, 0.0);
            let [one, two] = [here, there].map(|b| read(&world, b, &BodyRecord::new(b), 0.0).unwrap());
            let load = Vector6::zeros();
            let request = Request { handle: here, body: &one, load, substep: 1e-3, is_attached: &|_| false };
            let Found { carried, load, .. } = find(&world, &request).unwrap();
            let mobility = (own_inertia(&one) + carried).try_inverse().unwrap();
            let rigid = mobility - own_inertia(&one).try_inverse().unwrap() * JOINT_COMPLIANCE;
            let rigid = rigid.try_inverse().unwrap();
            let (carried, load) = (rigid - own_inertia(&one), rigid * mobility * load);
            let arm = two.position - one.position;
            let mut expected = Matrix6::identity() * two.mass;
            let lever = arm.cross_matrix() * two.mass;
            expected.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever);
            expected.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
            let inertia = two.world_inertia(&two.rotation) - lever * arm.cross_matrix();
            expected.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
            let inertia_error = (carried - expected).norm() / expected.norm();
            let weight = stack_spatial(&two.force, &arm.cross(&two.force));
            let load_error = (load - weight).norm() / weight.norm();
            let case = format!("multibody {multibody}, body {first}: {inertia_error:.1e}, {load_error:.1e}");
            assert!(inertia_error < 1e-4 && load_error < 1e-4, "{case}: {carried} {expected} {load}");
        }
    }
}
