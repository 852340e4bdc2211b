//! Bodies that joints hold: what a body feels of the others that it moves with, and how it is struck.
//!
//! ```text
//! link of a multibody   W = J M^-1 J^T                        u += M^-1 J^T p
//! impulse joints        R = M^-1 E - M^-1 G^T (G M^-1 G^T)^-1 G M^-1 E,   W = E^T R    v += R p
//!                       L = (W + e S)^-1
//! ```
//!
//! J is a link's Jacobian (velocity of its centre of mass before angular velocity), M the mass matrix, u the generalised velocity:
//! Rapier's. For impulse joints M holds the masses of all bodies that joints connect, G the rows of the locked axes and of the limits that
//! push, E picks the body. W is its mobility, L the inertia with which it answers a cable; S, the mobility of the body alone, times e
//! makes it as good as immovable where joints hold it. p is an impulse and its moment about the centre of mass. A limit pushes if it
//! did in Rapier's last substep, and would with the load of the cable added.
//!
//! Rapier overwrites the velocities of links by those of u, so what is to be given to a link has to be given to u; and it leaves in a
//! link the velocity of the last substep but one. A body of a chain that is given a velocity alone would be stopped by its neighbours.
//! *Source.* Khatib 1987; Featherstone 2008, section 3.2; Udwadia & Kalaba 1992. *Validity.* Stiff joints. Motors, contacts, and limits
//! of a multibody (Rapier does not say what they push with) are learnt. Two held bodies of one mechanism know of each other only through what they learn. Not with kinematic joints of
//! a multibody: Rapier's mass matrix is then a part of it. *Rejected.* The body as a free one that learns the inertia of the others as
//! a force: the lag of the learning pumps energy where the step resolves the cable's vibration (an arm of three links of 1 kg on
//! a soft rope rings by 130 N at 1/240 s). Rapier's softness of a joint in the matrix: what is learnt along held axes then feeds on itself.

use crate::convert::{rotation, to_vector, vector};
use crate::impedance::is_ledger;
use ::nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};
use lariat_ancf::island::RigidBody;
use rapier::dynamics::{ImpulseJoint, Multibody, RigidBodyHandle};
use rapier::math::{AngVector, Real, Vector};
use rapier::pipeline::PhysicsWorld;

/// Share of its own mobility that a body keeps along what its joints hold.
const YIELD: f64 = 1e-4;
/// Joints may hold the same axis twice: share by which the diagonal of the matrix of their rows is raised.
const REDUNDANT: f64 = 1e-12;
/// Bodies of a chain that are looked at; those beyond count as free.
const MOST_BODIES: usize = 24;

/// What a body moves with.
#[derive(Clone, Debug)]
pub(crate) enum Linkage {
    /// It is a link of a multibody: how the generalised velocity answers an impulse, and what it was before.
    Link { response: DMatrix<Real>, before: Vec<Real> },
    /// Impulse joints hold it.
    Chain(Chain),
}

/// Bodies held together by impulse joints.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// The body itself first.
    bodies: Vec<RigidBodyHandle>,
    /// R, 6 rows per body.
    response: DMatrix<f64>,
    /// Their velocities before they were struck.
    before: Vec<(Vector, AngVector)>,
}

/// The multibody of a link and its place in it, if its mass matrix is there and whole.
fn multibody(world: &PhysicsWorld, handle: RigidBodyHandle) -> Option<(&Multibody, usize)> {
    let link = world.multibody_joints.rigid_body_link(handle)?;
    let multibody = world.multibody_joints.get_multibody(link.multibody)?;
    let n = multibody.ndofs();
    let whole = n > 0
        && multibody.body_jacobian(link.id).ncols() == n
        && multibody.inv_augmented_mass().lu_internal().nrows() == n;
    whole.then_some((multibody, link.id))
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

/// What a body moves with, and what it carries of it beyond its own inertia; none if it moves alone. `load` is the force and torque that
/// it will be struck with over the step (N, N m): it decides whether limits still push. `substep` in s.
pub(crate) fn find(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    body: &RigidBody,
    load: &Vector6<f64>,
    substep: f64,
) -> Option<(Linkage, Matrix6<f64>)> {
    let (linkage, mobility) = if world.multibody_joints.rigid_body_link(handle).is_some() {
        let (multibody, id) = multibody(world, handle)?;
        let response = response_of_link(multibody, id)?;
        let product = multibody.body_jacobian(id) * &response;
        let before = multibody.generalized_velocity().iter().copied().collect();
        (Linkage::Link { response, before }, Matrix6::from_fn(|r, c| f64::from(product[(r, c)])))
    } else {
        let chain = chain(world, handle, load, substep)?;
        let mobility = chain.response.fixed_view::<6, 6>(0, 0).into_owned();
        (Linkage::Chain(chain), mobility)
    };
    let (mobility, own) = ((mobility + mobility.transpose()) * 0.5, own(body));
    let total = (mobility + own.try_inverse()? * YIELD).try_inverse()?;
    total.iter().all(|x| x.is_finite()).then_some((linkage, total - own))
}

/// Change of the generalised velocity per impulse on a link.
fn response_of_link(multibody: &Multibody, id: usize) -> Option<DMatrix<Real>> {
    let jacobian = multibody.body_jacobian(id);
    let mut response = DMatrix::<Real>::from_fn(multibody.ndofs(), 6, |r, c| jacobian[(c, r)]);
    multibody.inv_augmented_mass().solve_mut(&mut response).then_some(response)
}

/// The bodies that impulse joints connect with a body, and how they answer an impulse on it; none if no joint holds it.
fn chain(world: &PhysicsWorld, handle: RigidBodyHandle, load: &Vector6<f64>, substep: f64) -> Option<Chain> {
    let holds = |joint: &ImpulseJoint| !joint.data.locked_axes.is_empty();
    if !world.impulse_joints.attached_enabled_joints(handle).any(|(_, _, _, joint)| holds(joint)) {
        return None;
    }
    let mut bodies = vec![handle];
    let mut joints: Vec<(Option<usize>, Option<usize>, &ImpulseJoint)> = Vec::new();
    let mut next = 0;
    while next < bodies.len() {
        for (a, b, _, joint) in world.impulse_joints.attached_enabled_joints(bodies[next]) {
            if !holds(joint) {
                continue;
            }
            let mut place = |h: RigidBodyHandle| {
                let known = bodies.iter().position(|x| *x == h);
                let moves = |b: &rapier::dynamics::RigidBody| b.is_dynamic() && !is_ledger(b);
                if known.is_none() && bodies.len() < MOST_BODIES && world.bodies.get(h).is_some_and(moves) {
                    bodies.push(h);
                    return Some(bodies.len() - 1);
                }
                known
            };
            let ends = (place(a), place(b));
            // a joint is met at each of its bodies
            if ends.0.into_iter().chain(ends.1).min() == Some(next) {
                joints.push((ends.0, ends.1, joint));
            }
        }
        next += 1;
    }
    if bodies.iter().any(|b| world.multibody_joints.rigid_body_link(*b).is_some()) {
        return None;
    }
    let n = 6 * bodies.len();
    let mut inverse = DMatrix::<f64>::zeros(n, n);
    for (i, body) in bodies.iter().enumerate() {
        let properties = world.bodies[*body].mass_properties();
        inverse
            .view_mut((6 * i, 6 * i), (3, 3))
            .copy_from(&Matrix3::from_diagonal(&vector(properties.effective_inv_mass)));
        let s = &properties.effective_world_inv_inertia;
        let spin = Matrix3::new(s.m11, s.m12, s.m13, s.m12, s.m22, s.m23, s.m13, s.m23, s.m33).map(f64::from);
        inverse.view_mut((6 * i + 3, 6 * i + 3), (3, 3)).copy_from(&spin);
    }
    let locked = |joint: &ImpulseJoint| joint.data.locked_axes.bits() | at_limit(joint);
    let rows: usize = joints.iter().map(|j| locked(j.2).count_ones() as usize).sum();
    let mut g = DMatrix::<f64>::zeros(rows, n);
    // by row, what Rapier's limit pushed with in a substep; none of a locked axis
    let mut pushes: Vec<Option<f64>> = Vec::with_capacity(rows);
    for (one, two, joint) in &joints {
        let (a, b) = (world.bodies.get(joint.body1())?, world.bodies.get(joint.body2())?);
        let (frame1, frame2) = (*a.position() * joint.data.local_frame1, *b.position() * joint.data.local_frame2);
        let (basis, point) = (rotation(frame1.rotation).to_rotation_matrix(), vector(frame2.translation));
        for axis in (0..6).filter(|axis| locked(joint) & (1 << axis) != 0) {
            let row = pushes.len();
            let along = basis.matrix().column(axis % 3).into_owned();
            for (place, body, sign) in [(one, a, -1.0), (two, b, 1.0)] {
                let Some(place) = place else { continue };
                let (linear, angular) = if axis < 3 {
                    (along, (point - vector(body.center_of_mass())).cross(&along))
                } else {
                    (Vector3::zeros(), along)
                };
                for x in 0..3 {
                    g[(row, 6 * place + x)] = sign * linear[x];
                    g[(row, 6 * place + 3 + x)] = sign * angular[x];
                }
            }
            let limit = joint.data.locked_axes.bits() & (1 << axis) == 0;
            pushes.push(limit.then(|| -f64::from(joint.data.limits[axis].impulse)));
        }
    }
    let mut response;
    loop {
        response = inverse.columns(0, 6).into_owned();
        let spread = &inverse * g.transpose();
        let mut matrix = &g * &spread;
        for i in 0..matrix.nrows() {
            // a row that nothing moves, or that was given up, holds nothing
            matrix[(i, i)] = if matrix[(i, i)] > 0.0 { matrix[(i, i)] * (1.0 + REDUNDANT) } else { 1.0 };
        }
        let back = matrix.cholesky()?.solve(&(&g * &response));
        response -= spread * &back;
        let own = back * load * -substep;
        let pulls = |i: &usize| pushes[*i].is_some_and(|push| push * (push + own[*i]) < 0.0);
        let Some(row) = (0..pushes.len()).find(pulls) else { break };
        g.row_mut(row).fill(0.0);
        pushes[row] = None;
    }
    let before = bodies.iter().map(|b| (world.bodies[*b].linvel(), world.bodies[*b].angvel())).collect();
    Some(Chain { bodies, response, before })
}

/// Axes whose limits pushed in the last substep.
fn at_limit(joint: &ImpulseJoint) -> u8 {
    let bits = joint.data.limit_axes.bits() & !joint.data.locked_axes.bits() & !joint.data.coupled_axes.bits();
    (0..6)
        .filter(|axis| bits & (1 << axis) != 0 && joint.data.limits[*axis].impulse != 0.0)
        .fold(0, |b, axis| b | 1 << axis)
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
    match linkage {
        Linkage::Link { response, .. } => {
            let change = response * impulse.map(|x| x as Real);
            let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else { return };
            if let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) {
                multibody.generalized_velocity_mut().iter_mut().zip(&change).for_each(|(u, change)| *u += change);
            }
            refresh(world, handle);
        }
        Linkage::Chain(chain) => {
            let change = &chain.response * impulse;
            for (i, handle) in chain.bodies.iter().enumerate() {
                let Some(body) = world.bodies.get_mut(*handle) else { continue };
                let (linear, angular) = halves(&change.fixed_rows::<6>(6 * i).into_owned());
                body.set_linvel(to_vector(&(vector(body.linvel()) + linear)), false);
                body.set_angvel(to_vector(&(vector(body.angvel()) + angular)), false);
            }
        }
    }
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
