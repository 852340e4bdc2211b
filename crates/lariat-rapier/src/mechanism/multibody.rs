//! Links of multibodies.
//!
//! # Equation
//! ```text
//! W = J R      R = P M^-1 J^T      a = P M^-1 (sum J_i^T f_i - D u)      a0 = J (a - M^-1 sum J_i^T M_i J_i' u) + J' u
//! ```
//! J is a link's Jacobian (velocity of its centre of mass before angular velocity) and M the mass
//! matrix, both Rapier's; f_i are the loads on the other links, D the damping that Rapier gives the
//! joints (0.1 N m s about axes unless the user changes it) and u the generalised velocity. Each
//! active limit is a unit vector in G ([`super::constraints`]). All are those after half a step at
//! the present u (a clone of the multibody is moved there), which makes the prediction one of
//! second order; what u gains from J' u is Rapier's to do, so a0 alone contains it. Limits count
//! only where the loads on the other links are included.
//!
//! Rapier overwrites the velocities of links by those of the generalised velocity, so a change must
//! be made there; and it leaves in a link the velocity of the last substep but one.
//!
//! Where the loads on the other links are included, damping is a part of the prediction, and Rapier
//! has none meanwhile: implicit for the share w of the step h that gives each rate its own decay,
//!
//! ```text
//! (M + w h D) (u1 - u0) = h (sum J_i^T f_i - D u0)        1 - z/(1 + w z) = exp(-z),   z = h D (M^-1)_ii
//! ```
//!
//! With w from 1/2 to 1 that is stable for any damping: that of Rapier's axes, 0.1 N m s, stops a
//! link of a gram within microseconds.
//!
//! # Validity
//! Not with kinematic joints of a multibody: Rapier's mass matrix is then only a part of the whole.
//! Where the loads of the other links are not included, limits enter by the reaction estimate:
//! Rapier does not report the impulse of a limit of a multibody.
//!
//! # References
//! Featherstone 2008, section 3.2; Udwadia & Kalaba 1992.

use super::constraints::{Constraints, Limit};
use super::limits;
use super::loads::{CarriedLoads, are_isolated, can_predict_loads};
use super::of_body::{Mechanism, Velocities};
use super::request::Request;
use crate::body::spatial::{split_spatial, stack_spatial};
use crate::body::unsettled::JointGap;
use crate::convert::symmetric;
use crate::scales::mechanism::SERIES;
use ::nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Vector6};
use rapier::dynamics::{Multibody, RigidBody, RigidBodyHandle};
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Returns the multibody of a link and the index of the link, if its mass matrix is computed and
/// covers all degrees of freedom.
fn multibody(world: &PhysicsWorld, handle: RigidBodyHandle) -> Option<(&Multibody, usize)> {
    let link = world.multibody_joints.rigid_body_link(handle)?;
    let multibody = world.multibody_joints.get_multibody(link.multibody)?;
    let n = multibody.ndofs();
    let complete = n > 0
        && multibody.body_jacobian(link.id).ncols() == n
        && multibody.inv_augmented_mass().lu_internal().nrows() == n;
    complete.then_some((multibody, link.id))
}

/// Makes Rapier compute the mass matrix of a link's multibody, if it has not since joints changed.
pub(crate) fn prepare(world: &mut PhysicsWorld, handle: RigidBodyHandle) {
    let Some(link) = world.multibody_joints.rigid_body_link(handle).copied() else { return };
    let Some(multibody) = world.multibody_joints.get_multibody_mut(link.multibody) else { return };
    let n = multibody.ndofs();
    // with kinematic joints the matrix never covers all degrees of freedom
    let missing =
        multibody.body_jacobian(link.id).ncols() != n || multibody.inv_augmented_mass().lu_internal().is_empty();
    if n > 0 && missing {
        multibody.dof_inverse_inertia(&world.bodies);
    }
}

/// Returns the mechanism of a link.
pub(super) fn find(world: &PhysicsWorld, request: &Request) -> Option<Mechanism> {
    let (multibody, id) = multibody(world, request.handle)?;
    let n = multibody.ndofs();
    let handles: Vec<RigidBodyHandle> = multibody.links().map(|l| l.rigid_body_handle()).collect();
    let predicts_loads = can_predict_loads(world, &handles, request);
    let active = if predicts_loads { active_limits(multibody) } else { Vec::new() };
    // at a limit joints hardly turn, and it is their damping that brings Rapier's solver to rest
    let predicts_damping = predicts_loads && active.is_empty();
    let halfway = halfway(world, multibody, request, predicts_damping);
    let jacobian = |id: usize| halfway.body_jacobian(id).map(f64::from);
    let inverse = |b: &DMatrix<f64>| {
        let mut x = b.map(|x| x as Real);
        halfway.inv_augmented_mass().solve_mut(&mut x).then(|| x.map(f64::from))
    };
    let mut loads = CarriedLoads::default();
    // the loads on others alone, and those on all bodies
    let mut forces = [DVector::<f64>::zeros(n), DVector::<f64>::zeros(n)];
    for (i, body) in handles.iter().enumerate().filter(|(_, b)| world.bodies.get(**b).is_some_and(|b| b.is_dynamic())) {
        let of_member = request.members.iter().find(|(member, _)| member == body);
        let is_other = of_member.is_none() && predicts_loads;
        let load =
            if is_other { loads.add(world, *body) } else { of_member.map_or_else(Vector6::zeros, |(_, load)| *load) };
        let generalised = jacobian(i).transpose() * load;
        forces[1] += &generalised;
        if is_other {
            forces[0] += generalised;
        }
    }
    if predicts_damping {
        let damping = multibody.damping();
        let rates = damping.component_mul(&multibody.generalized_velocity()).map(f64::from);
        forces.iter_mut().for_each(|forces| *forces -= &rates);
        loads.joint_damping = Some((request.handle, damping.clone()));
    }
    loads.limited = !active.is_empty();
    let mut rows = DMatrix::<f64>::zeros(active.len(), n);
    active.iter().enumerate().for_each(|(i, (dof, _))| rows[(i, *dof)] = 1.0);
    let own = jacobian(id);
    let spread = inverse(&rows.transpose())?;
    let columns = inverse(&DMatrix::from_iterator(n, 6, own.transpose().iter().copied()))?;
    let [free, all] = forces.map(|forces| inverse(&DMatrix::from_column_slice(n, 1, forces.as_slice())));
    let limits = active.into_iter().map(|(_, limit)| limit).collect::<Vec<_>>();
    let turning = DVector::zeros(limits.len());
    let constraints = Constraints { rows, spread, turning, limits, substep: 1.0 };
    let (response, free, _) = constraints.project(&columns, &free?, &all?)?;
    // J' u, with which a link accelerates at a constant u
    let turning = |id: usize| {
        let change = (halfway.body_jacobian(id) - multibody.body_jacobian(id)) * multibody.generalized_velocity();
        change.map(f64::from) / request.half_step
    };
    loads.of_body = Vector6::from_iterator((&own * &free).iter().copied()) + turning(id);
    if !loads.limited {
        let mut forces = DMatrix::<f64>::zeros(n, 1);
        for (i, body) in handles.iter().enumerate().filter_map(|(i, b)| Some((i, world.bodies.get(*b)?))) {
            forces -= jacobian(i).transpose() * inertial_force(body, &turning(i));
        }
        loads.of_body += &own * inverse(&forces)?.column(0);
    }
    loads.accelerations = free.column(0).into_owned();
    loads.isolated = predicts_loads && are_isolated(world, &handles);
    let members = handles.iter().enumerate().filter(|(_, body)| request.is_member(**body));
    let mobilities =
        members.map(|(i, body)| (*body, Matrix6::from_iterator((jacobian(i) * &response).iter().copied())));
    let mobilities = mobilities.collect();
    let before = Velocities::Generalised(multibody.generalized_velocity().iter().copied().collect());
    Some(Mechanism { handle: request.handle, response, mobilities, before, loads, opening: JointGap::default() })
}

/// Returns the force and the torque that accelerate a body; zero for one that is not dynamic.
fn inertial_force(body: &RigidBody, acceleration: &Vector6<f64>) -> Vector6<f64> {
    let inverse = symmetric(&body.mass_properties().effective_world_inv_inertia);
    let (linear, angular) = split_spatial(acceleration);
    let inertia = inverse.try_inverse().filter(|_| body.is_dynamic()).unwrap_or_else(Matrix3::zeros);
    let mass = if body.is_dynamic() { f64::from(body.mass()) } else { 0.0 };
    stack_spatial(&(linear * mass), &(inertia * angular))
}

/// Returns a multibody as it is after half a step of its present motion: with the Jacobians and the
/// mass matrix of then, and damping that is `predicted`, or Rapier's.
fn halfway(world: &PhysicsWorld, multibody: &Multibody, request: &Request, predicted: bool) -> Multibody {
    let mut halfway = multibody.clone();
    let turns: Vec<Real> = multibody.generalized_velocity().iter().map(|u| u * request.half_step as Real).collect();
    halfway.apply_displacements(&turns);
    // Rapier's mass matrix contains the damping of a substep
    let damping = match predicted.then(|| implicit_times(world, &mut halfway, 2.0 * request.half_step)).flatten() {
        Some(times) => halfway.damping().component_mul(&times),
        None => halfway.damping() * request.substep as Real,
    };
    *halfway.armature_mut() += damping;
    halfway.dof_inverse_inertia(&world.bodies);
    halfway
}

/// Returns the times in s, by degree of freedom, of the damping in the mass matrix by which a rate
/// decays in a step of `h` (s) as by its own inertia; `None` if nothing damps.
fn implicit_times(world: &PhysicsWorld, multibody: &mut Multibody, h: f64) -> Option<DVector<Real>> {
    let damping = multibody.damping().clone();
    if damping.iter().all(|d| *d <= 0.0) {
        return None;
    }
    multibody.dof_inverse_inertia(&world.bodies);
    let n = multibody.ndofs();
    let mut inverse = DMatrix::<Real>::identity(n, n);
    multibody.inv_augmented_mass().solve_mut(&mut inverse).then(|| {
        DVector::from_fn(n, |i, _| {
            let z = f64::from(damping[i]) * h * f64::from(inverse[(i, i)]);
            (h * implicit_share(z)) as Real
        })
    })
}

/// Returns the share w of a step in which damping is implicit, so that 1 - z/(1 + w z) = exp(-z): a
/// half of a slow decay, 1 of one within the step.
fn implicit_share(z: f64) -> f64 {
    if z > SERIES { (-1.0 / libm::expm1(-z) - 1.0 / z).min(1.0) } else { 0.5 + z / 12.0 }
}

/// Returns the limits at which the joints of a multibody are, by degree of freedom; `None` for a
/// joint that is at both.
fn active_limits(multibody: &Multibody) -> Vec<(usize, Option<Limit>)> {
    let velocity = multibody.generalized_velocity();
    let mut active = Vec::new();
    for link in multibody.links() {
        let data = &link.joint.data;
        let free = |axis: usize| data.locked_axes.bits() & (1 << axis) == 0;
        let turns = (3..6).filter(|x| free(*x)).count();
        let limited = data.limit_axes.bits();
        for (dof, axis) in (link.assembly_id()..).zip((0..6).filter(|x| free(*x))) {
            if limited & (1 << axis) != 0 && (axis < 3 || turns == 1) {
                let at = f64::from(link.joint.coords()[axis]);
                if let Some(side) = limits::active_side(at, &data.limits[axis], f64::from(velocity[dof])) {
                    let one = !limits::hold_both_sides(&data.limits[axis]);
                    active.push((dof, one.then_some(Limit { side, impulse: 0.0 })));
                }
            }
        }
    }
    active
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* The decay exp(-z) of a rate by its own damping.
    #[test]
    fn damping_decays_as_by_its_own_inertia_at_any_step() {
        for z in [1e-6, 5e-4, 2e-3, 0.1, 1.0, 30.0, 1e6] {
            let left = 1.0 - z / (1.0 + implicit_share(z) * z);
            assert!((left - (-z).exp()).abs() < 1e-9 * z.min(1.0), "{z}: {left}");
            assert!((0.5..=1.0).contains(&implicit_share(z)));
        }
    }
}
