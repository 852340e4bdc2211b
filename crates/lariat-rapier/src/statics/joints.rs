//! Rapier's joints in statics: the coordinates that they hold, and the bodies that they join.
//!
//! # Validity
//! Impulse joints of any axes with their limits, rope joints, and joints of multibodies. A motor
//! that drives, a spring, limits of coupled angles and coupled joints are refused. A motor that
//! only damps does nothing at rest.

use crate::body::is_integrated;
use crate::body::ledger::is_ledger;
use crate::convert::{rotation, vector};
use crate::error::Error;
use crate::islands::{Island, Member};
use ::nalgebra::Vector3;
use lariat_ancf::island::{FREE, JointFrame, StaticJoint};
use rapier::dynamics::{GenericJoint, JointAxesMask, RigidBodyHandle};
use rapier::math::Pose;
use rapier::pipeline::PhysicsWorld;
use rapier::prelude::SpringCoefficients;

/// A joint of either kind: its bodies, and what it holds.
struct Joint<'a> {
    bodies: [RigidBodyHandle; 2],
    data: &'a GenericJoint,
    /// Why statics do not know it, if it is of a multibody.
    refused: Option<&'static str>,
}

/// Returns the joints between two bodies other than those of cables.
fn joints(world: &PhysicsWorld) -> impl Iterator<Item = Joint<'_>> {
    let ledger = |body| world.bodies.get(body).is_some_and(is_ledger);
    let impulse = world.impulse_joints.iter().map(|(_, joint)| joint);
    let impulse = impulse.filter(|joint| joint.data.is_enabled());
    let impulse = impulse.map(|j| Joint { bodies: [j.body1(), j.body2()], data: &j.data, refused: None });
    let multibody = world.multibody_joints.multibodies().flat_map(|multibody| {
        let coupled = (!multibody.couplings().is_empty()).then_some("joints of its multibody are coupled");
        multibody.links().filter_map(move |link| {
            let (parent, joint) = (multibody.link(link.parent_id()?)?, link.joint());
            let sprung = (0..6).any(|axis| joint.spring(axis).0 != 0.0).then_some("a joint has a spring");
            let bodies = [parent.rigid_body_handle(), link.rigid_body_handle()];
            Some(Joint { bodies, data: &joint.data, refused: coupled.or(sprung) })
        })
    });
    impulse.chain(multibody).filter(move |joint| !joint.bodies.into_iter().any(ledger))
}

/// Returns the islands of a world with the integrated bodies that joints connect to theirs; those
/// that joints connect become one.
pub(super) fn joined(world: &PhysicsWorld, islands: &[Island]) -> Vec<Island> {
    let mut out: Vec<Island> = Vec::new();
    for island in islands {
        let mut island = island.clone();
        let mut next = 0;
        while next < island.members.len() {
            let Member::Body(body) = island.members[next] else {
                next += 1;
                continue;
            };
            next += 1;
            for joint in joints(world).filter(|joint| joint.bodies.contains(&body)) {
                for other in joint.bodies.into_iter().filter(|b| is_integrated(world, *b)) {
                    if !island.members.contains(&Member::Body(other)) {
                        island.members.push(Member::Body(other));
                    }
                }
            }
        }
        let shares = |other: &Island| island.bodies().any(|body| other.members.contains(&Member::Body(body)));
        match out.iter().position(shares) {
            Some(known) => out[known].join(island),
            None => out.push(island),
        }
    }
    out
}

/// Returns the joints of an island.
pub(super) fn of_island(world: &PhysicsWorld, island: &Island) -> Result<Vec<StaticJoint>, Error> {
    let place = |body: RigidBodyHandle| island.members.iter().position(|member| *member == Member::Body(body));
    let mut out = Vec::new();
    for joint in joints(world) {
        let Joint { bodies, data, refused: unknown } = joint;
        let places = bodies.map(place);
        let Some(body) = places.iter().zip(bodies).find_map(|(place, body)| place.map(|_| body)) else { continue };
        let [first, second] = [(bodies[0], data.local_frame1), (bodies[1], data.local_frame2)];
        let refused = |reason| Error::JointInStatics { body, reason };
        unknown.map_or(Ok(()), |reason| Err(refused(reason)))?;
        out.push(StaticJoint {
            bodies: places,
            frames: [frame(world, places[0], first)?, frame(world, places[1], second)?],
            ..bounds(data).map_err(refused)?
        });
    }
    Ok(out)
}

/// Returns a frame of a joint, in the world if its body is no member.
fn frame(
    world: &PhysicsWorld,
    member: Option<usize>,
    (body, frame): (RigidBodyHandle, Pose),
) -> Result<JointFrame, Error> {
    let body = world.bodies.get(body).ok_or(Error::NoBody(body))?;
    let (local, axes) = (vector(frame.translation), rotation(frame.rotation));
    let attitude = rotation(*body.rotation());
    Ok(match member {
        Some(_) => JointFrame { position: local - vector(body.local_center_of_mass()), rotation: axes },
        None => JointFrame { position: vector(body.translation()) + attitude * local, rotation: attitude * axes },
    })
}

/// Returns the bounds of a joint's coordinates, without bodies and frames, or why it is refused.
fn bounds(joint: &GenericJoint) -> Result<StaticJoint, &'static str> {
    let has = |axes: JointAxesMask, axis: usize| axes.bits() & (1 << axis) != 0;
    let drives = |axis: usize| {
        let motor = &joint.motors[axis];
        motor.stiffness != 0.0 || motor.target_vel != 0.0 && motor.damping != 0.0
    };
    if (0..6).any(|axis| has(joint.motor_axes, axis) && !has(joint.locked_axes, axis) && drives(axis)) {
        return Err("the motor of a joint drives it");
    }
    if joint.softness != SpringCoefficients::joint_defaults() {
        return Err("a joint is a spring");
    }
    let coupled = |axis: usize| has(joint.coupled_axes, axis) && has(joint.limit_axes, axis);
    if (3..6).any(coupled) {
        return Err("a joint limits coupled angles");
    }
    let mut distance = f64::INFINITY;
    if let Some(axis) = (0..3).find(|&axis| coupled(axis)) {
        let limits = &joint.limits[axis];
        if limits.min > 0.0 || !(0..3).all(|axis| has(joint.coupled_axes, axis)) {
            return Err("a joint limits a distance that is not that of a rope");
        }
        distance = f64::from(limits.max);
    }
    let of = |axis: usize| {
        let limits = &joint.limits[axis];
        if has(joint.locked_axes, axis) {
            [0.0; 2]
        } else if has(joint.limit_axes, axis) && !has(joint.coupled_axes, axis) {
            [f64::from(limits.min), f64::from(limits.max)]
        } else {
            FREE
        }
    };
    let none = JointFrame { position: Vector3::zeros(), ..JointFrame::default() };
    let (along, about) = ([of(0), of(1), of(2)], [of(3), of(4), of(5)]);
    Ok(StaticJoint { bodies: [None; 2], frames: [none; 2], along, about, distance })
}

/// Returns whether a joint keeps two bodies from touching.
pub(super) fn keep_apart(world: &PhysicsWorld, one: RigidBodyHandle, other: RigidBodyHandle) -> bool {
    let joined = |bodies: &[RigidBodyHandle; 2]| bodies.contains(&one) && bodies.contains(&other);
    joints(world).any(|joint| !joint.data.contacts_enabled && joined(&joint.bodies))
}
