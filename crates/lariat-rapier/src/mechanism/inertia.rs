//! The inertia with which a body of a mechanism answers forces.
//!
//! # Equation
//! ```text
//! L = (W + e S)^-1
//! part of a force that moves the body:       f' = L (L^-1 - e S) f
//! impulse implied by a velocity residual:    p = D W D dv,   D = (W + c S)^-1
//! ```
//! W is the mobility of the body in its mechanism, S that of the body alone. The term e S makes the
//! body as good as immovable along what its joints hold, without a singular matrix.
//!
//! # Validity
//! With c = e, near a singular configuration (a straight arm with free elbows moves along itself
//! only by its bends; W is of the order of e there), an error of a joint of 1e-6 m reads as 1e3 N:
//! such an arm, once struck, blew up within ten steps. Therefore c is [`ISOLATED_COMPLIANCE`] for a
//! mechanism that touches nothing. 0.01 works as well; with 1e-3 one of six runs failed.

use ::nalgebra::{Matrix6, Vector6};
use lariat_ancf::island::RigidBody;

/// e: share of its own mobility that a body keeps along what its joints hold.
pub(super) const JOINT_COMPLIANCE: f64 = 1e-4;
/// c of a mechanism that touches nothing.
const ISOLATED_COMPLIANCE: f64 = 0.1;

/// Returns the inertia of a body alone, in world axes.
pub(super) fn own_inertia(body: &RigidBody) -> Matrix6<f64> {
    let mut inertia = Matrix6::identity() * body.mass;
    inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&body.world_inertia(&body.rotation));
    inertia
}

/// Returns the inertia of a body with what it carries, in world axes.
pub(crate) fn inertia(body: &RigidBody) -> Matrix6<f64> {
    body.carried.map_or_else(|| own_inertia(body), |carried| own_inertia(body) + carried)
}

/// Returns the part of a force and torque on a body that moves it; joints hold against the rest.
pub(crate) fn unconstrained_part(body: &RigidBody, load: &Vector6<f64>) -> Vector6<f64> {
    let (total, own) = (inertia(body), own_inertia(body));
    let share = own.try_inverse().and_then(|own| Some(total * (total.try_inverse()? - own * JOINT_COMPLIANCE)));
    share.map_or(*load, |share| share * load)
}

/// Returns the impulse implied by a velocity residual. `isolated`: the mechanism touches no other
/// body.
pub(crate) fn implied_impulse(body: &RigidBody, residual: &Vector6<f64>, isolated: bool) -> Vector6<f64> {
    let (total, own) = (inertia(body), own_inertia(body));
    let response = own.try_inverse().and_then(|own| {
        let mobility = total.try_inverse()? - own * JOINT_COMPLIANCE;
        let compliance = if isolated { ISOLATED_COMPLIANCE } else { JOINT_COMPLIANCE };
        let inertia = (mobility + own * compliance).try_inverse()?;
        Some(inertia * mobility * inertia)
    });
    response.map_or_else(Vector6::zeros, |response| response * residual)
}
