//! Finds what a body moves with: a link of a multibody, or a body of a chain of impulse joints.

use super::of_body::Mechanism;
use super::request::Request;
use super::{joint_chain, multibody};
use crate::body::ledger::is_ledger;
use crate::scales::mechanism::MAX_BODIES;
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::pipeline::PhysicsWorld;

/// Returns the mechanism of a body; `None` if it moves alone.
pub(crate) fn find(world: &PhysicsWorld, request: &Request) -> Option<Mechanism> {
    if world.multibody_joints.rigid_body_link(request.handle).is_some() {
        multibody::find(world, request)
    } else {
        joint_chain::find(world, request)
    }
}

/// Returns the bodies that joints connect with one, itself included; empty if none does.
pub(crate) fn bodies(world: &PhysicsWorld, handle: RigidBodyHandle) -> Vec<RigidBodyHandle> {
    match world.multibody_joints.rigid_body_link(handle).and_then(|l| world.multibody_joints.get_multibody(l.multibody))
    {
        Some(multibody) => multibody.links().map(|link| link.rigid_body_handle()).collect(),
        None => joint_chain::bodies(world, handle),
    }
}

/// Returns whether a body moves with others by impulse joints and by those of a multibody: its
/// mobility is that of neither. Bodies beyond [`MAX_BODIES`] are not looked at.
pub(crate) fn is_mixed(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    let (mut found, mut kinds, mut next) = (vec![handle], [false; 2], 0);
    let is = |body: RigidBodyHandle, test: fn(&RigidBody) -> bool| world.bodies.get(body).is_some_and(test);
    while next < found.len().min(MAX_BODIES) {
        let body = found[next];
        let joints = world.impulse_joints.attached_enabled_joints(body);
        let held = joints.filter(|(_, _, _, joint)| !joint.data.locked_axes.is_empty());
        let held = held.flat_map(|(a, b, ..)| [a, b]).filter(|other| !is(*other, is_ledger));
        let link = world.multibody_joints.rigid_body_link(body);
        let multibody = link.and_then(|link| world.multibody_joints.get_multibody(link.multibody));
        let links = multibody.into_iter().flat_map(|multibody| multibody.links().map(|link| link.rigid_body_handle()));
        let others = held.map(|other| (other, 0)).chain(links.map(|other| (other, 1)));
        for (other, kind) in others.filter(|(other, _)| *other != body) {
            kinds[kind] = true;
            if is(other, RigidBody::is_dynamic) && !found.contains(&other) {
                found.push(other);
            }
        }
        next += 1;
    }
    kinds == [true; 2]
}

#[cfg(test)]
mod tests {
    use super::super::own_inertia;
    use super::*;
    use crate::body::read;
    use crate::body::record::BodyRecord;
    use crate::body::spatial::stack_spatial;
    use ::nalgebra::{Matrix6, Vector6};
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
    /// Reference: the parallel-axis formula, and statics. Bound: single precision.
    #[test]
    fn a_welded_body_carries_the_inertia_and_the_weight_of_the_other() {
        for (multibody, first) in [(false, 0), (false, 1), (true, 0), (true, 1)] {
            let (mut world, boxes) = welded_pair(multibody);
            let (here, there) = (boxes[first], boxes[1 - first]);
            world.gravity = Vector::new(0.0, -9.81, 0.0);
            let [one, two] = [here, there].map(|b| read(&world, b, &BodyRecord::new(b), 0.0).unwrap());
            let members = [(here, Vector6::zeros())];
            let request = Request {
                handle: here,
                members: &members,
                half_step: 1e-3,
                substep: 1e-3,
                sweeps: 1,
                is_attached: &|_| false,
            };
            let mechanism = find(&world, &request).unwrap();
            let rigid = mechanism.mobility_of(here).unwrap().try_inverse().unwrap();
            let (carried, load) = (rigid - own_inertia(&one), rigid * mechanism.loads.of_body);
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
