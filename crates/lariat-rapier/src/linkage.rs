//! Bodies that joints hold: what a body feels of the others that it moves with, and how it is struck.
//!
//! ```text
//! L = (W + e S)^-1      L x'' = f + L a0      v += R p,  or of a multibody  u += R p
//! ```
//!
//! W is the mobility of the body in its mechanism, R how all that it moves with answers an impulse on it, a0 its acceleration by the loads on the
//! others (`mechanism`, `bear`). L is the inertia with which it answers a cable; S, the mobility of the body alone, times e
//! makes it as good as immovable where joints hold it. p is an impulse and its moment about the centre of mass, u the generalised velocity.
//!
//! Rapier overwrites the velocities of links by those of u, so what is to be given to a link has to be given to u; and it leaves in a
//! link the velocity of the last substep but one. A body of a chain that is given a velocity alone would be stopped by its neighbours.
//! *Source.* Khatib 1987. *Validity.* Stiff joints. Motors and contacts are learnt, and what comes of rates (centripetal forces). Two held
//! bodies of one mechanism know of each other only through what they learn.
//!
//! *Learning.* What a body deviates by from its prediction tells of a force `D W D` times it, D = (W + c S)^-1. With c = e, near a singular
//! configuration (a straight arm with free elbows moves along itself only by its bends, W is some e there) an error of a joint of 1e-6 m reads
//! as 1e3 N: such an arm, struck, blew up within ten steps, its rope's step refused. So c is 0.1 where nothing but joints is near; with
//! 0.01 it holds as well, with 1e-3 one of six runs was refused.
//!
//! *Rejected.* The body as a free one that learns the inertia of the others as
//! a force: the lag of the learning pumps energy where the step resolves the cable's vibration (an arm of three links of 1 kg on
//! a soft rope rings by 130 N at 1/240 s). Rapier's softness of a joint in the matrix: what is learnt along held axes then feeds on itself.
//! Learning nothing at all where nothing but joints is near: motors are not foreseen.

use crate::bear::Borne;
use crate::convert::{to_vector, vector};
use crate::mechanism::{chain, link, multibody};
use ::nalgebra::{DMatrix, DVector, Matrix6, Vector3, Vector6};
use lariat_ancf::island::RigidBody;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{AngVector, Real, Vector};
use rapier::pipeline::PhysicsWorld;

/// Share of its own mobility that a body keeps along what its joints hold.
const YIELD: f64 = 1e-4;
/// ... and c of the learning where no other body is near.
const CLEAR: f64 = 0.1;

/// What a body moves with.
#[derive(Clone, Debug)]
pub(crate) enum Linkage {
    /// It is a link of a multibody: how the generalised velocity answers an impulse, and what it was before.
    Link { response: DMatrix<Real>, before: Vec<Real>, borne: Borne },
    /// Impulse joints hold it.
    Chain(Chain),
}

/// Bodies held together by impulse joints.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// The body itself first.
    pub bodies: Vec<RigidBodyHandle>,
    /// R, 6 rows per body.
    pub response: DMatrix<f64>,
    /// Their velocities before they were struck.
    pub before: Vec<(Vector, AngVector)>,
    pub borne: Borne,
}

impl Linkage {
    /// The loads on the others.
    pub fn borne(&self) -> &Borne {
        match self {
            Linkage::Link { borne, .. } | Linkage::Chain(Chain { borne, .. }) => borne,
        }
    }
}

/// Velocity before angular velocity in one vector.
pub(crate) fn both(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

/// The two halves of such a vector.
pub(crate) fn halves(v: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]))
}

/// Inertia of a body alone, in world axes.
fn own(body: &RigidBody) -> Matrix6<f64> {
    let mut inertia = Matrix6::identity() * body.mass;
    inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&body.world_inertia(&body.rotation));
    inertia
}

/// Inertia of a body with what it carries, in world axes.
pub(crate) fn inertia(body: &RigidBody) -> Matrix6<f64> {
    body.carried.map_or_else(|| own(body), |carried| own(body) + carried)
}

/// What of a force and torque on a body moves it: joints hold against the rest.
pub(crate) fn moving(body: &RigidBody, load: &Vector6<f64>) -> Vector6<f64> {
    let (total, own) = (inertia(body), own(body));
    let held = own.try_inverse().and_then(|own| Some(total * (total.try_inverse()? - own * YIELD)));
    held.map_or(*load, |share| share * load)
}

/// The impulse on a body that a deviation of its velocities tells of. `clear`: nothing but joints is near.
pub(crate) fn told(body: &RigidBody, deviation: &Vector6<f64>, clear: bool) -> Vector6<f64> {
    let (total, own) = (inertia(body), own(body));
    let found = own.try_inverse().and_then(|own| {
        let mobility = total.try_inverse()? - own * YIELD;
        let inertia = (mobility + own * if clear { CLEAR } else { YIELD }).try_inverse()?;
        Some(inertia * mobility * inertia)
    });
    found.map_or_else(Vector6::zeros, |share| share * deviation)
}

/// What a body moves with, what it carries of it beyond its own inertia, and what force and torque the loads on the others are to it; none
/// if it moves alone. `load` is the force and torque that it will be struck with over the step (N, N m): it decides whether limits
/// still push. `substep` in s. `held` tells of bodies that cables hold.
pub(crate) fn find(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    body: &RigidBody,
    load: &Vector6<f64>,
    substep: f64,
    held: &dyn Fn(RigidBodyHandle) -> bool,
) -> Option<(Linkage, Matrix6<f64>, Vector6<f64>)> {
    let (linkage, mobility, free) = if world.multibody_joints.rigid_body_link(handle).is_some() {
        let (multibody, id) = multibody(world, handle)?;
        link(world, multibody, id, load, held)?
    } else {
        let chain = chain(world, handle, load, substep, held)?;
        let mobility = chain.response.fixed_view::<6, 6>(0, 0).into_owned();
        let free = chain.borne.free.fixed_rows::<6>(0).into_owned();
        (Linkage::Chain(chain), mobility, free)
    };
    let (mobility, own) = ((mobility + mobility.transpose()) * 0.5, own(body));
    let total = (mobility + own.try_inverse()? * YIELD).try_inverse()?;
    let force = total * free;
    let finite = total.iter().chain(force.iter()).all(|x| x.is_finite());
    finite.then_some((linkage, total - own, force))
}

/// Gives the bodies of a link's multibody the velocities of its generalised velocity; does nothing for others.
pub(crate) fn refresh(world: &mut PhysicsWorld, handle: RigidBodyHandle) {
    let Some(link) = world.multibody_joints.rigid_body_link(handle) else { return };
    let Some(multibody) = world.multibody_joints.get_multibody(link.multibody) else { return };
    for id in 0..multibody.num_links() {
        let (Some(link), jacobian) = (multibody.link(id), multibody.body_jacobian(id)) else { continue };
        let Some(body) = world.bodies.get_mut(link.rigid_body_handle()) else { continue };
        if jacobian.ncols() == multibody.ndofs() && body.is_dynamic() {
            let v = jacobian * multibody.generalized_velocity();
            let (linear, angular) = halves(&v.map(f64::from));
            body.set_linvel(to_vector(&linear), false);
            body.set_angvel(to_vector(&angular), false);
        }
    }
}

/// Strikes a body with an impulse and its moment: all that it moves with follows.
pub(crate) fn strike(world: &mut PhysicsWorld, handle: RigidBodyHandle, linkage: &Linkage, impulse: &Vector6<f64>) {
    let change = match linkage {
        Linkage::Link { response, .. } => response.map(f64::from) * impulse,
        Linkage::Chain(chain) => &chain.response * impulse,
    };
    apply(world, handle, linkage, &change);
}

/// Changes the velocities of all that a body moves with.
fn apply(world: &mut PhysicsWorld, handle: RigidBodyHandle, linkage: &Linkage, change: &DVector<f64>) {
    match linkage {
        Linkage::Link { .. } => {
            let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else { return };
            if let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) {
                let mut velocity = multibody.generalized_velocity_mut();
                velocity.iter_mut().zip(change).for_each(|(u, change)| *u += *change as Real);
            }
            refresh(world, handle);
        }
        Linkage::Chain(chain) => {
            for (i, handle) in chain.bodies.iter().enumerate() {
                let Some(body) = world.bodies.get_mut(*handle) else { continue };
                let (linear, angular) = halves(&change.fixed_rows::<6>(6 * i).into_owned());
                body.set_linvel(to_vector(&(vector(body.linvel()) + linear)), false);
                body.set_angvel(to_vector(&(vector(body.angvel()) + angular)), false);
            }
        }
    }
}

/// Gives all that it moves with what the loads on the others do in `time` (s).
pub(crate) fn load_others(world: &mut PhysicsWorld, handle: RigidBodyHandle, linkage: &Linkage, time: f64) {
    if linkage.borne().bodies.is_empty() {
        return;
    }
    let change = &linkage.borne().free * time;
    apply(world, handle, linkage, &change);
}

/// Undoes the first strike of a step.
pub(crate) fn take_back(world: &mut PhysicsWorld, handle: RigidBodyHandle, linkage: &Linkage) {
    match linkage {
        Linkage::Link { before, .. } => {
            let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else { return };
            if let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) {
                multibody.generalized_velocity_mut().iter_mut().zip(before).for_each(|(u, before)| *u = *before);
            }
            refresh(world, handle);
        }
        Linkage::Chain(chain) => {
            for (handle, (linvel, angvel)) in chain.bodies.iter().zip(&chain.before) {
                if let Some(body) = world.bodies.get_mut(*handle) {
                    body.set_linvel(*linvel, false);
                    body.set_angvel(*angvel, false);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Remembered, read};
    use rapier::prelude::*;

    /// Two boxes of 2 and 3 kg, turned and apart, welded.
    fn pair(multibody: bool) -> (PhysicsWorld, [RigidBodyHandle; 2]) {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let turned = Vector::new(0.3, -0.2, 0.5);
        let mut add = |at: Vector, mass: Real| {
            let body = RigidBodyBuilder::dynamic().translation(at).rotation(turned).can_sleep(false);
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

    /// What a body of a welded pair carries is the other's inertia about it, and what the other's weight is to it its weight and its moment: of
    /// impulse joints and of a multibody, either body of the pair.
    ///
    /// *Source.* The parallel-axis formula, and statics; the yield of joints is taken out again. Bound: single precision.
    #[test]
    fn a_welded_body_carries_the_inertia_and_the_weight_of_the_other() {
        for (multibody, first) in [(false, 0), (false, 1), (true, 0), (true, 1)] {
            let (mut world, boxes) = pair(multibody);
            let (here, there) = (boxes[first], boxes[1 - first]);
            world.gravity = Vector::new(0.0, -9.81, 0.0);
            let [one, two] = [here, there].map(|b| read(&world, b, &Remembered::new(b), 0.0).unwrap());
            let (_, carried, load) = find(&world, here, &one, &Vector6::zeros(), 1e-3, &|_| false).unwrap();
            let answer = (own(&one) + carried).try_inverse().unwrap();
            let stiff = (answer - own(&one).try_inverse().unwrap() * YIELD).try_inverse().unwrap();
            let (carried, load) = (stiff - own(&one), stiff * answer * load);
            let arm = two.position - one.position;
            let mut expected = Matrix6::identity() * two.mass;
            let lever = arm.cross_matrix() * two.mass;
            expected.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever);
            expected.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
            let inertia = two.world_inertia(&two.rotation) - lever * arm.cross_matrix();
            expected.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
            let off = (carried - expected).norm() / expected.norm();
            let weight = both(&two.force, &arm.cross(&two.force));
            let off_load = (load - weight).norm() / weight.norm();
            println!("multibody {multibody}, body {first}: {off:.1e}, {off_load:.1e}");
            assert!(off < 1e-4 && off_load < 1e-4, "multibody {multibody}, body {first}: {carried} {expected} {load}");
        }
    }
}
