//! How a mechanism answers: the bodies that joints connect with one that a cable holds.
//!
//! ```text
//! link of a multibody   W = J R,    R = P M^-1 J^T,   a = P M^-1 sum J_i^T f_i         P = 1 - M^-1 G^T (G M^-1 G^T)^-1 G
//! impulse joints        W = E^T R,  R = P M^-1 E,     a = P M^-1 f
//! ```
//!
//! J is a link's Jacobian (velocity of its centre of mass before angular velocity), M the mass matrix: Rapier's. For impulse joints M holds the
//! masses of all bodies that joints connect, G the rows of the locked axes, E picks the body. Limits that hold add rows to G, those of a
//! multibody a unit vector each. A limit holds if its joint stands there (`limits`), and the loads would push against it, the cable's of the last
//! step included. f are the loads on the other bodies where they are borne (`bear`); where not, the limits of impulse joints hold that pushed in Rapier's last
//! substep and would with the cable added, and those of a multibody are learnt.
//!
//! *Source.* Featherstone 2008, section 3.2; Udwadia & Kalaba 1992. *Validity.* Not with kinematic joints of a multibody: Rapier's mass matrix
//! is then a part of it.

use crate::bear::{Borne, alone, bears, put_aside};
use crate::convert::{rotation, vector};
use crate::impedance::is_ledger;
use crate::limits;
use crate::linkage::{Chain, Linkage};
use ::nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Vector3, Vector6};
use rapier::dynamics::{ImpulseJoint, Multibody, RigidBodyHandle};
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Joints may hold the same axis twice: share by which the diagonal of the matrix of their rows is raised.
const REDUNDANT: f64 = 1e-12;
/// Bodies of a chain that are looked at; those beyond count as free.
const MOST_BODIES: usize = 24;

/// The multibody of a link and its place in it, if its mass matrix is there and whole.
pub(crate) fn multibody(world: &PhysicsWorld, handle: RigidBodyHandle) -> Option<(&Multibody, usize)> {
    let link = world.multibody_joints.rigid_body_link(handle)?;
    let multibody = world.multibody_joints.get_multibody(link.multibody)?;
    let n = multibody.ndofs();
    let whole = n > 0
        && multibody.body_jacobian(link.id).ncols() == n
        && multibody.inv_augmented_mass().lu_internal().nrows() == n;
    whole.then_some((multibody, link.id))
}

/// Has Rapier reckon the mass matrix of a link's multibody, if it has not since joints changed.
pub(crate) fn prepare(world: &mut PhysicsWorld, handle: RigidBodyHandle) {
    let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else { return };
    let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) else { return };
    let n = multibody.ndofs();
    // with kinematic joints the matrix is never whole
    let missing =
        multibody.body_jacobian(link.id).ncols() != n || multibody.inv_augmented_mass().lu_internal().is_empty();
    if n > 0 && missing {
        multibody.dof_inverse_inertia(&world.bodies);
    }
}

/// How a multibody answers an impulse on a link, the mobility of the link, and its acceleration by the loads on the others.
pub(crate) fn link(
    world: &PhysicsWorld,
    multibody: &Multibody,
    id: usize,
    load: &Vector6<f64>,
    held: &dyn Fn(RigidBodyHandle) -> bool,
) -> Option<(Linkage, Matrix6<f64>, Vector6<f64>)> {
    let n = multibody.ndofs();
    let jacobian = |id: usize| multibody.body_jacobian(id).map(f64::from);
    let inverse = |b: &DMatrix<f64>| {
        let mut x = b.map(|x| x as Real);
        multibody.inv_augmented_mass().solve_mut(&mut x).then(|| x.map(f64::from))
    };
    let handles: Vec<RigidBodyHandle> = multibody.links().map(|l| l.rigid_body_handle()).collect();
    let moves = |i: &usize| *i != id && world.bodies.get(handles[*i]).is_some_and(|b| b.is_dynamic());
    let bears = bears(world, &handles, handles[id], held);
    let (mut borne, mut loads) = (Borne::default(), DVector::<f64>::zeros(n));
    for i in (0..handles.len()).filter(|i| bears && moves(i)) {
        let (aside, force) = put_aside(world, handles[i]);
        borne.bodies.push(aside);
        loads += jacobian(i).transpose() * force;
    }
    let own = jacobian(id);
    // limits at which a joint stands
    let (mut rows, mut sides) = (Vec::new(), Vec::new());
    let velocity = multibody.generalized_velocity();
    for link in multibody.links().filter(|_| bears) {
        let data = &link.joint.data;
        let free = |axis: usize| data.locked_axes.bits() & (1 << axis) == 0;
        let turns = (3..6).filter(|x| free(*x)).count();
        let bits = data.limit_axes.bits();
        for (dof, axis) in (link.assembly_id()..).zip((0..6).filter(|x| free(*x))) {
            if bits & (1 << axis) != 0 && (axis < 3 || turns == 1) {
                let at = f64::from(link.joint.coords()[axis]);
                if let Some(side) = limits::side(at, &data.limits[axis], f64::from(velocity[dof])) {
                    rows.push(dof);
                    sides.push(Some((side, 0.0)));
                }
            }
        }
    }
    let mut g = DMatrix::<f64>::zeros(rows.len(), n);
    rows.iter().enumerate().for_each(|(i, dof)| g[(i, *dof)] = 1.0);
    let spread = inverse(&g.transpose())?;
    let columns = inverse(&DMatrix::from_iterator(n, 6, own.transpose().iter().copied()))?;
    let free = inverse(&DMatrix::from_column_slice(n, 1, loads.as_slice()))?;
    let all = &free + &columns * DMatrix::from_column_slice(6, 1, load.as_slice());
    let (response, free) = constrain(g, spread, sides, columns, free, &all, 1.0)?;
    let mobility = Matrix6::from_iterator((&own * &response).iter().copied());
    let of_body = Vector6::from_iterator((&own * &free).iter().copied());
    borne.free = free.column(0).into_owned();
    borne.of_body = of_body;
    borne.quiet = !borne.bodies.is_empty() && alone(world, &handles, handles[id]);
    let before = multibody.generalized_velocity().iter().copied().collect();
    Some((Linkage::Link { response: response.map(|x| x as Real), before, borne }, mobility, of_body))
}

/// `P columns` and `P free`, with P of the rows of `g` that hold. `spread` is M^-1 G^T, `all` the accelerations by all loads, `sides` tells by
/// row to which side a limit pushes and with what it did, in N s; none of a locked axis.
fn constrain(
    mut g: DMatrix<f64>,
    mut spread: DMatrix<f64>,
    mut sides: Vec<Option<(f64, f64)>>,
    columns: DMatrix<f64>,
    free: DMatrix<f64>,
    all: &DMatrix<f64>,
    substep: f64,
) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    loop {
        let mut matrix = &g * &spread;
        for i in 0..matrix.nrows() {
            // a row that nothing moves, or that was given up, holds nothing
            matrix[(i, i)] = if matrix[(i, i)] > 0.0 { matrix[(i, i)] * (1.0 + REDUNDANT) } else { 1.0 };
        }
        let matrix = matrix.cholesky()?;
        let own = matrix.solve(&(&g * all)) * -substep;
        let pulls = |i: &usize| sides[*i].is_some_and(|(side, push)| side * (push + own[*i]) < 0.0);
        let Some(row) = (0..sides.len()).find(pulls) else {
            let response = &columns - &spread * matrix.solve(&(&g * &columns));
            let free = &free - &spread * matrix.solve(&(&g * &free));
            return Some((response, free));
        };
        g.row_mut(row).fill(0.0);
        spread.column_mut(row).fill(0.0);
        sides[row] = None;
    }
}

/// The bodies that impulse joints connect with a body, and how they answer an impulse on it; none if no joint holds it.
pub(crate) fn chain(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    load: &Vector6<f64>,
    substep: f64,
    held: &dyn Fn(RigidBodyHandle) -> bool,
) -> Option<Chain> {
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
    let bears = bodies.len() < MOST_BODIES && bears(world, &bodies, handle, held);
    let (mut borne, mut loads) = (Borne::default(), DMatrix::<f64>::zeros(n, 1));
    for (i, body) in bodies.iter().enumerate().skip(1).filter(|_| bears) {
        let (aside, force) = put_aside(world, *body);
        borne.bodies.push(aside);
        loads.fixed_view_mut::<6, 1>(6 * i, 0).copy_from(&force);
    }
    let standing = |joint: &ImpulseJoint| if bears { limits::near(world, joint) } else { limits::pushing(joint) };
    let locked = |joint: &ImpulseJoint| joint.data.locked_axes.bits() | standing(joint);
    let rows: usize = joints.iter().map(|j| locked(j.2).count_ones() as usize).sum();
    let mut g = DMatrix::<f64>::zeros(rows, n);
    // by row, to which side its limit pushes, and with what it did in Rapier's last substep; none of a locked axis
    let mut pushes: Vec<Option<(f64, f64)>> = Vec::with_capacity(rows);
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
            pushes.push(limit.then(|| {
                if bears {
                    (limits::nearest(world, joint, axis), 0.0)
                } else {
                    let push = -f64::from(joint.data.limits[axis].impulse);
                    (push.signum(), push)
                }
            }));
        }
    }
    let spread = &inverse * g.transpose();
    let columns = inverse.columns(0, 6).into_owned();
    let free = &inverse * loads;
    let all = &free + &columns * DMatrix::from_column_slice(6, 1, load.as_slice());
    let (response, free) = constrain(g, spread, pushes, columns, free, &all, substep)?;
    let before = bodies.iter().map(|b| (world.bodies[*b].linvel(), world.bodies[*b].angvel())).collect();
    borne.of_body = free.fixed_view::<6, 1>(0, 0).into_owned();
    borne.free = free.column(0).into_owned();
    borne.quiet = !borne.bodies.is_empty() && alone(world, &bodies, handle);
    Some(Chain { bodies, response, before, borne })
}
